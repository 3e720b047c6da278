#include "lambent/scene/sheets.h"

#include <cassert>

namespace lambent::scene {
namespace {

template <class T>
void appendAgain(std::vector<T>& values) {
  const std::size_t count = values.size();
  values.reserve(2 * count);
  for (std::size_t i = 0; i < count; ++i) values.push_back(values[i]);
}

}  // namespace

Mesh withBacks(Mesh mesh) {
  const std::size_t vertices = mesh.positions.size(), triangles = mesh.triangles.size();
  appendAgain(mesh.positions);
  appendAgain(mesh.normals);
  appendAgain(mesh.uvs);
  appendAgain(mesh.colors);
  appendAgain(mesh.alphas);
  for (std::size_t v = vertices; v < mesh.normals.size(); ++v) mesh.normals[v] = -mesh.normals[v];
  mesh.triangles.reserve(2 * triangles);
  const auto back = std::uint32_t(vertices);
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    mesh.triangles.push_back({a + back, c + back, b + back});
  }
  return mesh;
}

bool hasBacks(const Mesh& mesh) {
  const std::size_t vertices = mesh.positions.size() / 2, triangles = mesh.triangles.size() / 2;
  if (triangles == 0 || mesh.positions.size() != 2 * vertices ||
      mesh.triangles.size() != 2 * triangles)
    return false;
  const auto back = std::uint32_t(vertices);
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    if (a >= back || b >= back || c >= back) return false;
    if (mesh.triangles[t + triangles] != Triangle{a + back, c + back, b + back}) return false;
  }
  for (std::size_t v = 0; v < vertices; ++v)
    if (mesh.positions[v] != mesh.positions[v + vertices]) return false;
  return true;
}

std::uint32_t otherSideOf(const Mesh& mesh, std::uint32_t triangle) {
  const auto fronts = std::uint32_t(mesh.triangles.size() / 2);
  return triangle < fronts ? triangle + fronts : triangle - fronts;
}

void layOutBacks(Mesh& mesh) {
  assert(hasBacks(mesh));
  for (std::size_t v = 0; v < mesh.uvs.size(); ++v) {
    const bool front = v < mesh.uvs.size() / 2;
    mesh.uvs[v].x() = 0.5f * mesh.uvs[v].x() + (front ? 0.0f : 0.5f);
  }
}

}  // namespace lambent::scene
