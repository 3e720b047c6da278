// This work is based on:
// - gibson1998constrained: surface nets, one vertex in each cell that the surface cuts.
#include "figures/forms.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "lambent/scene/shapes.h"

namespace lambent::figures {

scene::Mesh torusKnot() {
  constexpr int kAlong = 480, kAround = 40;
  constexpr float kTube = 0.26f;
  const auto axis = [](float t) {
    const float r = 1.0f + 0.42f * std::cos(3.0f * t);
    return Vec3(r * std::cos(2.0f * t), 0.42f * std::sin(3.0f * t), r * std::sin(2.0f * t));
  };
  scene::Mesh mesh;
  mesh.name = "knot";
  for (int i = 0; i < kAlong; ++i) {
    const float t = 2.0f * float(kPi) * float(i) / kAlong;
    const Vec3 centre = axis(t), along = (axis(t + 1e-3f) - axis(t - 1e-3f)).normalized();
    // Sideways from the torus's core, which no tangent of the knot points along.
    const Vec3 core = Vec3(std::cos(2.0f * t), 0.0f, std::sin(2.0f * t));
    const Vec3 out = centre - core;
    const Vec3 side = (out - out.dot(along) * along).normalized(), up = along.cross(side);
    for (int k = 0; k < kAround; ++k) {
      const float a = 2.0f * float(kPi) * float(k) / kAround;
      mesh.positions.push_back(centre + kTube * (std::cos(a) * side + std::sin(a) * up));
    }
  }
  const auto at = [](int i, int k) { return std::uint32_t((i % kAlong) * kAround + k % kAround); };
  for (int i = 0; i < kAlong; ++i)
    for (int k = 0; k < kAround; ++k) {
      mesh.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k)});
      mesh.triangles.push_back({at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)});
    }
  scene::computeNormals(mesh);
  return mesh;
}

namespace {

/// Of two distances, rounded where they are within k of each other.
float smoothMinimum(float a, float b, float k) {
  const float h = std::max(k - std::abs(a - b), 0.0f) / k;
  return std::min(a, b) - 0.25f * h * h * k;
}

/// Distance to a rod whose radius runs from ra at a to rb at b (roughly: as if it were constant).
float rod(const Vec3& p, const Vec3& a, const Vec3& b, float ra, float rb) {
  const Vec3 ab = b - a;
  const float t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0f, 1.0f);
  return (p - a - t * ab).norm() - (ra + t * (rb - ra));
}

float creatureField(const Vec3& p) {
  const Vec3 m(p.x(), p.y(), std::abs(p.z()));                                    // left as right
  float d = rod(p, Vec3(-0.45f, 0.05f, 0), Vec3(0.42f, 0.12f, 0), 0.30f, 0.34f);  // trunk
  // Folds around the belly and the neck.
  const float wrinkles = std::sin(34.0f * p.x() + 3.0f * p.y());
  const float belly = std::exp(-8.0f * (p - Vec3(-0.02f, -0.22f, 0)).squaredNorm());
  const float neck = std::exp(-14.0f * (p - Vec3(0.66f, 0.30f, 0)).squaredNorm());
  d = smoothMinimum(d, rod(p, Vec3(0.5f, 0.2f, 0), Vec3(0.85f, 0.5f, 0), 0.20f, 0.17f), 0.15f);
  d = smoothMinimum(d, rod(p, Vec3(0.85f, 0.5f, 0), Vec3(1.12f, 0.42f, 0), 0.19f, 0.10f), 0.1f);
  d = smoothMinimum(d, rod(m, Vec3(0.82f, 0.62f, 0.10f), Vec3(0.74f, 0.86f, 0.20f), 0.08f, 0.035f),
                    0.06f);  // ears
  const auto limb = [&](const Vec3& hip, const Vec3& knee, const Vec3& foot, float thick) {
    d = smoothMinimum(d, rod(m, hip, knee, thick, 0.75f * thick), 0.10f);
    d = smoothMinimum(d, rod(m, knee, foot, 0.75f * thick, 0.6f * thick), 0.05f);
  };
  limb(Vec3(0.40f, 0.0f, 0.22f), Vec3(0.52f, -0.28f, 0.36f), Vec3(0.42f, -0.62f, 0.34f), 0.14f);
  limb(Vec3(-0.48f, 0.0f, 0.20f), Vec3(-0.42f, -0.30f, 0.34f), Vec3(-0.58f, -0.62f, 0.32f), 0.16f);
  d = smoothMinimum(d, rod(m, Vec3(0.40f, -0.62f, 0.34f), Vec3(0.56f, -0.65f, 0.36f), 0.09f, 0.06f),
                    0.05f);
  d = smoothMinimum(
      d, rod(m, Vec3(-0.6f, -0.62f, 0.32f), Vec3(-0.42f, -0.65f, 0.34f), 0.09f, 0.06f), 0.05f);
  d = smoothMinimum(d, rod(p, Vec3(-0.7f, 0.08f, 0), Vec3(-1.0f, 0.30f, 0.06f), 0.13f, 0.08f),
                    0.1f);
  d = smoothMinimum(d, rod(p, Vec3(-1.0f, 0.30f, 0.06f), Vec3(-1.15f, 0.62f, -0.02f), 0.08f, 0.04f),
                    0.06f);  // tail
  return d + 0.022f * (belly + neck) * wrinkles;
}

/// The zero of a field over a box as triangles, by surface nets: front where it grows.
scene::Mesh surfaceNets(const std::function<float(const Vec3&)>& field, const scene::Box& box,
                        float cell) {
  const Vec3 extent = box.upper - box.lower;
  std::array<int, 3> n;
  for (int a = 0; a < 3; ++a) n[std::size_t(a)] = int(std::ceil(extent[a] / cell)) + 1;
  const auto index = [&](int x, int y, int z) {
    return (std::size_t(z) * std::size_t(n[1]) + std::size_t(y)) * std::size_t(n[0]) +
           std::size_t(x);
  };
  const auto corner = [&](int x, int y, int z) -> Vec3 {
    return box.lower + cell * Vec3(float(x), float(y), float(z));
  };
  std::vector<float> value(index(0, 0, n[2]));
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) value[index(x, y, z)] = field(corner(x, y, z));

  scene::Mesh mesh;
  std::vector<std::uint32_t> vertexOf(value.size(), 0xffffffffu);
  for (int z = 0; z + 1 < n[2]; ++z)
    for (int y = 0; y + 1 < n[1]; ++y)
      for (int x = 0; x + 1 < n[0]; ++x) {
        Vec3 sum = Vec3::Zero();
        int crossings = 0;
        for (int axis = 0; axis < 3; ++axis)
          for (int k = 0; k < 4; ++k) {
            std::array<int, 3> a = {x, y, z};
            a[std::size_t((axis + 1) % 3)] += k & 1, a[std::size_t((axis + 2) % 3)] += k >> 1;
            std::array<int, 3> b = a;
            ++b[std::size_t(axis)];
            const float va = value[index(a[0], a[1], a[2])], vb = value[index(b[0], b[1], b[2])];
            if ((va < 0.0f) == (vb < 0.0f)) continue;
            const Vec3 pa = corner(a[0], a[1], a[2]), pb = corner(b[0], b[1], b[2]);
            sum += pa + va / (va - vb) * (pb - pa), ++crossings;
          }
        if (crossings == 0) continue;
        vertexOf[index(x, y, z)] = std::uint32_t(mesh.positions.size());
        mesh.positions.push_back(sum / float(crossings));
      }
  // A quad around every edge of the grid that the surface cuts.
  for (int axis = 0; axis < 3; ++axis)
    for (int z = 1; z + 1 < n[2]; ++z)
      for (int y = 1; y + 1 < n[1]; ++y)
        for (int x = 1; x + 1 < n[0]; ++x) {
          const std::array<int, 3> a = {x, y, z};
          std::array<int, 3> b = a, u = a, v = a, both = a;
          ++b[std::size_t(axis)];
          --u[std::size_t((axis + 1) % 3)], --v[std::size_t((axis + 2) % 3)];
          --both[std::size_t((axis + 1) % 3)], --both[std::size_t((axis + 2) % 3)];
          const bool inA = value[index(a[0], a[1], a[2])] < 0.0f;
          if (inA == (value[index(b[0], b[1], b[2])] < 0.0f)) continue;
          std::array<std::uint32_t, 4> quad = {
              vertexOf[index(both[0], both[1], both[2])], vertexOf[index(v[0], v[1], v[2])],
              vertexOf[index(a[0], a[1], a[2])], vertexOf[index(u[0], u[1], u[2])]};
          if (!inA) std::swap(quad[1], quad[3]);
          mesh.triangles.push_back({quad[0], quad[1], quad[2]});
          mesh.triangles.push_back({quad[0], quad[2], quad[3]});
        }
  scene::computeNormals(mesh);
  return mesh;
}

}  // namespace

scene::Mesh creature(int cells) {
  scene::Box box;
  box.extend(Vec3(-1.4f, -0.9f, -0.65f)), box.extend(Vec3(1.4f, 1.05f, 0.65f));
  scene::Mesh mesh = surfaceNets(creatureField, box, 2.3f / float(cells));
  mesh.name = "creature";
  return mesh;
}

scene::Mesh holedPlane() {
  constexpr int kAround = 96, kRings = 12;
  constexpr float kHole = 0.35f, kHalf = 1.0f;
  scene::Mesh mesh;
  mesh.name = "holed plane";
  for (int k = 0; k < kAround; ++k) {
    const float a = 2.0f * float(kPi) * float(k) / kAround;
    const Vec3 towards(std::cos(a), 0.0f, std::sin(a));
    const Vec3 border = towards * (kHalf / towards.cwiseAbs().maxCoeff());
    for (int r = 0; r <= kRings; ++r) {
      const float t = float(r) / kRings;
      mesh.positions.push_back((1.0f - t) * kHole * towards + t * border);
    }
  }
  for (std::uint32_t k = 0; k < kAround; ++k)
    for (std::uint32_t r = 0; r < kRings; ++r) {
      const std::uint32_t a = k * (kRings + 1) + r, b = (k + 1) % kAround * (kRings + 1) + r;
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({b, b + 1, a + 1});
    }
  mesh.normals.assign(mesh.positions.size(), Vec3::UnitY());
  return mesh;
}

}  // namespace lambent::figures
