"""The kinds of rows: each names a file of its folder, what is done with it, and the right value."""

import json
import math
import struct
from dataclasses import dataclass, field
from typing import Callable, Sequence

from harness import BAD_INPUT, ToolTest, read_csv

RAYS = ("--encoding", "float32", "--directions", "1024")


class Tool(ToolTest):
    def baked(self, scene: str, options: Sequence[str] = ()):
        """The asset and what the tool found in the scene, by code."""
        asset = scene.replace("/", "-") + ".glb"
        summary = self.run_json("bake", scene, "-o", asset, *RAYS, *options)
        return asset, {found["code"]: found for found in summary["findings"]}

    def shaded(self, asset: str, light: str):
        self.run_tool("shade", asset, "--light", light, "-o", "shaded.csv", "--quiet")
        return read_csv(self.path("shaded.csv"))

    def coefficients(self, source: str):
        """Of the light that a SOURCE is, in one row."""
        self.run_tool("light", source, "-o", "light.json", "--quiet")
        document = json.loads(self.path("light.json").read_text())
        return [value for three in document["coefficients"] for value in three]


def everywhere(_row) -> bool:
    return True


@dataclass
class Radiance:
    """The scene is baked and shaded under `light`: at every vertex `where(row)` holds of, `rgb`.
    A row is x, y, z, nx, ny, nz, r, g, b. `finds` are codes that the bake must report, `silent`
    those that it must not."""
    scene: str
    rgb: Sequence[float]
    where: Callable = everywhere
    light: str = "uniform"
    options: Sequence[str] = ()
    finds: Sequence[str] = ()
    silent: Sequence[str] = ()
    within: float = 5e-3

    def check(self, tool: Tool):
        asset, findings = tool.baked(self.scene, self.options)
        rows = [row for row in tool.shaded(asset, self.light) if self.where(row)]
        tool.assertTrue(rows, "no vertex is looked at")
        for row in rows:
            for got, right in zip(row[6:], self.rgb):
                tool.assertAlmostEqual(got, right, delta=self.within, msg=str(row))
        said(tool, findings, self.finds, self.silent)


@dataclass
class Findings:
    """`info` and `bake` report these codes (a loss each where `loss`), and not those of `silent`."""
    scene: str
    finds: Sequence[str]
    silent: Sequence[str] = ()
    loss: bool = False

    def check(self, tool: Tool):
        _, baked = tool.baked(self.scene)
        listed = {f["code"]: f for f in tool.run_json("info", self.scene)["findings"]}
        for findings in (baked, listed):
            said(tool, findings, self.finds, self.silent)
            for code in self.finds:
                tool.assertEqual(findings[code]["loss"], self.loss, code)
        if self.loss:
            refused = tool.run_tool("bake", self.scene, "-o", "strict.glb", "--strict",
                                    code=BAD_INPUT)
            tool.assertIn(self.finds[0], refused.stderr)


@dataclass
class Same:
    """Two scenes look alike: the relative RMSE of what their vertices, in sequence, send out."""
    scene: str
    other: str
    light: str = "disc:30,45,20,30"
    options: Sequence[str] = ()
    finds: Sequence[str] = ()
    within: float = 1e-4

    def check(self, tool: Tool):
        asset, findings = tool.baked(self.scene, self.options)
        a = tool.shaded(asset, self.light)
        b = tool.shaded(tool.baked(self.other, self.options)[0], self.light)
        tool.assertEqual(len(a), len(b))
        wrong = sum((x - y) ** 2 for p, q in zip(a, b) for x, y in zip(p[6:], q[6:]))
        whole = sum(y ** 2 for q in b for y in q[6:])
        tool.assertGreater(whole, 0.0)
        tool.assertLess(math.sqrt(wrong / whole), self.within)
        said(tool, findings, self.finds, ())


@dataclass
class Area:
    """The sum of the areas of the baked triangles, square metres."""
    scene: str
    area: float
    finds: Sequence[str] = ()

    def check(self, tool: Tool):
        asset, findings = tool.baked(self.scene)
        tool.assertAlmostEqual(area_of(tool.path(asset).read_bytes()), self.area,
                               delta=1e-5 * self.area)
        said(tool, findings, self.finds, ())


@dataclass
class Refused:
    """Exit 3, and the message says why."""
    scene: str
    says: Sequence[str]

    def check(self, tool: Tool):
        tool.refused("bake", self.scene, "-o", "refused.glb", says=self.says)


@dataclass
class Custom:
    """What no other row says: `test(tool)`."""
    what: str
    test: Callable = field(repr=False)

    def check(self, tool: Tool):
        self.test(tool)


@dataclass
class Light:
    """`light` makes of the SOURCE a light of this mean radiance, and reports these codes and no others."""
    source: str
    rgb: Sequence[float]
    finds: Sequence[str] = ()
    within: float = 2e-3

    def check(self, tool: Tool):
        summary = tool.run_json("light", self.source, "-o", "light.json")
        for got, right in zip(summary["light"]["mean_radiance"], self.rgb):
            tool.assertAlmostEqual(got, right, delta=self.within * max(self.rgb))
        tool.assertEqual({found["code"] for found in summary["findings"]}, set(self.finds))


@dataclass
class SameLight:
    """Two SOURCEs are the same light: the relative RMS difference of their coefficients."""
    source: str
    other: str
    within: float = 0.02

    def check(self, tool: Tool):
        a, b = (tool.coefficients(source) for source in (self.source, self.other))
        wrong = math.dist(a, b) / math.hypot(*b)
        tool.assertLess(wrong, self.within)
        # They have a direction: a constant light would be the same whichever way it lay.
        tool.assertGreater(math.hypot(*b[3:]), 0.1 * math.hypot(*b))


def said(tool: Tool, findings, finds, silent):
    for code in finds:
        tool.assertIn(code, findings)
    for code in silent:
        tool.assertNotIn(code, findings)


def area_of(glb: bytes) -> float:
    size, = struct.unpack_from("<I", glb, 12)
    document, binary = json.loads(glb[20:20 + size]), glb[28 + size:]

    def elements(index, letters):
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        form = f"<{accessor['count'] * width}{letters[accessor['componentType']]}"
        flat = struct.unpack_from(form, binary, view.get("byteOffset", 0))
        return [flat[i:i + width] for i in range(0, len(flat), width)]

    total = 0.0
    for mesh in document["meshes"]:
        primitive = mesh["primitives"][0]
        at = elements(primitive["attributes"]["POSITION"], {5126: "f"})
        corners = [i for i, in elements(primitive["indices"], {5123: "H", 5125: "I"})]
        for i in range(0, len(corners), 3):
            a, b, c = (at[k] for k in corners[i:i + 3])
            u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
            total += 0.5 * math.dist((u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                      u[0] * v[1] - u[1] * v[0]), (0, 0, 0))
    return total
