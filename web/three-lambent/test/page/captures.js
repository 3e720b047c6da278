// The page of the tests of local captures: a capture of a few bodies whose radiance tells where they
// are, looked up along rays.
import * as THREE from "three";
import { LocalCapture } from "../dist/gpu/local-capture.js";
import { localCapture } from "../dist/generated/localCapture.js";

const renderer = new THREE.WebGLRenderer({ antialias: false });

const kVertex = `varying vec3 place;
void main() {
  place = position;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

/** What is there: radiance 1.5 + its place. */
function sceneOf({ room, balls, from }) {
  const scene = new THREE.Scene();
  const add = (geometry) =>
    scene.add(
      new THREE.Mesh(
        geometry,
        new THREE.ShaderMaterial({
          side: THREE.DoubleSide,
          vertexShader: kVertex,
          fragmentShader: `varying vec3 place;
uniform vec3 from;
void main() { gl_FragColor = vec4(1.5 + place, distance(place, from)); }`,
          uniforms: { from: { value: from } },
        }),
      ),
    );
  if (room) add(new THREE.BoxGeometry(...room.map((half) => 2 * half)));
  for (const { center, radius } of balls ?? [])
    add(new THREE.SphereGeometry(radius, 96, 64).translate(...center));
  return scene;
}

/** @param rays six numbers each, an origin and a unit direction; returns four for each */
export function look({ size, from: at, rays, ...bodies }) {
  const from = new THREE.Vector3(...at);
  const scene = sceneOf({ ...bodies, from });
  const capture = new LocalCapture(from, 0.01, 20);
  capture.draw(renderer, scene, size);
  const count = rays.length / 6;
  const texels = new Float32Array(8 * count);
  for (let i = 0; i < count; ++i) {
    texels.set(rays.slice(6 * i, 6 * i + 3), 4 * i);
    texels.set(rays.slice(6 * i + 3, 6 * i + 6), 4 * (count + i));
  }
  const given = new THREE.DataTexture(texels, count, 2, THREE.RGBAFormat, THREE.FloatType);
  given.needsUpdate = true;
  const target = new THREE.WebGLRenderTarget(count, 1, { type: THREE.FloatType });
  const screen = new THREE.Mesh(
    new THREE.PlaneGeometry(2, 2),
    new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3,
      vertexShader: `in vec3 position;
void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }`,
      fragmentShader: `precision highp float;
precision highp sampler2D;
precision highp samplerCube;
${localCapture}
uniform sampler2D given;
out vec4 seen;
void main() {
  int i = int(gl_FragCoord.x);
  seen = capturedAlong(texelFetch(given, ivec2(i, 0), 0).xyz, texelFetch(given, ivec2(i, 1), 0).xyz);
}`,
      uniforms: {
        given: { value: given },
        capture: { value: capture.texture },
        captureFrom: { value: from },
        hasCapture: { value: true },
      },
    }),
  );
  const only = new THREE.Scene().add(screen);
  renderer.setRenderTarget(target);
  renderer.render(only, new THREE.Camera());
  renderer.setRenderTarget(null);
  const seen = new Float32Array(4 * count);
  renderer.readRenderTargetPixels(target, 0, 0, count, 1, seen);
  for (const mesh of [...scene.children, screen]) {
    mesh.geometry.dispose();
    mesh.material.dispose();
  }
  given.dispose();
  target.dispose();
  capture.dispose();
  return [...seen];
}

window.look = look;
window.renderer = renderer;
window.ready = true;
