// Files that are let go over the page.

export function acceptDrops(openAll: (files: readonly File[]) => Promise<void>): void {
  const has = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  let depth = 0; // of elements that the drag has entered and not left
  const mark = () => document.body.classList.toggle("dropping", depth > 0);
  window.addEventListener("dragenter", (event) => {
    if (!has(event)) return;
    event.preventDefault();
    ++depth;
    mark();
  });
  window.addEventListener("dragleave", (event) => {
    if (!has(event)) return;
    depth = Math.max(0, depth - 1);
    mark();
  });
  window.addEventListener("dragover", (event) => {
    if (has(event)) event.preventDefault();
  });
  window.addEventListener("drop", (event) => {
    if (!has(event)) return;
    event.preventDefault();
    depth = 0;
    mark();
    void openAll([...(event.dataTransfer?.files ?? [])]);
  });
}
