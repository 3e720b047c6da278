// Bakes for tests.
#pragma once

#include <gtest/gtest.h>

#include "lambent/macro/bake.h"
#include "lambent/scene/shapes.h"

namespace lambent::macro {

using transfer::Kind;
using transfer::SimulatedField;
using transport::Layout;
using transport::LocalFrames;
using transport::Placement;

inline scene::Material painted(const Rgb& diffuse, const Rgb& glossy = Rgb::Zero()) {
  scene::Material material;
  material.diffuse = diffuse;
  material.glossy = glossy;
  return material;
}

/// A red wall, a glossy ball and a mirror over a floor: every kind of surface in one scene.
inline scene::Scene mixedScene() {
  scene::Scene scene;
  scene::Material mirror;
  mirror.mirror = Rgb(0.9f, 0.8f, 0.7f);
  scene::addTo(scene, scene::gridPlane(4, 4, 12, 12), painted(Rgb::Constant(0.7f)));
  scene::addTo(scene, scene::translated(scene::box(Vec3(0.2f, 2, 4), 6), Vec3(-1.9f, 1, 0)),
               painted(Rgb(0.8f, 0.1f, 0.1f)));
  scene::addTo(scene, scene::translated(scene::icosphere(0.5f, 2), Vec3(0, 0.6f, 0)),
               painted(Rgb::Constant(0.2f), Rgb::Constant(0.6f)));
  scene::addTo(scene, scene::translated(scene::icosphere(0.4f, 2), Vec3(1, 0.5f, 0.5f)), mirror);
  return scene;
}

inline BakeOptions small() {
  BakeOptions options;
  options.kind = transfer::Kind::Interreflected;
  options.directions = 512;
  options.bands = 3;
  options.bounces = 2;
  return options;
}

/// A bake of receivers that stand where `placement` says.
inline Result<WithFindings<transfer::SimulatedField>> bakeScene(const scene::Scene& scene,
                                                                const BakeOptions& options,
                                                                const Placement& placement = {}) {
  const auto rays = trace::RayScene::build(scene);
  EXPECT_TRUE(rays);
  const auto receivers = transport::placeReceivers(scene, placement, rays->offset());
  if (!receivers) return receivers.error();
  return bake(scene, *rays, *receivers, options, {});
}

inline transfer::SimulatedField bakeOrDie(const scene::Scene& scene, const BakeOptions& options,
                                          const Placement& placement = {}) {
  auto baked = bakeScene(scene, options, placement);
  EXPECT_TRUE(baked) << baked.error().message;
  return std::move(baked->value);
}

/// What a bake says of a bare surface, with the parts that a test looks at by their names.
struct BakedMesh {
  bool onTexels = false;
  std::vector<Vec3> positions, normals;
  int bands = 0, channels = 0;
  transfer::Floats vectors;
  int outBands = 0, inBands = 0, matrixChannels = 0;
  transfer::Floats matrices;

  std::size_t receiverCount() const { return positions.size(); }
};

/// Empty for a mirror and for a kind that is not held.
inline BakedMesh meshOf(const transfer::SimulatedField& field, std::size_t mesh,
                        transfer::Kind kind) {
  BakedMesh out;
  const auto* surface = std::get_if<transfer::Surface<transfer::Floats>>(&field.meshes[mesh]);
  const auto* response = surface ? surface->responses.find(kind) : nullptr;
  if (!response) return out;
  out.onTexels = surface->receivers->texels() != nullptr;
  out.positions = surface->receivers->positions;
  out.normals = surface->receivers->normals;
  if (response->diffuse) {
    out.bands = response->diffuse->vectors.bands;
    out.channels = response->diffuse->vectors.channels;
    out.vectors = response->diffuse->vectors.numbers;
  }
  if (response->glossy) {
    out.outBands = response->glossy->matrices.outBands;
    out.inBands = response->glossy->matrices.inBands;
    out.matrixChannels = response->glossy->matrices.channels;
    out.matrices = response->glossy->matrices.numbers;
  }
  return out;
}
inline BakedMesh meshOf(const transfer::SimulatedField& field, std::size_t mesh) {
  return meshOf(field, mesh, field.kind);
}

/// What it says of a surface with meso-structure.
inline const transfer::BiScale<transfer::Floats>& localOf(const transfer::SimulatedField& field,
                                                          std::size_t mesh) {
  return std::get<transfer::BiScale<transfer::Floats>>(field.meshes[mesh]);
}
inline const transfer::Floats& matricesOf(const transfer::SimulatedField& field, std::size_t mesh,
                                          transfer::Kind kind) {
  return localOf(field, mesh).matrices.find(kind)->numbers;
}

}  // namespace lambent::macro
