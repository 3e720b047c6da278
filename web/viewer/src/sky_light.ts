// The sky in a viewer: shown in place of the environment, its air before what is seen, and the
// exposure that follows it.
import { loadEnvironment } from "./environments";
import { airs } from "./skies";
import { skySource, type SkySettings } from "./sky_source";
import type { Viewer } from "./viewer";
import type { AirShown, Rotation } from "./view_state";
import { messageOf } from "./messages";

const kSkyMean = 0.45; // what the mean radiance of a sky is exposed to

export class SkyLight {
  /** Whether the exposure follows. */
  follows = true;
  /** Why the last sky that was wanted is not shown; null if it is. */
  problem: string | null = null;
  private wanted = 0;
  private lastAir: AirShown = { metresPerUnit: 1, shafts: false };
  private before: { source: string; rotation: Rotation; exposure: number } | null = null;

  constructor(private readonly viewer: Viewer) {}

  /** A sky that is still on its way would undo what is shown now. */
  giveUp(): void {
    ++this.wanted;
  }

  /**
   * Shows a sky in place of the environment: once its data is there, in the next frame. null: shows
   * again what was there before.
   */
  async show(settings: SkySettings | null): Promise<void> {
    const ticket = ++this.wanted;
    const { viewer, before } = this;
    const wanted = settings === null ? null : skySource(settings);
    try {
      const source = wanted ?? before?.source ?? viewer.library.firstSource();
      const stage = viewer.current;
      const loaded = await loadEnvironment(source, viewer.library, stage.floatTextures);
      if (ticket !== this.wanted || stage !== viewer.current) return loaded.dispose();
      const shown = viewer.view.environment;
      const enters = wanted !== null && !shown.source.startsWith("sky:");
      if (enters)
        this.before = structuredClone({ ...shown, exposure: viewer.view.exposure });
      stage.setEnvironment(loaded);
      this.problem = null;
      viewer.change((view) => {
        view.environment.source = source;
        if (enters) view.environment.rotation = [0, 0, 0, 1]; // north is north
        if (wanted === null && before !== null) {
          view.environment.rotation = before.rotation;
          view.exposure = before.exposure;
        }
        this.expose(view);
      });
    } catch (error) {
      if (ticket !== this.wanted) return;
      const text = messageOf(error);
      this.problem = text.replace(/^LambentSky: /, "");
      viewer.changed();
    }
  }
  /** An environment takes the place of a sky: its exposure comes back with it. */
  leave(view: { environment: { source: string }; exposure: number }): void {
    if (view.environment.source.startsWith("sky:") && this.before !== null)
      view.exposure = this.before.exposure;
  }
  /** A view was opened: whether its exposure is the one that follows. */
  opened(): void {
    this.problem = null;
    this.follows = [null, this.viewer.view.exposure].includes(this.exposure());
  }

  follow(on: boolean): void {
    this.follows = on;
    if (on) this.viewer.change((view) => this.expose(view));
    else this.viewer.touch();
  }
  expose(view: { exposure: number }): void {
    const exposure = this.exposure();
    if (this.follows && exposure !== null) view.exposure = exposure;
  }
  /** EV by which the mean radiance from everywhere becomes a middle tone; null: there is no sky. */
  private exposure(): number | null {
    const sky = this.viewer.current.environment?.sky;
    if (!sky) return null;
    const [r, g, b] = sky.light(1).radiance({ x: 0, y: 1, z: 0 });
    const mean = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    return Math.round(100 * Math.log2(kSkyMean / mean)) / 100;
  }

  /** Things are seen through the air of the sky, or not; with what has changed of how. */
  async showAir(on: boolean, part: Partial<AirShown> = {}): Promise<void> {
    const air = { ...this.lastAir, ...this.viewer.view.air, ...part };
    this.lastAir = air;
    this.viewer.change((view) => (view.air = on ? { ...air } : null));
    await this.fetchAir();
  }
  /** What the air of a view is made with: it is there once it is wanted. */
  async fetchAir(): Promise<void> {
    const { viewer } = this;
    if (viewer.view.air === null || viewer.current.air !== null) return;
    try {
      viewer.current.air = await airs();
      viewer.touch();
    } catch (error) {
      viewer.messages.error(messageOf(error));
    }
  }
  /** Says so where a view that was opened has air that cannot be shown. */
  noteAir(): void {
    const { viewer } = this;
    if (viewer.view.air === null) return;
    const not = "The air of this view is not shown:";
    if (!viewer.current.environment?.sky)
      viewer.messages.note(`${not} it is that of a sky, which its light is not.`);
    else if (viewer.camera().orthographicHalfHeight !== null)
      viewer.messages.note(`${not} an orthographic camera sees no distance.`);
  }
}
