// A scene that has not been baked, as three.js shows it: standard materials, the environment by
// prefiltered maps, discs of light as directional lights. Nothing shadows anything.
import {
  DirectionalLight,
  Euler,
  PMREMGenerator,
  Quaternion,
  Scene,
  type Mesh,
  type Object3D,
  type WebGLRenderer,
  type WebGLRenderTarget,
} from "three";
import { EnvironmentBackground, type Disc, type Environment } from "three-lambent";

export class PlainScene {
  private readonly lamps: DirectionalLight[] = [];
  private prefiltered: WebGLRenderTarget | null = null;
  private of: unknown = null;

  constructor(
    readonly root: Object3D,
    readonly free: () => void,
  ) {}

  get vertices(): number {
    let count = 0;
    this.root.traverse((object) => {
      const mesh = object as Mesh;
      if (mesh.isMesh) count += mesh.geometry.attributes.position?.count ?? 0;
    });
    return count;
  }

  /**
   * Lights `scene` as `seen` has it. `identity` tells one environment, before it is turned, from
   * another; what is turned costs nothing.
   */
  light(renderer: WebGLRenderer, scene: Scene, seen: Environment, identity: unknown): void {
    if (identity !== this.of || this.prefiltered === null) {
      this.of = identity;
      this.prefiltered?.dispose();
      this.prefiltered = prefilter(renderer, seen);
    }
    scene.environment = this.prefiltered.texture;
    scene.environmentRotation = new Euler().setFromQuaternion(turnOf(seen.rotation));
    this.setLamps(scene, seen.discs ?? []);
  }

  private setLamps(scene: Scene, discs: readonly Disc[]): void {
    while (this.lamps.length > discs.length) scene.remove(this.lamps.pop()!);
    discs.forEach(({ direction, diameter, radiance }, i) => {
      const lamp = (this.lamps[i] ??= new DirectionalLight());
      scene.add(lamp);
      lamp.position.set(direction.x, direction.y, direction.z);
      // Irradiance of what faces it.
      const irradiance = Math.PI * Math.sin(Math.min(diameter, Math.PI) / 2) ** 2;
      const [r, g, b] = radiance;
      lamp.color.setRGB(r, g, b).multiplyScalar(irradiance);
      lamp.intensity = 1;
    });
  }

  /** Takes itself out of `scene`, with all that it holds. */
  dispose(scene: Scene): void {
    this.setLamps(scene, []);
    scene.environment = null;
    this.prefiltered?.dispose();
    this.free();
  }
}

function prefilter(renderer: WebGLRenderer, seen: Environment): WebGLRenderTarget {
  const around = new Scene();
  // As it stands before it is turned: the scene turns it.
  const back = turnOf(seen.rotation).invert();
  const rotation = new Quaternion();
  const sky = seen.sky && { ...seen.sky, rotation: back.multiply(turnOf(seen.sky.rotation)) };
  const background = new EnvironmentBackground({ ...seen, sky, rotation, discs: [] });
  around.add(background);
  const generator = new PMREMGenerator(renderer);
  try {
    return generator.fromScene(around);
  } finally {
    generator.dispose();
    background.dispose();
  }
}

const turnOf = (q: Environment["rotation"]) =>
  q === undefined ? new Quaternion() : new Quaternion(q.x, q.y, q.z, q.w);
