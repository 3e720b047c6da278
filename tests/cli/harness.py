"""Runs the tool in a folder of its own, and makes the small files that it is fed with."""

import json
import math
import os
import shutil
import struct
import subprocess
import tempfile
import unittest
import zlib
from pathlib import Path

TOOL = os.environ["LAMBENT_UNDER_TEST"]
WORK = os.environ["LAMBENT_TEST_WORK"]
INPUTS = Path(os.environ["LAMBENT_INPUTS"])
# Tables of skies are kept here and not with the person's own.
os.environ["XDG_CACHE_HOME"] = str(Path(WORK) / "cache")

DONE, FAILED, USAGE, BAD_INPUT = 0, 1, 2, 3


class ToolTest(unittest.TestCase):
    def setUp(self):
        self.dir = Path(tempfile.mkdtemp(prefix=self._testMethodName + ".", dir=WORK))
        self.addCleanup(shutil.rmtree, self.dir, ignore_errors=True)

    def path(self, name: str) -> Path:
        return self.dir / name

    def write(self, name: str, content) -> Path:
        path = self.path(name)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def run_tool(self, *args, code=DONE, **options):
        """Runs the tool in this test's folder and asserts its exit code (one, or one of several)."""
        result = subprocess.run([TOOL, *map(str, args)], cwd=self.dir, text=True,
                                capture_output=True, timeout=280, **options)
        self.assertIn(result.returncode, code if isinstance(code, tuple) else (code,),
                      f"lambent {' '.join(map(str, args))}\n{result.stdout}{result.stderr}")
        return result

    def run_json(self, *args, code=DONE) -> dict:
        return json.loads(self.run_tool(*args, "--json", "--quiet", code=code).stdout)

    def refused(self, *args, code=BAD_INPUT, says=()):
        """Asserts the exit code, that the message says what it must, and that nothing was left."""
        before = sorted(os.listdir(self.dir))
        result = self.run_tool(*args, code=code)
        self.assertIn("error: ", result.stderr)
        for words in [says] if isinstance(says, str) else says:
            self.assertIn(words, result.stderr)
        self.assertEqual(before, sorted(os.listdir(self.dir)), "something was left behind")
        return result

    def bake(self, scene="ball.obj", output="ball.glb", *options) -> Path:
        """A small asset, made in a moment."""
        if scene == "ball.obj" and not self.path(scene).exists():
            self.write(scene, ball_obj())
        if not any(str(option) == "--directions" for option in options):
            options = ("--directions", 256, *options)
        self.run_tool("bake", scene, "-o", output, "--quiet", *options)
        return self.path(output)


def ball(slices=16, stacks=8):
    """Vertices and triangles of a sphere of radius 1."""
    vertices = [(0.0, 1.0, 0.0)]
    for i in range(1, stacks):
        theta = math.pi * i / stacks
        for j in range(slices):
            phi = 2 * math.pi * j / slices
            vertices.append((math.sin(theta) * math.cos(phi), math.cos(theta),
                             math.sin(theta) * math.sin(phi)))
    vertices.append((0.0, -1.0, 0.0))
    south = len(vertices) - 1
    triangles = []
    for j in range(slices):
        k = (j + 1) % slices
        triangles.append((0, 1 + k, 1 + j))
        for i in range(stacks - 2):
            a, b = 1 + i * slices, 1 + (i + 1) * slices
            triangles += [(a + j, a + k, b + j), (a + k, b + k, b + j)]
        last = 1 + (stacks - 2) * slices
        triangles.append((south, last + j, last + k))
    return vertices, triangles


def ball_obj(slices=16, stacks=8, normals=True) -> str:
    vertices, triangles = ball(slices, stacks)
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices]
    if normals:
        lines += [f"vn {x!r} {y!r} {z!r}" for x, y, z in vertices]
        corner = "{0}//{0}"
    else:
        corner = "{0}"
    lines += ["f " + " ".join(corner.format(i + 1) for i in t) for t in triangles]
    return "\n".join(lines) + "\n"


def quad_obj(uvs=((0, 0), (1, 0), (1, 1), (0, 1))) -> str:
    """A square that faces up, with UVs."""
    lines = ["v -1 0 -1", "v -1 0 1", "v 1 0 1", "v 1 0 -1", "vn 0 1 0"]
    lines += [f"vt {u} {v}" for u, v in uvs]
    return "\n".join(lines + ["f 1/1/1 2/2/1 3/3/1", "f 1/1/1 3/3/1 4/4/1"]) + "\n"


def ply(vertices, triangles, binary=True, count=None) -> bytes:
    """count: what the header claims, if not the truth."""
    head = (f"ply\nformat {'binary_little_endian' if binary else 'ascii'} 1.0\n"
            f"element vertex {len(vertices) if count is None else count}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    if binary:
        body = b"".join(struct.pack("<3f", *v) for v in vertices)
        body += b"".join(struct.pack("<B3i", 3, *t) for t in triangles)
        return head.encode() + body
    text = "".join("{} {} {}\n".format(*v) for v in vertices)
    text += "".join("3 {} {} {}\n".format(*t) for t in triangles)
    return (head + text).encode()


def gltf_parts(vertices, triangles, index_count=None):
    """The JSON and the binary buffer of one indexed mesh."""
    positions = b"".join(struct.pack("<3f", *v) for v in vertices)
    indices = b"".join(struct.pack("<3I", *t) for t in triangles)
    flat = [c for v in vertices for c in v if math.isfinite(c)] or [0.0]
    document = {
        "asset": {"version": "2.0"},
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"name": "ball",
                    "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "buffers": [{"byteLength": len(positions) + len(indices)}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(positions)},
            {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(vertices), "type": "VEC3",
             "min": [min(flat)] * 3, "max": [max(flat)] * 3},
            {"bufferView": 1, "componentType": 5125, "type": "SCALAR",
             "count": 3 * len(triangles) if index_count is None else index_count}]}
    return document, positions + indices


def glb(document: dict, buffer: bytes) -> bytes:
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    buffer += b"\0" * (-len(buffer) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<II", len(buffer), 0x004E4942) + buffer
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def glb_json(document: dict) -> bytes:
    """A .glb without a chunk of its own for the buffer."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text


def png(width: int, height: int, pixel) -> bytes:
    """8-bit RGB; pixel(x, y) → (r, g, b)."""
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in pixel(x, y))
                    for y in range(height))

    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))

    return (b"\x89PNG\r\n\x1a\n" +
            chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def read_csv(path: Path):
    """Rows of numbers, the header checked."""
    lines = path.read_text().splitlines()
    assert lines[0] == "x,y,z,nx,ny,nz,r,g,b", lines[0]
    return [[float(cell) for cell in line.split(",")] for line in lines[1:]]


def hdr(width: int, height: int, rgbe=(128, 128, 128, 129)) -> bytes:
    head = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode()
    return head + bytes(rgbe) * (width * height)


class Exr:
    """An OpenEXR file of one part with 32-bit floats in ZIP blocks, as the tool writes them."""

    def __init__(self, path: Path):
        data = path.read_bytes()
        assert data[:4] == b"\x76\x2f\x31\x01", path
        at = 8
        self.attributes, self.names = {}, []

        def text():
            nonlocal at
            end = data.index(b"\0", at)
            word, at = data[at:end].decode(), end + 1
            return word

        while name := text():
            kind = text()
            size, = struct.unpack_from("<I", data, at)
            value = data[at + 4:at + 4 + size]
            at += 4 + size
            if kind == "string":
                self.attributes[name] = value.decode()
            elif kind == "chlist":
                while value[0]:
                    end = value.index(b"\0")
                    self.names.append(value[:end].decode())
                    assert value[end + 1] == 2, "not a float"
                    value = value[end + 17:]
            elif name == "dataWindow":
                x0, y0, x1, y1 = struct.unpack("<4i", value)
                self.width, self.height = x1 - x0 + 1, y1 - y0 + 1
            elif name == "compression":
                assert value == b"\3", "not ZIP"
        blocks = (self.height + 15) // 16
        self.rows = {name: [] for name in self.names}
        for place in struct.unpack_from(f"<{blocks}Q", data, at):
            y, size = struct.unpack_from("<2i", data, place)
            lines = min(16, self.height - y)
            whole = 4 * self.width * lines * len(self.names)
            packed = data[place + 8:place + 8 + size]
            raw = packed if size == whole else self.unpacked(zlib.decompress(packed))
            values = struct.unpack(f"<{whole // 4}f", raw)
            for line in range(lines):
                for i, name in enumerate(self.names):
                    start = (line * len(self.names) + i) * self.width
                    self.rows[name].append(values[start:start + self.width])

    @staticmethod
    def unpacked(data: bytes) -> bytes:
        bytes_, last = bytearray(data), data[0]
        for i in range(1, len(bytes_)):
            last = bytes_[i] = (last + bytes_[i] - 128) & 255
        half = (len(bytes_) + 1) // 2
        out = bytearray(len(bytes_))
        out[0::2], out[1::2] = bytes_[:half], bytes_[half:]
        return bytes(out)

    def __getitem__(self, name):
        """Rows of a channel, the top one first."""
        return self.rows[name]
