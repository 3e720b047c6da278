// Marks over the picture that show how a patch lies: apps/viewer/patch_marks.h and the library's
// render/gl_marks.h. Seams are three-lambent's: shaders find them in the id map.
import {
  BufferAttribute,
  GLSL3,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  Mesh,
  NoBlending,
  Object3D,
  RawShaderMaterial,
  Vector2,
} from "three";
import type { LambentAsset } from "three-lambent";
import markGlsl from "../../../shaders/mark.glsl?raw";
import { anyOf, type Marks, type Overlays } from "./overlays";
import { areaOf, patchLay, strokeSpacing, surfaceOf, type Line, type PatchLay } from "./patch_lay";

type Color = readonly [number, number, number];
const kStrokes = 2000;
const kFieldColor: Color = [0.1, 0.9, 1];
const kCutColor: Color = [1.2, 0.9, 0.05];
const [kPositiveColor, kNegativeColor]: [Color, Color] = [[1.5, 0.12, 0.02], [0.05, 0.15, 1.5]];
const kRimColor: Color = [0.01, 0.01, 0.01];

const kVertex = `precision highp float;
${markGlsl}
in vec2 corner;
in vec3 from, to, normal, color;
in vec2 radii;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec2 size;  // of the picture, pixels
flat out vec4 ends;
flat out vec2 radii_;
flat out vec3 color_;

void main() {
  mat4 clipFromSurface = projectionMatrix * modelViewMatrix;
  vec3 upwards = vec3(clipFromSurface[0].y, clipFromSurface[1].y, clipFromSurface[2].y);
  float pixel = 2.0 / (length(upwards) * size.y);
  vec4 a = liftedMark(clipFromSurface, from, normal, pixel);
  vec4 b = liftedMark(clipFromSurface, to, normal, pixel);
  ends = markEnds(a, b, size);
  radii_ = radii;
  color_ = color;
  vec3 place = vec3(modelViewMatrix * vec4(from, 1.0));
  vec3 away = projectionMatrix[3][3] == 1.0 ? vec3(0.0, 0.0, 1.0) : -place;
  float facing = dot(normalize(mat3(modelViewMatrix) * normal), normalize(away));
  gl_Position = markCorner(a, b, facing, corner, size, max(radii.x, radii.y));
}`;

const kFragment = `precision highp float;
${markGlsl}
uniform vec2 size;
uniform float brightness;
flat in vec4 ends;
flat in vec2 radii_;
flat in vec3 color_;
out vec4 radiance;

void main() {
  if (!insideOfMark(gl_FragCoord.xy - 0.5 * size, ends, radii_)) discard;
  radiance = vec4(brightness * color_, 1.0);
}`;

interface Mark extends Line {
  color: Color;
  radii: readonly [number, number];
}

function marksOf(lay: PatchLay, shown: Overlays): Mark[] {
  const marks: Mark[] = [];
  if (shown.cuts)
    for (const cut of lay.cuts) marks.push({ ...cut, color: kCutColor, radii: [0.75, 0.75] });
  if (shown.field)
    for (const stroke of lay.field)
      marks.push({ ...stroke, color: kFieldColor, radii: [1.3, 0.4] });
  if (shown.singularities)
    for (const { position, normal, index } of lay.singularities) {
      const dot = { from: position, to: position, normal };
      marks.push({ ...dot, color: kRimColor, radii: [7, 7] });
      marks.push({ ...dot, color: index > 0 ? kPositiveColor : kNegativeColor, radii: [5.5, 5.5] });
    }
  return marks;
}

function geometryOf(marks: readonly Mark[]): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  geometry.instanceCount = marks.length;
  const corners = Float32Array.of(-1, -1, 1, -1, 1, 1, -1, 1);
  geometry.setAttribute("corner", new BufferAttribute(corners, 2));
  geometry.setIndex([0, 1, 2, 0, 2, 3]);
  const set = (name: string, width: number, numbers: (mark: Mark) => readonly number[]) =>
    geometry.setAttribute(
      name, new InstancedBufferAttribute(Float32Array.from(marks.flatMap(numbers)), width));
  set("from", 3, ({ from }) => from.toArray());
  set("to", 3, ({ to }) => to.toArray());
  set("normal", 3, ({ normal }) => normal.toArray());
  set("color", 3, ({ color }) => color);
  set("radii", 2, ({ radii }) => radii);
  return geometry;
}

/** Marks of an asset, to be drawn into the scene that it stands in. */
export class PatchMarks implements Marks {
  readonly object = new Object3D();
  private lays: { mesh: Mesh; lay: PatchLay }[] | null = null;
  private made = "";
  private readonly size = { value: new Vector2(1, 1) };
  private readonly brightness = { value: 1 };
  private readonly material = new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: kVertex,
    fragmentShader: kFragment,
    uniforms: { size: this.size, brightness: this.brightness },
    depthWrite: false,
    blending: NoBlending,
  });

  constructor(private readonly asset: LambentAsset) {
    this.object.name = "marks";
  }

  show(shown: Overlays, brightness: number, width: number, height: number): void {
    this.size.value.set(width, height);
    this.brightness.value = brightness;
    const wanted = JSON.stringify(shown);
    if (wanted !== this.made && this.remake(shown)) this.made = wanted;
    this.object.children.forEach((each, i) => {
      const { mesh } = this.lays![i]!;
      mesh.updateWorldMatrix(true, false);
      each.matrix.copy(mesh.matrixWorld);
      each.matrixWorldNeedsUpdate = true;
    });
  }
  /** How the patch lies on each mesh that carries one; [] before it was first shown. */
  get found(): readonly PatchLay[] {
    return (this.lays ?? []).map(({ lay }) => lay);
  }
  dispose(): void {
    this.clear();
    this.material.dispose();
  }

  private remake(shown: Overlays): boolean {
    this.lays ??= this.look();
    if (this.lays === null) return false;
    this.clear();
    if (!anyOf(shown)) return true;
    for (const { lay } of this.lays) {
      const marks = new Mesh(geometryOf(marksOf(lay, shown)), this.material);
      marks.frustumCulled = false;
      marks.matrixAutoUpdate = false;
      marks.renderOrder = 1; // over what it marks
      this.object.add(marks);
    }
    return true;
  }
  /** null: nothing of the asset has been lit yet. */
  private look(): { mesh: Mesh; lay: PatchLay }[] | null {
    const found = this.asset.meshes.flatMap((mesh) => {
      const surface = surfaceOf(mesh.geometry);
      return surface === null ? [] : [{ mesh, surface }];
    });
    if (found.length === 0) return null;
    const area = found.reduce((sum, { surface }) => sum + areaOf(surface), 0);
    const spacing = strokeSpacing(area, kStrokes);
    return found.map(({ mesh, surface }) => ({ mesh, lay: patchLay(surface, spacing) }));
  }
  private clear(): void {
    for (const each of this.object.children) (each as Mesh).geometry.dispose();
    this.object.clear();
  }
}
