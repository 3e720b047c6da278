#include "lambent/scene_io/vertex_colors.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "lambent/radiometry/srgb.h"

namespace lambent::scene_io {
namespace {

struct Spread {
  float most = 0.0f;
  bool whole = true;
};

Spread spreadOf(std::span<const Rgb> colors) {
  Spread spread;
  for (const Rgb& color : colors) {
    for (const float c : {color.x(), color.y(), color.z()}) {
      if (!std::isfinite(c) || c < 0.0f) continue;
      spread.most = std::max(spread.most, c);
      spread.whole = spread.whole && c == std::floor(c);
    }
  }
  return spread;
}

}  // namespace

float whiteOf(std::span<const Rgb> colors) {
  const auto [most, whole] = spreadOf(colors);
  if (most > 65535.0f || !(most > 2.0f || (most > 1.0f && whole))) return 1.0f;
  return most > 255.0f ? 65535.0f : 255.0f;
}

float whiteOfIntegers(std::span<const Rgb> colors) {
  return spreadOf(colors).most > 255.0f ? 65535.0f : 255.0f;
}

void noteWhite(float white, Diagnosis& diagnosis) {
  if (white == 1.0f) return;
  diagnosis.add(Severity::Note, "colors-counted", 0,
                "vertex colours go beyond 1: they are taken as sRGB counted to " +
                    std::to_string(int(white)));
}

Rgb linearColor(const Rgb& color, float white) {
  return Rgb(radiometry::srgbDecode(color.x() / white), radiometry::srgbDecode(color.y() / white),
             radiometry::srgbDecode(color.z() / white));
}

}  // namespace lambent::scene_io
