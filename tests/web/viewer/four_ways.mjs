// One picture four ways: by the CPU, by native OpenGL, by the page in a browser, and path-traced,
// for every kind of asset, as it stands and with object, environment and disc of light turned.
// The first three agree to 1/255 in the mean, over the asset's own pixels and over all; but where mirrors
// see mirrors, which on the GPU know one side of everything.
//
// usage: node four_ways.mjs FOLDER [KIND…]   (pictures stay in FOLDER)
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import {
  ballScene,
  dyedScene,
  environmentExr,
  glossyScene,
  leafScene,
  mattScene,
  mirrorScene,
  mirrorsScene,
  sheetScene,
  texelScene,
} from "../../../web/three-lambent/test/support/scenes.mjs";
import { png } from "../../../web/three-lambent/test/support/glb.mjs";
import { decodePng, meanDifference } from "./png.mjs";
import { kSize, launch, openPage, serve, tool } from "./session.mjs";

const kBound = 1; // 1/255
const kMirrorsBound = 6;
/** What the baked picture may differ from the path-traced one: the light is cut to five bands, the
 * bake has few directions, and meso-structure is not traced at all. For the record. */
const kReferenceBound = 25;
/** A picture that is turned or mirrored differs by at least so much: else agreement says nothing. */
const kSensitivity = 3;

const [folder, ...chosen] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const lambent = (...args) => {
  try {
    return execFileSync(tool, args.map(String), {
      cwd: folder,
      encoding: "utf8",
      stdio: ["ignore", "pipe", "pipe"],
    });
  } catch (error) {
    throw new Error(`lambent ${args.join(" ")}\n${error.stdout ?? error}${error.stderr ?? ""}`);
  }
};
const put = (name, content) => writeFileSync(join(folder, name), content);

const scenes = {
  matt: mattScene,
  glossy: glossyScene,
  mirror: mirrorScene,
  mirrors: mirrorsScene,
  texel: texelScene,
  sheet: sheetScene,
  leaf: leafScene,
  ball: ballScene,
  dyed: dyedScene,
};
for (const [name, bytes] of Object.entries(scenes)) put(`${name}-scene.glb`, bytes);
put("light.exr", environmentExr);
put("mask.png", png(16, 8, (x, y) => [x % 8 < 4 ? 255 : 0, y < 3 ? 255 : 0, 0]));
const quick = ["--directions", 512, "--bounces", 1, "--quiet"];
const patch = ["--positions", "24x20", "--views", 4, "--directions", 128, "--bounces", 1];
const spread = ["--directions", 256, "--map-size", 256, "--vertices", 8000, "--mesh", "ball"];
const bake = (scene, output, ...more) =>
  lambent("bake", `${scene}-scene.glb`, "-o", output, ...quick, ...more);
const synthesize = (scene, output, ...more) => {
  lambent("rtt", "weave", "-o", "patch.rtt", ...patch, "--quiet");
  lambent("synthesize", `${scene}-scene.glb`, "--rtt", "patch.rtt", "-o", output, ...spread, "--quiet",
    ...more);
};

/** Three patches over one mesh. */
const layer = (scene, output, ...more) => {
  lambent("rtt", "pebbles", "-o", "second.rtt", ...patch, "--quiet");
  lambent("rtt", "bricks", "-o", "third.rtt", ...patch, "--quiet");
  synthesize(scene, output, "--rtt", "second.rtt", "--rtt", "third.rtt", "--mask", "mask.png", ...more);
};

/** Each makes its asset; `reference` is what the path tracer takes, with more of its options. */
const kinds = {
  "diffuse-1-channel": { make: (to) => bake("ball", to, "--albedo", "0.6,0.6,0.6") },
  "diffuse-3-channels-textured": { make: (to) => bake("matt", to) },
  "diffuse-sharp-sun": { make: (to) => bake("matt", to, "--keep-shadowed"), sun: true },
  glossy: { make: (to) => bake("glossy", to) },
  texels: { make: (to) => bake("texel", to, "--texels", "sheet=48x40") },
  "texels-laid-out": { make: (to) => bake("texel", to, "--texels", "auto", "--texel-budget", 4096) },
  "two-sided-sheet": { make: (to) => bake("sheet", to) },
  "cut-out-leaf": { make: (to) => bake("leaf", to) },
  "mirror-caustic": { make: (to) => bake("mirror", to) },
  "mirrors-between-colours": { make: (to) => bake("mirrors", to), bound: kMirrorsBound },
  "bi-scale-id-map": { make: (to) => synthesize("ball", to, "--patch-width", 0.5), relief: true },
  "bi-scale-tinted": {
    make: (to) => synthesize("dyed", to, "--patch-width", 0.5, "--tint", "own"),
    relief: true,
  },
  "bi-scale-layered": {
    make: (to) => layer("dyed", to, "--patch-width", 0.5, "--tint", "own"),
    relief: true,
  },
  "bi-scale-tiles": {
    make: (to) => synthesize("ball", to, "--map", "uv", "--tiles", "9x6"),
    relief: true,
  },
};

const q = (x, y, z, degrees) => {
  const length = Math.hypot(x, y, z);
  const half = (degrees * Math.PI) / 360;
  return [x, y, z].map((each) => (each / length) * Math.sin(half)).concat(Math.cos(half));
};
const views = {
  "as it stands": { lambent: "view", version: 1, environment: { source: "light.exr" } },
  "everything turned": {
    lambent: "view",
    version: 1,
    camera: { position: [2.6, 2.3, 3.1], target: [0.2, 0.4, 0.1], verticalFov: 42 },
    object: { rotation: q(0.3, 1, -0.2, 40), translation: [0.2, -0.1, 0.1] },
    environment: { source: "light.exr", rotation: q(0.2, 1, 0.4, 100) },
    discs: [{ azimuth: 20, elevation: 40, diameter: 30, radiance: [3, 2.2, 1.2] }],
    window: "hann:7",
    exposure: -0.3,
    samples: 9,
  },
};

/** Of an asset whose Sun throws sharp shadows. */
const viewsOfSun = {
  "under a sky and its Sun": {
    lambent: "view",
    version: 1,
    object: { rotation: q(0, 1, 0, 30), translation: [0, 0, 0] },
    environment: { source: "sky:sun-elevation=35,sun-azimuth=140" },
    exposure: -5,
    samples: 9,
  },
};

/** Pixels that the asset covers: where pictures with and without it differ in their alpha. */
function ownPixels(state, asset) {
  put("own.json", JSON.stringify({ ...state, background: false, tone: "linear", exposure: 20 }));
  lambent("render", asset, "--view", "own.json", "--size", `${kSize}x${kSize}`, "--backend", "cpu",
    "-o", "own.png", "--quiet");
  const { width, height, rgb } = decodePng(readFileSync(join(folder, "own.png")));
  return Uint8Array.from({ length: width * height }, (_, i) =>
    rgb[3 * i] + rgb[3 * i + 1] + rgb[3 * i + 2] > 0 ? 1 : 0);
}

const display = process.env.DISPLAY !== undefined && process.env.LAMBENT_FOUR_WAYS_WINDOW !== "0";
const browser = await launch();
let failures = 0;
const fail = (what) => {
  ++failures;
  console.log(`  FAILED: ${what}`);
};
for (const [kind, { make, relief, sun, bound = kBound }] of Object.entries(kinds)) {
  if (chosen.length > 0 && !chosen.includes(kind)) continue;
  const asset = `${kind}.glb`;
  make(asset);
  const server = await serve(folder, [asset, "light.exr"]);
  const { page, context, complaints } = await openPage(browser, server.url, {
    viewport: { width: kSize, height: kSize },
  });
  await page.keyboard.press("h"); // the picture alone, as large as the window
  for (const [i, [name, state]] of Object.entries({ ...views, ...(sun && viewsOfSun) }).entries()) {
    const stem = `${kind}-${i}`;
    put(`${stem}.json`, JSON.stringify(state));
    const picture = (way) => decodePng(readFileSync(join(folder, `${stem}-${way}.png`)));
    const common = ["--view", `${stem}.json`, "--size", `${kSize}x${kSize}`, "--quiet"];
    for (const backend of ["cpu", "gl"])
      lambent("render", asset, ...common, "--backend", backend, "-o", `${stem}-${backend}.png`);
    lambent("reference", asset, ...common, "--spp", 12, "-o", `${stem}-traced.png`);
    if (!(await page.evaluate((json) => window.lambent.showView(json), state)))
      fail("the page did not take the view");
    await page.screenshot({ path: join(folder, `${stem}-web.png`) });
    const ways = ["gl", "web"];
    if (display) {
      lambent("view", asset, ...common, "--screenshot", `${stem}-window.png`);
      ways.push("window");
    }

    const truth = picture("cpu");
    const own = ownPixels(state, asset);
    const covered = own.reduce((sum, each) => sum + each, 0) / own.length;
    console.log(`${kind}, ${name}: covers ${(100 * covered).toFixed(0)}%`);
    if (covered < 0.1 || covered > 0.95) fail("the asset does not stand in the picture");
    const pairs = [...ways.map((way) => ["cpu", way])];
    if (ways.length > 1) pairs.push(["gl", "web"]);
    for (const [a, b] of pairs) {
      const [over, all] = [own, null].map((mask) =>
        meanDifference(picture(a), picture(b), mask));
      console.log(`  ${a} and ${b}: ${over.toFixed(3)}/255 of its own pixels, ${all.toFixed(3)}/255 of all`);
      if (!(over <= bound && all <= bound)) fail(`more than ${bound}/255 between ${a} and ${b}`);
    }
    const traced = meanDifference(truth, picture("traced"), own);
    console.log(`  cpu and path-traced: ${traced.toFixed(2)}/255 of its own pixels` +
      (relief ? " (without the relief)" : ""));
    if (!relief && !(traced <= kReferenceBound)) fail(`more than ${kReferenceBound}/255`);

    const last = kSize - 1;
    for (const [turn, place] of [
      ["mirrored", (x, y) => [last - x, y]],
      ["upside down", (x, y) => [x, last - y]],
      ["turned", (x, y) => [last - x, last - y]],
    ]) {
      const difference = meanDifference(truth, picture("web"), null, place);
      if (!(difference >= kSensitivity))
        fail(`a picture ${turn} would differ by ${difference.toFixed(2)}/255 alone`);
    }
  }
  for (const complaint of complaints) fail(`the page complained: ${complaint}`);
  await context.close();
  if ((await server.stop()) !== 0) fail("the server did not end with 0 at Ctrl-C");
}
await browser.close();
console.log(failures === 0 ? "one picture, whichever way" : `${failures} failures`);
process.exit(failures === 0 ? 0 : 1);
