// Meshes with meso-structure on the GPU: radiance transfer textures, id maps, the light that
// arrives at every vertex, and the programs that bring them together.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/gl_view.h"
#include "lambent/render/light_on_gpu.h"
#include "lambent/shade/bi_scale_options.h"

namespace lambent::render {

/// What shaders/rtt_footprint.glsl wants before it.
std::string footprintDefines();

struct GlPatchOptions {
  std::size_t largestBlock = 0;  ///< bytes of one storage buffer
  int largestTexture = 0;        ///< side, in texels
  shade::BiScaleOptions biScale;
};

class GlPatches {
 public:
  /// `asset` must outlive it, and have passed shade::checkBiScale.
  GlPatches(const asset::Asset& asset, const GlPatchOptions& options)
      : asset_(&asset), options_(options) {}

  /// Uploads a mesh with meso-structure and all that it needs, and lights it.
  Status add(std::uint32_t mesh, TransferOnGpu& transfer);
  /// Draws them into the bound framebuffer: radiance, and 1 in alpha. A vertex array must be bound;
  /// its element buffer is changed.
  void draw(const GlView& view, GLuint vertexArray) const;

 private:
  struct Level {
    int width, height, first;  ///< positions; the first one's place among all
  };
  /// A radiance transfer texture and its pyramid as one buffer texture.
  struct Rtt {
    Buffer numbers;
    Texture texture;
    std::vector<Level> levels;
    std::vector<float> scales;  ///< of its coefficients: what the light is multiplied with
  };
  using ProgramKey = std::tuple<int, encode::Encoding>;  ///< bands, encoding
  struct Draw {
    std::uint32_t mesh = 0;
    Buffer vertices, light, triangles, corners;
    int cornerCount = 0;
  };

  Status addRtt(int index);
  Status addIdMap(std::uint32_t mesh);
  Status addProgram(int bands, encode::Encoding encoding);
  const encode::EncodedBiScale& biScaleOf(std::uint32_t mesh) const {
    return *asset_->transfer.meshes[mesh].biScale;
  }
  const encode::EncodedRtt& rttOf(std::uint32_t mesh) const {
    return asset_->transfer.rtts[std::size_t(biScaleOf(mesh).rtt)];
  }

  const asset::Asset* asset_;
  GlPatchOptions options_;
  std::map<int, Rtt> rtts_;                  ///< by index into the asset's
  std::map<std::uint32_t, Texture> idMaps_;  ///< by mesh
  std::map<ProgramKey, Program> programs_;
  std::vector<Draw> draws_;
};

}  // namespace lambent::render
