#include "lambent/scene/vertex_numbers.h"

#include <cmath>

#include <Eigen/LU>

namespace lambent::scene {

void takeVertices(AllVertexNumbers& all, std::span<const std::uint32_t> from) {
  for (VertexNumbers& numbers : all) {
    const auto width = std::size_t(numbers.width);
    std::vector<float> taken;
    taken.reserve(from.size() * width);
    for (const std::uint32_t v : from)
      for (std::size_t k = 0; k < width; ++k) taken.push_back(numbers.values[v * width + k]);
    numbers.values = std::move(taken);
  }
}

void copyVertex(AllVertexNumbers& all, std::uint32_t of) {
  for (VertexNumbers& numbers : all)
    for (int k = 0; k < numbers.width; ++k) {
      const float value = numbers.values[of * std::size_t(numbers.width) + std::size_t(k)];
      numbers.values.push_back(value);
    }
}

void addMiddle(AllVertexNumbers& all, std::uint32_t a, std::uint32_t b) {
  for (VertexNumbers& numbers : all) {
    const auto width = std::size_t(numbers.width);
    const std::size_t middle = numbers.values.size();
    for (std::size_t k = 0; k < width; ++k) {
      const float first = numbers.values[a * width + k], second = numbers.values[b * width + k];
      // Not even tangents of either hand have one between them: the first stands for both.
      const bool whole = numbers.areLabels() || (numbers.areTangents() && k == 3);
      numbers.values.push_back(whole ? first : 0.5f * first + 0.5f * second);
    }
    if (!numbers.areTangents()) continue;
    Eigen::Map<Eigen::Vector3f> tangent(numbers.values.data() + middle);
    const float length = tangent.norm();
    if (length > 1e-6f) {
      tangent /= length;
    } else {
      for (int k = 0; k < 3; ++k) tangent[k] = numbers.values[a * width + std::size_t(k)];
    }
  }
}

void appendBacks(AllVertexNumbers& all) {
  for (VertexNumbers& numbers : all) {
    const std::size_t count = numbers.values.size();
    numbers.values.reserve(2 * count);
    const float sign = numbers.areTangents() ? -1.0f : 1.0f;
    for (std::size_t i = 0; i < count; ++i) numbers.values.push_back(sign * numbers.values[i]);
  }
}

void transformTangents(AllVertexNumbers& all, const Eigen::Matrix3d& linear) {
  const bool mirrors = linear.determinant() < 0.0;
  for (VertexNumbers& numbers : all) {
    if (!numbers.areTangents()) continue;
    for (std::size_t i = 0; i + 3 < numbers.values.size(); i += 4) {
      Eigen::Map<Eigen::Vector3f> tangent(numbers.values.data() + i);
      const Eigen::Vector3d turned = linear * tangent.cast<double>();
      const double length = turned.norm();
      if (length > 0.0) tangent = (turned / length).cast<float>();
      if (mirrors) numbers.values[i + 3] = -numbers.values[i + 3];
    }
  }
}

}  // namespace lambent::scene
