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
type Elements = Float32Array | Uint32Array | Uint16Array | Uint8Array | Int8Array;
type ElementType = keyof typeof kComponents;

const kMostIndex = 2 ** 31 - 1;
const kMostCount = 2 ** 40; // beyond any file; keeps products exact

function listOf(json: Record<string, unknown>, key: string): unknown[] {
  const list = json[key];
  return Array.isArray(list) ? list : [];
}

export class AccessorReader {
  /** Bytes that were asked for, and those that were there to be asked for: buffers, packed views. */
  private asked = 0;
  private readonly there = new Map<string, number>();
  private readonly named = new Set<number>();

  constructor(private readonly source: GltfSource) {}

  /** The fields of `accessors[index]` that `fields.key` points to. */
  accessor(fields: Fields, key: string): Fields {
    const index = fields.integer(key, 0, kMostIndex);
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
    const viewIndex = accessor.integer("bufferView", 0, kMostIndex);
    const views = listOf(this.source.json, "bufferViews");
    if (viewIndex >= views.length)
      accessor.fail("bufferView", `is ${viewIndex}, but the file has ${views.length}`);
    const view = new Fields(views[viewIndex], `${accessor.place}: bufferViews[${viewIndex}]`);
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
      this.there.set(`view ${viewIndex}`, length);
      return { buffer, offset, stride };
    }
    const bufferIndex = view.integer("buffer", 0, kMostIndex);
    const buffers = listOf(this.source.json, "buffers").length;
    if (bufferIndex >= buffers)
      view.fail("buffer", `is ${bufferIndex}, but the file has ${buffers}`);
    const buffer = await this.source.buffer(bufferIndex);
    this.there.set(`buffer ${bufferIndex}`, buffer.byteLength);
    const begin = view.has("byteOffset") ? view.integer("byteOffset", 0, kMostCount) : 0;
    if (begin + length > buffer.byteLength)
      view.fail("", "reaches beyond the end of its buffer: the file is cut off or damaged");
    return { buffer, offset: begin + offset, stride };
  }

  /** Elements of an accessor whose type is known, one after the other. */
  private async gather(
    accessor: Fields,
    component: ComponentType,
    type: ElementType,
    count: number,
  ): Promise<Elements> {
    const each = kComponents[type] * kBytes[component];
    const { buffer, offset, stride } = await this.bytes(accessor, count, each);

    const make = (bytes: ArrayBuffer, at: number, length: number) =>
      component === 5126
        ? new Float32Array(bytes, at, length)
        : component === 5123
          ? new Uint16Array(bytes, at, length)
          : component === 5121
            ? new Uint8Array(bytes, at, length)
            : component === 5125
              ? new Uint32Array(bytes, at, length)
              : new Int8Array(bytes, at, length);
    const length = count * kComponents[type];
    if (stride === each && offset % kBytes[component] === 0) return make(buffer, offset, length);
    const packed = new Uint8Array(count * each);
    const from = new Uint8Array(buffer);
    for (let i = 0; i < count; ++i)
      packed.set(from.subarray(offset + i * stride, offset + i * stride + each), i * each);
    return make(packed.buffer, 0, length);
  }

  /** Elements of the accessor that `fields.key` names, one after the other. */
  async read(
    fields: Fields,
    key: string,
    component: ComponentType,
    type: ElementType,
  ): Promise<Elements> {
    const accessor = this.accessor(fields, key);
    const index = fields.integer(key, 0, kMostIndex);
    if (this.named.has(index)) fields.fail(key, `accessor ${index} serves two members`);
    this.named.add(index);
    const found = [accessor.integer("componentType", 0, 65535), accessor.string("type")];
    if (found[0] !== component || found[1] !== type)
      accessor.fail("", `holds ${found[1]} of ${found[0]} where ${type} of ${component} is needed`);
    const count = accessor.integer("count", 0, kMostCount);
    const elements = await this.gather(accessor, component, type, count);
    // Accessors that overlap could otherwise ask for any amount of memory.
    this.asked += elements.byteLength;
    const there = [...this.there.values()].reduce((sum, bytes) => sum + bytes, 0);
    if (this.asked > there)
      accessor.fail("", "accessors overlap: together they are larger than the file's buffers");
    return elements;
  }

  /**
   * An attribute of a primitive, which others may share: how many elements of how many numbers it
   * has, and these where they are plain floats (null: quantised, sparse or without bytes).
   */
  async attribute(
    attributes: Fields,
    name: "POSITION" | "NORMAL" | "TEXCOORD_0" | "TEXCOORD_1" | "COLOR_0",
  ): Promise<{ count: number; width: number; floats: Float32Array | null }> {
    const types = {
      POSITION: ["VEC3"],
      NORMAL: ["VEC3"],
      TEXCOORD_0: ["VEC2"],
      TEXCOORD_1: ["VEC2"],
    } as const;
    const accessor = this.accessor(attributes, name);
    const type = accessor.oneOf(
      "type",
      name === "COLOR_0" ? (["VEC3", "VEC4"] as const) : types[name],
    );
    const count = accessor.integer("count", 1, kMostCount);
    const component = accessor.integer("componentType", 0, 65535);
    if (component !== 5122 && !(component in kBytes))
      accessor.fail("componentType", `is ${component}, which glTF does not know`);
    const width = kComponents[type];
    if (component !== 5126 || accessor.has("sparse") || !accessor.has("bufferView"))
      return { count, width, floats: null };
    const floats = (await this.gather(accessor, 5126, type, count)) as Float32Array;
    return { count, width, floats };
  }

  /** Checks the indices of a primitive, which others may share. */
  async checkIndices(primitive: Fields, vertices: number): Promise<void> {
    const accessor: Fields = this.accessor(primitive, "indices");
    accessor.oneOf("type", ["SCALAR"]);
    const component = accessor.raw("componentType");
    if (component !== 5121 && component !== 5123 && component !== 5125)
      accessor.fail("componentType", `is ${JSON.stringify(component)}, not of unsigned numbers`);
    const count = accessor.integer("count", 0, kMostCount);
    const indices = await this.gather(accessor, component, "SCALAR", count);
    for (const index of indices)
      if (index >= vertices)
        primitive.fail("indices", `${index} is no vertex: there are ${vertices}`);
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
    if (encoding !== "snorm8" && fields.has("scales"))
      fields.fail("scales", "are for snorm8 alone");
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
