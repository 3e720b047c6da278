"""All rows: name of a folder → what its files must come to. Numbers are closed forms or, where it
says so, a path tracer's."""

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


def texels(*sizes):
    return [("--texels", size) for size in sizes]


ROWS = {
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
}
