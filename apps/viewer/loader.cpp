#include "apps/viewer/loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "apps/viewer/sky_control.h"
#include "lambent/file/extension.h"
#include "lambent/sky/make_aerial_perspective.h"
#include "lambent/sky/make_sky.h"
#include "lambent/sky/sky_light.h"
#include "lambent/sources/source.h"

namespace lambent::viewer {

namespace {

Result<LoadedEnvironment> readEnvironment(const std::string& source,
                                          const asset::ReadOptions& reading,
                                          const Progress& progress) {
  auto parsed =
      sources::parseSource(source, {.notFinite = sources::SourceOptions::NotFinite::Repair,
                                    .memoryLimit = reading.memoryLimit,
                                    .progress = progress});
  if (!parsed) return parsed.error();
  return LoadedEnvironment{source, std::move(parsed->value), std::move(parsed->findings)};
}

/// The same as of the SOURCE `sky:…`, with a maker that stays.
Result<LoadedEnvironment> makeSky(const std::string& source, const sky::SkyRequest& request,
                                  sky::SkyMaker& maker, const Progress& progress) {
  auto resolved = sky::resolve(request);
  if (!resolved) return resolved.error();
  resolved->value.options.cache = sky::cacheFolder();
  auto made = maker.make(resolved->value.options, progress);
  if (!made) return made.error();
  LoadedEnvironment loaded{source, sky::environmentOf(made->value, resolved->value.worldFromSun),
                           std::move(resolved->findings)};
  loaded.findings.insert(loaded.findings.end(), made->findings.begin(), made->findings.end());
  return loaded;
}

Result<LoadedAir> makeAir(const std::string& source, sky::AirMaker& maker,
                          const Progress& progress) {
  auto resolved = sources::resolvedSky(source);
  if (!resolved) return resolved.error();
  auto made = maker.make(resolved->value.options, sky::AerialForm::Table, progress);
  if (!made) return made.error();
  auto& table = std::get<sky::AirTable>(made->value);
  return LoadedAir{source, std::make_shared<const sky::AirTable>(std::move(table)),
                   resolved->value.worldFromSun, std::move(made->findings)};
}

template <class T>
Result<Loaded> loadedOf(Result<T> made) {
  return made ? Result<Loaded>(Loaded(std::move(*made))) : Result<Loaded>(made.error());
}

}  // namespace

Result<LoadedAsset> readAsset(const std::filesystem::path& path,
                              const asset::ReadOptions& reading) {
  const std::string extension = file::extensionOf(path);
  bool plain = extension == ".obj" || extension == ".ply";
  if (!plain) {
    const Result<bool> baked = asset::isAsset(path);
    if (!baked) return baked.error();
    plain = !*baked && (extension == ".glb" || extension == ".gltf");
  }
  if (plain) {
    const std::string stem = path.stem().string();
    return report::badInput(
        fmt::format("{} is not baked. Bake it first: lambent bake {} -o {}-baked.glb",
                    path.filename().string(), path.string(), stem));
  }
  auto read = asset::read(path, reading);
  if (!read) return read.error();
  return LoadedAsset{path, std::make_unique<asset::Asset>(std::move(*read))};
}

Loader::Loader() : thread_([this](std::stop_token stop) { work(stop); }) {}

Loader::~Loader() {
  thread_.request_stop();
}

void Loader::allow(const asset::ReadOptions& reading) {
  const std::lock_guard lock(mutex_);
  reading_ = reading;
}

void Loader::readAsset(std::filesystem::path path) {
  const std::lock_guard lock(mutex_);
  requests_.push_back({Request::What::Asset, path.string()});
  woken_.notify_one();
}

void Loader::readEnvironment(std::string source) {
  const std::lock_guard lock(mutex_);
  requests_.push_back({Request::What::Environment, std::move(source)});
  woken_.notify_one();
}

void Loader::readSky(std::string source) {
  const std::lock_guard lock(mutex_);
  std::erase_if(requests_, [](const Request& each) { return each.what == Request::What::Sky; });
  requests_.push_back({Request::What::Sky, std::move(source)});
  woken_.notify_one();
}

void Loader::readAir(std::string source) {
  const std::lock_guard lock(mutex_);
  std::erase_if(requests_, [](const Request& each) { return each.what == Request::What::Air; });
  requests_.push_back({Request::What::Air, std::move(source)});
  woken_.notify_one();
}

bool Loader::goesOn(const Request& request, const ProgressUpdate& update) {
  const std::lock_guard lock(mutex_);
  share_ =
      update.total > 0 ? std::optional(double(update.done) / double(update.total)) : std::nullopt;
  if (!givesWay(request)) return true;
  const auto mine = skyOf(request.name);
  return std::none_of(requests_.begin(), requests_.end(), [&](const Request& each) {
    const auto next = each.what == request.what ? skyOf(each.name) : std::nullopt;
    return next && mine && (mine->model == sky::Model::Exact || !sameAir(*mine, *next));
  });
}

void Loader::work(std::stop_token stop) {
  sky::SkyMaker skies;
  sky::AirMaker airs;
  for (;;) {
    Request request;
    asset::ReadOptions reading;
    {
      std::unique_lock lock(mutex_);
      if (!woken_.wait(lock, stop, [this] { return !requests_.empty(); })) return;
      request = requests_.front();
      requests_.pop_front();
      current_ = request;
      share_.reset();
      reading = reading_;
      began_ = std::chrono::steady_clock::now();
    }
    Result<Loaded> result = report::failed("");
    const Progress progress = [&](const ProgressUpdate& update) {
      return !stop.stop_requested() && goesOn(request, update);
    };
    try {
      if (request.what == Request::What::Asset) {
        result = loadedOf(viewer::readAsset(request.name, reading));
      } else if (request.what == Request::What::Air) {
        result = loadedOf(viewer::makeAir(request.name, airs, progress));
      } else {
        const auto sky = skyOf(request.name);
        auto light = sky ? viewer::makeSky(request.name, *sky, skies, progress)
                         : viewer::readEnvironment(request.name, reading, progress);
        if (light) light->underTheHand = request.what == Request::What::Sky;
        result = loadedOf(std::move(light));
      }
    } catch (const std::bad_alloc&) {
      result = report::failed(fmt::format("{}: not enough memory to read it", request.name));
    } catch (const std::exception& e) {
      result = report::failed(fmt::format("{}: {}", request.name, e.what()));
    }
    const std::lock_guard lock(mutex_);
    // Of a sky that was given up for another nobody hears.
    const bool givenUp =
        givesWay(request) && !result && result.error().kind == ErrorKind::Cancelled;
    if (!givenUp) results_.push_back(std::move(result));
    current_.reset();
  }
}

std::optional<Result<Loaded>> Loader::take() {
  const std::lock_guard lock(mutex_);
  if (results_.empty()) return std::nullopt;
  std::optional<Result<Loaded>> result(std::move(results_.front()));
  results_.pop_front();
  return result;
}

bool Loader::busy() const {
  const std::lock_guard lock(mutex_);
  return current_ || !requests_.empty() || !results_.empty();
}

std::string Loader::reading() const {
  const std::lock_guard lock(mutex_);
  if (!current_) return {};
  if (skyOf(current_->name)) return "the air of this sky";
  return std::filesystem::path(current_->name).filename().string();
}

std::optional<double> Loader::share() const {
  const std::lock_guard lock(mutex_);
  return current_ ? share_ : std::nullopt;
}

double Loader::seconds() const {
  const std::lock_guard lock(mutex_);
  return current_ ? std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count()
                  : 0.0;
}

}  // namespace lambent::viewer
