"""Between receivers: what `bake` and `synthesize` say of shadows that fall there, and `--refine`."""

from harness import USAGE, ToolTest, ball_obj, quad_obj, read_csv

FLOOR = """o floor
v -3 0 -3
v -3 0 3
v 3 0 3
v 3 0 -3
f 1 2 3 4
o box
v -.5 0 -.5
v -.5 0 .5
v .5 0 .5
v .5 0 -.5
v -.5 1 -.5
v -.5 1 .5
v .5 1 .5
v .5 1 -.5
s off
f 8 7 6 5
f 5 6 10 9
f 6 7 11 10
f 7 8 12 11
f 8 5 9 12
f 9 10 11 12
"""


class Refine(ToolTest):
    def setUp(self):
        super().setUp()
        self.write("floor.obj", FLOOR)

    def baked(self, *options, scene="floor.obj", output="a.glb"):
        return self.run_json("bake", scene, "-o", output, "--directions", 256, *options)

    def codes(self, summary):
        return {found["code"] for found in summary["findings"]}

    def test_large_triangles_are_cut_or_said(self):
        coarse = self.baked("--refine", "off")
        self.assertIn("coarse-receivers", self.codes(coarse))
        self.assertEqual(coarse["between_receivers"]["worst_mesh"], "floor")
        fine = self.baked()
        self.assertNotIn("coarse-receivers", self.codes(fine))
        self.assertIn("triangles-cut", self.codes(fine))
        between = fine["between_receivers"]
        self.assertEqual(fine["receivers"], coarse["receivers"] + between["vertices_added"])
        self.assertAlmostEqual(between["rms_before"], coarse["between_receivers"]["rms"])
        self.assertLess(between["rms"], 0.25 * between["rms_before"])

    def test_receivers_depend_on_the_scene_alone(self):
        counts = {self.baked(*options)["receivers"]
                  for options in ((), ("--transfer", "unshadowed"), ("--transfer", "shadowed"),
                                  ("--bands", 3), ("--seed", 5))}
        self.assertEqual(len(counts), 1, counts)

    def test_asked_for_it_is_done_to_any_scene_and_to_any_error(self):
        few, many = (self.baked(f"--refine={error}")["receivers"] for error in (0.1, 0.01))
        self.assertLess(1.5 * few, many)

    def test_what_is_open_stays_as_it_is(self):
        for scene, text in (("ball.obj", ball_obj()), ("quad.obj", quad_obj())):
            self.write(scene, text)
            plain = self.baked(scene=scene, output="plain.glb")
            self.assertNotIn("coarse-receivers", self.codes(plain))
            self.baked("--refine", "0.05", scene=scene, output="refined.glb")
            self.assertEqual(self.path("plain.glb").read_bytes(),
                             self.path("refined.glb").read_bytes())

    def test_the_same_bytes_whatever_the_threads(self):
        for threads in (1, 3):
            self.baked("--refine=0.05", "--threads", threads, output=f"{threads}.glb")
        self.assertEqual(self.path("1.glb").read_bytes(), self.path("3.glb").read_bytes())

    def test_a_budget_is_kept_and_said(self):
        summary = self.baked("--refine", "0.01", "--refine-budget", 200)
        self.assertIn("refine-budget", self.codes(summary))
        self.assertLessEqual(summary["between_receivers"]["vertices_added"], 200)
        none = self.baked("--refine", "--refine-budget", 0)
        self.assertEqual(none["receivers"], self.baked("--refine", "off")["receivers"])

    def test_a_mesh_of_texels_is_none_of_it(self):
        self.write("quad.obj", quad_obj())
        summary = self.baked("--texels", "8x8", "--refine", scene="quad.obj")
        self.assertEqual(summary["receivers"], 64)
        self.assertIsNone(summary["between_receivers"])

    def test_what_carries_a_patch_gets_its_shadows(self):
        self.run_tool("rtt", "stucco", "-o", "patch.rtt", "--positions", "16x16", "--views", 1, "--bands", 3,
                      "--directions", 64, "--bounces", 1, "--quiet")

        def spread(*options):
            return self.run_json("synthesize", "floor.obj", "--rtt", "patch.rtt", "-o", "a.glb",
                                 "--patch-width", 6, "--map-size", 128, "--vertices", 4000,
                                 "--directions", 128, *options)

        coarse, fine = spread("--refine=off"), spread()
        said, = (f for f in coarse["findings"] if f["code"] == "coarse-receivers")
        self.assertNotIn("--texels", said["message"])
        self.assertIn("triangles-cut", self.codes(fine))
        self.assertLess(fine["between_receivers"]["rms"], 0.5 * coarse["between_receivers"]["rms"])
        self.assertIsNone(spread("--preview")["between_receivers"])

    def test_wrong_usage_is_said(self):
        for options, says in ((("--refine", "0"), "0.0001"), (("--refine", "nan"), "--refine"),
                              (("--refine-budget", "-1"), "--refine-budget")):
            self.refused("bake", "floor.obj", "-o", "a.glb", *options, code=USAGE, says=says)
        self.refused("bake", "--refine", "floor.obj", "-o", "a.glb", code=USAGE,
                     says="--refine=ERROR")

    def test_the_floor_is_dark_beside_the_box_and_bright_far_away(self):
        self.baked("--bounces", 0)
        self.run_tool("shade", "a.glb", "--light", "uniform", "-o", "a.csv", "--quiet")
        floor = [row for row in read_csv(self.path("a.csv")) if row[1] == 0 and row[4] > 0.9]
        beside = [row[6] for row in floor if 0.55 < row[0] < 0.65 and abs(row[2]) < 0.3]
        self.assertTrue(beside)
        # Half of the sky is behind a wall of 1 x 1 m at a tenth of a metre: 0.8 of (1 + 0.1)/2.
        for radiance in beside:
            self.assertLess(abs(radiance - 0.8 * 0.6), 0.06)
        for row in floor:
            if abs(row[0]) == 3 and abs(row[2]) == 3:
                self.assertGreater(row[6], 0.78)
