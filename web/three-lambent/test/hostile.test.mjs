// Files that are damaged, cut off, or lie: each is an error that says where, and none hangs.
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
    "kept-shadowed.glb",
  ])
    it(name, async () => {
      const description = await read(sample(name));
      assert.ok(description.primitives.size > 0);
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

describe("versions", () => {
  const cases = [
    ["1.99", null],
    ["2.0", /version: 2\.0 is newer than this package/],
    ["0.9", /version: 0\.9 is older than 1\.0/],
    ["one", /version: is "one"/],
    [1.2, /version: is not a string/],
  ];
  for (const [version, message] of cases)
    it(String(version), async () => {
      const file = sample("unoccluded-square.glb");
      rootOf(file).version = version;
      if (message) await assert.rejects(read(file), message);
      else await read(file);
    });
});

describe("damage", () => {
  /** A change to a sample, and what is to be said about it. */
  const cases = [
    ["no frame", "unoccluded-square.glb", (f) => delete rootOf(f).frame, /frame: is missing/],
    [
      "bands of 11",
      "unoccluded-square.glb",
      (f) => (rootOf(f).bands = 11),
      /bands: is 11, not an integer from 1 to 10/,
    ],
    [
      "bands of 2.5",
      "unoccluded-square.glb",
      (f) => (objectOf(f, 0).vectors.bands = 2.5),
      /vectors\.bands: is 2\.5/,
    ],
    [
      "other bands than numbers",
      "unoccluded-square.glb",
      (f) => (objectOf(f, 0).vectors.bands = 2),
      /36 numbers where 4 receivers × 1 channels × 4 coefficients need 16/,
    ],
    [
      "two channels",
      "unoccluded-square.glb",
      (f) => (objectOf(f, 0).vectors.channels = 2),
      /channels: is 2, not 1 or 3/,
    ],
    [
      "no such accessor",
      "unoccluded-square.glb",
      (f) => (objectOf(f, 0).vectors.accessor = 99),
      /accessor 99 does not exist/,
    ],
    [
      "an accessor below 0",
      "unoccluded-square.glb",
      (f) => (objectOf(f, 0).vectors.accessor = -1),
      /accessor: is -1/,
    ],
    [
      "another component type",
      "unoccluded-square.glb",
      (f) => (objectOf(f, 0).vectors.encoding = "float16"),
      /holds SCALAR of 5126 where SCALAR of 5123 is needed/,
    ],
    [
      "an unknown encoding",
      "unoccluded-square.glb",
      (f) => (objectOf(f, 0).vectors.encoding = "snorm8"),
      /encoding: is "snorm8", not float16 or float32/,
    ],
    [
      "a count beyond the buffer",
      "unoccluded-square.glb",
      (f) => (f.json.accessors[objectOf(f, 0).vectors.accessor].count = 1e12),
      /overlap|beyond the end/,
    ],
    [
      "a view beyond the buffer",
      "unoccluded-square.glb",
      (f) => f.json.bufferViews.forEach((v) => (v.byteOffset = 1e9)),
      /reaches beyond the end of its buffer/,
    ],
    [
      "a view without a length",
      "unoccluded-square.glb",
      (f) => f.json.bufferViews.forEach((v) => delete v.byteLength),
      /byteLength: is missing/,
    ],
    [
      "sparse",
      "unoccluded-square.glb",
      (f) => (f.json.accessors[objectOf(f, 0).vectors.accessor].sparse = { count: 1 }),
      /sparse/,
    ],
    [
      "an unknown layout",
      "unoccluded-square.glb",
      (f) => (objectOf(f, 0).layout = "faces"),
      /layout: is "faces", not vertices or texels/,
    ],
    [
      "an object that is a list",
      "unoccluded-square.glb",
      (f) => (f.json.meshes[0].primitives[0].extensions[kName] = []),
      /is not an object/,
    ],
    [
      "a node that moves",
      "unoccluded-square.glb",
      (f) => (f.json.nodes[0].translation = [0, 1, 0]),
      /nodes\[0\]\.translation: moves a mesh away/,
    ],
    [
      "a node that is its own child",
      "unoccluded-square.glb",
      (f) => (f.json.nodes[0].children = [0]),
      null,
    ],
    ["a skin", "unoccluded-square.glb", (f) => (f.json.nodes[0].skin = 0), /skin/],
    [
      "morph targets",
      "unoccluded-square.glb",
      (f) => (f.json.meshes[0].primitives[0].targets = []),
      /morph targets/,
    ],
    [
      "lines",
      "unoccluded-square.glb",
      (f) => (f.json.meshes[0].primitives[0].mode = 1),
      /triangles/,
    ],
    [
      "a grid of other texels",
      "every-layout.glb",
      (f) => (texels(f).grid.width = 4),
      /18 numbers|vectors where 8 are needed|6 vectors where 8/,
    ],
    [
      "a grid of a million texels",
      "every-layout.glb",
      (f) => Object.assign(texels(f).grid, { width: 32768, height: 32768 }),
      /vectors where 1073741824 are needed/,
    ],
    [
      "a grid without UVs",
      "every-layout.glb",
      (f) => f.json.meshes.forEach((m) => delete m.primitives[0].attributes.TEXCOORD_0),
      /TEXCOORD_0 is missing/,
    ],
    [
      "a lobe that is no number",
      "every-layout.glb",
      (f) => (glossy(f).matrices.lobeExponent = "16"),
      /lobeExponent: is "16"/,
    ],
    [
      "glossy below 0",
      "every-layout.glb",
      (f) => (glossy(f).matrices.glossy = [1, -1, 1]),
      /glossy: is below 0/,
    ],
    [
      "glossy of two numbers",
      "every-layout.glb",
      (f) => (glossy(f).matrices.glossy = [1, 1]),
      /glossy: is not an array of 3/,
    ],
    [
      "no such rtt",
      "bi-scale.glb",
      (f) => (objectOf(f, 0).biScale.rtt = 7),
      /rtt: is 7, but the asset has 1/,
    ],
    [
      "an rtt of no size",
      "bi-scale.glb",
      (f) => (rootOf(f).rtts[0].size = [0, 1]),
      /size: is not two numbers above 0/,
    ],
    [
      "an rtt of other views",
      "bi-scale.glb",
      (f) => (rootOf(f).rtts[0].views = 3),
      /values\.accessor: .* numbers where/,
    ],
    [
      "rtts that are no list",
      "bi-scale.glb",
      (f) => (rootOf(f).rtts = {}),
      /rtts: is not an array/,
    ],
    ["a scale of 0", "bi-scale.glb", (f) => (objectOf(f, 0).biScale.scale = 0), /scale: is 0/],
    [
      "no place of the patch",
      "bi-scale.glb",
      (f) =>
        f.json.meshes.forEach((m) => {
          const b = m.primitives[0].extensions[kName].biScale;
          delete b.idMap;
          delete b.tiles;
        }),
      /neither an idMap nor tiles/,
    ],
    [
      "no scales",
      "bi-scale.glb",
      (f) => delete rootOf(f).rtts[0].values.scales,
      /scales: is missing/,
    ],
    [
      "shadowed beside nothing",
      "kept-shadowed.glb",
      (f) => {
        const o = objectOf(f, 0);
        o.shadowed.matrices = o.shadowed.vectors;
      },
      /shadowed\.matrices: has none beside it/,
    ],
    [
      "half of the shadowed",
      "kept-shadowed.glb",
      (f) => delete objectOf(f, 0).shadowed.vectors,
      /shadowed\.vectors: is missing/,
    ],
  ];
  const carrying = (file, test) =>
    file.json.meshes.map((_, i) => objectOf(file, i)).find((object) => object && test(object));
  const texels = (file) => carrying(file, (o) => o.layout === "texels");
  const glossy = (file) => carrying(file, (o) => o.matrices);
  for (const [name, from, change, message] of cases)
    it(name, async () => {
      const file = sample(from);
      change(file);
      if (message) await assert.rejects(read(file), message);
      else await read(file);
    });

  it("numbers that are not finite, wherever they are", async () => {
    for (const [name, find] of [
      ["unoccluded-square.glb", (f) => objectOf(f, 0).vectors],
      ["every-layout.glb", (f) => glossy(f).matrices],
      ["bi-scale.glb", (f) => ({ accessor: objectOf(f, 0).biScale.tangents })],
      ["bi-scale.glb", (f) => ({ accessor: rootOf(f).rtts[0].values.scales })],
    ]) {
      const file = sample(name);
      const view = file.json.bufferViews[file.json.accessors[find(file).accessor].bufferView];
      for (const bad of [NaN, Infinity]) {
        const damaged = { json: file.json, bin: Buffer.from(file.bin) };
        damaged.bin.writeFloatLE(bad, (view.byteOffset ?? 0) + 4);
        await assert.rejects(read(damaged), /not finite|not a finite/);
      }
    }
  });

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
            if (error.code === "ERR_ASSERTION") continue; // a buffer that the document lacks
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
