// What a file with LAMBENT_radiance_transfer holds, checked, before anything of it is uploaded.

/** The extension's name in glTF. */
export const kExtensionName = "LAMBENT_radiance_transfer";
/** The major version of the format that this package reads. Any minor version of it will do. */
export const kFormatMajor = 1;

/** Whether a document says that it carries transfer. */
export function hasTransfer(json: unknown): boolean {
  const extensions = (json as { extensions?: unknown } | null)?.extensions;
  return typeof extensions === "object" && extensions !== null && kExtensionName in extensions;
}

/** Numbers as the file stores them. */
export interface Numbers {
  encoding: "float16" | "float32" | "snorm8";
  /** Bit patterns (float16), floats, or −127 … 127. A view of the file's own buffer. */
  data: Uint16Array | Float32Array | Int8Array;
  /** snorm8: what 127 stands for in each run of `run` numbers. */
  scales: Float32Array | null;
  run: number;
}

/** Diffuse transfer: receivers × channels × bands². Includes ρ/π. */
export interface Vectors {
  numbers: Numbers;
  bands: number;
  channels: 1 | 3;
  /** Whether exit radiance is still to be multiplied by the base colour that varies. */
  albedoOutside: boolean;
}

/** Glossy transfer: receivers × channels × outBands² × inBands². */
export interface Matrices {
  numbers: Numbers;
  outBands: number;
  inBands: number;
  channels: 1 | 3;
  /** k, the lobe's reflectance, linear RGB. */
  glossy: [number, number, number];
  lobeExponent: number;
}

/** Receivers on texels: width × height, row 0 at v = 0. */
export interface Grid {
  width: number;
  height: number;
  /** The UV set that it lies on: TEXCOORD_0 or TEXCOORD_1. */
  texCoord: 0 | 1;
  normals: Float32Array;
}

/** Matrices into the tangent frame: receivers × channels × bands² × bands². */
export interface MacroMatrices {
  numbers: Numbers;
  channels: 1 | 3;
}

export interface BiScale {
  rtt: number;
  bands: number;
  /** Metres of the surface that one metre of the patch covers. */
  scale: number;
  /** A unit tangent for every vertex. */
  tangents: Float32Array;
  idMap: { width: number; height: number; ids: Uint16Array } | null;
  tiles: [number, number];
  /** Whether each of its triangles lies on one of another primitive, before which it is seen. */
  layer: boolean;
  shadowed: MacroMatrices | null;
  interreflected: MacroMatrices | null;
}

/** The transfer of one primitive. */
export interface PrimitiveTransfer {
  layout: "vertices" | "texels";
  receivers: number;
  vectors: Vectors | null;
  matrices: Matrices | null;
  /** Kept beside them: the direct light alone, where vectors and matrices hold more. */
  shadowed: { vectors: Vectors | null; matrices: Matrices | null } | null;
  grid: Grid | null;
  biScale: BiScale | null;
}

/** A radiance transfer texture: bands² × height × width × views × views × 3. */
export interface RadianceTransferTexture {
  name: string;
  width: number;
  height: number;
  views: number;
  bands: number;
  /** The patch's period along x and y, metres. */
  size: [number, number];
  /** Metres between its lowest and its highest point. */
  depth: number;
  numbers: Numbers;
  /** height × width × views × views: how high what is seen stands, 0 lowest, 255 highest. */
  heights: Uint8Array | null;
}

export type TransferKind = "unshadowed" | "shadowed" | "interreflected";

export interface AssetDescription {
  version: string;
  generator: string;
  transfer: TransferKind;
  bands: number;
  directions: number;
  bounces: number;
  rtts: RadianceTransferTexture[];
  /** Of "MESH/PRIMITIVE", the indices in the document. */
  primitives: Map<string, PrimitiveTransfer>;
}

/** What is wrong with a file, in words: the place in it, what was found, and a remedy. */
export class LambentFormatError extends Error {
  override readonly name = "LambentFormatError";
}
