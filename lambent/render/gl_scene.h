// An asset on the GPU, already lit: geometry, exit radiance and lobes at the receivers, textures,
// and the programs that draw them.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/light/environment.h"
#include "lambent/render/batches.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/gl_patches.h"
#include "lambent/render/gl_view.h"
#include "lambent/render/light_on_gpu.h"

namespace lambent::render {

struct GlSceneOptions {
  std::size_t largestBlock = 0;  ///< bytes of one storage buffer
  int largestTexture = 0;        ///< side, in texels
  std::optional<float> lobeExponent;
  shade::BiScaleOptions biScale;
};

class GlScene {
 public:
  /// Uploads and lights everything. `asset` must outlive the scene.
  static Result<GlScene> make(const asset::Asset& asset, const sh::RgbCoefficients& light,
                              const light::Environment& environment, const GlSceneOptions& options);

  /// Draws all surfaces into the bound framebuffer: radiance, and 1 in alpha.
  void draw(const GlView& view) const;

 private:
  struct Geometry {
    Buffer vertices, corners;
    int cornerCount = 0;
  };
  struct Lit {
    Buffer diffuse, lobe;
  };
  struct Draw {
    std::uint32_t mesh = 0;
    std::size_t geometry = 0;
    std::optional<std::size_t> lit;
    RowBand rows;
  };

  GlScene(const asset::Asset& asset, const GlSceneOptions& options)
      : asset_(&asset),
        patches_(asset, {options.largestBlock, options.largestTexture, options.biScale}) {}
  Status addMesh(std::uint32_t mesh, TransferOnGpu& transfer, const GlSceneOptions& options);
  Status addTexture(int texture, const GlSceneOptions& options);
  Status addProgram(int lobeBands);
  Result<std::size_t> addLit(const encode::EncodedMesh& mesh,
                             const std::vector<std::uint32_t>& receivers, TransferOnGpu& transfer,
                             const GlSceneOptions& options);
  Status addEnvironment(const light::Environment& environment, const GlSceneOptions& options);
  const scene::Material& materialOf(std::uint32_t mesh) const {
    return asset_->scene.materials[asset_->scene.meshes[mesh].material];
  }
  int textureOf(std::uint32_t mesh) const;
  int lobeBandsOf(std::uint32_t mesh) const;

  const asset::Asset* asset_;
  GlPatches patches_;
  std::vector<Geometry> geometries_;
  std::vector<Lit> lit_;
  std::vector<Draw> draws_;
  std::map<int, Texture> textures_;  ///< by index into the scene's
  std::map<int, Program> programs_;  ///< by bands of the lobe, 0: not glossy
  Texture environment_;
  Buffer srgbTable_;
  VertexArray noAttributes_;
};

}  // namespace lambent::render
