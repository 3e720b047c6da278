// When frames are drawn: one after every change, samples of a still picture while nothing changes,
// none once all of them are there.

const kStillAfter = 120; // milliseconds without a change until a picture is refined

export interface Picture {
  /** Whether there is something to draw and something to draw with. */
  ready(): boolean;
  /** Moves on what goes by itself; true if anything did. */
  advance(seconds: number): boolean;
  /** One frame of something that moves. */
  drawMoving(): void;
  /** One more sample of a still picture; true once it has all of them. */
  refine(): boolean;
  /**
   * After each. `now` as requestAnimationFrame gives it; `work`: milliseconds that it took of the
   * page, null where a picture was refined.
   */
  drawn(now: number, work: number | null): void;
}

export class Frames {
  private scheduled = false;
  private moved = true;
  private done = false;
  private lastChange = 0;
  private lastFrame = 0;
  private stopped = false;
  private waiting: (() => void)[] = [];
  private drawing: (() => void)[] = [];

  constructor(private readonly picture: Picture) {}

  /** Something changed. */
  touch(): void {
    this.moved = true;
    this.done = false;
    this.lastChange = performance.now();
    this.schedule();
  }
  /** What goes by itself begins now, from where it is. */
  begin(): void {
    this.lastFrame = performance.now();
    this.touch();
  }
  schedule(): void {
    if (this.scheduled || this.stopped) return;
    this.scheduled = true;
    requestAnimationFrame((now) => {
      this.scheduled = false;
      this.render(now);
    });
  }
  render(now: number): void {
    if (this.stopped || !this.picture.ready()) return;
    const seconds = Math.max(0, Math.min(0.1, (now - this.lastFrame) / 1000));
    if (this.picture.advance(seconds)) this.lastFrame = now;
    const began = performance.now();
    let work: number | null = null;
    if (this.moved) {
      this.moved = false;
      this.picture.drawMoving();
      work = performance.now() - began;
    } else if (!this.done && began - this.lastChange >= kStillAfter) {
      this.done = this.picture.refine();
    }
    this.picture.drawn(now, work);
    for (const resolve of this.drawing.splice(0)) requestAnimationFrame(() => resolve());
    if (!this.done || this.moved) return this.schedule();
    for (const resolve of this.waiting.splice(0)) resolve();
  }
  /** Resolves once the next frame is on the screen. */
  drawn(): Promise<void> {
    return new Promise((resolve) => {
      this.drawing.push(resolve);
      this.schedule();
    });
  }
  /** Resolves once all samples of a still picture are shown. */
  settled(): Promise<void> {
    if (this.done && !this.moved) return Promise.resolve();
    return new Promise((resolve) => {
      this.waiting.push(resolve);
      this.schedule();
    });
  }
  /** No frame is drawn any more; whoever waits for one is let go. */
  stop(): void {
    this.stopped = true;
    for (const resolve of [...this.drawing.splice(0), ...this.waiting.splice(0)]) resolve();
  }
}
