// Discs of light: which there are, and where, how large, how bright and of what colour one is.
import { kMostDiscs, srgbDecode, srgbEncode } from "three-lambent";
import { button, h, slider } from "./dom";
import type { DiscState, Triple, ViewState } from "./view_state";

export interface DiscActions {
  change(what: (view: ViewState) => void): void;
  addDisc(): void;
  removeDisc(index: number): void;
  chooseDisc(index: number): void;
}

/** A colour whose largest channel is 1, and how bright it is. */
function split(radiance: Triple): { color: Triple; strength: number } {
  const strength = Math.max(...radiance);
  if (!(strength > 0)) return { color: [1, 1, 1], strength: 0 };
  return { color: radiance.map((each) => each / strength) as Triple, strength };
}
const toHex = (color: Triple): string =>
  "#" +
  color
    .map((each) => Math.round(255 * srgbEncode(each)).toString(16).padStart(2, "0"))
    .join("");
const fromHex = (text: string): Triple =>
  [1, 3, 5].map((at) => srgbDecode(parseInt(text.slice(at, at + 2), 16) / 255)) as Triple;

export class DiscControls {
  private readonly chips = h("div", { class: "row chips" });
  private readonly fields = h("div", { class: "disc" });
  readonly element = h("fieldset", { class: "discs" }, h("legend", {}, "Discs of light"),
    this.chips, this.fields);
  private chosen = -1;
  private readonly set: ((disc: DiscState) => void)[] = [];

  constructor(private readonly actions: DiscActions) {
    const number = (
      [label, title]: [string, string],
      key: "azimuth" | "elevation" | "diameter",
      [min, max]: [number, number],
    ) => {
      const control = slider({
        label,
        title,
        min,
        max,
        step: 0.5,
        format: (value) => `${value.toFixed(1)}°`,
        change: (value) => this.edit((disc) => (disc[key] = value)),
      });
      this.set.push((disc) => control.set(disc[key]));
      return control.element;
    };
    // Radiance in stops: a lamp is many times as bright as a sky.
    const strength = slider({
      label: "Brightness",
      title: "Radiance, W m⁻² sr⁻¹",
      min: -4,
      max: 12,
      step: 0.1,
      format: (value) => (2 ** value).toPrecision(3),
      change: (value) =>
        this.edit((disc) => {
          disc.radiance = split(disc.radiance).color.map((each) => each * 2 ** value) as Triple;
        }),
    });
    this.set.push((disc) =>
      strength.set(Math.log2(Math.max(split(disc.radiance).strength, 1 / 16))));
    const color = h("input", { type: "color", id: "disc-color" });
    color.addEventListener("input", () =>
      this.edit((disc) => {
        const { strength: before } = split(disc.radiance);
        const { color: wanted } = split(fromHex(color.value));
        disc.radiance = wanted.map((each) => each * before) as Triple;
      }));
    this.set.push((disc) => (color.value = toHex(split(disc.radiance).color)));
    this.fields.append(
      number(["Direction", "Azimuth, from +x towards +z"], "azimuth", [-180, 180]),
      number(["Height", "Elevation above the horizon"], "elevation", [-90, 90]),
      number(["Size", "Angular diameter"], "diameter", [0.5, 120]),
      strength.element,
      h("div", { class: "toggle" }, h("label", { for: "disc-color" }, "Colour"), color),
      h("div", { class: "row" },
        button("Remove this disc", "Take the disc away (Delete)", () =>
          this.actions.removeDisc(this.chosen))),
    );
  }

  show(view: ViewState, chosen: number): void {
    this.chosen = chosen;
    if (this.chips.querySelectorAll(".chip").length !== view.discs.length ||
        this.chips.childElementCount === 0) {
      const add = button("Add", "Add a disc of light (D)", () => this.actions.addDisc());
      add.disabled = view.discs.length >= kMostDiscs;
      if (add.disabled) add.title = `There can be ${kMostDiscs} discs`;
      this.chips.replaceChildren(
        ...view.discs.map((_, i) =>
          button(String(i + 1), `Disc ${i + 1}`, () => this.actions.chooseDisc(i), "chip")),
        add);
    }
    this.chips.querySelectorAll(".chip").forEach((chip, i) =>
      chip.setAttribute("aria-pressed", String(i === chosen)));
    const disc = view.discs[chosen];
    this.fields.hidden = disc === undefined;
    if (disc !== undefined) for (const set of this.set) set(disc);
  }

  private edit(what: (disc: DiscState) => void): void {
    this.actions.change((view) => {
      const disc = view.discs[this.chosen];
      if (disc !== undefined) what(disc);
    });
  }
}
