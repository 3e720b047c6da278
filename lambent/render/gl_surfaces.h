// Bare surfaces and mirrors on the GPU: geometry, exit radiance and lobes at the receivers, and the
// programs that draw them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/render/batches.h"
#include "lambent/render/gl_air.h"
#include "lambent/render/gl_base_colors.h"
#include "lambent/render/gl_environment.h"
#include "lambent/render/gl_mirrors.h"
#include "lambent/render/gl_objects.h"
#include "lambent/render/gl_sun_map.h"
#include "lambent/render/gl_view.h"
#include "lambent/render/transfer_on_gpu.h"
#include "lambent/shade/lobe.h"
#include "lambent/shade/showing.h"

namespace lambent::render {

class GlSurfaces {
 public:
  /// `asset` must outlive it, and fit together (asset::faultOf).
  /// `air`: before what mirrors show; null for none.
  GlSurfaces(const asset::Asset& asset, std::size_t largestBlock, std::shared_ptr<const GlAir> air)
      : asset_(&asset),
        passings_(scene::passingsOf(asset.scene)),
        largestBlock_(largestBlock),
        air_(std::move(air)) {}

  /// Uploads a mesh without meso-structure, lit as `showing` says.
  Status add(std::uint32_t mesh, const shade::Showing& showing, TransferOnGpu& transfer);

  /// What a piece of a mesh sends out.
  struct Lit {
    std::uint32_t mesh = 0;
    Relit diffuse, lobe;
    shade::LobeGain gain;  ///< of what `lobe` shows
    Relit sunShare;        ///< what is to be taken out of `diffuse` under a sharp Sun, if anything
  };
  /// The light of all pieces under other transfer, to be given to setLight.
  Result<std::vector<Lit>> lightUnder(const shade::Showing& showing, TransferOnGpu& transfer) const;
  /// Other air; null for none. Makes programs where there was none before; if that fails, all stays
  /// as it was.
  Status setAir(std::shared_ptr<const GlAir> air);
  /// Whether what is lit from now on is lit by a sharp Sun, whose own light the caller draws.
  void setSharpSun(bool sharp) { sharpSun_ = sharp; }
  void setLight(std::vector<Lit> light);
  /// Other lobes for what is lit.
  void setLobe(const shade::Showing& showing);
  /// Calls each(mesh, relit) for everything that a new light changes.
  template <class Each>
  void forEach(Each each) {
    for (Lit& lit : lit_)
      for (Relit* relit : {&lit.diffuse, &lit.lobe, &lit.sunShare})
        if (relit->product.name()) each(lit.mesh, *relit);
  }

  bool hasMirrors() const { return hasMirrors_; }
  /// What surfaces show, and are lit by, beside what came of transfer.
  struct Around {
    const GlEnvironment& environment;    ///< in mirrors
    const GlMirrors* mirrors = nullptr;  ///< what else they show; null: nothing
    const GlSunMap* sunMap = nullptr;    ///< where view.sun is hidden; null: nowhere
  };
  /// Draws them into the bound framebuffer: radiance, and in alpha what sample_alpha.glsl says. A
  /// vertex array must be bound; its element buffer is changed.
  void draw(const GlView& view, const Around& around, const GlBaseColors& colors,
            const shade::Showing& showing, GLuint vertexArray) const;
  /// Calls drawPiece(mesh, vertices, corners, count) for every piece, as GlPatches::drawUnlit.
  /// Where a mesh has backs, back faces are culled meanwhile.
  template <class DrawUnlit>
  void drawUnlit(DrawUnlit drawPiece) const {
    for (const Draw& draw : draws_) {
      if (draw.rows.begin > 0) continue;  // the first band of texels draws the whole of the piece
      const Geometry& geometry = geometries_[draw.geometry];
      cullBacks(geometry.backs);
      drawPiece(draw.mesh, geometry.vertices.name(), geometry.corners.name(), geometry.cornerCount);
    }
    cullBacks(false);
  }

 private:
  static void cullBacks(bool cull);

  /// As in surface.frag.glsl.
  enum class SurfaceKind { Vertices = 0, Texels = 1, Mirror = 2, Black = 3 };
  struct Geometry {
    Buffer vertices, corners, normals;
    Buffer texelUvs;  ///< of vertices, if receivers are texels
    int cornerCount = 0;
    bool backs = false;  ///< of triangles: only what faces the eye is to be drawn
  };
  struct Draw {
    std::uint32_t mesh = 0;
    SurfaceKind kind = SurfaceKind::Black;
    std::size_t geometry = 0;
    std::optional<std::size_t> lit;
    RowBand rows;
  };
  using Response = transfer::SurfaceResponse<transfer::Numbers>;

  Result<Lit> lightOf(std::uint32_t mesh, const shade::Showing& showing, const Response& response,
                      const std::vector<std::uint32_t>& receivers, TransferOnGpu& transfer) const;
  void setGain(Lit& lit, const shade::Showing& showing) const;
  Status addTexels(std::uint32_t mesh, const transfer::AtTexels& grid, const Response& response,
                   std::size_t perReceiver, const shade::Showing& showing, TransferOnGpu& transfer,
                   std::vector<std::pair<RowBand, std::size_t>>& litRows);
  const scene::Material& materialOf(std::uint32_t mesh) const {
    return asset_->scene.materials[asset_->scene.meshes[mesh].material];
  }
  /// Null for a mirror.
  const transfer::Surface<transfer::Numbers>* surfaceOf(std::uint32_t mesh) const {
    return std::get_if<transfer::Surface<transfer::Numbers>>(&asset_->transfer.meshes[mesh]);
  }
  /// The parts that a mesh has, whatever is shown; null for a mirror.
  const Response* partsOf(std::uint32_t mesh) const;
  int lobeBandsOf(std::uint32_t mesh) const;

  const asset::Asset* asset_;
  std::vector<scene::Passing> passings_;
  std::size_t largestBlock_;  ///< bytes of one storage buffer
  std::shared_ptr<const GlAir> air_;
  std::vector<Geometry> geometries_;
  std::vector<Lit> lit_;
  std::vector<Draw> draws_;
  /// What a program is made for.
  struct Shape {
    SurfaceKind kind;
    int lobeBands;  ///< or 0
    bool gaps;      ///< it may be there in parts alone
    auto operator<=>(const Shape&) const = default;
  };
  Status addProgram(const Shape& shape);
  Shape shapeOf(std::uint32_t mesh, SurfaceKind kind) const {
    return {kind, lobeBandsOf(mesh), passings_[mesh] != scene::Passing::Nothing};
  }
  std::map<Shape, Program> programs_;
  bool hasMirrors_ = false, sharpSun_ = false;
};

}  // namespace lambent::render
