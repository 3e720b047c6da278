#include "web/viewer/assets/turned.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "lambent/scene/shapes.h"

namespace lambent::page {

using scene::Mesh;

std::vector<ProfilePoint> smoothProfile(const std::vector<ProfilePoint>& points, int count) {
  const auto at = [&](int i) {
    const ProfilePoint& p = points[std::size_t(std::clamp(i, 0, int(points.size()) - 1))];
    return Vec2(p.radius, p.height);
  };
  std::vector<ProfilePoint> out;
  for (int k = 0; k <= count; ++k) {
    const float where = float(k) / float(count) * float(points.size() - 1);
    const int i = std::min(int(where), int(points.size()) - 2);
    const Vec2 p[4] = {at(i - 1), at(i), at(i + 1), at(i + 2)};
    // Barry and Goldman's pyramid, knots spaced by the root of the chords.
    float t[4] = {0};
    for (int j = 1; j < 4; ++j)
      t[j] = t[j - 1] + std::max(std::sqrt((p[j] - p[j - 1]).norm()), 1e-4f);
    const float x = t[1] + (where - float(i)) * (t[2] - t[1]);
    const auto mix = [&](const Vec2& a, const Vec2& b, float ta, float tb) -> Vec2 {
      return ((tb - x) * a + (x - ta) * b) / (tb - ta);
    };
    const Vec2 a = mix(p[0], p[1], t[0], t[1]), b = mix(p[1], p[2], t[1], t[2]),
               c = mix(p[2], p[3], t[2], t[3]);
    const Vec2 d = mix(a, b, t[0], t[2]), e = mix(b, c, t[1], t[3]);
    const Vec2 q = mix(d, e, t[1], t[2]);
    out.push_back({std::max(q.x(), 0.0f), q.y()});
  }
  return out;
}

Mesh turned(const std::vector<ProfilePoint>& profile, int segments) {
  Mesh mesh;
  const int rows = int(profile.size());
  // Normals from the profile: what lies at the same place twice has one for each side.
  std::vector<Vec2> normals(profile.size());
  const auto same = [&](int i, int j) {
    const ProfilePoint &a = profile[std::size_t(i)], &b = profile[std::size_t(j)];
    return a.radius == b.radius && a.height == b.height;
  };
  for (int i = 0; i < rows; ++i) {
    Vec2 sum = Vec2::Zero();
    for (int j = std::max(i - 1, 0); j <= std::min(i, rows - 2); ++j) {
      if (same(j, j + 1)) continue;
      const Vec2 step(profile[std::size_t(j) + 1].radius - profile[std::size_t(j)].radius,
                      profile[std::size_t(j) + 1].height - profile[std::size_t(j)].height);
      sum += Vec2(-step.y(), step.x()) / step.norm();
    }
    normals[std::size_t(i)] = sum.normalized();
  }
  // Where the profile meets the axis the surface has the axis as its normal.
  for (const int end : {0, rows - 1})
    if (profile[std::size_t(end)].radius == 0.0f)
      normals[std::size_t(end)] = Vec2(0, end == 0 ? 1 : -1);

  for (int i = 0; i < rows; ++i)
    for (int s = 0; s <= segments; ++s) {
      const float angle = float(2 * kPi) * float(s % segments) / float(segments);
      const Vec3 out(std::cos(angle), 0, std::sin(angle));
      const ProfilePoint& p = profile[std::size_t(i)];
      mesh.positions.push_back(p.radius * out + Vec3(0, p.height, 0));
      mesh.normals.push_back(normals[std::size_t(i)].x() * out +
                             Vec3(0, normals[std::size_t(i)].y(), 0));
      mesh.uvs.emplace_back(float(s) / float(segments), float(i) / float(rows - 1));
    }
  const auto index = [&](int i, int s) { return std::uint32_t(i * (segments + 1) + s); };
  for (int i = 0; i + 1 < rows; ++i) {
    if (same(i, i + 1)) continue;
    for (int s = 0; s < segments; ++s) {
      if (profile[std::size_t(i)].radius > 0)
        mesh.triangles.push_back({index(i, s), index(i, s + 1), index(i + 1, s)});
      if (profile[std::size_t(i) + 1].radius > 0)
        mesh.triangles.push_back({index(i, s + 1), index(i + 1, s + 1), index(i + 1, s)});
    }
  }
  return mesh;
}

Mesh plinth(float radius, float height, int segments, int rings) {
  std::vector<ProfilePoint> profile;
  const float edge = 0.35f * height;
  for (int i = 0; i <= rings; ++i) {
    const float t = float(i) / float(rings);
    profile.push_back({(radius - edge) * (0.55f * t + 0.45f * t * t * t), 0.0f});
  }
  for (int i = 1; i <= 6; ++i) {
    const float angle = float(kPi / 2) * float(i) / 6.0f;
    profile.push_back({radius - edge + edge * std::sin(angle), -edge + edge * std::cos(angle)});
  }
  profile.push_back({radius, -0.7f * height});
  profile.push_back({radius, -height});
  profile.push_back({radius, -height});
  profile.push_back({0.0f, -height});
  return turned(profile, segments);
}

namespace {

Vec3 knotPoint(const KnotOptions& o, double t) {
  const double a = 2 * kPi * o.around * t, b = 2 * kPi * o.through * t;
  const double r = o.major + o.minor * std::cos(b);
  return Vec3d(r * std::cos(a), r * std::sin(a), -o.minor * std::sin(b)).cast<float>();
}

}  // namespace

Mesh knot(const KnotOptions& o) {
  Mesh mesh;
  const double step = 1e-4;
  // A frame carried along without twist, and its closing error spread over the whole length.
  std::vector<Vec3> centres, tangents, across;
  for (int i = 0; i <= o.along; ++i) {
    const double t = double(i % o.along) / o.along;
    centres.push_back(knotPoint(o, t));
    tangents.push_back((knotPoint(o, t + step) - knotPoint(o, t - step)).normalized());
  }
  across.push_back(tangents[0].cross(Vec3(0, 0, 1)).normalized());
  for (int i = 1; i <= o.along; ++i) {
    const auto turn =
        Eigen::Quaternionf::FromTwoVectors(tangents[std::size_t(i) - 1], tangents[std::size_t(i)]);
    across.push_back((turn * across.back()).normalized());
  }
  const Vec3 last = across.back(), first = across.front();
  const float error = std::atan2(last.cross(first).dot(tangents[0]), last.dot(first));
  for (int i = 0; i <= o.along; ++i) {
    const float share = error * float(i) / float(o.along);
    const Vec3 u = Eigen::AngleAxisf(share, tangents[std::size_t(i)]) * across[std::size_t(i)];
    const Vec3 v = tangents[std::size_t(i)].cross(u);
    for (int j = 0; j <= o.across; ++j) {
      const float angle = float(2 * kPi) * float(j % o.across) / float(o.across);
      const Vec3 normal = std::cos(angle) * u + std::sin(angle) * v;
      mesh.positions.push_back(centres[std::size_t(i)] + o.tube * normal);
      mesh.normals.push_back(normal);
      mesh.uvs.emplace_back(float(i) / float(o.along), float(j) / float(o.across));
    }
  }
  const auto index = [&](int i, int j) { return std::uint32_t(i * (o.across + 1) + j); };
  for (int i = 0; i < o.along; ++i)
    for (int j = 0; j < o.across; ++j) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i + 1, j)});
      mesh.triangles.push_back({index(i, j), index(i, j + 1), index(i + 1, j + 1)});
    }
  return mesh;
}

float lengthOf(const KnotOptions& options) {
  constexpr int kSteps = 2000;
  float length = 0;
  for (int i = 0; i < kSteps; ++i)
    length +=
        (knotPoint(options, (i + 1.0) / kSteps) - knotPoint(options, double(i) / kSteps)).norm();
  return length;
}

}  // namespace lambent::page
