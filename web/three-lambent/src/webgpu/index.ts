/**
 * Relit assets by three's WebGPURenderer, on both of its back ends, WebGPU and WebGL 2: hand `nodes` to
 * the plugin, `loader.register((parser) => new LambentLoaderPlugin(parser, { nodes }))`.
 *
 * @packageDocumentation
 */
export { kOldestThree, nodes } from "./nodes.js";
