// `sky:KEY=VALUE,…` as text and as values: the keys of lambent/sky/sky_request.h that this page knows.
import type { SkyModel, SkyRequest } from "three-lambent";
import { kRadians } from "./directions";

/** Where and when. Degrees. */
export interface SkyMoment {
  /** "2026-06-21", of the civil clock. */
  date: string;
  /** What it shows, minutes since midnight, 0 … under 1440. */
  minutes: number;
  /** Hours that it is ahead of UTC. */
  utcOffset: number;
  latitude: number;
  longitude: number;
}

/** Degrees; the azimuth is a compass bearing. */
export interface SunPlace {
  elevation: number;
  azimuth: number;
}

export interface SkySettings {
  sun: SkyMoment | SunPlace;
  model: SkyModel;
  turbidity: number;
  /** W m⁻², as measured: of perez and asrc-cie alone. */
  directNormal?: number;
  diffuseHorizontal?: number;
}

export const isMoment = (sun: SkyMoment | SunPlace): sun is SkyMoment => "date" in sun;

/** What the tool takes unless it is told. */
export const kClearTurbidity = 2.5;

const kOthers = ["albedo", "altitude", "atmosphere", "ozone", "refine"];
const kModels = "fast, preetham, perez, asrc-cie, cie-clear, cie-overcast, and cie:1 to cie:15";
const kElsewhere = "the native viewer (lambent view) and lambent render do";

function numberOf(text: string, least: number, most: number, unit: string): number {
  const value = Number(text);
  if (text.trim() === "" || !Number.isFinite(value))
    throw new Error(`'${text}' is not a number; it takes ${least} to ${most}${unit}`);
  if (value < least || value > most)
    throw new Error(`${text} is not within ${least} to ${most}${unit}`);
  return value;
}

function dateOf(text: string): string {
  const found = /^(\d{4})-(\d{2})-(\d{2})$/.exec(text);
  const [year, month, day] = (found ?? []).slice(1).map(Number);
  const date = found === null ? null : new Date(Date.UTC(year!, month! - 1, day!));
  if (date === null || date.toISOString().slice(0, 10) !== text || year! < 1600 || year! > 2400)
    throw new Error(`'${text}' is no day of 1600 to 2400 as YYYY-MM-DD`);
  return text;
}

function minutesOf(text: string): number {
  const found = /^(\d{2}):(\d{2})(?::(\d{2}))?$/.exec(text);
  const [hours, minutes, seconds] = (found ?? []).slice(1).map((each) => Number(each ?? 0));
  if (found === null || hours! > 23 || minutes! > 59 || seconds! > 59)
    throw new Error(`'${text}' is no time of a day as HH:MM or HH:MM:SS`);
  return 60 * hours! + minutes! + seconds! / 60;
}

function offsetOf(text: string): number {
  const found = /^([+-]?)(\d{1,2}):([0-5]\d)$/.exec(text);
  const hours =
    found === null
      ? text
      : String((found[1] === "-" ? -1 : 1) * (Number(found[2]) + Number(found[3]) / 60));
  return numberOf(hours, -14, 14, " hours east of UTC");
}

function modelOf(text: string): SkyModel {
  if (/^(fast|preetham|perez|asrc-cie|cie-clear|cie-overcast|cie:([1-9]|1[0-5]))$/.test(text))
    return text as SkyModel;
  if (text === "exact")
    throw new Error(
      `this page has not the model exact, which marches through the air: ${kElsewhere}; nearest to it ` +
        "here is fast",
    );
  throw new Error(`'${text}' is no model; this page has ${kModels}`);
}

/**
 * What stands after `sky:`. Throws an Error that says what cannot be understood, and which keys of the
 * tool this page does not know.
 */
export function parseSky(text: string): SkySettings {
  const given = new Map<string, string>();
  for (const part of text.split(",")) {
    const equals = part.indexOf("=");
    const key = part.slice(0, equals);
    if (equals < 1) throw new Error(`'${part}' is not KEY=VALUE`);
    if (given.has(key)) throw new Error(`'${key}' is given twice`);
    given.set(key, part.slice(equals + 1));
  }
  const at = <T>(key: string, read: (value: string) => T): T | undefined => {
    const value = given.get(key);
    given.delete(key);
    if (value === undefined) return undefined;
    try {
      return read(value);
    } catch (error) {
      throw new Error(`${key}: ${(error as Error).message}`);
    }
  };
  const date = at("date", dateOf);
  const minutes = at("time", minutesOf);
  const utcOffset = at("utc-offset", offsetOf);
  const latitude = at("lat", (v) => numberOf(v, -90, 90, " degrees, north positive"));
  const longitude = at("lon", (v) => numberOf(v, -180, 180, " degrees, east positive"));
  const elevation = at("sun-elevation", (v) => numberOf(v, -90, 90, " degrees"));
  const azimuth = at("sun-azimuth", (v) => numberOf(v, -360, 360, " degrees"));
  const model = at("model", modelOf) ?? "fast";
  const turbidity = at("turbidity", (v) => numberOf(v, 1, 10, "")) ?? kClearTurbidity;
  const irradiance = (v: string) => numberOf(v, 0, 2000, " W/m²");
  const measured = {
    directNormal: at("direct-normal", irradiance),
    diffuseHorizontal: at("diffuse-horizontal", irradiance),
  };
  if (Object.values(measured).some((each) => each !== undefined) && !/^(perez|asrc-cie)$/.test(model))
    throw new Error(`direct-normal and diffuse-horizontal are of the models perez and asrc-cie`);
  for (const key of given.keys())
    throw new Error(
      kOthers.includes(key)
        ? `this page knows no ${key}: ${kElsewhere}`
        : `there is no key '${key}'; this page knows date, time, utc-offset, lat, lon, ` +
          "sun-elevation, sun-azimuth, model, turbidity, direct-normal and diffuse-horizontal",
    );
  const moment = [date, minutes, latitude, longitude];
  if (moment.every((each) => each === undefined)) {
    if (elevation === undefined)
      throw new Error(
        "where the Sun stands is missing: give sun-elevation, or date, time, lat and lon",
      );
    return { sun: { elevation, azimuth: azimuth ?? 180 }, model, turbidity, ...measured };
  }
  if (elevation !== undefined || azimuth !== undefined)
    throw new Error(
      "date, time, lat and lon say where the Sun stands, and so do sun-elevation and " +
        "sun-azimuth: give one of them",
    );
  const missing = ["date", "time", "lat", "lon"].filter((_, i) => moment[i] === undefined);
  if (missing.length > 0)
    throw new Error(
      `the Sun of a moment takes date, time, lat and lon: ${missing.join(" and ")} ` +
        `${missing.length > 1 ? "are" : "is"} missing`,
    );
  return {
    sun: {
      date: date!,
      minutes: minutes!,
      utcOffset: utcOffset ?? 0,
      latitude: latitude!,
      longitude: longitude!,
    },
    model,
    turbidity,
    ...measured,
  };
}

/** "05:40", or "05:40:30". */
export function clock(minutes: number): string {
  const seconds = Math.round(60 * minutes) % 86400;
  const two = (value: number) => String(Math.floor(value)).padStart(2, "0");
  const time = `${two(seconds / 3600)}:${two((seconds / 60) % 60)}`;
  return seconds % 60 === 0 ? time : `${time}:${two(seconds % 60)}`;
}

/** The SOURCE, as the tool takes it. */
export function skySource(settings: SkySettings): string {
  const { sun, model, turbidity, directNormal, diffuseHorizontal } = settings;
  const keys: Record<string, string | number | undefined> = {
    ...(isMoment(sun)
      ? {
          date: sun.date,
          time: clock(sun.minutes),
          "utc-offset": sun.utcOffset,
          lat: sun.latitude,
          lon: sun.longitude,
        }
      : { "sun-elevation": sun.elevation, "sun-azimuth": sun.azimuth }),
    model: model === "fast" ? undefined : model,
    turbidity: turbidity === kClearTurbidity ? undefined : turbidity,
    "direct-normal": directNormal,
    "diffuse-horizontal": diffuseHorizontal,
  };
  const given = Object.entries(keys).filter(([, value]) => value !== undefined);
  return `sky:${given.map(([key, value]) => `${key}=${value}`).join(",")}`;
}

export function requestOf({ sun, ...rest }: SkySettings): SkyRequest {
  if (!isMoment(sun))
    return { ...rest, sunElevation: sun.elevation * kRadians, sunAzimuth: sun.azimuth * kRadians };
  return {
    ...rest,
    date: Date.parse(`${sun.date}T00:00:00Z`) + 60000 * (sun.minutes - 60 * sun.utcOffset),
    latitude: sun.latitude * kRadians,
    longitude: sun.longitude * kRadians,
  };
}

/** The settings of a source that is one sky and nothing else; null for others. */
export function skyAlone(source: string): SkySettings | null {
  if (!source.startsWith("sky:")) return null;
  try {
    return parseSky(source.slice(4));
  } catch {
    return null;
  }
}
