// Scene + RTT → bi-scale asset (sloan2003biscale §4): where texture synthesis and macro-scale
// transfer meet.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/atlas/atlas.h"
#include "lambent/bi_scale/direction_guides.h"
#include "lambent/bi_scale/tint.h"
#include "lambent/macro/bake.h"
#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/scene/scene.h"
#include "lambent/synthesis/patch_symmetry.h"

namespace lambent::bi_scale {

enum class Placement {
  Synthesized,  ///< texture synthesis over the surface, kept in an id map over an atlas
  OwnUvs,       ///< the mesh's UVs repeat the patch: parametric surfaces
};

/// How a patch is laid by synthesis.
enum class Layout {
  Automatic,  ///< a lattice for patches that repeat themselves within their period, else pieces
  Lattice,    ///< without a seam, as whole cells of the patch: synthesis/lattice_map.h
  Pieces,     ///< grown of pieces that fit: synthesis/synthesize.h
};

/// One more patch, over the first.
struct PatchOver {
  transfer::EncodedRtt rtt;
  Rgb albedo = Rgb::Constant(0.5f);  ///< as SpreadOptions::albedo, though nothing meets it
  std::optional<float> patchWidth;   ///< none: as SpreadOptions::patchWidth
};

struct SpreadOptions {
  std::vector<std::uint32_t> meshes;  ///< that carry the patch; empty: all that are no mirrors
  Placement placement = Placement::Synthesized;
  /// Metres of the surface that the patch's width covers; 0: see automaticPatchWidth.
  float patchWidth = 0.0f;
  Layout layout = Layout::Automatic;
  Vec2 tiles = Vec2(0.0f, 0.0f);   ///< OwnUvs: patches along u and v; 0: from patchWidth
  std::uint32_t mesoVertices = 0;  ///< 0: one for each position of the patch, to 960,000
  /// What the patch's +x follows: nothing, a direction (world space), curves, a picture.
  std::variant<std::monostate, Vec3, CurveSteering, PictureSteering> steering;
  /// Along sharp creases and borders of the surface, where nothing else steers it: see
  /// synthesis::TangentFieldOptions::align.
  bool align = true;
  /// 0 … 1: see synthesis::SynthesisOptions. None: what the patch bears, 0 for one that repeats
  /// itself within its period (a weave would be torn), to 0.5 for one that never does (stucco would
  /// show its tiles).
  std::optional<float> randomness;
  atlas::AtlasOptions atlas;  ///< its size is the id map's
  std::uint64_t seed = 0;
  Rgb albedo =
      Rgb::Constant(0.5f);  ///< of the patch as a whole: what it sends on to other surfaces
  Tint tint;                ///< what of the meshes' own colours varies the patch's
  /// At most three, each over those before it, as far as red, green and blue of a picture over the
  /// meshes' own UVs say: layers (scene/layers.h). All else is as it is for the first.
  std::vector<PatchOver> over;
  scene::Texture mask;  ///< of `over`
  macro::BakeOptions transfer;
  transfer::Encoding matrixEncoding = transfer::Encoding::Snorm8;
  transfer::Encoding vectorEncoding =
      transfer::Encoding::Float16;  ///< of other meshes in the scene
};

/// What was done to one mesh.
struct SpreadReport {
  std::uint32_t mesh = 0;
  std::string name;
  std::string patch;  ///< its name
  bool layer = false;
  double share = 1.0;       ///< of the whole surface, where it is seen
  double area = 0.0;        ///< m², of a layer where the mask touches it
  double patches = 0.0;     ///< how many times the patch's area fits
  float patchWidth = 0.0f;  ///< metres
  std::uint32_t vertices = 0, mesoVertices = 0;
  std::uint32_t singularities = 0;
  std::uint32_t featureLines = 0;  ///< sharp creases and borders, if it was to be aligned
  std::uint32_t alignedLines = 0;  ///< those that it lies along or across
  double guided = 0.0;             ///< share of the vertices that curves or a picture steer
  float randomness = 0.0f;         ///< of pieces
  /// Lattice or Pieces, if synthesised, and what the choice stood on.
  Layout layout = Layout::Pieces;
  synthesis::PatchSymmetry symmetry;
  /// Of a lattice: the share of edges that it goes on over; the share of the surface where it lies
  /// face down, and where it is below 2/3 or above 3/2 of its size; the rms of ln(size).
  double continued = 0.0, flipped = 0.0, squeezed = 0.0, sizeError = 0.0;
  std::uint32_t charts = 0;
  double stretch = 1.0, worstStretch = 1.0, usedArea = 0.0;
  bool ownUvs = false;
  double matrixError = 0.0;  ///< relative RMS that the encoding of the matrices costs
};

struct Spread {
  asset::Asset asset;
  std::vector<SpreadReport> reports;
  std::vector<atlas::Atlas> atlases;  ///< of Synthesized meshes, in the sequence of `reports`
};

/// The patch's colours and relief take the place of the material, texture and vertex colours of the
/// meshes that carry it, but for their tint. Layers stand at the end of the scene. Everything else is
/// baked at its vertices. BadInput and BadUsage name the mesh.
Result<WithFindings<Spread>> spreadPatch(scene::Scene scene, const transfer::EncodedRtt& rtt,
                                         const SpreadOptions& options,
                                         const Progress& progress = {});

/// The width at which a surface of `area` m² holds 200 patches or, if that is fewer, as many as a
/// meso-mesh of so many vertices (0: 960,000) shows position by position.
float automaticPatchWidth(double area, const transfer::EncodedRtt& rtt, std::uint32_t mesoVertices);

double areaOf(const scene::Mesh& mesh);  ///< m²

/// Makes surfaces fit to be laid out with a patch, and says what it did: leaves out what a patch
/// would end at (scene/flaps.h), and cuts triangles that are large beside its period, within which
/// it could not turn. spreadPatch does it first of all; whoever looks at what the patch will lie on
/// does it before that.
Findings prepare(scene::Scene& scene, const transfer::EncodedRtt& rtt,
                 const SpreadOptions& options);

}  // namespace lambent::bi_scale
