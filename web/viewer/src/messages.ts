// What the page has to say: errors stay until they are closed, notes go by themselves.
import { button, h } from "./dom";

const kNoteSeconds = 5;
const kMost = 3;

export class Messages {
  readonly element = h("div", { class: "messages", role: "log", "aria-live": "polite" });

  error(text: string): void {
    this.add(text, "error");
  }
  note(text: string): void {
    const message = this.add(text, "note");
    setTimeout(() => message.remove(), 1000 * kNoteSeconds);
  }
  clearErrors(): void {
    for (const each of this.element.querySelectorAll(".error")) each.remove();
  }

  private add(text: string, kind: "error" | "note"): HTMLElement {
    const message = h("div", { class: `message ${kind}`, role: kind === "error" ? "alert" : "status" });
    message.append(
      h("p", {}, text),
      button("×", "Close this message", () => message.remove(), "close"),
    );
    message.querySelector("button")!.setAttribute("aria-label", "Close this message");
    this.element.append(message);
    while (this.element.children.length > kMost) this.element.firstElementChild!.remove();
    return message;
  }
}

/** What happens at the moment and how far it is; hidden when nothing does. */
export class LoadingBar {
  private readonly text = h("span", {});
  private readonly bar = h("progress", { max: 1, "aria-label": "Loading" });
  readonly element = h("div", { class: "loading", hidden: true }, this.text, this.bar);

  /** `share` 0 … 1, or null where nobody knows. */
  show(what: string, share: number | null): void {
    this.text.textContent = what;
    if (share === null) this.bar.removeAttribute("value");
    else this.bar.value = share;
    this.element.hidden = false;
  }
  hide(): void {
    this.element.hidden = true;
  }
}
