// An asset on the GPU, relit and drawn anew with every frame: light, viewer and object move.
#pragma once

#include <cstddef>
#include <memory>

#include "lambent/asset/asset.h"
#include "lambent/capture/blending.h"
#include "lambent/image/image.h"
#include "lambent/light/environment.h"
#include "lambent/report/result.h"
#include "lambent/scene/camera.h"
#include "lambent/sh/coefficients.h"
#include "lambent/shade/air.h"
#include "lambent/shade/sharp_sun.h"
#include "lambent/shade/showing.h"
#include "lambent/tone/tone_curve.h"

namespace lambent::render {

/// How things stand in one frame. World is where camera and lamps are; the asset may be turned and
/// moved in it.
struct LiveView {
  scene::Camera camera;                          ///< in the world
  Mat4 worldFromAsset = Mat4::Identity();        ///< rigid
  Mat3 worldFromEnvironment = Mat3::Identity();  ///< what mirrors and the background show is turned
  bool background = true;                        ///< the environment behind the asset; else black
  bool unlit = false;  ///< the base colour alone: what relighting costs is measured against it
  /// Of meso-structure: radiance of the lines, a pixel and a half wide, along which pieces of the
  /// patch meet in its id map; none: they are not drawn. Not with Showing::filter off, nor unlit.
  std::optional<Rgb> seams;
  scene::Box others;  ///< in the world: what else is drawn into the frame, for near and far
};

/// Works in the OpenGL 4.5 context that is current when it is made (a window's, or a GlContext),
/// which must be current in every call and outlive it. Movable. Mirrors show the asset and,
/// between, the environment; what they show of it is drawn anew in the first frame after the light,
/// the Sun, the air or the choice of what is shown has changed (where mirrors show mirrors or
/// veils, the environment too), which costs about as much as six frames of 512×512 for each of
/// them. Nothing that happens once a frame costs CPU time that grows with the asset. Leaves GL's
/// state as it was, but for what is bound to texture units, image units and indexed storage
/// buffers.
class LiveRenderer {
 public:
  /// Checks and uploads everything. `asset` must outlive it. Black until there is a light.
  static Result<LiveRenderer> make(const asset::Asset& asset, const shade::Showing& showing);
  /// The same with storage buffers of `largestBlock` bytes at most, and 128 texels to a side of
  /// what mirrors show, for tests.
  static Result<LiveRenderer> make(const asset::Asset& asset, const shade::Showing& showing,
                                   std::size_t largestBlock);
  LiveRenderer(LiveRenderer&&) noexcept;
  LiveRenderer& operator=(LiveRenderer&&) noexcept;
  ~LiveRenderer();

  /// Shows the asset otherwise; what that needs is uploaded. If that fails, all stays as it was.
  /// Lobe and dependence on the view cost next to nothing, other transfer about what make() costs.
  Status choose(const shade::Showing& showing);
  /// What mirrors and the background show, as it stands before worldFromEnvironment. Rotations of
  /// an image that was shown last, and up to 16 discs beside it, cost next to nothing: they can
  /// change every frame. A new image is uploaded with the next frame that shows it.
  Status setEnvironment(const light::Environment& environment);

  /// One light for the whole asset, in the asset's own frame: sh::rotate(assetFromWorld, …).
  void setLight(const sh::RgbCoefficients& assetLight);
  /// The Sun of setLight's light whose shadows are to be sharp (none: all of it is soft), in the
  /// asset's frame. The first one uploads what it needs; others cost next to nothing: it can move
  /// in every frame. A map of what it leaves dark is drawn with each. A light field knows none.
  Status setSun(const std::optional<shade::SharpSun>& sun);
  /// The air between a perspective camera and all that the asset shows (none: there is none), in
  /// the asset's frame; what others draw is not behind it. The first one, and the first one with or
  /// without shafts of light, makes programs; another table of as many nodes is uploaded, and the
  /// rest costs next to nothing. Without a Sun (setSun) there are no shafts.
  Status setAir(const std::optional<shade::Air>& air);
  /// Light that varies over the asset: `samples` sets of coefficients, [sample][coefficient][3]
  /// floats in a GL buffer that the caller (or capture on the GPU) fills, blended at each vertex by
  /// its weights. Sets setLight's light aside; `blending` is uploaded here, once, and the buffer is
  /// read anew after lightChanged() until there is another light. BadUsage where blending or buffer
  /// do not fit the asset.
  Status setLightField(const capture::Blending& blending, unsigned lightBuffer, int bands);
  /// The light buffer of setLightField has changed: M · L is due again.
  void lightChanged();

  /// Size of the frames, in pixels; due before the first. Another size begins a picture.
  Status resize(int width, int height);
  /// Begins a picture: forgets the samples that were added.
  void begin();
  /// Adds one frame to the picture, seen through `place` of every pixel, as
  /// scene::subpixelPositions (the middle: 0.5, 0.5). `samples`: how many there will be, which the
  /// filter of meso-structure wants to know. Relights first, if light or options have changed.
  Status add(const LiveView& view, const Vec2& place = Vec2(0.5f, 0.5f), int samples = 1);
  /// Other things of the world (lamps, occluders) can be drawn into the same frame after add() and
  /// before the next add(), show() or picture(): the framebuffer of the last add(), with linear
  /// radiance, coverage in alpha, and depth; and the projection that it was drawn with, jitter and
  /// LiveView::others included.
  unsigned framebuffer() const;
  Mat4 clipFromWorld() const;
  /// The mean of what was added, exposed and sRGB-coded, onto the whole of a framebuffer (0: the
  /// window) of that size. Equals tone::toneMap and sRGB coding to 1/255.
  Status show(unsigned framebuffer, float exposureEv, tone::Curve curve) const;
  /// The same mean, read back: linear radiance, coverage in alpha unless there is a background.
  /// As reference::relitPicture gives it.
  Result<image::Image> picture() const;

 private:
  struct Impl;
  explicit LiveRenderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lambent::render
