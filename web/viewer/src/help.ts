// What keys and gestures do.
import { button, h } from "./dom";

const kGestures: [string, string][] = [
  ["Drag, one finger", "orbit; or turn the object or the light, as chosen below the picture"],
  ["Ctrl + drag", "turn the object"],
  ["Shift + drag", "turn the light"],
  ["Right button or Alt + drag, two fingers", "pan"],
  ["Wheel, pinch", "zoom"],
  ["Double click, double tap", "frame the object"],
  ["Drop or open a file", ".glb, .hdr, .exr, .png, a saved view, a light as JSON"],
];
const kKeys: [string, string][] = [
  ["Arrows", "orbit; with Ctrl turn the object, with Shift the light, with Alt pan"],
  ["+ −", "zoom"],
  ["F", "frame the object"],
  ["R", "turn everything back"],
  ["Ctrl + Z", "undo; with Shift redo"],
  ["A, Space", "let the light go round, or stop it"],
  ["0 1 2 3", "what light does: best, bare, shadows, bounces"],
  ["M", "shadows on the relief"],
  ["V", "relief changes with the view"],
  ["L", "how the patch lies: field, singularities, seams, cuts"],
  ["U", "base colour alone, without light"],
  ["E, Shift + E", "next environment, previous one"],
  ["N", "next asset"],
  ["D, Delete", "add a disc of light, remove the chosen one"],
  ["W", "next smoothing of the light"],
  ["[ ]", "darker, brighter by a third of a stop"],
  ["T", "tone curve"],
  ["B", "background"],
  ["S, Ctrl + S", "save the picture, the view"],
  ["O", "open files"],
  ["H", "hide the controls, or show them"],
  ["Shift + F", "fill the screen, or no longer"],
  ["Escape", "close a message, this help, the full screen"],
  ["?", "this help"],
];

export class Help {
  readonly element = h("dialog", { class: "help", "aria-label": "Help" });

  constructor() {
    const table = (rows: [string, string][]) =>
      h("dl", {}, ...rows.flatMap(([key, what]) => [h("dt", {}, key), h("dd", {}, what)]));
    this.element.append(
      h("header", {}, h("h2", {}, "Help"), button("Close", "Close the help", () => this.close())),
      h("div", { class: "columns" },
        h("section", {}, h("h3", {}, "On the picture"), table(kGestures)),
        h("section", {}, h("h3", {}, "Keys"), table(kKeys))),
      h("p", {},
        "Files stay in this browser: the page sends nothing anywhere. Assets are baked by " +
          "lambent bake or lambent synthesize; saved views also go to lambent render --view."),
    );
    this.element.addEventListener("click", (event) => {
      if (event.target === this.element) this.close(); // outside of it
    });
  }
  toggle(): void {
    if (this.element.open) this.close();
    else this.element.showModal();
  }
  private close(): void {
    this.element.close();
  }
}
