"""A glTF file that says all that glTF can say, put together by hand."""

import json
import math
import struct
import zlib

SIZES = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def png(color, size=4) -> bytes:
    def chunk(kind, data):
        body = kind + data
        return struct.pack(">I", len(data)) + body + struct.pack(">I", zlib.crc32(body))
    rows = b"".join(b"\0" + bytes(color) * size for _ in range(size))
    head = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head)
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def read_glb(data: bytes):
    """The document and the binary chunk."""
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + size]), data[28 + size:]


def accessor_values(document, binary, index):
    """Rows of numbers, normalized as glTF says."""
    accessor = document["accessors"][index]
    view = document["bufferViews"][accessor["bufferView"]]
    width, code = WIDTHS[accessor["type"]], SIZES[accessor["componentType"]]
    stride = view.get("byteStride", width * struct.calcsize(code))
    first = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    most = {5121: 255.0, 5123: 65535.0}.get(accessor["componentType"], 1.0)
    scale = most if accessor.get("normalized") else 1.0
    return [[v / scale for v in struct.unpack_from(f"<{width}{code}", binary, first + i * stride)]
            for i in range(accessor["count"])]


class Glb:
    def __init__(self):
        self.json = {"accessors": [], "bufferViews": [], "images": [], "textures": []}
        self.binary = b""

    def view(self, data: bytes, target=None, stride=None) -> int:
        self.binary += b"\0" * (-len(self.binary) % 4)
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)}
        if target:
            view["target"] = target
        if stride:
            view["byteStride"] = stride
        self.binary += data
        self.json["bufferViews"].append(view)
        return len(self.json["bufferViews"]) - 1

    def accessor(self, rows, kind, component=5126, target=34962, normalized=False) -> int:
        code, width = SIZES[component], WIDTHS[kind]
        flat = [row if isinstance(row, (list, tuple)) else [row] for row in rows]
        size = width * struct.calcsize(code)
        padding = b"\0" * (-size % 4) if target == 34962 else b""
        data = b"".join(struct.pack(f"<{width}{code}", *row) + padding for row in flat)
        view = self.view(data, target, size + len(padding) if padding else None)
        accessor = {"bufferView": view, "componentType": component, "type": kind,
                    "count": len(flat)}
        if normalized:
            accessor["normalized"] = True
        if kind == "VEC3" and target == 34962:
            accessor["min"] = [min(column) for column in zip(*flat)]
            accessor["max"] = [max(column) for column in zip(*flat)]
        self.json["accessors"].append(accessor)
        return len(self.json["accessors"]) - 1

    def texture(self, name, color, sampler=None) -> int:
        self.json["images"].append({"name": f"{name}.png", "mimeType": "image/png",
                                    "bufferView": self.view(png(color)), "extras": {"of": name}})
        texture = {"source": len(self.json["images"]) - 1, "name": name, "extras": {"is": name}}
        if sampler is not None:
            texture["sampler"] = sampler
        self.json["textures"].append(texture)
        return len(self.json["textures"]) - 1

    def bytes(self) -> bytes:
        binary = self.binary + b"\0" * (-len(self.binary) % 4)
        document = {**self.json, "buffers": [{"byteLength": len(self.binary)}]}
        text = json.dumps(document).encode()
        text += b" " * (-len(text) % 4)
        return (struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(binary))
                + struct.pack("<II", len(text), 0x4E4F534A) + text
                + struct.pack("<II", len(binary), 0x004E4942) + binary)


def grid(glb, n=3, raised=0.0, two_sets=True):
    """Attributes and indices of a square of n × n vertices that faces up."""
    places = [(i / (n - 1), j / (n - 1)) for j in range(n) for i in range(n)]
    attributes = {
        "POSITION": glb.accessor([(x - 0.5, raised, y - 0.5) for x, y in places], "VEC3"),
        "NORMAL": glb.accessor([(0, 1, 0)] * len(places), "VEC3"),
        "TEXCOORD_0": glb.accessor([(u, v) for u, v in places], "VEC2"),
    }
    if two_sets:
        attributes.update({
            "TANGENT": glb.accessor([(1, 0, 0, 1)] * len(places), "VEC4"),
            "TEXCOORD_1": glb.accessor([(int(200 * v), int(100 * u)) for u, v in places], "VEC2",
                                       5121, normalized=True),
            "COLOR_0": glb.accessor([(255, 255, 255 - i) for i in range(len(places))], "VEC3", 5121,
                                    normalized=True),
            "COLOR_1": glb.accessor([(0.5, u, v) for u, v in places], "VEC3"),
            "_TEMPERATURE": glb.accessor([20 + u for u, _ in places], "SCALAR"),
            "_PART": glb.accessor([i % 3 for i in range(len(places))], "SCALAR", 5121),
        })
    corners = []
    for j in range(n - 1):
        for i in range(n - 1):
            a = j * n + i
            corners += [a, a + n, a + 1, a + 1, a + n, a + n + 1]
    return attributes, glb.accessor(corners, "SCALAR", 5123, target=34963)


def moved(index, scale=2.0, **more):
    """A texture that is laid out anew by KHR_texture_transform."""
    return {"index": index, **more, "extensions": {"KHR_texture_transform": {
        "offset": [0.25, 0.5], "rotation": 0.5, "scale": [scale, 3.0]}}}


def materials(glb):
    glb.json["samplers"] = [{"magFilter": 9728, "minFilter": 9984, "wrapS": 33071, "wrapT": 33648,
                             "name": "sharp", "extras": {"kept": True}},
                            {"wrapS": 33071}]
    t = {name: glb.texture(name, color, sampler) for name, color, sampler in [
        ("base", (200, 180, 90), 0), ("rough", (0, 128, 200), 1), ("bumps", (128, 128, 255), None),
        ("soot", (220, 0, 0), 1), ("glow", (255, 40, 0), None), ("coat", (90, 0, 0), 0),
        ("coat bumps", (120, 130, 255), 0), ("thick", (0, 77, 0), None),
        ("leaf", (30, 160, 30), 1)]}
    return [
        {"name": "glaze", "extras": {"batch": 7}, "normalTexture":
             {"index": t["bumps"], "scale": 0.7, "texCoord": 1, "extras": {"by": "hand"}},
         "occlusionTexture": {"index": t["soot"], "strength": 0.5, "texCoord": 1},
         "emissiveTexture": moved(t["glow"], 5.0), "emissiveFactor": [1.0, 0.5, 0.25],
         "pbrMetallicRoughness": {
             "baseColorFactor": [0.9, 0.8, 0.7, 1.0], "baseColorTexture": moved(t["base"]),
             "metallicRoughnessTexture": {"index": t["rough"], "texCoord": 1},
             "metallicFactor": 0.6, "roughnessFactor": 0.5},
         "extensions": {
             "KHR_materials_emissive_strength": {"emissiveStrength": 3.0},
             "KHR_materials_clearcoat": {
                 "clearcoatFactor": 0.8, "clearcoatTexture": {"index": t["coat"]},
                 "clearcoatRoughnessFactor": 0.1,
                 "clearcoatNormalTexture": {"index": t["coat bumps"], "texCoord": 1, "scale": 0.3}},
             "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3]}}},
        {"name": "glass", "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.2},
         "extensions": {
             "KHR_materials_transmission": {"transmissionFactor": 0.9},
             "KHR_materials_ior": {"ior": 1.8},
             "KHR_materials_specular": {"specularFactor": 0.5},
             "KHR_materials_volume": {"thicknessFactor": 0.2, "attenuationColor": [0.9, 1.0, 0.9],
                                      "attenuationDistance": 0.4,
                                      "thicknessTexture": {"index": t["thick"]}}}},
        {"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.4, 0.6, 1.0]},
         "extensions": {"KHR_materials_unlit": {}}},
        {"name": "leaf", "doubleSided": True, "alphaMode": "MASK", "alphaCutoff": 0.3,
         "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.4,
                                  "baseColorTexture": {"index": t["leaf"]}}},
        {"name": "stone", "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.5,
                                                   "baseColorFactor": [0.4, 0.4, 0.4, 1.0]}},
    ]


def rich() -> Glb:
    glb = Glb()
    half = math.sqrt(0.5)
    top, top_indices = grid(glb, raised=0.1)
    rim, rim_indices = grid(glb, raised=0.2)
    plain, plain_indices = grid(glb, two_sets=False)
    wide, wide_indices = grid(glb, n=4, two_sets=False)
    plate, plate_indices = grid(glb, n=2, two_sets=False)
    times = glb.accessor([0.0, 1.0], "SCALAR", target=None)
    spins = glb.accessor([(0, 0, 0, 1), (0, 1, 0, 0)], "VEC4", target=None)
    offsets = glb.accessor([(0.0, 0.01, 0.0)] * 4, "VEC3")
    glb.json.update({
        "asset": {"version": "2.0", "generator": "Some Modeller 4.2",
                  "copyright": "© 2024 A Museum",
                  "extras": {"author": "N. N.", "license": "CC-BY-4.0", "title": "Bowl"},
                  "extensions": {"KHR_xmp_json_ld": {"packet": 0}}},
        "extensionsUsed": [
            "KHR_texture_transform", "KHR_materials_emissive_strength", "KHR_materials_clearcoat",
            "KHR_materials_sheen", "KHR_materials_transmission", "KHR_materials_ior",
            "KHR_materials_specular", "KHR_materials_volume", "KHR_materials_unlit",
            "KHR_materials_variants", "KHR_lights_punctual", "KHR_xmp_json_ld"],
        "extensions": {
            "KHR_lights_punctual": {"lights": [
                {"type": "spot", "name": "lamp", "intensity": 40.0, "color": [1.0, 0.9, 0.8],
                 "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.5}},
                {"type": "directional", "intensity": 3.0}]},
            "KHR_materials_variants": {"variants": [{"name": "old"}, {"name": "new"}]},
            "KHR_xmp_json_ld": {"packets": [{"@context": {"dc": "http://purl.org/dc/elements/1.1/"},
                                             "dc:rights": "free"}]}},
        "extras": {"catalogue": [1, {"number": "B-17"}]},
        "scene": 0,
        "scenes": [{"name": "Room", "nodes": [0, 6, 7], "extras": {"floor": 2}},
                   {"name": "Other", "nodes": []}],
        "nodes": [
            {"name": "Table", "translation": [1, 0, 0], "children": [1, 2, 3, 4],
             "extras": {"legs": 4}, "extensions": {"KHR_lights_punctual": {"light": 1}}},
            {"name": "Bowl", "mesh": 0, "rotation": [0, half, 0, half], "scale": [2, 2, 2],
             "extras": {"id": "b"}, "children": [8]},
            {"name": "Lamp", "translation": [0, 3, 0],
             "extensions": {"KHR_lights_punctual": {"light": 0}}},
            {"name": "View", "translation": [0, 1, 5], "camera": 0, "extras": {"shot": 1}},
            {"name": "Marker", "translation": [0, 2, 0], "children": [5]},
            {"name": "Below", "translation": [0, 0, 1]},
            {"name": "Leaf", "mesh": 1, "translation": [0, 0.5, 4]},
            {"name": "Flat", "camera": 1, "mesh": 2, "translation": [0, -1, 0]},
            {"name": "Plate", "mesh": 3}],
        "cameras": [
            {"type": "perspective", "name": "lens", "extras": {"mm": 35},
             "perspective": {"yfov": 0.6, "znear": 0.02, "zfar": 90.0, "aspectRatio": 1.5}},
            {"type": "orthographic",
             "orthographic": {"xmag": 2.0, "ymag": 1.0, "znear": 0.1, "zfar": 10.0}}],
        "meshes": [
            {"name": "bowl shape", "extras": {"made": 1999}, "primitives": [
                {"attributes": top, "indices": top_indices, "material": 0,
                 "extras": {"part": "top"},
                 "extensions": {"KHR_materials_variants": {"mappings": [
                     {"material": 1, "variants": [0]}, {"material": 4, "variants": [1]}]}}},
                {"attributes": rim, "indices": rim_indices, "material": 1}]},
            {"name": "leaf shape", "primitives": [
                {"attributes": plain, "indices": plain_indices, "material": 3}]},
            {"name": "ground", "primitives": [
                {"attributes": wide, "indices": wide_indices, "material": 4}]},
            {"name": "plate", "weights": [0.5], "primitives": [
                {"attributes": plate, "indices": plate_indices, "material": 2,
                 "targets": [{"POSITION": offsets}]}]}],
        "materials": materials(glb),
        "animations": [{"name": "turn", "channels": [
            {"sampler": 0, "target": {"node": 1, "path": "rotation"}}],
            "samplers": [{"input": times, "output": spins}]}],
    })
    return glb
