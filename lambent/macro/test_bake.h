// Bakes for tests.
#pragma once

#include <gtest/gtest.h>

#include "lambent/macro/bake.h"

namespace lambent::macro {

using transport::Layout;
using transport::LocalFrames;
using transport::LocalTransfer;
using transport::MeshTransfer;
using transport::Placement;
using transport::ShadowedTransfer;
using transport::TransferField;
using transport::TransferKind;

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
