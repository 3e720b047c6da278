// An asset on the GPU, whatever its meshes carry: one sibling for each kind of transfer, relit and
// drawn together.
#pragma once

#include <memory>

#include "lambent/asset/asset.h"
#include "lambent/render/gl_air.h"
#include "lambent/render/gl_base_colors.h"
#include "lambent/render/gl_environment.h"
#include "lambent/render/gl_mirrors.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/gl_patches.h"
#include "lambent/render/gl_sun_map.h"
#include "lambent/render/gl_surfaces.h"
#include "lambent/render/gl_target.h"
#include "lambent/render/gl_view.h"
#include "lambent/render/transfer_on_gpu.h"
#include "lambent/shade/showing.h"

namespace lambent::render {

/// Bytes of one storage buffer, where GL takes as many.
inline constexpr std::size_t kLargestBlock = std::size_t(128) << 20;

struct GlSceneOptions {
  std::size_t largestBlock = 0;  ///< bytes of one storage buffer
  int largestTexture = 0;        ///< side, in texels
  int mirrorSide = 512;          ///< texels along the edge of a face of what mirrors show
  shade::Showing showing;
  std::optional<sh::RgbCoefficients> sunShare;  ///< of makeLit's light, of a sharp Sun
  std::optional<shade::Air> air;                ///< before all of makeLit()'s
};

class GlScene {
 public:
  /// Uploads everything, to be relit again and again. `asset` must outlive the scene, and have
  /// passed shade::checkPicture.
  static Result<GlScene> make(const asset::Asset& asset, const GlSceneOptions& options);
  /// Lit once: transfer streams through the GPU and leaves no trace there but radiance.
  static Result<GlScene> makeLit(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                 const GlSceneOptions& options);

  // Of what make() made:
  /// Shows it otherwise. Uploads what it needs; if that fails, all stays as it was. Then relight()
  /// is due.
  Status choose(const shade::Showing& showing);
  void setLight(const sh::RgbCoefficients& light) { transfer_.setLight(light); }
  /// What a sharp Sun is of the light that is set (none: there is no such). The first one uploads
  /// what it needs; if that fails, all stays as it was. Then relight() is due.
  Status setSunShare(const std::optional<sh::RgbCoefficients>& share);
  /// The air before all of it (none: there is none). If making what it needs fails, all stays as it
  /// was.
  Status setAir(const std::optional<shade::Air>& air);
  /// What a frame of it is to be added up with: its air is looked through there.
  GlTarget::Around around() const { return {nullptr, air_.get(), sunMap_ ? &*sunMap_ : nullptr}; }
  /// As LiveRenderer::setLightField.
  Status setLightField(const capture::Blending& blending, GLuint lights, int bands);
  /// M · L of every receiver: GL commands alone, one dispatch for each chunk of transfer.
  Status relight();

  bool hasMirrors() const { return surfaces_.hasMirrors(); }
  /// What lights mirrors, beside the light that is set.
  struct Surroundings {
    const GlEnvironment& environment;
    Mat3 environmentFromWorld = Mat3::Identity();
    std::optional<light::Sun> sun = {};  ///< whose shadows are sharp
    int veilSamples = 4;  ///< sub-samples of what mirrors show, where there are veils
  };
  /// Draws what mirrors show of the asset, if anything of it has changed since it was drawn, and
  /// binds other framebuffers for that: before mapSun(). The first time it makes what it needs.
  Status captureMirrors(const Surroundings& surroundings);
  /// The environment is another.
  void environmentChanged() { environmentStale_ = true; }
  /// Draws what hides view.sun, if there is one, and binds another framebuffer for that: before the
  /// frame that is drawn so.
  Status mapSun(const GlView& view);
  /// Draws all surfaces into the bound framebuffer: as GlSurfaces::draw. Mirrors show what was
  /// captured and, where that is nothing, `environment`.
  void draw(const GlView& view, const GlEnvironment& environment) const;

 private:
  GlScene(const asset::Asset& asset, const GlSceneOptions& options,
          TransferOnGpu::Residence residence, std::shared_ptr<GlAir> air)
      : asset_(&asset),
        options_(options),
        transfer_(options.largestBlock, residence),
        colors_(asset.scene),
        surfaces_(asset, options.largestBlock, air),
        patches_(asset, {options.largestBlock, options.largestTexture}, options.showing),
        bounds_(scene::bounds(asset.scene)),
        air_(std::move(air)) {}
  Status addAll();
  Status retransfer(const shade::Showing& showing);
  void drawUnlit(const GlView& view) const;
  /// As mapSun(): of what is seen through `clipFromWorld`, or of the whole asset (null).
  Status mapSun(const light::SunPoint& sun, const Mat4* clipFromWorld, int sample);
  bool isPatched(std::uint32_t mesh) const;
  template <class Each>
  void forEachRelit(Each each) {
    surfaces_.forEach(each);
    patches_.forEach(each);
  }

  const asset::Asset* asset_;
  GlSceneOptions options_;
  TransferOnGpu transfer_;
  GlBaseColors colors_;
  GlSurfaces surfaces_;
  GlPatches patches_;
  scene::Box bounds_;
  std::shared_ptr<GlAir> air_;
  std::optional<GlSunMap> sunMap_;  ///< made for the first sharp Sun
  bool sharpSun_ = false;
  std::optional<GlMirrors> mirrors_;  ///< made for the first frame, if there is any to be shown
  bool mirrorsStale_ = true, environmentStale_ = true;
  Mat3 environmentInMirrors_ = Mat3::Identity();  ///< environmentFromWorld, as it was captured
  Program unlit_;
  VertexArray noAttributes_;
};

}  // namespace lambent::render
