// What else a file has at the vertices of a mesh than light asks for.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace lambent::scene {

/// Numbers at the vertices of a mesh that light does not ask for: further sets of texture
/// coordinates and colours, tangents, what a program put there.
struct VertexNumbers {
  std::string name;           ///< glTF's: "TEXCOORD_1", "TANGENT", "_TEMPERATURE"
  int width = 1;              ///< numbers at a vertex, 1 to 4
  std::vector<float> values;  ///< width · vertices, normalized integers as [0, 1] or [−1, 1]
  int component = 5126;       ///< glTF's componentType that they are stored as
  bool normalized = false;

  /// Integers that are names of something: between two of them there is no third.
  bool areLabels() const { return component != 5126 && !normalized; }
  bool areTangents() const { return name == "TANGENT" && width == 4; }
};
using AllVertexNumbers = std::vector<VertexNumbers>;

/// Vertex i becomes what vertex `from[i]` was.
void takeVertices(AllVertexNumbers& all, std::span<const std::uint32_t> from);
/// A further vertex, as vertex `of` is.
void copyVertex(AllVertexNumbers& all, std::uint32_t of);
/// A further vertex half-way between two.
void addMiddle(AllVertexNumbers& all, std::uint32_t a, std::uint32_t b);
/// All vertices again, as the back of a sheet: a relief that rises from its front sinks into it.
void appendBacks(AllVertexNumbers& all);
/// Tangents go where `linear` takes them; a mirror turns the third axis of their frames over.
void transformTangents(AllVertexNumbers& all, const Eigen::Matrix3d& linear);

}  // namespace lambent::scene
