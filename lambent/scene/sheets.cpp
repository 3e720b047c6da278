#include "lambent/scene/sheets.h"

#include <cassert>
#include <string>

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
  appendAgain(mesh.texelUvs);
  appendAgain(mesh.colors);
  appendAgain(mesh.alphas);
  appendBacks(mesh.others);
  for (std::size_t v = vertices; v < mesh.normals.size(); ++v) mesh.normals[v] = -mesh.normals[v];
  mesh.triangles.reserve(2 * triangles);
  const auto back = std::uint32_t(vertices);
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    mesh.triangles.push_back({a + back, c + back, b + back});
  }
  return mesh;
}

std::vector<std::uint32_t> verticesOfOtherSide(const Mesh& mesh) {
  const std::size_t triangles = mesh.triangles.size() / 2;
  if (triangles == 0 || mesh.triangles.size() != 2 * triangles) return {};
  std::vector<std::uint32_t> other;
  const auto pair = [&](std::uint32_t front, std::uint32_t back) {
    if (front == back || mesh.positions[front] != mesh.positions[back]) return false;
    if (other.empty()) other.assign(mesh.positions.size(), kNoVertex);
    if (other[front] == kNoVertex && other[back] == kNoVertex)
      other[front] = back, other[back] = front;
    return other[front] == back && other[back] == front;
  };
  for (std::size_t t = 0; t < triangles; ++t) {
    const auto [a, b, c] = mesh.triangles[t];
    const auto [x, z, y] = mesh.triangles[t + triangles];
    if (!pair(a, x) || !pair(b, y) || !pair(c, z)) return {};
  }
  return other;
}

bool hasBacks(const Mesh& mesh) {
  return !verticesOfOtherSide(mesh).empty();
}

std::uint32_t otherSideOf(const Mesh& mesh, std::uint32_t triangle) {
  const auto fronts = std::uint32_t(mesh.triangles.size() / 2);
  return triangle < fronts ? triangle + fronts : triangle - fronts;
}

void layOutBacks(Mesh& mesh) {
  assert(hasBacks(mesh));
  std::vector<Vec2>& uvs = mesh.texelUvs.empty() ? mesh.uvs : mesh.texelUvs;
  if (mesh.texelUvs.empty() && mesh.source.uvSet >= 0) {  // others may look up textures with them
    VertexNumbers& kept = mesh.others.emplace_back(
        VertexNumbers{"TEXCOORD_" + std::to_string(mesh.source.uvSet), 2, {}});
    for (const Vec2& uv : uvs) kept.values.insert(kept.values.end(), {uv.x(), uv.y()});
    mesh.source.uvSet = -1;
  }
  std::vector<float> shift(uvs.size(), 0.0f);
  for (std::size_t t = mesh.triangles.size() / 2; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) shift[v] = 0.5f;
  for (std::size_t v = 0; v < uvs.size(); ++v) uvs[v].x() = 0.5f * uvs[v].x() + shift[v];
}

}  // namespace lambent::scene
