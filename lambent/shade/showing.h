// How an asset is shown: the one value by which every face says which of the transfer that is held
// relights it, and how its lobes and its meso-structure look.
#pragma once

#include <optional>
#include <string_view>

#include "lambent/asset/asset.h"
#include "lambent/report/result.h"
#include "lambent/transfer/kind.h"

namespace lambent::shade {

struct Showing {
  /// Of bare surfaces; none: the most that each mesh holds.
  std::optional<transfer::Kind> surfaces;
  /// Of surfaces with meso-structure: what the shape as a whole does to light on its way to the
  /// structure (sloan2003biscale Figure 3). Unshadowed needs no matrices; none: the most that each
  /// mesh holds.
  std::optional<transfer::Kind> mesoStructure;
  std::optional<float> lobeExponent;  ///< instead of the materials'
  /// Few bands cannot hold a narrow lobe, nor a small light: both ring, and polished surfaces show dark
  /// and coloured rings around every highlight. On: lobes, and the light that reaches them, are
  /// softened by the least that leaves neither negative (sh::leastSoftening), so that nothing of what
  /// they show is, and what a softer lobe loses below the horizon is made up for (lobe.h). Off: as the
  /// harmonics have them, for comparison with other renderers. Diffuse surfaces are the same either
  /// way.
  bool softLobes = true;
  /// Off: meso-structure everywhere as seen from straight above, the centre of the view samples
  /// (the one in the middle or, where their number is even, the mean of the four around it), so
  /// that the patch looks pasted on (sloan2003biscale Figure 6c).
  bool viewDependent = true;
  /// Average the patch over what a sub-sample covers. Off: the nearest position, as
  /// sloan2003biscale §5.
  bool filter = true;

  /// Everything under one kind.
  static Showing of(std::optional<transfer::Kind> kind) {
    return {kind, kind, {}, true, true, true};
  }
  bool operator==(const Showing&) const = default;
};

/// "best" for none, otherwise the kind's name: how files and people name such a choice.
std::string_view choiceName(std::optional<transfer::Kind> kind);
/// Nothing for any other word.
std::optional<std::optional<transfer::Kind>> choiceNamed(std::string_view name);

/// What a mesh is shown under: the wanted kind or, if it is not held, the nearest below that is.
/// Unshadowed for a mirror.
transfer::Kind kindShown(const transfer::EncodedMesh& mesh, const Showing& showing);

/// Whether every mesh can be shown under a kind. Unshadowed always: ρ/π Â_l y_i(N) for diffuse
/// receivers, the identity for glossy matrices, a rotation into the tangent frame for bi-scale
/// ones. `bake --keep-shadowed` keeps what is shadowed beside what is interreflected.
bool offers(const asset::Asset& asset, transfer::Kind kind);

/// BadUsage where the asset does not hold what is asked for, with what there is and how to bake the
/// rest.
Status checkHeld(const asset::Asset& asset, const Showing& showing);

}  // namespace lambent::shade
