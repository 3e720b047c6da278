// Bakes for tests.
#pragma once

#include <gtest/gtest.h>

#include "lambent/macro/bake.h"
#include "lambent/scene/shapes.h"

namespace lambent::macro {

using transport::Layout;
using transport::LocalFrames;
using transport::LocalTransfer;
using transport::MeshTransfer;
using transport::Placement;
using transport::ShadowedTransfer;
using transport::TransferField;
using transport::TransferKind;

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
  options.kind = TransferKind::Interreflected;
  options.directions = 512;
  options.bands = 3;
  options.bounces = 2;
  return options;
}

/// A bake of receivers that stand where `placement` says.
inline Result<WithFindings<TransferField>> bakeScene(const scene::Scene& scene,
                                                     const BakeOptions& options,
                                                     const Placement& placement = {}) {
  const auto rays = trace::RayScene::build(scene);
  EXPECT_TRUE(rays);
  const auto receivers = transport::placeReceivers(scene, placement, rays->offset());
  if (!receivers) return receivers.error();
  return bake(scene, *rays, *receivers, options, {});
}

inline TransferField bakeOrDie(const scene::Scene& scene, const BakeOptions& options,
                               const Placement& placement = {}) {
  auto baked = bakeScene(scene, options, placement);
  EXPECT_TRUE(baked) << baked.error().message;
  return std::move(baked->value);
}

}  // namespace lambent::macro
