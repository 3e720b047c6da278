// The same with drei, and as gltfjsx would have it: one cache for all that show the file, controls,
// and a component that stands for the model.
import { Suspense } from "react";
import { Canvas, type ThreeElements } from "@react-three/fiber";
import { Bounds, OrbitControls, useGLTF } from "@react-three/drei";
import { LambentLight, type LambentAsset as Asset } from "three-lambent";
import { extendLambent, LambentAsset } from "three-lambent/react";

const light = LambentLight.uniform([1, 1, 1], 5);

/** What gltfjsx writes, with the whole asset in the place of its meshes, which shade each other. */
export function Model(props: ThreeElements["group"]) {
  const gltf = useGLTF("baked.glb", true, true, extendLambent);
  const asset = gltf.userData.lambent as Asset;
  return (
    <group {...props} dispose={null}>
      <LambentAsset
        asset={asset}
        light={light}
        onClick={(event) => console.log(event.object.name)} // the part that was hit
      />
    </group>
  );
}
useGLTF.preload("baked.glb", true, true, extendLambent);

export function App() {
  return (
    <Canvas>
      <Suspense>
        <Bounds fit>
          <Model rotation={[0, 0.5, 0]} />
        </Bounds>
      </Suspense>
      <OrbitControls makeDefault />
    </Canvas>
  );
}
