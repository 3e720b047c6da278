// The factors of a glTF material as Lambent understands them: lambent/scene_io/gltf_material.cpp.

/** Linear reflectances, without what varies over a primitive (COLOR_0, baseColorTexture). */
export interface Reflectance {
  diffuse: [number, number, number];
  /** A mirror's; black where the surface is none. */
  mirror: [number, number, number];
  /** What goes straight through. */
  transmitted: [number, number, number];
  /** baseColorFactor. */
  base: [number, number, number];
}

type Json = Record<string, unknown>;

const clamp = (v: number) => Math.min(Math.max(v, 0), 1);

function triple(value: unknown): [number, number, number] | null {
  if (!Array.isArray(value) || value.length < 3) return null;
  const rgb = value.slice(0, 3);
  return rgb.every((v) => typeof v === "number" && Number.isFinite(v))
    ? [clamp(rgb[0]), clamp(rgb[1]), clamp(rgb[2])]
    : null;
}

function factor(value: unknown): number {
  return typeof value === "number" && Number.isFinite(value) ? clamp(value) : 1;
}

/**
 * @param material `materials[i]` of the document, or undefined for glTF's default
 * @param colored whether the primitive has COLOR_0
 */
export function reflectanceOf(material: unknown, colored: boolean): Reflectance {
  const black = (): [number, number, number] => [0, 0, 0];
  if (typeof material !== "object" || material === null) {
    const grey = colored ? 1 : 0.8;
    return { diffuse: [grey, grey, grey], mirror: black(), transmitted: black(), base: [grey, grey, grey] };
  }
  const pbr = ((material as Json).pbrMetallicRoughness ?? {}) as Json;
  const base = triple(pbr.baseColorFactor) ?? [1, 1, 1];
  const metallic = factor(pbr.metallicFactor);
  const roughness = factor(pbr.roughnessFactor);
  const extensions = ((material as Json).extensions ?? {}) as Json;
  const transmission = (extensions.KHR_materials_transmission ?? {}) as Json;
  const passed = transmission.transmissionFactor === undefined ? 0 : factor(transmission.transmissionFactor);
  const share = (of: number) =>
    base.map((c) => c * (1 - metallic) * of) as [number, number, number];
  const plain: Reflectance =
    metallic >= 0.999 && roughness <= 0.05
      ? { diffuse: black(), mirror: base, transmitted: black(), base }
      : { diffuse: share(1 - passed), mirror: black(), transmitted: share(passed), base };
  // Exact numbers, where the file carries them and nobody has edited what stands beside them: what
  // they come to, or what a source had there, which is then said.
  const exact = ((material as Json).extras as Json | undefined)?.lambent as Json | undefined;
  const diffuse = triple(exact?.diffuse);
  const glossy = triple(exact?.glossy);
  const mirror = triple(exact?.mirror);
  const transmitted = triple(exact?.transmitted) ?? black();
  if (!diffuse || !glossy || !mirror) return plain;
  const isMirror = Math.max(...mirror) > 0;
  const found = { diffuse: isMirror ? black() : diffuse, mirror, transmitted, base };
  const beside = exact?.beside as Json | undefined;
  const besideBase = triple(beside?.baseColor);
  if (besideBase) {
    const near = (a: number, b: number) => Math.abs(a - b) < 1e-4;
    return besideBase.every((v, c) => near(v, base[c])) &&
      near(factor(beside?.metallic), metallic) &&
      near(factor(beside?.roughness), roughness)
      ? found
      : plain;
  }
  const sum = isMirror ? mirror : [0, 1, 2].map((c) => clamp(diffuse[c] + glossy[c] + transmitted[c]));
  if (sum.some((v, c) => Math.abs(v - base[c]) >= 1e-4)) return plain;
  const total = [...diffuse, ...glossy, ...transmitted].reduce((a, b) => a + b, 0);
  const metal = isMirror ? 1 : total > 0 ? glossy.reduce((a, b) => a + b, 0) / total : 0;
  if (Math.abs(metal - metallic) >= 1e-4) return plain;
  return found;
}

/** Whether a surface is a mirror. */
export const isMirror = ({ mirror }: Reflectance) => Math.max(...mirror) > 0;
