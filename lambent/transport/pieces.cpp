#include "lambent/transport/pieces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lambent/scene/texel_map.h"

namespace lambent::transport {

namespace {

constexpr int kRowsInTriangle = 6;
constexpr int kPlacesAcrossTexel = 4;

void addWeight(PlaceInPiece& place, std::uint32_t receiver, float weight) {
  if (!(weight > 0.0f)) return;
  for (auto& [known, sum] : place.weights)
    if (known == receiver) {
      sum += weight;
      return;
    }
  place.weights.emplace_back(receiver, weight);
}

/// The middles of the triangles into which a triangle is cut, kRowsInTriangle along each side.
std::vector<Vec2> middles() {
  std::vector<Vec2> all;
  constexpr float side = 1.0f / kRowsInTriangle;
  for (int i = 0; i < kRowsInTriangle; ++i)
    for (int j = 0; i + j < kRowsInTriangle; ++j) {
      all.push_back(side * Vec2(float(i) + 1.0f / 3.0f, float(j) + 1.0f / 3.0f));
      if (i + j + 1 < kRowsInTriangle)
        all.push_back(side * Vec2(float(i) + 2.0f / 3.0f, float(j) + 2.0f / 3.0f));
    }
  return all;
}

/// The corner to count from: the same one however a file turns the triangle.
std::size_t firstCornerOf(const scene::Mesh& mesh, const scene::Triangle& corners) {
  const auto placeOf = [&](std::size_t k) {
    const Vec3& p = mesh.positions[corners[k]];
    return std::array<float, 3>{p.x(), p.y(), p.z()};
  };
  std::size_t first = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (placeOf(k) < placeOf(first)) first = k;
  return first;
}

std::vector<std::vector<PlaceInPiece>> trianglesAt(const scene::Mesh& mesh,
                                                   const PlacedReceivers::PerMesh& place,
                                                   std::span<const std::uint8_t> chosen) {
  std::vector<std::vector<PlaceInPiece>> pieces;
  const std::vector<Vec2> places = middles();
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const scene::Triangle& corners = mesh.triangles[t];
    if (std::none_of(corners.begin(), corners.end(),
                     [&](std::uint32_t v) { return chosen[place.first + v] != 0; }))
      continue;
    std::vector<PlaceInPiece>& piece = pieces.emplace_back();
    const std::size_t first = firstCornerOf(mesh, corners);
    for (const Vec2& at : places) {
      const float inTurn[3] = {1.0f - at.x() - at.y(), at.x(), at.y()};
      float weights[3];
      for (std::size_t k = 0; k < 3; ++k) weights[(first + k) % 3] = inTurn[k];
      PlaceInPiece& here = piece.emplace_back(PlaceInPiece{t, weights[1], weights[2], {}});
      for (std::size_t k = 0; k < 3; ++k)
        addWeight(here, place.first + corners[(first + k) % 3], inTurn[k]);
    }
  }
  return pieces;
}

/// Cells lie between the centres of texels, and half a texel beyond them at the grid's border, where
/// look-ups are clamped.
std::vector<std::vector<PlaceInPiece>> cellsAt(const scene::Mesh& mesh,
                                               const PlacedReceivers::PerMesh& place,
                                               std::span<const std::uint8_t> chosen) {
  const int width = place.width, height = place.height;
  const auto receiverAt = [&](int x, int y) {
    return place.receiverOfTexel[std::size_t(std::clamp(y, 0, height - 1)) * width +
                                 std::clamp(x, 0, width - 1)];
  };
  constexpr std::uint32_t kNone = 0xffffffffu;
  std::vector<std::uint32_t> pieceOfCell(std::size_t(width + 1) * (height + 1), kNone);
  std::uint32_t count = 0;
  for (int y = 0; y <= height; ++y)
    for (int x = 0; x <= width; ++x)
      if (chosen[receiverAt(x - 1, y - 1)] || chosen[receiverAt(x, y - 1)] ||
          chosen[receiverAt(x - 1, y)] || chosen[receiverAt(x, y)])
        pieceOfCell[std::size_t(y) * (width + 1) + x] = count++;
  std::vector<std::vector<PlaceInPiece>> pieces(count);
  if (count == 0) return pieces;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    scene::visitTexels(
        mesh, mesh.triangles[t], kPlacesAcrossTexel * width, kPlacesAcrossTexel * height,
        [&](int fineX, int fineY, double u, double v) {
          const float x = (float(fineX) + 0.5f) / kPlacesAcrossTexel - 0.5f;
          const float y = (float(fineY) + 0.5f) / kPlacesAcrossTexel - 0.5f;
          const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
          const std::uint32_t piece = pieceOfCell[std::size_t(top + 1) * (width + 1) + left + 1];
          if (piece == kNone) return;
          PlaceInPiece here{t, static_cast<float>(u), static_cast<float>(v), {}};
          const float a = x - float(left), b = y - float(top);
          addWeight(here, receiverAt(left, top), (1.0f - a) * (1.0f - b));
          addWeight(here, receiverAt(left + 1, top), a * (1.0f - b));
          addWeight(here, receiverAt(left, top + 1), (1.0f - a) * b);
          addWeight(here, receiverAt(left + 1, top + 1), a * b);
          pieces[piece].push_back(std::move(here));
        });
  return pieces;
}

}  // namespace

std::vector<std::vector<PlaceInPiece>> piecesAt(const scene::Mesh& mesh,
                                                const PlacedReceivers::PerMesh& place,
                                                std::span<const std::uint8_t> chosen) {
  const auto here = chosen.subspan(place.first, place.count);
  if (std::find(here.begin(), here.end(), 1) == here.end()) return {};
  return place.layout == Layout::Texels ? cellsAt(mesh, place, chosen)
                                        : trianglesAt(mesh, place, chosen);
}

}  // namespace lambent::transport
