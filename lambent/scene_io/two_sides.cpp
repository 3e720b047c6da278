#include "lambent/scene_io/two_sides.h"

#include <algorithm>
#include <cstdint>

#include "lambent/scene/sheets.h"
#include "lambent/scene/weld.h"
#include "lambent/scene_io/mesh_bytes.h"

namespace lambent::scene_io {
namespace {

struct SidedEdge {
  std::uint64_t ends;  ///< smaller position's number above the larger one's
  std::uint32_t mesh;
  bool upwards;  ///< begins at the smaller
};

/// All edges of some meshes, with positions that are equal taken as one, edges of equal ends side by
/// side.
std::vector<SidedEdge> edgesOf(const scene::Scene& scene, const std::vector<bool>& chosen) {
  scene::Mesh all;
  for (std::size_t m = 0; m < chosen.size(); ++m)
    if (chosen[m])
      all.positions.insert(all.positions.end(), scene.meshes[m].positions.begin(),
                           scene.meshes[m].positions.end());
  const std::vector<std::uint32_t> places = scene::weldPositions(all);
  std::vector<SidedEdge> edges;
  std::size_t first = 0;
  for (std::size_t m = 0; m < chosen.size(); ++m) {
    if (!chosen[m]) continue;
    for (const scene::Triangle& t : scene.meshes[m].triangles)
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = places[first + t[std::size_t(k)]],
                            b = places[first + t[std::size_t((k + 1) % 3)]];
        if (a != b)
          edges.push_back(
              {std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), std::uint32_t(m), a < b});
      }
    first += scene.meshes[m].positions.size();
  }
  std::sort(edges.begin(), edges.end(),
            [](const SidedEdge& a, const SidedEdge& b) { return a.ends < b.ends; });
  return edges;
}

/// Of the chosen meshes those that do not bound a body: a surface does where as many triangles run
/// along each edge one way as the other, be they of one mesh or of several, one for each material.
std::vector<bool> openOnes(const scene::Scene& scene, const std::vector<bool>& chosen) {
  std::vector<bool> open(chosen.size(), false);
  const std::vector<SidedEdge> edges = edgesOf(scene, chosen);
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    std::int64_t balance = 0;
    for (; last < edges.size() && edges[last].ends == edges[first].ends; ++last)
      balance += edges[last].upwards ? 1 : -1;
    if (balance == 0) continue;
    for (std::size_t i = first; i < last; ++i) open[edges[i].mesh] = true;
  }
  return open;
}

std::string placeOf(const scene::Mesh& mesh, std::size_t number) {
  return "mesh " + (mesh.name.empty() ? std::to_string(number) : "\"" + mesh.name + "\"");
}

}  // namespace

Result<std::vector<bool>> giveBacks(scene::Scene& scene, Sides sides, const std::string& name,
                                    file::Budget& budget, Diagnosis& diagnosis) {
  std::vector<bool> chosen(scene.meshes.size(), sides == Sides::Two);
  if (sides != Sides::Two) {
    for (std::size_t m = 0; m < chosen.size(); ++m)
      chosen[m] = scene.materials[std::size_t(scene.meshes[m].material)].doubleSided;
    if (std::find(chosen.begin(), chosen.end(), true) != chosen.end())
      chosen = openOnes(scene, chosen);
  }
  for (std::size_t m = 0; m < chosen.size(); ++m) {
    if (!chosen[m]) continue;
    scene::Mesh& mesh = scene.meshes[m];
    const std::string place = placeOf(mesh, m);
    if (sides == Sides::One) {
      diagnosis.add(Severity::Note, "one-sided", 1,
                    "meshes have two sides and are open, and were taken as one-sided: their backs "
                    "are black",
                    place);
      continue;
    }
    if (Status fits = budget.hold(bytesOf(mesh), name + ": the back of " + place); !fits)
      return fits.error();
    mesh = scene::withBacks(std::move(mesh));
    diagnosis.add(Severity::Note, "two-sided", 1,
                  "meshes have two sides and were given backs of their own, which are lit and seen "
                  "as their fronts are: twice the vertices. --sides one leaves the fronts alone",
                  place);
  }
  if (sides == Sides::One) chosen.assign(chosen.size(), false);
  for (std::size_t m = 0; m < chosen.size(); ++m)
    if (chosen[m]) scene.materials[std::size_t(scene.meshes[m].material)].doubleSided = false;
  return chosen;
}

}  // namespace lambent::scene_io
