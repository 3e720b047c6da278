#include "apps/viewer/loader.h"

#include <fmt/format.h>

#include <exception>

#include "lambent/sources/source.h"

namespace lambent::viewer {

namespace {

std::string lowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return extension;
}

Result<Loaded> readEnvironment(const std::string& source, const asset::ReadOptions& reading,
                               const std::stop_token& stop) {
  auto parsed = sources::parseSource(
      source, {.notFinite = sources::SourceOptions::NotFinite::Repair,
               .memoryLimit = reading.memoryLimit,
               .progress = [&](const ProgressUpdate&) { return !stop.stop_requested(); }});
  if (!parsed) return parsed.error();
  return Loaded(LoadedEnvironment{source, std::move(parsed->value), std::move(parsed->findings)});
}

}  // namespace

Result<LoadedAsset> readAsset(const std::filesystem::path& path,
                              const asset::ReadOptions& reading) {
  const std::string extension = lowerExtension(path);
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
  requests_.push_back({true, path.string()});
  woken_.notify_one();
}

void Loader::readEnvironment(std::string source) {
  const std::lock_guard lock(mutex_);
  requests_.push_back({false, std::move(source)});
  woken_.notify_one();
}

void Loader::work(std::stop_token stop) {
  for (;;) {
    Request request;
    asset::ReadOptions reading;
    {
      std::unique_lock lock(mutex_);
      if (!woken_.wait(lock, stop, [this] { return !requests_.empty(); })) return;
      request = requests_.front();
      requests_.pop_front();
      current_ = request;
      reading = reading_;
      began_ = std::chrono::steady_clock::now();
    }
    Result<Loaded> result = report::failed("");
    try {
      if (request.asset) {
        auto asset = viewer::readAsset(request.name, reading);
        result = asset ? Result<Loaded>(Loaded(std::move(*asset))) : Result<Loaded>(asset.error());
      } else {
        result = viewer::readEnvironment(request.name, reading, stop);
      }
    } catch (const std::bad_alloc&) {
      result = report::failed(fmt::format("{}: not enough memory to read it", request.name));
    } catch (const std::exception& e) {
      result = report::failed(fmt::format("{}: {}", request.name, e.what()));
    }
    const std::lock_guard lock(mutex_);
    results_.push_back(std::move(result));
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
  return current_ ? std::filesystem::path(current_->name).filename().string() : std::string();
}

double Loader::seconds() const {
  const std::lock_guard lock(mutex_);
  return current_ ? std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count()
                  : 0.0;
}

}  // namespace lambent::viewer
