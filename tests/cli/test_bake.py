"""Baking, lighting and shading: what comes out is what was asked for."""

import json
import math
import os
import subprocess
from pathlib import Path

from harness import FAILED, INPUTS, USAGE, ToolTest, ball_obj, png, quad_obj, read_csv

GLTF_MODULES = os.environ["LAMBENT_GLTF_MODULES"]


class Bake(ToolTest):
    def test_the_same_bytes_whatever_the_threads(self):
        self.write("ball.obj", ball_obj(48, 24))
        options = ("--directions", 512, "--bounces", 2)
        one = self.bake("ball.obj", "one.glb", *options, "--threads", 1).read_bytes()
        two = self.bake("ball.obj", "two.glb", *options, "--threads", 2).read_bytes()
        three = self.bake("ball.obj", "three.glb", *options, "--threads", 3).read_bytes()
        self.assertTrue(one == two == three)
        other = self.bake("ball.obj", "other.glb", *options, "--seed", 7).read_bytes()
        self.assertNotEqual(one, other)

    def test_a_white_ball_under_an_even_sky_is_as_bright_as_the_sky(self):
        self.bake("ball.obj", "ball.glb", "--albedo", 1, "--transfer", "unshadowed",
                  "--encoding", "float32")
        self.run_tool("shade", "ball.glb", "--light", "uniform:0.5", "-o", "ball.csv")
        for row in read_csv(self.path("ball.csv")):
            for radiance in row[6:]:
                self.assertAlmostEqual(radiance, 0.5, places=4)

    def test_albedo_scales_diffuse_light(self):
        for albedo, name in (("0.25,0.5,1", "a"), ("1", "b")):
            self.bake("ball.obj", name + ".glb", "--albedo", albedo, "--transfer", "shadowed",
                      "--encoding", "float32")
            self.run_tool("shade", name + ".glb", "--light", "disc:0,45,20", "-o", name + ".csv")
        for a, b in zip(read_csv(self.path("a.csv")), read_csv(self.path("b.csv"))):
            for c, albedo in enumerate((0.25, 0.5, 1.0)):
                self.assertAlmostEqual(a[6 + c], albedo * b[6 + c], places=5)

    def test_csv_and_ply_hold_the_same(self):
        self.bake()
        for output in ("a.csv", "a.ply"):
            self.run_tool("shade", "ball.glb", "--light", "disc:10,50,30", "-o", output)
        self.run_tool("compare", "a.csv", "a.csv", "--fail-above", "rmse=0")
        csv, ply = read_csv(self.path("a.csv")), self.path("a.ply").read_bytes()
        self.assertIn(b"element vertex 114\n", ply)
        self.assertEqual(len(ply) - ply.index(b"end_header\n") - 11, 114 * 9 * 4)
        self.assertEqual(len(csv), 114)
        for row in csv:
            self.assertAlmostEqual(math.hypot(*row[3:6]), 1.0, places=5)

    def test_texels_over_a_plane(self):
        self.write("plane.obj", quad_obj())
        summary = self.run_json("bake", "plane.obj", "-o", "plane.glb", "--texels", "24x16",
                                "--directions", 256)
        mesh = summary["transfer"]["meshes"][0]
        self.assertEqual((mesh["layout"], mesh["width"], mesh["height"]), ("texels", 24, 16))
        self.run_tool("shade", "plane.glb", "--light", "uniform", "-o", "plane.csv")
        self.assertEqual(len(read_csv(self.path("plane.csv"))), 24 * 16)

    def test_texels_on_a_layout_that_is_made_for_them(self):
        self.write("ball.obj", ball_obj(24, 12))
        self.write("tiled.obj", quad_obj(((0, 0), (4, 0), (4, -4), (0, -4))))
        options = ("--texels", "auto", "--texel-budget", 4096, "--directions", 64, "--bounces", 0)
        # Beside the coordinates that a mesh has, or as those that it has not.
        for scene, tex_coord in (("ball", 0), ("tiled", 1)):
            summary = self.run_json("bake", scene + ".obj", "-o", scene + ".glb", *options)
            (mesh,) = summary["transfer"]["meshes"]
            (layout,) = summary["texel_layout"]["meshes"]
            self.assertEqual((mesh["layout"], mesh["width"], mesh["height"], mesh["tex_coord"]),
                             ("texels", layout["size"], layout["size"], tex_coord))
            self.assertLessEqual(summary["texel_layout"]["texels"], 4096)
            # It is there for every way of looking, and for another bake.
            self.run_tool("shade", scene + ".glb", "--light", "uniform", "-o", "a.csv")
            self.assertGreater(len(read_csv(self.path("a.csv"))), layout["size"] ** 2 / 5)
            self.run_tool("render", scene + ".glb", "--light", "uniform", "-o", "cpu.exr",
                          "--backend", "cpu", "--size", "32x32")
            self.run_tool("bake", scene + ".glb", "-o", "again.glb", *options)
            validate = Path(__file__).parent.parent / "gltf" / "validate.mjs"
            subprocess.run(["node", validate, "--modules", GLTF_MODULES,
                            self.path(scene + ".glb")], check=True, capture_output=True)
        one = self.bake("ball.obj", "one.glb", *options, "--threads", 1).read_bytes()
        self.assertTrue(one == self.path("ball.glb").read_bytes())

    def test_glossy_has_matrices_and_its_lobe_is_free(self):
        summary = self.run_json(
            "bake", str(self.write("ball.obj", ball_obj())), "-o", "ball.glb", "--directions", 256,
            "--material", "glossy", "--albedo", 1, "--lobe", 8, "--transfer", "shadowed",
            "--bands", 5, "--glossy-bands", 3)
        mesh = summary["transfer"]["meshes"][0]
        self.assertEqual((mesh["matrix_out_bands"], mesh["matrix_in_bands"]), (3, 5))
        # As three bands have the lobes: softened until they do not ring, both are about as wide.
        shade = ("shade", "ball.glb", "--light", "disc:0,90,40", "--eye", "0,10,0",
                 "--window", "none")
        self.run_tool(*shade, "-o", "soft.csv")
        self.run_tool(*shade, "-o", "hard.csv", "--lobe", 40)
        soft, hard = (read_csv(self.path(n)) for n in ("soft.csv", "hard.csv"))
        self.assertGreater(hard[0][6], soft[0][6])  # the pole mirrors the light to the eye

    def test_a_mirror_records_no_transfer(self):
        self.write("ball.obj", ball_obj())
        self.run_tool("bake", "ball.obj", "-o", "ball.glb", "--material", "mirror", "--directions",
                      64, code=(0, 3))

    def test_a_ground_takes_the_shadow(self):
        summary = self.run_json("bake", str(self.write("ball.obj", ball_obj())), "-o", "ball.glb",
                                "--directions", 512, "--ground", "--transfer", "shadowed")
        names = [mesh["name"] for mesh in summary["transfer"]["meshes"]]
        self.assertEqual(names[1:], ["ground"])
        self.run_tool("shade", "ball.glb", "--light", "uniform", "-o", "ball.csv")
        ground = read_csv(self.path("ball.csv"))[114:]
        under = min(ground, key=lambda row: math.hypot(row[0], row[2]))
        corner = max(ground, key=lambda row: math.hypot(row[0], row[2]))
        self.assertAlmostEqual(under[1], -1.0, places=5)
        self.assertLess(under[6], 0.3 * corner[6])

    def test_a_threshold_ends_the_bounces(self):
        self.write("plane.obj", quad_obj())
        summary = self.run_json("bake", "plane.obj", "-o", "a.glb", "--directions", 256,
                                "--bounces", 50, "--energy-threshold", 0.01)
        self.assertLess(summary["transfer"]["bounces"], 50)

    def test_other_peoples_gltf_tools_do_not_object(self):
        self.write("plane.obj", quad_obj())
        self.bake()
        self.bake("plane.obj", "texels.glb", "--texels", "8x8", "--encoding", "float32")
        self.bake("ball.obj", "glossy.glb", "--material", "glossy", "--transfer", "shadowed")
        self.bake("ball.obj", "both.glb", "--material", "glossy", "--ground", "--keep-shadowed")
        result = subprocess.run(
            ["node", Path(__file__).parent.parent / "gltf/validate.mjs", "--modules", GLTF_MODULES,
             *(self.path(name + ".glb") for name in ("ball", "texels", "glossy", "both"))],
            capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)


class TransferChoice(ToolTest):
    """One asset, shown unshadowed, shadowed and interreflected."""

    SCENE = ("--ground", "--albedo", "0.8,0.5,0.3", "--encoding", "float32")
    LIGHT = ("--light", "disc:40,35,30,4+uniform:0.3")
    KINDS = ("unshadowed", "shadowed", "interreflected")

    def test_each_is_what_a_bake_of_that_kind_gives(self):
        for material in ("diffuse", "glossy"):
            scene = ("--material", material, *self.SCENE)
            self.bake("ball.obj", "all.glb", *scene, "--keep-shadowed")
            means = []
            for kind in self.KINDS:
                self.bake("ball.obj", "one.glb", *scene, "--transfer", kind)
                shade = (*self.LIGHT, "--eye", "0,3,9", "-o")
                self.run_tool("shade", "one.glb", *shade, "one.csv")
                self.run_tool("shade", "all.glb", *shade, "all.csv", "--transfer", kind)
                self.run_tool("compare", "one.csv", "all.csv", "--fail-above", "relative_rmse=1e-3")
                means.append(sum(row[6] for row in read_csv(self.path("all.csv"))))
            self.assertLess(means[1], 0.98 * means[0])
            self.assertLess(means[1], 0.99 * means[2])
            self.run_tool("shade", "all.glb", *shade, "best.csv")
            self.assertEqual(self.path("best.csv").read_bytes(), self.path("all.csv").read_bytes())

    def test_pictures_by_either_backend(self):
        self.bake("ball.obj", "all.glb", "--material", "glossy", *self.SCENE, "--keep-shadowed")
        for kind in self.KINDS:
            for backend in ("cpu", "gl"):
                self.run_tool("render", "all.glb", *self.LIGHT, "--size", "96x72", "--exposure", 0,
                              "-o", f"{kind}.{backend}.png", "--backend", backend, "--transfer", kind)
            self.run_tool("compare", f"{kind}.cpu.png", f"{kind}.gl.png", "--fail-above",
                          "difference=0.5")
        apart = self.run_json("compare", "shadowed.cpu.png", "unshadowed.cpu.png")
        self.assertGreater(apart["difference_lit"], 3)
        self.assertNotEqual(self.path("shadowed.gl.png").read_bytes(),
                            self.path("interreflected.gl.png").read_bytes())

    def test_the_suns_shadow_is_sharp_where_shadowed_transfer_is_kept(self):
        light = ("--light", "uniform:0.2+disc:40,30,0.53,20000", "--size", "96x72", "--exposure", 0)
        self.bake("ball.obj", "all.glb", *self.SCENE, "--keep-shadowed")
        for backend in ("cpu", "gl"):
            told = self.run_json("render", "all.glb", *light, "-o", f"{backend}.png", "--backend",
                                 backend)
            self.assertEqual(told["sun_shadow"], "sharp")
        self.run_tool("compare", "cpu.png", "gl.png", "--fail-above", "difference=0.5")
        told = self.run_json("render", "all.glb", *light, "-o", "soft.png", "--sun-shadow", "soft")
        self.assertIsNone(told["sun_shadow"])
        # Twice what the backends may be apart.
        apart = self.run_json("compare", "gl.png", "soft.png")
        self.assertGreater(apart["difference_lit"], 1)
        self.bake("ball.obj", "one.glb", *self.SCENE)
        self.assertIn("--keep-shadowed",
                      self.run_tool("render", "one.glb", *light, "-o", "one.png").stderr)

    def test_info_tells_what_is_kept(self):
        summary = self.run_json("bake", self.write("ball.obj", ball_obj()), "-o", "all.glb",
                                *self.SCENE, "--directions", 64, "--keep-shadowed")
        ball, ground = self.run_json("info", "all.glb")["transfer"]["meshes"]
        self.assertEqual([ball, ground], summary["transfer"]["meshes"])
        self.assertTrue(ball["shadowed"] and ground["shadowed"])
        self.assertEqual((ground["vector_channels"], ground["shadowed_vector_channels"]), (3, 1))
        self.assertIn("shadowed beside: vectors 1x25", self.run_tool("info", "all.glb").stdout)

    def test_what_was_not_kept_cannot_be_shown(self):
        self.bake()
        for verb, output in (("shade", "a.csv"), ("render", "a.png")):
            self.refused(verb, "ball.glb", "--light", "uniform", "-o", output, "--transfer",
                         "shadowed", code=USAGE,
                         says=("ball.glb", "no shadowed transfer", "unshadowed, interreflected",
                               "--keep-shadowed"))
        self.bake("ball.obj", "dark.glb", "--transfer", "shadowed")
        self.refused("shade", "dark.glb", "--light", "uniform", "-o", "a.csv", "--transfer",
                     "interreflected", code=USAGE, says="unshadowed, shadowed")
        self.refused("bake", "ball.obj", "-o", "c.glb", "--transfer", "shadowed",
                     "--keep-shadowed", code=USAGE, says="nothing to keep it beside")


class Light(ToolTest):
    def test_a_real_environment_map(self):
        summary = self.run_json("light", INPUTS / "hdri/venice.exr", "-o", "v.json")["light"]
        self.assertEqual(summary["coefficients"], 25)
        self.assertGreater(min(summary["mean_radiance"]), 0)

    def test_turning_moves_the_azimuth_and_keeps_the_mean(self):
        plain = self.run_json("light", "disc:20,30,10", "-o", "a.json")["light"]
        turned = self.run_json("light", "disc:20,30,10", "-o", "b.json", "--rotate-y", 50)["light"]
        self.assertAlmostEqual(plain["azimuth"], 20, places=2)
        self.assertAlmostEqual(plain["elevation"], 30, places=2)
        # Counter-clockwise seen from above takes +x towards -z: azimuth falls.
        self.assertAlmostEqual(turned["azimuth"], 20 - 50, places=2)
        self.assertAlmostEqual(turned["mean_radiance"][0], plain["mean_radiance"][0], places=6)

    def test_sums_add_up(self):
        parts = [self.run_json("light", source, "-o", "a.json")["light"]["mean_radiance"][0]
                 for source in ("uniform:0.25", "disc:0,90,60,3", "uniform:0.25+disc:0,90,60,3")]
        self.assertAlmostEqual(parts[0] + parts[1], parts[2], places=5)

    def test_a_light_goes_through_its_file_unchanged(self):
        self.bake("ball.obj", "ball.glb", "--encoding", "float32")
        self.run_tool("light", "disc:0,60,30,2", "-o", "l.json")
        for source, output in (("l.json", "a.csv"), ("disc:0,60,30,2", "b.csv")):
            self.run_tool("shade", "ball.glb", "--light", source, "-o", output)
        self.run_tool("compare", "a.csv", "b.csv", "--fail-above", "relative_rmse=1e-6")

    def test_minimal_window_keeps_radiance_from_falling_below_zero(self):
        lowest = [self.run_json("light", "disc:0,40,5,100", "-o", "a.json", "--window",
                                window)["light"]["lowest_luminance"]
                  for window in ("none", "minimal")]
        self.assertLess(lowest[0], -0.01)
        self.assertGreater(lowest[1], -1e-3)


class Info(ToolTest):
    def test_says_what_is_in_a_file(self):
        self.write("ball.obj", ball_obj())
        self.assertEqual(self.run_json("info", "ball.obj")["vertices"], 114)
        self.bake()
        asset = self.run_json("info", "ball.glb")
        self.assertEqual((asset["kind"], asset["transfer"]["bands"]), ("asset", 5))
        self.write("a.png", png(16, 8, lambda x, y: (255, 255, 255)))
        image = self.run_json("info", "a.png")
        self.assertEqual((image["kind"], image["width"], image["height"]), ("image", 16, 8))
        self.assertAlmostEqual(image["light"]["mean_radiance"][0], 1.0, places=4)
        self.run_tool("light", "uniform", "-o", "l.json", "--bands", 2)
        self.assertEqual(self.run_json("info", "l.json")["bands"], 2)
        self.run_tool("shade", "ball.glb", "--light", "uniform", "-o", "s.ply")
        self.assertEqual(self.run_json("info", "s.ply")["receivers"], 114)
        self.assertIn("114 vertices", self.run_tool("info", "ball.obj").stdout)

    def test_the_real_bunny(self):
        self.assertEqual(self.run_json("info", INPUTS / "bunny.obj")["vertices"], 34835)


class Compare(ToolTest):
    def test_metrics_of_pictures_worked_out_by_hand(self):
        self.write("a.png", png(8, 8, lambda x, y: (255, 255, 255)))
        self.write("b.png", png(8, 8, lambda x, y: (0, 0, 0)))
        summary = self.run_json("compare", "a.png", "b.png")
        self.assertAlmostEqual(summary["bias"], -1.0)
        self.assertAlmostEqual(summary["rmse"], 1.0)
        self.assertAlmostEqual(summary["relative_rmse"], 1.0)
        self.assertAlmostEqual(summary["relative_mse"], 1 / 1.01, places=6)
        self.assertAlmostEqual(summary["psnr"], 0.0)
        self.assertGreater(summary["flip"], 0.9)
        self.assertEqual((summary["difference"], summary["difference_lit"]), (255, 255))

    def test_steps_of_the_codes(self):
        self.write("a.png", png(8, 8, lambda x, y: (100 * (x < 2), 0, 0)))
        self.write("b.png", png(8, 8, lambda x, y: (106 * (x < 2), 3 * (x < 1), 0)))
        summary = self.run_json("compare", "a.png", "b.png")
        self.assertAlmostEqual(summary["difference"], (2 * 6 + 3) / 24)
        self.assertAlmostEqual(summary["difference_lit"], (2 * 6 + 3) / 6)
        self.assertEqual(summary["difference_largest"], 6)
        # Of the codes, as other programs have it: 16 reds are 6 apart and 8 greens 3.
        square = (16 * 36 + 8 * 9) / (3 * 64)
        self.assertAlmostEqual(summary["psnr"], 10 * math.log10(255 ** 2 / square), places=9)
        self.run_tool("compare", "a.png", "b.png", "--fail-above", "difference=0.7")
        self.run_tool("compare", "a.png", "b.png", "--fail-above", "difference_lit=0.7", code=FAILED)

    def test_equal_pictures(self):
        self.write("a.png", png(8, 8, lambda x, y: (9 * x, 9 * y, 77)))
        summary = self.run_json("compare", "a.png", "a.png")
        self.assertEqual((summary["rmse"], summary["flip"], summary["psnr"]), (0, 0, None))

    def test_fail_above_is_for_scripts(self):
        self.write("a.png", png(8, 8, lambda x, y: (200, 200, 200)))
        self.write("b.png", png(8, 8, lambda x, y: (180, 180, 180)))
        self.run_tool("compare", "a.png", "b.png", "--fail-above", "relative_rmse=0.9")
        result = self.run_tool("compare", "a.png", "b.png", "--fail-above", "relative_rmse=0.01",
                               code=FAILED)
        self.assertIn("relative_rmse", result.stderr)
        summary = self.run_json("compare", "a.png", "b.png", "--fail-above", "rmse=0", code=FAILED)
        self.assertEqual(summary["status"], "failed")
        self.assertGreater(summary["rmse"], 0)

    def test_strip_and_difference_are_pictures(self):
        self.write("a.png", png(8, 6, lambda x, y: (200, 200, 200)))
        self.write("b.png", png(8, 6, lambda x, y: (180, 180, 180)))
        self.run_tool("compare", "a.png", "b.png", "--strip", "s.png", "--diff", "d.png")
        strip, difference = (self.run_json("info", n) for n in ("s.png", "d.png"))
        self.assertEqual((strip["width"], strip["height"]), (3 * 8 + 2 * 4, 6))
        self.assertEqual((difference["width"], difference["height"]), (8, 6))


class Pictures(ToolTest):
    SIZE = ("--size", "96x72")
    LIGHT = ("--light", "disc:40,35,30,4+uniform:0.3")

    def test_gl_and_cpu_agree(self):
        self.bake("ball.obj", "ball.glb", "--albedo", "0.8,0.6,0.4")
        for backend in ("gl", "cpu"):
            self.run_tool("render", "ball.glb", *self.LIGHT, *self.SIZE, "-o", backend + ".png",
                          "--backend", backend, "--exposure", 0)
        self.run_tool("compare", "cpu.png", "gl.png", "--fail-above", "rmse=0.01")

    def test_air_of_the_lights_sky(self):
        self.bake("ball.obj", "ball.glb", "--albedo", "0.8,0.6,0.4")
        picture = ("render", "ball.glb", *self.SIZE, "--light")
        sky = "sky:sun-elevation=30,model=preetham"
        for backend in ("gl", "cpu"):
            self.run_tool(*picture, sky, "-o", backend + ".exr", "--backend", backend, "--air",
                          "--metres-per-unit", 3000)
        self.run_tool("compare", "cpu.exr", "gl.exr", "--fail-above", "relative_rmse=0.01")
        self.run_tool(*picture, sky, "-o", "none.exr", "--backend", "cpu")
        self.assertGreater(self.run_json("compare", "none.exr", "cpu.exr")["relative_rmse"], 0.05)
        self.refused(*picture, "uniform", "--air", "-o", "a.png", code=USAGE,
                     says=["--air", "'uniform'", "no sky"])
        for option in (("--metres-per-unit", 2), ("--shafts",)):
            self.refused(*picture, sky, *option, "-o", "a.png", code=USAGE, says=["--air"])

    def test_shafts_of_light(self):
        self.bake("ball.obj", "ball.glb", "--albedo", "0.8,0.6,0.4", "--keep-shadowed")
        air = ("--light", "sky:sun-elevation=30,model=preetham", "--air", "--metres-per-unit", 1000)
        picture = ("render", "ball.glb", *self.SIZE, *air)
        for backend in ("gl", "cpu"):
            self.run_tool(*picture, "-o", backend + ".exr", "--backend", backend, "--shafts",
                          "--background")
        self.run_tool("compare", "cpu.exr", "gl.exr", "--fail-above", "relative_rmse=0.03")
        self.refused(*picture, "-o", "a.png", "--shafts", "--sun-shadow", "soft", code=USAGE,
                     says=["shafts", "sharp"])

    def test_the_air_of_a_view(self):
        self.bake("ball.obj", "ball.glb", "--albedo", "0.8,0.6,0.4", "--keep-shadowed")
        sky = "sky:sun-elevation=30,model=preetham"
        picture = ("render", "ball.glb", *self.SIZE, "--backend", "cpu", "-o")

        def view(**members):
            self.write("view.json", json.dumps(
                {"lambent": "view", "environment": {"source": sky}, **members}))
            return ("--view", "view.json")

        air = {"metresPerUnit": 1000, "shafts": True}
        flags = ("--metres-per-unit", 1000, "--shafts")
        self.run_tool(*picture, "told.exr", "--light", sky, "--background", "--air", *flags)
        told = self.run_json(*picture, "kept.exr", *view(air=air))
        self.assertEqual((told["metres_per_unit"], told["shafts"]), (1000, True))
        self.run_tool(*picture, "over.exr", *view(air={}), *flags)
        self.run_tool(*picture, "both.exr", *view(), "--air", *flags)
        for other in ("kept.exr", "over.exr", "both.exr"):
            self.run_tool("compare", "told.exr", other, "--fail-above", "relative_rmse=1e-5")
        soft = self.run_json(*picture, "soft.exr", *view(air=air, sunShadow="soft"))
        self.assertFalse(soft["shafts"])
        self.assertIn("no-shafts", [each["code"] for each in soft["findings"]])
        self.refused(*picture, "a.exr", *view(air={}), "--light", "uniform", code=USAGE,
                     says=["--air", "no sky"])
        self.refused(*picture, "a.exr", *view(), "--shafts", code=USAGE, says=["--shafts", "--air"])

    def test_render_against_the_path_traced_truth(self):
        self.bake("ball.obj", "ball.glb", "--directions", 4096, "--encoding", "float32")
        self.run_tool("render", "ball.glb", *self.LIGHT, *self.SIZE, "-o", "ours.exr",
                      "--backend", "cpu")
        self.run_tool("reference", "ball.glb", *self.LIGHT, *self.SIZE, "-o", "truth.exr",
                      "--bands", 5, "--spp", 256)
        summary = self.run_json("compare", "truth.exr", "ours.exr", "--fail-above",
                                "beyond_noise=0.02", "--fail-above", "bias=0.01")
        self.assertGreater(summary["noise"], 0.0)
        self.assertLessEqual(summary["beyond_noise"], summary["relative_rmse"])

    def test_the_truth_through_air(self):
        self.bake("ball.obj", "ball.glb", "--directions", 4096, "--encoding", "float32",
                  "--keep-shadowed")
        sky = ("--light", "sky:sun-elevation=30,model=preetham")
        for extra in ((), ("--shafts",)):
            air = ("--background", "--air", "--metres-per-unit", 1000, *extra)
            self.run_tool("render", "ball.glb", *sky, *self.SIZE, "-o", "ours.exr", "--backend",
                          "cpu", *air)
            told = self.run_json("reference", "ball.glb", *sky, *self.SIZE, "-o", "truth.exr",
                                 "--spp", 64, *air)
            self.assertEqual((told["metres_per_unit"], told["shafts"]), (1000, bool(extra)))
            self.run_tool("compare", "truth.exr", "ours.exr", "--fail-above", "beyond_noise=0.05")
        self.run_tool("reference", "ball.glb", *sky, *self.SIZE, "-o", "clear.exr", "--spp", 16,
                      "--background")
        self.assertGreater(self.run_json("compare", "truth.exr", "clear.exr")["relative_rmse"], 0.1)
        self.refused("reference", "ball.glb", *sky, "--air", "-o", "a.csv", code=USAGE,
                     says=["--air", "viewer"])

    def test_the_truth_at_every_vertex(self):
        self.bake("ball.obj", "ball.glb", "--directions", 4096, "--encoding", "float32")
        self.run_tool("shade", "ball.glb", *self.LIGHT, "-o", "ours.csv")
        for output in ("truth.csv", "truth.ply"):
            self.run_tool("reference", "ball.glb", *self.LIGHT, "-o", output, "--bands", 5, "--spp",
                          1024)
        summary = self.run_json("compare", "truth.csv", "ours.csv", "--fail-above",
                                "beyond_noise=0.01", "--fail-above", "bias=0.01")
        self.assertEqual(summary["count"], 114)
        self.assertGreater(summary["noise"], 0)
        self.run_tool("compare", "truth.csv", "truth.ply", "--fail-above", "rmse=1e-6")

    def test_the_reference_has_a_layer_of_variance(self):
        self.write("ball.obj", ball_obj())
        self.run_tool("reference", "ball.obj", *self.LIGHT, *self.SIZE, "-o", "a.exr", "--spp", 4)
        self.assertIn(b"variance.R", self.path("a.exr").read_bytes()[:2000])

    def test_exposure_doubles_and_tone_curves_differ(self):
        self.bake()
        render = ("render", "ball.glb", *self.LIGHT, *self.SIZE, "--backend", "cpu")
        means = [sum(self.run_json(*render, "-o", f"{ev}.exr", "--exposure", ev)["picture"]["mean"])
                 for ev in (0, 1)]
        self.assertAlmostEqual(means[1] / means[0], 2.0, places=4)
        for tone in ("linear", "filmic"):
            self.run_tool(*render, "-o", tone + ".png", "--tone", tone)
        self.assertNotEqual(self.path("linear.png").read_bytes(),
                            self.path("filmic.png").read_bytes())

    def test_the_background_is_the_environment(self):
        self.bake()
        summary = self.run_json("render", "ball.glb", "--light", "uniform:3", *self.SIZE, "-o",
                                "a.exr", "--backend", "cpu", "--background")
        self.assertAlmostEqual(summary["picture"]["highest"][0], 3.0, places=3)
