// Whether what a shader is told is still what it was told.

import { Texture, type IUniform } from "three";

/** Equal for equal values, and for textures if they are the same ones with the same pixels. */
export function stateOf(uniforms: readonly IUniform[]): string {
  return JSON.stringify(
    uniforms.map(({ value }) =>
      value instanceof Texture ? `${value.uuid} ${value.version}` : (value as unknown),
    ),
  );
}
