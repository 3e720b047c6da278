import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";

export default defineConfig({
  base: "./", // so that the page can lie anywhere on a server
  resolve: {
    alias: {
      "three-lambent": fileURLToPath(new URL("../three-lambent/src/index.ts", import.meta.url)),
    },
    dedupe: ["three"],
  },
  build: {
    target: "es2022",
    assetsInlineLimit: 0, // data: URLs of styles and scripts are what the content policy forbids
    assetsDir: "code", // assets/ holds what is looked at
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1000,
  },
});
