// All directions of the world on a small map, in latitude and longitude, with the discs of light:
// drag a disc to move it, drag the sky to turn it.
import { Quaternion, Vector3 } from "three";
import { filmic, srgbEncode } from "three-lambent";
import { h } from "./dom";
import { pixelAt } from "./environment_map";
import { azimuthElevationOf, directionFromAzimuthElevation, kRadians } from "./directions";
import type { LoadedEnvironment } from "./environments";
import type { DiscState, ViewState } from "./view_state";

const kWidth = 208;
const kHeight = kWidth / 2;
const kScale = 2; // pixels of the canvas for one of the map, so that discs are round

export interface SkyMapEvents {
  choose(disc: number): void;
  move(disc: number, azimuth: number, elevation: number): void;
  turn(radians: number): void;
}

export class SkyMap {
  readonly element = h("canvas", {
    class: "sky",
    width: kWidth * kScale,
    height: kHeight * kScale,
    role: "img",
    "aria-label":
      "Map of the sky. Discs of light can be dragged here, or set by the sliders below",
  });
  private readonly sky = new ImageData(kWidth, kHeight);
  private drawn = "";
  private discs: readonly DiscState[] = [];
  private chosen = -1;

  constructor(events: SkyMapEvents) {
    let held: { disc: number; x: number } | null = null;
    const place = (event: PointerEvent) => {
      const box = this.element.getBoundingClientRect();
      return {
        u: (event.clientX - box.left) / box.width,
        v: (event.clientY - box.top) / box.height,
        reach: 14 / box.width,
      };
    };
    this.element.addEventListener("pointerdown", (event) => {
      this.element.setPointerCapture(event.pointerId);
      const { u, v, reach } = place(event);
      let disc = -1;
      this.discs.forEach((each, i) => {
        const { u: du, v: dv } = onMap(each);
        const across = Math.abs(u - du);
        if (Math.hypot(Math.min(across, 1 - across), (v - dv) / 2) < reach + each.diameter / 720)
          disc = i;
      });
      held = { disc, x: u };
      if (disc >= 0) events.choose(disc);
    });
    this.element.addEventListener("pointermove", (event) => {
      if (held === null) return;
      const { u, v } = place(event);
      if (held.disc >= 0)
        events.move(
          held.disc,
          360 * (u - Math.floor(u)) - 180,
          Math.max(-90, Math.min(90, 180 * (0.5 - v))),
        );
      else events.turn(-2 * Math.PI * (u - held.x));
      held.x = u;
    });
    for (const end of ["pointerup", "pointercancel"] as const)
      this.element.addEventListener(end, () => (held = null));
  }

  /** Draws anew if anything changed that it shows. */
  show(view: ViewState, environment: LoadedEnvironment | null, chosen: number): void {
    this.discs = view.discs;
    this.chosen = chosen;
    const key = JSON.stringify([view.environment, view.discs, view.exposure, view.tone, chosen]);
    if (key === this.drawn || this.element.offsetParent === null) return;
    this.drawn = key;
    this.paintSky(view, environment);
    const context = this.element.getContext("2d")!;
    const small = new OffscreenCanvas(kWidth, kHeight);
    small.getContext("2d")!.putImageData(this.sky, 0, 0);
    context.imageSmoothingEnabled = true;
    context.drawImage(small, 0, 0, this.element.width, this.element.height);
    context.fillStyle = "#ffffff30";
    context.fillRect(0, this.element.height / 2, this.element.width, 1);
    const sun = environment?.sky?.sun;
    if (sun?.disc) {
      // Half a degree would not show here.
      const turn = new Quaternion(...view.environment.rotation);
      const at = azimuthElevationOf(new Vector3(...sun.direction).applyQuaternion(turn));
      const { u, v } = onMap({ azimuth: at.azimuth / kRadians, elevation: at.elevation / kRadians });
      context.beginPath();
      context.arc(u * this.element.width, v * this.element.height, 5, 0, 2 * Math.PI);
      context.fillStyle = "#ffffff";
      context.fill();
    }
    view.discs.forEach((disc, i) => this.paintDisc(context, disc, i === this.chosen));
  }

  private paintSky(view: ViewState, environment: LoadedEnvironment | null): void {
    const back = new Quaternion(...view.environment.rotation).invert();
    const gain = 2 ** view.exposure;
    const direction = new Vector3();
    const [pixels, uniform] = [this.sky.data, environment?.uniform ?? [0, 0, 0]];
    for (let y = 0, at = 0; y < kHeight; ++y)
      for (let x = 0; x < kWidth; ++x, at += 4) {
        direction.copy(
          directionFromAzimuthElevation(
            2 * Math.PI * ((x + 0.5) / kWidth - 0.5),
            Math.PI * (0.5 - (y + 0.5) / kHeight),
          ),
        );
        direction.applyQuaternion(back);
        const color = [...uniform];
        if (environment?.map) {
          const { azimuth, elevation } = azimuthElevationOf(direction);
          const [u, v] = [azimuth / (2 * Math.PI) + 0.5, 0.5 - elevation / Math.PI];
          pixelAt(environment.map, u, v).forEach((each, c) => (color[c]! += each));
        }
        environment?.sky?.radiance(direction).forEach((each, c) => (color[c]! += each));
        for (const disc of environment?.discs ?? [])
          if (!disc.horizon && direction.dot(disc.direction as Vector3) > Math.cos(disc.diameter / 2))
            disc.radiance.forEach((each, c) => (color[c]! += each));
        for (let c = 0; c < 3; ++c) {
          const exposed = gain * color[c]!;
          const toned = view.tone === "filmic" ? filmic(exposed) : Math.min(1, exposed);
          pixels[at + c] = 255 * srgbEncode(toned);
        }
        pixels[at + 3] = 255;
      }
  }

  private paintDisc(context: CanvasRenderingContext2D, disc: DiscState, chosen: boolean): void {
    const { u, v } = onMap(disc);
    const { width, height } = this.element;
    const largest = Math.max(...disc.radiance, 1e-9);
    const [r, g, b] = disc.radiance.map((each) => Math.round(255 * srgbEncode(each / largest)));
    const radius = Math.max(5, Math.min(40, (disc.diameter / 360) * width) / 2);
    for (const wrap of [-1, 0, 1]) {
      context.beginPath();
      context.arc((u + wrap) * width, v * height, radius, 0, 2 * Math.PI);
      context.fillStyle = `rgb(${r} ${g} ${b})`;
      context.fill();
      context.lineWidth = chosen ? 4 : 2;
      context.strokeStyle = chosen ? "#ffffff" : "#000000a0";
      context.stroke();
    }
  }
}

function onMap(disc: { azimuth: number; elevation: number }): { u: number; v: number } {
  const u = disc.azimuth / 360 + 0.5;
  return { u: u - Math.floor(u), v: 0.5 - disc.elevation / 180 };
}
