"""All rows: name of a folder → what its files must come to. Numbers are closed forms or, where it
says so, a path tracer's."""

import math

from checks import Custom, Radiance

GREY = (0.5, 0.5, 0.5)
SPHERE = (0.8, 0.8, 0.8)


def traced(tool, scene, *options):
    """What the path tracer says of every vertex: x, y, z, nx, ny, nz, r, g, b and variances."""
    tool.run_tool("reference", scene, *options, "-o", "traced.csv", "--quiet")
    lines = tool.path("traced.csv").read_text().splitlines()[1:]
    return [[float(cell) for cell in line.split(",")] for line in lines]


def emission_is_written(tool):
    """Of a sphere in the dark: what it emits itself, in the table as in the picture."""
    rows = traced(tool, "es2.glb", "--light", "uniform:0", "--spp", "16")
    tool.assertEqual(len(rows), 642)
    for row in rows:
        for got, right in zip(row[6:9], (1.0, 0.5, 0.25)):
            tool.assertAlmostEqual(got, right, delta=1e-6)


def apart(rows, truth, where):
    """Relative RMSE of the colours of rows `where` holds of."""
    wrong = sum((a - b) ** 2 for p, q in zip(rows, truth) if where(p) for a, b in zip(p[6:9], q[6:9]))
    whole = sum(b ** 2 for p, q in zip(rows, truth) if where(p) for b in q[6:9])
    return math.sqrt(wrong / whole)


def bounced_colour(tool):
    """The wall over a floor of one quad with a red carpet and a dark rim, against paths."""
    asset, _ = tool.baked("carpet.glb", ("--bounces", "2", "--refine", "off"))
    rows = tool.shaded(asset, "uniform")
    truth = traced(tool, "carpet.glb", "--light", "uniform", "--bounces", "2", "--spp", "256")

    def is_low_wall(row):
        return row[5] > 0.9 and 0.0 < row[1] < 0.5
    tool.assertLess(apart(rows, truth, is_low_wall), 0.02)
    near = [row for row in rows if is_low_wall(row) and row[1] < 0.15 and abs(row[0]) < 0.3]
    tool.assertTrue(near)
    for row in near:
        tool.assertGreater(row[6], 1.2 * row[7])


def no_teeth(tool):
    """A room with boxes that have no bottoms, on texels: the picture against paths."""
    asset, findings = tool.baked("box_uv.glb", ("--texels", "48x48", "--bounces", "3"))
    tool.assertIn("receivers-inside", findings)
    picture = ("--light", "uniform", "--size", "96x96")
    tool.run_tool("render", asset, *picture, "-o", "ours.exr", "--backend", "cpu", "--quiet")
    tool.run_tool("reference", "box_uv.glb", *picture, "--bounces", "3", "--spp", "128", "-o",
                  "truth.exr", "--quiet")
    # 2% and more with what the receivers inside see for themselves.
    far = tool.run_json("compare", "truth.exr", "ours.exr")
    tool.assertLess(far["beyond_noise"], 0.012)
    tool.assertLess(abs(far["bias"]), 0.004)


def no_step(tool):
    """The texels at both ends of a turn hold the same, where those beside them differ."""
    asset, _ = tool.baked("us.glb", ("--texels", "40x20", "--transfer", "shadowed"))
    value = [row[6] for row in tool.shaded(asset, "disc:90,30,60,1")]
    tool.assertEqual(len(value), 800)
    inner = range(2, 18)
    step = max(abs(value[40 * y] - value[40 * y + 39]) for y in inner)
    beside = max(abs(value[40 * y] - value[40 * y + 1]) for y in inner)
    tool.assertLess(step, 0.05 * beside)


def mirrors_see(scene, beyond, bias):
    """Pictures against paths, in a light that harmonics hold whole. A mirror that showed the light
    through walls was 31% too bright."""
    def check(tool):
        asset, _ = tool.baked(scene)
        picture = ("--light", "uniform", "--size", "96x96")
        tool.run_tool("render", asset, *picture, "--window", "none", "-o", "ours.exr", "--backend",
                      "cpu", "--quiet")
        tool.run_tool("reference", scene, *picture, "--spp", "128", "-o", "truth.exr", "--quiet")
        far = tool.run_json("compare", "truth.exr", "ours.exr")
        tool.assertLess(far["beyond_noise"], beyond)
        tool.assertLess(abs(far["bias"]), bias)
    return check


def texels(*sizes):
    return [("--texels", size) for size in sizes]


ROWS = {
    "01-buried-receivers": [Custom("no teeth along contacts", no_teeth)],
    "02-textured-bounce": [Custom("the colour of the carpet", bounced_colour)],
    "04-mixed-winding": [
        # A convex body in uniform light: its albedo.
        Radiance("sphere20.glb", SPHERE, within=0.01, finds=("winding-reversed",),
                 silent=("normals-flipped",)),
    ],
    "05-texel-on-diagonal": [
        # Convex bodies, all of whose texel centres lie on edges of triangles.
        *(Radiance("grid8.glb", GREY, options=o) for o in texels("8x8", "4x4")),
        *(Radiance("uvsphere64x32.glb", SPHERE, options=o, within=0.01)
          for o in texels("64x32", "32x16", "16x8")),
        Radiance("quad.glb", GREY, options=("--texels", "1x1")),
    ],
    "06-emissive-csv": [Custom("a surface's own emission", emission_is_written)],
    "08-texel-seam": [Custom("no step along the seam", no_step)],
    "09-mirrors": [
        Custom("a box that is a mirror in a room", mirrors_see("mixed.glb", 0.035, 0.012)),
        Custom("a mirror ring on a ground", mirrors_see("ring.glb", 0.02, 0.005)),
    ],
}
