"""Files that do harm (tests/hostile): a message in a moment, whatever they ask for."""

import base64
import json
import os
import shutil
import struct
import subprocess
import zlib
from pathlib import Path

from harness import BAD_INPUT, DONE, TOOL, ToolTest, ball, glb, gltf_parts

FILES = Path(__file__).resolve().parent.parent / "hostile"
# What these would take unbounded is minutes; a machine that others use is half as fast as it was.
MOST_SECONDS, MOST_BYTES = 20.0, 1.5e9


def png_chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def black_png(width, height):
    """1 bit a pixel, all 0: as small as PNG gets."""
    deflate = zlib.compressobj(9)
    row = b"\0" * (1 + (width + 7) // 8)
    packed = b"".join(deflate.compress(row) for _ in range(height)) + deflate.flush()
    return (b"\x89PNG\r\n\x1a\n" +
            png_chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 1, 0, 0, 0, 0)) +
            png_chunk(b"IDAT", packed) + png_chunk(b"IEND", b""))


class Hostile(ToolTest):
    def take(self, *names):
        for name in names:
            shutil.copy(FILES / name, self.dir)

    def run_cheaply(self, *args, code=BAD_INPUT, says=()):
        """Asserts the exit code, the words of the message, and what it cost."""
        with open(self.path("stderr.txt"), "w+") as errors:
            process = subprocess.Popen([TOOL, *map(str, args)], cwd=self.dir,
                                       stdout=subprocess.DEVNULL, stderr=errors)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            errors.seek(0)
            message = errors.read()
        self.assertEqual(process.returncode, code, message[-2000:])
        for words in [says] if isinstance(says, str) else says:
            self.assertIn(words, message)
        self.assertLess(len(message), 2000)
        self.assertLess(usage.ru_utime + usage.ru_stime, MOST_SECONDS)
        self.assertLess(usage.ru_maxrss * 1024, MOST_BYTES)
        return message

    def test_jpeg_with_too_many_codes(self):
        self.take("stb_dht.jpg", "stb_dht.gltf", "j.obj", "j.mtl")
        words = "Bogus Huffman table definition at byte"
        self.run_cheaply("light", "stb_dht.jpg", "-o", "x.json", says=["stb_dht.jpg", words])
        self.run_cheaply("info", "stb_dht.gltf", says=["stb_dht.gltf: image 0", words])
        self.run_cheaply("info", "j.obj", says=["stb_dht.jpg", words])

    def test_jpeg_with_undefined_behaviour(self):
        self.take("stb_jpeg_ub_1990")
        data = self.path("stb_jpeg_ub_1990").read_bytes()
        self.write("a.jpg", data)
        self.run_cheaply("light", "a.jpg", "-o", "x.json", says="a.jpg: cannot be decoded")
        document, buffer = gltf_parts(*ball())
        uri = "data:image/jpeg;base64," + base64.b64encode(data).decode()
        document.update(materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
                        textures=[{"source": 0}], images=[{"uri": uri}])
        self.write("a.glb", glb(document, buffer))
        self.run_cheaply("bake", "a.glb", "-o", "b.glb", says="a.glb: image 0: cannot be decoded")

    def test_deep_values(self):
        deep = "[" * 65000 + "]" * 65000
        self.write("light.json", '{"lambent":"light","bands":1,"coefficients":[' + deep + "]}")
        self.write("view.json", '{"lambent":"view","version":1,"camera":' + deep + "}")
        self.write("scene.gltf", '{"asset":{"version":"2.0"},"extras":' + deep + "}")
        words = "nested more than 200 deep at byte"
        self.write("air.json", '{"lambent":"atmosphere","air":' + deep + "}")
        self.run_cheaply("light", "light.json", "-o", "x.json", says=["light.json", words])
        self.run_cheaply("light", "sky:sun-elevation=9,atmosphere=air.json", "-o", "x.json",
                         says=["air.json", words])
        self.run_cheaply("info", "scene.gltf", says=["scene.gltf", words])
        self.bake()
        self.run_cheaply("render", "ball.glb", "--view", "view.json", "-o", "x.png",
                         says=["view.json", words])
        header = ('{"name":' + deep + "}").encode()
        self.write("deep.rtt", struct.pack("<4sII", b"LRTT", 1, len(header)) + header)
        self.run_cheaply("info", "deep.rtt", says="deep.rtt")

    def test_picture_much_larger_than_its_file(self):
        document, buffer = gltf_parts(*ball())
        picture = black_png(16384, 16384)
        document["buffers"][0]["byteLength"] += len(picture)
        document["bufferViews"].append({"buffer": 0, "byteOffset": len(buffer),
                                        "byteLength": len(picture)})
        document.update(materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
                        textures=[{"source": 0}], images=[{"bufferView": 2}])
        self.write("a.glb", glb(document, buffer + picture))
        self.run_cheaply("info", "a.glb", says=["a.glb: image 0", "16384×16384", "1.0 GiB",
                                                "over the limit of", "--memory-limit"])

    def test_one_picture_for_many_materials(self):
        self.take("mr30.glb")
        self.run_cheaply("info", "mr30.glb", code=DONE)

    def test_many_pictures(self):
        document, buffer = gltf_parts(*ball())
        uri = base64.b64encode(black_png(4096, 4096)).decode()
        names = [f"data:image/png;v={i};base64,{uri}" for i in range(100)]
        document.update(
            materials=[{"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": i}}}
                       for i in range(len(names))],
            textures=[{"source": i} for i in range(len(names))],
            images=[{"uri": name} for name in names])
        self.write("a.glb", glb(document, buffer))
        self.run_cheaply("info", "a.glb", says=["a.glb: image", "gone through", "over the limit"])

    def test_one_library_many_times(self):
        self.take("m.mtl", "p.png")
        triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
        self.write("m.obj", "mtllib m.mtl\n" * 200 + triangle)
        self.run_cheaply("info", "m.obj", code=DONE)
        # A picture that many libraries name is read once; as many pictures are not.
        library = Path(self.path("m.mtl")).read_text()
        for i in range(200):
            shutil.copy(self.path("m.mtl"), self.path(f"m{i}.mtl"))
        self.write("m.obj", "".join(f"mtllib m{i}.mtl\n" for i in range(200)) + triangle)
        self.run_cheaply("info", "m.obj", code=DONE)
        for i in range(200):
            shutil.copy(self.path("p.png"), self.path(f"p{i}.png"))
            self.write(f"m{i}.mtl", library.replace("p.png", f"p{i}.png"))
        self.run_cheaply("info", "m.obj", says=[".png", "2048×2048", "over the limit"])

    def test_radiance_header_alone(self):
        self.write("h.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 11584 +X 23168\n" +
                   b"\0" * 66000)
        for arguments in (("light", "h.hdr", "-o", "x.json"), ("info", "h.hdr")):
            self.run_cheaply(*arguments, says=["h.hdr", "23168×11584", "3.0 GiB"])

    def test_exr_attribute(self):
        name = "exr_header_attribute_1.8GB.exr"
        self.take(name)
        self.run_cheaply("light", name, "-o", "x.json",
                         says=[name, "an attribute of the header says", "at byte"])

    def test_exr_tiles(self):
        def attribute(name, kind, value):
            return name + b"\0" + kind + b"\0" + struct.pack("<I", len(value)) + value
        window = struct.pack("<4i", 0, 0, 7, 7)
        channels = b"".join(c + b"\0" + struct.pack("<i4x2i", 2, 1, 1) for c in (b"B", b"G", b"R"))
        header = (attribute(b"channels", b"chlist", channels + b"\0") +
                  attribute(b"compression", b"compression", b"\3") +
                  attribute(b"dataWindow", b"box2i", window) +
                  attribute(b"displayWindow", b"box2i", window) +
                  attribute(b"lineOrder", b"lineOrder", b"\0") +
                  attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) +
                  attribute(b"screenWindowCenter", b"v2f", bytes(8)) +
                  attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) +
                  attribute(b"tiles", b"tiledesc", struct.pack("<IIB", 13000, 13000, 0)) + b"\0")
        self.write("a.exr", struct.pack("<II", 20000630, 0x202) + header + bytes(600))
        self.run_cheaply("light", "a.exr", "-o", "x.json", says=["a.exr", "over the limit"])

    def test_a_file_outside_of_the_folder(self):
        self.take("exfil.gltf")
        self.run_cheaply("bake", "exfil.gltf", "-o", "x.glb",
                         says=["exfil.gltf", "buffer 1", "/etc/passwd", "--allow-outside"])
        self.assertFalse(self.path("x.glb").exists())

    def test_a_file_of_the_folder_that_is_not_there(self):
        document, buffer = gltf_parts(*ball())
        document["buffers"][0]["uri"] = "gone.bin"
        self.write("ball.gltf", json.dumps(document))
        self.run_cheaply("info", "ball.gltf", says=["gone.bin", "which does not exist"])

    def test_a_file_outside_of_the_folder_that_is_allowed(self):
        document, buffer = gltf_parts(*ball())
        document["buffers"][0]["uri"] = "../ball.bin"
        self.path("scene").mkdir()
        self.write("ball.bin", buffer)
        self.write("scene/ball.gltf", json.dumps(document))
        for arguments in (("info", "scene/ball.gltf"),
                          ("bake", "scene/ball.gltf", "-o", "b.glb", "--directions", 64)):
            self.run_cheaply(*arguments, says=["../ball.bin", "--allow-outside"])
            self.run_cheaply(*arguments, "--allow-outside", code=DONE)

    def test_unused_vertices_many_times(self):
        document, buffer = gltf_parts([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        document["accessors"][0] = {"componentType": 5126, "count": 1 << 22, "type": "VEC3"}
        primitive = {"attributes": {"POSITION": 0}, "indices": 1}
        document["meshes"] = [{"primitives": [primitive] * 5000}]
        self.write("a.glb", glb(document, buffer))
        self.run_cheaply("info", "a.glb", says=["a.glb: node 0", "over the limit"])

    def test_a_light_much_larger_than_its_file(self):
        self.bake()
        self.write("l.png", black_png(16384, 16384))
        self.write("state.json", json.dumps({"lambent": "view", "environment": {"source": "l.png"}}))
        words = ["l.png", "16384×16384", "over the limit of", "--memory-limit"]
        self.run_cheaply("light", "l.png", "-o", "x.json", says=words)
        self.run_cheaply("render", "ball.glb", "--view", "state.json", "-o", "x.png", says=words)
        self.run_cheaply("reference", "ball.obj", "--light", "l.png", "-o", "x.png", says=words)
        self.run_cheaply("compare", "l.png", "l.png", says=words)
        self.run_cheaply("rtt", "l.png", "-o", "x.rtt", says=words)

    def test_one_picture_for_many_directions(self):
        self.write("b.png", black_png(4096, 4096))
        table = ["file,view_theta,view_phi,light_theta,light_phi"]
        table += [f"b.png,0,0,{10 + i % 70},{i // 70}" for i in range(700)]
        self.write("btf.csv", "\n".join(table) + "\n")
        self.run_cheaply("rtt", "btf.csv", "-o", "x.rtt", "--positions", "4", "--views", 1,
                         says=["btf.csv, line", "b.png", "gone through", "--memory-limit"])

    def test_many_buffers_of_one_file(self):
        # The transfer of each mesh lies in a buffer of its own, and all of these are one file.
        self.bake("ball.obj", "ball.glb", "--directions", 64, "--material", "glossy", "--bands", 7)
        data = self.path("ball.glb").read_bytes()
        length = struct.unpack_from("<I", data, 12)[0]
        document, buffer = json.loads(data[20:20 + length]), data[28 + length:]
        document["buffers"][0]["uri"] = "data.bin"
        primitives = document["meshes"][0]["primitives"]
        primitive = json.dumps(primitives[0])
        for _ in range(60):
            copy = json.loads(primitive)
            matrices = copy["extensions"]["LAMBENT_radiance_transfer"]["matrices"]
            accessor = dict(document["accessors"][matrices["accessor"]])
            view = dict(document["bufferViews"][accessor["bufferView"]])
            view["buffer"] = len(document["buffers"])
            accessor["bufferView"] = len(document["bufferViews"])
            matrices["accessor"] = len(document["accessors"])
            document["buffers"].append(document["buffers"][0])
            document["bufferViews"].append(view)
            document["accessors"].append(accessor)
            primitives.append(copy)
        self.write("data.bin", buffer)
        self.write("many.gltf", json.dumps(document))
        shade = ("shade", "many.gltf", "--light", "uniform", "-o", "x.csv", "--memory-limit")
        self.run_cheaply(*shade, "10MiB", says=["many.gltf", ".matrices.accessor: accessor ",
                                                "over the limit of 10.0 MiB"])
        self.run_cheaply(*shade, "40MiB", code=DONE)

    def test_every_verb_takes_a_limit(self):
        self.bake()
        self.run_tool("rtt", "weave", "-o", "a.rtt", "--positions", "8", "--views", 1,
                      "--directions", 16, "--bounces", 0)
        self.run_tool("shade", "ball.glb", "--light", "uniform", "-o", "a.csv")
        self.write("l.png", black_png(64, 32))
        self.write("btf.csv", "file,view_theta,view_phi,light_theta,light_phi\n" +
                   "".join(f"l.png,0,0,{i},0\n" for i in range(1, 10)))
        lit = ("--light", "uniform", "-o")
        by_l = ("--light", "l.png", "-o")
        for arguments in (("light", "l.png", "-o", "x.json"),
                          ("bake", "ball.obj", "-o", "x.glb"),
                          ("bake", "ball.glb", "-o", "x.glb"),
                          ("reference", "ball.glb", *lit, "x.exr"),
                          ("reference", "ball.obj", *lit, "x.exr"),
                          ("render", "ball.glb", *lit, "x.png"),
                          ("shade", "ball.glb", *lit, "x.csv"),
                          ("compare", "l.png", "l.png"),
                          ("compare", "a.csv", "a.csv"),
                          ("rtt", "l.png", "-o", "x.rtt"),
                          ("rtt", "ball.obj", "-o", "x.rtt"),
                          ("rtt", "btf.csv", "-o", "x.rtt"),
                          ("synthesize", "ball.obj", "--rtt", "a.rtt", "-o", "x.glb"),
                          ("view", "ball.glb", "--surroundings", "ball.obj"),
                          ("info", "ball.glb"), ("info", "a.rtt"), ("info", "a.csv")):
            self.run_cheaply(*arguments, "--memory-limit", "200",
                             says=["limit of 200 bytes", "--memory-limit"])
        for arguments in (("render", "ball.glb", *by_l, "x.png"),
                          ("shade", "ball.glb", *by_l, "x.csv"),
                          ("reference", "ball.obj", *by_l, "x.exr")):
            self.write("l.png", black_png(1024, 512))
            self.run_cheaply(*arguments, "--memory-limit", "1MiB",
                             says=["l.png", "limit of 1.0 MiB", "--memory-limit"])

    def test_a_limit_of_ones_own(self):
        document, buffer = gltf_parts(*ball())
        self.write("ball.glb", glb(document, buffer))
        self.run_cheaply("info", "ball.glb", "--memory-limit", "1KiB",
                         says=["ball.glb", "over the limit of 1.0 KiB"])
        self.run_cheaply("info", "ball.glb", "--memory-limit", "1MiB", code=DONE)

    def test_instances_by_the_million(self):
        document, buffer = gltf_parts(*ball())
        document["accessors"].append({"componentType": 5126, "type": "VEC3", "count": 4000000})
        node = document["nodes"][0]
        node["extensions"] = {"EXT_mesh_gpu_instancing": {
            "attributes": {"TRANSLATION": len(document["accessors"]) - 1}}}
        self.write("a.glb", glb(document, buffer))
        self.run_cheaply("info", "a.glb", says=["a.glb: node 0", "over the limit"])
        # Many nodes, each with many instances of a mesh without anything to see.
        document["meshes"].append({"primitives": []})
        document["accessors"][-1]["count"] = 100000
        document["nodes"] += [dict(node, mesh=1) for _ in range(3000)]
        node.pop("extensions")
        document["scenes"][0]["nodes"] = list(range(len(document["nodes"])))
        self.write("b.glb", glb(document, buffer))
        self.run_cheaply("info", "b.glb", says=["b.glb: node", "over the limit"])

    def test_compressed_streams_that_claim_too_much(self):
        counts = b"\xff\xff\xff\xff\x07" * 2
        for method, head in ((0, b""), (1, b"\0")):
            document, buffer = gltf_parts(*ball())
            stream = b"DRACO\2\2\1" + bytes([method]) + b"\0\0" + head + counts + bytes(200)
            view = len(document["bufferViews"])
            document["bufferViews"].append(
                {"buffer": 0, "byteOffset": len(buffer), "byteLength": len(stream)})
            document["buffers"][0]["byteLength"] = len(buffer) + len(stream)
            document["meshes"][0]["primitives"][0]["extensions"] = {
                "KHR_draco_mesh_compression": {"bufferView": view, "attributes": {"POSITION": 0}}}
            self.write("a.glb", glb(document, buffer + stream))
            self.run_cheaply("info", "a.glb", says=["a.glb: mesh", "over the limit"])
        document, buffer = gltf_parts(*ball())
        for view in document["bufferViews"]:
            whole = dict(view)
            view.update(buffer=1, extensions={"EXT_meshopt_compression": dict(
                whole, count=2000000000, byteStride=16, mode="ATTRIBUTES")})
        document["buffers"].append(
            {"byteLength": 1, "extensions": {"EXT_meshopt_compression": {"fallback": True}}})
        self.write("a.glb", glb(document, buffer))
        self.run_cheaply("info", "a.glb", says=["a.glb: bufferView", "cannot come out of"])

    def test_cycles_through_extensions_and_skins(self):
        document, buffer = gltf_parts(*ball())
        document["skins"] = [{"joints": [0] * 1000} for _ in range(2000)]
        document["nodes"] += [{"mesh": 0, "skin": i} for i in range(2000)]
        document["scenes"][0]["nodes"] = list(range(1, 2001))
        self.write("a.glb", glb(document, buffer))
        self.run_cheaply("info", "a.glb", code=DONE)
        document, buffer = gltf_parts(*ball())
        document["nodes"][0].update(children=[1])
        document["nodes"].append({"children": [0], "extensions": {
            "KHR_node_visibility": {"visible": False}, "EXT_mesh_gpu_instancing": {}}})
        self.write("a.glb", glb(document, buffer))
        self.run_cheaply("info", "a.glb", says=["a.glb: node 0", "twice"])
