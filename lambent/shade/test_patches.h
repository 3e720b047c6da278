// Small bi-scale assets for the tests of shade and render: radiance transfer textures by formula,
// spread over meshes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/transfer/field.h"

namespace lambent::shade::test {

/// Positions, views a side and bands; values zero.
transfer::SimulatedRtt emptyRtt(int width, int height, int views, int bands);

/// A flat patch of one reflectance: B_i = ρ/π Â_l y_i(+z) everywhere, from everywhere.
transfer::SimulatedRtt flatRtt(int width, int height, int views, int bands, const Rgb& reflectance);

/// Bumps with colours, all different, that answer differently to every view: nothing about it is
/// symmetric. 1 m a side.
transfer::SimulatedRtt bumpyRtt(int width, int height, int views, int bands);

/// Every coefficient but the constant one is zero; that of position (x, y), view (vx, vy) is the
/// colour of `of`. Under uniform light of radiance 1 the patch shows these colours.
template <class Colour>
transfer::SimulatedRtt paintedRtt(int width, int height, int views, Colour of) {
  transfer::SimulatedRtt rtt = emptyRtt(width, height, views, 1);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int vy = 0; vy < views; ++vy)
        for (int vx = 0; vx < views; ++vx) {
          const Rgb colour = of(x, y, vx, vy);
          for (int c = 0; c < 3; ++c)
            rtt.values[rtt.index(0, x, y, vx, vy) + c] = colour[c] / 3.5449077f;  // √4π
        }
  return rtt;
}

/// Unit tangents at right angles to the normals, as near as possible to `direction`.
std::vector<Vec3> tangentsAlong(const scene::Mesh& mesh, const Vec3& direction);

/// An id map whose places run on as the texture coordinates do, `tiles` times, but jump by a random
/// amount from square to square of 8 texels.
transfer::IdMap patchworkMap(int width, int height, const Vec2& tiles);

struct SpreadOptions {
  transfer::Encoding encoding = transfer::Encoding::Float32;
  transfer::Encoding matrices = transfer::Encoding::Float32;
  Vec3 tangent = Vec3(1.0f, 0.1f, 0.05f);
  std::optional<transfer::IdMap> idMap;
  Vec2 tiles = Vec2(3.0f, 2.0f);
  float scale = 1.0f;
  int shadowedBands = 0;  ///< 0: no matrices
  int channels = 0;       ///< of interreflected matrices, 0: none
};

/// Adds `mesh` with the patch spread over it. Matrices: the rotation into the tangent frame, of
/// which shadowed ones keep ¾, and interreflected ones ½ with a tint that differs by channel and
/// receiver.
void addPatched(asset::Asset& asset, scene::Mesh mesh, const transfer::SimulatedRtt& rtt,
                const SpreadOptions& options);

/// Adds a layer of a mesh that is there: all of its triangles, with a patch spread over them, there as
/// these alphas say, which lie side by side along u.
void addLayer(asset::Asset& asset, std::uint32_t mesh, const transfer::SimulatedRtt& rtt,
              const SpreadOptions& options, const std::vector<std::uint8_t>& alphas);

}  // namespace lambent::shade::test
