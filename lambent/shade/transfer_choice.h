// Which part of the simulated transport relights: to show what shadows and further bounces add.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "lambent/asset/asset.h"
#include "lambent/encode/encoded_field.h"
#include "lambent/report/result.h"
#include "lambent/shade/bi_scale_options.h"

namespace lambent::shade {

/// Best: what the asset holds. Unshadowed can always be had: ρ/π Â_l y_i(N) for diffuse receivers,
/// the identity for glossy matrices, a rotation into the tangent frame for bi-scale ones.
/// Shadowed and Interreflected only where the asset holds them (`bake --keep-shadowed` keeps the
/// first beside the second); otherwise the nearest below that it holds.
enum class TransferChoice { Best, Unshadowed, Shadowed, Interreflected };

/// "best", "unshadowed", "shadowed", "interreflected"; nullopt for any other word.
std::string_view nameOf(TransferChoice choice);
std::optional<TransferChoice> transferChoiceNamed(std::string_view name);

/// Whether the asset has what a choice asks for: every one of its meshes that records transfer
/// does. Best and Unshadowed always.
bool offers(const asset::Asset& asset, TransferChoice choice);

/// BadUsage where it does not, with what there is and how to bake the rest.
Status checkTransfer(const asset::Asset& asset, TransferChoice choice);

/// Whether the choice shows the mesh just as it is stored, so that no copy need be made.
bool isStored(const asset::Asset& asset, std::uint32_t mesh, TransferChoice choice);

/// The transfer of one mesh under a choice: what EncodedMesh holds, with vectors and matrices (and
/// those of its biScale) exchanged, and no other choice left in it. In the encodings of the asset;
/// rotations of a bi-scale mesh, which stand in biScale.shadowed, are float32 where its own
/// matrices are, otherwise float16. All threads.
encode::EncodedMesh chosenTransfer(const asset::Asset& asset, std::uint32_t mesh,
                                   TransferChoice choice);

/// The transfer that a mesh is shown with: a copy is made only where the choice wants one.
class ShownTransfer {
 public:
  /// `macro`: the switch of meshes with meso-structure, which wins over the choice where it is set:
  /// such a mesh is then shown as stored. `asset` must outlive it.
  ShownTransfer(const asset::Asset& asset, std::uint32_t mesh, TransferChoice choice,
                std::optional<MacroTransport> macro);
  const encode::EncodedMesh& get() const { return made_ ? *made_ : *stored_; }

 private:
  const encode::EncodedMesh* stored_;
  std::optional<encode::EncodedMesh> made_;
};

}  // namespace lambent::shade
