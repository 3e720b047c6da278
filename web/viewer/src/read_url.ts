// Bytes from the server the page came from, with progress.
import type { ReadFile } from "./environments";
import type { LoadingBar } from "./messages";

export function progressiveRead(url: string, bar: LoadingBar): ReadFile {
  const name = url.split("/").pop()!;
  return async () => {
    let response: Response;
    try {
      response = await fetch(url);
    } catch {
      throw new Error(`${name}: the server does not answer. Is it still running?`);
    }
    if (!response.ok || response.body === null)
      throw new Error(`${name}: the server answers ${response.status}`);
    const total = Number(response.headers.get("Content-Length") ?? 0);
    if (!(total > 0)) return response.arrayBuffer();
    const bytes = new Uint8Array(total);
    const reader = response.body.getReader();
    for (let at = 0; ; ) {
      const { done, value } = await reader.read();
      if (done) {
        if (at !== total) throw new Error(`${name}: the server broke off`);
        return bytes.buffer;
      }
      // A server that compresses counts what it sent, not what arrives.
      if (at + value.length > total) {
        const parts: Uint8Array[] = [bytes.slice(0, at), value];
        for (let more = await reader.read(); !more.done; more = await reader.read())
          parts.push(more.value);
        return new Blob(parts as BlobPart[]).arrayBuffer();
      }
      bytes.set(value, at);
      at += value.length;
      bar.show(`Loading ${name}`, at / total);
    }
  };
}
