"""One scene in every format and compression: the same light leaves the same places."""

import math
import os
import subprocess
import unittest

from harness import ToolTest, read_csv

LOSSLESS = ("scene.gltf", "webp.glb", "draco-sequential.glb", "draco-edgebreaker.glb",
            "meshopt.gltf", "scene.obj", "scene.ply")


class Formats(ToolTest):
    def setUp(self):
        super().setUp()
        subprocess.run([os.environ["LAMBENT_WRITE_FORMATS"], self.dir], check=True)

    def shaded(self, scene):
        """Radiance by place and normal."""
        # The file's own vertices: where triangles are cut depends on the sequence that they come in.
        found = self.run_json("bake", scene, "-o", "out.glb", "--encoding", "float32", "--refine",
                              "off", "--directions", "16384", "--bounces", "1")["findings"]
        self.assertFalse([f["code"] for f in found if f["loss"]], scene)
        self.run_tool("shade", "out.glb", "--light", "disc:30,45,20,30", "-o", "out.csv", "--quiet")
        return [(row[:6], row[6:]) for row in read_csv(self.path("out.csv"))]

    def compare(self, scene, plain, places, radiance):
        """Each vertex with the plain one that is nearest in place and normal. A ray along an edge may
        fall to either side where a position was rounded otherwise: it is one of thousands."""
        rows = self.shaded(scene)
        self.assertEqual(len(rows), len(plain), scene)
        brightest = max(max(color) for _, color in plain)
        for place, color in rows:
            if place[4] > 0.9 and place[1] < 0.1 and max(abs(place[0]), abs(place[2])) < 0.49:
                continue  # under the box: nobody sees what is extrapolated there
            nearest, right = min(plain, key=lambda row: math.dist(row[0], place))
            self.assertLess(math.dist(nearest, place), places, scene)
            for got, expected in zip(color, right):
                self.assertLess(abs(got - expected), radiance * brightest, (scene, place))

    def test_same_radiance_at_the_same_places(self):
        plain = self.shaded("plain.glb")
        self.assertGreater(max(max(color) for _, color in plain), 0.1)
        for scene in LOSSLESS:
            with self.subTest(scene):
                self.compare(scene, plain, 1e-5, 1e-3)
        # 16 bits over 4 m, 8 bits of a normal.
        self.compare("quantized.gltf", plain, 1e-2, 2e-2)


if __name__ == "__main__":
    unittest.main()
