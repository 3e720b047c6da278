// A .glb → an asset that can be relit, or an Error that says what is wrong and what to do.
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import type { Camera, Material, Mesh, Object3D, Texture } from "three";
import { LambentAsset, LambentLoaderPlugin } from "three-lambent";

export interface LoadedAsset {
  name: string;
  asset: LambentAsset;
  /** Cameras of the file, as they stand in its scene. */
  cameras: Camera[];
  bytes: number;
}

const kGlbMagic = 0x46546c67;

/** Throws an Error with a message for the person who dropped the file. */
export async function loadAsset(bytes: ArrayBuffer, name: string): Promise<LoadedAsset> {
  if (bytes.byteLength < 20 || new DataView(bytes).getUint32(0, true) !== kGlbMagic)
    throw new Error(`${name}: not a binary glTF file (.glb)`);
  const loader = new GLTFLoader();
  loader.register((parser) => new LambentLoaderPlugin(parser));
  let gltf;
  try {
    gltf = await loader.parseAsync(bytes, "");
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    throw new Error(`${name}: cannot be read: ${reason}`);
  }
  const asset = LambentAsset.of(gltf.scene);
  if (asset === undefined) {
    for (const scene of gltf.scenes) freeAll(scene);
    throw new Error(
      `${name}: it has not been baked, so there is nothing to relight. ` +
        `Bake it first: lambent bake ${name} -o baked.glb`,
    );
  }
  return { name, asset, cameras: gltf.cameras, bytes: bytes.byteLength };
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
