"""A bake keeps what its source said, or names what it lost: whatever key a source has, its value is
in the asset, or a finding speaks of it."""

import math
import os
import subprocess
import unittest

from harness import ToolTest
from rich_scene import accessor_values, grid, read_glb, rich, Glb

NODE, VALIDATE, MODULES = (os.environ[name] for name in
                           ("LAMBENT_NODE", "LAMBENT_VALIDATE", "LAMBENT_GLTF_MODULES"))

# What is said in other words than the key's own, by the code of the finding.
SAID = {"doubleSided": "two-sided", "animations": "animations-ignored", "targets": "morph-targets",
        "weights": "morph-targets", "scenes": "scenes-ignored"}


class File:
    def __init__(self, data: bytes):
        self.json, self.binary = read_glb(data)
        self.nodes = {}  # of each name the first
        for node in self.json["nodes"]:
            self.nodes.setdefault(node.get("name"), node)

    def picture(self, texture):
        """All that a texture is: bytes of its image, its sampler, names and extras."""
        object = dict(self.json["textures"][texture])
        image = dict(self.json["images"][object.pop("source")])
        view = self.json["bufferViews"][image.pop("bufferView")]
        first = view.get("byteOffset", 0)
        sampler = object.pop("sampler", None)
        return {**object, "bytes": self.binary[first:first + view["byteLength"]], "image": image,
                "sampler": None if sampler is None else self.json["samplers"][sampler]}

    def primitives_of(self, material):
        return [p for mesh in self.json["meshes"] for p in mesh["primitives"]
                if p.get("material") == material]

    def looked_up(self, info, primitive):
        """Where a texture is looked up at the vertices."""
        transform = info.get("extensions", {}).get("KHR_texture_transform", {})
        texCoord = transform.get("texCoord", info.get("texCoord", 0))
        accessor = primitive["attributes"].get(f"TEXCOORD_{texCoord}")
        if accessor is None:
            return None
        (du, dv), (su, sv) = transform.get("offset", [0, 0]), transform.get("scale", [1, 1])
        c, s = math.cos(transform.get("rotation", 0)), math.sin(transform.get("rotation", 0))
        return [(du + c * su * u + s * sv * v, dv - s * su * u + c * sv * v)
                for u, v in accessor_values(self.json, self.binary, accessor)]

    def plain(self, value, primitive, key=""):
        """A material with textures as what they are, and coordinates as where they are."""
        if isinstance(value, list):
            return [self.plain(each, primitive) for each in value]
        if not isinstance(value, dict):
            return value
        if key.endswith("Texture") and "index" in value:
            rest = {k: v for k, v in value.items() if k not in ("index", "texCoord", "extensions")}
            return {**rest, "texture": self.picture(value["index"]),
                    "at": self.looked_up(value, primitive)}
        return {k: v if k == "extras" else self.plain(v, primitive, k) for k, v in value.items()}


class Kept(ToolTest):
    maxDiff = None

    def validate(self, *names):
        done = subprocess.run([NODE, VALIDATE, "--modules", MODULES, *map(self.path, names)],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def bake(self, glb, *options):
        self.write("in.glb", glb.bytes())
        report = self.run_json("bake", "in.glb", "-o", "out.glb", "--directions", "64", "--bounces",
                               "1", *options)
        return (File(self.path("in.glb").read_bytes()), File(self.path("out.glb").read_bytes()),
                report["findings"])

    def same(self, before, after, place, findings):
        """Every value of `before` is there, or something is said of it."""
        if isinstance(before, dict) and isinstance(after, dict):
            for key, value in before.items():
                if key in after or key == "extensions":
                    self.same(value, after.get(key, {}), f"{place}.{key}", findings)
                else:
                    self.assertTrue(self.is_said(key, findings), f"{place}.{key} is lost")
        elif isinstance(before, list) and isinstance(after, list) and place.endswith(".at"):
            for (u, v), (x, y) in zip(before, after):
                self.assertAlmostEqual(u, x, 5, place)
                self.assertAlmostEqual(v, y, 5, place)
        elif before != after:
            key = place.rsplit(".", 1)[-1]
            self.assertTrue(self.is_said(key, findings), f"{place}: {before} became {after}")

    def is_said(self, key, findings):
        return any(key in f["message"] or SAID.get(key) == f["code"] for f in findings)

    def same_materials(self, before, after, findings):
        for m, material in enumerate(before.json["materials"]):
            old, new = before.primitives_of(m), after.primitives_of(m)
            self.assertTrue(old and new, material["name"])
            self.same(before.plain(material, old[0]),
                      after.plain(after.json["materials"][m], new[0]), material["name"], findings)

    def test_everything_is_kept_or_named(self):
        before, after, findings = self.bake(rich(), "--refine", "off")
        self.validate("out.glb")
        codes = {f["code"] for f in findings}
        for named in ("animations-ignored", "morph-targets", "scenes-ignored",
                      "extension-KHR_lights_punctual", "extension-KHR_materials_clearcoat"):
            self.assertIn(named, codes)
        self.same_materials(before, after, findings)

        asset = after.json["asset"]
        self.assertEqual(asset["generator"], "Lambent (from: Some Modeller 4.2)")
        self.same({**before.json["asset"], "generator": asset["generator"]}, asset, "asset",
                  findings)
        self.assertEqual(after.json["scenes"][0]["name"], "Room")
        for key in ("extensions", "extras", "cameras"):
            self.same(before.json[key], after.json[key], key, findings)
        for key in before.json:
            if key not in after.json:
                self.assertTrue(self.is_said(key, findings), key)

        # The tree, and what stands at its nodes.
        def names(file, node):
            return [[file.json["nodes"][c].get("name"), names(file, file.json["nodes"][c])]
                    for c in node.get("children", [])]
        tree = names(after, {"children": after.json["scenes"][0]["nodes"]})
        self.assertEqual([name for name, _ in tree], ["Table", "Leaf", "Flat"])
        table = dict(tree[0][1])
        self.assertEqual([*table], ["Table", "Bowl", "Lamp", "View", "Marker"])
        self.assertEqual([name for name, _ in table["Bowl"]], ["Bowl/0", "Bowl/1", "Plate"])
        self.assertEqual(table["Marker"], [["Below", []]])
        for name, node in before.nodes.items():
            self.assertEqual(after.nodes[name].get("extras"), node.get("extras"), name)
        self.assertEqual(after.nodes["View"]["matrix"][12:15], [1, 1, 5])
        self.assertEqual(after.nodes["Lamp"]["matrix"][12:15], [1, 3, 0])
        self.assertEqual(after.nodes["Marker"]["matrix"][12:15], [1, 2, 0])
        self.assertEqual(after.nodes["Below"]["translation"], [0, 0, 1])
        lamps = [n for n in after.json["nodes"] if "KHR_lights_punctual" in n.get("extensions", {})]
        self.assertEqual([n["matrix"][12] for n in lamps], [1, 1])
        self.assertEqual(sum("camera" in n for n in after.json["nodes"]), 2)
        self.assertEqual([m["name"] for m in after.json["meshes"]],
                         ["bowl shape", "bowl shape", "plate", "leaf shape", "ground"])
        part = after.json["meshes"][0]["primitives"][0]
        self.assertEqual(part["extras"], {"part": "top"})
        self.assertEqual([m["material"] for m in
                          part["extensions"]["KHR_materials_variants"]["mappings"]], [1, 4])

    def same_attributes(self, before, after):
        old = before.json["meshes"][0]["primitives"][0]["attributes"]
        new = after.json["meshes"][0]["primitives"][0]["attributes"]
        for name in ("COLOR_1", "_TEMPERATURE", "_PART"):
            values = accessor_values(before.json, before.binary, old[name])
            got = accessor_values(after.json, after.binary, new[name])
            self.assertEqual(got[:len(values)], values, name)
            self.assertEqual(after.json["accessors"][new[name]]["componentType"],
                             before.json["accessors"][old[name]]["componentType"], name)
        tangents = accessor_values(after.json, after.binary, new["TANGENT"])
        for x, y, z, w in tangents:  # turned by a quarter about +y
            self.assertAlmostEqual(abs(z), 1.0, 5)
            self.assertEqual(w, 1.0)
        return len(tangents)

    def test_attributes_of_vertices(self):
        before, after, _ = self.bake(rich(), "--refine", "off")
        self.assertEqual(self.same_attributes(before, after), 9)

    def test_attributes_where_the_mesh_is_cut_and_laid_out(self):
        before, after, findings = self.bake(rich(), "--refine", "0.0005")
        self.validate("out.glb")
        self.same_attributes(before, after)
        self.same_materials(before, after, findings)
        before, after, findings = self.bake(rich(), "--texels", "auto", "--refine", "0.1")
        self.validate("out.glb")
        self.same_materials(before, after, findings)

    def test_an_asset_that_is_written_again(self):
        _, once, _ = self.bake(rich(), "--refine", "off")
        self.run_tool("bake", "out.glb", "-o", "again.glb", "--directions", "64", "--bounces", "1",
                      "--refine", "off", "--quiet")
        self.assertEqual(self.path("again.glb").read_bytes(), self.path("out.glb").read_bytes())
        self.run_tool("bake", "out.glb", "-o", "grey.glb", "--directions", "64", "--material",
                      "diffuse", "--albedo", "0.5,0.5,0.5", "--refine", "off", "--quiet")
        self.validate("grey.glb")
        grey = File(self.path("grey.glb").read_bytes())
        glaze = grey.json["materials"][0]
        self.assertEqual(glaze["pbrMetallicRoughness"]["metallicFactor"], 0)
        self.assertNotIn("metallicRoughnessTexture", glaze["pbrMetallicRoughness"])
        self.assertNotIn("KHR_materials_clearcoat", glaze["extensions"])
        self.assertIn("normalTexture", glaze)
        self.assertEqual(grey.json["asset"], once.json["asset"])

    def test_a_patch_over_it(self):
        self.run_tool("rtt", "stucco", "-o", "s.rtt", "--positions", "8x8", "--views", "2", "--bands",
                      "2", "--bounces", "0", "--directions", "16", "--quiet")
        self.write("in.glb", rich().bytes())
        self.run_tool("synthesize", "in.glb", "--rtt", "s.rtt", "-o", "out.glb", "--mesh", "Leaf",
                      "--directions", "64", "--vertices", "4000", "--map-size", "64", "--quiet")
        self.validate("out.glb")
        after = File(self.path("out.glb").read_bytes())
        self.assertEqual(after.json["asset"]["copyright"], "© 2024 A Museum")
        self.assertEqual(after.json["asset"]["extras"]["license"], "CC-BY-4.0")
        self.assertIn("Marker", after.nodes)

    def test_keys_that_nobody_knows(self):
        glb = rich()
        document = glb.json
        document["asset"]["futureOfAsset"] = {"a": [1, 2]}
        document["futureOfDocument"] = 1
        for material in document["materials"]:
            material["futureOfMaterial"] = {"deep": [{"x": 1}]}
            material.setdefault("extensions", {})["VENDOR_gloss"] = {"glossTexture": {"index": 2}}
            material["extensions"]["KHR_materials_future"] = {
                "futureFactor": 0.3, "futureTexture": {"index": 2, "texCoord": 1}}
            material["pbrMetallicRoughness"]["futureFactor"] = 0.25
        for node in document["nodes"]:
            node["futureOfNode"] = "n"
            node.setdefault("extensions", {})["VENDOR_node"] = {"mesh": 3}
        before, after, findings = self.bake(glb, "--refine", "off")
        self.same_materials(before, after, findings)
        asset = {**document["asset"], "generator": after.json["asset"]["generator"]}
        self.same(asset, after.json["asset"], "asset", findings)
        for key in document:
            self.assertTrue(key in after.json or self.is_said(key, findings), key)
        for name, node in before.nodes.items():
            self.same({k: v for k, v in node.items() if k.startswith("f") or k == "extensions"},
                      after.nodes[name], name, findings if name != "Table" else
                      [*findings, {"code": "", "message": "KHR_lights_punctual"}])
        self.assertNotIn("VENDOR_gloss", str(after.json["materials"]))

    def test_pictures_that_are_not_there(self):
        glb = rich()
        document = glb.json
        document["images"][2] = {"uri": "gone.png"}
        document["images"][1] = {"uri": "../outside.png"}
        document["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"]["index"] = 99
        _, after, findings = self.bake(glb, "--refine", "off")
        self.validate("out.glb")
        self.assertIn("picture-lost", {f["code"] for f in findings if f["loss"]})
        glaze = after.json["materials"][0]
        self.assertNotIn("normalTexture", glaze)
        self.assertNotIn("metallicRoughnessTexture", glaze["pbrMetallicRoughness"])
        self.assertIn("occlusionTexture", glaze)

    def test_losses_are_errors_where_they_must_not_be(self):
        glb = Glb()
        attributes, indices = grid(glb, two_sets=False)
        glb.json = {**{k: v for k, v in glb.json.items() if v}, "asset": {"version": "2.0"},
                    "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "materials": [
                        {"normalTexture": {"index": 0}}],
                    "meshes": [{"primitives": [{"attributes": attributes, "indices": indices}]}]}
        glb.json["meshes"][0]["primitives"][0]["attributes"]["WHAT"] = attributes["NORMAL"]
        self.write("in.glb", glb.bytes())
        self.refused("bake", "in.glb", "-o", "out.glb", "--strict", says="picture-lost")
        del glb.json["materials"]
        self.write("in.glb", glb.bytes())
        self.refused("bake", "in.glb", "-o", "out.glb", "--strict", says="attributes-lost")

    def test_what_info_tells(self):
        self.write("in.glb", rich().bytes())
        told = self.run_json("info", "in.glb")
        self.assertEqual(told["copyright"], "© 2024 A Museum")
        self.assertEqual(told["generator"], "Some Modeller 4.2")
        self.assertEqual(told["name"], "Room")
        self.assertEqual(told["asset_extras"]["license"], "CC-BY-4.0")
        self.assertIn("© 2024 A Museum", self.run_tool("info", "in.glb").stdout)

    def test_roughness_of_other_formats(self):
        self.write("in.obj", "mtllib in.mtl\nusemtl clay\nv 0 0 0\nv 0 0 1\nv 1 0 0\nf 1 2 3\n")
        self.write("in.mtl", "newmtl clay\nKd 0.5 0.4 0.3\nPr 0.5\n")
        self.run_tool("bake", "in.obj", "-o", "out.glb", "--directions", "64", "--quiet")
        self.validate("out.glb")
        document, _ = read_glb(self.path("out.glb").read_bytes())
        self.assertEqual(document["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"], 0.5)


if __name__ == "__main__":
    unittest.main()
