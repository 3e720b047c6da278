#include "figures/displaced.h"

#include <Eigen/LU>

#include "lambent/scene/shapes.h"
#include "lambent/work/parallel_for.h"

namespace lambent::figures {

namespace {

/// The patch's backing as geometry of one period, cut finely enough to bend.
scene::Mesh backingSheet(const meso::Patch& patch, float height, int material) {
  constexpr int kQuads = 8;
  scene::Mesh mesh = scene::gridPlane(patch.size.x(), patch.size.y(), kQuads, kQuads);
  for (Vec3& p : mesh.positions)  // from y = 0 with +y up to z = height with +z up, one period
    p = Vec3(p.x() + 0.5f * patch.size.x(), 0.5f * patch.size.y() - p.z(), height);
  for (Vec3& n : mesh.normals) n = Vec3(0, 0, 1);
  mesh.name = "backing", mesh.material = material;
  mesh.uvs.clear();
  return mesh;
}

}  // namespace

scene::Scene displaced(const meso::Patch& patch, const ParametricSurface& surface, int tilesU,
                       int tilesV) {
  scene::Scene tile = patch.scene;
  const meso::Extent extent = meso::extentOf(patch);
  if (patch.backing) {
    scene::Material material;
    material.name = "backing";
    material.diffuse = *patch.backing;
    const int index = static_cast<int>(tile.materials.size());
    tile.materials.push_back(material);
    tile.meshes.push_back(backingSheet(patch, extent.lowest - 1e-3f * extent.depth(), index));
  }
  // q: periods of the patch; z: metres of the patch above its middle.
  const auto carried = [&](double qx, double qy, double z) -> Vec3d {
    const SurfacePlace place = surface(qx / tilesU, -qy / tilesV);
    return place.position + place.normal * (z * place.scale);
  };
  scene::Scene out;
  out.materials = tile.materials, out.textures = tile.textures;
  for (const scene::Mesh& from : tile.meshes) {
    const std::size_t vertices = from.positions.size();
    scene::Mesh to;
    to.name = from.name, to.material = from.material;
    const std::size_t tiles = std::size_t(tilesU) * std::size_t(tilesV);
    to.positions.resize(tiles * vertices), to.normals.resize(tiles * vertices);
    to.triangles.reserve(tiles * from.triangles.size());
    for (std::size_t t = 0; t < tiles; ++t)
      for (const scene::Triangle& tri : from.triangles) {
        const auto base = static_cast<std::uint32_t>(t * vertices);
        to.triangles.push_back({tri[0] + base, tri[1] + base, tri[2] + base});
      }
    if (!from.colors.empty())
      for (std::size_t t = 0; t < tiles; ++t)
        to.colors.insert(to.colors.end(), from.colors.begin(), from.colors.end());
    if (!from.uvs.empty())
      for (std::size_t t = 0; t < tiles; ++t)
        to.uvs.insert(to.uvs.end(), from.uvs.begin(), from.uvs.end());
    work::parallelFor(tiles, [&](std::size_t t) {
      const double i = double(t % tilesU), j = double(t / tilesU) - tilesV;
      constexpr double kStep = 1e-5;  // periods
      for (std::size_t v = 0; v < vertices; ++v) {
        const Vec3& p = from.positions[v];
        const double qx = p.x() / patch.size.x() + i, qy = p.y() / patch.size.y() + j;
        const double z = double(p.z()) - extent.middle();
        const SurfacePlace place = surface(qx / tilesU, -qy / tilesV);
        to.positions[t * vertices + v] =
            (place.position + place.normal * (z * place.scale)).cast<float>();
        Mat3d jacobian;  // worldFromPatch, both in metres
        jacobian.col(0) = (carried(qx + kStep, qy, z) - carried(qx - kStep, qy, z)) /
                          (2 * kStep * patch.size.x());
        jacobian.col(1) = (carried(qx, qy + kStep, z) - carried(qx, qy - kStep, z)) /
                          (2 * kStep * patch.size.y());
        jacobian.col(2) = place.normal * place.scale;
        to.normals[t * vertices + v] =
            (jacobian.inverse().transpose() * from.normals[v].cast<double>())
                .normalized()
                .cast<float>();
      }
    });
    out.meshes.push_back(std::move(to));
  }
  return out;
}

}  // namespace lambent::figures
