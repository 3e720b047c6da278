// What a program probably did not mean, said once on the console, with the remedy: nothing stays
// black without a word.

import type { Light, Matrix4, Object3D, Scene } from "three";
import type { RelitMesh } from "./relit-mesh.js";

/** What is known of the asset that is drawn. */
export interface Drawn {
  root: Object3D;
  /** How large it is, in its own units. */
  diagonal: number;
  updated: boolean;
  unlit: boolean;
  /** Whether anybody ever said what light, and what surroundings, it has. */
  lightGiven: boolean;
  environmentGiven: boolean;
  said: Set<string>;
}

function say({ said, root }: Drawn, kind: string, text: string): void {
  if (said.has(kind)) return;
  said.add(kind);
  console.warn(`three-lambent: ${root.name ? `"${root.name}"` : "an asset"} ${text}`);
}

function sceneOf(object: Object3D): Object3D {
  let at = object;
  while (at.parent) at = at.parent;
  return at;
}

/** The names of three's own lights around an object. */
function lightsAround(object: Object3D): string[] {
  const found = new Set<string>();
  sceneOf(object).traverse((each) => {
    if ((each as Light).isLight) found.add(each.type);
  });
  return [...found];
}

/** Whether one matrix turns and scales as another, to 1e-3. */
function turnsAlike(a: Matrix4, b: Matrix4): boolean {
  const scale = b.getMaxScaleOnAxis();
  return [0, 1, 2, 4, 5, 6, 8, 9, 10].every(
    (i) => !(Math.abs(a.elements[i] - b.elements[i]) > 1e-3 * scale),
  );
}

function movesAlike(a: Matrix4, b: Matrix4, diagonal: number): boolean {
  const most = 1e-3 * diagonal * b.getMaxScaleOnAxis();
  return [12, 13, 14].every((i) => {
    const [x, y] = [a.elements[i], b.elements[i]];
    return !(Math.abs(x - y) > most + 1e-6 * Math.abs(y));
  });
}

/** Of how a root stands in the world. */
export function adviseOnPlace(drawn: Drawn): void {
  const { matrixWorld } = drawn.root;
  const e = matrixWorld.elements;
  const scales = [0, 4, 8].map((i) => Math.hypot(e[i], e[i + 1], e[i + 2]));
  if (!e.every(Number.isFinite))
    say(drawn, "place", "stands nowhere: its matrix has a number that is not finite");
  else if (matrixWorld.determinant() < 0)
    say(
      drawn,
      "mirrored",
      "is mirrored (a negative scale), which its baked light cannot be: bake the mirrored scene",
    );
  else if (Math.max(...scales) > 1.01 * Math.min(...scales))
    say(
      drawn,
      "stretched",
      "is scaled unevenly, which its baked light cannot be: scale it by one number, or bake the " +
        "stretched scene",
    );
}

/** Of an object that is drawn with the material of one of the asset's meshes. */
export function adviseOnDrawing(
  drawn: Drawn,
  mesh: RelitMesh,
  scene: Scene,
  object: Object3D,
): void {
  if (drawn.unlit) return;
  if (!drawn.updated) {
    const how = "call asset.update(renderer) once a frame, before renderer.render()";
    return say(drawn, "update", `is drawn before it was ever relit: ${how}`);
  }
  const { matrixWorld } = drawn.root;
  if (object !== mesh.mesh) {
    if (!turnsAlike(object.matrixWorld, matrixWorld))
      say(
        drawn,
        "copy",
        `has a copy of mesh "${object.name}" that is turned otherwise, and shows the light of ` +
          "the original: make an instance of the whole by asset.instantiate(), or root.clone()",
      );
    else if ((object as Partial<typeof mesh.mesh>).geometry !== mesh.mesh.geometry)
      say(
        drawn,
        "geometry",
        `has a copy of mesh "${object.name}" that was made before the first update(), and lacks ` +
          "what the device needs: copy it after that, or use asset.instantiate()",
      );
  } else if (
    !turnsAlike(object.matrixWorld, matrixWorld) ||
    !movesAlike(object.matrixWorld, matrixWorld, drawn.diagonal)
  )
    say(
      drawn,
      "part",
      `has a part that moved by itself, mesh "${object.name}": its parts shade each other as ` +
        "they were baked. Move asset.root, or bake what moves as an asset of its own",
    );
  adviseOnLight(drawn, mesh, scene);
}

function adviseOnLight(drawn: Drawn, mesh: RelitMesh, scene: Scene): void {
  const around = scene.environment ? ", nor does scene.environment" : "";
  if (mesh.isMirror) {
    if (!drawn.environmentGiven && !drawn.said.has("environment")) {
      const instead = scene.environment ? "scene.environment is not looked at: " : "";
      say(
        drawn,
        "environment",
        "has mirrors, and nothing that they show where they do not see the asset itself: " +
          `${instead}call asset.setEnvironment({ texture }) with a latitude-longitude map`,
      );
    }
  } else if (mesh.transfer && !drawn.lightGiven && !drawn.said.has("light")) {
    const lights = lightsAround(drawn.root);
    const own = lights.length
      ? `three's own lights (${lights.join(", ")}) do not reach it${around}: `
      : around
        ? "scene.environment does not light it: "
        : "";
    say(
      drawn,
      "light",
      `has no light: ${own}call asset.setLight() with a LambentLight, such as ` +
        "LambentLight.fromEquirectangular(map) or new LambentLight().addDisc({ direction, " +
        "diameter, radiance })",
    );
  }
}
