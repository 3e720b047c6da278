"""glTF as the world writes it: what exporters, converters and archives leave in files."""

from checks import Custom, Radiance, Refused, Same

GREY = (0.5, 0.5, 0.5)
ORANGE = (0.8, 0.4, 0.2)
COUNTED_RED = (0.5029, 0.0452, 0.0452)  # sRGB 188, 60, 60


def is_top(row):
    return row[4] > 0.9


def is_side(row):
    return abs(row[4]) < 0.1 and abs(row[3]) + abs(row[5]) > 0.9


def three_cubes(tool):
    asset, findings = tool.baked("used.glb")
    tool.assertEqual(len(tool.shaded(asset, "uniform")), 72)
    tool.assertFalse([code for code in findings if code.startswith("extension-")])


def is_no_metal(tool):
    asset, findings = tool.baked("unlit_factor.glb")
    tool.assertIn("unlit", findings)
    tool.assertNotIn("glossy", tool.run_tool("info", asset).stdout)


def is_ground(row):
    return row[1] == 0.0


def back_as_front(tool):
    """The ground beside a sheet, and the side of it that faces the light."""
    looks = []
    for scene in ("back_lit.glb", "front_lit.glb"):
        asset, findings = tool.baked(scene, ("--refine", "off"))  # the file's own vertices
        tool.assertIn("two-sided", findings)
        rows = tool.shaded(asset, "disc:0,30,20,30")
        ground = [row[6:] for row in rows if row[4] > 0.9]
        lit = [row[6:] for row in rows if row[3] > 0.9]
        tool.assertEqual(len(ground), 81)
        tool.assertEqual(len(lit), 81)
        looks.append([[sum(row[c] for row in part) / 81 for c in range(3)]
                      for part in (ground, lit)])
    for part, twin in zip(*looks):
        for got, right in zip(part, twin):
            tool.assertAlmostEqual(got, right, delta=0.01 * max(twin))
    tool.assertGreater(looks[0][1][0], 0.5)


def a_box_has_its_shadow(tool):
    """A floor of two triangles is cut where the shadow is; if that is turned off it is said."""
    light = ("--light", "disc:120,45,30", "--size", "192x144", "--quiet")
    tool.run_tool("reference", "floor.glb", *light, "--bands", 5, "--spp", 256, "-o", "truth.exr")
    beyond = {}
    for name, options in (("two", ("--refine", "off")), ("cut", ())):
        summary = tool.run_json("bake", "floor.glb", "-o", f"{name}.glb", "--directions", 2048,
                                "--encoding", "float32", *options)
        codes = {found["code"] for found in summary["findings"]}
        tool.assertIn("coarse-receivers" if name == "two" else "triangles-cut", codes)
        tool.assertNotIn("triangles-cut" if name == "two" else "coarse-receivers", codes)
        tool.run_tool("render", f"{name}.glb", *light, "-o", f"{name}.exr")
        beyond[name] = tool.run_json("compare", "truth.exr", f"{name}.exr")["beyond_noise"]
    tool.assertGreater(beyond["two"], 0.08)
    tool.assertLess(beyond["cut"], 0.025)


ROWS = {
    "04-gltf-far-node": [Same("far.glb", "near.glb", finds=("far-origin",))],
    "05-gltf-no-normals": [
        # 0.3798 above and nothing on the sides, as five bands have a cosine: 1/4 + 1/2 + 5/16 - 3/32
        # of it towards the light, 1/4 - 5/32 - 9/256 across.
        Radiance("cube.glb", (0.3798 * 0.96875,) * 3, where=is_top, light="disc:0,90,10,100",
                 options=("--bounces", "0"), finds=("normals-made",)),
        Radiance("cube.glb", (0.3798 * 0.05859,) * 3, where=is_side, light="disc:0,90,10,100",
                 options=("--bounces", "0")),
        Radiance("cube.glb", (0.2184,) * 3, where=lambda row: row[4] > 0, light="disc:0,90,10,100",
                 options=("--bounces", "0", "--smooth", "180")),
    ],
    "06-gltf-unlit": [Radiance("unlit_factor.glb", ORANGE), Custom("no metal", is_no_metal)],
    "07-gltf-specgloss": [Radiance("specgloss.glb", COUNTED_RED)],
    "15-gltf-bytestride-0": [Radiance("stride0.glb", GREY)],
    "16-gltf-instancing": [Custom("three cubes", three_cubes)],
    # One part in 64 of the sheet above is there, and sends nearly all of its light down.
    "17-gltf-alpha-mask": [
        Radiance("mask.glb", GREY, where=is_ground,
                 silent=("alpha-ignored", "receivers-inside")),
    ],
    "18-gltf-transmission": [
        Radiance("glass.glb", GREY, where=is_ground,
                 silent=("extension-KHR_materials_transmission", "receivers-inside")),
    ],
    "19-gltf-matrix-noise": [Radiance("m44.glb", GREY)],
    "21-double-sided": [
        Custom("the back is lit and gives light as its twin's front does", back_as_front),
    ],
    "22-gltf-hidden-node": [
        Radiance("hidden.glb", GREY, finds=("hidden-nodes",),
                 silent=("extension-KHR_node_visibility",)),
    ],
    "28-gltf-compressed-not-required": [
        Refused("draco.glb", says=("mesh 0", "Draco", "gltf-transform")),
        Refused("draco_noidx.glb", says=("mesh 0", "Draco", "gltf-transform")),
        Refused("webp.glb", says=("image 0", "WebP", "damaged")),
    ],
    "31-coarse-floor": [Custom("a shadow", a_box_has_its_shadow)],
}
