// Meshes made by formula, which tests, figures and examples share, and the small operations that
// put a scene together from them. All are in metres, centred on the origin with +Y up, wound
// counter-clockwise from the front, with unit normals; those called closed have no boundary once
// vertices of equal position are taken as one.
#pragma once

#include <span>

#include "lambent/scene/scene.h"

namespace lambent::scene {

/// Latitude-longitude sphere with UVs (u once around, v from the north pole): closed, front
/// outside. slices ≥ 3 around, stacks ≥ 2 from pole to pole.
Mesh uvSphere(float radius, int slices, int stacks);

/// Icosahedron subdivided `subdivisions` times: 10·4ⁿ+2 evenly spread vertices, closed, no UVs.
Mesh icosphere(float radius, int subdivisions);

/// The patch of a sphere that covers `areaFraction` (0 … 1) of the sphere's area around its south
/// pole; its concave side is the front. UVs as uvSphere's, v running 0 … 1 from the pole to the
/// rim.
Mesh bowl(float radius, float areaFraction, int slices, int stacks);

/// A rectangle in the plane y = 0, front up: u along +x, v along +z, both 0 … 1 over the whole.
Mesh gridPlane(float sizeX, float sizeZ, int quadsX, int quadsZ);

/// A box, front outside: closed, flat-shaded, every face a grid of quads² with its own cell of a
/// 3×2 UV atlas (texel bakes find no overlap).
Mesh box(const Vec3& size, int quads = 1);

/// A box seen from within: closed, front inside.
Mesh room(const Vec3& size, int quads = 1);

/// A cylinder about +Y with flat caps: closed.
Mesh cylinder(float radius, float height, int segments, int rows = 1);

/// A torus about +Y: closed.
Mesh torus(float majorRadius, float minorRadius, int majorSegments, int minorSegments);

/// A finger ring about +Y: inner wall, outer wall, and the flat rims between them: closed. The
/// walls are smooth, so that a mirror ring throws a clean caustic.
Mesh ring(float innerRadius, float outerRadius, float height, int segments, int rows = 1);

/// Positions by the matrix, normals by its inverse transpose; a reflection turns the winding over
/// so that the front stays the front.
Mesh transformed(Mesh mesh, const Mat4& dstFromSrc);
Mesh transformed(Mesh mesh, const Eigen::Matrix4d& dstFromSrc);
Mesh translated(Mesh mesh, const Vec3& offset);
Mesh scaled(Mesh mesh, const Vec3& factors);
Mesh rotated(Mesh mesh, const Vec3& axis, float radians);
/// The back becomes the front.
Mesh flipped(Mesh mesh);

/// Drops vertices that no triangle uses. Returns the old index of every vertex that is left.
std::vector<std::uint32_t> dropUnusedVertices(Mesh& mesh);

/// One mesh of many, with the first one's name and material. UVs and colours are kept if every
/// part has them.
Mesh merge(std::span<const Mesh> parts);

/// A scene of one mesh.
Scene sceneOf(Mesh mesh, Material material = {});
/// Adds a mesh with a material of its own; returns the mesh's index.
std::uint32_t addTo(Scene& scene, Mesh mesh, Material material);

/// Sets normals: of every vertex, the mean of its triangles' normals weighted by their angle there,
/// which does not depend on how a flat polygon was cut; where they cancel (a folded sheet), its
/// largest triangle's. Vertices with the same entry in `groups` (one per vertex) share a normal;
/// without it each stands alone. Returns the number of vertices that no triangle of area gives a
/// normal to; they get +Y.
std::size_t computeNormals(Mesh& mesh, std::span<const std::uint32_t> groups = {});

/// Sets normals as computeNormals does, but smooth only across edges between two triangles whose
/// normals lie within `angle` (radians) of each other: with 0 every facet is flat. Vertices are
/// split where they need several normals; the first keeps its number and others are appended.
/// Positions that are equal are one place, whatever their UVs. Returns as computeNormals.
std::size_t creaseNormals(Mesh& mesh, float angle);

}  // namespace lambent::scene
