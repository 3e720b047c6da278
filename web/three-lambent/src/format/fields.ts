// Members of a JSON object that came from anywhere: each is asked for with its type and range, and
// what is missing or wrong is an error that names its place.

import { LambentFormatError } from "./description.js";

/** The largest finite 32-bit float: what numbers become. */
export const kFloatMax = (2 - 2 ** -23) * 2 ** 127;

export type Json = Record<string, unknown>;

function isObject(value: unknown): value is Json {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

export class Fields {
  private readonly value: Json;

  /** @param place the object's path for messages, as "meshes[3].extensions.…" */
  constructor(
    value: unknown,
    readonly place: string,
  ) {
    if (!isObject(value)) throw new LambentFormatError(`${place}: is not an object`);
    this.value = value;
  }

  has(key: string): boolean {
    return this.value[key] !== undefined;
  }

  fail(key: string, what: string): never {
    throw new LambentFormatError(`${this.place}${key ? `.${key}` : ""}: ${what}`);
  }

  raw(key: string): unknown {
    const value = Object.hasOwn(this.value, key) ? this.value[key] : undefined;
    if (value === undefined) this.fail(key, "is missing");
    return value;
  }

  integer(key: string, least: number, most: number): number {
    const value = this.raw(key);
    if (!Number.isInteger(value) || (value as number) < least || (value as number) > most)
      this.fail(key, `is ${JSON.stringify(value)}, not an integer from ${least} to ${most}`);
    return value as number;
  }

  channels(key: string): 1 | 3 {
    const value = this.raw(key);
    if (value !== 1 && value !== 3) this.fail(key, `is ${JSON.stringify(value)}, not 1 or 3`);
    return value;
  }

  /** A number that stays finite as a 32-bit float. */
  number(key: string, least: number, most = kFloatMax): number {
    const value = this.raw(key);
    if (typeof value !== "number" || !(value >= least && value <= most))
      this.fail(key, `is ${JSON.stringify(value)}, not a number that is finite and ≥ ${least}`);
    return value;
  }

  numbers(key: string, count: number): number[] {
    const value = this.raw(key);
    if (
      !Array.isArray(value) ||
      value.length !== count ||
      !value.every((v) => typeof v === "number" && Number.isFinite(v))
    )
      this.fail(key, `is not an array of ${count} finite numbers`);
    return value;
  }

  boolean(key: string): boolean {
    const value = this.raw(key);
    if (typeof value !== "boolean")
      this.fail(key, `is ${JSON.stringify(value)}, not true or false`);
    return value;
  }

  string(key: string): string {
    const value = this.raw(key);
    if (typeof value !== "string") this.fail(key, "is not a string");
    return value;
  }

  oneOf<T extends string>(key: string, names: readonly T[]): T {
    const value = this.raw(key);
    if (!names.includes(value as T))
      this.fail(key, `is ${JSON.stringify(value)}, not ${names.join(" or ")}`);
    return value as T;
  }

  object(key: string): Fields {
    return new Fields(this.raw(key), `${this.place}.${key}`);
  }
}
