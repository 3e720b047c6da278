// Accessors of a glTF document as typed arrays, with every bound checked. Nothing is copied where
// the bytes lie aligned in the file's own buffer.

import type { Numbers } from "./description.js";
import { Fields } from "./fields.js";

/** Where the bytes come from: a GLTFParser, or a test's own reader. */
export interface GltfSource {
  json: Record<string, unknown>;
  /** The bytes of `buffers[index]`. */
  buffer(index: number): Promise<ArrayBuffer>;
  /** The bytes of `bufferViews[index]` where an extension packs them; needed for such files only. */
  bufferView?(index: number): Promise<ArrayBuffer>;
}

const kBytes = { 5120: 1, 5121: 1, 5123: 2, 5125: 4, 5126: 4 } as const;
const kComponents = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 } as const;

type ComponentType = keyof typeof kBytes;
type ElementType = keyof typeof kComponents;

const kMostCount = 2 ** 40; // beyond any file; keeps products exact

function listOf(json: Record<string, unknown>, key: string): unknown[] {
  const list = json[key];
  return Array.isArray(list) ? list : [];
}

export class AccessorReader {
  private budget = 0;

  constructor(private readonly source: GltfSource) {
    for (const buffer of listOf(source.json, "buffers")) {
      const length = (buffer as { byteLength?: unknown } | null)?.byteLength;
      if (typeof length === "number" && length > 0) this.budget += length;
    }
  }

  /** The fields of `accessors[index]` that `fields.key` points to. */
  accessor(fields: Fields, key: string): Fields {
    const index = fields.integer(key, 0, 2 ** 31);
    const list = listOf(this.source.json, "accessors");
    if (index >= list.length)
      fields.fail(key, `accessor ${index} does not exist: the file has ${list.length}`);
    return new Fields(list[index], `${fields.place}.${key}: accessors[${index}]`);
  }

  private async bytes(
    accessor: Fields,
    count: number,
    elementBytes: number,
  ): Promise<{ buffer: ArrayBuffer; offset: number; stride: number }> {
    if (accessor.has("sparse")) accessor.fail("sparse", "is not allowed here");
    const viewIndex = accessor.integer("bufferView", 0, 2 ** 31);
    const views = listOf(this.source.json, "bufferViews");
    if (viewIndex >= views.length)
      accessor.fail("bufferView", `is ${viewIndex}, but the file has ${views.length}`);
    const view = new Fields(views[viewIndex], `bufferViews[${viewIndex}]`);
    const length = view.integer("byteLength", 0, kMostCount);
    const stride = view.has("byteStride")
      ? view.integer("byteStride", elementBytes, 1024)
      : elementBytes;
    const offset = accessor.has("byteOffset") ? accessor.integer("byteOffset", 0, kMostCount) : 0;
    if (count > 0 && offset + (count - 1) * stride + elementBytes > length)
      accessor.fail("", `${count} elements reach beyond the end of bufferViews[${viewIndex}]`);

    if (view.has("extensions") && view.object("extensions").has("EXT_meshopt_compression")) {
      const buffer = this.source.bufferView
        ? await this.source.bufferView(viewIndex)
        : view.fail("extensions", "compressed views cannot be read here");
      if (buffer.byteLength < length) view.fail("byteLength", "is more than was decompressed");
      return { buffer, offset, stride };
    }
    const buffer = await this.source.buffer(view.integer("buffer", 0, 2 ** 31));
    const begin = view.has("byteOffset") ? view.integer("byteOffset", 0, kMostCount) : 0;
    if (begin + length > buffer.byteLength)
      view.fail("", "reaches beyond the end of its buffer: the file is cut off or damaged");
    return { buffer, offset: begin + offset, stride };
  }

  /** Elements of the accessor that `fields.key` names, one after the other. */
  async read(
    fields: Fields,
    key: string,
    component: ComponentType,
    type: ElementType,
  ): Promise<Float32Array | Uint16Array | Uint8Array | Int8Array> {
    const accessor = this.accessor(fields, key);
    const found = [accessor.integer("componentType", 0, 65535), accessor.string("type")];
    if (found[0] !== component || found[1] !== type)
      accessor.fail("", `holds ${found[1]} of ${found[0]} where ${type} of ${component} is needed`);
    const count = accessor.integer("count", 0, kMostCount);
    const each = kComponents[type] * kBytes[component];
    // Accessors that overlap could otherwise ask for any amount of memory.
    this.budget -= count * each;
    if (this.budget < 0)
      accessor.fail("", "accessors overlap: together they are larger than the file's buffers");
    const { buffer, offset, stride } = await this.bytes(accessor, count, each);

    const make = (bytes: ArrayBuffer, at: number, length: number) =>
      component === 5126
        ? new Float32Array(bytes, at, length)
        : component === 5123
          ? new Uint16Array(bytes, at, length)
          : component === 5121
            ? new Uint8Array(bytes, at, length)
            : new Int8Array(bytes, at, length);
    const length = count * kComponents[type];
    if (stride === each && offset % kBytes[component] === 0) return make(buffer, offset, length);
    const packed = new Uint8Array(count * each);
    const from = new Uint8Array(buffer);
    for (let i = 0; i < count; ++i)
      packed.set(from.subarray(offset + i * stride, offset + i * stride + each), i * each);
    return make(packed.buffer, 0, length);
  }

  /** Vectors of three floats, all finite; `count` of them. */
  async vectors(fields: Fields, key: string, count: number): Promise<Float32Array> {
    const vectors = (await this.read(fields, key, 5126, "VEC3")) as Float32Array;
    if (vectors.length !== 3 * count)
      fields.fail(key, `${vectors.length / 3} vectors where ${count} are needed`);
    const wrong = vectors.findIndex((v) => !Number.isFinite(v));
    if (wrong >= 0) fields.fail(key, `not a finite number in element ${Math.floor(wrong / 3)}`);
    return vectors;
  }

  /**
   * A block of numbers in its encoding, all finite.
   *
   * @param count how many are needed, and in words where they come from
   * @param run for snorm8: the numbers that share a scale; 0: snorm8 is not allowed
   */
  async numbers(fields: Fields, count: number, words: string, run: number): Promise<Numbers> {
    const encoding = fields.oneOf(
      "encoding",
      run > 0 ? (["float16", "float32", "snorm8"] as const) : (["float16", "float32"] as const),
    );
    const component = { float16: 5123, float32: 5126, snorm8: 5120 } as const;
    const data = (await this.read(
      fields,
      "accessor",
      component[encoding],
      "SCALAR",
    )) as Numbers["data"];
    if (data.length !== count)
      fields.fail("accessor", `${data.length} numbers where ${words} need ${count}`);
    let scales: Float32Array | null = null;
    let wrong = -1;
    if (encoding === "snorm8") {
      scales = (await this.read(fields, "scales", 5126, "SCALAR")) as Float32Array;
      if (scales.length * run !== count)
        fields.fail("scales", `${scales.length} numbers where ${count / run} are needed`);
      wrong = scales.findIndex((v) => !Number.isFinite(v));
      if (wrong >= 0) wrong *= run;
    } else if (encoding === "float16") {
      wrong = firstNonFiniteHalf(data as Uint16Array);
    } else {
      wrong = firstNonFinite(data as Float32Array);
    }
    if (wrong >= 0) fields.fail("accessor", `number ${wrong} is not finite: bake the asset again`);
    return { encoding, data, scales, run };
  }
}

function firstNonFiniteHalf(data: Uint16Array): number {
  for (let i = 0; i < data.length; ++i) if ((data[i] & 0x7c00) === 0x7c00) return i;
  return -1;
}

function firstNonFinite(data: Float32Array): number {
  for (let i = 0; i < data.length; ++i) if (!Number.isFinite(data[i])) return i;
  return -1;
}
