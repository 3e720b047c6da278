// The mean of the frames that were drawn so far, in 32-bit floats: what a still picture becomes.
import {
  FloatType,
  GLSL3,
  HalfFloatType,
  Mesh,
  NearestFilter,
  NoBlending,
  OrthographicCamera,
  PlaneGeometry,
  RawShaderMaterial,
  RGBAFormat,
  Scene,
  WebGLRenderTarget,
  type Texture,
  type WebGLRenderer,
} from "three";

const kVertex = `in vec3 position;
void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }`;

const kFragment = `precision highp float;
uniform sampler2D mean, frame;
uniform float share;
out vec4 color;
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 now = texelFetch(frame, at, 0);
  color = share >= 1.0 ? now : mix(texelFetch(mean, at, 0), now, share);
}`;

export class Accumulator {
  /** Draw a frame here, then add(). Linear radiance, with depth. */
  readonly frame: WebGLRenderTarget;
  private readonly means: [WebGLRenderTarget, WebGLRenderTarget];
  private readonly material: RawShaderMaterial;
  private readonly scene = new Scene();
  private readonly camera = new OrthographicCamera();
  private readonly quad: Mesh;
  private added = 0;

  /** `float32`: whether the GPU can draw into 32-bit floats (EXT_color_buffer_float). */
  constructor(width: number, height: number, float32: boolean) {
    const target = (depthBuffer: boolean) =>
      new WebGLRenderTarget(width, height, {
        type: float32 ? FloatType : HalfFloatType,
        format: RGBAFormat,
        minFilter: NearestFilter,
        magFilter: NearestFilter,
        depthBuffer,
      });
    this.frame = target(true);
    this.means = [target(false), target(false)];
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
      uniforms: { mean: { value: null }, frame: { value: this.frame.texture }, share: { value: 1 } },
      depthTest: false,
      depthWrite: false,
      blending: NoBlending,
    });
    this.quad = new Mesh(new PlaneGeometry(2, 2), this.material);
    this.quad.frustumCulled = false;
    this.scene.add(this.quad);
  }

  get count(): number {
    return this.added;
  }
  /** The mean of all frames since reset(). */
  get mean(): Texture {
    return this.means[0].texture;
  }
  reset(): void {
    this.added = 0;
  }
  setSize(width: number, height: number): void {
    for (const target of [this.frame, ...this.means]) target.setSize(width, height);
    this.reset();
  }
  add(renderer: WebGLRenderer): void {
    const [from, to] = this.means;
    this.material.uniforms.mean!.value = from.texture;
    this.material.uniforms.share!.value = 1 / ++this.added;
    renderer.setRenderTarget(to);
    renderer.render(this.scene, this.camera);
    renderer.setRenderTarget(null);
    this.means.reverse();
  }
  dispose(): void {
    for (const target of [this.frame, ...this.means]) target.dispose();
    this.quad.geometry.dispose();
    this.material.dispose();
  }
}
