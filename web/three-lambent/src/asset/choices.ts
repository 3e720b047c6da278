// Which part of the simulated transport relights, as shade::Showing has it.

import type {
  AssetDescription,
  MacroMatrices,
  PrimitiveTransfer,
  TransferKind,
} from "../format/description.js";

/**
 * "best": what the asset holds. "unshadowed" can always be had: ρ/π Â_l y_i(N) for diffuse
 * receivers, the light itself for glossy ones, the light turned into the tangent frame under
 * meso-structure. "shadowed" and "interreflected" only where the asset holds them; otherwise the
 * nearest below that it does.
 */
export type TransferChoice = "best" | "unshadowed" | "shadowed" | "interreflected";

const kChoices: readonly TransferChoice[] = ["best", "unshadowed", "shadowed", "interreflected"];

/** @throws RangeError for what is no choice */
export function checkTransfer(choice: TransferChoice): TransferChoice {
  if (!kChoices.includes(choice))
    throw new RangeError(
      `three-lambent: no transfer "${String(choice)}": ${kChoices.slice(0, 3).join(", ")} or ` +
        kChoices[3],
    );
  return choice;
}

function holds(asset: AssetDescription, mesh: PrimitiveTransfer, kind: TransferKind): boolean {
  if (kind === "unshadowed") return true;
  if (mesh.biScale) return mesh.biScale[kind] !== null;
  return asset.transfer === kind || (kind === "shadowed" && mesh.shadowed !== null);
}

/** What a mesh shows: the wanted, or the nearest below that it holds. */
export function kindOf(
  asset: AssetDescription,
  mesh: PrimitiveTransfer,
  choice: TransferChoice,
): TransferKind {
  let kind: TransferKind = choice === "best" ? "interreflected" : choice;
  if (kind === "interreflected" && !holds(asset, mesh, kind)) kind = "shadowed";
  if (kind === "shadowed" && !holds(asset, mesh, kind)) kind = "unshadowed";
  return kind;
}

/** Whether every mesh that records transfer has what a choice asks for. */
export function offers(asset: AssetDescription, choice: TransferChoice): boolean {
  if (choice === "best") return true;
  return [...asset.primitives.values()].every(
    (mesh) =>
      !(mesh.biScale || mesh.vectors || mesh.matrices) || kindOf(asset, mesh, choice) === choice,
  );
}

/** Matrices of meso-structure under a choice; null: only the turn into the tangent frame. */
export function macroOf(
  asset: AssetDescription,
  mesh: PrimitiveTransfer,
  choice: TransferChoice,
  macro: boolean,
): MacroMatrices | null {
  if (!mesh.biScale || !macro) return null;
  const kind = kindOf(asset, mesh, choice);
  return kind === "unshadowed" ? null : mesh.biScale[kind];
}
