// Files that are damaged, cut off, or lie: each is an error that says where, and none hangs. What
// single members may hold is in spec/refused.json (refused.test.mjs).
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, it } from "node:test";
import { readTransfer } from "../dist/format/read.js";
import { parseGlb } from "./support/glb.mjs";

const kName = "LAMBENT_radiance_transfer";
const samples = new URL("../../../spec/samples/", import.meta.url);
const sample = (name) => parseGlb(readFileSync(new URL(name, samples)));

function read({ json, bin }) {
  const bytes = bin.buffer.slice(bin.byteOffset, bin.byteOffset + bin.byteLength);
  return readTransfer({
    json,
    buffer: async (index) => {
      assert.equal(index, 0);
      return bytes;
    },
  });
}

const rootOf = (file) => file.json.extensions[kName];
const objectOf = (file, mesh) => file.json.meshes[mesh].primitives[0].extensions?.[kName];

describe("samples", () => {
  for (const name of [
    "unoccluded-square.glb",
    "every-layout.glb",
    "bi-scale.glb",
    "relief.glb",
    "kept-shadowed.glb",
    "second-uvs.glb",
  ])
    it(name, async () => {
      const description = await read(sample(name));
      assert.ok(description.primitives.size > 0);
    });

  it("a patch of meso-structure may have heights", async () => {
    const { rtts } = await read(sample("relief.glb"));
    assert.equal(rtts[0].heights.length, 8 * 4);
    assert.equal(rtts[0].heights[1], 245);
    assert.equal((await read(sample("1.1/bi-scale.glb"))).rtts[0].heights, null);
  });

  it("a grid may lie on the second set of texture coordinates", async () => {
    const { primitives } = await read(sample("second-uvs.glb"));
    assert.equal(primitives.get("0/0").grid.texCoord, 1);
  });

  it("every layout has what the text says", async () => {
    const { primitives } = await read(sample("every-layout.glb"));
    const all = [...primitives.values()];
    assert.ok(
      all.some(
        (p) =>
          p.vectors?.channels === 3 &&
          p.vectors.albedoOutside &&
          p.vectors.numbers.encoding === "float16",
      ),
    );
    assert.ok(all.some((p) => p.grid?.width === 3 && p.grid.height === 2 && p.receivers === 6));
    assert.ok(
      all.some(
        (p) =>
          p.matrices?.outBands === 2 &&
          p.matrices.inBands === 3 &&
          p.matrices.numbers.encoding === "float32",
      ),
    );
  });

  it("the square's vectors are those of the text", async () => {
    const { primitives } = await read(sample("unoccluded-square.glb"));
    const { numbers } = primitives.get("0/0").vectors;
    const expected = [0.141047, 0.162868, 0, 0, 0, 0, -0.039424, 0, -0.068284];
    expected.forEach((value, i) => assert.ok(Math.abs(numbers.data[i] - value) < 1e-6));
  });

  it("kept shadowed transfer takes its shape from what stands beside it", async () => {
    const { primitives } = await read(sample("kept-shadowed.glb"));
    for (const { vectors, matrices, shadowed } of primitives.values()) {
      assert.equal(shadowed.vectors?.bands, vectors?.bands);
      assert.equal(shadowed.matrices?.outBands, matrices?.outBands);
    }
  });
});

describe("messages say what to do", () => {
  const cases = [
    ["2.0", /version: 2\.0 is newer than this package, .*: update three-lambent/],
    ["0.9", /version: 0\.9 is older than 1\.0: bake the scene anew/],
  ];
  for (const [version, message] of cases)
    it(`version ${version}`, async () => {
      const file = sample("unoccluded-square.glb");
      rootOf(file).version = version;
      await assert.rejects(read(file), message);
    });

  it("another count of numbers", async () => {
    const file = sample("unoccluded-square.glb");
    objectOf(file, 0).vectors.bands = 2;
    await assert.rejects(
      read(file),
      /36 numbers where 4 receivers × 1 channels × 4 coefficients need 16/,
    );
  });

  it("a node that moves", async () => {
    const file = sample("unoccluded-square.glb");
    file.json.nodes[0].translation = [0, 1, 0];
    await assert.rejects(read(file), /nodes\[0\]\.translation: moves .*: bake the scene as it/);
  });
});

describe("damage", () => {
  it("files cut off anywhere", async () => {
    for (const name of ["every-layout.glb", "bi-scale.glb", "kept-shadowed.glb"]) {
      const { json, bin } = sample(name);
      for (let length = 0; length < bin.length - 4; length += 61)
        await assert.rejects(
          read({ json, bin: bin.subarray(0, length) }),
          /LambentFormatError|cut off/,
        );
    }
  });

  it("any member replaced by something else is read or refused, and never anything besides", async () => {
    const wrong = [null, -1, 1e300, "x", [], {}, true, 0];
    for (const name of ["every-layout.glb", "bi-scale.glb", "kept-shadowed.glb"]) {
      const text = JSON.stringify(sample(name).json);
      const paths = [];
      const walk = (value, path) => {
        if (path.length > 0) paths.push(path);
        if (typeof value === "object" && value !== null)
          for (const key of Object.keys(value)) walk(value[key], [...path, key]);
      };
      walk(JSON.parse(text), []);
      const { bin } = sample(name);
      for (const path of paths)
        for (const value of wrong) {
          const json = JSON.parse(text);
          const parent = path.slice(0, -1).reduce((at, key) => at[key], json);
          parent[path.at(-1)] = value;
          if (!json.extensions?.[kName]) continue; // then it is an ordinary file
          try {
            await read({ json, bin });
          } catch (error) {
            assert.equal(
              error.name,
              "LambentFormatError",
              `${path.join(".")} = ${JSON.stringify(value)}: ${error.stack}`,
            );
          }
        }
    }
  });
});
