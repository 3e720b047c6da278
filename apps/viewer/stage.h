// What stands before the camera: an asset on the GPU, its light, its backdrop; drawn for a state.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "apps/viewer/gl_window.h"
#include "apps/viewer/loader.h"
#include "apps/viewer/patch_marks.h"
#include "apps/viewer/surroundings.h"
#include "lambent/image/image.h"
#include "lambent/render/live_renderer.h"
#include "lambent/shade/showing.h"
#include "lambent/view/state_light.h"
#include "lambent/view/view_state.h"

namespace lambent::viewer {

/// What the shown asset makes possible; the rest is greyed.
struct Possibilities {
  bool unshadowed = false, shadowed = false, interreflected = false;
  bool mesoStructure = false;  ///< macro and view dependence mean something
  bool glossy = false;         ///< so does the exponent of lobes
  bool sharpSun = false;       ///< so do sharp shadows of the Sun
};

class Stage {
 public:
  /// Uploads the asset and shows it from now on; what was shown before stays if that fails.
  Status show(LoadedAsset loaded, const view::ViewState& state);
  void setEnvironment(const light::Environment& environment);
  /// The air of the environment's sky: shown where the state wants it. Null: it has no sky.
  void setAir(std::shared_ptr<const sky::AirTable> table, const Mat3d& environmentFromSun);
  /// What moves around the asset and lights it, or nothing.
  Status setSurroundings(std::unique_ptr<Surroundings> surroundings);
  bool hasSurroundings() const { return surroundings_ != nullptr; }
  /// Time goes on for the surroundings, in seconds.
  void elapse(double seconds);
  /// At how many points of the asset its light is sampled; 0 without surroundings.
  int lightSamples() const { return surroundings_ ? surroundings_->samples() : 0; }
  Status setLightSamples(int count);

  bool empty() const { return !asset_; }
  const asset::Asset& asset() const { return *asset_->asset; }
  const std::filesystem::path& path() const { return asset_->path; }
  const light::Environment& environment() const { return environment_; }
  const Possibilities& possibilities() const { return possibilities_; }

  /// The box of the object where the state puts it.
  scene::Box bounds(const view::ViewState& state) const;
  /// The state's camera or what stands for it.
  scene::Camera camera(const view::ViewState& state, const PixelSize& size) const;

  /// Draws a frame of this size: one sample while anything moves, and then sample after sample
  /// until the picture is as smooth as the state wants it.
  Status draw(const view::ViewState& state, const PixelSize& size);
  /// Whether another frame would make the picture smoother.
  bool settled() const { return settled_; }
  /// Onto a framebuffer of the size of draw().
  Status present(unsigned framebuffer, const view::ViewState& state) const;
  /// A whole picture with all samples of the state, developed for the eye: what `lambent render
  /// --view` makes of it.
  Result<image::Image> picture(const view::ViewState& state, const PixelSize& size);
  /// Nothing that was drawn counts any more.
  void restart() { drawn_.reset(); }
  bool unlit = false;  ///< the base colour alone, to measure against
  PatchOverlays overlays;

 private:
  Status prepare(const view::ViewState& state, const PixelSize& size, bool moving);
  Status addSample(const view::ViewState& state, const PixelSize& size, const Vec2& place,
                   int samples);
  Status hangBackdrop(const view::ViewState& state);
  Status letAirIn(const view::ViewState& state, const PixelSize& size);

  struct Drawn {
    view::ViewState state;
    PixelSize size;
    bool unlit = false;
    PatchOverlays overlays;
  };
  bool sameFrame(const view::ViewState& state, const PixelSize& size) const;
  std::optional<LoadedAsset> asset_;  // before the renderer, which reads from it
  std::optional<render::LiveRenderer> renderer_;
  std::optional<PatchMarks> marks_;  ///< of the asset, once some are wanted
  std::unique_ptr<Surroundings> surroundings_;
  Possibilities possibilities_;
  scene::Box box_;
  light::Environment environment_ = light::Environment::uniform(Rgb::Ones());
  std::optional<view::StateLight> light_;
  std::shared_ptr<const sky::AirTable> air_;
  Mat3d environmentFromSun_ = Mat3d::Identity();
  std::optional<Drawn> drawn_;
  std::optional<shade::Showing> showing_;    ///< under which the renderer was set up
  std::optional<view::ViewState> backdrop_;  ///< for which it was
  PixelSize size_;
  int samples_ = 0;
  bool settled_ = false;
};

}  // namespace lambent::viewer
