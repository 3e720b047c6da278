// All controls, in sections: beside the picture, or as a sheet with tabs where there is no room.
import type { TransferChoice, WindowName } from "three-lambent";
import { button, h, segments, select, slider, toggle } from "./dom";
import { DiscControls } from "./disc_controls";
import type { FrameGraph } from "./frame_graph";
import { SkyControls, type SkyActions, type SkyFacts } from "./sky_controls";
import type { SkyMap } from "./sky_map";
import type { ViewState } from "./view_state";

/** What the panel asks its owner to do. */
export interface PanelActions extends SkyActions {
  change(what: (view: ViewState) => void): void;
  openAsset(index: number): void;
  openEnvironment(index: number): void;
  openFiles(): void;
  addDisc(): void;
  removeDisc(index: number): void;
  chooseDisc(index: number): void;
  frame(): void;
  reset(): void;
  play(on: boolean): void;
  setUnlit(on: boolean): void;
  saveView(): void;
  copyLink(): void;
  savePicture(): void;
  help(): void;
}

/** What the panel shows besides the view. */
export interface PanelFacts {
  assets: readonly string[];
  asset: number;
  environments: readonly string[];
  environment: number;
  disc: number;
  playing: boolean;
  unlit: boolean;
  sky: SkyFacts;
  info: string;
  /** Why a choice shows nothing of its own; null where it does. */
  noTransfer: Record<TransferChoice, string | null>;
  noSharpSun: string | null;
  noPatch: string | null;
  noLobe: string | null;
}

const kSections = ["Object", "Light", "Sky", "Transport", "Picture"] as const;
type Section = (typeof kSections)[number];
const kMostLobe = 200;

export class Panel {
  readonly element: HTMLElement;
  private environments = 0;
  private readonly updates: ((view: ViewState, facts: PanelFacts) => void)[] = [];

  constructor(
    private readonly actions: PanelActions,
    sky: SkyMap,
    graph: FrameGraph,
  ) {
    const sections: Record<Section, HTMLElement> = {
      Object: this.objectSection(),
      Light: this.lightSection(sky),
      Sky: this.skySection(),
      Transport: this.transportSection(),
      Picture: this.pictureSection(graph),
    };
    const tabs = h("div", { class: "tabs", role: "tablist", "aria-label": "Controls" });
    const body = h("div", { class: "sections" });
    const open = (name: Section) => {
      for (const each of kSections) {
        sections[each].classList.toggle("chosen", each === name);
        tabs.querySelector(`#tab-${each}`)!.setAttribute("aria-selected", String(each === name));
      }
      this.element?.classList.remove("folded");
      window.dispatchEvent(new Event("resize"));
    };
    for (const name of kSections) {
      const tab = button(name, "", () => open(name), "tab");
      tab.id = `tab-${name}`;
      tab.setAttribute("role", "tab");
      tab.setAttribute("aria-controls", `section-${name}`);
      sections[name].id = `section-${name}`;
      tabs.append(tab);
      body.append(sections[name]);
    }
    const fold = button("", "Fold or unfold the controls", () => {
      this.element.classList.toggle("folded");
      window.dispatchEvent(new Event("resize"));
    }, "fold");
    fold.setAttribute("aria-label", "Fold or unfold the controls");
    const header = h("header", {},
      h("h1", {}, "Lambent"),
      button("?", "Help (?)", () => actions.help(), "round"));
    this.element = h("aside", { id: "panel", "aria-label": "Controls" }, header, fold, tabs, body);
    open("Light");
  }

  show(view: ViewState, facts: PanelFacts): void {
    for (const update of this.updates) update(view, facts);
  }

  private section(title: Section, ...children: HTMLElement[]): HTMLElement {
    return h("section", { "aria-label": title }, h("h2", {}, title), ...children);
  }

  private objectSection(): HTMLElement {
    const { actions } = this;
    const assets = select("Asset", (index) => actions.openAsset(index));
    const info = h("p", { class: "figures" });
    this.updates.push((_, facts) => {
      assets.fill(facts.assets, facts.asset);
      info.textContent = facts.info;
    });
    return this.section("Object", assets.element, info,
      h("div", { class: "row" },
        button("Open files…", "Open .glb, .hdr, .exr, .png or a saved view (O)", () =>
          actions.openFiles()),
        button("Frame", "Frame the object (F)", () => actions.frame()),
        button("Reset", "Turn everything back (R)", () => actions.reset())));
  }

  private lightSection(sky: SkyMap): HTMLElement {
    const { actions } = this;
    const environments = select("Environment", (index) => {
      if (index < this.environments) actions.openEnvironment(index);
    });
    const turn = slider({
      label: "Turn",
      min: -180,
      max: 180,
      step: 1,
      format: (value) => `${value.toFixed(0)}°`,
      change: (degrees) =>
        actions.change((view) => {
          // About the vertical: what other axes have turned is let go.
          const half = (degrees * Math.PI) / 360;
          view.environment.rotation = [0, Math.sin(half), 0, Math.cos(half)];
        }),
    });
    const play = toggle("Let it go round", "Turn the light slowly (A)", (on) =>
      actions.play(on));
    const discs = new DiscControls(actions);
    const window = segments<"auto" | "none" | "minimal" | "hann" | "lanczos">(
      "Windowing",
      [
        { value: "auto", label: "Gloss", title: "Glossy surfaces alone, by the least that leaves no rings" },
        { value: "none", label: "None", title: "The harmonics as they are" },
        { value: "minimal", label: "Least", title: "The least that keeps radiance above zero" },
        { value: "hann", label: "Hann" },
        { value: "lanczos", label: "Lanczos" },
      ],
      (kind) =>
        actions.change((view) => {
          view.window = kind === "hann" || kind === "lanczos" ? `${kind}:${width}` : kind;
        }),
    );
    let width = 5;
    const widthSlider = slider({
      label: "Width of the window",
      min: 1,
      max: 10,
      step: 0.25,
      format: (value) => `${value} bands`,
      change: (value) =>
        actions.change((view) => {
          width = value;
          const kind = view.window.split(":")[0] as "hann" | "lanczos";
          view.window = `${kind}:${value}` as WindowName;
        }),
    });
    this.updates.push((view, facts) => {
      // What is not of the list has no other name.
      this.environments = facts.environments.length;
      const sky = facts.environment < 0 && view.environment.source.startsWith("sky:");
      environments.fill(
        sky ? [...facts.environments, "Sky"] : facts.environments,
        sky ? facts.environments.length : facts.environment,
      );
      const [x, y, z, w] = view.environment.rotation;
      turn.set(Math.round((Math.atan2(2 * (w * y + x * z), 1 - 2 * (x * x + y * y)) * 180) / Math.PI));
      play.set(facts.playing);
      discs.show(view, facts.disc);
      const [kind, given] = view.window.split(":") as ["none" | "minimal" | "hann" | "lanczos", string?];
      if (given !== undefined) width = Number(given);
      window.set(kind);
      widthSlider.set(width);
      widthSlider.element.hidden = kind === "none" || kind === "minimal";
    });
    return this.section("Light", environments.element, sky.element, turn.element, play.element,
      discs.element, window.element, widthSlider.element);
  }

  private skySection(): HTMLElement {
    const controls = new SkyControls(this.actions);
    this.updates.push((view, facts) => controls.show(view, facts.sky));
    return this.section("Sky", controls.element);
  }

  private transportSection(): HTMLElement {
    const { actions } = this;
    const transfer = segments<TransferChoice>(
      "What light does",
      [
        { value: "best", label: "Best", title: "The best that the asset holds (0)" },
        { value: "unshadowed", label: "Bare", title: "Unshadowed: the cosine alone (1)" },
        { value: "shadowed", label: "Shadows", title: "Shadowed: surfaces hide light (2)" },
        { value: "interreflected", label: "Bounces",
          title: "Interreflected: surfaces also pass light on (3)" },
      ],
      (choice) => actions.change((view) => (view.transfer = choice)),
    );
    const reasons = h("p", { class: "reason" });
    const sun = toggle("Sharp shadow of the Sun",
      "A small disc of light shows through a map of its shadows, not as harmonics have it",
      (on) => actions.change((view) => (view.sunShadow = on ? "sharp" : "soft")));
    const macro = toggle("Macro-scale shadows",
      "What the shape as a whole does to the light on meso-structure (M)",
      (on) => actions.change((view) => (view.macro = on)));
    const views = toggle("Dependence on the view",
      "Off: meso-structure as seen from straight above (V)",
      (on) => actions.change((view) => (view.viewDependent = on)));
    const unlit = toggle("Base colour alone", "Without light (U)", (on) => actions.setUnlit(on));
    const ownLobe = toggle("Lobe of my own", "Another exponent of glossy lobes", (on) =>
      actions.change((view) => (view.lobe = on ? 16 : null)));
    // Exponents as the ear hears loudness: equal steps are equal ratios.
    const lobe = slider({
      label: "Exponent of the lobe",
      min: 0,
      max: Math.log2(kMostLobe),
      step: 0.05,
      format: (value) => (2 ** value).toPrecision(3).replace(/\.0+$/, ""),
      change: (value) => actions.change((view) => (view.lobe = Number((2 ** value).toPrecision(3)))),
    });
    this.updates.push((view, facts) => {
      transfer.set(view.transfer);
      for (const choice of Object.keys(facts.noTransfer) as TransferChoice[])
        transfer.forbid(choice, facts.noTransfer[choice]);
      const said = new Set(
        [...Object.values(facts.noTransfer), facts.noSharpSun, facts.noPatch, facts.noLobe].filter(
          (each) => each !== null,
        ),
      );
      reasons.textContent = [...said].join(" ");
      reasons.hidden = said.size === 0;
      sun.set(view.sunShadow === "sharp");
      sun.forbid(facts.noSharpSun);
      macro.set(view.macro);
      macro.forbid(facts.noPatch);
      views.set(view.viewDependent);
      views.forbid(facts.noPatch);
      ownLobe.set(view.lobe !== null);
      ownLobe.forbid(facts.noLobe);
      lobe.set(Math.log2(Math.max(view.lobe ?? 16, 1)));
      lobe.element.hidden = view.lobe === null;
      unlit.set(facts.unlit);
    });
    return this.section("Transport", transfer.element, sun.element, macro.element, views.element,
      ownLobe.element, lobe.element, unlit.element, reasons);
  }

  private pictureSection(graph: FrameGraph): HTMLElement {
    const { actions } = this;
    const exposure = slider({
      label: "Exposure",
      min: -10,
      max: 24, // of a sky with the Sun at −18°
      step: 0.1,
      format: (value) => `${value > 0 ? "+" : ""}${value.toFixed(1)} EV`,
      change: (value) => actions.change((view) => (view.exposure = value)),
    });
    const tone = segments<"filmic" | "linear">(
      "Tone",
      [
        { value: "filmic", label: "Filmic" },
        { value: "linear", label: "Linear" },
      ],
      (curve) => actions.change((view) => (view.tone = curve)),
    );
    const background = toggle("Background", "The environment behind the object (B)", (on) =>
      actions.change((view) => (view.background = on)));
    const samples = slider({
      label: "Samples of a still picture",
      min: 0,
      max: 8,
      step: 1,
      format: (value) => `${2 ** value}`,
      change: (value) => actions.change((view) => (view.samples = 2 ** value)),
    });
    this.updates.push((view) => {
      exposure.set(view.exposure);
      tone.set(view.tone);
      background.set(view.background);
      samples.set(Math.log2(view.samples));
    });
    return this.section("Picture", exposure.element, tone.element, background.element,
      samples.element,
      h("div", { class: "row" },
        button("Save picture", "As .png (S)", () => actions.savePicture()),
        button("Save view", "As .json, which lambent view and lambent render --view take (Ctrl + S)", () =>
          actions.saveView()),
        button("Copy link", "To this page with this view", () => actions.copyLink())),
      h("h3", {}, "Frame times"), graph.element);
  }
}
