// What there is to say: errors stay until they are closed, notes go by themselves.
import { button, h } from "./dom";

const kNoteSeconds = 5;
const kMost = 3;

export const messageOf = (error: unknown): string =>
  error instanceof Error ? error.message : String(error);

export class Messages {
  readonly element = h("div", { class: "messages" });
  /** Told of every error. */
  failed: (text: string) => void = () => {};

  error(text: string): void {
    this.add(text, "error");
    this.failed(text);
  }
  note(text: string): void {
    const message = this.add(text, "note");
    setTimeout(() => message.remove(), 1000 * kNoteSeconds);
  }
  /**
   * A note that stays until it is closed; `offer`: something to do about it. Returns how to close it.
   */
  stay(text: string, offer?: { label: string; title: string; press(): void }): () => void {
    const message = this.add(text, "note");
    const close = () => message.remove();
    if (offer === undefined) return close;
    const press = () => {
      message.remove();
      offer.press();
    };
    message.querySelector(".close")!.before(button(offer.label, offer.title, press));
    return close;
  }
  /** Closes the newest; false: there is none. */
  closeOne(): boolean {
    const newest = this.element.lastElementChild;
    newest?.remove();
    return newest !== null;
  }
  /** Those that are still there. */
  errors(): string[] {
    return [...this.element.querySelectorAll(".error p")].map((each) => each.textContent ?? "");
  }
  clearErrors(): void {
    for (const each of this.element.querySelectorAll(".error")) each.remove();
  }

  private add(text: string, kind: "error" | "note"): HTMLElement {
    const role = kind === "error" ? "alert" : "status";
    const message = h("div", { class: `message ${kind}`, role });
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

  /** Told of every step. */
  stepped: (share: number | null) => void = () => {};

  /** `share` 0 … 1, or null where nobody knows. */
  show(what: string, share: number | null): void {
    this.stepped(share);
    this.text.textContent = what;
    if (share === null) this.bar.removeAttribute("value");
    else this.bar.value = share;
    this.element.hidden = false;
  }
  hide(): void {
    this.element.hidden = true;
  }
}
