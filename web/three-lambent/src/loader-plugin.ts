// LAMBENT_radiance_transfer for three's GLTFLoader.

import type { BufferAttribute, Mesh, Object3D } from "three";
import type { GLTF, GLTFParser } from "three/addons/loaders/GLTFLoader.js";
import { LambentAsset } from "./asset/asset.js";
import { AssetSource, type IncidentMode } from "./asset/asset-source.js";
import type { MeshEntry } from "./asset/mesh-source.js";
import { coverageOf } from "./materials/coverage.js";
import { extrasOf, type Extras } from "./asset/extras.js";
import { isMirror, reflectanceOf } from "./asset/reflectance.js";
import type { LambentNodes } from "./gpu/nodes.js";
import {
  hasTransfer,
  kExtensionName,
  LambentFormatError,
  type AssetDescription,
} from "./format/description.js";

export interface LambentLoaderOptions {
  /**
   * How incident light of glossy surfaces and meso-structure comes to the pixels: "varyings" (by the
   * rasteriser, fast), "fetch" (by the fragment shader at the triangle's corners, which needs three
   * vertices for each triangle), "auto": varyings, if the device has enough. Default "auto".
   */
  incident?: IncidentMode;
  /**
   * `nodes` of "three-lambent/webgpu", by which WebGPURenderer draws the asset too. Default null:
   * WebGLRenderer alone does.
   */
  nodes?: LambentNodes | null;
}

/** What GLTFLoader makes of a baked file. */
export interface LambentGLTF extends GLTF {
  userData: GLTF["userData"] & { lambent: LambentAsset };
}

/**
 * The asset of a loaded file, which is also at `gltf.userData.lambent`.
 *
 * @throws Error if the file was not baked, or was loaded without {@link LambentLoaderPlugin}
 */
export function lambentOf(gltf: Pick<GLTF, "userData">): LambentAsset {
  const asset = gltf.userData?.lambent as LambentAsset | undefined;
  if (typeof asset?.update === "function") return asset;
  throw new Error(
    "three-lambent: nothing to relight in this file: bake it (lambent bake scene.glb -o " +
      "baked.glb), and load it by new GLTFLoader().register((p) => new LambentLoaderPlugin(p))",
  );
}

/**
 * `loader.register((parser) => new LambentLoaderPlugin(parser))`.
 *
 * Files without the extension load as ever. With it, materials of all meshes are replaced, and the
 * {@link LambentAsset} stands at `gltf.userData.lambent`. A file that is damaged, or of another major
 * version of the format, is an error of the load that says what is wrong and where.
 */
export class LambentLoaderPlugin {
  readonly name = kExtensionName;
  private description: AssetDescription | null = null;
  private extras: Promise<Extras> | null = null;

  constructor(
    private readonly parser: GLTFParser,
    private readonly options: LambentLoaderOptions = {},
  ) {}

  /** Reads and checks all transfer, before anything else is made of the file. */
  beforeRoot(): Promise<void> | null {
    const { parser } = this;
    if (!hasTransfer(parser.json)) return null;
    const source = {
      json: parser.json as Record<string, unknown>,
      buffer: (index: number) => parser.getDependency("buffer", index) as Promise<ArrayBuffer>,
      bufferView: (index: number) =>
        parser.getDependency("bufferView", index) as Promise<ArrayBuffer>,
    };
    return import("./format/read.js")
      .then(({ readTransfer }) => readTransfer(source))
      .then((description) => {
        this.description = description;
        // Comes while the meshes do.
        const { materials } = parser.json as { materials?: unknown };
        const mirrors =
          Array.isArray(materials) &&
          materials.some((each) => isMirror(reflectanceOf(each, false)));
        this.extras = extrasOf(description, mirrors);
        this.extras.catch(() => {}); // afterRoot tells
      });
  }

  /** Hands the meshes over to a LambentAsset. */
  afterRoot(gltf: GLTF): Promise<void> | null {
    const { description, extras } = this;
    if (!description || !extras) return null;
    return extras.then((each) => this.relight(gltf, description, each));
  }

  private relight(gltf: GLTF, description: AssetDescription, extras: Extras): void {
    const { parser } = this;
    const json = parser.json as {
      materials?: unknown[];
      meshes?: { primitives: { material?: number }[] }[];
    };
    const entries: MeshEntry[] = [];
    gltf.scene.traverse((object: Object3D) => {
      const place = parser.associations.get(object);
      const mesh = object as Mesh;
      if (!mesh.isMesh || place?.meshes === undefined) return;
      if (!mesh.geometry.hasAttribute("position")) return; // nothing to see, says glTF
      const primitive = place.primitives ?? 0;
      const key = `${place.meshes}/${primitive}`;
      checkGeometry(mesh, key);
      const index = json.meshes?.[place.meshes]?.primitives[primitive]?.material;
      const material = json.materials?.[index ?? -1];
      const colored = mesh.geometry.hasAttribute("color");
      const reflectance = reflectanceOf(material, colored);
      const coverage = coverageOf(material, reflectance.transmitted);
      entries.push({ mesh, key, reflectance, coverage });
    });
    // What no scene shows, nobody can relight.
    gltf.userData ??= {};
    const { incident = "auto", nodes = null } = this.options;
    const source = new AssetSource(description, entries, incident, extras, nodes);
    const meshes = entries.map(({ mesh }) => mesh);
    gltf.userData.lambent = new LambentAsset(gltf.scene, source, meshes);
  }
}

/** What GLTFLoader takes on trust. */
function checkGeometry({ geometry }: Mesh, key: string): void {
  const [mesh, primitive] = key.split("/");
  const place = `meshes[${mesh}].primitives[${primitive}]`;
  const position = geometry.getAttribute("position");
  const { index } = geometry;
  if (index)
    for (let i = 0; i < index.count; ++i)
      if (index.getX(i) >= position.count)
        throw new LambentFormatError(
          `${place}.indices: ${index.getX(i)} is no vertex: there are ${position.count}`,
        );
  for (const [name, key] of [
    ["POSITION", "position"],
    ["NORMAL", "normal"],
  ]) {
    const values = (geometry.getAttribute(key) as BufferAttribute | undefined)?.array ?? [];
    for (let i = 0; i < values.length; ++i)
      if (!Number.isFinite(values[i]))
        throw new LambentFormatError(`${place}.attributes.${name}: a number is not finite`);
  }
  if (!geometry.hasAttribute("normal")) geometry.computeVertexNormals();
  for (const name of ["normal", "uv", "uv1", "color"])
    if (geometry.hasAttribute(name) && geometry.getAttribute(name).count !== position.count)
      throw new LambentFormatError(`${place}.attributes: not as many ${name}s as positions`);
}
