// The sky's controls: model, place, day, hour, haze.
import { LambentSky, type SkyModel } from "three-lambent";
import { h, select, slider, toggle } from "./dom";
import { kRadians } from "./directions";
import {
  clock,
  isMoment,
  kClearTurbidity,
  requestOf,
  skyAlone,
  type SkyMoment,
  type SkySettings,
} from "./sky_source";
import type { AirShown, ViewState } from "./view_state";

export interface SkyActions {
  /** Shows a sky in place of the environment; null: the environment that was there before. */
  showSky(settings: SkySettings | null): void;
  followSky(on: boolean): void;
  /** Shows the asset through the sky's air, or not; with what has changed of how. */
  showAir(on: boolean, part?: Partial<AirShown>): void;
}

/** What the controls show besides the view. */
export interface SkyFacts {
  /** Why there is no new picture; null if there is one. */
  problem: string | null;
  /** Whether the exposure follows. */
  follows: boolean;
  /** null: it is not shown. */
  air: AirShown | null;
  /** Why there are no shafts of light; null if there can be. */
  noShafts: string | null;
}

/** Degrees, and hours of standard time ahead of UTC. */
const kPlaces: readonly [string, number, number, number][] = [
  ["Geneva", 46.2, 6.14, 1],
  ["Reykjavík", 64.15, -21.94, 0],
  ["Tromsø", 69.65, 18.96, 1],
  ["London", 51.51, -0.13, 0],
  ["New York", 40.71, -74.01, -5],
  ["San Francisco", 37.77, -122.42, -8],
  ["Quito", -0.18, -78.47, -5],
  ["São Paulo", -23.55, -46.63, -3],
  ["Cape Town", -33.92, 18.42, 2],
  ["Nairobi", -1.29, 36.82, 3],
  ["Delhi", 28.61, 77.21, 5.5],
  ["Tokyo", 35.68, 139.69, 9],
  ["Sydney", -33.87, 151.21, 10],
];

const kSunset = -0.27; // degrees: the last of the disc
const kNight = -18;

const kModels: readonly [SkyModel, string][] = [
  ["fast", "Simulated, clear"],
  ["preetham", "Preetham"],
  ["perez", "Perez"],
  ["asrc-cie", "ASRC-CIE"],
  ["cie-clear", "CIE clear"],
  ["cie-overcast", "CIE overcast"],
];

function defaultSky(): SkySettings {
  const [, latitude, longitude, utcOffset] = kPlaces[0]!;
  return {
    sun: { date: "2026-06-21", minutes: 600, utcOffset, latitude, longitude },
    model: "fast",
    turbidity: kClearTurbidity,
  };
}

/** The Sun's elevation in degrees every ten minutes of a day, both midnights among them. */
function elevationsOf(day: SkyMoment): number[] {
  return Array.from({ length: 24 * 6 + 1 }, (_, i) => {
    const sun = { ...day, minutes: 10 * i };
    const request = requestOf({ sun, model: "fast", turbidity: kClearTurbidity });
    return LambentSky.sun(request).elevation / kRadians;
  });
}

/** Minutes of the clock at which the Sun passes an elevation, upwards and downwards. */
function crossings(elevations: readonly number[], at: number): { up: number[]; down: number[] } {
  const [up, down]: [number[], number[]] = [[], []];
  for (let i = 0; i + 1 < elevations.length; ++i) {
    const [before, after] = [elevations[i]! - at, elevations[i + 1]! - at];
    if (before < 0 !== after < 0)
      (after < 0 ? down : up).push(10 * (i + before / (before - after)));
  }
  return { up, down };
}

/** Of a day's strip: night, twilight and day. */
function stripColor(elevation: number): string {
  if (elevation >= kSunset) return "#f2c879";
  return elevation >= kNight ? "#5a76a8" : "#23272e";
}

export class SkyControls {
  readonly element: HTMLElement;
  private settings = defaultSky();
  private day = "";
  private dayWords = "";
  private readonly set: (() => void)[] = [];
  private readonly rest: HTMLElement[];
  private setAir: (facts: SkyFacts) => void = () => {};
  private readonly on;
  private readonly follow;
  private readonly strip = h("div", { class: "day", "aria-hidden": "true" });
  private readonly words = h("p", { class: "figures", id: "sky-facts", "aria-live": "polite" });

  constructor(private readonly actions: SkyActions) {
    this.on = toggle("Light from a sky", "Of a place, a day and an hour, in place of the environment",
      (on) => actions.showSky(on ? this.settings : null));
    this.follow = toggle("Exposure follows the sky", "From noon to the last of dusk",
      (on) => actions.followSky(on));
    const models = select("Model", (index) => {
      const model = kModels[index]?.[0];
      // What was measured is of the model that it was measured for.
      if (model !== undefined)
        this.change({ model, directNormal: undefined, diffuseHorizontal: undefined });
    });
    const places = select("Place", (index) => {
      const place = kPlaces[index];
      if (place === undefined) return;
      const [, latitude, longitude, utcOffset] = place;
      this.move({ latitude, longitude, utcOffset });
    });
    const date = h("input", { type: "date", id: "sky-date", min: "1600-01-01", max: "2400-12-31" });
    date.addEventListener("input", () => {
      if (date.value !== "" && date.validity.valid) this.move({ date: date.value });
    });
    const number = (
      label: string,
      [min, max, step]: [number, number, number],
      format: (value: number) => string,
      key: "latitude" | "longitude" | "utcOffset" | "minutes",
    ) => {
      const control = slider({
        label, min, max, step, format,
        change: (value) => this.move({ [key]: value }),
      });
      this.set.push(() => control.set(this.moment()[key]));
      return control.element;
    };
    const side = (positive: string, negative: string) => (value: number) =>
      `${Math.abs(value).toFixed(2)}° ${value < 0 ? negative : positive}`;
    const air = this.airControls();
    const turbidity = slider({
      label: "Haze",
      title: "Turbidity: 1 is air without haze",
      min: 1, max: 10, step: 0.1,
      format: (value) => value.toFixed(1),
      change: (value) => this.change({ turbidity: value }),
    });
    this.set.push(() => {
      const { model } = this.settings;
      const known = kModels.findIndex(([name]) => name === model);
      const more = known < 0 ? [model.toUpperCase().replace(":", " ")] : [];
      models.fill([...kModels.map(([, name]) => name), ...more],
        known < 0 ? kModels.length : known);
      const moment = this.moment();
      const place = kPlaces.findIndex(
        ([, latitude, longitude]) =>
          latitude === moment.latitude && longitude === moment.longitude);
      places.fill([...kPlaces.map(([name]) => name), "Elsewhere"],
        place < 0 ? kPlaces.length : place);
      if (document.activeElement !== date) date.value = moment.date;
      turbidity.set(this.settings.turbidity);
    });
    this.rest = [
      number("Time", [0, 1439, 1], clock, "minutes"),
      this.strip,
      this.words,
      h("div", { class: "select" }, h("label", { for: "sky-date" }, "Date"), date),
      places.element,
      number("Latitude", [-90, 90, 0.01], side("N", "S"), "latitude"),
      number("Longitude", [-180, 180, 0.01], side("E", "W"), "longitude"),
      number("Clock ahead of UTC", [-12, 14, 0.25], (value) => `${value} h`, "utcOffset"),
      models.element,
      turbidity.element,
      this.follow.element,
      ...air,
    ];
    this.element = h("div", { class: "sky-controls" }, this.on.element, ...this.rest);
  }

  private airControls(): HTMLElement[] {
    const { actions } = this;
    const on = toggle("Seen through the air",
      "Aerial perspective: what is far away pales (lambent render --air)",
      (on) => actions.showAir(on));
    const metres = slider({
      label: "Metres in one unit",
      title: "How large the scene is",
      min: 0, max: 5, step: 0.1,
      format: (value) => Number((10 ** value).toPrecision(2)).toLocaleString("en"),
      change: (value) => actions.showAir(true, { metresPerUnit: Number((10 ** value).toPrecision(2)) }),
    });
    const shafts = toggle("Shafts of light",
      "What throws a sharp shadow of the Sun throws it into the air as well",
      (on) => actions.showAir(true, { shafts: on }));
    this.setAir = ({ air, noShafts }) => {
      on.set(air !== null);
      metres.element.hidden = shafts.element.hidden = air === null;
      if (air === null) return;
      metres.set(Math.log10(air.metresPerUnit));
      shafts.set(air.shafts);
      shafts.forbid(noShafts);
    };
    return [on.element, metres.element, shafts.element];
  }

  show(view: ViewState, facts: SkyFacts): void {
    const shown = skyAlone(view.environment.source);
    if (shown !== null && facts.problem === null) this.settings = shown;
    this.on.set(shown !== null);
    this.follow.set(facts.follows);
    for (const each of this.rest) each.hidden = shown === null;
    this.strip.hidden = shown === null || !isMoment(this.settings.sun);
    if (shown === null) return;
    for (const set of this.set) set();
    this.setAir(facts);
    this.words.textContent = facts.problem ?? this.sayWhere();
  }

  /** A Sun that was placed by hand gives way to that of a moment once one of its controls is moved. */
  private moment(): SkyMoment {
    return isMoment(this.settings.sun) ? this.settings.sun : (defaultSky().sun as SkyMoment);
  }
  private move(part: Partial<SkyMoment>): void {
    this.change({ sun: { ...this.moment(), ...part } });
  }
  private change(part: Partial<SkySettings>): void {
    this.settings = { ...this.settings, ...part };
    for (const set of this.set) set();
    this.actions.showSky(this.settings);
  }

  private sayWhere(): string {
    const { elevation, azimuth } = LambentSky.sun(requestOf(this.settings));
    const sun = `The Sun stands at ${(elevation / kRadians).toFixed(1)}°, ` +
      `bearing ${(azimuth / kRadians).toFixed(0)}°.`;
    if (!isMoment(this.settings.sun)) return sun;
    this.readDay(this.settings.sun);
    return sun + this.dayWords;
  }
  /** When it rises and sets, in words and on the strip. */
  private readDay(moment: SkyMoment): void {
    const day = JSON.stringify({ ...moment, minutes: 0 });
    if (day === this.day) return;
    this.day = day;
    const elevations = elevationsOf(moment);
    const { up, down } = crossings(elevations, kSunset);
    const times = (all: number[]) => all.map((each) => clock(Math.round(each))).join(", ") || "none";
    this.dayWords =
      up.length + down.length === 0
        ? " It neither rises nor sets."
        : ` Sunrise ${times(up)}, sunset ${times(down)}.`;
    const steps = elevations.slice(0, -1).map((elevation, i) => {
      const color = stripColor((elevation + elevations[i + 1]!) / 2);
      return `${color} ${(100 * i) / 144}% ${(100 * (i + 1)) / 144}%`;
    });
    this.strip.style.background = `linear-gradient(to right, ${steps.join(", ")})`;
  }
}
