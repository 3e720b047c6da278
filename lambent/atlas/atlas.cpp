// This work is based on:
// - sloan2003biscale: §4.3, "Parameterizing the Surface": charts, their layout, one packed atlas
//   with gutters. There, a person chose the cuts and packed the charts.
// - sander2001texture: §3, L² stretch, by which charts are judged, and reported.
#include "lambent/atlas/atlas.h"

#include <string>
#include <utility>

#include "lambent/atlas/charted_surface.h"
#include "lambent/atlas/own_uvs.h"

namespace lambent::atlas {

Result<WithFindings<Atlas>> makeAtlas(const scene::Mesh& mesh, const AtlasOptions& options,
                                      const Progress& progress) {
  if (options.size < 1 || options.size > 16384)
    return report::badUsage("an atlas must have 1 to 16384 texels a side");
  if (options.gutter < 1 || options.gutter > 256)
    return report::badUsage("gutters of an atlas must be 1 to 256 texels wide");
  if (!mesh.texelUvs.empty()) {  // an atlas is about `uvs`
    scene::Mesh bare = mesh;
    bare.texelUvs.clear();
    return makeAtlas(bare, options, progress);
  }
  WeldedSurface surface = weldedSurface(mesh);
  const std::string name = mesh.name.empty() ? "the mesh" : "mesh \"" + mesh.name + "\"";
  if (!(surface.area > 0.0))
    return report::badInput(name + " has no triangle of any area, and so no surface to lay out");
  Findings findings;
  if (surface.nonManifoldEdges > 0)
    findings.push_back({Severity::Note, "non-manifold-edges",
                        name + ": more than two triangles meet at " +
                            std::to_string(surface.nonManifoldEdges) +
                            " edges, or two are wound against each other; charts end there",
                        surface.nonManifoldEdges});
  if (options.ownUvs) {
    auto own = atlasOfOwnUvs(mesh, surface, options);
    findings.insert(findings.end(), own.findings.begin(), own.findings.end());
    if (own.value) return WithFindings<Atlas>{std::move(*own.value), std::move(findings)};
  }

  Result<ChartedSurface> charted =
      chartedSurface(mesh, std::move(surface), options.maximumStretch, progress, options.cutAt);
  if (!charted) return charted.error();
  Result<Atlas> atlas = packedAtlas(mesh, *charted, {}, {options.size, options.gutter}, progress);
  if (!atlas) return atlas.error();
  return WithFindings<Atlas>{std::move(*atlas), std::move(findings)};
}

}  // namespace lambent::atlas
