// glTF with the extension LAMBENT_radiance_transfer → AssetDescription. The file may come from
// anywhere: every count, bound and number is checked before anything is made of it, and nothing
// larger than the file's own buffers is allocated. As lambent/asset/read.cpp.

import { kMaxBands } from "../sh/basis.js";
import { AccessorReader, type GltfSource } from "./accessors.js";
import {
  kExtensionName,
  kFormatMajor,
  type AssetDescription,
  type BiScale,
  type Grid,
  type MacroMatrices,
  type Matrices,
  type PrimitiveTransfer,
  type RadianceTransferTexture,
  type TransferKind,
  type Vectors,
} from "./description.js";
import { Fields, kFloatMax } from "./fields.js";
import { findCarriers, type Carrier } from "./scene.js";

const kLargestGrid = 32768;
const kLargestRtt = 4096;
const kLargestViews = 64;
const kMostPasses = 2 ** 20;
const kMostCounted = 2 ** 31 - 1;
/** How far a tangent may be from unit length, and from right angles with its normal. */
const kTangentLength = 1e-3;
const kTangentLean = 1e-2;

function checkVersion(root: Fields): string {
  const version = root.string("version");
  const match = /^(\d+)\.(\d+)$/.exec(version);
  if (!match) root.fail("version", `is "${version}", not of the form "${kFormatMajor}.0"`);
  const major = Number(match[1]);
  if (major > kFormatMajor)
    root.fail(
      "version",
      `${version} is newer than this package, which reads ${kFormatMajor}.x: update three-lambent`,
    );
  if (major < kFormatMajor)
    root.fail("version", `${version} is older than ${kFormatMajor}.0: bake the scene anew`);
  return version;
}

/** Numbers of vectors whose shape is known. */
async function vectorNumbers(
  fields: Fields,
  accessors: AccessorReader,
  receivers: number,
  bands: number,
): Promise<Pick<Vectors, "numbers" | "channels">> {
  const channels = fields.channels("channels");
  const words = `${receivers} receivers × ${channels} channels × ${bands ** 2} coefficients`;
  const count = receivers * channels * bands ** 2;
  return { numbers: await accessors.numbers(fields, count, words, 0), channels };
}

/** Numbers of matrices whose shape is known. */
async function matrixNumbers(
  fields: Fields,
  accessors: AccessorReader,
  receivers: number,
  { outBands, inBands }: Pick<Matrices, "outBands" | "inBands">,
): Promise<Pick<Matrices, "numbers" | "channels">> {
  const channels = fields.channels("channels");
  const words =
    `${receivers} receivers × ${channels} channels × ${outBands ** 2} rows × ` +
    `${inBands ** 2} columns`;
  const count = receivers * channels * outBands ** 2 * inBands ** 2;
  return { numbers: await accessors.numbers(fields, count, words, 0), channels };
}

async function readVectors(
  fields: Fields,
  accessors: AccessorReader,
  receivers: number,
  most: number,
): Promise<Vectors> {
  const bands = bandsOf(fields, "bands", most);
  const albedo = fields.oneOf("albedo", ["included", "baseColor"]);
  const numbers = await vectorNumbers(fields, accessors, receivers, bands);
  return { ...numbers, bands, albedoOutside: albedo === "baseColor" };
}

async function readMatrices(
  fields: Fields,
  accessors: AccessorReader,
  receivers: number,
  most: number,
): Promise<Matrices> {
  const outBands = fields.integer("outBands", 1, kMaxBands);
  const inBands = bandsOf(fields, "inBands", most);
  const glossy = fields.numbers("glossy", 3) as [number, number, number];
  if (!glossy.every((k) => k >= 0 && k <= kFloatMax))
    fields.fail("glossy", "is below 0, or beyond what a float holds");
  const lobeExponent = fields.number("lobeExponent", 0);
  const shape = { outBands, inBands };
  const numbers = await matrixNumbers(fields, accessors, receivers, shape);
  return { ...numbers, ...shape, glossy, lobeExponent };
}

/** The direct light, kept beside what is interreflected (since format version 1.2). */
async function readShadowed(
  fields: Fields,
  accessors: AccessorReader,
  receivers: number,
  beside: { vectors: Vectors | null; matrices: Matrices | null },
  kind: TransferKind,
): Promise<PrimitiveTransfer["shadowed"]> {
  if (!fields.has("vectors") && !fields.has("matrices")) return null; // it says nothing
  if (kind !== "interreflected")
    fields.fail("", `kept beside interreflected transfer alone, and this asset's is ${kind}`);
  for (const key of ["vectors", "matrices"] as const)
    if (fields.has(key) !== (beside[key] !== null))
      fields.fail(key, fields.has(key) ? "has none beside it to be shadowed" : "is missing");
  const { vectors, matrices } = beside;
  return {
    vectors: vectors && {
      ...vectors,
      ...(await vectorNumbers(fields.object("vectors"), accessors, receivers, vectors.bands)),
    },
    matrices: matrices && {
      ...matrices,
      ...(await matrixNumbers(fields.object("matrices"), accessors, receivers, matrices)),
    },
  };
}

function bandsOf(fields: Fields, key: string, most: number): number {
  const bands = fields.integer(key, 1, kMaxBands);
  if (bands > most) fields.fail(key, `is ${bands}, more than the ${most} of the document's object`);
  return bands;
}

async function readGrid(fields: Fields, accessors: AccessorReader): Promise<Grid> {
  const width = fields.integer("width", 1, kLargestGrid);
  const height = fields.integer("height", 1, kLargestGrid);
  const texCoord = fields.integer("texCoord", 0, 1) as 0 | 1;
  const texels = width * height;
  await accessors.vectors(fields, "positions", texels);
  const normals = await accessors.vectors(fields, "normals", texels);
  const covered = (await accessors.read(fields, "covered", 5121, "SCALAR")) as Uint8Array;
  if (covered.length !== texels)
    fields.fail("covered", `${covered.length} flags where ${texels} texels need one each`);
  const odd = covered.findIndex((c) => c > 1);
  if (odd >= 0) fields.fail("covered", `is ${covered[odd]} at texel ${odd}, not 0 or 1`);
  return { width, height, texCoord, normals };
}

async function readMacro(
  fields: Fields,
  accessors: AccessorReader,
  receivers: number,
  bands: number,
  channels: 1 | 3,
): Promise<MacroMatrices> {
  const matrix = bands ** 4;
  const words = `${receivers} receivers × ${channels} channels × ${matrix}`;
  const count = receivers * channels * matrix;
  return { numbers: await accessors.numbers(fields, count, words, matrix), channels };
}

async function readBiScale(
  fields: Fields,
  accessors: AccessorReader,
  { vertices: receivers, normals }: Carrier,
  rtts: readonly RadianceTransferTexture[],
  most: number,
): Promise<BiScale> {
  const rtt = fields.integer("rtt", 0, kMostCounted);
  if (rtt >= rtts.length) fields.fail("rtt", `is ${rtt}, but the asset has ${rtts.length}`);
  const bands = bandsOf(fields, "bands", most);
  if (bands !== rtts[rtt].bands)
    fields.fail("bands", `is ${bands}, and its RTT's ${rtts[rtt].bands}`);
  const scale = fields.number("scale", 0);
  if (Math.fround(scale) === 0) fields.fail("scale", "is 0");
  const tangents = await accessors.vectors(fields, "tangents", receivers);
  for (let i = 0; i < receivers; ++i) {
    const [x, y, z] = tangents.subarray(3 * i, 3 * i + 3);
    const [nx, ny, nz] = normals ? normals.subarray(3 * i, 3 * i + 3) : [0, 0, 0];
    const lean = (x * nx + y * ny + z * nz) / (Math.hypot(nx, ny, nz) || 1);
    if (Math.abs(Math.hypot(x, y, z) - 1) > kTangentLength || Math.abs(lean) > kTangentLean)
      fields.fail(
        "tangents",
        `that of vertex ${i} is not of unit length at right angles to the normal`,
      );
  }
  if (fields.has("idMap") === fields.has("tiles"))
    fields.fail("idMap", "exactly one of idMap and tiles says where the patch stands");
  let idMap: BiScale["idMap"] = null;
  if (fields.has("idMap")) {
    const map = fields.object("idMap");
    const width = map.integer("width", 1, kLargestGrid);
    const height = map.integer("height", 1, kLargestGrid);
    map.integer("texCoord", 0, 0);
    const ids = (await accessors.read(map, "accessor", 5123, "SCALAR")) as Uint16Array;
    if (ids.length !== 2 * width * height)
      map.fail("accessor", `${ids.length} numbers where ${width}×${height} texels need two each`);
    idMap = { width, height, ids };
  }
  let tiles: [number, number] = [1, 1];
  if (fields.has("tiles")) tiles = fields.numbers("tiles", 2) as [number, number];
  if (!tiles.map(Math.fround).every((t) => Number.isFinite(t) && t !== 0))
    fields.fail("tiles", "must be finite and not 0");
  const layer = fields.has("layer") && fields.boolean("layer");
  let shadowed: MacroMatrices | null = null;
  if (fields.has("shadowed"))
    shadowed = await readMacro(fields.object("shadowed"), accessors, receivers, bands, 1);
  let interreflected: MacroMatrices | null = null;
  if (fields.has("interreflected")) {
    const object = fields.object("interreflected");
    const channels = object.channels("channels");
    interreflected = await readMacro(object, accessors, receivers, bands, channels);
  }
  return { rtt, bands, scale, tangents, idMap, tiles, layer, shadowed, interreflected };
}

async function readRtt(
  fields: Fields,
  accessors: AccessorReader,
): Promise<RadianceTransferTexture> {
  const width = fields.integer("width", 1, kLargestRtt);
  const height = fields.integer("height", 1, kLargestRtt);
  const views = fields.integer("views", 1, kLargestViews);
  const bands = fields.integer("bands", 1, kMaxBands);
  const size = fields.numbers("size", 2) as [number, number];
  if (!size.map(Math.fround).every((metres) => metres > 0 && Number.isFinite(metres)))
    fields.fail("size", "is not two numbers above 0");
  const depth = fields.number("depth", 0);
  const plane = width * height * views * views * 3;
  const words = `${bands ** 2} coefficients × ${width}×${height} positions × ${views}×${views} views × 3`;
  const numbers = await accessors.numbers(
    fields.object("values"),
    bands ** 2 * plane,
    words,
    plane,
  );
  let heights: RadianceTransferTexture["heights"] = null;
  if (fields.has("heights")) {
    heights = (await accessors.read(fields, "heights", 5121, "SCALAR")) as Uint8Array;
    if (heights.length !== plane / 3)
      fields.fail("heights", `${heights.length} of them where ${plane / 3} are needed`);
  }
  const name = fields.has("name") ? fields.string("name") : "";
  return { name, width, height, views, bands, size, depth, numbers, heights };
}

async function readPrimitive(
  carrier: Carrier,
  accessors: AccessorReader,
  asset: AssetDescription,
): Promise<PrimitiveTransfer> {
  const { transfer: fields, vertices } = carrier;
  const { bands } = asset;
  const layout = fields.oneOf("layout", ["vertices", "texels"]);
  if (layout === "vertices" && fields.has("grid"))
    fields.fail("grid", "is for the layout texels alone");
  const grid = layout === "texels" ? await readGrid(fields.object("grid"), accessors) : null;
  const receivers = grid ? grid.width * grid.height : vertices;
  const pair = {
    vectors: fields.has("vectors")
      ? await readVectors(fields.object("vectors"), accessors, receivers, bands)
      : null,
    matrices: fields.has("matrices")
      ? await readMatrices(fields.object("matrices"), accessors, receivers, bands)
      : null,
  };
  const shadowed = fields.has("shadowed")
    ? await readShadowed(fields.object("shadowed"), accessors, receivers, pair, asset.transfer)
    : null;
  let biScale: BiScale | null = null;
  if (fields.has("biScale")) {
    if (layout !== "vertices") fields.fail("biScale", "its receivers must be vertices");
    if (pair.vectors || pair.matrices) fields.fail("biScale", "has vectors or matrices beside it");
    const object = fields.object("biScale");
    biScale = await readBiScale(object, accessors, carrier, asset.rtts, bands);
  }
  return { layout, receivers, ...pair, shadowed, grid, biScale };
}

/** What describes the bake: evaluation does not need it, but a file that lies is damaged. */
function checkBake(root: Fields): void {
  const seed = root.string("seed");
  if (!/^[0-9]{1,20}$/.test(seed) || BigInt(seed) >= 2n ** 64n)
    root.fail("seed", "is not a string of decimal digits, below 2^64");
  const energy = root.raw("passEnergy");
  if (
    !Array.isArray(energy) ||
    energy.length > kMostPasses ||
    !energy.every((e) => typeof e === "number" && Number.isFinite(e))
  )
    root.fail("passEnergy", `is not an array of at most ${kMostPasses} finite numbers`);
}

/**
 * Reads and checks all transfer of a document.
 *
 * @throws LambentFormatError that names the place, what is wrong with it, and the remedy
 */
export async function readTransfer(source: GltfSource): Promise<AssetDescription> {
  const { json } = source;
  const extensions = new Fields(json.extensions ?? {}, "extensions");
  if (!extensions.has(kExtensionName))
    extensions.fail(kExtensionName, "is missing: an ordinary glTF file, without transfer");
  const root = extensions.object(kExtensionName);
  const version = checkVersion(root); // first: the rest may mean something else
  const transfer = root.oneOf("transfer", ["unshadowed", "shadowed", "interreflected"]);
  root.oneOf("frame", ["scene"]);
  const bands = root.integer("bands", 1, kMaxBands);
  const accessors = new AccessorReader(source);
  const description: AssetDescription = {
    version,
    transfer,
    bands,
    generator: root.has("generator") ? root.string("generator") : "",
    directions: root.integer("directions", 0, kMostCounted),
    bounces: root.integer("bounces", 0, kMostCounted),
    rtts: [],
    primitives: new Map(),
  };
  checkBake(root);
  const carriers = await findCarriers(json, accessors);
  if (root.has("rtts")) {
    const list = root.raw("rtts");
    const rtts: unknown[] = Array.isArray(list) ? list : root.fail("rtts", "is not an array");
    for (const [i, rtt] of rtts.entries())
      description.rtts.push(await readRtt(new Fields(rtt, `${root.place}.rtts[${i}]`), accessors));
  }
  for (const carrier of carriers)
    description.primitives.set(carrier.key, await readPrimitive(carrier, accessors, description));
  return description;
}
