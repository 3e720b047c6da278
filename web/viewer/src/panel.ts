// All controls, in sections: beside the picture, or as a sheet with tabs where there is no room.
import type { TransferChoice, WindowName } from "three-lambent";
import { button, h, segments, select, slider, toggle } from "./dom";
import { DiscControls } from "./disc_controls";
import type { FrameGraph } from "./frame_graph";
import { SkyControls, type SkyActions, type SkyFacts } from "./sky_controls";
import { kOverlays, type Overlay, type Overlays } from "./overlays";
import type { SkyMap } from "./sky_map";
import type { ViewState } from "./view_state";

/** What the panel asks its owner to do. */
export interface PanelActions extends SkyActions {
  change(what: (view: ViewState) => void): void;
  openAsset(index: number): void;
  openEnvironment(index: number): void;
  openFiles(): void;
  copyBakeLine(): void;
  startAfresh(): void;
  addDisc(): void;
  removeDisc(index: number): void;
  chooseDisc(index: number): void;
  frame(): void;
  reset(): void;
  undo(): void;
  redo(): void;
  play(on: boolean): void;
  setUnlit(on: boolean): void;
  setOverlay(which: Overlay, on: boolean): void;
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
  /** Why nothing goes by itself; null if it may. */
  still: string | null;
  unlit: boolean;
  overlays: Overlays;
  undoes: boolean;
  redoes: boolean;
  sky: SkyFacts;
  info: string;
  /** The line that bakes what is shown; null: it is baked. */
  bake: string | null;
  /** Why a choice shows nothing of its own; null where it does. */
  noTransfer: Record<TransferChoice, string | null>;
  noSharpSun: string | null;
  noPatch: string | null;
  noLobe: string | null;
  /** Why the choices of how light acts do nothing at all. */
  noLight: string | null;
}

const kSections = ["Object", "Light", "Sky", "Surface", "Picture"] as const;
type Section = (typeof kSections)[number];
const kMostLobe = 200;
const kOverlayWords: Record<Overlay, [string, string]> = {
  field: ["Field", "Strokes along the patch's first axis, thinner towards it"],
  singularities: ["Singularities",
    "Where the field turns about a point: red, or blue where it turns backwards"],
  seams: ["Seams", "Lines along which pieces of the patch meet"],
  cuts: ["Cuts", "Borders of the charts that the surface was laid out in"],
};

export class Panel {
  readonly element: HTMLElement;
  /** Changes taken back and made again: beside the picture, in reach of a thumb. */
  readonly past = h("div", { id: "past", role: "group", "aria-label": "Changes" });
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
      Surface: this.surfaceSection(),
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
      tab.addEventListener("keydown", ({ key }) => {
        const by = { ArrowRight: 1, ArrowLeft: -1 }[key];
        if (by === undefined) return;
        const at = (kSections.indexOf(name) + by + kSections.length) % kSections.length;
        open(kSections[at]!);
        tabs.querySelectorAll("button")[at]!.focus();
      });
      sections[name].id = `section-${name}`;
      tabs.append(tab);
      body.append(sections[name]);
    }
    const fold = button("", "Fold or unfold the controls", () => {
      this.element.classList.toggle("folded");
      window.dispatchEvent(new Event("resize"));
    }, "fold");
    fold.setAttribute("aria-label", "Fold or unfold the controls");
    const round = (text: string, name: string, key: string, press: () => void) => {
      const made = button(text, `${name} (${key})`, press, "round");
      made.setAttribute("aria-label", name);
      return made;
    };
    const header = h("header", {},
      h("p", { class: "title" }, "Lambent"),
      round("?", "Help", "?", () => actions.help()));
    const undo = round("↶", "Undo", "Ctrl + Z", () => actions.undo());
    const redo = round("↷", "Redo", "Ctrl + Shift + Z", () => actions.redo());
    this.past.append(undo, redo);
    this.updates.push((_, facts) => {
      undo.disabled = !facts.undoes;
      redo.disabled = !facts.redoes;
    });
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
    const line = h("code", {});
    const bake = h("div", { class: "bake" },
      h("p", { class: "reason" }, "It is not baked. This relights it:"), line,
      button("Copy the line", "Onto the clipboard", () => actions.copyBakeLine()));
    this.updates.push((_, facts) => {
      assets.fill(facts.assets, facts.asset);
      info.textContent = facts.info;
      bake.hidden = facts.bake === null;
      line.textContent = facts.bake;
    });
    return this.section("Object", assets.element, info, bake,
      h("div", { class: "row" },
        button("Open files…", "Open .glb, .hdr, .exr, .png or a saved view (O)", () =>
          actions.openFiles()),
        button("Frame", "Frame the object (F)", () => actions.frame()),
        button("Reset", "Turn everything back (R)", () => actions.reset()),
        button("Start afresh", "The page's own scene, as it was first shown", () =>
          actions.startAfresh())));
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
      "Smoothing",
      [
        { value: "auto", label: "Gloss",
          title: "Glossy surfaces alone, by the least that leaves no rings" },
        { value: "none", label: "None", title: "The harmonics as they are" },
        { value: "minimal", label: "Least", title: "The least that keeps radiance above zero" },
        { value: "hann", label: "Hann", title: "Hann's window: soft" },
        { value: "lanczos", label: "Lanczos", title: "Lanczos's window: less soft" },
      ],
      (kind) =>
        actions.change((view) => {
          view.window = kind === "hann" || kind === "lanczos" ? `${kind}:${width}` : kind;
        }),
      "Windowing of the harmonics against ringing: takes dark rings around bright light (W)",
    );
    let width = 5;
    const widthSlider = slider({
      label: "Detail that stays",
      title: "Width of the window, in bands of spherical harmonics",
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
      play.forbid(facts.still);
      discs.show(view, facts.disc);
      const [kind, given] = view.window.split(":") as
        ["auto" | "none" | "minimal" | "hann" | "lanczos", string?];
      if (given !== undefined) width = Number(given);
      window.set(kind);
      widthSlider.set(width);
      widthSlider.element.hidden = kind !== "hann" && kind !== "lanczos";
    });
    return this.section("Light", environments.element, sky.element, turn.element, play.element,
      discs.element, window.element, widthSlider.element);
  }

  private skySection(): HTMLElement {
    const controls = new SkyControls(this.actions);
    this.updates.push((view, facts) => controls.show(view, facts.sky));
    return this.section("Sky", controls.element);
  }

  private surfaceSection(): HTMLElement {
    const { actions } = this;
    const transfer = segments<TransferChoice>(
      "What light does",
      [
        { value: "best", label: "Best", title: "The best transfer that the asset holds (0)" },
        { value: "unshadowed", label: "Bare",
          title: "Unshadowed transfer: no shadows, the cosine alone (1)" },
        { value: "shadowed", label: "Shadows",
          title: "Shadowed transfer: surfaces hide light (2)" },
        { value: "interreflected", label: "Bounces",
          title: "Interreflected transfer: surfaces also pass light on (3)" },
      ],
      (choice) => actions.change((view) => (view.transfer = choice)),
      "Which part of the precomputed radiance transfer is shown",
    );
    const reasons = h("p", { class: "reason" });
    const sun = toggle("Sharp shadow of the Sun",
      "A small disc of light shows through a map of its shadows, not as harmonics have it",
      (on) => actions.change((view) => (view.sunShadow = on ? "sharp" : "soft")));
    const macro = toggle("Shadows on the relief",
      "Macro-scale transfer: what the whole shape does to the light on meso-structure (M)",
      (on) => actions.change((view) => (view.macro = on)));
    const views = toggle("Relief changes with the view",
      "View dependence of the radiance transfer texture; off: as seen from straight above (V)",
      (on) => actions.change((view) => (view.viewDependent = on)));
    const unlit = toggle("Base colour alone", "Albedo, without light (U)", (on) =>
      actions.setUnlit(on));
    const overlays = kOverlays.map((each) =>
      toggle(kOverlayWords[each][0], `${kOverlayWords[each][1]} (L: all of them)`, (on) =>
        actions.setOverlay(each, on)));
    const ownLobe = toggle("Gloss of my own", "Another exponent of the glossy lobe", (on) =>
      actions.change((view) => (view.lobe = on ? 16 : null)));
    // Exponents as the ear hears loudness: equal steps are equal ratios.
    const lobe = slider({
      label: "Gloss",
      title: "Exponent of the Phong lobe: the higher, the sharper what is reflected",
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
      kOverlays.forEach((each, i) => {
        overlays[i]!.set(facts.overlays[each]);
        overlays[i]!.forbid(facts.noPatch);
      });
      unlit.set(facts.unlit);
      unlit.forbid(facts.noLight);
    });
    return this.section("Surface", transfer.element, sun.element, macro.element, views.element,
      ownLobe.element, lobe.element, unlit.element,
      h("h3", {}, "How the patch lies"), ...overlays.map(({ element }) => element), reasons);
  }

  private pictureSection(graph: FrameGraph): HTMLElement {
    const { actions } = this;
    const exposure = slider({
      label: "Exposure",
      title: "In stops: +1 EV is twice as bright ([ and ])",
      min: -10,
      max: 24, // of a sky with the Sun at −18°
      step: 0.1,
      format: (value) => `${value > 0 ? "+" : ""}${value.toFixed(1)} EV`,
      change: (value) => actions.change((view) => (view.exposure = value)),
    });
    const tone = segments<"filmic" | "linear">(
      "Tone",
      [
        { value: "filmic", label: "Filmic", title: "Highlights roll off as on film" },
        { value: "linear", label: "Linear", title: "Cut off at white" },
      ],
      (curve) => actions.change((view) => (view.tone = curve)),
      "Tone curve: how bright light is brought onto the screen (T)",
    );
    const background = toggle("Background", "The environment behind the object (B)", (on) =>
      actions.change((view) => (view.background = on)));
    const samples = slider({
      label: "Samples of a still picture",
      title: "Per pixel, once nothing moves: edges and shadows of the Sun become smooth",
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
        button("Copy link", "To this page with this asset and this view", () =>
          actions.copyLink())),
      h("h3", {}, "Frame times"), graph.element);
  }
}
