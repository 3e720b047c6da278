// A baked asset in React: a click switches its shadows off and on, and it turns under its light.
import { useRef, useState } from "react";
import { Canvas, useFrame, useThree } from "@react-three/fiber";
import { Vector3, type Group, type PerspectiveCamera } from "three";
import {
  frameAutomatically,
  LambentLight,
  type Disc,
  type LambentAsset as Asset,
} from "three-lambent";
import { LambentAsset } from "three-lambent/react";

const lamp: Disc = { direction: new Vector3(1, 0.8, 0), diameter: 0.6, radiance: [9, 8, 6] };
const light = LambentLight.uniform([0.25, 0.35, 0.5], 5).addDisc(lamp);
const environment = { uniform: [0.25, 0.35, 0.5] as const, discs: [lamp] }; // what mirrors show

function Turning() {
  const group = useRef<Group>(null);
  const [shadows, setShadows] = useState(true);
  const camera = useThree((state) => state.camera as PerspectiveCamera);
  useFrame((_, seconds) => group.current?.rotateY(0.3 * seconds));
  const frame = (asset: Asset) => frameAutomatically(asset.root, camera, camera.aspect);
  return (
    <group ref={group}>
      <LambentAsset
        url="baked.glb"
        light={light}
        environment={environment}
        transfer={shadows ? "best" : "unshadowed"}
        onClick={() => setShadows(!shadows)}
        onLoad={frame}
      />
    </group>
  );
}

export function App() {
  return (
    <Canvas>
      <color attach="background" args={[0x223344]} />
      <Turning />
    </Canvas>
  );
}
