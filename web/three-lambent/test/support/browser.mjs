// A page in headless Chromium, with files served on loopback.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { chromium } from "playwright-core";

const kTypes = {
  js: "text/javascript",
  html: "text/html",
  png: "image/png",
  json: "application/json",
};

function chromiumPath() {
  try {
    return execFileSync("which", ["chromium"], { encoding: "utf8" }).trim();
  } catch {
    throw new Error("chromium is not installed: apt-get install chromium");
  }
}

/**
 * `source` (an ES module in the package's folder, or its text) as one script for the browser.
 *
 * @param three the name of the installed package that is to be three
 */
export async function bundle(source, three = "three") {
  const result = await build({
    stdin: {
      contents: source,
      resolveDir: fileURLToPath(new URL("..", import.meta.url)),
      loader: "js",
    },
    bundle: true,
    format: "esm",
    write: false,
    logLevel: "silent",
    absWorkingDir: fileURLToPath(new URL("../..", import.meta.url)),
    jsx: "automatic",
    define: { "process.env.NODE_ENV": '"development"' }, // React's strict mode
    alias: {
      "three-lambent/react": fileURLToPath(new URL("../../dist/react/index.js", import.meta.url)),
      "three-lambent/webgpu": fileURLToPath(new URL("../../dist/webgpu/index.js", import.meta.url)),
      "three-lambent": fileURLToPath(new URL("../../dist/index.js", import.meta.url)),
      ...(three !== "three" && { three }),
    },
  });
  return result.outputFiles[0].text;
}

/**
 * Serves `files` (name → bytes or text; what is missing is read from `folder`) and opens "/", a page
 * that runs `script`.
 *
 * @param flags of Chromium, besides those that all pages have
 */
export async function openPage({ script, folder = "", files = {}, flags = [] }) {
  const html =
    '<!doctype html><html><body style="margin:0"><script type="module" src="/page.js"></script>';
  const all = { "page.js": script, "": html, "favicon.ico": "", ...files };
  const server = createServer((request, response) => {
    const name = decodeURIComponent(new URL(request.url, "http://host").pathname.slice(1));
    try {
      const body = Object.hasOwn(all, name) ? all[name] : readFileSync(`${folder}/${name}`);
      const type = name === "" ? "text/html" : kTypes[name.split(".").pop()];
      response.writeHead(200, { "content-type": type ?? "application/octet-stream" });
      response.end(body);
    } catch {
      response.writeHead(404);
      response.end();
    }
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const browser = await chromium.launch({
    executablePath: chromiumPath(),
    args: [
      "--headless",
      "--no-sandbox",
      "--use-angle=gl-egl",
      "--ignore-gpu-blocklist",
      "--disable-quic",
      "--no-first-run",
      "--disable-background-networking",
      "--disable-component-update",
      "--disable-sync",
      ...flags,
    ],
  });
  const page = await browser.newPage({ viewport: { width: 512, height: 512 } });
  const problems = [];
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("console", (message) => {
    // Drivers that translate say so of themselves; that is not the page's fault.
    const text = message.text();
    if (
      ["error", "warning"].includes(message.type()) &&
      !/GPU stall|GL Driver Message|favicon/.test(text)
    )
      problems.push(text);
  });
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  return {
    page,
    /** What the page complained of since it was last asked. */
    problems: () => problems.splice(0),
    close: async () => {
      await browser.close();
      await new Promise((done) => server.close(done));
    },
  };
}
