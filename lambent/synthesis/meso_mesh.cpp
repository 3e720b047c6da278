// This work is based on:
// - sloan2003biscale (§4.3): texture is synthesised on a mesh of about 960,000 vertices.
// - turk2001texture (§4): vertices spread evenly in nested levels, each four times as dense as the
//   one before; the levels are what synthesis refines over.
//
// Where we deviate: Turk repels points from each other until they are even, and triangulates them.
// Poisson-disk sampling is as even for the purpose and takes seconds (surface_samples.cpp); nothing
// here needs triangles, only neighbours.
#include "lambent/synthesis/meso_mesh.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Geometry>

#include "lambent/synthesis/frames.h"
#include "lambent/synthesis/manifold.h"
#include "lambent/synthesis/meso_neighbours.h"
#include "lambent/synthesis/surface_samples.h"
#include "lambent/work/parallel_for.h"

namespace lambent::synthesis {
namespace {

std::vector<Vec3> faceNormals(const scene::Mesh& mesh) {
  std::vector<Vec3> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3d p = mesh.positions[a].cast<double>();
    const Vec3d cross =
        (mesh.positions[b].cast<double>() - p).cross(mesh.positions[c].cast<double>() - p);
    const double length = cross.norm();
    normals[t] = length > 0.0 ? Vec3((cross / length).cast<float>()) : Vec3(Vec3::UnitY());
  }
  return normals;
}

}  // namespace

float MesoMesh::spacing(std::size_t level) const {
  assert(level < levelEnd.size() && levelEnd[level] > 0);
  return std::sqrt(2.0f / std::sqrt(3.0f) * area / float(levelEnd[level]));
}

Result<MesoMesh> mesoMesh(const scene::Mesh& mesh, const TangentField& field,
                          const MesoMeshOptions& options, const Progress& progress) {
  assert(field.tangents.size() == mesh.positions.size());
  if (options.vertices == 0 || options.vertices > 100'000'000u) {
    return report::badUsage("a meso-mesh has from 1 to 100,000,000 vertices");
  }
  if (options.neighbours < 3 || options.neighbours > 64) {
    return report::badUsage("meso-vertices have from 3 to 64 neighbours");
  }
  const std::uint32_t coarsest = std::max(options.coarsest, 1u);
  int levels = 1;
  for (double n = options.vertices; n >= 2.0 * coarsest; n /= 4.0) ++levels;

  const Manifold manifold = manifoldOf(mesh);
  const std::vector<Vec3> faces = faceNormals(mesh);
  Result<SurfaceSamples> spread =
      spreadOver(mesh, manifold, faces, options.vertices, levels, options.seed, progress);
  if (!spread) return spread.error();

  const std::vector<Vec3> normals = normalsOf(mesh);

  MesoMesh meso;
  meso.area = float(spread->area);
  meso.levelEnd = spread->levelEnd;
  const std::size_t count = spread->samples.size();
  meso.positions.resize(count), meso.normals.resize(count), meso.tangents.resize(count);
  work::parallelFor(count, [&](std::size_t i) {
    const SurfaceSample& s = spread->samples[i];
    const scene::Triangle& corners = mesh.triangles[s.triangle];
    const float weights[3] = {1.0f - s.u - s.v, s.u, s.v};
    Vec3 normal = Vec3::Zero();
    for (int k = 0; k < 3; ++k) normal += weights[k] * normals[corners[std::size_t(k)]];
    normal = normal.norm() > 1e-3f ? Vec3(normal.normalized()) : faces[s.triangle];
    // Around a singularity the corners' tangents may cancel; then the nearest corner's decides.
    Vec3 tangent = Vec3::Zero(), nearest = Vec3::Zero();
    float most = -1.0f;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = corners[std::size_t(k)];
      const Vec3 turned = turnedInto(field.tangents[v], normals[v], normal);
      tangent += weights[k] * turned;
      if (weights[k] > most) most = weights[k], nearest = turned;
    }
    meso.positions[i] = s.position;
    meso.normals[i] = normal;
    meso.tangents[i] = tangent.norm() > 1e-3f ? Vec3(tangent.normalized()) : nearest;
  });
  for (std::size_t k = 0; k < meso.levelEnd.size(); ++k) {
    if (progress && !progress({"neighbours", k, meso.levelEnd.size(), "levels"})) {
      return report::cancelled();
    }
    meso.levels.push_back(neighboursOf(mesh, manifold, faces,
                                       std::span(spread->samples).first(meso.levelEnd[k]),
                                       options.neighbours));
  }
  return meso;
}

}  // namespace lambent::synthesis
