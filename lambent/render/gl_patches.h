// Meshes with meso-structure on the GPU: radiance transfer textures, id maps, the light that
// arrives at every vertex, and the programs that bring them together.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/render/gl_base_colors.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/gl_view.h"
#include "lambent/render/transfer_on_gpu.h"
#include "lambent/scene/coverage.h"
#include "lambent/shade/showing.h"

namespace lambent::render {

struct GlPatchOptions {
  std::size_t largestBlock = 0;  ///< bytes of one storage buffer
  int largestTexture = 0;        ///< side, in texels
};

class GlPatches {
 public:
  /// `asset` must outlive it, and fit together (asset::faultOf).
  GlPatches(const asset::Asset& asset, const GlPatchOptions& options, const shade::Showing& showing)
      : asset_(&asset),
        passings_(scene::passingsOf(asset.scene)),
        options_(options),
        showing_(showing) {}

  /// Uploads a mesh with meso-structure and all that it needs. Meshes are to be added in sequence.
  Status add(std::uint32_t mesh, TransferOnGpu& transfer);
  /// Filter and dependence on the view, which need no other transfer.
  Status choose(const shade::Showing& showing);

  /// The light of all pieces under other transfer, to be given to setLight.
  Result<std::vector<Relit>> lightUnder(const shade::Showing& showing,
                                        TransferOnGpu& transfer) const;
  void setLight(std::vector<Relit> light);
  /// Calls each(mesh, relit) for every piece.
  template <class Each>
  void forEach(Each each) {
    for (Draw& draw : draws_) each(draw.mesh, draw.light);
  }

  /// Draws them into the bound framebuffer: as GlSurfaces::draw, and before that, so that layers
  /// are seen and not what they lie on, which is as deep. A vertex array must be bound;
  /// its element buffer is changed.
  void draw(const GlView& view, const GlBaseColors& colors, GLuint vertexArray) const;
  /// Calls draw(mesh, vertices, corners, count) for every piece: vertices hold positions and
  /// texture coordinates where unlit.vert.glsl seeks them.
  template <class DrawUnlit>
  void drawUnlit(DrawUnlit drawPiece) const {
    for (const Draw& draw : draws_)
      drawPiece(draw.mesh, draw.vertices.name(), draw.corners.name(), draw.cornerCount);
  }

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
    Buffer heightBytes;
    Texture heights;             ///< of all levels; none: views are not corrected
    Vec2 relief = Vec2::Zero();  ///< as shade::RttPyramid
  };
  /// What a program is made for.
  struct Shape {
    int bands;
    transfer::Encoding encoding;
    bool filter, relief;  ///< … and whether views are corrected
    bool gaps;            ///< it may be there in parts alone
    auto operator<=>(const Shape&) const = default;
  };
  struct Draw {
    std::uint32_t mesh = 0;
    Buffer vertices, triangles, corners;
    Buffer tints;  ///< colours of the vertices; none: white
    Relit light;
    int cornerCount = 0;
  };

  Result<Rtt> makeRtt(int index, bool filter) const;
  Status addIdMap(std::uint32_t mesh);
  Shape shapeOf(std::uint32_t mesh, bool relief, bool filter) const {
    const transfer::EncodedRtt& rtt = rttOf(mesh);
    return {rtt.bands, rtt.values.encoding, filter, relief,
            passings_[mesh] != scene::Passing::Nothing};
  }
  Status addProgram(const Shape& shape);
  const transfer::BiScale<transfer::Numbers>& biScaleOf(std::uint32_t mesh) const {
    return std::get<transfer::BiScale<transfer::Numbers>>(asset_->transfer.meshes[mesh]);
  }
  const transfer::EncodedRtt& rttOf(std::uint32_t mesh) const {
    return asset_->transfer.rtts[std::size_t(biScaleOf(mesh).patch.rtt)];
  }

  const asset::Asset* asset_;
  std::vector<scene::Passing> passings_;
  GlPatchOptions options_;
  shade::Showing showing_;
  std::map<int, Rtt> rtts_;                  ///< by index into the asset's
  std::map<std::uint32_t, Texture> idMaps_;  ///< by mesh
  std::map<Shape, Program> programs_;
  std::vector<Draw> draws_;  ///< layers first, the uppermost before the others
};

}  // namespace lambent::render
