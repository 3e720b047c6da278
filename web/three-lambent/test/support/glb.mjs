// A small writer of .glb scenes, so that tests bake what they need and nothing is kept in git.
import { deflateSync } from "node:zlib";

/** Chunks, padded to four bytes. */
export function glb(json, bin) {
  const text = Buffer.from(JSON.stringify(json));
  const pad = (bytes, fill) =>
    Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4, fill)]);
  const chunks = [
    [0x4e4f534a, pad(text, 0x20)],
    [0x004e4942, pad(bin, 0)],
  ];
  const parts = [];
  for (const [type, data] of chunks) {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(data.length, 0);
    head.writeUInt32LE(type, 4);
    parts.push(head, data);
  }
  const header = Buffer.alloc(12);
  header.write("glTF", 0, "latin1");
  header.writeUInt32LE(2, 4);
  header.writeUInt32LE(12 + parts.reduce((sum, part) => sum + part.length, 0), 8);
  return Buffer.concat([header, ...parts]);
}

/** { json, bin } of a .glb. */
export function parseGlb(bytes) {
  const length = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.subarray(20, 20 + length).toString());
  return { json, bin: bytes.subarray(20 + length + 8) };
}

/**
 * @param meshes [{ name, positions, normals, uvs, colors?, indices, material }], arrays of numbers
 * @param materials glTF materials
 * @param images PNG files as buffers; texture i is image i
 */
export function sceneGlb(
  meshes,
  materials,
  images = [],
  samplers = [{ wrapS: 10497, wrapT: 33648 }],
) {
  const parts = [];
  const json = {
    asset: { version: "2.0" },
    scene: 0,
    scenes: [{ nodes: meshes.map((_, i) => i) }],
    nodes: meshes.map((mesh, i) => ({ mesh: i, name: mesh.name })),
    meshes: [],
    materials,
    accessors: [],
    bufferViews: [],
  };
  let length = 0;
  const view = (bytes) => {
    json.bufferViews.push({ buffer: 0, byteOffset: length, byteLength: bytes.length });
    const padded = Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4)]);
    parts.push(padded);
    length += padded.length;
    return json.bufferViews.length - 1;
  };
  const accessor = (values, type, componentType) => {
    const array = componentType === 5126 ? Float32Array.from(values) : Uint32Array.from(values);
    const size = { SCALAR: 1, VEC2: 2, VEC3: 3 }[type];
    const entry = {
      bufferView: view(Buffer.from(array.buffer)),
      componentType,
      type,
      count: values.length / size,
    };
    if (type === "VEC3") {
      const column = (c) => values.filter((_, i) => i % 3 === c).map(Math.fround);
      entry.min = [0, 1, 2].map((c) => Math.min(...column(c)));
      entry.max = [0, 1, 2].map((c) => Math.max(...column(c)));
    }
    json.accessors.push(entry);
    return json.accessors.length - 1;
  };
  for (const mesh of meshes) {
    const attributes = {
      POSITION: accessor(mesh.positions, "VEC3", 5126),
      NORMAL: accessor(mesh.normals, "VEC3", 5126),
    };
    if (mesh.uvs) attributes.TEXCOORD_0 = accessor(mesh.uvs, "VEC2", 5126);
    if (mesh.colors) attributes.COLOR_0 = accessor(mesh.colors, "VEC3", 5126);
    const indices = accessor(mesh.indices, "SCALAR", 5125);
    json.meshes.push({
      name: mesh.name,
      primitives: [{ attributes, indices, material: mesh.material }],
    });
  }
  if (images.length > 0) {
    json.images = images.map((png) => ({ bufferView: view(png), mimeType: "image/png" }));
    json.samplers = samplers;
    json.textures = images.map((_, i) => ({ source: i, sampler: 0 }));
  }
  json.buffers = [{ byteLength: length }];
  return glb(json, Buffer.concat(parts));
}

/** A PNG of 8-bit RGB; color(x, y) → [r, g, b]. */
export function png(width, height, color) {
  const channels = color(0, 0).length;
  const line = 1 + channels * width;
  const rows = Buffer.alloc(height * line);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) rows.set(color(x, y), y * line + 1 + channels * x);
  const table = Array.from({ length: 256 }, (_, n) => {
    let c = n;
    for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
    return c >>> 0;
  });
  const crc = (bytes) =>
    (bytes.reduce((c, byte) => table[(c ^ byte) & 255] ^ (c >>> 8), 0xffffffff) ^ 0xffffffff) >>> 0;
  const chunk = (type, data) => {
    const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
    const out = Buffer.alloc(body.length + 8);
    out.writeUInt32BE(data.length, 0);
    body.copy(out, 4);
    out.writeUInt32BE(crc(body), body.length + 4);
    return out;
  };
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, channels === 4 ? 6 : 2, 0, 0, 0], 8);
  return Buffer.concat([
    Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
    chunk("IHDR", header),
    chunk("IDAT", deflateSync(rows)),
    chunk("IEND", Buffer.alloc(0)),
  ]);
}

/** An uncompressed EXR of 32-bit RGB; color(x, y) → [r, g, b], row 0 on top. */
export function exr(width, height, color) {
  const text = (s) => Buffer.from(`${s}\0`, "latin1");
  const ints = (...values) => Buffer.from(Int32Array.from(values).buffer);
  const attribute = (name, type, data) =>
    Buffer.concat([text(name), text(type), ints(data.length), data]);
  const channel = (name) => Buffer.concat([text(name), ints(2, 0, 1, 1)]);
  const box = ints(0, 0, width - 1, height - 1);
  const floats = (...values) => Buffer.from(Float32Array.from(values).buffer);
  const header = Buffer.concat([
    ints(20000630, 2),
    attribute(
      "channels",
      "chlist",
      Buffer.concat([..."BGR"].map(channel).concat([Buffer.alloc(1)])),
    ),
    attribute("compression", "compression", Buffer.alloc(1)),
    attribute("dataWindow", "box2i", box),
    attribute("displayWindow", "box2i", box),
    attribute("lineOrder", "lineOrder", Buffer.alloc(1)),
    attribute("pixelAspectRatio", "float", floats(1)),
    attribute("screenWindowCenter", "v2f", floats(0, 0)),
    attribute("screenWindowWidth", "float", floats(1)),
    Buffer.alloc(1),
  ]);
  const rowBytes = 8 + 12 * width;
  const offsets = Buffer.alloc(8 * height);
  const rows = [];
  for (let y = 0; y < height; ++y) {
    offsets.writeBigUInt64LE(BigInt(header.length + offsets.length + y * rowBytes), 8 * y);
    const row = new Float32Array(3 * width);
    for (let x = 0; x < width; ++x) {
      const [r, g, b] = color(x, y);
      row[x] = b;
      row[width + x] = g;
      row[2 * width + x] = r;
    }
    rows.push(ints(y, 12 * width), Buffer.from(row.buffer));
  }
  return Buffer.concat([header, offsets, ...rows]);
}
