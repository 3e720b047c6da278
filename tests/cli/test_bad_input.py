"""Everything that can be wrong with a file: a clear message, exit code 3, nothing half-written."""

import json
import math
import struct

from harness import (BAD_INPUT, INPUTS, USAGE, ToolTest, ball, ball_obj, glb, gltf_parts, hdr, ply,
                     png, quad_obj)

OUT = ("-o", "out.glb", "--directions", 64, "--quiet")


class BadScene(ToolTest):
    def refused_scene(self, name, content, says=()):
        if content is not None:
            self.write(name, content)
        words = [says] if isinstance(says, str) else list(says)
        self.refused("bake", name, *OUT, says=[name, *words])

    def findings_of(self, name, content):
        self.write(name, content)
        summary = self.run_json("bake", name, "-o", "out.glb", "--directions", 64)
        return {finding["code"]: finding for finding in summary["findings"]}

    def test_missing_file(self):
        self.refused_scene("nothing.obj", None)

    def test_unknown_extension(self):
        self.refused_scene("scene.fbx", "x", says=".glb")

    def test_a_folder_instead_of_a_file(self):
        self.path("folder.obj").mkdir()
        self.refused("bake", "folder.obj", *OUT, says="folder.obj")

    def test_empty_file(self):
        for extension in ("obj", "ply", "glb", "gltf"):
            self.refused_scene("empty." + extension, b"")

    def test_empty_mesh(self):
        self.refused_scene("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")
        self.refused_scene("empty.ply", ply([(0, 0, 0)], []))
        self.refused_scene("empty.gltf", '{"asset": {"version": "2.0"}}')

    def test_nan_and_infinite_positions(self):
        for bad in (math.nan, math.inf, -math.inf):
            vertices, triangles = ball()
            vertices[5] = (0.0, bad, 0.0)
            self.refused_scene("bad.ply", ply(vertices, triangles), says="5")
            self.refused_scene("bad.glb", glb(*gltf_parts(vertices, triangles)))
        self.refused_scene("bad.obj", ball_obj().replace("v 0.0 1.0 0.0", "v 0.0 nan 0.0"))

    def test_indices_out_of_range(self):
        vertices, triangles = ball()
        triangles[3] = (0, 1, 9999)
        self.refused_scene("bad.ply", ply(vertices, triangles), says="9999")
        self.refused_scene("bad.glb", glb(*gltf_parts(vertices, triangles)), says="9999")
        self.refused_scene("bad.obj", ball_obj() + "f 1//1 2//2 9999//1\n", says="9999")

    def test_accessor_that_reads_beyond_its_buffer(self):
        document, buffer = gltf_parts(*ball(), index_count=10**9)
        self.refused_scene("bad.glb", glb(document, buffer))
        document, buffer = gltf_parts(*ball())
        document["bufferViews"][1]["byteOffset"] = 2**40
        self.refused_scene("bad.glb", glb(document, buffer))
        document, buffer = gltf_parts(*ball())
        document["accessors"][0]["count"] = 2**62
        self.refused_scene("bad.glb", glb(document, buffer))

    def test_truncated_glb(self):
        whole = glb(*gltf_parts(*ball()))
        for size in (3, 11, 12, 19, 100, len(whole) // 2, len(whole) - 1):
            self.refused_scene("cut.glb", whole[:size])

    def test_hostile_glb(self):
        whole = bytearray(glb(*gltf_parts(*ball())))
        struct.pack_into("<I", whole, 12, 0xFFFFFFF0)  # the length of the JSON chunk
        self.refused_scene("hostile.glb", bytes(whole))
        self.refused_scene("deep.gltf", "[" * 200000)
        self.refused_scene("list.gltf", "[1, 2, 3]")
        document, buffer = gltf_parts(*ball())
        document["nodes"][0]["children"] = [0]  # its own child
        self.refused_scene("circle.glb", glb(document, buffer))
        document, buffer = gltf_parts(*ball())
        document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -7
        self.refused_scene("negative.glb", glb(document, buffer))

    def test_gltf_whose_buffer_is_missing(self):
        document, _ = gltf_parts(*ball())
        document["buffers"][0]["uri"] = "nowhere.bin"
        self.refused_scene("scene.gltf", json.dumps(document), says="nowhere.bin")

    def test_truncated_ply(self):
        whole = ply(*ball())
        for size in (2, 30, whole.index(b"end_header") + 11, len(whole) // 2, len(whole) - 1):
            self.refused_scene("cut.ply", whole[:size])
        text = ply(*ball(), binary=False)
        self.refused_scene("cut.ply", text[:len(text) // 2])

    def test_hostile_ply(self):
        vertices, triangles = ball()
        for count in (2**32 - 1, 2**63, 10**30, -1):
            self.refused_scene("hostile.ply", ply(vertices, triangles, count=count))
        self.refused_scene("hostile.ply", b"ply\nformat binary_middle_endian 1.0\nend_header\n")

    def test_degenerate_triangles_are_kept_out_and_counted(self):
        vertices, triangles = ball()
        triangles += [(1, 1, 2), (3, 4, 4)]
        found = self.findings_of("odd.ply", ply(vertices, triangles))["degenerate-triangles"]
        self.assertEqual(found["count"], 2)
        self.assertEqual(self.run_json("info", "out.glb")["triangles"], len(triangles) - 2)

    def test_nothing_but_degenerate_triangles(self):
        self.refused_scene("flat.ply", ply([(0, 0, 0), (1, 0, 0), (2, 0, 0)], [(0, 1, 2)]))

    def test_missing_normals_are_made_and_said(self):
        found = self.findings_of("bare.obj", ball_obj(normals=False))
        self.assertIn("normals-made", found)

    def test_flipped_normals_are_said(self):
        text = "\n".join("vn " + " ".join(str(-float(c)) for c in line.split()[1:])
                         if line.startswith("vn") else line for line in ball_obj().splitlines())
        found = self.findings_of("flipped.obj", text)
        self.assertTrue({"normals-flipped", "winding-reversed", "inside-out"} & set(found), found)

    def test_zero_normals_are_said(self):
        text = ball_obj().replace("vn 0.0 1.0 0.0", "vn 0 0 0")
        self.assertIn("zero-normals", self.findings_of("zero.obj", text))

    def test_overlapping_uvs_where_texels_are_asked_for(self):
        self.write("plane.obj", quad_obj(((0, 0), (1, 0), (1, 1), (1, 0))))
        self.refused("bake", "plane.obj", *OUT, "--texels", "16x16", says=["plane.obj", "overlap"])

    def test_missing_uvs_where_texels_are_asked_for(self):
        self.write("ball.obj", ball_obj())
        self.refused("bake", "ball.obj", *OUT, "--texels", "0=16x16",
                     says=["ball.obj", "texture coordinates"])

    def test_a_plain_glb_is_no_asset(self):
        self.write("plain.glb", glb(*gltf_parts(*ball())))
        self.refused("render", "plain.glb", "--light", "uniform", "-o", "a.png",
                     says=["plain.glb", "bake"])

    def test_truncated_asset(self):
        whole = self.bake().read_bytes()
        self.path("ball.glb").unlink()
        for size in (11, len(whole) // 3, len(whole) - 4):
            self.write("cut.glb", whole[:size])
            self.refused("shade", "cut.glb", "--light", "uniform", "-o", "a.csv", says="cut.glb")


class BadLight(ToolTest):
    def refused_light(self, name, content=None, says=()):
        if content is not None:
            self.write(name, content)
        words = [says] if isinstance(says, str) else list(says)
        self.refused("light", name, "-o", "out.json", says=[name, *words])

    def test_missing_image(self):
        self.refused_light("nothing.exr")

    def test_truncated_exr(self):
        whole = (INPUTS / "hdri" / "sky.exr").read_bytes()
        for size in (0, 3, 60, 400, len(whole) // 2, len(whole) - 200):
            self.refused_light("cut.exr", whole[:size])

    def test_hostile_exr(self):
        whole = (INPUTS / "hdri" / "sky.exr").read_bytes()
        window = whole.index(b"dataWindow\0box2i\0") + len(b"dataWindow\0box2i\0") + 4
        huge = whole[:window] + struct.pack("<4i", 0, 0, 2**30, 2**30) + whole[window + 16:]
        self.refused_light("huge.exr", huge)
        inverted = whole[:window] + struct.pack("<4i", 10, 10, -10, -10) + whole[window + 16:]
        self.refused_light("inverted.exr", inverted)

    def test_truncated_hdr(self):
        whole = hdr(64, 32)
        for size in (0, 5, 30, len(whole) // 2):
            self.refused_light("cut.hdr", whole[:size])

    def test_hostile_hdr(self):
        self.refused_light("huge.hdr", hdr(4, 2).replace(b"-Y 2 +X 4", b"-Y 2000000000 +X 2000000000"))
        self.refused_light("negative.hdr", hdr(4, 2).replace(b"-Y 2 +X 4", b"-Y -2 +X -4"))

    def test_truncated_png(self):
        whole = png(64, 32, lambda x, y: (x, y, 7))
        for size in (0, 7, 30, len(whole) // 2):
            self.refused_light("cut.png", whole[:size])

    def test_text_that_is_no_image(self):
        for extension in ("exr", "hdr", "png"):
            self.refused_light("text." + extension, "this is not a picture")

    def test_damaged_light_json(self):
        self.refused_light("cut.json", '{"lambent": "light", "bands": 3, "coeff')
        self.refused_light("other.json", '{"hello": 1}')
        self.refused_light("few.json",
                           '{"lambent": "light", "bands": 3, "coefficients": [[1, 1, 1]]}')
        self.refused_light("nan.json",
                           '{"lambent": "light", "bands": 1, "coefficients": [[1, "x", 1]]}')

    def test_a_source_that_is_none(self):
        for source in ("disc:1,2", "uniform:bright", "lamp", "uniform+", "disc:0,0,nan"):
            self.refused("light", source, "-o", "out.json", code=(USAGE, BAD_INPUT))


    def test_damaged_atmospheres(self):
        for name, text in (("cut.json", '{"lambent": "atmosphere", "ozone_dobson"'), ("list.json", "[]"),
                           ("light.json", '{"lambent": "light"}'),
                           ("key.json", '{"lambent": "atmosphere", "haze": 3}'),
                           ("range.json", '{"lambent": "atmosphere", "top_km": -1}')):
            self.write(name, text)
            self.refused("light", f"sky:sun-elevation=30,model=preetham,atmosphere={name}", "-o",
                         "out.json", code=BAD_INPUT, says=name)


class BadPicture(ToolTest):
    def test_pictures_of_different_size(self):
        self.write("a.png", png(8, 8, lambda x, y: (x, y, 0)))
        self.write("b.png", png(9, 8, lambda x, y: (x, y, 0)))
        self.refused("compare", "a.png", "b.png", says=["8x8", "9x8"])

    def test_receivers_of_another_bake(self):
        self.write("a.csv", "x,y,z,nx,ny,nz,r,g,b\n0,0,0,0,1,0,1,1,1\n")
        self.write("b.csv", "x,y,z,nx,ny,nz,r,g,b\n")
        self.refused("compare", "a.csv", "b.csv", says=["a.csv", "b.csv"])

    def test_damaged_receivers(self):
        self.write("a.csv", "x,y,z,nx,ny,nz,r,g,b\n0,0,0,0,1,0,1,1,1\n")
        self.write("b.csv", "x,y,z,nx,ny,nz,r,g,b\n0,0,0,0,1,0,1,one,1\n")
        self.refused("compare", "a.csv", "b.csv", says=["b.csv", "line 2", "column 8"])
        self.write("c.ply", ply(*ball()))
        self.write("d.ply", ply(*ball()))
        self.refused("compare", "c.ply", "d.ply", says="c.ply")
