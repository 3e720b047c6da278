// Pictures for tests: values that no two pixels share, and folders that clean up after themselves.
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include "lambent/image/image.h"
#include "lambent/image/maps.h"

namespace lambent::image {

/// A reproducible sequence in [0, 1).
class Sequence {
 public:
  explicit Sequence(std::uint64_t seed) : state_(seed * 2 + 1) {}
  std::uint32_t bits() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<std::uint32_t>(state_ >> 32);
  }
  float next() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }

 private:
  std::uint64_t state_;
};

inline Image noise(int width, int height, float scale = 1.0f, std::uint64_t seed = 1) {
  Image image(width, height);
  Sequence sequence(seed);
  for (Rgb& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) pixel[c] = scale * sequence.next();
  }
  return image;
}

/// Smooth, so that lossy compressions keep close to it.
inline Image gradient(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(width);
      const float v = static_cast<float>(y) / static_cast<float>(height);
      image.at(x, y) = Rgb(0.25f + 0.5f * u, 0.25f + 0.5f * v, 0.5f + 0.25f * (u - v));
    }
  }
  return image;
}

/// A map with radiance(direction) at each pixel's centre, black where it has no direction.
inline Image paint(const MapShape& shape, const auto& radiance) {
  Image image(shape.width, shape.height);
  for (int y = 0; y < shape.height; ++y) {
    for (int x = 0; x < shape.width; ++x) {
      if (const auto d = directionOf(shape, {x + 0.5, y + 0.5})) image.at(x, y) = radiance(*d);
    }
  }
  return image;
}

class FolderTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "lambent_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::filesystem::path folder_;
};

}  // namespace lambent::image
