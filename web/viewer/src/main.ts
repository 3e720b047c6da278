// Puts the page together: <lambent-viewer>, the controls beside it, files from outside.
import { h, segments } from "./dom";
import { acceptDrops } from "./drops";
import { LambentViewerElement } from "./element/lambent_viewer";
import { facts } from "./facts";
import { FrameGraph } from "./frame_graph";
import { Help } from "./help";
import { History } from "./history";
import { environmentOf, listenToKeys } from "./keys";
import type { Grip } from "./orbit";
import type { Overlay } from "./overlays";
import { Panel, type PanelFacts } from "./panel";
import { PatchMarks } from "./patch_marks";
import { save } from "./save";
import { Session } from "./session";
import { SkyMap } from "./sky_map";
import type { SkySettings } from "./sky_source";
import { viewToJson, type AirShown } from "./view_state";
import type { Viewer } from "./viewer";

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

/** In place of everything. */
function sorry(stage: HTMLElement): void {
  stage.replaceChildren(
    h("div", { class: "sorry", role: "alert" },
      h("h1", {}, "No picture"),
      h("p", {}, "The page draws with WebGL 2, and this browser gives none."),
      h("p", {},
        "Update the browser or the graphics driver, switch hardware acceleration on, or use the " +
          "native viewer: lambent view ASSET.glb")));
}

function start(): void {
  const stage = document.querySelector<HTMLElement>("#stage")!;
  const element = document.querySelector<LambentViewerElement>("lambent-viewer")!;
  const { viewer } = element;
  if (viewer === null) return sorry(stage);
  element.fullScreenTarget = document.documentElement;

  const help = new Help();
  const session = new Session(viewer);
  const past = new History(viewer);
  const graph = new FrameGraph();
  const sky = new SkyMap({
    choose: (disc) => viewer.chooseDisc(disc),
    move: (disc, azimuth, elevation) =>
      viewer.change((view) => Object.assign(view.discs[disc]!, { azimuth, elevation })),
    turn: (radians) => viewer.turnLight(radians, 0),
  });
  viewer.makeMarks = (asset) => new PatchMarks(asset);
  viewer.framed.add((now, work) => {
    if (work !== null) graph.add(now, work);
    sky.show(viewer.view, viewer.current.environment, viewer.disc);
  });
  for (const type of ["pointerdown", "pointerup", "pointercancel"])
    document.addEventListener(type, () => past.divide(), { capture: true });

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
    await session.opened();
  };
  const savePicture = () =>
    void viewer.picture().then((blob) => save(blob, "lambent.png"));
  const hide = () => {
    element.toggleAttribute("bare", document.body.classList.toggle("bare"));
    window.dispatchEvent(new Event("resize"));
    // Who was among the controls is not left where nothing is.
    if (panel.element.contains(document.activeElement)) element.focus();
  };
  const actions = {
    change: viewer.change.bind(viewer),
    openAsset: (index: number) => void viewer.openAsset(index),
    openEnvironment: (index: number) => void viewer.openEnvironment(index),
    openFiles: () => picker.click(),
    copyBakeLine: () => void session.copyBakeLine(),
    startAfresh: () => void session.startAfresh(),
    addDisc: () => viewer.addDisc(),
    removeDisc: (index: number) => viewer.removeDisc(index),
    chooseDisc: (index: number) => viewer.chooseDisc(index),
    showSky: (settings: SkySettings | null) => void viewer.sky.show(settings),
    followSky: (on: boolean) => viewer.sky.follow(on),
    showAir: (on: boolean, part?: Partial<AirShown>) => void viewer.sky.showAir(on, part),
    frame: () => viewer.frame(),
    reset: () => viewer.reset(),
    undo: () => void past.undo(),
    redo: () => void past.redo(),
    play: (on: boolean) => viewer.play(on),
    setUnlit: (on: boolean) => viewer.setUnlit(on),
    setOverlay: (which: Overlay, on: boolean) => viewer.setOverlay(which, on),
    saveView: () =>
      save(new Blob([viewToJson(viewer.view)], { type: "application/json" }), "view.json"),
    copyLink: () => void session.copyLink(),
    savePicture,
    hide,
    fullScreen: () => element.fullScreen(),
    help: () => help.toggle(),
  };
  const panel = new Panel(actions, sky, graph);
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
  stage.append(grip.element, panel.past, picker);
  document.body.append(panel.element, help.element);
  listenToKeys(viewer, actions);
  acceptDrops(openAll);

  let shown = "";
  viewer.changed = () => {
    past.note();
    session.note();
    const now: PanelFacts = facts(viewer, environmentOf(viewer), past);
    const key = JSON.stringify([viewer.view, now]);
    if (key !== shown) panel.show(viewer.view, now);
    shown = key;
  };
  window.lambent = {
    viewer,
    ready: session.begin(),
    view: () => JSON.parse(viewToJson(viewer.view)) as unknown,
    async showView(json) {
      const opened = await viewer.openView(json, "view");
      await viewer.settled();
      return opened;
    },
  };
}

start();
