// Patches that tests can integrate by hand.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include <Eigen/Geometry>

#include "lambent/meso/build_rtt.h"
#include "lambent/meso/height_field.h"

namespace lambent::meso {

inline RttOptions smallOptions(int positions, int views) {
  RttOptions options;
  options.width = options.height = positions;
  options.views = views;
  return options;
}

inline transfer::SimulatedRtt build(const Patch& patch, const RttOptions& options) {
  auto rtt = buildRtt(patch, options, {});
  EXPECT_TRUE(rtt) << (rtt ? "" : rtt.error().message);
  return rtt ? std::move(rtt->value) : transfer::SimulatedRtt{};
}

/// Quads, counter-clockwise from the front, each with its own flat normal.
inline void addQuad(Patch& patch, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                    int material = 0) {
  scene::Mesh mesh;
  mesh.material = material;
  mesh.positions = {a, b, c, d};
  mesh.normals.assign(4, (b - a).cross(c - a).normalized());
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  patch.scene.meshes.push_back(mesh);
}

inline Patch patchWith(const Rgb& first, const Rgb& second) {
  Patch patch;
  patch.name = "test";
  patch.size = Vec2(0.1f, 0.1f);
  patch.scene.materials.resize(2);
  patch.scene.materials[0].diffuse = first;
  patch.scene.materials[1].diffuse = second;
  return patch;
}

inline Patch flatPatch(const Rgb& albedo) {
  Patch patch = patchWith(albedo, albedo);
  addQuad(patch, {0, 0, 0}, {0.1f, 0, 0}, {0.1f, 0.1f, 0}, {0, 0.1f, 0});
  return patch;
}

/// A slot along y, from x = 0.02 to 0.02 + width: floor at −height, walls, and a level top.
inline Patch slotPatch(float width, float height, float wallAlbedo, float floorAlbedo) {
  Patch patch = patchWith(Rgb::Constant(wallAlbedo), Rgb::Constant(floorAlbedo));
  const float l = 0.02f, r = l + width, s = 0.1f, z = -height;
  addQuad(patch, {l, 0, z}, {r, 0, z}, {r, s, z}, {l, s, z}, 1);
  addQuad(patch, {l, 0, z}, {l, s, z}, {l, s, 0}, {l, 0, 0});
  addQuad(patch, {r, 0, z}, {r, 0, 0}, {r, s, 0}, {r, s, z});
  addQuad(patch, {r, 0, 0}, {l + s, 0, 0}, {l + s, s, 0}, {r, s, 0});
  return patch;
}

/// A V groove along y, one in a period of 0.1.
inline Patch groovePatch(float depth, const Rgb& albedo) {
  Patch patch = patchWith(albedo, albedo);
  const float s = 0.1f, m = 0.05f, z = -depth;
  addQuad(patch, {0, 0, 0}, {m, 0, z}, {m, s, z}, {0, s, 0});
  addQuad(patch, {m, 0, z}, {s, 0, 0}, {s, s, 0}, {m, s, z});
  return patch;
}

/// A smooth height field without symmetry, moved by whole samples.
inline Patch bumpyPatch(const Rgb& albedo, int shiftX = 0, int shiftY = 0) {
  HeightField field;
  field.width = field.height = 48;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 48; ++x) {
      const double u = 2 * kPi * (x + shiftX) / 48, v = 2 * kPi * (y + shiftY) / 48;
      field.heights.push_back(static_cast<float>(
          0.006 * (std::sin(u) + 0.6 * std::sin(2 * v + u) + 0.5 * std::cos(3 * u - v))));
    }
  scene::Material material;
  material.diffuse = albedo;
  return patchOf(field, Vec2(0.1f, 0.1f), material, "bumpy");
}

}  // namespace lambent::meso
