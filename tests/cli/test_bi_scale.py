"""A patch becomes an RTT, is spread over a surface, and is relit."""

import math
import os
import subprocess
from pathlib import Path

from harness import USAGE, ToolTest, ball_obj, png, quad_obj, read_csv

GLTF_MODULES = os.environ["LAMBENT_GLTF_MODULES"]
SMALL = ("--positions", "16x16", "--views", 4, "--bands", 3, "--directions", 128, "--bounces", 1)


class BiScaleTest(ToolTest):
    def rtt(self, patch="stucco", output="patch.rtt", *options) -> Path:
        self.run_tool("rtt", patch, "-o", output, "--quiet", *(options or SMALL))
        return self.path(output)

    def spread(self, *options, scene="ball.obj", output="ball.glb") -> dict:
        if scene == "ball.obj" and not self.path(scene).exists():
            self.write(scene, ball_obj(24, 12))
        return self.run_json("synthesize", scene, "--rtt", "patch.rtt", "-o", output,
                             "--directions", 256, "--map-size", 256, "--vertices", 8000, *options)


class Spread(BiScaleTest):
    def test_from_a_patch_to_a_picture(self):
        self.rtt()
        info = self.run_json("info", "patch.rtt")
        self.assertEqual((info["kind"], info["width"], info["views"], info["bands"]),
                         ("radiance transfer texture", 16, 4, 3))
        summary = self.spread("--patch-width", 0.8)
        surface = summary["surfaces"][0]
        self.assertAlmostEqual(surface["patches"], 4 * math.pi / 0.64, delta=1.0)
        self.assertEqual((surface["layout"], surface["singularities"]), ("pieces", 2))
        info = self.run_json("info", "ball.glb")
        bi_scale = info["transfer"]["meshes"][0]["bi_scale"]
        self.assertEqual(bi_scale["id_map"], [256, 256])
        self.assertEqual(info["transfer"]["rtts"][0]["width"], 16)
        self.assertNotIn("layouts", info)
        layout, = self.run_json("info", "ball.glb", "--measure")["layouts"]
        self.assertAlmostEqual(layout["period"][0], 0.8, delta=1e-6)
        self.assertGreater(layout["continued"], 0.8)
        self.assertEqual(len(layout["tears"]), min(16, layout["tear_count"]))
        for backend in ("gl", "cpu"):
            self.run_tool("render", "ball.glb", "--light", "disc:30,45,40", "-o", backend + ".exr",
                          "--size", "96", "--backend", backend)
        self.run_tool("compare", "cpu.exr", "gl.exr", "--fail-above", "rmse=0.004")
        self.run_tool("shade", "ball.glb", "--light", "uniform", "-o", "ball.csv")
        mean = [sum(row[6 + c] for row in read_csv(self.path("ball.csv"))) for c in range(3)]
        self.assertGreater(min(mean), 0.0)

    def test_what_repeats_itself_is_a_lattice_unless_it_is_not_to_be(self):
        self.rtt("weave")
        surface, = self.spread()["surfaces"]
        # Its two colours bear half turns.
        self.assertEqual((surface["layout"], surface["patch_symmetry"]["turns"]), ("lattice", 2))
        self.assertEqual((surface["singularities"], surface["continued"]), (4, 1.0))
        lattice, = self.run_json("info", "ball.glb", "--measure")["layouts"]
        surface, = self.spread("--layout", "pieces")["surfaces"]
        pieces, = self.run_json("info", "ball.glb", "--measure")["layouts"]
        self.assertLess(lattice["tear_length"], 0.5 * pieces["tear_length"])
        self.assertEqual((surface["layout"], surface["singularities"]), ("pieces", 2))
        self.assertGreater(surface["meso_vertices"], 0)
        surface, = self.spread("--layout", "lattice", "--direction", "0,1,0")["surfaces"]
        self.assertEqual((surface["layout"], surface["continued"]), ("lattice", 1.0))

    def test_a_preview_lies_as_the_whole_does(self):
        self.rtt()
        whole, = self.spread(output="whole.glb")["surfaces"]
        summary = self.run_json("synthesize", "ball.obj", "--rtt", "patch.rtt", "-o", "look.glb",
                                "--vertices", 8000, "--preview")
        look, = summary["surfaces"]
        self.assertAlmostEqual(look["patch_width"], whole["patch_width"], delta=1e-6)
        self.assertEqual(look["singularities"], whole["singularities"])
        self.assertEqual(summary["transfer"]["kind"], "unshadowed")
        refused = self.run_tool("synthesize", "ball.obj", "--rtt", "patch.rtt", "-o", "look.glb",
                                "--preview", "--transfer", "shadowed", code=2)
        self.assertIn("--preview", refused.stderr)

    def test_a_tint_varies_the_patchs_colours(self):
        """A square under a picture whose left half is red and whose right half is blue."""
        self.rtt("weave")
        self.write("two.png", png(64, 32, lambda x, y: (255, 40, 40) if x < 32 else (40, 40, 255)))
        self.write("quad.obj", quad_obj(((0.1, 0.1), (0.1, 0.9), (0.9, 0.9), (0.9, 0.1))))

        def spread(*options):
            summary = self.spread(*options, scene="quad.obj", output="quad.glb")
            return summary["transfer"]["meshes"][0]["bi_scale"]["tint"]

        self.assertEqual(spread(), {"texels": [0, 0], "vertex_colors": False})
        for how in (("--map", "uv", "--tiles", "4x4"), ("--new-uvs",)):
            tint = spread("--tint", "two.png", *how)
            self.assertFalse(tint["vertex_colors"])
            if "--map" in how:
                self.assertEqual(tint["texels"], [64, 32])
            self.assertIn("tinted by", self.run_tool("info", "quad.glb").stdout)
            self.run_tool("shade", "quad.glb", "--light", "uniform", "-o", "quad.csv")
            for row in read_csv(self.path("quad.csv")):
                if abs(row[0]) < 0.1:
                    continue  # where the halves meet
                strong, weak = (row[6], row[8]) if row[0] < 0 else (row[8], row[6])
                self.assertGreater(strong, 5 * weak, how)
            for backend in ("gl", "cpu"):
                self.run_tool("render", "quad.glb", "--light", "disc:30,45,40", "-o",
                              backend + ".exr", "--size", "96", "--backend", backend)
            self.run_tool("compare", "cpu.exr", "gl.exr", "--fail-above", "rmse=0.004")

    def test_a_tint_of_its_own_is_what_it_was(self):
        self.rtt()
        self.write("quad.obj", "mtllib quad.mtl\nusemtl red\n" + quad_obj())
        self.write("quad.mtl", "newmtl red\nKd 0.8 0.2 0.1\n")
        summary = self.spread("--tint", "own", scene="quad.obj", output="quad.glb")
        tint = summary["transfer"]["meshes"][0]["bi_scale"]["tint"]
        self.assertEqual(tint, {"texels": [0, 0], "vertex_colors": True})
        self.assertIn("tint-even", {finding["code"] for finding in summary["findings"]})

    def test_a_tint_needs_something_to_lie_by(self):
        self.rtt()
        self.write("ball.obj", ball_obj())
        self.write("red.png", png(8, 8, lambda x, y: (255, 0, 0)))
        self.write("light.hdr", b"#?RADIANCE")
        spread = ("synthesize", "ball.obj", "--rtt", "patch.rtt", "-o", "a.glb", "--tint")
        self.refused(*spread, "red.png", says="texture coordinates")
        self.refused(*spread, "none.png", says="none.png")
        self.refused(*spread, "light.hdr", says=["light.hdr", "PNG"])

    def masked(self, *options, scene="quad.obj") -> dict:
        self.rtt("weave")
        self.rtt("stucco", "over.rtt")
        self.write("quad.obj", quad_obj())
        self.write("mask.png", png(8, 8, lambda x, y: (255, 0, 0) if x < 4 else (0, 0, 0)))
        return self.spread("--rtt", "over.rtt", "--mask", "mask.png", *options, scene=scene,
                           output="layered.glb")

    def test_a_mask_shows_a_second_patch(self):
        summary = self.masked("--patch-width", 0.5, "--patch-width", 0.25)
        below, above = summary["surfaces"]
        self.assertEqual((below["patch"], below["layer"], above["patch"], above["layer"]),
                         ("weave", False, "stucco", True))
        self.assertAlmostEqual(below["share"], 0.5, delta=0.01)
        self.assertAlmostEqual(above["share"], 0.5, delta=0.01)
        self.assertEqual((below["patch_width"], above["patch_width"]), (0.5, 0.25))
        meshes = self.run_json("info", "layered.glb")["transfer"]["meshes"]
        self.assertEqual([mesh["bi_scale"]["layer"] for mesh in meshes], [False, True])
        self.assertEqual([mesh["bi_scale"]["rtt"] for mesh in meshes], [0, 1])
        self.assertIn("a layer by a mask of", self.run_tool("info", "layered.glb").stdout)
        # Beside each other: as each alone, but for where they blend.
        for backend in ("gl", "cpu"):
            self.run_tool("render", "layered.glb", "--light", "disc:30,45,40", "-o",
                          backend + ".exr", "--size", "96", "--backend", backend, "--samples", 16)
        self.run_tool("compare", "cpu.exr", "gl.exr", "--fail-above", "rmse=0.01")
        # What is baked again is what carries them.
        again = self.run_json("bake", "layered.glb", "-o", "again.glb", "--directions", 16)
        self.assertIn("layers-left-out", {finding["code"] for finding in again["findings"]})
        self.assertEqual(len(again["transfer"]["meshes"]), 1)

    def test_a_mask_that_shows_nothing_is_said(self):
        self.rtt()
        self.write("quad.obj", quad_obj())
        self.write("black.png", png(8, 8, lambda x, y: (0, 0, 0)))
        summary = self.spread("--rtt", "patch.rtt", "--mask", "black.png", scene="quad.obj")
        self.assertIn("mask-empty", {finding["code"] for finding in summary["findings"]})
        self.assertEqual(len(summary["surfaces"]), 1)
        self.write("grey.png", png(8, 8, lambda x, y: (128, 128, 128)))
        summary = self.spread("--rtt", "patch.rtt", "--rtt", "patch.rtt", "--mask", "grey.png",
                              scene="quad.obj")
        self.assertIn("mask-grey", {finding["code"] for finding in summary["findings"]})
        shares = [surface["share"] for surface in summary["surfaces"]]
        for share, expected in zip(shares, (0.25, 0.25, 0.5)):
            self.assertAlmostEqual(share, expected, delta=0.01)

    def test_patches_and_mask_go_together(self):
        self.rtt()
        self.write("ball.obj", ball_obj())
        self.write("red.png", png(8, 8, lambda x, y: (255, 0, 0)))
        one = ("synthesize", "ball.obj", "-o", "a.glb", "--rtt", "patch.rtt")
        two = (*one, "--rtt", "patch.rtt")
        self.refused(*two, code=USAGE, says="--mask")
        self.refused(*one, "--mask", "red.png", code=USAGE, says="--rtt")
        self.refused(*two, "--rtt", "patch.rtt", "--rtt", "patch.rtt", "--rtt", "patch.rtt",
                     "--mask", "red.png", code=USAGE, says="three patches")
        self.refused(*one, "--patch-width", 1, "--patch-width", 2, code=USAGE, says="--patch-width")
        self.refused(*two, "--mask", "red.png", says=["texture coordinates", "unwrap it"])
        self.refused(*two, "--mask", "none.png", says="none.png")

    def test_it_lies_along_creases_unless_it_is_not_to(self):
        self.rtt("bricks")
        self.write("cube.obj", "\n".join(
            [f"v {x} {y} {z}" for x in (0, 1) for y in (0, 1) for z in (0, 1)] +
            [f"f {a} {b} {c} {d}" for a, b, c, d in ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2),
                                                    (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4))]))
        surface, = self.spread(scene="cube.obj", output="cube.glb")["surfaces"]
        self.assertEqual(surface["feature_lines"], 12)
        self.assertGreater(surface["aligned_lines"], 3)
        self.assertIn("of 12 creases", self.run_tool(
            "synthesize", "cube.obj", "--rtt", "patch.rtt", "-o", "cube.glb", "--preview").stdout)
        for other in (("--no-align",), ("--direction", "0,1,0")):
            surface, = self.spread(*other, scene="cube.obj", output="cube.glb")["surfaces"]
            self.assertEqual(surface["feature_lines"], 0)

    def test_curves_and_pictures_steer_it(self):
        self.rtt("bricks")
        self.write("quad.obj", quad_obj())
        self.write("strokes.csv", "curve,x,y,z\na,-1,0,-1\na,-1,0,1\n")
        self.write("strokes.obj", "v 9 9 9\nv 9 9 8\nl 1 2\n")
        self.write("arrows.png", png(4, 4, lambda x, y: (255, 128, 128)))
        self.write("grey.png", png(4, 4, lambda x, y: (128, 128, 128)))
        for file, share, found in (("strokes.csv", 0.5, ()), ("strokes.obj", 0, {"steers-nothing"}),
                                   ("arrows.png", 1, ()), ("grey.png", 0, {"steers-nothing"})):
            summary = self.spread("--direction", file, "--patch-width", 6, scene="quad.obj",
                                  output="quad.glb")  # so large that no triangle is cut
            self.assertEqual(summary["surfaces"][0]["guided"], share, file)
            codes = {finding["code"] for finding in summary["findings"]}
            self.assertEqual(codes & {"steers-nothing"}, set(found), file)
        self.write("bad.csv", "a,0,0,0\na,1,0\n")
        spread = ("synthesize", "quad.obj", "--rtt", "patch.rtt", "-o", "a.glb", "--direction")
        self.refused(*spread, "bad.csv", says=["bad.csv, line 2", "curve,x,y,z"])
        self.refused(*spread, "none.csv", says="none.csv")
        self.refused(*spread, "0,1,0", "--map", "uv", code=USAGE, says="--map uv")

    def test_the_file_is_sound_to_other_tools(self):
        self.rtt()
        self.spread()
        validate = Path(__file__).parents[1] / "gltf" / "validate.mjs"
        result = subprocess.run(["node", validate, "--modules", GLTF_MODULES, "ball.glb"],
                                cwd=self.dir, text=True, capture_output=True, timeout=120)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    def test_the_same_bytes_whatever_the_threads(self):
        for threads in (1, 2, 3):
            self.rtt("stucco", f"{threads}.rtt", *SMALL, "--threads", threads)
            self.path(f"{threads}.rtt").replace(self.path("patch.rtt"))
            self.spread("--threads", threads, output=f"{threads}.glb")
            self.path("patch.rtt").replace(self.path(f"{threads}.rtt"))
        for kind in ("rtt", "glb"):
            one, two, three = (self.path(f"{n}.{kind}").read_bytes() for n in (1, 2, 3))
            self.assertTrue(one == two == three, kind)

    def test_a_flat_patch_is_diffuse_transfer(self):
        """B of a flat patch is the cosine lobe: bi-scale must equal what `bake` makes."""
        self.write("flat.png", png(8, 8, lambda x, y: (128, 128, 128)))
        self.rtt("flat.png", "patch.rtt", *SMALL, "--depth", 0, "--albedo", 0.6,
                 "--encoding", "float32")
        self.write("ball.obj", ball_obj(24, 12))
        self.spread("--transfer", "unshadowed", "--patch-width", 2)  # cuts no triangle
        self.bake("ball.obj", "plain.glb", "--transfer", "unshadowed", "--albedo", 0.6, "--bands", 3,
                  "--encoding", "float32")
        light = "disc:20,50,60,3/2/1+uniform:0.2"
        for name in ("ball", "plain"):
            self.run_tool("shade", name + ".glb", "--light", light, "-o", name + ".csv")
        plain = {tuple(round(v, 4) for v in row[:3]): row[6:] for row in
                 read_csv(self.path("plain.csv"))}
        for row in read_csv(self.path("ball.csv")):
            expected = plain[tuple(round(v, 4) for v in row[:3])]
            for a, b in zip(row[6:], expected):
                self.assertAlmostEqual(a, b, delta=0.01 * max(1.0, b))

    def test_macro_transport_can_be_switched(self):
        self.rtt()
        self.spread("--ground", "--keep-shadowed")
        pictures = {}
        for macro in ("off", "shadowed", "interreflected"):
            self.run_tool("render", "ball.glb", "--light", "uniform", "-o", macro + ".exr",
                          "--size", "64", "--macro", macro)
            pictures[macro] = self.run_json("info", macro + ".exr")["mean"][0]
        self.assertGreater(pictures["off"], pictures["interreflected"])
        self.assertGreater(pictures["interreflected"], pictures["shadowed"])

    def test_the_choice_of_transfer_is_that_switch(self):
        self.rtt()
        self.spread("--ground", "--keep-shadowed")
        render = ("render", "ball.glb", "--light", "disc:40,35,30,4", "--size", "64", "--exposure",
                  0, "--backend", "cpu", "-o")
        for macro, transfer in (("off", "unshadowed"), ("shadowed", "shadowed"),
                                ("interreflected", "interreflected")):
            # The ground is no bi-scale surface: it follows --transfer alone.
            self.run_tool(*render, "macro.png", "--macro", macro, "--transfer", transfer)
            self.run_tool(*render, "both.png", "--transfer", transfer)
            self.run_tool("compare", "macro.png", "both.png", "--fail-above", "difference=0.02")

    def test_what_was_not_baked_cannot_be_shown(self):
        self.rtt()
        self.spread("--transfer", "shadowed")
        self.run_tool("render", "ball.glb", "--light", "uniform", "-o", "a.png", "--size", "32",
                      "--macro", "shadowed")
        result = self.run_tool("render", "ball.glb", "--light", "uniform", "-o", "b.png", "--size",
                               "32", "--macro", "interreflected", code=(USAGE, 3))
        self.assertIn("interreflected", result.stderr)
        self.assertFalse(self.path("b.png").exists())

    def test_own_uvs_repeat_the_patch(self):
        self.write("quad.obj", quad_obj(((0, 0), (0, 1), (1, 1), (1, 0))))
        self.rtt()
        summary = self.spread("--map", "uv", "--tiles", "3x2", scene="quad.obj", output="quad.glb")
        self.assertEqual(summary["transfer"]["meshes"][0]["bi_scale"]["tiles"], [3, 2])
        self.run_tool("render", "quad.glb", "--light", "disc:30,45,40", "-o", "a.png", "--size", "32")

    def test_a_picture_of_the_atlas(self):
        self.rtt()
        self.spread("--atlas-picture", "atlas.png")
        info = self.run_json("info", "atlas.png")
        self.assertEqual((info["width"], info["height"]), (512, 256))


def torus_obj(around=24, across=12) -> str:
    lines = []
    for i in range(around):
        for j in range(across):
            a, b = 2 * math.pi * i / around, 2 * math.pi * j / across
            r = 1 + 0.4 * math.cos(b)
            lines.append(f"v {r * math.cos(a)} {0.4 * math.sin(b)} {r * math.sin(a)}")
    for i in range(around):
        for j in range(across):
            k, l = (i + 1) % around, (j + 1) % across
            a, b, c, d = (1 + p * across + q for p, q in ((i, j), (i, l), (k, l), (k, j)))
            lines += [f"f {a} {b} {c}", f"f {a} {c} {d}"]
    return "\n".join(lines) + "\n"


class OddMeshes(BiScaleTest):
    """Each works, or says clearly why not."""

    def findings(self, summary) -> set:
        return {finding["code"] for finding in summary["findings"]}

    def test_a_hole_through_it(self):
        self.rtt()
        self.write("torus.obj", torus_obj())
        surface = self.spread(scene="torus.obj")["surfaces"][0]
        self.assertEqual(surface["singularities"], 0)

    def test_an_open_mesh_of_two_parts(self):
        self.rtt()
        ball = ball_obj(24, 12).splitlines()
        half = [line for k, line in enumerate(ball) if not (line.startswith("f") and k % 3 == 0)]
        count = sum(line.startswith("v ") for line in half)
        away = [f"v {float(line.split()[1]) + 3} {line.split()[2]} {line.split()[3]}"
                for line in ball if line.startswith("v ")]
        again = ["f " + " ".join(str(int(c.split("//")[0]) + count) for c in line.split()[1:])
                 for line in ball if line.startswith("f")]
        only = [line.replace("//", " ") for line in half if line.startswith("v ")]
        faces = ["f " + " ".join(c.split("//")[0] for c in line.split()[1:])
                 for line in half if line.startswith("f")]
        self.write("parts.obj", "\n".join(only + away + faces + again) + "\n")
        self.assertGreater(self.spread(scene="parts.obj")["surfaces"][0]["charts"], 1)

    def test_three_triangles_at_an_edge(self):
        self.rtt()
        self.write("fin.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 1 0 1\nv 0 1 0\n"
                              "f 1 3 2\nf 2 3 4\nf 1 2 5\nf 2 1 5\n")
        self.assertIn("non-manifold-edges", self.findings(self.spread(scene="fin.obj")))

    def test_uvs_that_overlap(self):
        self.rtt()
        self.write("quad.obj", quad_obj(((0, 0), (1, 0), (0, 1), (1, 1))))
        summary = self.spread(scene="quad.obj")
        self.assertIn("uvs-unsound", self.findings(summary))
        self.assertFalse(summary["surfaces"][0]["own_uvs"])

    def test_sound_uvs_are_kept(self):
        self.rtt()
        self.write("quad.obj", quad_obj(((0.1, 0.1), (0.1, 0.9), (0.9, 0.9), (0.9, 0.1))))
        self.assertTrue(self.spread(scene="quad.obj")["surfaces"][0]["own_uvs"])


class OddPatches(BiScaleTest):
    def test_a_height_field_that_does_not_tile(self):
        self.write("ramp.png", png(16, 16, lambda x, y: (16 * x,) * 3))
        summary = self.run_json("rtt", "ramp.png", "-o", "ramp.rtt", *SMALL)
        self.assertIn("height-field-seam", {f["code"] for f in summary["findings"]})
        self.run_tool("rtt", "ramp.png", "-o", "blended.rtt", "--blend", 0.3, "--quiet", *SMALL)

    def test_files_that_are_no_patches(self):
        self.write("bad.png", b"not a picture")
        self.refused("rtt", "bad.png", "-o", "a.rtt", says="bad.png")
        self.refused("rtt", "missing.exr", "-o", "a.rtt", says="missing.exr")
        self.refused("rtt", "velvet", "-o", "a.rtt", code=(USAGE, 3), says="velvet")

    def test_a_measured_btf(self):
        folder = self.path("btf")
        folder.mkdir()
        rows = ["file,view_theta,view_phi,light_theta,light_phi"]
        for v, (theta, phi) in enumerate(((0, 0), (45, 0), (45, 120), (45, 240))):
            for l, (light, turn) in enumerate(((0, 0), (40, 0), (40, 90), (40, 180), (40, 270))):
                grey = int(200 * math.cos(math.radians(light)))
                (folder / f"{v}-{l}.png").write_bytes(png(8, 8, lambda x, y: (grey,) * 3))
                rows.append(f"{v}-{l}.png,{theta},{phi},{light},{turn}")
        (folder / "btf.csv").write_text("\n".join(rows) + "\n")
        self.run_tool("rtt", "btf", "-o", "btf.rtt", "--positions", "8x8", "--views", 4, "--bands", 3,
                      "--size", 0.1, "--quiet")
        self.assertEqual(self.run_json("info", "btf.rtt")["width"], 8)
        (folder / "2-3.png").unlink()
        self.refused("rtt", "btf", "-o", "b.rtt", says="2-3.png")


class Refused(BiScaleTest):
    def test_files_that_are_no_rtts(self):
        self.write("ball.obj", ball_obj())
        self.write("not.rtt", "hello")
        self.refused("synthesize", "ball.obj", "--rtt", "not.rtt", "-o", "a.glb",
                     says=("not.rtt", "lambent rtt"))
        self.refused("synthesize", "ball.obj", "--rtt", "missing.rtt", "-o", "a.glb",
                     says="missing.rtt")
        whole = self.rtt().read_bytes()
        self.write("cut.rtt", whole[: len(whole) // 2])
        self.refused("synthesize", "ball.obj", "--rtt", "cut.rtt", "-o", "a.glb",
                     says=("cut.rtt", "cut off"))

    def test_uvs_that_are_not_there(self):
        self.write("ball.obj", ball_obj())
        self.rtt()
        self.refused("synthesize", "ball.obj", "--rtt", "patch.rtt", "-o", "a.glb", "--map", "uv",
                     says=("ball.obj", "UVs"))

    def test_tiles_without_uvs(self):
        self.write("ball.obj", ball_obj())
        self.rtt()
        self.refused("synthesize", "ball.obj", "--rtt", "patch.rtt", "-o", "a.glb", "--tiles", "2x2",
                     code=USAGE, says="--map uv")

    def test_a_mesh_that_is_not_there(self):
        self.write("ball.obj", ball_obj())
        self.rtt()
        self.refused("synthesize", "ball.obj", "--rtt", "patch.rtt", "-o", "a.glb", "--mesh", "hat",
                     code=USAGE, says="hat")

    def test_a_mirror(self):
        self.write("ball.obj", ball_obj())
        self.rtt()
        self.refused("synthesize", "ball.obj", "--rtt", "patch.rtt", "-o", "a.glb", "--material",
                     "mirror", says="mirror")
