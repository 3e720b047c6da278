// Baked assets through glTF-Transform: every triangle keeps its corners' transfer, or writing says
// what is wrong. Triangles are compared whatever their sequence, corners by what they hold.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join as path } from "node:path";
import { after, before, describe, it } from "node:test";
import { Logger, NodeIO } from "@gltf-transform/core";
import { ALL_EXTENSIONS } from "@gltf-transform/extensions";
import * as transforms from "@gltf-transform/functions";
import draco3d from "draco3dgltf";
import { MeshoptDecoder, MeshoptEncoder, MeshoptSimplifier } from "meshoptimizer";
import sharp from "sharp";
import { hasBacks } from "../dist/asset/two-sides.js";
import { readTransfer } from "../dist/format/read.js";
import { LambentRadianceTransfer } from "../dist/gltf-transform/index.js";
import { glb, parseGlb } from "./support/glb.mjs";
import { patched } from "./support/patch.mjs";
import { environmentExr, leafScene, mirrorScene, sheetScene } from "./support/scenes.mjs";
import { lambent, noTool } from "./support/tool.mjs";

const spec = new URL("../../../spec/", import.meta.url);
const sampleOf = (name) => readFileSync(new URL(`samples/${name}`, spec));
await Promise.all([MeshoptDecoder.ready, MeshoptEncoder.ready, MeshoptSimplifier.ready]);

const said = [];
const logger = { debug() {}, info() {}, warn: (text) => said.push(text), error() {} };
const makeIo = async () =>
  new NodeIO()
    .setLogger(logger)
    .registerExtensions([...ALL_EXTENSIONS, LambentRadianceTransfer])
    .registerDependencies({
      "meshopt.decoder": MeshoptDecoder,
      "meshopt.encoder": MeshoptEncoder,
      "draco3d.encoder": await draco3d.createEncoderModule(),
      "draco3d.decoder": await draco3d.createDecoderModule(),
    });
const io = await makeIo();

/** What a reader of this package makes of a file; views that meshopt packed are unpacked. */
async function read(bytes) {
  const { json, bin } = parseGlb(Buffer.from(bytes));
  const whole = bin.buffer.slice(bin.byteOffset, bin.byteOffset + bin.byteLength);
  const unpacked = (index) => {
    const packed = json.bufferViews[index].extensions.EXT_meshopt_compression;
    const { byteOffset = 0, byteLength, count, byteStride, mode, filter } = packed;
    const out = new Uint8Array(count * byteStride);
    const from = new Uint8Array(whole, byteOffset, byteLength);
    MeshoptDecoder.decodeGltfBuffer(out, count, byteStride, from, mode, filter);
    return out.buffer;
  };
  const source = { json, buffer: async () => whole, bufferView: async (i) => unpacked(i) };
  return {
    json,
    transfer: await readTransfer(source),
    numbersOf: numbersOf(json, whole, unpacked),
  };
}

/** Elements of an accessor as arrays of numbers. */
const numbersOf = (json, whole, unpacked) => (index) => {
  const { bufferView, byteOffset = 0, componentType, type, count } = json.accessors[index];
  const view = json.bufferViews[bufferView];
  const packed = view.extensions?.EXT_meshopt_compression;
  const width = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 }[type];
  const [size, get] = {
    5120: [1, "getInt8"],
    5121: [1, "getUint8"],
    5122: [2, "getInt16"],
    5123: [2, "getUint16"],
    5125: [4, "getUint32"],
    5126: [4, "getFloat32"],
  }[componentType];
  const data = packed
    ? new DataView(unpacked(bufferView))
    : new DataView(whole, view.byteOffset ?? 0, view.byteLength);
  const stride = view.byteStride ?? packed?.byteStride ?? size * width;
  return Array.from({ length: count }, (_, i) =>
    Array.from({ length: width }, (_, c) => data[get](byteOffset + i * stride + c * size, true)),
  );
};

const rowsOf = (numbers, receivers) => {
  const each = numbers.data.length / receivers;
  return (k) => [
    ...numbers.data.subarray(k * each, (k + 1) * each),
    ...(numbers.scales ? [numbers.scales[(k * each) / numbers.run]] : []),
  ];
};

/** All numbers that follow vertices, of a vertex; and those that do not, as one text. */
function transferOf({ layout, receivers, vectors, matrices, shadowed, grid, biScale }) {
  const parts = [vectors, matrices, shadowed?.vectors, shadowed?.matrices];
  parts.push(biScale?.shadowed, biScale?.interreflected);
  const held = parts.filter(Boolean);
  const { vectors: v, matrices: m } = { vectors, matrices };
  const whole = JSON.stringify([
    ...[layout, v?.bands, v?.channels, v?.albedoOutside, m?.glossy, m?.lobeExponent],
    ...[biScale?.rtt, biScale?.scale, biScale?.tiles, [...(biScale?.idMap?.ids ?? [])]],
    grid && [grid.width, grid.texCoord, [...grid.normals]],
    layout === "texels" ? held.map(({ numbers }) => [...numbers.data]) : "",
  ]);
  const rows = layout === "texels" ? [] : held.map(({ numbers }) => rowsOf(numbers, receivers));
  const tangents = biScale ? [(k) => [...biScale.tangents.subarray(3 * k, 3 * k + 3)]] : [];
  return { whole, of: (k) => [...rows, ...tangents].map((row) => row(k)), uvs: grid ?? biScale };
}

/** Every triangle with transfer as one text, sorted; and every corner. */
async function trianglesOf(bytes) {
  const { json, transfer, numbersOf } = await read(bytes);
  const triangles = [];
  const corners = new Set();
  for (const [key, primitive] of transfer.primitives) {
    const [m, p] = key.split("/").map(Number);
    const { attributes, indices } = json.meshes[m].primitives[p];
    const { whole, of, uvs } = transferOf(primitive);
    const names = ["POSITION", "NORMAL", ...(uvs ? [`TEXCOORD_${uvs.texCoord ?? 0}`] : [])];
    const lists = names.map((name) => numbersOf(attributes[name]));
    const count = lists[0].length;
    const corner = (i) => JSON.stringify([...lists.map((list) => list[i]), ...of(i)]);
    const texts = Array.from({ length: count }, (_, i) => `${whole} ${corner(i)}`);
    const order = indices === undefined ? [...texts.keys()] : numbersOf(indices).flat();
    for (let i = 0; i < order.length; i += 3) {
      const three = [0, 1, 2].map((c) => texts[order[i + c]]);
      three.forEach((text) => corners.add(text));
      const least = three.indexOf([...three].sort()[0]); // turned so that the least is first
      triangles.push([0, 1, 2].map((c) => three[(least + c) % 3]).join("\n"));
    }
  }
  return { triangles: triangles.sort(), corners, rtts: JSON.stringify(transfer.rtts), json };
}

const meshopt = (level) => transforms.meshopt({ encoder: MeshoptEncoder, level });
const simplify = (error) =>
  transforms.simplify({ simplifier: MeshoptSimplifier, ratio: 0.5, error });
/** What is as it was after these, but for the sequence of things. */
const kKept = {
  nothing: [],
  dedup: [transforms.dedup()],
  prune: [transforms.prune({ keepSolidTextures: true })],
  weld: [transforms.weld()],
  unweld: [transforms.unweld()],
  quantize: [transforms.quantize()],
  "quantize within the scene": [transforms.quantize({ quantizationVolume: "scene" })],
  dequantize: [transforms.quantize(), transforms.dequantize()],
  reorder: [transforms.reorder({ encoder: MeshoptEncoder })],
  "meshopt, medium": [meshopt("medium")],
  "meshopt, high": [meshopt("high")],
  "flatten and join": [transforms.dedup(), transforms.flatten(), transforms.join()],
  sparse: [transforms.sparse({ ratio: 0.9 })],
  partition: [transforms.partition(), transforms.unpartition()],
  webp: [transforms.textureCompress({ encoder: sharp, targetFormat: "webp" })],
  "all of them": [
    transforms.dedup(),
    transforms.flatten(),
    transforms.join(),
    transforms.weld(),
    transforms.prune({ keepSolidTextures: true }),
    transforms.sparse(),
    meshopt("high"),
  ],
};

async function through(bytes, steps) {
  const document = await io.readBinary(new Uint8Array(bytes));
  await document.transform(...steps);
  return io.writeBinary(document);
}

async function keeps(bytes, except = []) {
  const original = await trianglesOf(bytes);
  assert.ok(original.triangles.length > 0);
  for (const [name, steps] of Object.entries(kKept)) {
    if (except.includes(name)) continue;
    const result = await trianglesOf(await through(bytes, steps));
    assert.equal(result.triangles.length, original.triangles.length, name);
    for (const [i, triangle] of result.triangles.entries())
      assert.equal(triangle, original.triangles[i], `${name}: triangle ${i}`);
    assert.equal(result.rtts, original.rtts, name);
    const used = result.json.accessors.length;
    assert.ok(!JSON.stringify(result.json).includes("_LAMBENT_"), `${name}: names of receivers`);
    assert.ok(used <= original.json.accessors.length, `${name}: ${used} accessors`);
  }
}

describe("samples of the format", () => {
  for (const name of [
    "unoccluded-square.glb",
    "every-layout.glb",
    "bi-scale.glb",
    "relief.glb",
    "kept-shadowed.glb",
    "second-uvs.glb",
    "1.0/every-layout.glb",
    "1.1/bi-scale.glb",
    "1.2/kept-shadowed.glb",
    "1.3/second-uvs.glb",
  ])
    it(name, () => keeps(sampleOf(name)));

  it("stay as they are when they are written, and can be written twice", async () => {
    const document = await io.readBinary(new Uint8Array(sampleOf("bi-scale.glb")));
    await document.transform(meshopt("high"));
    const accessors = document.getRoot().listAccessors().length;
    const first = await io.writeBinary(document);
    assert.equal(document.getRoot().listAccessors().length, accessors);
    assert.deepEqual(await io.writeBinary(document), first);
  });

  it("are kept by copies of a document", async () => {
    const bytes = sampleOf("every-layout.glb");
    const document = await io.readBinary(new Uint8Array(bytes));
    const copy = transforms.cloneDocument(document);
    await copy.transform(transforms.weld());
    const result = await trianglesOf(await io.writeBinary(copy));
    assert.deepEqual(result.triangles, (await trianglesOf(bytes)).triangles);
  });

  it("are read where the table of refused files takes them, and fail in words else", async () => {
    const table = JSON.parse(readFileSync(new URL("refused.json", spec), "utf8"));
    let [taken, refused] = [0, 0];
    for (const { name, sample, patch, refused: wrong } of table) {
      const { json, bin } = patched(parseGlb(sampleOf(sample)), patch);
      const file = glb(json, bin);
      // What glTF-Transform itself cannot read is none of ours, nor what it shows to no extension.
      let ordinary = json.extensionsUsed?.includes("LAMBENT_radiance_transfer");
      try {
        await new NodeIO().setLogger(logger).readBinary(new Uint8Array(file));
      } catch {
        ordinary = false;
      }
      if (!ordinary) continue;
      try {
        const written = await through(file, []);
        if (!wrong) assert.ok(await read(written), name);
        taken += 1;
      } catch (error) {
        assert.ok(wrong, `${name}: ${error.stack}`);
        refused += 1;
        assert.ok(
          error instanceof Error && !(error instanceof TypeError),
          `${name}: ${error.stack}`,
        );
      }
    }
    assert.ok(taken > 20 && refused > 20, `${taken} taken, ${refused} refused`);
  });
});

describe("what would break transfer", () => {
  const fails = async (steps, pattern, bytes = sampleOf("every-layout.glb")) => {
    const document = await io.readBinary(new Uint8Array(bytes));
    await document.transform(...[steps].flat());
    await assert.rejects(io.writeBinary(document), (error) => {
      assert.equal(error.name, "LambentFormatError", error.stack);
      assert.match(error.message, pattern);
      return true;
    });
    // The document is as it was, and can be mended.
    assert.ok(document.getRoot().listMeshes()[0].listPrimitives()[0].getAttribute("POSITION"));
  };
  const primitiveOf = (document) => document.getRoot().listMeshes()[0].listPrimitives()[0];
  const nodeOf = (document) => document.getRoot().listNodes()[0];

  it("Draco", () => fails(transforms.draco(), /KHR_draco.*meshopt\(\)/));
  it("palette", () => fails(transforms.palette({ min: 1 }), /baseColorTexture.*palette\(\)/));
  it("a mesh that is moved", () =>
    fails((d) => void nodeOf(d).setTranslation([0.1, 0, 0]), /was moved.*before the bake/));
  it("a mesh that is turned", () =>
    fails((d) => void nodeOf(d).setRotation([0, 1, 0, 0]), /turn the light/));
  it("a mesh that is shown twice", () =>
    fails((d) => {
      const again = d.createNode().setMesh(d.getRoot().listMeshes()[0]);
      d.getRoot().listScenes()[0].addChild(again);
    }, /more than one node/));
  it("lines", () => fails((d) => void primitiveOf(d).setMode(1), /no longer triangles/));
  it("morph targets", () =>
    fails((d) => void primitiveOf(d).addTarget(d.createPrimitiveTarget()), /targets/));
  it("receivers that were taken away", () =>
    fails((d) => {
      const primitive = primitiveOf(d);
      const name = primitive.listSemantics().find((s) => s.startsWith("_LAMBENT"));
      primitive.setAttribute(name, null);
    }, /leave it alone/));
  it("vertices that were added", () =>
    fails((d) => {
      const primitive = primitiveOf(d);
      for (const name of primitive.listSemantics()) {
        const attribute = primitive.getAttribute(name);
        const array = attribute.getArray();
        const longer = new array.constructor(array.length + attribute.getElementSize());
        longer.set(array);
        primitive.setAttribute(name, attribute.clone().setArray(longer));
      }
    }, /lost its transfer/));
  it("COLOR_0 that was taken away", () =>
    fails((d) => void primitiveOf(d).setAttribute("COLOR_0", null), /COLOR_0/));
  it("UVs of a grid that were replaced", () =>
    fails((d) => {
      const [uvs] = d
        .getRoot()
        .listMeshes()
        .map((mesh) => mesh.listPrimitives()[0])
        .filter((p) => p.getExtension("LAMBENT_radiance_transfer")?.getLayout() === "texels");
      const attribute = uvs.getAttribute("TEXCOORD_0");
      uvs.setAttribute(
        "TEXCOORD_0",
        attribute.clone().setArray(attribute.getArray().map((v) => v / 2)),
      );
    }, /TEXCOORD_0.*was replaced/));
  it("two assets in one", async () => {
    const [one, other] = await Promise.all(
      [0, 1].map(() => io.readBinary(new Uint8Array(sampleOf("unoccluded-square.glb")))),
    );
    transforms.mergeDocuments(one, other);
    await one.transform(transforms.unpartition());
    await assert.rejects(io.writeBinary(one), /baked apart/);
  });
  it("a material of another colour is said", async () => {
    said.length = 0;
    await through(sampleOf("unoccluded-square.glb"), [
      (d) => void d.getRoot().listMaterials()[0].setBaseColorFactor([1, 0, 0, 1]),
    ]);
    assert.ok(
      said.some((text) => /changed since the bake/.test(text)),
      said.join("\n"),
    );
  });
});

describe("baked scenes", { skip: noTool }, () => {
  let folder;
  before(() => {
    folder = mkdtempSync(path(tmpdir(), "lambent-"));
    writeFileSync(path(folder, "sky.exr"), environmentExr);
  });
  after(() => rmSync(folder, { recursive: true }));
  const bake = (name, scene) => {
    writeFileSync(path(folder, `${name}.glb`), scene);
    const options = ["--directions", "64", "--bounces", "1", "-q", "--refine", "off"];
    lambent(folder, "bake", `${name}.glb`, "-o", `${name}-baked.glb`, ...options);
    return readFileSync(path(folder, `${name}-baked.glb`));
  };

  it("keep two sides, with holes", async () => {
    for (const [name, scene] of [
      ["sheet", sheetScene],
      ["leaf", leafScene],
    ]) {
      const bytes = bake(name, scene);
      await keeps(bytes);
      for (const steps of [[meshopt("high")], [transforms.unweld()], kKept["all of them"]]) {
        const { json, numbersOf } = await read(await through(bytes, steps));
        const mesh = json.meshes.find((m) => m.name === name || m.name === "sheet");
        const { attributes, indices } = mesh.primitives[0];
        const [positions, order] = [numbersOf(attributes.POSITION), numbersOf(indices).flat()];
        const at = (c) => (i) => positions[i][c];
        const geometry = {
          getAttribute: () => ({ getX: at(0), getY: at(1), getZ: at(2) }),
          index: { count: order.length, getX: (i) => order[i] },
        };
        assert.ok(hasBacks(geometry), name);
      }
    }
  });

  it("join meshes of one material beside a mirror, and look the same", async () => {
    const bytes = bake("mirror", mirrorScene);
    const result = await through(bytes, kKept["all of them"]);
    writeFileSync(path(folder, "small.glb"), result);
    const { json } = parseGlb(Buffer.from(result));
    assert.equal(json.meshes.flatMap((m) => m.primitives).length, 2, "the matt ones are one");
    assert.deepEqual((await trianglesOf(result)).triangles, (await trianglesOf(bytes)).triangles);
    for (const name of ["mirror-baked", "small"])
      lambent(
        folder,
        "render",
        `${name}.glb`,
        "--light",
        "sky.exr",
        "-o",
        `${name}.exr`,
        "--size",
        "128x128",
        "-q",
      );
    const words = lambent(folder, "compare", "mirror-baked.exr", "small.exr", "--json", "-q");
    const { rmse } = JSON.parse(words);
    assert.ok(rmse < 1e-3, `RMSE ${rmse}`);
  });

  it("take fewer triangles, with the transfer of the vertices that stay", async () => {
    const bytes = bake("ball", mirrorScene);
    const original = await trianglesOf(bytes);
    const result = await trianglesOf(await through(bytes, [transforms.weld(), simplify(0.02)]));
    assert.ok(result.triangles.length < 0.8 * original.triangles.length);
    for (const corner of result.corners) assert.ok(original.corners.has(corner));
  });

  it("refuse to lose a texture that transfer is multiplied by", async () => {
    // A solid texture becomes a factor, unless one asks for it to stay.
    const { json, bin } = parseGlb(bake("leaf", leafScene));
    const document = await io.readBinary(new Uint8Array(glb(json, bin)));
    const material = document
      .getRoot()
      .listMaterials()
      .find((m) => m.getBaseColorTexture());
    material.setBaseColorTexture(null);
    await assert.rejects(io.writeBinary(document), /keepSolidTextures/);
  });
});
