// SOURCE of light as text, as the tool takes it (lambent/sources/source.h): files, uniform, discs,
// directional lights, skies, and sums of them.
import { parseSky, type SkySettings } from "./sky_source";
import type { Triple } from "./view_state";

export type Term =
  | { kind: "file"; name: string }
  | { kind: "uniform"; radiance: Triple }
  | { kind: "disc"; azimuth: number; elevation: number; diameter: number; radiance: Triple }
  | { kind: "directional"; azimuth: number; elevation: number; irradiance: Triple }
  | { kind: "sky"; settings: SkySettings };

function numberOf(text: string, source: string): number {
  const value = Number(text);
  if (text.trim() === "" || !Number.isFinite(value))
    throw new Error(`light '${source}': '${text}' is not a number`);
  return value;
}

function colorOf(text: string, source: string): Triple {
  const parts = text.split("/").map((each) => numberOf(each, source));
  if (parts.some((each) => each < 0) || (parts.length !== 1 && parts.length !== 3))
    throw new Error(`light '${source}': '${text}' is not a number from 0 up, nor R/G/B`);
  return parts.length === 1 ? [parts[0]!, parts[0]!, parts[0]!] : (parts as Triple);
}

function termOf(text: string): Term {
  if (text === "") throw new Error("a light is empty, or nothing stands on one side of a '+'");
  const colon = text.indexOf(":");
  const kind = colon < 0 ? text : text.slice(0, colon);
  const rest = colon < 0 ? "" : text.slice(colon + 1);
  if (kind === "uniform")
    return { kind, radiance: rest === "" ? [1, 1, 1] : colorOf(rest, text) };
  if (kind === "disc" || kind === "directional") {
    const parts = rest.split(",");
    const needed = kind === "disc" ? 3 : 2;
    if (parts.length !== needed && parts.length !== needed + 1)
      throw new Error(
        `light '${text}': it takes AZIMUTH,ELEVATION` +
          (kind === "disc" ? ",DIAMETER[,RADIANCE]" : "[,IRRADIANCE]"),
      );
    const [azimuth, elevation, diameter] = parts
      .slice(0, needed)
      .map((each) => numberOf(each, text));
    const color: Triple = parts.length > needed ? colorOf(parts[needed]!, text) : [1, 1, 1];
    if (kind === "directional")
      return { kind, azimuth: azimuth!, elevation: elevation!, irradiance: color };
    if (!(diameter! > 0 && diameter! <= 360))
      throw new Error(`light '${text}': a diameter is above 0 and up to 360 degrees`);
    return { kind, azimuth: azimuth!, elevation: elevation!, diameter: diameter!, radiance: color };
  }
  if (kind === "sky") {
    try {
      return { kind, settings: parseSky(rest) };
    } catch (error) {
      throw new Error(`light '${text}': ${(error as Error).message}`);
    }
  }
  return { kind: "file", name: text };
}

/**
 * The terms of a sum. `files` are names that the page has a file for: a '+' inside of one does not
 * divide, nor does one in an exponent (1e+3), nor the sign of a sky's number. Throws an Error that says what cannot be understood.
 */
export function parseSource(text: string, files: Iterable<string>): Term[] {
  const names = new Set(files);
  return termsOf(text, names).map((term) =>
    names.has(term) ? { kind: "file", name: term } : termOf(term));
}
/** The same as texts, which need not make sense. */
export function termsOf(text: string, files: Iterable<string>): string[] {
  const names = [...files].sort((a, b) => b.length - a.length);
  const terms: string[] = [];
  for (let at = 0; at <= text.length; ) {
    const rest = text.slice(at);
    const file = names.find((name) => rest === name || rest.startsWith(name + "+"));
    const end = file !== undefined ? file.length : endOfTerm(rest);
    terms.push(rest.slice(0, end));
    at += end + 1;
  }
  return terms;
}

/** Whether a term is the name of a file: it begins with no other word. */
export const isFile = (term: string): boolean => !/^(uniform$|[a-z]+:)/.test(term);

function endOfTerm(text: string): number {
  const sky = text.startsWith("sky:");
  const analytic = sky || /^(uniform|disc:|directional:)/.test(text);
  for (let i = 0; i < text.length; ++i)
    if (
      text[i] === "+" &&
      !(analytic && /[0-9.][eE]$/.test(text.slice(0, i))) &&
      !(sky && /=$/.test(text.slice(0, i)))
    )
      return i;
  return text.length;
}
