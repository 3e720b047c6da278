// <lambent-viewer>: an asset under its light, in one tag. The page is this and controls beside it.
import { button, h } from "../dom";
import { pressOnPicture } from "../picture_keys";
import { Viewer } from "../viewer";
import { kTransfers, viewToJson, type Rotation } from "../view_state";
import { messageOf } from "../messages";
import style from "./lambent_viewer.css?inline";

const kHint = "Arrow keys move around it, plus and minus zoom, F frames it, R turns it back, " +
  "Shift + F fills the screen";

const kCorners = '<svg viewBox="0 0 24 24" aria-hidden="true">' +
  '<path d="M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5"/></svg>';

/**
 * Attributes, which can change at any time:
 * - `src`: address of a .glb.
 * - `environment`: address of an .exr, .hdr or .png in latitude and longitude, or of a light's .json;
 *   `sky:…`, `uniform:…`, `disc:…`; or a sum of them, as `lambent view` takes it. Default uniform:1.
 * - `poster`: address of a picture that is shown until the first one is drawn.
 * - `rotation`: of the light about the vertical, degrees. Default 0.
 * - `transfer`: best, unshadowed, shadowed, interreflected. Default best.
 * - `exposure`: EV, -60 … 60. Default 0.
 * - `alt`: what it shows, in words. `bare`: the picture without a button on it.
 *
 * One that makes no sense is an `error`, and what was shown stays.
 *
 * Events: `load` once an asset is on the screen, detail { src, baked }; `error`, detail { message };
 * `progress`, detail { share }: 0 … 1, or null where nobody knows.
 */
export class LambentViewerElement extends HTMLElement {
  static readonly observedAttributes = [
    "src", "environment", "poster", "rotation", "transfer", "exposure", "alt",
  ];

  /** What is shown; null while the element is in no document, or where there is no WebGL 2. */
  viewer: Viewer | null = null;
  /** What fills the screen: the element itself. */
  fullScreenTarget: Element = this;

  private readonly changed = new Set<string>();
  private readonly poster = h("img", { class: "poster", alt: "" });
  private readonly enlarge = button("", "", () => this.fullScreen(), "fill");
  private picture: HTMLCanvasElement | null = null;
  private updating: Promise<void> | null = null;
  private shownSource = "";

  constructor() {
    super();
    const root = this.attachShadow({ mode: "open", delegatesFocus: true });
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(style);
    root.adoptedStyleSheets = [sheet];
    this.enlarge.innerHTML = kCorners;
    this.nameEnlarge();
    this.poster.hidden = true;
  }

  private readonly nameEnlarge = (): void => {
    const name = document.fullscreenElement ? "Leave the full screen" : "Fill the screen";
    this.enlarge.setAttribute("aria-label", name);
    this.enlarge.title = `${name} (Shift + F)`;
  };

  connectedCallback(): void {
    if (this.viewer !== null) return; // it was moved within the document
    const root = this.shadowRoot!;
    const picture = h("canvas", {
      id: "picture", tabindex: 0, role: "application", "aria-roledescription": "3D picture",
      "aria-label": this.label(),
    });
    try {
      this.viewer = new Viewer(picture);
    } catch (error) {
      root.replaceChildren(h("div", { class: "sorry", role: "alert" },
        h("p", {}, "This picture is drawn with WebGL 2, which this browser does not give. Update " +
          "the browser or the graphics driver, or switch hardware acceleration on.")));
      this.tell("error", { message: messageOf(error) });
      return;
    }
    this.picture = picture;
    const { viewer } = this;
    root.replaceChildren(picture, this.poster, viewer.loading.element, viewer.messages.element,
      this.enlarge);
    this.enlarge.hidden = !document.fullscreenEnabled;
    document.addEventListener("fullscreenchange", this.nameEnlarge);
    picture.addEventListener("keydown", (event) => {
      const fills = event.key === "F" && event.shiftKey && !event.ctrlKey && !event.altKey;
      if (fills) this.fullScreen();
      if (fills || pressOnPicture(viewer, event)) event.preventDefault();
    });
    viewer.messages.failed = (message) => this.tell("error", { message });
    viewer.loading.stepped = (share) => this.tell("progress", { share });
    viewer.framed.add(() => (this.poster.hidden = true));
    for (const name of LambentViewerElement.observedAttributes)
      if (this.hasAttribute(name)) this.changed.add(name);
    this.shownSource = "";
    this.schedule();
  }
  disconnectedCallback(): void {
    // An element that is moved comes back within the same task.
    queueMicrotask(() => {
      if (this.isConnected || this.viewer === null) return;
      document.removeEventListener("fullscreenchange", this.nameEnlarge);
      this.viewer.end();
      this.viewer = this.picture = null;
      this.shadowRoot!.replaceChildren();
    });
  }
  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (before === now) return;
    if (name === "alt") this.picture?.setAttribute("aria-label", this.label());
    if (name === "poster") {
      this.poster.hidden = now === null || this.viewer?.current.loaded != null;
      if (now !== null) this.poster.src = now;
    }
    this.changed.add(name);
    this.schedule();
  }

  /** The view as `lambent render --view` takes it; null while nothing is shown. */
  get view(): unknown {
    return this.viewer && (JSON.parse(viewToJson(this.viewer.view)) as unknown);
  }
  /** Resolves once what the attributes say is shown, or was refused. */
  get updated(): Promise<void> {
    const now = this.updating ?? Promise.resolve();
    return now.then(() => (this.updating === null ? undefined : this.updated));
  }
  /** Shows a saved view (parsed JSON). False, and an `error`, where it cannot. */
  async show(view: unknown): Promise<boolean> {
    await this.updating;
    return this.viewer?.openView(view, "view") ?? false;
  }
  /** Fills the screen, or no longer. */
  fullScreen(): void {
    if (document.fullscreenElement) return void document.exitFullscreen();
    this.fullScreenTarget.requestFullscreen().catch(() =>
      this.viewer?.messages.error("This browser lets nothing fill the screen here."));
  }

  /** Attributes that change together are one change. */
  private schedule(): void {
    if (this.viewer === null || this.updating !== null || this.changed.size === 0) return;
    this.updating = Promise.resolve()
      .then(() => this.update())
      .finally(() => {
        this.updating = null;
        this.schedule();
      });
  }
  private async update(): Promise<void> {
    const { viewer } = this;
    if (viewer === null) return;
    const names = new Set(this.changed);
    this.changed.clear();
    const { members, complaints } = this.members();
    const src = this.getAttribute("src");
    if (names.has("src") && src !== null && src !== this.shownSource) {
      const opened = viewer.library.atAddress(src);
      opened.view = members;
      const before = viewer.current.loaded;
      if (!(await viewer.open(opened))) return;
      const { loaded } = viewer.current;
      if (loaded === null || loaded === before) return; // taken away meanwhile
      this.shownSource = src;
      this.tell("load", { src, baked: loaded.plain === null });
    } else if (viewer.current.loaded !== null) {
      const source = members.environment.source ?? viewer.library.firstSource();
      if (names.has("environment") && !(await viewer.openSource(source))) return;
      viewer.change((view) => {
        if (names.has("rotation")) view.environment.rotation = members.environment.rotation;
        if (names.has("exposure")) view.exposure = members.exposure;
        if (names.has("transfer")) view.transfer = members.transfer;
      });
    }
    for (const [name, complaint] of complaints)
      if (names.has(name)) viewer.messages.error(complaint);
  }
  /** What the attributes say, as members of a view; and what is wrong with them, by their names. */
  private members() {
    const complaints = new Map<string, string>();
    const number = (name: string, most: number) => {
      const text = this.getAttribute(name);
      const value = Number(text ?? 0);
      if (text?.trim() !== "" && Math.abs(value) <= most) return value;
      complaints.set(name, `${name}="${text}": it takes a number from ${-most} to ${most}`);
      return 0;
    };
    const asked = this.getAttribute("transfer") ?? "best";
    const transfer = kTransfers.find((each) => each === asked);
    if (transfer === undefined)
      complaints.set("transfer", `transfer="${asked}": it takes ${kTransfers.join(", ")}`);
    const half = (number("rotation", 36000) * Math.PI) / 360;
    const source = this.getAttribute("environment");
    const rotation: Rotation = [0, Math.sin(half), 0, Math.cos(half)];
    const members = {
      environment: { ...(source !== null && { source }), rotation } as {
        source?: string;
        rotation: Rotation;
      },
      exposure: number("exposure", 60),
      transfer: transfer ?? "best",
    };
    return { members, complaints };
  }
  private label(): string {
    return `${this.getAttribute("alt") ?? "A picture in three dimensions"}. ${kHint}`;
  }
  private tell(name: string, detail: unknown): void {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }
}

if (!customElements.get("lambent-viewer"))
  customElements.define("lambent-viewer", LambentViewerElement);

declare global {
  interface HTMLElementTagNameMap {
    "lambent-viewer": LambentViewerElement;
  }
}
