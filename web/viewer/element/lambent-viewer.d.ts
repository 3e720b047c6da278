/** `<lambent-viewer>`: a baked asset under its light. README.md has its attributes and events. */
export declare class LambentViewerElement extends HTMLElement {
  /** The element that fills the screen; the viewer itself unless it is set. */
  fullScreenTarget: Element;
  /** What is shown, as JSON that `lambent render --view` takes; null while nothing is. */
  readonly view: unknown;
  /** Resolves once what the attributes say is shown, or was refused. */
  readonly updated: Promise<void>;
  /** Shows a saved view (parsed JSON). False, and an `error` event, where it cannot. */
  show(view: unknown): Promise<boolean>;
  /** Fills the screen, or no longer. */
  fullScreen(): void;
}

export interface LambentViewerEvents {
  /** An asset is on the screen. `baked`: false where it is shown under three.js's own light. */
  load: CustomEvent<{ src: string; baked: boolean }>;
  error: CustomEvent<{ message: string }>;
  /** `share`: 0 … 1, or null where nobody knows. */
  progress: CustomEvent<{ share: number | null }>;
}

declare global {
  interface HTMLElementTagNameMap {
    "lambent-viewer": LambentViewerElement;
  }
}
