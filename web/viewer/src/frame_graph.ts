// The time between frames while something moves, and what of it the page's own work took.
import { h } from "./dom";

const kFrames = 120;
const kTop = 50; // milliseconds at the upper edge
const kPause = 250; // a longer gap is not a slow frame: nothing moved

export class FrameGraph {
  private readonly canvas = h("canvas", {
    class: "graph", width: 480, height: 96, role: "img", "aria-label": "Frame times: nothing moves",
  });
  private readonly text = h("p", { class: "figures" }, "Nothing moves");
  readonly element = h("div", { class: "frames" }, this.canvas, this.text);
  private frames: { interval: number; work: number }[] = [];
  private last = -Infinity;
  private due = 0;

  /** Call after every frame. `now` as requestAnimationFrame gives it, `work` in milliseconds. */
  add(now: number, work: number): void {
    const interval = now - this.last;
    this.last = now;
    if (interval > kPause) return;
    this.frames.push({ interval, work });
    if (this.frames.length > kFrames) this.frames.shift();
    if (now < this.due || this.canvas.offsetParent === null) return;
    this.due = now + 100;
    this.draw();
  }
  /** The mean of the frames that are shown, milliseconds. */
  mean(): { interval: number; work: number } {
    const n = Math.max(1, this.frames.length);
    return {
      interval: this.frames.reduce((sum, each) => sum + each.interval, 0) / n,
      work: this.frames.reduce((sum, each) => sum + each.work, 0) / n,
    };
  }

  private draw(): void {
    const context = this.canvas.getContext("2d");
    if (context === null) return;
    const { width, height } = this.canvas;
    context.clearRect(0, 0, width, height);
    const y = (milliseconds: number) => height * (1 - Math.min(milliseconds, kTop) / kTop);
    context.fillStyle = "#3a4048";
    for (const line of [16.7, 33.3]) context.fillRect(0, y(line), width, 1);
    const step = width / kFrames;
    this.frames.forEach(({ interval, work }, i) => {
      const x = (kFrames - this.frames.length + i) * step;
      context.fillStyle = "#6f7f8f";
      context.fillRect(x, y(interval), step - 1, height - y(interval));
      context.fillStyle = "#e3b778";
      context.fillRect(x, y(work), step - 1, height - y(work));
    });
    const { interval, work } = this.mean();
    const text =
      `${interval.toFixed(1)} ms a frame (${(1000 / interval).toFixed(0)} a second), ` +
      `${work.toFixed(1)} ms of it on the CPU`;
    this.text.textContent = text;
    this.canvas.setAttribute("aria-label", `Frame times: ${text}`);
  }
}
