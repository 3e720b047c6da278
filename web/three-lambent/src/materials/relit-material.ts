// The material of a relit mesh: what the loader made of the file's, with other shaders. So it has
// the file's name, colours and maps, whoever asks (exporters, fog, what disposes of a scene), and
// is drawn as three would draw it until it has shaders of its own.

import {
  DoubleSide,
  FrontSide,
  Material,
  MeshStandardMaterial,
  NoBlending,
  Vector4,
  type BufferGeometry,
  type Camera,
  type Color,
  type IUniform,
  type Object3D,
  type Scene,
  type Texture,
  type Vector2,
  type WebGLProgramParametersWithUniforms,
  type WebGLRenderer,
} from "three";

/** Sources for three's preprocessor, and what they are told. */
export interface RelitShaders {
  vertex: string;
  fragment: string;
  uniforms: Record<string, IUniform>;
  /** Sub-samples of a pixel that are added up: what is filtered is as much narrower. Default 1. */
  samples?: number;
}

/** Nodes for three's WebGPURenderer, and what they read when they are drawn. */
export interface RelitNodes {
  /** Of three's NodeMaterial: a material of WebGPURenderer takes over what has these names. */
  fragmentNode: object;
  uniforms: Record<string, IUniform>;
  samples?: number;
  vertex?: undefined;
}

/** Programs are the same where their sources are: a number for each pair of them, from 1. */
const numbers = new Map<string, number>();

/** Of nodes, from −1 down. */
const nodeNumbers = new WeakMap<RelitNodes, number>();
let nodeCount = 0;

function numberOfNodes(nodes: RelitNodes): number {
  const number = nodeNumbers.get(nodes) ?? -++nodeCount;
  nodeNumbers.set(nodes, number);
  return number;
}

const viewport = new Vector4();

export class RelitMaterial extends MeshStandardMaterial {
  /** @internal null: three's own. */
  shaders: RelitShaders | RelitNodes | null = null;
  /** @internal Before an object is drawn with it. */
  drawn: ((scene: Scene, object: Object3D) => void) | null = null;
  /** @internal After somebody disposed of it. */
  disposed: (() => void) | null = null;
  private number = 0;
  private readonly copies = new Set<WeakRef<RelitMaterial>>();

  /** @internal */
  get uniforms(): Record<string, IUniform> {
    return this.shaders?.uniforms ?? {};
  }

  /**
   * A copy of what the loader made.
   *
   * @internal
   * @param culled what faces away is not seen; else it is black, and hides what lies behind it
   */
  static of(original: Material, culled: boolean): RelitMaterial {
    const made = new RelitMaterial();
    if ((original as MeshStandardMaterial).isMeshStandardMaterial)
      made.copy(original as RelitMaterial);
    else {
      Material.prototype.copy.call(made, original);
      const { color, map } = original as { color?: Color; map?: Texture | null };
      if (color) made.color.copy(color);
      made.map = map ?? null;
    }
    made.side = culled ? FrontSide : DoubleSide;
    // What is there in parts alone is cut out, or drawn in a share of the sub-samples.
    made.blending = NoBlending;
    made.depthWrite = true;
    made.forceSinglePass = true;
    return made;
  }

  /** @internal */
  wear(shaders: RelitShaders | RelitNodes | null): void {
    super.dispose(); // the program that it had
    this.shaders = shaders;
    this.number = 0;
    // By that name WebGPURenderer finds it.
    Object.assign(this, { fragmentNode: null });
    if (shaders?.vertex === undefined) {
      Object.assign(this, { fragmentNode: shaders?.fragmentNode ?? null });
      // Nodes hold what they read.
      if (shaders) this.number = numberOfNodes(shaders);
    } else {
      const text = shaders.vertex + shaders.fragment;
      this.number = numbers.get(text) ?? numbers.size + 1;
      numbers.set(text, this.number);
    }
    this.needsUpdate = true;
    for (const each of this.copies) {
      const copy = each.deref();
      if (copy) copy.wear(shaders);
      else this.copies.delete(each);
    }
  }

  /** A copy of a relit material is lit with it. */
  override copy(source: RelitMaterial): this {
    super.copy(source);
    if (!(source instanceof RelitMaterial)) return this;
    source.copies.add(new WeakRef(this));
    this.drawn = source.drawn;
    this.wear(source.shaders);
    return this;
  }

  override onBeforeCompile(program: WebGLProgramParametersWithUniforms): void {
    if (this.shaders?.vertex === undefined) return;
    program.vertexShader = this.shaders.vertex;
    program.fragmentShader = this.shaders.fragment;
    Object.assign(program.uniforms, this.shaders.uniforms);
  }

  override customProgramCacheKey(): string {
    return `three-lambent ${this.number}`;
  }

  /** How wide a pixel is, in the frame of the object. */
  override onBeforeRender(
    renderer: WebGLRenderer,
    scene: Scene,
    camera: Camera,
    _geometry: BufferGeometry,
    object: Object3D,
  ): void {
    const { pixelWidth, capturing } = this.uniforms;
    if (!capturing?.value) this.drawn?.(scene, object);
    if (!pixelWidth) return;
    const samples = capturing?.value ? 1 : (this.shaders?.samples ?? 1);
    const { w: height } = renderer.getCurrentViewport(viewport);
    // Half the picture's height: at distance 1, or of an orthographic camera at any.
    const half = 1 / Math.abs(camera.projectionMatrix.elements[5]);
    const width = (2 * half) / (height * Math.sqrt(samples));
    const orthographic = camera.projectionMatrix.elements[15] === 1;
    const scale = object.matrixWorld.getMaxScaleOnAxis();
    const size = pixelWidth.value as Vector2;
    if (orthographic) size.set(0, width / scale);
    else size.set(width, 0);
  }

  override dispose(): void {
    super.dispose();
    this.disposed?.();
  }
}
