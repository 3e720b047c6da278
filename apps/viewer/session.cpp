#include "apps/viewer/session.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lambent/file/atomic_file.h"
#include "lambent/file/extension.h"
#include "lambent/image/io.h"
#include "lambent/sources/source.h"
#include "lambent/view/orbit.h"
#include "lambent/view/placement.h"

namespace lambent::viewer {

namespace {

bool isOneOf(const std::string& word, std::initializer_list<const char*> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A .json is a state or a light: its own word says which. A file that cannot be read is the
/// reader's to explain.
bool saysLight(const std::filesystem::path& path) {
  const auto bytes = file::readWhole(path);
  if (!bytes) return false;
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  return text.find("\"coefficients\"") != text.npos && text.find("\"light\"") != text.npos;
}

}  // namespace

void Session::openAsset(const std::filesystem::path& path) {
  loader_.readAsset(path);
}

void Session::openEnvironment(const std::string& source) {
  loader_.readEnvironment(source);
}

void Session::openState(const std::filesystem::path& path) {
  auto read = view::readViewState(path);
  if (!read) return notices.problem(read.error());
  waiting_ = std::move(*read);
  if (findLights_) waiting_->environment = findLights_(waiting_->environment, path);
  loader_.readEnvironment(waiting_->environment);
}

void Session::open(const std::filesystem::path& path) {
  const std::string extension = file::extensionOf(path);
  if (isOneOf(extension, {".glb", ".gltf", ".obj", ".ply"})) return openAsset(path);
  if (isOneOf(extension, {".exr", ".hdr", ".png", ".jpg", ".jpeg", ".webp"}))
    return openEnvironment(path.string());
  if (extension == ".json")
    return saysLight(path) ? openEnvironment(path.string()) : openState(path);
  notices.problem(report::badInput(
      fmt::format("{}: the viewer shows baked assets (.glb), lights them with images (.exr, .hdr, "
                  ".png, .jpg, .webp) or a LIGHT.json, and opens its own states (.json)",
                  path.filename().string())));
}

void Session::nextEnvironment(int step) {
  const int count = int(environments.size());
  if (count < 2) return;
  const auto shown = std::find(environments.begin(), environments.end(), state.environment);
  const int at = shown == environments.end() ? 0 : int(shown - environments.begin());
  openEnvironment(environments[std::size_t(((at + step) % count + count) % count)]);
}

void Session::ask(FileQuestion::What what, const PixelSize& picture) {
  FileQuestion question{what, {}, {}, picture};
  if (what == FileQuestion::What::SavePicture && stage.empty())
    return saveScreenshot({}, picture);  // which says that there is nothing to save
  std::error_code ignored;
  if (question.saves()) {
    question.name = freeName(what == FileQuestion::What::SavePicture ? ".png" : ".json").string();
    question.folder = std::filesystem::current_path(ignored);
  } else if (!stage.empty()) {
    question.folder = std::filesystem::absolute(stage.path(), ignored).parent_path();
  }
  ownQuestion_.reset();
  fileDialog.ask(std::move(question));
}

void Session::answer(const FileQuestion& question, std::filesystem::path path) {
  using What = FileQuestion::What;
  if (!question.saves()) return open(path);
  if (!path.has_extension()) {
    // Whoever was asked whether to write over a file was asked about the name without it.
    path += question.what == What::SavePicture ? ".png" : ".json";
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored))
      return notices.problem(report::badInput(fmt::format(
          "{} is there already: to write over it, choose it by its whole name", path.string())));
  }
  question.what == What::SavePicture ? saveScreenshot(path, question.picture) : saveState(path);
}

void Session::answerOwn(const std::filesystem::path& path) {
  const FileQuestion question = std::exchange(ownQuestion_, std::nullopt)->question;
  std::error_code ignored;
  if (question.saves() && std::filesystem::exists(path, ignored))
    return notices.problem(report::badInput(
        fmt::format("{} is there already: save under another name", path.string())));
  answer(question, path);
}

void Session::askNoMore() {
  ownQuestion_.reset();
  fileDialog.giveUp();
}

void Session::takeFile() {
  auto taken = fileDialog.take();
  if (!taken) return;
  auto& [question, told] = *taken;
  switch (told.how) {
    case FileAnswer::How::Chosen:
      return answer(question, std::move(told.path));
    case FileAnswer::How::Cancelled:
      return;
    case FileAnswer::How::NoDialog:
      ownQuestion_ = OwnQuestion{std::move(question), std::move(told.text)};
      return;
    case FileAnswer::How::Failed:
      return notices.problem(report::failed(fmt::format(
          "{}. {}", told.text,
          question.saves() ? "S and Ctrl+S save in the current folder without it"
                           : "Drop the file on the window, or name it on the command line")));
  }
}

bool Session::collect() {
  takeFile();
  bool any = false;
  while (auto read = loader_.take()) {
    any = true;
    if (!*read) {
      // A state whose light cannot be had is not half shown.
      waiting_.reset();
      sky_ = skyOf(state.environment);
      skyRemark_.clear();
      notices.problem(read->error());
      continue;
    }
    std::visit([this](auto& loaded) { take(std::move(loaded)); }, **read);
  }
  seekAir();
  return any;
}

void Session::seekAir() {
  if (!state.air || airSource_ == state.environment) return;
  airSource_ = state.environment;
  airRemark_.clear();
  if (const auto sky = sources::resolvedSky(airSource_); sky) return loader_.readAir(airSource_);
  airRemark_ = "No air: the light is not that of one sky.";
  notices.remarkOnce(airRemark_);
  stage.setAir(nullptr, Mat3d::Identity());
}

void Session::take(LoadedAir loaded) {
  for (const Finding& finding : loaded.findings) notices.remarkOnce(finding.message);
  stage.setAir(std::move(loaded.table), loaded.worldFromSun);
}

void Session::take(LoadedAsset loaded) {
  const std::string name = loaded.path.filename().string();
  view::ViewState next = state;
  next.camera.reset();
  next.objectRotation = {0, 0, 0, 1};
  next.objectTranslation = Vec3::Zero();
  if (!notices.check(stage.show(std::move(loaded), next))) return;
  state = next;
  notices.remark(name);
}

void Session::showSky(const sky::SkyRequest& request) {
  ShownSky shown = shownSky(request);
  sky_ = request;
  skyRemark_ = std::move(shown.remark);
  loader_.readSky(std::move(shown.source));
}

void Session::take(LoadedEnvironment loaded) {
  for (const Finding& finding : loaded.findings)
    if (finding.severity == Severity::Warning) notices.remarkOnce(finding.message);
  stage.setEnvironment(loaded.environment);
  const bool isSky = skyOf(loaded.source).has_value();
  if (!loaded.underTheHand) {
    sky_ = skyOf(loaded.source);
    skyRemark_.clear();
  }
  nameEnvironment(loaded.source, loaded.underTheHand);
  if (!loaded.underTheHand && waiting_ && waiting_->environment == loaded.source) {
    state = *waiting_;
    waiting_.reset();
    desk.disc = -1;
    if (isSky) desk.exposeSky = false;  // the state has an exposure of its own
  } else if (isSky && desk.exposeSky) {
    state.exposure = exposureFor(loaded.environment);
  } else if (!isSky && desk.exposeSky && skyOf(state.environment)) {
    state.exposure = 0;
  }
  state.environment = loaded.source;
}

/// Into the list; a sky under the hand stands there once, `instead` of what it was before.
void Session::nameEnvironment(const std::string& source, bool instead) {
  if (std::find(environments.begin(), environments.end(), source) != environments.end()) return;
  const auto shown = std::find(environments.begin(), environments.end(), state.environment);
  if (instead && shown != environments.end() && skyOf(*shown))
    *shown = source;
  else
    environments.push_back(source);
}

view::LookAt& Session::hand(const PixelSize& picture) {
  if (!state.camera)
    state.camera = view::lookAtOf(stage.camera(state, picture),
                                  stage.empty() ? scene::Box() : stage.bounds(state));
  return *state.camera;
}

void Session::frameAll(const PixelSize& picture) {
  if (stage.empty()) return;
  const double aspect = double(picture.width) / std::max(picture.height, 1);
  state.camera = view::framed(hand(picture), stage.bounds(state), aspect);
}

void Session::turnEnvironment(const Vec3d& axis, double radians) {
  state.environmentRotation = view::turned(state.environmentRotation, axis, radians);
}

void Session::turnObject(const Vec3d& axis, double radians) {
  const scene::Box box = stage.empty() ? scene::Box() : stage.bounds(state);
  const Vec3d pivot = box.empty() ? Vec3d::Zero() : Vec3d(box.center().cast<double>());
  view::turnObject(state, pivot, axis, radians);
}

void Session::resetView() {
  state.camera.reset();
  state.objectRotation = {0, 0, 0, 1};
  state.objectTranslation = Vec3::Zero();
}

void Session::addDisc(const view::Disc& disc) {
  state.discs.push_back(disc);
  desk.disc = int(state.discs.size()) - 1;
}

void Session::removeDisc(int index) {
  if (index < 0 || index >= int(state.discs.size())) return;
  state.discs.erase(state.discs.begin() + index);
  desk.disc = std::min(desk.disc, int(state.discs.size()) - 1);
}

std::filesystem::path Session::freeName(const std::string& extension) const {
  const std::string stem = stage.empty() ? "lambent" : stage.path().stem().string();
  for (int i = 1;; ++i) {
    const std::filesystem::path name = fmt::format("{}-{:03}{}", stem, i, extension);
    std::error_code ignored;
    if (!std::filesystem::exists(name, ignored)) return name;
  }
}

void Session::saveScreenshot(const std::filesystem::path& path, const PixelSize& size) {
  if (stage.empty())
    return notices.problem(report::failed("there is nothing to take a picture of: open an asset"));
  const auto picture = stage.picture(state, size);
  if (!picture) return notices.problem(picture.error());
  if (notices.check(image::write(*picture, path)))
    notices.remark(fmt::format("{}  {} × {}", path.string(), size.width, size.height));
}

void Session::saveState(const std::filesystem::path& path) {
  if (notices.check(view::writeViewState(state, path))) notices.remark(path.string());
}

}  // namespace lambent::viewer
