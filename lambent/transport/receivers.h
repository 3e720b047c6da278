// Where transfer is recorded: the vertices of a mesh, or the texels of a grid over its UVs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::transport {

/// A texel outside of all charts, y·width + x, and the place beyond a chart's border that it shows.
struct TexelBeyond {
  std::uint32_t texel = 0;
  scene::SurfacePoint point;
};

/// A mesh whose receivers are to be texels of a width×height grid over its texel UVs.
struct TexelGrid {
  std::uint32_t mesh = 0;
  int width = 256, height = 256;
  /// Where the surface goes on beyond a chart's border, texels beside it may show it: light that is
  /// interpolated along the border then comes out the same on both sides. Those that are not named
  /// here copy the nearest that shows something.
  std::vector<TexelBeyond> beyond = {};
};

/// A mesh that carries meso-structure: its receivers are its vertices, and what they record is the
/// light that arrives there, as matrices in their tangent frames (transfer::BiScale).
struct LocalFrames {
  std::uint32_t mesh = 0;
  std::vector<Vec3> tangents;  ///< one per vertex: world space, unit, at right angles to the normal
};

/// Where the receivers of a scene are to stand: at the vertices of meshes that are not named here.
struct Placement {
  std::vector<TexelGrid> texels;
  std::vector<LocalFrames> local;  ///< meshes whose transfer is local
};

/// What a mesh's receivers stand on. Mirrors have none.
enum class Layout { None, Vertices, Texels };

/// All receivers of a scene, numbered through; mirrors have none.
struct PlacedReceivers {
  std::vector<Vec3> positions, normals;  ///< world space, unit normals
  std::vector<Vec3> origins;             ///< where rays start: off the surface, away from its edges
  std::vector<Rgb> diffuse, glossy;      ///< reflectances with the base colour applied
  std::vector<float> exponents;

  struct PerMesh {
    Layout layout = Layout::None;
    std::uint32_t first = 0, count = 0;  ///< its receivers are first … first + count − 1
    int width = 0, height = 0;           ///< Texels
    /// Texels: for every texel the receiver that speaks for it (the nearest covered one).
    std::vector<std::uint32_t> receiverOfTexel;
    std::vector<std::uint8_t> covered;  ///< Texels: whether the texel's centre lies on the surface
    bool isDiffuse = false, isGlossy = false;
    /// Whether a texture colours it, whose detail receivers are too few to hold: light that it
    /// sends on takes the base colour where a ray strikes, not the receivers'.
    bool textured = false;
    /// Bi-scale: a matrix records what arrives. What it sends on to others is diffuse, with the
    /// material's albedo: at the macro-scale the meso-structure is a matt surface.
    std::optional<LocalFrames> local;
  };
  std::vector<PerMesh> meshes;
  /// Receivers behind those of the meshes: the mesh on which each stands. They are simulated and
  /// not stored, for others to be set by (mend_buried.h).
  std::vector<std::uint32_t> witnesses;

  std::size_t size() const { return positions.size(); }
  /// Adds a witness on a mesh, whose rays start at `origin`; its number. No mesh's receivers may be
  /// added after it.
  std::uint32_t addWitness(std::uint32_t mesh, const scene::SurfacePoint& point,
                           const Vec3& origin);
};

/// BadInput where texels are asked for and the UVs are missing, outside the unit square, or
/// overlap; BadUsage where the placement does not fit the scene.
/// `offset`: how far origins are lifted off, trace::RayScene::offset().
Result<PlacedReceivers> placeReceivers(const scene::Scene& scene, const Placement& placement,
                                       float offset);

/// All receivers along a Morton curve through their bounding box. Rays from neighbours walk the
/// same part of the acceleration structure: a scan with its vertices in any sequence is baked as
/// fast as a well-ordered one.
std::vector<std::uint32_t> spatialOrder(const PlacedReceivers& receivers);

/// The receivers between which a point of a surface is interpolated: the corners of its triangle,
/// or the four texels around it. Weights sum to 1; texels may share a receiver, which then comes
/// twice.
struct ReceiversAround {
  std::array<std::uint32_t, 4> receiver{};
  std::array<float, 4> weight{};
  std::size_t count = 0;
};
/// Its mesh must have receivers.
ReceiversAround receiversAround(const scene::Scene& scene, const PlacedReceivers& receivers,
                                std::uint32_t mesh, std::uint32_t triangle, float u, float v);

/// The receiver that stands for a point of a surface: one of the corners of its triangle (or of
/// the four texels around it), drawn in proportion to the weights of linear interpolation. An
/// average over many points converges to the interpolated value, with one look-up a point.
/// u1 and u2 in [0, 1). Its mesh must have receivers.
std::uint32_t drawReceiver(const scene::Scene& scene, const PlacedReceivers& receivers,
                           std::uint32_t mesh, std::uint32_t triangle, float u, float v, float u1,
                           float u2);

}  // namespace lambent::transport
