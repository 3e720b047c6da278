// Which meshes are closed bodies, whose backs are not drawn, and where mirrors are captured from.
import assert from "node:assert/strict";
import { describe, it } from "node:test";
import * as THREE from "three";
import { isBody } from "../dist/asset/closed.js";
import { capturePlace } from "../dist/asset/mirror-place.js";

const ball = (radius, y = 0) => new THREE.SphereGeometry(radius, 32, 24).translate(0, y, 0);

/** Without its last triangles. */
function opened(geometry, triangles) {
  const { array } = geometry.index;
  return geometry.clone().setIndex([...array.slice(0, array.length - 3 * triangles)]);
}

/** Seen from inside. */
function turnedOver(geometry) {
  const corners = [...geometry.index.array];
  for (let i = 0; i < corners.length; i += 3)
    [corners[i], corners[i + 1]] = [corners[i + 1], corners[i]];
  return geometry.clone().setIndex(corners);
}

describe("closed bodies", () => {
  for (const [name, expected, geometry] of [
    ["a ball, whose seam and poles are vertices of their own", true, ball(1)],
    ["a box of six sides", true, new THREE.BoxGeometry(1, 2, 3)],
    ["without an index", true, new THREE.BoxGeometry(1, 2, 3).toNonIndexed()],
    ["large and far away", true, ball(1e3, 1e5)],
    ["tiny", true, ball(1e-6)],
    ["a knot", true, new THREE.TorusKnotGeometry(1, 0.3, 64, 12)],
    ["a ball with a hole", false, opened(ball(1), 1)],
    ["a room, seen from inside", false, turnedOver(new THREE.BoxGeometry(4, 3, 4))],
    ["a plane", false, new THREE.PlaneGeometry(1, 1, 4, 4)],
    ["a tube", false, new THREE.CylinderGeometry(1, 1, 1, 24, 1, true)],
    ["nothing", false, new THREE.BufferGeometry()],
    ["a single place", false, ball(0)],
  ])
    it(`${name}: ${expected ? "is" : "is not"}`, () => assert.equal(isBody(geometry), expected));

  it("numbers that are not finite are no body", () => {
    for (const bad of [NaN, Infinity]) {
      const geometry = ball(1);
      geometry.getAttribute("position").setX(3, bad);
      assert.equal(isBody(geometry), false);
    }
  });
});

describe("where a mirror is captured from", () => {
  const ring = new THREE.TorusGeometry(1, 0.1, 12, 48);

  it("its middle, if nothing hides it", () => {
    assert.ok(capturePlace(ring, [ball(0.5, 3)]).length() < 1e-6);
    assert.ok(capturePlace(ring, []).length() < 1e-6);
  });

  it("before it, where something stands in its middle", () => {
    for (const body of [ball(0.5), opened(ball(0.5), 3), turnedOver(ball(0.5))]) {
      const place = capturePlace(ring, [new THREE.PlaneGeometry(9, 9), body]);
      assert.ok(place.length() > 0.55, `${place.toArray()}`);
      const away = Math.hypot(Math.hypot(place.x, place.y) - 1, place.z);
      assert.ok(away > 0.1 && away < 0.3, `${away}`);
    }
  });

  it("its middle again, where all is inside", () =>
    assert.ok(capturePlace(ring, [ball(5)]).length() < 1e-6));
});
