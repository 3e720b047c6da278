#include "lambent/transport/receivers.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "lambent/scene/diagnose.h"
#include "lambent/scene/texel_map.h"
#include "lambent/transport/texel_charts.h"
#include "lambent/transport/texel_taps.h"

namespace lambent::transport {

namespace {

void add(PlacedReceivers& receivers, const scene::SurfacePoint& point, const Vec3& origin) {
  receivers.positions.push_back(point.position);
  receivers.origins.push_back(origin);
  receivers.normals.push_back(point.normal);
  receivers.diffuse.push_back(point.diffuse);
  receivers.glossy.push_back(point.glossy);
  receivers.exponents.push_back(point.lobeExponent);
}

using scene::kNobody;

/// Every empty texel takes the receiver of a nearest full one: rings of breadth-first search over
/// the eight neighbours, each texel choosing among its neighbours' full texels by distance.
void dilate(PlacedReceivers::PerMesh& grid) {
  const int width = grid.width, height = grid.height;
  std::vector<std::int32_t> source(grid.receiverOfTexel.size(), -1);  // the full texel it copies
  std::vector<std::int32_t> front, next;
  for (std::int32_t t = 0; t < width * height; ++t)
    if (grid.receiverOfTexel[t] != kNobody) source[t] = t, front.push_back(t);
  const auto forNeighbours = [&](std::int32_t t, const auto& visit) {
    const int x = t % width, y = t / width;
    for (int ny = std::max(0, y - 1); ny <= std::min(height - 1, y + 1); ++ny)
      for (int nx = std::max(0, x - 1); nx <= std::min(width - 1, x + 1); ++nx)
        visit(ny * width + nx);
  };
  const auto squaredDistance = [&](std::int32_t a, std::int32_t b) {
    const std::int64_t dx = a % width - b % width, dy = a / width - b / width;
    return dx * dx + dy * dy;
  };
  while (!front.empty()) {
    next.clear();
    for (const std::int32_t t : front)
      forNeighbours(t, [&](std::int32_t n) {
        if (source[n] < 0) source[n] = source[t], next.push_back(n);
      });
    for (const std::int32_t t : next)
      forNeighbours(t, [&](std::int32_t n) {
        if (source[n] >= 0 && squaredDistance(source[n], t) < squaredDistance(source[t], t))
          source[t] = source[n];
      });
    front.swap(next);
  }
  for (std::size_t t = 0; t < source.size(); ++t)
    grid.receiverOfTexel[t] = grid.receiverOfTexel[source[t]];
}

Status placeTexels(const scene::Scene& scene, const TexelGrid& asked, float offset,
                   PlacedReceivers& receivers) {
  const scene::Mesh& mesh = scene.meshes[asked.mesh];
  PlacedReceivers::PerMesh& grid = receivers.meshes[asked.mesh];
  if (Status sound = scene::checkUvs(mesh, asked.width, asked.height); !sound) return sound.error();
  grid.layout = Layout::Texels;
  grid.width = asked.width, grid.height = asked.height;
  grid.receiverOfTexel.assign(std::size_t(asked.width) * asked.height, kNobody);
  grid.covered.assign(grid.receiverOfTexel.size(), 0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    scene::visitTexels(
        mesh, mesh.triangles[t], asked.width, asked.height, [&](int x, int y, double u, double v) {
          std::uint32_t& place = grid.receiverOfTexel[std::size_t(y) * asked.width + x];
          if (place != kNobody) return;
          place = static_cast<std::uint32_t>(receivers.size());
          grid.covered[std::size_t(y) * asked.width + x] = 1;
          const scene::SurfacePoint point =
              scene::surfaceAt(scene, asked.mesh, t, static_cast<float>(u), static_cast<float>(v));
          add(receivers, point, point.position + offset * point.normal);
        });
  // A chart between the centres of texels gets those around it that nobody else has.
  for (const TinyChart& tiny : tinyCharts(mesh, asked.width, asked.height)) {
    std::uint32_t own = kNobody;
    for (const std::uint32_t texel : tiny.texels) {
      if (grid.receiverOfTexel[texel] != kNobody) continue;
      if (own == kNobody) {
        own = static_cast<std::uint32_t>(receivers.size());
        const scene::SurfacePoint point =
            scene::surfaceAt(scene, asked.mesh, tiny.triangle, 1.0f / 3.0f, 1.0f / 3.0f);
        add(receivers, point, point.position + offset * point.normal);
      }
      grid.receiverOfTexel[texel] = own;
    }
  }
  for (const TexelBeyond& beyond : asked.beyond) {
    std::uint32_t& place = grid.receiverOfTexel[beyond.texel];
    if (place != kNobody) continue;
    place = static_cast<std::uint32_t>(receivers.size());
    add(receivers, beyond.point, beyond.point.position + offset * beyond.point.normal);
  }
  dilate(grid);
  return Status::ok();
}

/// For every vertex a vector of length ≤ 1 in the surface that points from the border of its
/// triangles to their middle: zero within a smooth patch, inwards at an edge. A vertex of a wall's
/// edge stands on the next wall too, and rays that start exactly on a surface may slip through it:
/// lifting the origin off its own wall alone would let light in along every edge of a room.
std::vector<Vec3> inwardDirections(const scene::Mesh& mesh) {
  std::vector<Vec3> inward(mesh.positions.size(), Vec3::Zero());
  std::vector<float> weight(mesh.positions.size(), 0.0f);
  for (const scene::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = (mesh.positions[t[(k + 1) % 3]] - mesh.positions[t[k]]).normalized();
      const Vec3 b = (mesh.positions[t[(k + 2) % 3]] - mesh.positions[t[k]]).normalized();
      const float angle = std::acos(std::clamp(a.dot(b), -1.0f, 1.0f));
      inward[t[k]] += angle * (a + b);
      weight[t[k]] += 2.0f * angle;
    }
  for (std::size_t v = 0; v < inward.size(); ++v) {
    if (!(weight[v] > 0.0f)) continue;
    inward[v] /= weight[v];
    const Vec3& normal = mesh.normals[v];
    inward[v] -= inward[v].dot(normal) * normal;
  }
  return inward;
}

Status checkFrames(const scene::Scene& scene, const Placement& placement) {
  for (const LocalFrames& frames : placement.local) {
    if (frames.mesh >= scene.meshes.size())
      return report::badUsage("tangent frames are given for mesh " + std::to_string(frames.mesh) +
                              " of " + std::to_string(scene.meshes.size()));
    const scene::Mesh& mesh = scene.meshes[frames.mesh];
    if (frames.tangents.size() != mesh.positions.size())
      return report::badUsage("mesh " + std::to_string(frames.mesh) + ": " +
                              std::to_string(frames.tangents.size()) + " tangents for " +
                              std::to_string(mesh.positions.size()) + " vertices");
    if (scene.materials[mesh.material].isMirror())
      return report::badUsage("mesh " + std::to_string(frames.mesh) +
                              " is a mirror: meso-structure can not be spread over it");
    for (const TexelGrid& grid : placement.texels)
      if (grid.mesh == frames.mesh)
        return report::badUsage("mesh " + std::to_string(frames.mesh) +
                                " carries meso-structure: its receivers are vertices, not texels");
  }
  return Status::ok();
}

}  // namespace

std::uint32_t PlacedReceivers::addWitness(std::uint32_t mesh, const scene::SurfacePoint& point,
                                          const Vec3& origin) {
  add(*this, point, origin);
  witnesses.push_back(mesh);
  return static_cast<std::uint32_t>(size() - 1);
}

Result<PlacedReceivers> placeReceivers(const scene::Scene& scene, const Placement& placement,
                                       float offset) {
  const std::span<const TexelGrid> texels = placement.texels;
  PlacedReceivers receivers;
  receivers.meshes.resize(scene.meshes.size());
  if (Status sound = checkFrames(scene, placement); !sound) return sound.error();
  for (const TexelGrid& asked : texels) {
    if (asked.mesh >= scene.meshes.size())
      return report::badUsage("a texel grid is asked for mesh " + std::to_string(asked.mesh) +
                              " of " + std::to_string(scene.meshes.size()));
    if (asked.width < 1 || asked.height < 1 || asked.width > 16384 || asked.height > 16384)
      return report::badUsage("a texel grid must have 1 to 16384 texels a side");
  }
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const scene::Mesh& mesh = scene.meshes[m];
    const scene::Material& material = scene.materials[mesh.material];
    PlacedReceivers::PerMesh& place = receivers.meshes[m];
    place.first = static_cast<std::uint32_t>(receivers.size());
    if (material.isMirror()) continue;
    place.textured = material.baseColorTexture >= 0 && !mesh.uvs.empty();
    place.isGlossy = material.isGlossy();
    place.isDiffuse = material.isDiffuse() || !place.isGlossy;  // black is a diffuse material too
    for (const LocalFrames& frames : placement.local)
      if (frames.mesh == m) place.local = frames, place.isGlossy = false, place.isDiffuse = true;
    const auto asked = std::find_if(texels.begin(), texels.end(),
                                    [&](const TexelGrid& grid) { return grid.mesh == m; });
    if (asked != texels.end()) {
      if (Status placed = placeTexels(scene, *asked, offset, receivers); !placed)
        return placed.error();
    } else {
      place.layout = Layout::Vertices;
      const std::vector<Vec3> inward = inwardDirections(mesh);
      for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const scene::SurfacePoint point = scene::surfaceAtVertex(scene, m, v);
        add(receivers, point, point.position + offset * (point.normal + inward[v]));
      }
    }
    place.count = static_cast<std::uint32_t>(receivers.size()) - place.first;
  }
  return receivers;
}

std::vector<std::uint32_t> spatialOrder(const PlacedReceivers& receivers) {
  scene::Box box;
  for (const Vec3& p : receivers.positions) box.extend(p);
  const Vec3 scale = (box.upper - box.lower).cwiseMax(1e-30f).cwiseInverse() * 1023.0f;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keyed(receivers.size());
  for (std::uint32_t r = 0; r < keyed.size(); ++r) {
    const Vec3 at = (receivers.positions[r] - box.lower).cwiseProduct(scale);
    std::uint32_t key = 0;
    for (int bit = 9; bit >= 0; --bit)
      for (int axis = 0; axis < 3; ++axis)
        key = (key << 1) | ((static_cast<std::uint32_t>(at[axis]) >> bit) & 1u);
    keyed[r] = {key, r};
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<std::uint32_t> order;
  order.reserve(keyed.size());
  for (const auto& [key, r] : keyed) order.push_back(r);
  return order;
}

ReceiversAround receiversAround(const scene::Scene& scene, const PlacedReceivers& receivers,
                                std::uint32_t mesh, std::uint32_t triangle, float u, float v) {
  const PlacedReceivers::PerMesh& place = receivers.meshes[mesh];
  const scene::Triangle& corners = scene.meshes[mesh].triangles[triangle];
  const float w = 1.0f - u - v;
  if (place.layout == Layout::Vertices)
    return {{place.first + corners[0], place.first + corners[1], place.first + corners[2]},
            {w, u, v},
            3};
  const std::vector<Vec2>& uvs = scene::texelUvsOf(scene.meshes[mesh]);
  const Vec2 uv = w * uvs[corners[0]] + u * uvs[corners[1]] + v * uvs[corners[2]];
  const TexelTaps taps = tapsAt(uv, place.width, place.height);
  ReceiversAround around;
  around.count = 4;
  for (std::size_t k = 0; k < 4; ++k) {
    around.receiver[k] = place.receiverOfTexel[taps.texels[k]];
    around.weight[k] = static_cast<float>(taps.weights[k]);
  }
  return around;
}

std::uint32_t drawReceiver(const scene::Scene& scene, const PlacedReceivers& receivers,
                           std::uint32_t mesh, std::uint32_t triangle, float u, float v, float u1,
                           float u2) {
  const PlacedReceivers::PerMesh& place = receivers.meshes[mesh];
  const scene::Triangle& corners = scene.meshes[mesh].triangles[triangle];
  if (place.layout == Layout::Vertices) {
    const float w = 1.0f - u - v;
    return place.first + corners[u1 < w ? 0 : (u1 < w + u ? 1 : 2)];
  }
  const std::vector<Vec2>& uvs = scene::texelUvsOf(scene.meshes[mesh]);
  const Vec2 uv = (1.0f - u - v) * uvs[corners[0]] + u * uvs[corners[1]] + v * uvs[corners[2]];
  const auto cell = [](float coordinate, int count, float random) {
    const float at = coordinate * static_cast<float>(count) - 0.5f;
    const float below = std::floor(at);
    const int index = static_cast<int>(below) + (random < at - below ? 1 : 0);
    return std::clamp(index, 0, count - 1);
  };
  const int x = cell(uv.x(), place.width, u1), y = cell(uv.y(), place.height, u2);
  return place.receiverOfTexel[std::size_t(y) * place.width + x];
}

}  // namespace lambent::transport
