// Polygons → triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/scene/scene.h"

namespace lambent::scene_io {

/// Cuts a polygon, given by its corners in sequence, into triangles of corner numbers: by ears, so
/// that it need not be convex (meisters1975polygons). Corners beyond 64 are cut as a fan, which
/// bounds the time that a hostile file can take. Appends n−2 triangles.
void cutPolygon(std::span<const Vec3d> corners, std::vector<scene::Triangle>& triangles);

}  // namespace lambent::scene_io
