"""What the tool says about itself, and how it refuses what is wrongly asked."""

import json
import os
import pty
import subprocess

from harness import DONE, TOOL, USAGE, ToolTest, ball_obj

VERBS = ["bake", "light", "shade", "render", "reference", "compare", "rtt", "synthesize", "sky",
         "info"]


class Usage(ToolTest):
    def test_alone_it_tells_the_verbs(self):
        text = self.run_tool().stdout
        for verb in VERBS:
            self.assertIn(f"  {verb}", text)
        self.assertIn("lambent bake", text)

    def test_every_verb_has_help_with_an_example(self):
        for verb in VERBS:
            text = self.run_tool(verb, "--help").stdout
            self.assertIn("Usage: lambent " + verb, text)
            self.assertIn("Example", text)
            self.assertGreaterEqual(text.count("lambent " + verb), 3, verb)
            for line in text.splitlines():
                self.assertLessEqual(len(line), 100, line)

    def test_version(self):
        self.assertRegex(self.run_tool("--version").stdout, r"^lambent \d+\.\d+\.\d+\n$")

    def test_wrong_usage_exits_with_2(self):
        self.write("ball.obj", ball_obj())
        for args in (["paint", "x"], ["bake"], ["bake", "ball.obj"],
                     ["bake", "ball.obj", "-o", "a.glb", "--bands", "0"],
                     ["bake", "ball.obj", "-o", "a.glb", "--bands", "11"],
                     ["bake", "ball.obj", "-o", "a.glb", "--bands", "five"],
                     ["bake", "ball.obj", "-o", "a.glb", "--transfer", "magic"],
                     ["bake", "ball.obj", "-o", "a.glb", "--albedo", "1,2"],
                     ["bake", "ball.obj", "-o", "a.glb", "--albedo", "1.5"],
                     ["bake", "ball.obj", "-o", "a.glb", "--texels", "0x5"],
                     ["bake", "ball.obj", "-o", "a.glb", "--texels", "nobody=8x8"],
                     ["bake", "ball.obj", "-o", "a.glb", "--no-such-option"],
                     ["bake", "ball.obj", "-o", "a.obj"],
                     ["light", "uniform", "-o", "l.json", "--window", "square"],
                     ["light", "uniform", "-o", "l.json", "--window", "hann:-1"],
                     ["reference", "ball.obj", "--light", "uniform", "-o", "a.exr",
                      "--size", "10x"],
                     ["reference", "ball.obj", "--light", "uniform", "-o", "a.exr",
                      "--camera", "nobody"],
                     ["compare", "a.png"]):
            self.refused(*args, code=USAGE)

    def test_wrong_usage_points_to_the_help(self):
        result = self.refused("bake", "ball.obj", code=USAGE)
        self.assertIn("lambent bake --help", result.stderr)

    def test_the_output_may_not_replace_the_input(self):
        self.write("ball.obj", ball_obj())
        asset = self.bake()
        before = asset.read_bytes()
        self.refused("bake", "ball.glb", "-o", "ball.glb", code=USAGE, says="replace the input")
        self.assertEqual(asset.read_bytes(), before)

    def test_json_of_every_verb_parses(self):
        self.write("ball.obj", ball_obj())
        baked = self.run_json("bake", "ball.obj", "-o", "ball.glb", "--directions", 256)
        self.assertEqual(baked["status"], "done")
        self.assertEqual(baked["receivers"], 114)
        self.assertGreater(baked["rays"], 0)
        self.assertGreater(baked["bytes"], 0)
        self.assertTrue(any(stage["name"] == "write" for stage in baked["stages"]))
        light = self.run_json("light", "uniform:2", "-o", "l.json", "--bands", 3)
        self.assertEqual(light["light"]["coefficients"], 9)
        for got in light["light"]["mean_radiance"]:
            self.assertAlmostEqual(got, 2.0, places=5)
        shaded = self.run_json("shade", "ball.glb", "--light", "l.json", "-o", "ball.csv")
        self.assertEqual(shaded["receivers"], 114)
        small = ["--size", "32x32"]
        self.run_json("render", "ball.glb", "--light", "l.json", "-o", "a.exr", "--backend", "cpu",
                      *small)
        truth = self.run_json("reference", "ball.obj", "--light", "l.json", "-o", "b.exr",
                              "--spp", 4, *small)
        self.assertGreater(truth["estimated_relative_rmse"], 0)
        compared = self.run_json("compare", "b.exr", "a.exr")
        for metric in ("bias", "rmse", "relative_rmse", "relative_mse", "psnr", "flip"):
            self.assertIn(metric, compared)
        self.assertEqual(self.run_json("info", "ball.glb")["kind"], "asset")

    def test_json_of_a_failure_parses_too(self):
        result = self.run_tool("info", "nothing.glb", "--json", code=3)
        summary = json.loads(result.stdout)
        self.assertEqual((summary["status"], summary["exit_code"]), ("failed", 3))
        self.assertIn("nothing.glb", summary["error"]["message"])

    def test_quiet_says_nothing_and_a_pipe_gets_no_bar(self):
        self.write("ball.obj", ball_obj())
        quiet = self.run_tool("bake", "ball.obj", "-o", "a.glb", "--directions", 256, "--quiet")
        self.assertEqual(quiet.stderr, "")
        plain = self.run_tool("bake", "ball.obj", "-o", "a.glb", "--directions", 256)
        self.assertNotIn("\r", plain.stderr)
        self.assertNotIn("\033", plain.stderr)
        self.assertIn("Mrays/s", plain.stdout)

    def test_a_terminal_gets_a_bar(self):
        self.write("ball.obj", ball_obj(128, 64))
        terminal, tool_side = pty.openpty()
        process = subprocess.Popen([TOOL, "bake", "ball.obj", "-o", "a.glb"], cwd=self.dir,
                                   stdout=subprocess.DEVNULL, stderr=tool_side)
        os.close(tool_side)
        seen = b""
        try:
            while chunk := os.read(terminal, 65536):
                seen += chunk
        except OSError:  # how a terminal says that its other side is gone
            pass
        os.close(terminal)
        self.assertEqual(process.wait(), DONE)
        self.assertRegex(seen.decode(), r"\r.*\[#*\.*\] +\d+%  [\d.]+ M?k?rays/s  [\d.]+ s left")

    def test_help_is_no_error(self):
        self.assertEqual(self.run_tool("--help", code=DONE).stderr, "")
