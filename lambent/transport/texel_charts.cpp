#include "lambent/transport/texel_charts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <unordered_map>

#include "lambent/math/union_find.h"
#include "lambent/scene/texel_map.h"
#include "lambent/transport/texel_taps.h"

namespace lambent::transport {

namespace {

using scene::kNobody;

/// Look-ups are tried out this often across a texel.
constexpr int kLookupsAcrossTexel = 2;
/// Less of another chart's light than this is not worth a word.
constexpr double kMixed = 0.05, kMixedShare = 0.01;

using Corner = std::array<std::uint32_t, 5>;
struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    std::uint64_t h = 0x9e3779b97f4a7c15ull;
    for (const std::uint32_t b : corner) h = (h ^ b) * 0xff51afd7ed558ccdull, h ^= h >> 32;
    return std::size_t(h);
  }
};

double areaOfUvs(const scene::Mesh& mesh, const scene::Triangle& t) {
  const Vec2d a = scene::texelUvsOf(mesh)[t[0]].cast<double>();
  const Vec2d e = scene::texelUvsOf(mesh)[t[1]].cast<double>() - a,
              f = scene::texelUvsOf(mesh)[t[2]].cast<double>() - a;
  return std::abs(e.x() * f.y() - e.y() * f.x());
}

/// Of a mesh on texels: the chart whose light each texel holds; kNobody for those that show what
/// lies beyond the border of the chart beside them.
std::vector<std::uint32_t> chartOfTexels(const scene::Mesh& mesh,
                                         const PlacedReceivers::PerMesh& place,
                                         const std::vector<std::uint32_t>& charts) {
  const scene::TexelMap map = scene::texelMap(mesh, place.width, place.height);
  std::vector<std::uint32_t> ofReceiver(place.count, kNobody);
  for (std::size_t t = 0; t < map.size(); ++t)
    if (map.covered(t))
      ofReceiver[place.receiverOfTexel[t] - place.first] = charts[map.triangle[t]];
  for (const TinyChart& tiny : tinyCharts(mesh, place.width, place.height))
    for (const std::uint32_t t : tiny.texels) {
      std::uint32_t& chart = ofReceiver[place.receiverOfTexel[t] - place.first];
      if (chart == kNobody) chart = charts[tiny.triangle];
    }
  std::vector<std::uint32_t> ofTexel(map.size());
  for (std::size_t t = 0; t < map.size(); ++t)
    ofTexel[t] = ofReceiver[place.receiverOfTexel[t] - place.first];
  return ofTexel;
}

}  // namespace

std::vector<std::uint32_t> cornersOf(const scene::Mesh& mesh) {
  std::unordered_map<Corner, std::uint32_t, CornerHash> known;
  known.reserve(mesh.positions.size());
  std::vector<std::uint32_t> ids(mesh.positions.size());
  for (std::size_t v = 0; v < ids.size(); ++v) {
    const Vec3 p = mesh.positions[v] + Vec3::Zero();  // −0 equals +0
    const Vec2 uv = scene::texelUvsOf(mesh)[v] + Vec2::Zero();
    const Corner corner = {std::bit_cast<std::uint32_t>(p.x()), std::bit_cast<std::uint32_t>(p.y()),
                           std::bit_cast<std::uint32_t>(p.z()),
                           std::bit_cast<std::uint32_t>(uv.x()),
                           std::bit_cast<std::uint32_t>(uv.y())};
    ids[v] = known.try_emplace(corner, std::uint32_t(known.size())).first->second;
  }
  return ids;
}

std::vector<std::uint32_t> chartsOf(const scene::Mesh& mesh) {
  const std::vector<std::uint32_t> corners = cornersOf(mesh);
  math::UnionFind joined(mesh.positions.size());
  for (const scene::Triangle& t : mesh.triangles)
    for (int k = 1; k < 3; ++k) joined.join(corners[t[k]], corners[t[0]]);
  std::vector<std::uint32_t> numbers(mesh.positions.size(), kNobody), charts;
  charts.reserve(mesh.triangles.size());
  std::uint32_t count = 0;
  for (const scene::Triangle& t : mesh.triangles) {
    std::uint32_t& number = numbers[joined.rootOf(corners[t[0]])];
    if (number == kNobody) number = count++;
    charts.push_back(number);
  }
  return charts;
}

std::vector<TinyChart> tinyCharts(const scene::Mesh& mesh, int width, int height) {
  const std::vector<std::uint32_t> charts = chartsOf(mesh);
  std::vector<std::uint32_t> largest;  // triangle of each chart; kNobody: the chart has a texel
  std::vector<double> areas;
  std::vector<std::uint8_t> held;
  for (std::uint32_t t = 0; t < charts.size(); ++t) {
    if (charts[t] >= largest.size()) {
      largest.resize(charts[t] + 1, t), areas.resize(charts[t] + 1, -1.0);
      held.resize(charts[t] + 1, 0);
    }
    const double area = areaOfUvs(mesh, mesh.triangles[t]);
    if (area > areas[charts[t]]) areas[charts[t]] = area, largest[charts[t]] = t;
    if (!held[charts[t]])
      scene::visitTexels(mesh, mesh.triangles[t], width, height,
                         [&](int, int, double, double) { held[charts[t]] = 1; });
  }
  std::vector<TinyChart> tiny;
  for (std::size_t c = 0; c < largest.size(); ++c) {
    if (held[c]) continue;
    const scene::Triangle& t = mesh.triangles[largest[c]];
    const Vec2 middle = (scene::texelUvsOf(mesh)[t[0]] + scene::texelUvsOf(mesh)[t[1]] +
                         scene::texelUvsOf(mesh)[t[2]]) /
                        3.0f;
    const TexelTaps taps = tapsAt(middle, width, height);
    TinyChart& chart = tiny.emplace_back(TinyChart{largest[c], {}});
    for (const std::uint32_t texel : taps.texels)
      if (std::find(chart.texels.begin(), chart.texels.end(), texel) == chart.texels.end())
        chart.texels.push_back(texel);
  }
  return tiny;
}

Findings chartFindings(const scene::Scene& scene, const PlacedReceivers& receivers) {
  std::uint64_t homeless = 0, close = 0;
  std::string firstHomeless, firstClose;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const scene::Mesh& mesh = scene.meshes[m];
    const PlacedReceivers::PerMesh& place = receivers.meshes[m];
    if (place.layout != Layout::Texels) continue;
    const std::string name = mesh.name.empty() ? "mesh " + std::to_string(m) : mesh.name;
    const std::vector<std::uint32_t> charts = chartsOf(mesh);
    const std::vector<std::uint32_t> ofTexel = chartOfTexels(mesh, place, charts);
    for (const TinyChart& tiny : tinyCharts(mesh, place.width, place.height)) {
      const bool has = std::any_of(tiny.texels.begin(), tiny.texels.end(), [&](std::uint32_t t) {
        return ofTexel[t] == charts[tiny.triangle];
      });
      if (!has && homeless++ == 0) firstHomeless = name;
    }
    std::uint64_t lookups = 0, mixed = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      scene::visitTexels(mesh, mesh.triangles[t], kLookupsAcrossTexel * place.width,
                         kLookupsAcrossTexel * place.height, [&](int x, int y, double, double) {
                           const TexelTaps taps = tapsAt((x + 0.5) / kLookupsAcrossTexel - 0.5,
                                                         (y + 0.5) / kLookupsAcrossTexel - 0.5,
                                                         place.width, place.height);
                           double other = 0.0;
                           for (int k = 0; k < 4; ++k) {
                             const std::uint32_t chart = ofTexel[taps.texels[k]];
                             if (chart != charts[t] && chart != kNobody) other += taps.weights[k];
                           }
                           ++lookups;
                           mixed += other > kMixed;
                         });
    if (double(mixed) > kMixedShare * double(lookups) && close++ == 0)
      firstClose = name + ", " + std::to_string(100 * mixed / lookups) + "% of its texels";
  }
  Findings findings;
  if (homeless > 0)
    findings.push_back(
        {Severity::Warning, "uvs-tiny-charts",
         std::to_string(homeless) +
             " charts are smaller than a texel and find none of their own: they take "
             "another chart's light; ask for more texels, give them more of the "
             "layout, or bake at vertices (first: " +
             firstHomeless + ")",
         homeless});
  if (close > 0)
    findings.push_back(
        {Severity::Warning, "uvs-without-gutter",
         std::to_string(close) +
             " meshes have charts so close to each other that look-ups between texels "
             "mix their light along their borders; leave 2 texels between charts, ask "
             "for more texels, or bake at vertices (first: " +
             firstClose + ")",
         close});
  return findings;
}

}  // namespace lambent::transport
