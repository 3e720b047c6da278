// This work is based on:
// - sloan2003biscale: §4.3, the id map in three steps (synthesise, parameterise, look up), and
//   §4.1, matrices at the vertices; the frames of both are the same tangent field.
//
// Where we deviate, and why: the surface is laid out first and the tangent field computed on what
// that leaves, so that vertices doubled along the borders of charts get the same tangent.
#include "lambent/bi_scale/spread_patch.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "lambent/bi_scale/layers.h"
#include "lambent/bi_scale/quoted_mesh.h"
#include "lambent/bi_scale/uv_frames.h"
#include "lambent/scene/flaps.h"
#include "lambent/scene/layers.h"
#include "lambent/scene/split_edges.h"
#include "lambent/synthesis/appearance.h"
#include "lambent/synthesis/cross_field.h"
#include "lambent/synthesis/lattice_map.h"
#include "lambent/synthesis/meso_mesh.h"
#include "lambent/synthesis/patch_pieces.h"
#include "lambent/synthesis/place_ids.h"
#include "lambent/synthesis/synthesize.h"
#include "lambent/synthesis/tangent_field.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transfer/encode.h"

namespace lambent::bi_scale {

namespace {

constexpr std::uint32_t kMostMesoVertices = 960000;
constexpr double kAutomaticPatches = 200.0;

/// Names a stage that first speaks when it has got somewhere, so that its time counts from here.
void announce(const Progress& progress, std::string_view stage) {
  if (progress) (void)progress({stage, 0, 0, ""});
}

/// Names a stage that does not say how far it is, when it begins and when it ends.
template <class Work>
auto staged(const Progress& progress, std::string_view stage, Work&& work) {
  announce(progress, stage);
  auto result = work();
  announce(progress, stage);  // its last update, too
  return result;
}

/// Where a mesh carries the patch.
struct Placed {
  std::uint32_t mesh = 0;
  transfer::Patch patch;
};

Error named(const Error& error, const scene::Mesh& mesh, std::uint32_t index) {
  if (error.kind == ErrorKind::Cancelled) return error;
  return {error.kind, quoted(mesh, index) + ": " + error.message};
}

Result<std::vector<std::uint32_t>> chosenMeshes(const scene::Scene& scene,
                                                const SpreadOptions& options) {
  const auto isMirror = [&](std::uint32_t m) {
    return scene.materials[std::size_t(scene.meshes[m].material)].isMirror();
  };
  std::vector<std::uint32_t> chosen = options.meshes;
  if (chosen.empty())
    for (std::uint32_t m = 0; m < scene.meshes.size(); ++m)
      if (!isMirror(m)) chosen.push_back(m);
  for (const std::uint32_t m : chosen) {
    if (m >= scene.meshes.size()) return report::badUsage("there is no mesh " + std::to_string(m));
    if (isMirror(m))
      return report::badInput(quoted(scene.meshes[m], m) +
                              " is a mirror: meso-structure can not be spread over it");
  }
  if (chosen.empty())
    return report::badInput("the scene has no mesh to spread the patch over: all are mirrors");
  return chosen;
}

/// Materials and textures that nothing uses any more would only make the file larger.
void dropUnused(scene::Scene& scene) {
  std::vector<int> materialAt(scene.materials.size(), -1), textureAt(scene.textures.size(), -1);
  std::vector<scene::Material> materials;
  std::vector<scene::Texture> textures;
  for (scene::Mesh& mesh : scene.meshes) {
    int& at = materialAt[std::size_t(mesh.material)];
    if (at < 0) {
      at = int(materials.size());
      scene::Material& material = materials.emplace_back(scene.materials[mesh.material]);
      if (material.baseColorTexture >= 0) {
        int& texture = textureAt[std::size_t(material.baseColorTexture)];
        if (texture < 0) {
          texture = int(textures.size());
          textures.push_back(std::move(scene.textures[std::size_t(material.baseColorTexture)]));
        }
        material.baseColorTexture = texture;
      }
    }
    mesh.material = at;
  }
  scene.materials = std::move(materials);
  scene.textures = std::move(textures);
}

/// That of a mesh's base colour, or null.
const scene::Texture* textureOf(const scene::Scene& scene, std::uint32_t mesh) {
  const int texture = scene.materials[std::size_t(scene.meshes[mesh].material)].baseColorTexture;
  const bool has = texture >= 0 && !scene.meshes[mesh].uvs.empty();
  return has ? &scene.textures[std::size_t(texture)] : nullptr;
}

/// What the encoding of the matrices costs: relative RMS, of the most that is held.
double matrixError(const transfer::BiScale<transfer::Floats>& exact,
                   const transfer::BiScale<transfer::Numbers>& encoded) {
  const auto most = exact.matrices.most();
  return most ? transfer::encodingError(exact.matrices.find(*most)->numbers,
                                        encoded.matrices.find(*most)->numbers)
              : 0.0;
}

std::string nameOf(const transfer::EncodedRtt& rtt) {
  return rtt.name.empty() ? "meso-structure" : rtt.name;
}

/// Lays one patch over meshes.
struct Spreader {
  scene::Scene& scene;
  const transfer::EncodedRtt& rtt;
  const SpreadOptions& options;
  const Progress& progress;
  Findings& findings;
  Spread& out;
  std::optional<synthesis::Appearance> appearance;  ///< made once for all meshes
  synthesis::PatchPieces pieces;                    ///< with it
  std::optional<synthesis::PatchSymmetry> symmetry;

  /// Over the mesh of `placed`, which wears it.
  Status lay(float width, SpreadReport& report, Placed& placed, std::vector<Vec3>& tangents) {
    report.patch = nameOf(rtt);
    report.patchWidth = width;
    count(placed, report);
    const Status status = options.placement == Placement::OwnUvs
                              ? byOwnUvs(placed.mesh, report, placed, tangents)
                              : bySynthesis(placed.mesh, report, placed, tangents);
    if (status) count(placed, report);
    return status;
  }

  /// How much of it there is.
  void count(Placed& placed, SpreadReport& report) const {
    const scene::Mesh& mesh = scene.meshes[placed.mesh];
    placed.patch.scale = report.patchWidth / rtt.size.x();
    report.area = areaOf(mesh);
    report.patches = report.area / (double(placed.patch.scale) * placed.patch.scale * rtt.size.x() *
                                    rtt.size.y());
    report.vertices = std::uint32_t(mesh.positions.size());
  }

  Status byOwnUvs(std::uint32_t index, SpreadReport& report, Placed& placed,
                  std::vector<Vec3>& tangents) {
    const scene::Mesh& mesh = scene.meshes[index];
    auto frames = uvTangents(mesh);
    if (!frames) return named(frames.error(), mesh, index);
    findings.insert(findings.end(), frames->findings.begin(), frames->findings.end());
    tangents = std::move(frames->value);
    const Vec2 metres = metresPerUv(mesh);
    const float aspect = rtt.size.y() / rtt.size.x();
    Vec2 tiles = options.tiles;
    // Whole numbers, so that a surface closed in u or v stays without a seam.
    if (!(tiles.x() > 0.0f)) tiles.x() = std::max(1.0f, std::round(metres.x() / report.patchWidth));
    if (!(tiles.y() > 0.0f))
      tiles.y() = std::max(1.0f, std::round(metres.y() / (report.patchWidth * aspect)));
    placed.patch.place = transfer::Tiles{tiles};
    report.patchWidth = metres.x() / tiles.x();
    report.ownUvs = true;
    const Vec2 asked(metres.x() / tiles.x(), metres.y() / tiles.y());
    const float squash = asked.y() / (asked.x() * aspect);
    if (squash > 1.5f || squash < 1.0f / 1.5f)
      findings.push_back(
          {Severity::Warning, "patch-stretched",
           quoted(mesh, index) + ": in the mean its UVs stretch the patch to " +
               std::to_string(squash).substr(0, 4) +
               " times its height over its width: shadows inside the patch were computed for 1",
           1});
    return Status::ok();
  }

  Status bySynthesis(std::uint32_t index, SpreadReport& report, Placed& placed,
                     std::vector<Vec3>& tangents) {
    if (!symmetry)
      symmetry = staged(progress, "symmetry of the patch",
                        [&] { return synthesis::symmetryOf(transfer::decode(rtt)); });
    report.symmetry = *symmetry;
    const bool lattice = options.layout == Layout::Automatic ? symmetry->regular()
                                                             : options.layout == Layout::Lattice;
    report.layout = lattice ? Layout::Lattice : Layout::Pieces;
    return lattice ? byLattice(index, report, placed, tangents)
                   : byPieces(index, report, placed, tangents);
  }

  /// The texture that tints a mesh, laid out as its atlas is.
  void tintAnew(std::uint32_t index, const atlas::Atlas& atlas) {
    const scene::Texture* tint = textureOf(scene, index);
    if (!tint) return;
    announce(progress, "tint");
    std::vector<Vec2> uvs;
    for (const std::uint32_t v : atlas.sourceVertex) uvs.push_back(scene.meshes[index].uvs[v]);
    // The atlas keeps its charts so many of its texels apart.
    const int size = options.atlas.size, gutter = std::max(options.atlas.gutter, 2);
    scene::Texture made = laidOut(*tint, uvs, atlas.mesh, (2 * size + gutter - 1) / gutter, size);
    scene::Material& worn = scene.materials[std::size_t(scene.meshes[index].material)];
    worn.baseColorTexture = int(scene.textures.size());
    scene.textures.push_back(std::move(made));
  }

  /// Lays the surface out; the mesh becomes the atlas's.
  Result<atlas::Atlas> atlasOf(std::uint32_t index, const atlas::AtlasOptions& how,
                               SpreadReport& report) {
    announce(progress, "charts");
    scene::Mesh& mesh = scene.meshes[index];
    auto laidOut = atlas::makeAtlas(mesh, how, progress);
    if (!laidOut) return named(laidOut.error(), mesh, index);
    findings.insert(findings.end(), laidOut->findings.begin(), laidOut->findings.end());
    atlas::Atlas& atlas = laidOut->value;
    if (!atlas.ownUvs) tintAnew(index, atlas);
    const int material = mesh.material;
    mesh = atlas.mesh;
    mesh.material = material;
    mesh.source.uvSet = -1;
    report.charts = atlas.charts;
    report.stretch = atlas.stretch, report.worstStretch = atlas.worstStretch;
    report.usedArea = atlas.usedArea, report.ownUvs = atlas.ownUvs;
    return std::move(atlas);
  }

  /// What steers a mesh at its vertices, before it is laid out.
  Result<std::vector<synthesis::Guide>> guidesFor(std::uint32_t index, SpreadReport& report) {
    using Guides = std::vector<synthesis::Guide>;
    const scene::Mesh& mesh = scene.meshes[index];
    Result<Guides> guides = Guides();
    if (const auto* curves = std::get_if<CurveSteering>(&options.steering))
      guides = guidesBy(*curves, mesh);
    else if (const auto* picture = std::get_if<PictureSteering>(&options.steering))
      guides = guidesBy(*picture, mesh);
    if (!guides) return named(guides.error(), mesh, index);
    if (guides->empty()) return guides;
    const auto steered = std::count_if(guides->begin(), guides->end(),
                                       [](const auto& guide) { return guide.weight > 0.0f; });
    report.guided = double(steered) / double(guides->size());
    if (steered == 0)
      findings.push_back({Severity::Warning, "steers-nothing",
                          quoted(mesh, index) +
                              ": no vertex is near a curve, or under a colour other than grey: "
                              "--direction steers nothing here",
                          1});
    return guides;
  }

  Result<synthesis::TangentField> fieldOf(std::uint32_t index, int turns,
                                          std::vector<synthesis::Guide> guides,
                                          SpreadReport& report) {
    const scene::Mesh& mesh = scene.meshes[index];
    synthesis::TangentFieldOptions how;
    if (const auto* direction = std::get_if<Vec3>(&options.steering)) how.direction = *direction;
    how.guides = std::move(guides);
    how.align = options.align;
    how.turns = turns;
    auto combed =
        staged(progress, "tangent field", [&] { return synthesis::tangentField(mesh, how); });
    if (!combed) return named(combed.error(), mesh, index);
    report.featureLines = combed->value.featureLines;
    report.alignedLines = combed->value.alignedLines;
    findings.insert(findings.end(), combed->findings.begin(), combed->findings.end());
    return std::move(combed->value);
  }

  Status byLattice(std::uint32_t index, SpreadReport& report, Placed& placed,
                   std::vector<Vec3>& tangents) {
    auto guides = guidesFor(index, report);
    if (!guides) return guides.error();
    auto combed = fieldOf(index, symmetry->turns, std::move(*guides), report);
    if (!combed) return combed.error();
    const synthesis::Manifold manifold = synthesis::manifoldOf(scene.meshes[index]);
    synthesis::CrossField field =
        synthesis::crossField(scene.meshes[index], manifold, combed->tangents, symmetry->turns);
    atlas::AtlasOptions how = options.atlas;
    for (const auto& s : field.singularities) how.cutAt.push_back(manifold.firstCorner[s.vertex]);
    // Where the patch turns, charts end: own UVs would have it turn in their midst.
    how.ownUvs = how.ownUvs && how.cutAt.empty();
    auto atlas = atlasOf(index, how, report);
    if (!atlas) return atlas.error();
    synthesis::comb(manifold, atlas->chartOfTriangle, field);

    const scene::Mesh& mesh = scene.meshes[index];
    const Vec2 patch = placed.patch.scale * rtt.size;
    announce(progress, "lattice");
    auto map =
        synthesis::latticeMap(manifold, field, atlas->chartOfTriangle, *symmetry, patch, progress);
    if (!map) return named(map.error(), mesh, index);
    auto ids = staged(progress, "id map",
                      [&] { return synthesis::placeIds(*atlas, *map, options.atlas.size); });
    if (!ids) return named(ids.error(), mesh, index);
    placed.patch.place = std::move(*ids);
    tangents = synthesis::vertexTangents(mesh, *map);
    report.singularities = std::uint32_t(field.singularities.size());
    report.continued = map->edges > 0 ? double(map->continued) / double(map->edges) : 1.0;
    report.flipped = map->flipped, report.squeezed = map->squeezed;
    report.sizeError = map->stretch;
    if (map->flipped > 0.01)
      findings.push_back(
          {Severity::Warning, "patch-folded",
           quoted(mesh, index) + ": the patch is folded over " +
               std::to_string(int(std::ceil(100.0 * map->flipped))) +
               "% of the surface, whose shapes are too small for whole cells of it: lay a smaller "
               "patch (--patch-width), or pieces of it (--layout pieces)",
           1});
    out.atlases.push_back(std::move(*atlas));
    return Status::ok();
  }

  Status byPieces(std::uint32_t index, SpreadReport& report, Placed& placed,
                  std::vector<Vec3>& tangents) {
    auto guides = guidesFor(index, report);
    if (!guides) return guides.error();
    auto atlas = atlasOf(index, options.atlas, report);
    if (!atlas) return atlas.error();
    const scene::Mesh& mesh = scene.meshes[index];
    if (!guides->empty())
      for (std::size_t v = guides->size(); v < mesh.positions.size(); ++v)
        guides->push_back(synthesis::Guide((*guides)[atlas->sourceVertex[v]]));
    auto field = fieldOf(index, 1, std::move(*guides), report);
    if (!field) return field.error();

    const Vec2 patch = placed.patch.scale * rtt.size;
    const double positions = report.patches * rtt.width * rtt.height;
    synthesis::MesoMeshOptions mesoOptions;
    mesoOptions.vertices =
        options.mesoVertices > 0
            ? options.mesoVertices
            : std::uint32_t(std::clamp(std::ceil(positions), 1024.0, double(kMostMesoVertices)));
    mesoOptions.seed = options.seed;
    announce(progress, "meso-mesh");
    auto meso = synthesis::mesoMesh(mesh, *field, mesoOptions, progress);
    if (!meso) return named(meso.error(), mesh, index);

    if (!appearance) {
      appearance = staged(progress, "appearance", [&] {
        const auto responses = transfer::decode(rtt);
        pieces = synthesis::piecesOf(synthesis::lookOf(responses));
        return synthesis::appearanceOf(responses);
      });
    }
    synthesis::SynthesisOptions synthesisOptions;
    synthesisOptions.patchSize = patch;
    synthesisOptions.randomness =
        options.randomness.value_or(0.5f * (1.0f - float(synthesis::regularityOf(*appearance))));
    report.randomness = synthesisOptions.randomness;
    synthesisOptions.seed = options.seed;
    synthesisOptions.pieces = &pieces;
    announce(progress, "texture synthesis");
    auto coordinates = synthesis::synthesize(*meso, *appearance, synthesisOptions, progress);
    if (!coordinates) return named(coordinates.error(), mesh, index);

    announce(progress, "id map");
    auto ids = synthesis::placeIds(*atlas, *meso, *coordinates,
                                   {.size = options.atlas.size, .patchSize = patch}, progress);
    if (!ids) return named(ids.error(), mesh, index);

    placed.patch.place = std::move(*ids);
    tangents = std::move(field->tangents);
    report.mesoVertices = std::uint32_t(meso->positions.size());
    report.singularities = std::uint32_t(field->singularities.size());
    out.atlases.push_back(std::move(*atlas));
    return Status::ok();
  }
};

}  // namespace

double areaOf(const scene::Mesh& mesh) {
  double area = 0.0;
  for (const scene::Triangle& t : mesh.triangles)
    area += 0.5 * double((mesh.positions[t[1]] - mesh.positions[t[0]])
                             .cross(mesh.positions[t[2]] - mesh.positions[t[0]])
                             .norm());
  return area;
}

float automaticPatchWidth(double area, const transfer::EncodedRtt& rtt,
                          std::uint32_t mesoVertices) {
  const double vertices = mesoVertices > 0 ? mesoVertices : kMostMesoVertices;
  const double patches = std::min(kAutomaticPatches, vertices / (double(rtt.width) * rtt.height));
  const double aspect = double(rtt.size.y()) / rtt.size.x();
  return float(std::sqrt(area / (patches * aspect)));
}

namespace {

/// Metres of a surface of `area` m² that a patch's width covers, if so many are asked for.
float widthOf(const transfer::EncodedRtt& patch, float asked, double area,
              const SpreadOptions& options) {
  return asked > 0.0f ? asked : automaticPatchWidth(area, patch, options.mesoVertices);
}

float askedFor(const PatchOver& over, const SpreadOptions& options) {
  return over.patchWidth.value_or(options.patchWidth);
}

double areaOfAll(const scene::Scene& scene, const std::vector<std::uint32_t>& meshes) {
  double area = 0.0;
  for (const std::uint32_t m : meshes) area += areaOf(scene.meshes[m]);
  return area;
}

/// The shortest period of all patches, metres of the surface.
float shortestPeriod(double area, const transfer::EncodedRtt& rtt, const SpreadOptions& options) {
  const auto period = [&](const transfer::EncodedRtt& patch, float asked) {
    return widthOf(patch, asked, area, options) * std::min(1.0f, patch.size.y() / patch.size.x());
  };
  float shortest = period(rtt, options.patchWidth);
  for (const PatchOver& over : options.over)
    shortest = std::min(shortest, period(over.rtt, askedFor(over, options)));
  return shortest;
}

/// What is wrong with what is asked for, or all is well.
Status checkPatches(const transfer::EncodedRtt& rtt, const SpreadOptions& options) {
  if (options.over.size() > 3)
    return report::badUsage(
        "a mask has red, green and blue: " + std::to_string(options.over.size()) +
        " patches over the first are " + "more than it can show");
  const auto fits = [&](const transfer::EncodedRtt& one) {
    return one.bands == options.transfer.bands;
  };
  if (!fits(rtt))
    return report::badUsage("the transfer has " + std::to_string(options.transfer.bands) +
                            " bands and the RTT " + std::to_string(rtt.bands) +
                            ": they have to be the same");
  for (const PatchOver& over : options.over)
    if (!fits(over.rtt))
      return report::badUsage("the first RTT has " + std::to_string(rtt.bands) + " bands and \"" +
                              over.rtt.name + "\" " + std::to_string(over.rtt.bands) +
                              ": patches over one mesh have to have the same");
  return Status::ok();
}

/// The layers of each patch over the first.
Result<std::vector<std::vector<Layer>>> addLayers(scene::Scene& scene, const SpreadOptions& options,
                                                  std::vector<SpreadReport>& bases,
                                                  Findings& findings) {
  std::vector<std::vector<Layer>> all(options.over.size());
  for (SpreadReport& base : bases) {
    std::vector<std::uint32_t> added;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const PatchOver& over = options.over[k];
      auto layer = addLayer(scene, base.mesh, nameOf(over.rtt), over.albedo.max(0.0f).min(1.0f),
                            {options.mask, int(k)}, options.tint);
      if (!layer) return layer.error();
      if (*layer) {
        added.push_back((*layer)->mesh);
        all[k].push_back(std::move(**layer));
      } else {
        findings.push_back({Severity::Warning, "mask-empty",
                            quoted(scene.meshes[base.mesh], base.mesh) + ": the mask shows \"" +
                                nameOf(over.rtt) + "\" nowhere on it: its channel is 0 there",
                            1});
      }
    }
    const std::vector<double> shares = sharesSeen(scene, base.mesh, added);
    base.share = shares[0];
    std::size_t next = 1;
    for (std::vector<Layer>& layers : all)
      if (!layers.empty() && layers.back().base == base.mesh) layers.back().share = shares[next++];
  }
  return all;
}

/// Leaves of a layer that was laid out whole what the mask touches.
void cut(scene::Mesh& mesh, const Layer& layer, std::vector<Vec3>& tangents) {
  std::vector<Vec3> left;
  for (const std::uint32_t v : scene::makeLayer(mesh, layer.triangles)) left.push_back(tangents[v]);
  tangents = std::move(left);
}

}  // namespace

Findings prepare(scene::Scene& scene, const transfer::EncodedRtt& rtt,
                 const SpreadOptions& options) {
  constexpr float kLongest = 0.5f;  // of the shortest period
  constexpr std::size_t kBudget = 100'000;
  Findings findings;
  const auto chosen = chosenMeshes(scene, options);
  if (!chosen || options.placement != Placement::Synthesized) return findings;
  for (const std::uint32_t m : *chosen)
    if (const std::size_t flaps = scene::dropFlaps(scene.meshes[m]); flaps > 0)
      findings.push_back({Severity::Note, "flaps-dropped",
                          quoted(scene.meshes[m], m) + ": " + std::to_string(flaps) +
                              " pairs of triangles lay back to back on the surface and enclosed "
                              "nothing: they are left out, since the patch would end at them",
                          flaps});
  const double area = areaOfAll(scene, *chosen);
  if (!(area > 0.0)) return findings;
  const float longest = kLongest * shortestPeriod(area, rtt, options);
  if (const std::size_t added = scene::splitLongEdges(scene, *chosen, longest, kBudget); added > 0)
    findings.push_back({Severity::Note, "edges-cut",
                        "triangles larger than half of the patch were cut, which added " +
                            std::to_string(added) +
                            " vertices: the patch could not turn within them",
                        added});
  return findings;
}

Result<WithFindings<Spread>> spreadPatch(scene::Scene scene, const transfer::EncodedRtt& rtt,
                                         const SpreadOptions& options, const Progress& progress) {
  const auto chosen = chosenMeshes(scene, options);
  if (!chosen) return chosen.error();
  if (Status sane = checkPatches(rtt, options); !sane) return sane.error();
  WithFindings<Spread> result;
  Spread& spread = result.value;
  Findings& findings = result.findings;
  findings = prepare(scene, rtt, options);
  const double area = areaOfAll(scene, *chosen);
  if (!(area > 0.0)) return report::badInput("the surface has no area to spread the patch over");
  for (const std::uint32_t m : *chosen) {
    SpreadReport& report = spread.reports.emplace_back();
    report.mesh = m;
    report.name = scene.meshes[m].name;
  }
  const auto layers = addLayers(scene, options, spread.reports, findings);
  if (!layers) return layers.error();

  transport::Placement placement;
  std::vector<Placed> all;
  Spreader first{scene, rtt, options, progress, findings, spread, {}, {}, {}};
  for (SpreadReport& report : spread.reports) {
    auto worn = wearPatch(scene, report.mesh, nameOf(rtt), options.albedo.max(0.0f).min(1.0f),
                          options.tint);
    if (!worn) return worn.error();
    findings.insert(findings.end(), worn->begin(), worn->end());
    transport::LocalFrames& frames = placement.local.emplace_back();
    frames.mesh = report.mesh;
    Placed& placed = all.emplace_back(Placed{report.mesh, {}});
    const float width = widthOf(rtt, options.patchWidth, area, options);
    if (Status s = first.lay(width, report, placed, frames.tangents); !s) return s.error();
  }
  for (std::size_t k = 0; k < layers->size(); ++k) {
    const PatchOver& over = options.over[k];
    Spreader spreader{scene, over.rtt, options, progress, findings, spread, {}, {}, {}};
    for (const Layer& layer : (*layers)[k]) {
      SpreadReport& report = spread.reports.emplace_back();
      report.mesh = layer.mesh;
      report.name = scene.meshes[layer.mesh].name;
      report.layer = true;
      report.share = layer.share;
      transport::LocalFrames& frames = placement.local.emplace_back();
      frames.mesh = layer.mesh;
      Placed& placed = all.emplace_back(Placed{layer.mesh, {}});
      placed.patch.rtt = int(k) + 1;
      const float width = widthOf(over.rtt, askedFor(over, options), area, options);
      if (Status s = spreader.lay(width, report, placed, frames.tangents); !s) return s.error();
      cut(scene.meshes[layer.mesh], layer, frames.tangents);
      spreader.count(placed, report);
    }
  }
  dropUnused(scene);

  const auto rays =
      staged(progress, "ray structure", [&] { return trace::RayScene::build(scene); });
  if (!rays) return rays.error();
  const auto receivers = transport::placeReceivers(scene, placement, rays->offset());
  if (!receivers) return receivers.error();
  auto baked = macro::bake(scene, *rays, *receivers, options.transfer, progress);
  if (!baked) return baked.error();
  transfer::SimulatedField& field = baked->value;
  findings.insert(findings.end(), baked->findings.begin(), baked->findings.end());
  for (Placed& placed : all)
    std::get<transfer::BiScale<transfer::Floats>>(field.meshes[placed.mesh]).patch =
        std::move(placed.patch);
  transfer::EncodedField& transfer = spread.asset.transfer;
  transfer = staged(progress, "encode", [&] {
    // The matrices have an encoding of their own.
    return transfer::encode(field, {options.vectorEncoding, options.matrixEncoding});
  });
  for (std::size_t k = 0; k < all.size(); ++k)
    spread.reports[k].matrixError =
        matrixError(std::get<transfer::BiScale<transfer::Floats>>(field.meshes[all[k].mesh]),
                    std::get<transfer::BiScale<transfer::Numbers>>(transfer.meshes[all[k].mesh]));
  transfer.rtts = {rtt};
  for (const PatchOver& over : options.over) transfer.rtts.push_back(over.rtt);
  spread.asset.scene = std::move(scene);
  return result;
}

}  // namespace lambent::bi_scale
