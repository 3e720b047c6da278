// What a person works on: a state, what stands on the stage for it, and the files it comes from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/viewer/file_dialog.h"
#include "apps/viewer/light_finder.h"
#include "apps/viewer/loader.h"
#include "apps/viewer/notices.h"
#include "apps/viewer/sky_control.h"
#include "apps/viewer/stage.h"
#include "lambent/view/view_state.h"

namespace lambent::viewer {

/// What is switched on around the picture. Not part of a state.
struct Desk {
  bool panel = true, help = false;
  bool turnEnvironment = false, turnObject = false;
  bool moveSurroundings = true;
  bool vsync = true;
  bool exposeSky = true;  ///< the exposure follows a sky
  int disc = -1;          ///< the one that is chosen, or −1
  bool quit = false;
};

class Session {
 public:
  view::ViewState state;
  Desk desk;
  Stage stage;
  Notices notices;
  /// SOURCEs to switch between; the shown one is state.environment.
  std::vector<std::string> environments;

  /// Of all files that are opened from now on.
  void allow(const asset::ReadOptions& reading) { loader_.allow(reading); }
  /// Of all states that are opened from now on.
  void findLightsBy(LightFinder finder) { findLights_ = std::move(finder); }
  /// All of these read in the background; what is shown stays until the file is there, and for good
  /// if something is wrong with it.
  void openAsset(const std::filesystem::path& path);
  void openEnvironment(const std::string& source);
  void openState(const std::filesystem::path& path);
  /// Whatever it is: a baked .glb, an image, a LIGHT.json, a state.
  void open(const std::filesystem::path& path);
  void nextEnvironment(int step);

  /// Has the desktop ask for a file, and does what the question is for once it is chosen; the window
  /// itself asks where the desktop has no dialog.
  void ask(FileQuestion::What what, const PixelSize& picture);
  /// The question that the window itself has to ask, with why; nothing if there is none.
  struct OwnQuestion {
    FileQuestion question;
    std::string why;  ///< no desktop does
  };
  const std::optional<OwnQuestion>& ownQuestion() const { return ownQuestion_; }
  /// What was typed as its answer. No file is written over.
  void answerOwn(const std::filesystem::path& path);
  /// Whatever asks for a file is closed.
  void askNoMore();
  FileDialog fileDialog;

  /// The sky that is shown, or that a person has asked for and waits for; nothing if the light is
  /// another.
  const std::optional<sky::SkyRequest>& sky() const { return sky_; }
  /// What sky() is from now on, without showing it yet: a slider that is being dragged.
  void holdSky(const sky::SkyRequest& request) { sky_ = request; }
  /// Shows it as soon as it is made; what is shown stays until then.
  void showSky(const sky::SkyRequest& request);
  /// Why the sky is not the one of the moment that was asked for; empty if it is.
  const std::string& skyRemark() const { return skyRemark_; }

  /// Has the air of the light's sky made, where the state wants it and has none of this light yet.
  void seekAir();
  /// Why there is no air although the state wants it; empty if there is.
  const std::string& airRemark() const { return airRemark_; }

  /// Shows what has been read since the last call. True if anything changed.
  bool collect();
  bool busy() const { return loader_.busy(); }
  const Loader& loader() const { return loader_; }

  /// The camera as the hand holds it; made of the file's or the automatic one at first touch.
  view::LookAt& hand(const PixelSize& picture);
  void frameAll(const PixelSize& picture);
  void turnEnvironment(const Vec3d& axis, double radians);
  /// About the middle of the object.
  void turnObject(const Vec3d& axis, double radians);
  /// Camera and object as the file has them.
  void resetView();
  /// Adds a lamp where the disc says, and chooses it.
  void addDisc(const view::Disc& disc);
  void removeDisc(int index);

  /// A name that is not taken in the current folder: "bunny-001.png".
  std::filesystem::path freeName(const std::string& extension) const;
  void saveScreenshot(const std::filesystem::path& path, const PixelSize& size);
  void saveState(const std::filesystem::path& path);

 private:
  void takeFile();
  void answer(const FileQuestion& question, std::filesystem::path path);
  void take(LoadedAsset loaded);
  void take(LoadedEnvironment loaded);
  void take(LoadedAir loaded);
  void nameEnvironment(const std::string& source, bool instead);

  Loader loader_;
  LightFinder findLights_;
  std::optional<OwnQuestion> ownQuestion_;
  std::optional<view::ViewState> waiting_;  ///< a state whose environment is being read
  std::optional<sky::SkyRequest> sky_;
  std::string skyRemark_;
  std::string airSource_;  ///< the SOURCE whose air is shown or waited for
  std::string airRemark_;
};

}  // namespace lambent::viewer
