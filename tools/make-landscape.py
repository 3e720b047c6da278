#!/usr/bin/env python3
"""Writes a valley between mountains as a glTF file with a camera: the landscape of `make demo`.

usage: tools/make-landscape.py OUT.gltf [POINTS-ALONG-A-SIDE]

Heights are ridged noise (a sum of octaves of value noise, each folded at its middle), the same
every time; metres, +y up, north -z. Colours by slope and height: grass, scree, rock, snow.
"""
import base64
import json
import math
import struct
import sys

SIDE = 6000.0  # m


def hashed(x, y):
    """Uniform in 0 … 1 for whole numbers."""
    n = (x * 374761393 + y * 668265263) & 0xFFFFFFFF
    n = ((n ^ (n >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((n ^ (n >> 16)) & 0xFFFFFF) / float(0x1000000)


def noise(x, y):
    """Value noise with a smooth slope."""
    i, j = math.floor(x), math.floor(y)
    u, v = x - i, y - j
    u, v = u * u * u * (u * (6 * u - 15) + 10), v * v * v * (v * (6 * v - 15) + 10)
    a = hashed(i, j) + (hashed(i + 1, j) - hashed(i, j)) * u
    b = hashed(i, j + 1) + (hashed(i + 1, j + 1) - hashed(i, j + 1)) * u
    return a + (b - a) * v


def ridges(x, y):
    """0 … 1: sharp crests, and detail where they are high."""
    total, amplitude, weight = 0.0, 0.5, 1.0
    for octave in range(6):
        fold = 1 - abs(2 * noise(x + 17.3 * octave, y - 9.1 * octave) - 1)
        fold *= fold * weight
        weight = min(1.0, max(0.0, 1.6 * fold))
        total += amplitude * fold
        amplitude *= 0.5
        x, y = 1.95 * x + 0.37 * y, 1.95 * y - 0.37 * x
    return total


def height(east, south):
    """m, for a place so far from the middle: a valley that falls away from the north-west."""
    x, z = (east - south) * math.sqrt(0.5), (east + south) * math.sqrt(0.5)
    bend = 350 * math.sin(z / 1100 + 0.6)
    across = abs(x - bend)
    wall = 1 - math.exp(-((max(0.0, across - 220) / 900) ** 2))
    end = 0.3 / (1 + math.exp((z + 2300) / 260))
    rise = min(1.0, wall + end)
    rough = 30 * ridges(x / 240, z / 240) * (0.25 + rise)
    return 1500 * rise * (0.25 + ridges(x / 1700 + 3.1, z / 1700 + 7.7)) + rough


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    count = int(sys.argv[2]) if len(sys.argv) == 3 else 241
    step = SIDE / (count - 1)
    heights = [[height(i * step - SIDE / 2, j * step - SIDE / 2) for i in range(count)]
               for j in range(count)]
    positions, normals, colors = bytearray(), bytearray(), bytearray()
    lowest, highest = 1e9, -1e9
    for j in range(count):
        for i in range(count):
            x, z, y = i * step - SIDE / 2, j * step - SIDE / 2, heights[j][i]
            west, east = heights[j][max(i - 1, 0)], heights[j][min(i + 1, count - 1)]
            north, south = heights[max(j - 1, 0)][i], heights[min(j + 1, count - 1)][i]
            wide = step * (min(i + 1, count - 1) - max(i - 1, 0))
            deep = step * (min(j + 1, count - 1) - max(j - 1, 0))
            nx, nz = -(east - west) / wide, -(south - north) / deep
            length = math.sqrt(nx * nx + nz * nz + 1)
            positions += struct.pack("<3f", x, y, z)
            normals += struct.pack("<3f", nx / length, 1 / length, nz / length)
            steep = 1 - 1 / length
            patch = noise(x / 90 + 50, z / 90)
            snow = min(1, max(0, (y - 1050 + 250 * patch) / 160)) * min(1, max(0, (0.42 - steep) / 0.1))
            rock = min(1, max(0, (steep - 0.16 + 0.1 * patch) / 0.12))
            grass = (0.085 + 0.06 * patch, 0.10 + 0.035 * patch, 0.045)
            stone = (0.22, 0.20, 0.18)
            color = [(1 - rock) * g + rock * s for g, s in zip(grass, stone)]
            color = [(1 - snow) * c + snow * 0.85 for c in color]
            colors += struct.pack("<3f", *color)
            lowest, highest = min(lowest, y), max(highest, y)
    indices = bytearray()
    for j in range(count - 1):
        for i in range(count - 1):
            a, b, c, d = j * count + i, j * count + i + 1, (j + 1) * count + i, (j + 1) * count + i + 1
            indices += struct.pack("<6I", a, c, b, b, c, d)
    # A person on a slope in the south-east, who looks up the valley to the north-west.
    eye = (1950.0, height(1950, 1350) + 45, 1350.0)
    half_turn = math.radians(45 + 2) / 2
    turn = [0.0, math.sin(half_turn), 0.0, math.cos(half_turn)]
    blobs = [positions, normals, colors, indices]
    views, offset = [], 0
    for blob in blobs:
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": len(blob)})
        offset += len(blob)
    data = b"".join(blobs)
    vertices = count * count

    def accessor(view, component, kind, number, **more):
        return {"bufferView": view, "componentType": component, "type": kind, "count": number, **more}

    half = SIDE / 2
    document = {
        "asset": {"version": "2.0", "generator": "tools/make-landscape.py"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "name": "valley"},
                  {"camera": 0, "name": "wanderer", "translation": eye, "rotation": turn}],
        "cameras": [{"type": "perspective", "name": "wanderer",
                     "perspective": {"yfov": 0.72, "aspectRatio": 1.7778, "znear": 1,
                                     "zfar": 20000}}],
        "materials": [{"name": "land", "pbrMetallicRoughness": {
            "baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0, "roughnessFactor": 1}}],
        "meshes": [{"name": "valley", "primitives": [{
            "attributes": {"POSITION": 0, "NORMAL": 1, "COLOR_0": 2}, "indices": 3,
            "material": 0}]}],
        "accessors": [
            accessor(0, 5126, "VEC3", vertices, min=[-half, lowest, -half],
                     max=[half, highest, half]),
            accessor(1, 5126, "VEC3", vertices),
            accessor(2, 5126, "VEC3", vertices),
            accessor(3, 5125, "SCALAR", 6 * (count - 1) ** 2)],
        "bufferViews": views,
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(data).decode("ascii")}],
    }
    with open(sys.argv[1], "w", encoding="ascii") as out:
        json.dump(document, out)


if __name__ == "__main__":
    main()
