// An environment that the page can show: the sum of a source's terms, as harmonics to relight by
// and as something to look at in mirrors and behind the object.
import {
  DataTexture,
  EquirectangularReflectionMapping,
  FloatType,
  HalfFloatType,
  DataUtils,
  LinearFilter,
  LinearSRGBColorSpace,
  RGBAFormat,
  RepeatWrapping,
  ClampToEdgeWrapping,
  Vector3,
} from "three";
import { LambentLight, type Disc, type Sky } from "three-lambent";
import { directionFromAzimuthElevation, kRadians } from "./directions";
import { asEquirectangular, decodeMap, reduced, type LightMap } from "./environment_map";
import { skies } from "./skies";
import { requestOf } from "./sky_source";
import { parseSource } from "./source";
import type { Triple } from "./view_state";
import { messageOf } from "./messages";

/** Angular diameter that stands for a light without extent, degrees: nothing of 10 bands sees it. */
const kPointLike = 0.02;

/** Reads the bytes behind a name; where they come from is the caller's matter. */
export type ReadFile = () => Promise<ArrayBuffer>;

/** What the names in a SOURCE stand for. */
export interface Files {
  /** Those that are known beforehand, in which a '+' divides nothing. */
  names(): Iterable<string>;
  /** undefined: there is no such file. */
  read(name: string): ReadFile | undefined;
}

export interface LoadedEnvironment {
  source: string;
  /** As it stands before it is turned. */
  map: LightMap | null;
  texture: DataTexture | null;
  discs: Disc[];
  uniform: Triple;
  sky: Sky | null;
  /** The light in n bands, before it is turned; held for the next call. */
  light(bands: number): LambentLight;
  dispose(): void;
}

/** A file of light that nobody has given. */
export class MissingLight extends Error {
  /** `why`: what the server said of it; nothing where it was not asked. */
  constructor(
    readonly file: string,
    why = "",
  ) {
    super(
      `${file}: the page has no such light${why && ` (${why})`}. Drop the file onto it, or name ` +
        `it to lambent view --web ASSET ${file}`,
    );
  }
}

/**
 * Loads a SOURCE. `files` says how to read each name in it. `floatTextures`: whether the GPU
 * filters 32-bit textures; where it does not, what is looked at has 16 bits.
 */
export async function loadEnvironment(
  source: string,
  files: Files,
  floatTextures: boolean,
): Promise<LoadedEnvironment> {
  const maps: LightMap[] = [];
  const harmonics: LambentLight[] = [];
  const seen: Disc[] = [];
  const hidden: Disc[] = [];
  const uniform: Triple = [0, 0, 0];
  let sky: Sky | null = null;
  for (const term of parseSource(source, files.names())) {
    if (term.kind === "uniform") {
      term.radiance.forEach((each, c) => (uniform[c]! += each));
    } else if (term.kind === "disc") {
      seen.push({
        direction: directionFromAzimuthElevation(
          term.azimuth * kRadians,
          term.elevation * kRadians,
        ),
        diameter: term.diameter * kRadians,
        radiance: term.radiance,
      });
    } else if (term.kind === "directional") {
      const half = (kPointLike * kRadians) / 2;
      const solidAngle = Math.PI * Math.sin(half) ** 2; // projected: what irradiance is made of
      hidden.push({
        direction: directionFromAzimuthElevation(
          term.azimuth * kRadians,
          term.elevation * kRadians,
        ),
        diameter: 2 * half,
        radiance: term.irradiance.map((each) => each / solidAngle) as Triple,
      });
    } else if (term.kind === "sky") {
      if (sky !== null) throw new Error(`light '${source}': this page shows one sky at a time`);
      sky = (await skies()).at(requestOf(term.settings));
      seen.push(...sky.discs);
    } else {
      const read = files.read(term.name);
      if (read === undefined) throw new MissingLight(term.name);
      const bytes = await read();
      if (/\.json$/i.test(pathOf(term.name))) harmonics.push(lightFromJson(bytes, term.name));
      else maps.push(await decodeMap(bytes, pathOf(term.name)));
    }
  }

  const map = sumOfMaps(maps, harmonics);
  const texture = map === null ? null : textureOf(map, floatTextures);
  const held = new Map<number, LambentLight>();
  return {
    source,
    map,
    texture,
    discs: seen,
    uniform,
    sky,
    light(bands) {
      let light = held.get(bands);
      if (light === undefined) {
        light = LambentLight.uniform(uniform, bands);
        for (const each of maps)
          light.add(LambentLight.fromEquirectangular(asEquirectangular(each), bands));
        for (const each of harmonics) light.add(each);
        if (sky !== null) light.add(sky.light(bands, { without: "discs" }));
        for (const disc of [...seen, ...hidden]) light.addDisc(disc);
        held.set(bands, light);
      }
      return light;
    },
    dispose() {
      texture?.dispose();
      sky?.dispose();
    },
  };
}

/** A name that is an address can end in a query. */
const pathOf = (name: string): string => name.replace(/[?#].*$/, "");

function lightFromJson(bytes: ArrayBuffer, name: string): LambentLight {
  try {
    return LambentLight.fromJson(JSON.parse(new TextDecoder().decode(bytes)));
  } catch (error) {
    const reason = messageOf(error);
    throw new Error(`${name}: not a light as 'lambent light' writes it (${reason})`);
  }
}

/** Radiance given by harmonics becomes pixels, so that it can be looked at as maps are. */
function sumOfMaps(maps: readonly LightMap[], harmonics: readonly LambentLight[]): LightMap | null {
  if (harmonics.length === 0 && maps.length <= 1) return maps[0] ?? null;
  const width = Math.max(256, ...maps.map((each) => each.width));
  const height = width / 2;
  const data = new Float32Array(4 * width * height);
  const direction = new Vector3();
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const at = 4 * (y * width + x);
      const [u, v] = [(x + 0.5) / width, (y + 0.5) / height];
      direction.copy(directionFromAzimuthElevation(2 * Math.PI * (u - 0.5), Math.PI * (0.5 - v)));
      for (const light of harmonics)
        light.radiance(direction).forEach((each, c) => (data[at + c]! += each));
      for (const map of maps) {
        const [i, j] = [Math.floor(u * map.width), Math.floor(v * map.height)];
        for (let c = 0; c < 3; ++c) data[at + c]! += map.data[4 * (j * map.width + i) + c]!;
      }
      data[at + 3] = 1;
    }
  return { width, height, data };
}

function textureOf(map: LightMap, floatTextures: boolean): DataTexture {
  const { width, height, data } = reduced(map, 4096);
  const numbers = floatTextures
    ? (data as Float32Array<ArrayBuffer>)
    : Uint16Array.from(data, (each) => DataUtils.toHalfFloat(Math.min(each, 65504)));
  const texture = new DataTexture(
    numbers,
    width,
    height,
    RGBAFormat,
    floatTextures ? FloatType : HalfFloatType,
    EquirectangularReflectionMapping,
    RepeatWrapping,
    ClampToEdgeWrapping,
    LinearFilter,
    LinearFilter,
  );
  texture.colorSpace = LinearSRGBColorSpace;
  texture.flipY = true;
  texture.needsUpdate = true;
  return texture;
}
