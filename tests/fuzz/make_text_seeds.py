#!/usr/bin/env python3
"""Writes the seeds of glTF, OBJ, PLY and Radiance files: make_text_seeds.py FOLDER.

They lie in corpus/; this made them. Lights, view states and SOURCEs are written by hand.
"""

import base64
import json
import struct
import sys
import zlib
from pathlib import Path


def png(width, height):
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    rows = b"".join(b"\0" + bytes((x * 90 + y * 40 + c * 20) % 256
                                  for x in range(width) for c in range(3)) for y in range(height))
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) +
            chunk(b"IEND", b""))


class Gltf:
    """A document and its one buffer."""

    def __init__(self):
        self.buffer = b""
        self.document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                         "nodes": [{"mesh": 0}], "meshes": [], "bufferViews": [], "accessors": []}

    def view(self, data, **more):
        self.buffer += bytes(-len(self.buffer) % 4)
        self.document["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data), **more})
        self.buffer += data
        return len(self.document["bufferViews"]) - 1

    def accessor(self, data, component, kind, count, **more):
        self.document["accessors"].append({"bufferView": self.view(data), "type": kind,
                                           "componentType": component, "count": count, **more})
        return len(self.document["accessors"]) - 1

    def floats(self, rows):
        flat = [v for row in rows for v in row]
        data = struct.pack(f"<{len(flat)}f", *flat)
        return self.accessor(data, 5126, f"VEC{len(rows[0])}", len(rows))

    def glb(self):
        data = self.buffer + bytes(-len(self.buffer) % 4)
        self.document["buffers"] = [{"byteLength": len(self.buffer)}]
        text = json.dumps(self.document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(data)) +
                struct.pack("<I4s", len(text), b"JSON") + text +
                struct.pack("<I4s", len(data), b"BIN\0") + data)

    def gltf(self):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.buffer).decode()
        self.document["buffers"] = [{"byteLength": len(self.buffer), "uri": uri}]
        return json.dumps(self.document, indent=1).encode()


QUAD = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
UVS = [(0, 1), (1, 1), (1, 0), (0, 0)]


def plain():
    g = Gltf()
    position = g.floats(QUAD)
    indices = g.accessor(struct.pack("<6H", 0, 1, 2, 0, 2, 3), 5123, "SCALAR", 6)
    g.document["meshes"] = [
        {"primitives": [{"attributes": {"POSITION": position}, "indices": indices}]}]
    return g


def textured():
    g = Gltf()
    attributes = {"POSITION": g.floats(QUAD), "NORMAL": g.floats([(0, 0, 1)] * 4),
                  "TEXCOORD_0": g.floats(UVS),
                  "TEXCOORD_1": g.accessor(bytes([0, 255, 255, 255, 255, 0, 0, 0]), 5121, "VEC2", 4,
                                           normalized=True),
                  "COLOR_0": g.accessor(bytes([255, 128, 0, 255] * 4), 5121, "VEC4", 4,
                                        normalized=True)}
    picture = g.view(png(4, 2))
    g.document.update(
        images=[{"bufferView": picture, "mimeType": "image/png"},
                {"uri": "data:image/png;base64," + base64.b64encode(png(1, 1)).decode()},
                {"uri": "tile.png"}],
        samplers=[{"wrapS": 33071, "wrapT": 33648}],
        textures=[{"source": 0, "sampler": 0}, {"source": 1}, {"source": 2}],
        extensionsUsed=["KHR_texture_transform", "KHR_materials_emissive_strength"],
        materials=[{"name": "tiles", "doubleSided": True, "emissiveFactor": [1, 0.5, 0],
                    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3}},
                    "pbrMetallicRoughness": {
                        "baseColorTexture": {"index": 0, "texCoord": 1, "extensions": {
                            "KHR_texture_transform": {"offset": [0.1, 0.2], "rotation": 0.3,
                                                      "scale": [2, 2]}}},
                        "baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0.5, "roughnessFactor": 0.3,
                        "metallicRoughnessTexture": {"index": 1}}},
                   {"extras": {"lambent": {"diffuse": [0.5, 0.5, 0.5]}},
                    "pbrMetallicRoughness": {"baseColorTexture": {"index": 2}}}])
    g.document["meshes"] = [{"name": "m", "primitives": [
        {"attributes": attributes, "mode": 5, "material": 0},
        {"attributes": attributes, "mode": 6, "material": 1}]}]
    return g


def nodes():
    g = plain()
    g.document["nodes"] = [
        {"mesh": 0, "children": [1, 2], "translation": [1, 2, 3],
         "rotation": [0, 0.7071068, 0, 0.7071068]},
        {"mesh": 0, "scale": [-1, 2, 1]},
        {"camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1]},
        {"camera": 1}]
    g.document["scenes"] = [{"nodes": [0, 3]}]
    g.document["cameras"] = [
        {"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 2, "znear": 0, "zfar": 9}}]
    return g


def sparse():
    g = plain()
    places = g.view(struct.pack("<2B", 1, 3))
    values = g.view(struct.pack("<6f", 2, 0, 0, 0, 2, 0))
    g.document["accessors"][0]["sparse"] = {
        "count": 2, "indices": {"bufferView": places, "componentType": 5121},
        "values": {"bufferView": values}}
    # Interleaved, quantised.
    data = b"".join(struct.pack("<3hxx4b", x * 100, y * 100, z, 0, 0, 127, 0)
                    for x, y, z in QUAD)
    view = g.view(data, byteStride=12)
    g.document["accessors"] += [
        {"bufferView": view, "componentType": 5122, "type": "VEC3", "count": 4,
         "normalized": True},
        {"bufferView": view, "byteOffset": 8, "componentType": 5120, "type": "VEC3", "count": 4,
         "normalized": True}]
    n = len(g.document["accessors"])
    g.document["extensionsUsed"] = g.document["extensionsRequired"] = ["KHR_mesh_quantization"]
    g.document["meshes"][0]["primitives"].append(
        {"attributes": {"POSITION": n - 2, "NORMAL": n - 1}, "indices": 1})
    return g


def deformed():
    """Instances, a hidden node, a skin and morph targets."""
    g = plain()
    primitive = g.document["meshes"][0]["primitives"][0]
    primitive["attributes"].update(
        JOINTS_0=g.accessor(bytes([0, 1, 0, 0] * 4), 5121, "VEC4", 4),
        WEIGHTS_0=g.accessor(bytes([200, 55, 0, 0] * 4), 5121, "VEC4", 4, normalized=True))
    primitive["targets"] = [{"POSITION": g.floats([(0, 0, 0.5)] * 4)}]
    g.document["meshes"][0]["weights"] = [0.5]
    identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1] * 2
    bind = g.accessor(struct.pack("<32f", *identity), 5126, "MAT4", 2)
    g.document["skins"] = [{"joints": [2, 3], "inverseBindMatrices": bind}]
    g.document["nodes"] = [
        {"mesh": 0, "skin": 0},
        {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {
            "TRANSLATION": g.floats([(0, 3, 0), (0, 5, 0)]),
            "ROTATION": g.floats([(0, 0, 0, 1), (0, 1, 0, 0)]),
            "SCALE": g.floats([(1, 1, 1), (-1, 2, 1)])}}}},
        {"translation": [0, 1, 0], "children": [3]}, {"rotation": [0, 0, 0.6, 0.8]},
        {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": False}}}]
    g.document["scenes"] = [{"nodes": [0, 1, 2, 4]}]
    g.document["extensionsUsed"] = ["EXT_mesh_gpu_instancing", "KHR_node_visibility"]
    return g


def materials():
    """What extensions say about materials."""
    g = textured()
    g.document["materials"] += [
        {"extensions": {"KHR_materials_unlit": {}}},
        {"extensions": {"KHR_materials_ior": {"ior": 2.4}, "KHR_materials_specular": {
            "specularFactor": 0.9, "specularColorFactor": [1, 0.5, 0.2],
            "specularTexture": {"index": 1}, "specularColorTexture": {"index": 0}}}},
        {"extensions": {"KHR_materials_pbrSpecularGlossiness": {
            "diffuseFactor": [0.5, 0.5, 0.5, 1], "diffuseTexture": {"index": 0},
            "specularFactor": [0.3, 0.3, 0.3], "glossinessFactor": 0.7,
            "specularGlossinessTexture": {"index": 1}}}},
        {"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}}]
    primitives = g.document["meshes"][0]["primitives"]
    primitives += [dict(primitives[0], material=i) for i in range(2, 6)]
    g.document["extensionsUsed"] = ["KHR_materials_unlit", "KHR_materials_transmission"]
    return g


OBJ = {
    "cube.obj": """# a cube without its lid
mtllib scene.mtl
o cube
v 0 0 0
v 1 0 0
v 1 0 1
v 0 0 1
v 0 1 0 1 0 0
v 1 1 0 0 1 0
v 1 1 1 0 0 1
v 0 1 1 1 1 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 -1 0
usemtl tiles
f 1/1/1 2/2/1 3/3/1 4/4/1
f 1/1 5/2 6/3 2/4
usemtl mirror
f -6//1 -2//1 -3//1
f 3 7 8 4
f 4 8 5 \\
  1
#=== scene.mtl
newmtl tiles
Kd 0.5 0.6 0.7
Ks 0.2 0.2 0.2
Ns 40
map_Kd -s 2 2 1 tile.png
newmtl mirror
illum 3
Kd 0 0 0
Ks 0.9 0.9 0.9
newmtl metal
Pm 1
Pr 0.3
d 0.5
""",
    "polygon.obj": """v 0 0 0
v 2 0 0
v 2 2 0
v 1 0.5 0
v 0 2 0
f 1 2 3 4 5
s 1
g a b
usemtl nowhere
f 5 4 3 2 1
l 1 2
p 1
""",
    "windows.obj": "\ufeffmtllib C:\\jobs\\scene.mtl # there\r\nv 448251.25 5 5411930.5 188 60 60#\r\n"
                   "v 448252.25 5 5411930.5\r\nv 448252.25 5 5411931.5 9 9 9\r\nvt 1.#QNAN 0\r\n"
                   "s off\r\nusemtl red # one\r\nf 1/1 2/1 3/1 # all\r\ncall x\r\nsurf 1\r\n"
                   "#=== scene.mtl\nnewmtl red # wine\nKd 255 0 0\nKe 2 1 .5\nTr .5\n"
                   "map_Kd \"Tile.PNG\" -s 2 2 1 -o .5 0 -clamp on -imfchan r\nbump -bm 1 tile.png\n",
    "numbers.obj": "v 1e-40 +.5 -1e30\r\nv 1e39 0 0\r\nv 0 1 0\r\nv 0 0 1\rf 1 3 4\nf 3 4 1 2\n",
}

PLY_TEXT = """ply
format ascii 1.0
comment TextureFile tile.png
element vertex 4
property float x
property float y
property float z
property float nx
property float ny
property float nz
property float s
property float t
property uchar red
property uchar green
property uchar blue
element face 2
property list uchar int vertex_indices
element edge 1
property int a
property list uchar float b
end_header
0 0 0 0 0 1 0 0 255 0 0
1 0 0 0 0 1 1 0 0 255 0
1 1 0 0 0 1 1 1 0 0 255
0 1 0 0 0 1 0 1 9 9 9
3 0 1 2
4 0 2 3 1
7 2 0.5 1.5
"""


PLY_CORNERS = """ply
made by an old exporter
format ascii 1.0
comment TextureFile tile.png
comment TextureFile TILE.png
obj_info 3
element vertex 4
property double x
property double y
property double z
property float alpha
element face 3
property list uchar int vertex_indices
property list uchar float texcoord
property int texnumber
property int red
property int green
property int blue
end_header
448251.25 0 5411930.5 1
448252.25 0 5411930.5 .5
448252.25 1 5411930.5 1
448251.25 1 5411930.5 1.#INF
3 0 1 2 6 0 0 1 0 1 1 1 188 60 60
4 0 1 2 3 8 0 0 1 0 1 1 0 1 0 9 9 9
3 1 2 3 0 7 256 0 0
"""


def ply_binary(big):
    order = ">" if big else "<"
    head = ("ply\nformat binary_%s_endian 1.0\nelement vertex 4\nproperty float x\n"
            "property double y\nproperty short z\nproperty float red\nproperty float green\n"
            "property float blue\n"
            "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
            % ("big" if big else "little"))
    body = b"".join(struct.pack(order + "fdhfff", x, y, z, 0.5, 0.25, 1) for x, y, z in QUAD)
    return head.encode() + body + struct.pack(order + "i6i", 6, 0, 1, 3, -1, 2, 0)


def ply_faces():
    head = ("ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\n"
            "property float y\nproperty float z\nproperty float u\nproperty float v\nelement face 1\n"
            "property uchar flags\nproperty list uchar uint vertex_index\nend_header\n")
    body = b"".join(struct.pack("<5f", *p, *uv) for p, uv in zip(QUAD, UVS))
    return head.encode() + body + struct.pack("<BB4I", 7, 4, 0, 1, 2, 3)


def hdr(head, resolution, pixels):
    return b"#?RADIANCE\n" + head + b"\n" + resolution + b"\n" + pixels


def main():
    folder = Path(sys.argv[1])

    def save(name, data):
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)

    for made in (plain, textured, nodes, sparse, deformed, materials):
        save(f"gltf/{made.__name__}.glb", made().glb())
    save("gltf/plain.gltf", plain().gltf())
    save("gltf/textured.gltf", textured().gltf())
    for name, text in OBJ.items():
        save(f"obj/{name}", text.encode())
    save("ply/text.ply", PLY_TEXT.encode())
    save("ply/corners.ply", PLY_CORNERS.encode())
    save("ply/little.ply", ply_binary(False))
    save("ply/big.ply", ply_binary(True))
    save("ply/faces.ply", ply_faces())
    rgbe = b"FORMAT=32-bit_rle_rgbe\n"
    save("hdr/flat.hdr", hdr(rgbe + b"EXPOSURE=2.5\nCOLORCORR= 1 0.5 2\n", b"-Y 2 +X 4",
                             bytes(range(1, 33))))
    old = (b"\x40\x50\x60\x80\1\1\1\5\1\1\1\0\x10\x20\x30\x81\1\1\1\5" +
           b"\x41\x51\x61\x82\1\1\1\x0b")
    save("hdr/old_runs.hdr", hdr(rgbe, b"+X 12 +Y 2", old))
    save("hdr/xyz.hdr", hdr(b"FORMAT=32-bit_rle_xyze\n", b"+Y 2 -X 2", bytes(range(100, 116))))
    run = b"\2\2\0\x08" + b"\x88\x40" + b"\3\1\2\3\x85\x50" + b"\x88\x60" + b"\x88\x81"
    save("hdr/new_runs.hdr", hdr(rgbe + b"# comment\n", b"-Y 2 +X 8", run + run))


if __name__ == "__main__":
    main()
