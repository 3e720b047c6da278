// Elements and controls. Controls are native inputs, so that keyboards, screen readers and touch
// work as the browser has them; each returns how to set it from outside.

type Child = Node | string;
type Properties = Record<string, string | number | boolean | ((event: never) => void)>;

/** An element with attributes, listeners (functions, by the event's name) and children. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (typeof value === "function") element.addEventListener(key, value as EventListener);
    else if (value === true) element.setAttribute(key, "");
    else if (value !== false) element.setAttribute(key, String(value));
  }
  element.append(...children);
  return element;
}

export interface Control<T> {
  element: HTMLElement;
  set(value: T): void;
}

let ids = 0;
const freshId = (): string => `control-${++ids}`;

export interface SliderOptions {
  label: string;
  /** What it is called in papers, and what it does. */
  title?: string;
  min: number;
  max: number;
  step: number;
  /** The value as it is shown, with its unit. */
  format(value: number): string;
  change(value: number): void;
}

export function slider(options: SliderOptions): Control<number> {
  const id = freshId();
  const output = h("output", { for: id });
  const input = h("input", {
    id,
    type: "range",
    min: options.min,
    max: options.max,
    step: options.step,
  });
  const show = (value: number) => {
    output.value = options.format(value);
    input.setAttribute("aria-valuetext", options.format(value));
    const share = (Number(input.value) - options.min) / (options.max - options.min);
    input.style.setProperty("--share", `${100 * Math.min(1, Math.max(0, share))}%`);
  };
  input.addEventListener("input", () => {
    show(Number(input.value));
    options.change(Number(input.value));
  });
  return {
    element: h("div", { class: "slider", title: options.title ?? "" },
      h("label", { for: id }, options.label), output, input),
    set(value) {
      if (document.activeElement !== input || Number(input.value) !== value)
        input.value = String(value);
      show(value);
    },
  };
}

export interface Choice<T extends string> {
  value: T;
  label: string;
  title?: string;
}

export interface Segments<T extends string> extends Control<T> {
  /** A reason disables the choice and says why; null enables it. */
  forbid(value: T, reason: string | null): void;
}

/** One of a few, side by side. */
export function segments<T extends string>(
  label: string,
  choices: readonly Choice<T>[],
  change: (value: T) => void,
  title = "",
): Segments<T> {
  const name = freshId();
  const inputs = new Map<T, { input: HTMLInputElement; label: HTMLLabelElement }>();
  const row = h("div", { class: "segments" });
  for (const choice of choices) {
    const id = freshId();
    const input = h("input", { type: "radio", name, id, value: choice.value });
    const text = h("label", { for: id, title: choice.title ?? "" }, choice.label);
    input.addEventListener("change", () => change(choice.value));
    inputs.set(choice.value, { input, label: text });
    row.append(input, text);
  }
  return {
    element: h("fieldset", { class: "choice" }, h("legend", { title }, label), row),
    set(value) {
      const found = inputs.get(value);
      if (found) found.input.checked = true;
    },
    forbid(value, reason) {
      const found = inputs.get(value);
      if (!found) return;
      found.input.disabled = reason !== null;
      const choice = choices.find((each) => each.value === value)!;
      found.label.title = reason ?? choice.title ?? "";
    },
  };
}

export interface Toggle extends Control<boolean> {
  /** A reason disables it and says why; null enables it. */
  forbid(reason: string | null): void;
}

export function toggle(label: string, title: string, change: (on: boolean) => void): Toggle {
  const id = freshId();
  const input = h("input", { type: "checkbox", role: "switch", id });
  input.addEventListener("change", () => change(input.checked));
  const element = h("div", { class: "toggle", title }, h("label", { for: id }, label), input);
  return {
    element,
    set(value) {
      input.checked = value;
    },
    forbid(reason) {
      input.disabled = reason !== null;
      element.title = reason ?? title;
      element.classList.toggle("off", reason !== null);
    },
  };
}

export function button(
  label: string,
  title: string,
  press: () => void,
  className = "",
): HTMLButtonElement {
  return h("button", { type: "button", title, class: className, click: press }, label);
}

/** A list to choose from; its entries can change. */
export function select(
  label: string,
  change: (index: number) => void,
): { element: HTMLElement; fill(names: readonly string[], chosen: number): void } {
  const id = freshId();
  const box = h("select", { id });
  box.addEventListener("change", () => change(box.selectedIndex));
  return {
    element: h("div", { class: "select" }, h("label", { for: id }, label), box),
    fill(names, chosen) {
      box.replaceChildren(...names.map((name) => h("option", {}, name)));
      box.selectedIndex = chosen;
    },
  };
}
