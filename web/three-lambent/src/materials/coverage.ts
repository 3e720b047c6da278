// How much of a surface is there (shaders/coverage.glsl): glTF's alphaMode.

import {
  ClampToEdgeWrapping,
  MirroredRepeatWrapping,
  Vector2,
  type IUniform,
  type Texture,
} from "three";

/** LAMBENT's alphaMode in coverage.glsl: 0 whole, 1 a mask, 2 a blend. */
export interface Coverage {
  mode: 0 | 1 | 2;
  /** The material's part of alpha. */
  opacity: number;
  /** The threshold of a mask. */
  cutoff: number;
  /** Of the light behind, by a pane. */
  kept: number;
}

export const kWhole: Coverage = { mode: 0, opacity: 1, cutoff: 0.5, kept: 1 };

/** Whether a surface may be there in parts alone. */
export const hasGaps = ({ mode, kept }: Coverage) => mode !== 0 || kept < 1;

/** Whether it is there in a share of the sub-samples. */
export const hasGrain = ({ mode, kept }: Coverage) => mode === 2 || kept < 1;

type Json = Record<string, unknown>;

const numberOr = (value: unknown, otherwise: number) =>
  typeof value === "number" && Number.isFinite(value) ? value : otherwise;

/**
 * @param material `materials[i]` of the document, or undefined
 * @param transmitted what goes straight through it
 */
export function coverageOf(material: unknown, transmitted: readonly number[]): Coverage {
  if (typeof material !== "object" || material === null) return kWhole;
  const { alphaMode, alphaCutoff, pbrMetallicRoughness } = material as Json;
  const kept = 1 - transmitted.reduce((sum, c) => sum + c, 0) / 3;
  if (alphaMode !== "MASK" && alphaMode !== "BLEND") return { ...kWhole, kept };
  const factor = (pbrMetallicRoughness as Json | undefined)?.baseColorFactor;
  const alpha = Array.isArray(factor) ? numberOr(factor[3], 1) : 1;
  return {
    mode: alphaMode === "MASK" ? 1 : 2,
    opacity: Math.min(Math.max(alpha, 0), 1),
    cutoff: Math.max(numberOr(alphaCutoff, 0.5), 0),
    kept,
  };
}

function wrapRule(wrapping: number): number {
  return wrapping === ClampToEdgeWrapping ? 1 : wrapping === MirroredRepeatWrapping ? 2 : 0;
}

/** Of base_color.glsl and base_color_map.glsl. */
export function mapUniforms(map: Texture): Record<string, IUniform> {
  return {
    baseColorMap: { value: map },
    baseColorWrap: { value: Int32Array.of(wrapRule(map.wrapS), wrapRule(map.wrapT)) },
  };
}

/** Of coverage.glsl. `number`: of what is drawn; blends of one number hide the same sub-samples. */
export function coverageUniforms(
  coverage: Coverage,
  number: number,
): Record<string, IUniform> & { veil: IUniform<Int32Array> } {
  return {
    alphaMode: { value: coverage.mode },
    alphaRule: { value: new Vector2(coverage.opacity, coverage.cutoff) },
    kept: { value: coverage.kept },
    veil: { value: Int32Array.of(number, 0) },
  };
}
