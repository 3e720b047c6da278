// Polygons → triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lambent/scene/scene.h"
#include "lambent/scene_io/diagnosis.h"

namespace lambent::scene_io {

/// Cuts a polygon of any size, given by its corners in sequence, into triangles of corner numbers:
/// by ears, so that it need not be convex, and may touch itself, as one with holes does
/// (meisters1975polygons). Appends n−2 triangles. False if the polygon crosses itself or is so
/// entangled that the work was broken off: then some of them cover what they should not.
bool cutPolygon(std::span<const Vec3d> corners, std::vector<scene::Triangle>& triangles);

/// The finding for `count` polygons of which that was false.
void noteCrossing(std::size_t count, Diagnosis& diagnosis);

}  // namespace lambent::scene_io
