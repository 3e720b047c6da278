// What the browser tests bake and light: small scenes with every kind of surface, and an environment
// with a direction of its own, in which a mirrored or turned picture would show.
import { exr, png, sceneGlb } from "./glb.mjs";

function ball({ name, center, radius, rings = 24, sectors = 36, material, colors }) {
  const mesh = { name, positions: [], normals: [], uvs: [], indices: [], material };
  if (colors) mesh.colors = [];
  for (let r = 0; r <= rings; ++r)
    for (let s = 0; s <= sectors; ++s) {
      const theta = (Math.PI * r) / rings;
      const phi = (2 * Math.PI * s) / sectors;
      const n = [
        Math.sin(theta) * Math.cos(phi),
        Math.cos(theta),
        -Math.sin(theta) * Math.sin(phi),
      ];
      mesh.normals.push(...n);
      mesh.positions.push(...n.map((v, c) => center[c] + radius * v));
      mesh.uvs.push(s / sectors, r / rings);
      if (colors) mesh.colors.push(...colors(n));
    }
  const at = (r, s) => r * (sectors + 1) + s;
  for (let r = 0; r < rings; ++r)
    for (let s = 0; s < sectors; ++s) {
      if (r > 0) mesh.indices.push(at(r, s), at(r + 1, s), at(r, s + 1));
      if (r < rings - 1) mesh.indices.push(at(r, s + 1), at(r + 1, s), at(r + 1, s + 1));
    }
  return mesh;
}

function floor({ name = "floor", half, y = 0, cells = 16, material, repeat = 1 }) {
  const mesh = { name, positions: [], normals: [], uvs: [], indices: [], material };
  for (let j = 0; j <= cells; ++j)
    for (let i = 0; i <= cells; ++i) {
      mesh.positions.push(half * ((2 * i) / cells - 1), y, half * ((2 * j) / cells - 1));
      mesh.normals.push(0, 1, 0);
      mesh.uvs.push((repeat * i) / cells, (repeat * j) / cells);
    }
  const at = (j, i) => j * (cells + 1) + i;
  for (let j = 0; j < cells; ++j)
    for (let i = 0; i < cells; ++i)
      mesh.indices.push(
        at(j, i),
        at(j + 1, i),
        at(j, i + 1),
        at(j, i + 1),
        at(j + 1, i),
        at(j + 1, i + 1),
      );
  return mesh;
}

const matt = (color, texture) => ({
  pbrMetallicRoughness: {
    baseColorFactor: [...color, 1],
    metallicFactor: 0,
    roughnessFactor: 1,
    ...(texture !== undefined && { baseColorTexture: { index: texture } }),
  },
});
const shiny = (color, metallic, roughness) => ({
  pbrMetallicRoughness: {
    baseColorFactor: [...color, 1],
    metallicFactor: metallic,
    roughnessFactor: roughness,
  },
});

const checker = png(16, 8, (x, y) =>
  ((x >> 1) + (y >> 1)) & 1 ? [240, 200, 90] : [30, 90 + 8 * x, 160],
);

const holes = png(32, 32, (x, y) => {
  const hole = (x % 16) - 8;
  const away = Math.hypot(hole + 0.5, (y % 16) - 7.5);
  return [255, 200 + x, 100 + 4 * y, Math.min(255, 40 * away)];
});

/** A coloured ball on a floor whose texture repeats and mirrors. */
export const mattScene = sceneGlb(
  [
    ball({
      name: "ball",
      center: [0, 0.7, 0],
      radius: 0.7,
      material: 0,
      colors: (n) => n.map((v) => 0.5 + 0.45 * v),
    }),
    floor({ half: 1.5, material: 1, repeat: 3 }),
  ],
  [matt([0.9, 0.9, 0.9]), matt([0.8, 0.8, 0.8], 0)],
  [checker],
);

/** Two glossy balls, one of them tinted by its vertices, on a glossy floor. */
export const glossyScene = sceneGlb(
  [
    ball({
      name: "satin",
      center: [-0.6, 0.5, 0.1],
      radius: 0.5,
      material: 0,
      colors: (n) => n.map((v) => 0.6 + 0.4 * v),
    }),
    ball({ name: "metal", center: [0.6, 0.5, -0.1], radius: 0.5, material: 1 }),
    floor({ half: 1.5, material: 2 }),
  ],
  [
    shiny([0.9, 0.8, 0.7], 0.5, 0.6),
    shiny([0.9, 0.7, 0.4], 1, 0.4),
    shiny([0.5, 0.5, 0.6], 0.3, 0.5),
  ],
);

/** A mirror, tinted, beside a matt ball, on a matt floor. */
export const mirrorScene = sceneGlb(
  [
    ball({
      name: "mirror",
      center: [-0.6, 0.5, 0.1],
      radius: 0.5,
      material: 0,
      rings: 40,
      sectors: 60,
    }),
    ball({ name: "matt", center: [0.6, 0.5, -0.1], radius: 0.5, material: 1 }),
    floor({ half: 1.5, material: 1 }),
  ],
  [shiny([0.95, 0.85, 0.75], 1, 0), matt([0.7, 0.7, 0.7])],
);

/** A mirror ring around a ball that stands in its middle, on a floor with a texture. */
export const ringScene = (() => {
  const ring = { name: "ring", positions: [], normals: [], uvs: [], indices: [], material: 0 };
  const [around, across] = [64, 24];
  for (let i = 0; i <= around; ++i)
    for (let j = 0; j <= across; ++j) {
      const [a, b] = [(2 * Math.PI * i) / around, (2 * Math.PI * j) / across];
      const [c, s] = [Math.cos(a), Math.sin(a)];
      const r = 0.8 + 0.18 * Math.cos(b);
      ring.positions.push(r * c, 0.55 + 0.18 * Math.sin(b), -r * s);
      ring.normals.push(Math.cos(b) * c, Math.sin(b), -Math.cos(b) * s);
      ring.uvs.push(i / around, j / across);
    }
  const at = (i, j) => i * (across + 1) + j;
  for (let i = 0; i < around; ++i)
    for (let j = 0; j < across; ++j) {
      const corners = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
      ring.indices.push(corners[0], corners[1], corners[2]);
      ring.indices.push(corners[2], corners[1], corners[3]);
    }
  return sceneGlb(
    [
      ring,
      ball({ name: "red", center: [0, 0.5, 0], radius: 0.45, material: 1 }),
      floor({ half: 1.5, material: 2, repeat: 3 }),
    ],
    [shiny([0.95, 0.85, 0.75], 1, 0), matt([0.8, 0.15, 0.1]), matt([0.8, 0.8, 0.8], 0)],
    [checker],
  );
})();

/** Stood up, its front towards +z, at a depth. */
function standing(mesh, z) {
  for (const list of [mesh.positions, mesh.normals])
    for (let i = 0; i < list.length; i += 3)
      [list[i + 1], list[i + 2]] = [-list[i + 2], list[i + 1]];
  for (let i = 0; i < mesh.positions.length; i += 3) {
    mesh.positions[i + 1] += 0.8;
    mesh.positions[i + 2] += z;
  }
  return mesh;
}

/**
 * Two mirrors, a ball and a wall, that see each other and what stands between them: matt, glossy, with
 * holes, on a floor with a texture.
 */
export const mirrorsScene = sceneGlb(
  [
    ball({
      name: "ball",
      center: [-0.6, 0.5, 0],
      radius: 0.5,
      material: 0,
      rings: 40,
      sectors: 60,
    }),
    standing(floor({ name: "wall", half: 0.8, material: 0, cells: 2 }), -1.2),
    ball({ name: "red", center: [0.5, 0.35, 0.3], radius: 0.35, material: 1 }),
    ball({ name: "glossy", center: [0.2, 0.25, -0.6], radius: 0.25, material: 2 }),
    floor({ name: "leaf", half: 0.5, y: 1.2, material: 3, cells: 4 }),
    floor({ half: 1.5, material: 4, repeat: 3 }),
  ],
  [
    shiny([0.95, 0.85, 0.75], 1, 0),
    matt([0.8, 0.15, 0.1]),
    shiny([0.2, 0.7, 0.3], 0.5, 0.6),
    { ...matt([0.4, 0.8, 0.3], 0), doubleSided: true, alphaMode: "MASK", alphaCutoff: 0.4 },
    matt([0.8, 0.8, 0.8], 1),
  ],
  [holes, checker],
);

/** One square for receivers on texels, matt under a texture and glossy, with a ball above it. */
export const texelScene = sceneGlb(
  [
    floor({ name: "sheet", half: 1.2, material: 0, cells: 2 }),
    ball({ name: "ball", center: [0.2, 0.6, 0], radius: 0.4, material: 1 }),
  ],
  [
    {
      pbrMetallicRoughness: {
        baseColorFactor: [0.9, 0.9, 0.9, 1],
        metallicFactor: 0.4,
        roughnessFactor: 0.6,
        baseColorTexture: { index: 0 },
      },
    },
    matt([0.6, 0.4, 0.3]),
  ],
  [checker],
);

/** A leaning sheet with two sides, its front down, on a floor. */
export const sheetScene = (() => {
  const sheet = floor({ name: "sheet", half: 0.8, material: 0, cells: 6 });
  const [c, s] = [Math.cos(2.5), Math.sin(2.5)];
  for (const list of [sheet.positions, sheet.normals])
    for (let i = 0; i < list.length; i += 3) {
      const [y, z] = [list[i + 1], list[i + 2]];
      list[i + 1] = c * y - s * z + (list === sheet.positions ? 0.7 : 0);
      list[i + 2] = s * y + c * z;
    }
  return sceneGlb(
    [sheet, floor({ half: 1.5, material: 1 })],
    [{ ...matt([0.9, 0.3, 0.2]), doubleSided: true }, matt([0.7, 0.7, 0.7])],
  );
})();

/** A leaf with holes, of two sides, and half a veil before a ball, over a floor. */
export const leafScene = sceneGlb(
  [
    floor({ name: "leaf", half: 1, y: 0.9, material: 0, cells: 4 }),
    ball({ name: "ball", center: [0.2, 0.4, 0], radius: 0.3, material: 1 }),
    floor({ half: 1.5, material: 1 }),
  ],
  [
    { ...matt([0.4, 0.8, 0.3], 0), doubleSided: true, alphaMode: "MASK", alphaCutoff: 0.4 },
    matt([0.7, 0.7, 0.7]),
  ],
  [holes],
);

/** A ball of small triangles, whose seam is as far apart as sines are from 0. */
export const denseScene = sceneGlb(
  [ball({ name: "ball", center: [0, 0.5, 0], radius: 1, rings: 120, sectors: 180, material: 0 })],
  [matt([0.8, 0.8, 0.8])],
);

/** What a patch is spread over. */
export const ballScene = sceneGlb(
  [
    ball({ name: "ball", center: [0, 0.7, 0], radius: 0.7, material: 0 }),
    floor({ half: 1.5, material: 0 }),
  ],
  [matt([0.7, 0.7, 0.7])],
);

/** The same with colours of its own: a texture, and its vertices'. */
export const dyedScene = sceneGlb(
  [
    ball({
      name: "ball",
      center: [0, 0.7, 0],
      radius: 0.7,
      material: 0,
      colors: (n) => n.map((v) => 0.7 + 0.3 * v),
    }),
    floor({ half: 1.5, material: 1 }),
  ],
  [matt([0.9, 0.8, 0.7], 0), matt([0.7, 0.7, 0.7])],
  [checker],
);

/** A sun, a red side, a blue side, a darker ground: different in every direction. */
export const environmentExr = exr(64, 32, (x, y) => {
  const azimuth = 2 * Math.PI * ((x + 0.5) / 64 - 0.5);
  const elevation = Math.PI * (0.5 - (y + 0.5) / 32);
  const d = [
    Math.cos(elevation) * Math.cos(azimuth),
    Math.sin(elevation),
    Math.cos(elevation) * Math.sin(azimuth),
  ];
  const up = 0.5 + 0.5 * d[1];
  const sun = 6 * Math.exp(8 * (0.5 * d[0] + 0.7 * d[1] + 0.51 * d[2] - 1));
  return [
    0.15 + 0.5 * up * up + 0.5 * Math.max(0, d[2]) + sun,
    0.12 + 0.55 * up * up + 0.9 * sun,
    0.1 + 0.8 * up * up + 0.5 * Math.max(0, -d[0]) + 0.7 * sun,
  ];
});
