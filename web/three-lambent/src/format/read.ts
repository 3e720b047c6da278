// glTF with the extension LAMBENT_radiance_transfer → AssetDescription. The file may come from
// anywhere: every count, bound and number is checked before anything is made of it, and nothing
// larger than the file's own buffers is allocated. As lambent/asset/read.cpp.

import { kMaxBands } from "../sh/basis.js";
import { AccessorReader, type GltfSource } from "./accessors.js";
import {
  kExtensionName,
  kFormatMajor,
  LambentFormatError,
  type AssetDescription,
  type BiScale,
  type Grid,
  type MacroMatrices,
  type Matrices,
  type PrimitiveTransfer,
  type RadianceTransferTexture,
  type Vectors,
} from "./description.js";
import { Fields } from "./fields.js";

const kLargestGrid = 32768;
const kLargestRtt = 4096;
const kLargestViews = 64;

/** Whether a document says that it carries transfer. */
export function hasTransfer(json: unknown): boolean {
  const extensions = (json as { extensions?: unknown } | null)?.extensions;
  return typeof extensions === "object" && extensions !== null && kExtensionName in extensions;
}

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
  if (glossy.some((k) => k < 0)) fields.fail("glossy", "is below 0");
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
): Promise<PrimitiveTransfer["shadowed"]> {
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
  fields.integer("texCoord", 0, 0);
  const texels = width * height;
  await accessors.vectors(fields, "positions", texels);
  const normals = await accessors.vectors(fields, "normals", texels);
  const covered = (await accessors.read(fields, "covered", 5121, "SCALAR")) as Uint8Array;
  if (covered.length !== texels)
    fields.fail("covered", `${covered.length} flags where ${texels} texels need one each`);
  const odd = covered.findIndex((c) => c > 1);
  if (odd >= 0) fields.fail("covered", `is ${covered[odd]} at texel ${odd}, not 0 or 1`);
  return { width, height, normals };
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
  receivers: number,
  rtts: readonly RadianceTransferTexture[],
  most: number,
): Promise<BiScale> {
  const rtt = fields.integer("rtt", 0, 2 ** 31);
  if (rtt >= rtts.length) fields.fail("rtt", `is ${rtt}, but the asset has ${rtts.length}`);
  const bands = bandsOf(fields, "bands", most);
  const scale = fields.number("scale", 0);
  if (scale === 0) fields.fail("scale", "is 0");
  const tangents = await accessors.vectors(fields, "tangents", receivers);
  for (let i = 0; i < receivers; ++i) {
    const length = Math.hypot(tangents[3 * i], tangents[3 * i + 1], tangents[3 * i + 2]);
    if (Math.abs(length - 1) > 1e-3)
      fields.fail("tangents", `that of vertex ${i} is not of unit length`);
  }
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
  else if (!idMap) fields.fail("", "has neither an idMap nor tiles");
  let shadowed: MacroMatrices | null = null;
  if (fields.has("shadowed"))
    shadowed = await readMacro(fields.object("shadowed"), accessors, receivers, bands, 1);
  let interreflected: MacroMatrices | null = null;
  if (fields.has("interreflected")) {
    const object = fields.object("interreflected");
    const channels = object.channels("channels");
    interreflected = await readMacro(object, accessors, receivers, bands, channels);
  }
  return { rtt, bands, scale, tangents, idMap, tiles, shadowed, interreflected };
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
  if (!(size[0] > 0 && size[1] > 0)) fields.fail("size", "is not two numbers above 0");
  const plane = width * height * views * views * 3;
  const words = `${bands ** 2} coefficients × ${width}×${height} positions × ${views}×${views} views × 3`;
  const numbers = await accessors.numbers(
    fields.object("values"),
    bands ** 2 * plane,
    words,
    plane,
  );
  const name = fields.has("name") ? fields.string("name") : "";
  return { name, width, height, views, bands, size, numbers };
}

async function readPrimitive(
  fields: Fields,
  accessors: AccessorReader,
  primitive: Fields,
  rtts: readonly RadianceTransferTexture[],
  bands: number,
): Promise<PrimitiveTransfer> {
  const attributes = primitive.object("attributes");
  const vertices = accessors.accessor(attributes, "POSITION").integer("count", 1, 2 ** 32);
  if (primitive.has("mode") && primitive.integer("mode", 0, 6) !== 4)
    primitive.fail("mode", "is not triangles, which is all that transfer is baked for");
  if (primitive.has("targets"))
    primitive.fail("targets", "morph targets deform a mesh with baked transfer: remove them");
  const layout = fields.oneOf("layout", ["vertices", "texels"]);
  const grid = layout === "texels" ? await readGrid(fields.object("grid"), accessors) : null;
  const receivers = grid ? grid.width * grid.height : vertices;
  const biScaleHere = fields.has("biScale");
  if ((grid || biScaleHere) && !attributes.has("TEXCOORD_0"))
    primitive.fail("attributes", "TEXCOORD_0 is missing, which transfer is looked up with");

  const pair = {
    vectors: fields.has("vectors")
      ? await readVectors(fields.object("vectors"), accessors, receivers, bands)
      : null,
    matrices: fields.has("matrices")
      ? await readMatrices(fields.object("matrices"), accessors, receivers, bands)
      : null,
  };
  const shadowed =
    fields.has("shadowed") && !biScaleHere
      ? await readShadowed(fields.object("shadowed"), accessors, receivers, pair)
      : null;
  let biScale: BiScale | null = null;
  if (biScaleHere) {
    if (layout !== "vertices") fields.fail("biScale", "its receivers must be vertices");
    if (pair.vectors || pair.matrices) fields.fail("biScale", "has vectors or matrices beside it");
    const object = fields.object("biScale");
    biScale = await readBiScale(object, accessors, receivers, rtts, bands);
  }
  return { layout, receivers, ...pair, shadowed, grid, biScale };
}

/** Transfer belongs to a place in the scene: no node may carry its mesh elsewhere. */
function checkNodes(json: Record<string, unknown>, carriers: ReadonlySet<number>): void {
  const nodes = Array.isArray(json.nodes) ? (json.nodes as unknown[]) : [];
  const parents = new Map<number, number>();
  nodes.forEach((node, i) => {
    const children = (node as { children?: unknown } | null)?.children;
    if (Array.isArray(children))
      for (const child of children) if (Number.isInteger(child)) parents.set(child, i);
  });
  const identity = {
    matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    translation: [0, 0, 0],
    rotation: [0, 0, 0, 1],
    scale: [1, 1, 1],
  };
  nodes.forEach((node, i) => {
    const object = node as Record<string, unknown> | null;
    if (!object || !carriers.has(object.mesh as number)) return;
    if (object.skin !== undefined)
      throw new LambentFormatError(
        `nodes[${i}].skin: deforms a mesh with baked transfer: remove it, or bake the deformed mesh`,
      );
    let at: number | undefined = i;
    for (let steps = 0; at !== undefined && steps <= nodes.length; ++steps) {
      const here = nodes[at] as Record<string, unknown> | null;
      for (const [key, expected] of Object.entries(identity)) {
        const value = here?.[key];
        const same =
          value === undefined ||
          (Array.isArray(value) &&
            value.length === expected.length &&
            value.every((v, k) => v === expected[k]));
        if (!same)
          throw new LambentFormatError(
            `nodes[${at}].${key}: moves a mesh away from where its transfer was baked: ` +
              "bake the scene as it stands now",
          );
      }
      at = parents.get(at);
    }
  });
}

/**
 * Reads and checks all transfer of a document.
 *
 * @throws LambentFormatError that names the place, what is wrong with it, and the remedy
 */
export async function readTransfer(source: GltfSource): Promise<AssetDescription> {
  const { json } = source;
  const root = new Fields(
    (json.extensions as Record<string, unknown>)[kExtensionName],
    `extensions.${kExtensionName}`,
  );
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
    directions: root.integer("directions", 0, 2 ** 31),
    bounces: root.integer("bounces", 0, 2 ** 31),
    rtts: [],
    primitives: new Map(),
  };
  if (root.has("rtts")) {
    const list = root.raw("rtts");
    const rtts: unknown[] = Array.isArray(list) ? list : root.fail("rtts", "is not an array");
    for (const [i, rtt] of rtts.entries())
      description.rtts.push(await readRtt(new Fields(rtt, `${root.place}.rtts[${i}]`), accessors));
  }
  const carriers = new Set<number>();
  const meshes = Array.isArray(json.meshes) ? (json.meshes as unknown[]) : [];
  for (const [m, mesh] of meshes.entries()) {
    const primitives = (mesh as { primitives?: unknown } | null)?.primitives;
    if (!Array.isArray(primitives)) continue;
    for (const [p, value] of primitives.entries()) {
      const place = `meshes[${m}].primitives[${p}]`;
      const object = (value as { extensions?: Record<string, unknown> } | null)?.extensions?.[
        kExtensionName
      ];
      if (object === undefined) continue;
      carriers.add(m);
      description.primitives.set(
        `${m}/${p}`,
        await readPrimitive(
          new Fields(object, `${place}.extensions.${kExtensionName}`),
          accessors,
          new Fields(value, place),
          description.rtts,
          bands,
        ),
      );
    }
  }
  checkNodes(json, carriers);
  return description;
}
