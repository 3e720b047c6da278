// M L by nodes: src/glsl/transfer.frag.glsl, pack.glsl and pass_main.glsl, for the results of stored
// vectors and matrices (sloan2002precomputed eq. 8, 9 and 12).

import { Vector4, type DataArrayTexture, type WebGLRenderer } from "three";
import {
  dot,
  Fn,
  If,
  int,
  ivec2,
  Loop,
  screenCoordinate,
  select,
  texture,
  uniform,
  uniformArray,
  vec3,
  vec4,
} from "three/tsl";
import { NodeMaterial, QuadMesh, RendererUtils, type Node, type Renderer } from "three/webgpu";
import type { FullScreenPass } from "../gpu/full-screen-pass.js";
import type { LitTexture } from "../gpu/lit-texture.js";
import type { RowLayout } from "../gpu/row-texture.js";
import type { LightPass, MatrixShape, TransferRows } from "../gpu/transfer-pass.js";

type Int = Node<"int">;
type Vec3 = Node<"vec3">;

interface Rows {
  texture: DataArrayTexture;
  layout: RowLayout;
}

/** Where rows lie: src/glsl/row_place.glsl. @returns texel `on` of a row */
function rowReader({ texture: stored, layout }: Rows): (row: Int, on?: Int) => Node<"vec4"> {
  const aLine = uniform(layout.rowsALine, "int");
  const aLayer = uniform(layout.linesALayer, "int");
  const texels = uniform(layout.texelsARow, "int");
  return (row, on) => {
    const line = row.div(aLine).toVar();
    const layer = line.div(aLayer).toVar();
    const x = row.sub(line.mul(aLine)).mul(texels);
    const place = ivec2(on ? x.add(on) : x, line.sub(layer.mul(aLayer)));
    const load = texture(stored, place).level(int(0)).depth(layer).setSampler(false);
    return load as unknown as Node<"vec4">;
  };
}

const vectors = (count: number) => Array.from({ length: count }, () => new Vector4());

/** Results of stored vectors or matrices. */
export class NodePass implements LightPass {
  private readonly material = new NodeMaterial();
  private readonly quad = new QuadMesh(this.material);
  /** [channel][columns in groups of four] */
  private readonly light: Vector4[];
  private readonly factors: Vector4[];
  private readonly quads: number;

  /** @param stored what it reads; others may read it too */
  constructor(
    private readonly stored: TransferRows,
    private readonly shape: MatrixShape,
    private readonly lit: LitTexture,
    private readonly reflectance: readonly [number, number, number],
  ) {
    this.quads = Math.ceil(shape.columns / 4);
    this.light = vectors(3 * this.quads);
    this.factors = vectors(lit.rows);
    Object.assign(this.material, { depthTest: false, depthWrite: false, fog: false });
    this.material.fragmentNode = this.fragment(stored);
  }

  private fragment(stored: TransferRows): Node<"vec4"> {
    const { shape, lit, quads } = this;
    const { channels } = shape;
    const light = uniformArray<"vec4">(this.light, "vec4");
    const factors = uniformArray<"vec4">(this.factors, "vec4");
    const receivers = uniform(lit.receivers, "int");
    const receiversALine = uniform(lit.receiversALine, "int");
    const numbers = rowReader(stored.numbers);
    const scales = stored.scales && rowReader(stored.scales);
    const lightOf = (channel: number, j: Int) => light.element(j.add(channel * quads));

    const result = (receiver: Int, i: Int): Vec3 => {
      const matrix = (shape.shared ? int(0) : receiver.mul(channels)).toVar();
      const sum = vec3(0).toVar();
      const rows = [0, 1, 2].slice(0, channels).map((c) => matrix.add(c).mul(shape.rows).add(i));
      Loop(quads, ({ i: j }: { i: Int }) => {
        const read = rows.map((row) => numbers(row, j).toVar());
        sum.addAssign(
          vec3(
            ...([0, 1, 2].map((c) => dot(read[c % channels], lightOf(c, j))) as [
              Node<"float">,
              Node<"float">,
              Node<"float">,
            ]),
          ),
        );
      });
      if (scales) {
        const scale = [0, 1, 2].map((c) => scales(matrix.add(c % channels)).x);
        sum.mulAssign(vec3(scale[0], scale[1], scale[2]));
      }
      return sum.mul(factors.element(i).xyz);
    };

    return Fn(() => {
      const at = ivec2(screenCoordinate).toVar();
      const column = at.x.div(lit.texels).toVar();
      const receiver = at.y.mul(receiversALine).add(column).toVar();
      const out = vec4(0).toVar();
      If(receiver.lessThan(receivers), () => {
        if (lit.rows === 1) {
          out.assign(vec4(result(receiver, int(0)), 0));
          return;
        }
        // Four numbers from the middle of a coefficient end within the next one.
        const first = at.x.sub(column.mul(lit.texels)).mul(4).toVar();
        const row = first.div(3).toVar();
        const here = result(receiver, row).toVar();
        const next = vec3(0).toVar();
        If(row.add(1).lessThan(lit.rows), () => {
          next.assign(result(receiver, row.add(1)));
        });
        const from = first.sub(row.mul(3)).toVar();
        out.assign(
          select(
            from.equal(0),
            vec4(here, next.x),
            select(from.equal(1), vec4(here.yz, next.xy), vec4(here.z, next)),
          ),
        );
      });
      return out;
    })() as unknown as Node<"vec4">;
  }

  run(
    renderer: WebGLRenderer,
    _screen: FullScreenPass,
    light: ArrayLike<number>,
    factors: Float32Array,
  ): void {
    const { quads, lit, reflectance } = this;
    const count = Math.min(this.shape.columns, light.length / 3);
    for (let c = 0; c < 3; ++c)
      for (let j = 0; j < 4 * quads; ++j)
        this.light[c * quads + (j >> 2)].setComponent(j & 3, j < count ? light[3 * j + c] : 0);
    const [r, g, b] = reflectance;
    this.factors.forEach((factor, i) => factor.set(r, g, b, 0).multiplyScalar(factors[i]));
    const given = renderer as unknown as Renderer;
    // WebGL's names, which WebGPU would take for its own.
    if ((given.backend as { isWebGPUBackend?: boolean }).isWebGPUBackend)
      for (const rows of [this.stored.numbers, this.stored.scales])
        if (rows) rows.texture.internalFormat = null;
    const before = RendererUtils.resetRendererState(given, undefined as never);
    try {
      given.setRenderTarget(lit.target);
      this.quad.render(given);
    } finally {
      RendererUtils.restoreRendererState(given, before);
    }
  }

  dispose(): void {
    this.material.dispose();
  }
}
