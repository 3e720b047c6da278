// An asset on the GPU: geometry, transfer or what is left of it, exit radiance and lobes at the
// receivers, textures, and the programs that draw them.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/render/batches.h"
#include "lambent/render/gl_environment.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/gl_patches.h"
#include "lambent/render/gl_view.h"
#include "lambent/render/transfer_on_gpu.h"
#include "lambent/shade/transfer_choice.h"

namespace lambent::render {

struct GlSceneOptions {
  std::size_t largestBlock = 0;  ///< bytes of one storage buffer
  int largestTexture = 0;        ///< side, in texels
  shade::TransferChoice transfer = shade::TransferChoice::Best;
  std::optional<float> lobeExponent;
  shade::BiScaleOptions biScale;
};

class GlScene {
 public:
  /// Uploads everything, to be relit again and again. `asset` must outlive the scene, fit together
  /// (shade::checkPicture), and hold what options.biScale asks for.
  static Result<GlScene> make(const asset::Asset& asset, const GlSceneOptions& options);
  /// Lit once: transfer streams through the GPU and leaves no trace there but radiance.
  static Result<GlScene> makeLit(const asset::Asset& asset, const sh::RgbCoefficients& light,
                                 const GlSceneOptions& options);

  // Of what make() made:
  /// Another choice of transfer, lobe, macro transport, filter, or dependence on the view. Uploads
  /// what it needs; if that fails, all stays as it was. Then relight() is due.
  Status choose(shade::TransferChoice transfer, std::optional<float> lobeExponent,
                const shade::BiScaleOptions& biScale);
  void setLight(const sh::RgbCoefficients& light) { transfer_.setLight(light); }
  /// As LiveRenderer::setLightField.
  Status setLightField(const capture::Blending& blending, GLuint lights, int bands);
  /// M · L of every receiver: GL commands alone, one dispatch for each chunk of transfer.
  Status relight();

  bool hasMirrors() const { return hasMirrors_; }
  /// Draws all surfaces into the bound framebuffer: radiance, and 1 in alpha. Mirrors show
  /// `environment`.
  void draw(const GlView& view, const GlEnvironment& environment) const;

 private:
  /// As in surface.frag.glsl.
  enum class SurfaceKind { Vertices = 0, Texels = 1, Mirror = 2, Black = 3 };
  struct Geometry {
    Buffer vertices, corners, normals;
    int cornerCount = 0;
  };
  struct Lit {
    std::uint32_t mesh = 0;
    Relit diffuse, lobe;
  };
  struct Draw {
    std::uint32_t mesh = 0;
    SurfaceKind kind = SurfaceKind::Black;
    std::size_t geometry = 0;
    std::optional<std::size_t> lit;
    RowBand rows;
  };

  GlScene(const asset::Asset& asset, const GlSceneOptions& options,
          TransferOnGpu::Residence residence)
      : asset_(&asset),
        options_(options),
        keeps_(residence == TransferOnGpu::Residence::Keep),
        transfer_(options.largestBlock, residence),
        patches_(asset, {options.largestBlock, options.largestTexture, options.biScale}) {}
  Status addAll();
  Status addMesh(std::uint32_t mesh, const encode::EncodedMesh& shown,
                 std::optional<shade::MacroTransport> macro);
  Status addTexture(int texture);
  Status addProgram(SurfaceKind kind, int lobeBands);
  Result<Lit> makeLit(std::uint32_t mesh, const encode::EncodedMesh& shown,
                      const std::vector<std::uint32_t>& receivers, std::optional<float> lobe);
  shade::ShownTransfer shownTransfer(std::uint32_t mesh, shade::TransferChoice transfer,
                                     std::optional<shade::MacroTransport>& macro) const;
  Status retransfer(shade::TransferChoice transfer, std::optional<float> lobe,
                    std::optional<shade::MacroTransport> macro);
  void drawUnlit(const GlView& view) const;
  const scene::Material& materialOf(std::uint32_t mesh) const {
    return asset_->scene.materials[asset_->scene.meshes[mesh].material];
  }
  bool isPatched(std::uint32_t mesh) const {
    return asset_->transfer.meshes[mesh].biScale && !materialOf(mesh).isMirror();
  }
  int textureOf(std::uint32_t mesh) const;
  void bindTexture(const Program& program, std::uint32_t mesh) const;
  int lobeBandsOf(std::uint32_t mesh) const;
  template <class Each>
  void forEachRelit(Each each);

  const asset::Asset* asset_;
  GlSceneOptions options_;
  bool keeps_;
  TransferOnGpu transfer_;
  GlPatches patches_;
  std::vector<Geometry> geometries_;
  std::vector<Lit> lit_;
  std::vector<Draw> draws_;
  std::map<int, Texture> textures_;                          ///< by index into the scene's
  std::map<std::pair<SurfaceKind, int>, Program> programs_;  ///< … and bands of the lobe, or 0
  Program unlit_;
  Buffer srgbTable_;
  VertexArray noAttributes_;
  bool hasMirrors_ = false;
};

}  // namespace lambent::render
