import { fileURLToPath } from "node:url";
import { defineConfig, type Plugin } from "vite";

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

/** From a folder, styles are what a browser loads of the page: with `crossorigin` it does not. */
const plainStyles: Plugin = {
  name: "plain-styles",
  transformIndexHtml: {
    order: "post",
    handler: (html) => html.replace(/(<link rel="stylesheet") crossorigin/, "$1"),
  },
};

/** What three-lambent fetches with the first file that asks for it is in <lambent-viewer> already. */
const oneFile: Plugin = {
  name: "one-file",
  transform(code, id) {
    if (!id.includes("/three-lambent/src/")) return;
    let head = "";
    const whole = code.replace(/\bimport\("(\.[^"]+)"\)/g, (_, from: string) => {
      const name = `part${head.split(";").length}`;
      head += `import * as ${name} from "${from}";`;
      return `Promise.resolve(${name})`;
    });
    if (head) return { code: head + whole, map: null };
  },
};

export default defineConfig({
  base: "./", // so that the page can lie anywhere on a server
  plugins: [plainStyles, oneFile],
  resolve: {
    alias: { "three-lambent": here("../three-lambent/src/index.ts") },
    dedupe: ["three"],
  },
  build: {
    target: "es2022",
    minify: "terser", // 2 % less than esbuild's, of what every page with <lambent-viewer> fetches
    terserOptions: { module: true, compress: { passes: 2 } },
    assetsInlineLimit: 0, // data: URLs of styles and scripts are what the content policy forbids
    assetsDir: "code", // assets/ holds what is looked at
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1000,
    rollupOptions: {
      // <lambent-viewer> is one file with all that it takes, which the page uses as anybody can.
      input: {
        index: here("index.html"),
        "lambent-viewer": here("src/element/lambent_viewer.ts"),
      },
      preserveEntrySignatures: "allow-extension",
      output: {
        entryFileNames: ({ name }) =>
          name === "lambent-viewer" ? "[name].js" : "code/[name]-[hash].js",
        // Skies, and the air under them, beside the element that looks for them there.
        assetFileNames: ({ names }) =>
          names[0]?.endsWith(".bin") ? "[name][extname]" : "code/[name]-[hash][extname]",
      },
    },
  },
});
