// Bytes from an address, with progress.
import type { ReadFile } from "./environments";
import { nameOfAddress } from "./library";
import type { LoadingBar } from "./messages";

/** What a browser does not say of an answer that it did not get. */
function whyNot(address: string): string {
  const { origin, host } = new URL(address, document.baseURI);
  return origin === location.origin
    ? "the server does not answer. Is it still running?"
    : `${host} does not answer, or may not be read from here (CORS, or this page's content ` +
        "policy). Download the file, and open it";
}

export function progressiveRead(url: string, bar: LoadingBar): ReadFile {
  const name = nameOfAddress(url);
  return async () => {
    let response: Response;
    try {
      response = await fetch(url);
    } catch {
      throw new Error(`${name}: ${whyNot(url)}`);
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
