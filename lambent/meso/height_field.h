// A height field that repeats itself → Patch.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lambent/meso/patch.h"

namespace lambent::meso {

/// Heights on a grid over one period. Sample (x, y) stands at ((x+½)/width, (y+½)/height) · size;
/// row 0 is the lowest, at y = 0. The last column is followed by the first.
struct HeightField {
  int width = 0, height = 0;
  std::vector<float> heights;  ///< metres, [y][x]
  std::vector<Rgb> colors;     ///< diffuse reflectance of each sample, or empty: the material's
  float at(int x, int y) const { return heights[std::size_t(y) * width + x]; }
};

/// Two triangles between any four neighbouring samples, across the period's border too, with smooth
/// normals from central differences. The shorter diagonal of each cell is its crease. width, height
/// ≥ 2. UVs run over the period, v downwards from the top row, for a material with a base-colour
/// texture.
Patch patchOf(const HeightField& field, const Vec2& size, const scene::Material& material,
              std::string name);

/// Makes opposite borders meet: within `margin` (a fraction of the width and height, 0 … 0.5) of
/// each border, heights and colours fade into their own copy moved by half a period, which is
/// continuous where the original is not. What lies deeper inside is left as it is.
HeightField withBlendedBorders(const HeightField& field, float margin);

}  // namespace lambent::meso
