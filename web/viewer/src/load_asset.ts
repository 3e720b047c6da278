// A .glb → something to show: an asset that can be relit, or a plain scene under three's own light.
// Or an Error that says what is wrong and what to do.
import { GLTFLoader, type GLTF } from "three/addons/loaders/GLTFLoader.js";
import type { Camera, Material, Mesh, Object3D, Texture } from "three";
import { LambentAsset, LambentLoaderPlugin } from "three-lambent";
import { bakeLine } from "./bake_line";
import { PlainScene } from "./plain_scene";
import { messageOf } from "./messages";

interface Loaded {
  name: string;
  root: Object3D;
  /** Cameras of the file, as they stand in its scene. */
  cameras: Camera[];
  bytes: number;
}
export interface RelitAsset extends Loaded {
  asset: LambentAsset;
  plain: null;
}
/** What has no transfer. */
export interface PlainAsset extends Loaded {
  asset: null;
  plain: PlainScene;
  /** It was baked once, and what wrote it since let go of the transfer. */
  stripped: boolean;
}
export type LoadedAsset = RelitAsset | PlainAsset;

const kGlbMagic = 0x46546c67;
/** What GLTFLoader says of what it cannot unpack, and what that is. The tool reads both. */
const kPacked: readonly [string, string][] = [
  ["DRACOLoader", "Draco"],
  ["MeshoptDecoder", "meshopt"],
];

/** Throws an Error with a message for the person who opened the file. */
export async function loadAsset(bytes: ArrayBuffer, name: string): Promise<LoadedAsset> {
  if (bytes.byteLength < 20 || new DataView(bytes).getUint32(0, true) !== kGlbMagic)
    throw new Error(`${name}: not a binary glTF file (.glb)`);
  const loader = new GLTFLoader();
  loader.register((parser) => new LambentLoaderPlugin(parser));
  let gltf: GLTF;
  try {
    gltf = await loader.parseAsync(bytes, "");
  } catch (error) {
    const reason = messageOf(error);
    const packed = kPacked.find(([sign]) => reason.includes(sign));
    throw new Error(
      packed === undefined
        ? `${name}: cannot be read: ${reason}`
        : `${name}: it is compressed (${packed[1]}), which is not read here before it is baked: ` +
            bakeLine(name),
    );
  }
  const { scene: root, cameras } = gltf;
  const common = { name, root, cameras, bytes: bytes.byteLength };
  const asset = LambentAsset.of(root);
  if (asset !== undefined) return { ...common, asset, plain: null };
  for (const scene of gltf.scenes) if (scene !== root) freeAll(scene);
  return {
    ...common,
    asset: null,
    plain: new PlainScene(root, () => freeAll(root)),
    stripped: wasBaked(gltf),
  };
}

/** What was loaded and is not shown after all. */
export function freeAsset({ asset, plain }: LoadedAsset): void {
  asset?.dispose();
  plain?.free();
}

/** Marks of a bake that are left where the extension is gone. */
function wasBaked({ asset, parser }: GLTF): boolean {
  const { extras } = parser.json as { extras?: Record<string, unknown> };
  const own = asset.extras as Record<string, unknown> | undefined;
  return /\bLambent\b/.test(asset.generator ?? "") || [own, extras].some((each) => each?.lambent);
}

/** Geometries, materials and textures of an ordinary glTF scene. */
function freeAll(root: Object3D): void {
  root.traverse((object) => {
    const mesh = object as Mesh;
    if (!mesh.isMesh) return;
    mesh.geometry.dispose();
    const materials: Material[] = Array.isArray(mesh.material) ? mesh.material : [mesh.material];
    for (const material of materials) {
      for (const value of Object.values(material))
        if (value && (value as Texture).isTexture) {
          (value as Texture).dispose();
          ((value as Texture).image as Partial<ImageBitmap> | undefined)?.close?.();
        }
      material.dispose();
    }
  });
}
