// Puts the page together: the picture, the controls beside it, files from outside.
import { button, h, segments } from "./dom";
import { Help } from "./help";
import { environmentOf, listenToKeys } from "./keys";
import { fetchManifest } from "./manifest";
import type { Grip } from "./orbit";
import { Panel, type PanelFacts } from "./panel";
import { progressiveRead } from "./read_url";
import { facts } from "./facts";
import { save } from "./save";
import type { SkySettings } from "./sky_source";
import { parseView, viewToJson, type AirShown } from "./view_state";
import { Viewer } from "./viewer";

declare global {
  interface Window {
    /** For scripts that drive the page, tests among them. */
    lambent?: {
      viewer: Viewer;
      /** Resolves once the first picture is shown. */
      ready: Promise<void>;
      /** Shows a saved view (parsed JSON); resolves once all of its samples are shown. */
      showView(json: unknown): Promise<boolean>;
      view(): unknown;
    };
  }
}

function sorry(stage: HTMLElement, reason: string): void {
  stage.append(
    h("div", { class: "sorry", role: "alert" },
      h("h2", {}, "No picture"),
      h("p", {}, `The page draws with WebGL 2, and this browser gives none (${reason}).`),
      h("p", {},
        "Update the browser or the graphics driver, switch hardware acceleration on, or use the " +
          "native viewer: lambent view ASSET.glb")));
}

function start(): void {
  const stage = document.querySelector<HTMLElement>("#stage")!;
  const canvas = document.querySelector<HTMLCanvasElement>("#picture")!;
  let viewer: Viewer;
  try {
    viewer = new Viewer(canvas);
  } catch (error) {
    return sorry(stage, error instanceof Error ? error.message : String(error));
  }

  const help = new Help();
  const picker = h("input", {
    type: "file", multiple: true, hidden: true, "aria-label": "Files to open",
    accept: ".glb,.hdr,.exr,.png,.jpg,.jpeg,.json",
  });
  picker.addEventListener("change", () => {
    void openAll([...(picker.files ?? [])]);
    picker.value = "";
  });
  const openAll = async (files: readonly File[]) => {
    // Lights first, so that an asset dropped with its light is first seen under it.
    const rank = (file: File) => (/\.glb$/i.test(file.name) ? 1 : 0);
    for (const file of [...files].sort((a, b) => rank(a) - rank(b))) await viewer.openFile(file);
  };
  const savePicture = () =>
    void viewer.picture().then((blob) => save(blob, "lambent.png"));
  const hide = () => {
    document.body.classList.toggle("bare");
    window.dispatchEvent(new Event("resize"));
  };
  const actions = {
    change: viewer.change.bind(viewer),
    openAsset: (index: number) => void viewer.openAsset(index),
    openEnvironment: (index: number) => void viewer.openEnvironment(index),
    openFiles: () => picker.click(),
    addDisc: () => viewer.addDisc(),
    removeDisc: (index: number) => viewer.removeDisc(index),
    chooseDisc: (index: number) => viewer.chooseDisc(index),
    showSky: (settings: SkySettings | null) => void viewer.showSky(settings),
    followSky: (on: boolean) => viewer.followSky(on),
    showAir: (on: boolean, part?: Partial<AirShown>) => void viewer.showAir(on, part),
    frame: () => viewer.frame(),
    reset: () => viewer.reset(),
    play: (on: boolean) => viewer.play(on),
    setUnlit: (on: boolean) => viewer.setUnlit(on),
    saveView: () =>
      save(new Blob([viewToJson(viewer.view)], { type: "application/json" }), "view.json"),
    copyLink: () => void copyLink(viewer),
    savePicture,
    help: () => help.toggle(),
  };
  const panel = new Panel(actions, viewer.sky, viewer.graph);
  const grip = segments<Grip>(
    "Dragging turns",
    [
      { value: "camera", label: "Camera" },
      { value: "object", label: "Object", title: "Also: Ctrl + drag" },
      { value: "light", label: "Light", title: "Also: Shift + drag" },
    ],
    (value) => (viewer.grip = value),
  );
  grip.set("camera");
  grip.element.id = "grip";
  stage.append(viewer.loading.element, viewer.messages.element, grip.element, picker);
  const show = button("Controls", "Show the controls (H)", hide, "show-controls");
  stage.append(show);
  document.body.append(panel.element, help.element);
  listenToKeys(viewer, {
    openFiles: actions.openFiles,
    savePicture,
    saveView: actions.saveView,
    hide,
    help: () => help.toggle(),
  });
  acceptDrops(openAll);

  let shown = "";
  viewer.changed = () => {
    const now: PanelFacts = facts(viewer, environmentOf(viewer));
    const key = JSON.stringify([viewer.view, now]);
    if (key !== shown) panel.show(viewer.view, now);
    shown = key;
  };
  const ready = open(viewer);
  window.lambent = {
    viewer,
    ready,
    view: () => JSON.parse(viewToJson(viewer.view)) as unknown,
    async showView(json) {
      const opened = await viewer.openView(json, "view");
      await viewer.settled();
      return opened;
    },
  };
}

/** The first of the manifest's assets, under its own light or as the link says. */
async function open(viewer: Viewer): Promise<void> {
  try {
    viewer.loading.show("Loading", null);
    const manifest = await fetchManifest();
    const read = (url: string) => progressiveRead(url, viewer.loading);
    viewer.addEnvironments(manifest.environments, read);
    viewer.addAssets(manifest.assets, read);
    const link = linkedView();
    if (manifest.assets.length > 0) await viewer.openAsset(0);
    if (link !== null) await viewer.openView(link, "the link");
    performance.mark("lambent-first-view");
  } catch (error) {
    viewer.messages.error(error instanceof Error ? error.message : String(error));
  } finally {
    viewer.loading.hide();
    viewer.changed();
  }
}

/** #view=… of the address, or null. */
function linkedView(): unknown {
  const text = new URLSearchParams(location.hash.slice(1)).get("view");
  if (text === null) return null;
  try {
    const json: unknown = JSON.parse(text);
    parseView(json, "the link");
    return json;
  } catch (error) {
    throw new Error(`The link's view cannot be read: ${(error as Error).message}`);
  }
}

async function copyLink(viewer: Viewer): Promise<void> {
  const json = JSON.stringify(JSON.parse(viewToJson(viewer.view)));
  const link = `${location.href.split("#")[0]}#${new URLSearchParams({ view: json }).toString()}`;
  history.replaceState(null, "", link);
  try {
    await navigator.clipboard.writeText(link);
    viewer.messages.note("The link is on the clipboard, and in the address bar.");
  } catch {
    viewer.messages.note("The address bar now holds the link.");
  }
}

function acceptDrops(openAll: (files: readonly File[]) => Promise<void>): void {
  const has = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  let depth = 0; // of elements that the drag has entered and not left
  const mark = () => document.body.classList.toggle("dropping", depth > 0);
  window.addEventListener("dragenter", (event) => {
    if (!has(event)) return;
    event.preventDefault();
    ++depth;
    mark();
  });
  window.addEventListener("dragleave", (event) => {
    if (!has(event)) return;
    depth = Math.max(0, depth - 1);
    mark();
  });
  window.addEventListener("dragover", (event) => {
    if (has(event)) event.preventDefault();
  });
  window.addEventListener("drop", (event) => {
    if (!has(event)) return;
    event.preventDefault();
    depth = 0;
    mark();
    void openAll([...(event.dataTransfer?.files ?? [])]);
  });
}

start();
