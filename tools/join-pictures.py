#!/usr/bin/env python3
"""Puts PNG pictures of one size into a grid, two side by side: what `make demo` ends with.

usage: tools/join-pictures.py OUT.png PICTURE.png …
"""
import struct
import sys
import zlib


def read(path):
    """Width, height, channels and rows of an 8-bit RGB or RGBA picture without interlacing."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        sys.exit(f"{path}: not a PNG")
    at, packed = 8, b""
    while at < len(data):
        (size,) = struct.unpack(">I", data[at:at + 4])
        kind, body = data[at + 4:at + 8], data[at + 8:at + 8 + size]
        at += 12 + size
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            if depth != 8 or color not in (2, 6) or interlaced:
                sys.exit(f"{path}: not of 8 bits in RGB or RGBA")
            channels = 3 if color == 2 else 4
        elif kind == b"IDAT":
            packed += body
    raw, stride = zlib.decompress(packed), width * channels
    rows, above = [], bytearray(stride)
    for y in range(height):
        start = y * (stride + 1)
        kind, row = raw[start], bytearray(raw[start + 1:start + 1 + stride])
        for i in range(stride):
            left = row[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            if kind == 1:
                row[i] = (row[i] + left) & 255
            elif kind == 2:
                row[i] = (row[i] + above[i]) & 255
            elif kind == 3:
                row[i] = (row[i] + (left + above[i]) // 2) & 255
            elif kind == 4:
                guess = left + above[i] - corner
                distances = (abs(guess - left), abs(guess - above[i]), abs(guess - corner))
                row[i] = (row[i] + (left, above[i], corner)[distances.index(min(distances))]) & 255
        rows.append(row)
        above = row
    return width, height, [
        b"".join(bytes(row[x:x + 3]) for x in range(0, stride, channels)) for row in rows]


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    pictures = [read(path) for path in sys.argv[2:]]
    width, height, _ = pictures[0]
    if any(picture[:2] != (width, height) for picture in pictures):
        sys.exit("the pictures are not of one size")
    black = [bytes(3 * width)] * height
    lines = []
    for k in range(0, len(pictures), 2):
        right = pictures[k + 1][2] if k + 1 < len(pictures) else black
        lines += [a + b for a, b in zip(pictures[k][2], right)]
    # Each line as what it differs from the one above by: skies pack better so.
    above, differences = bytes(6 * width), []
    for line in lines:
        differences.append(b"\2" + bytes((a - b) & 255 for a, b in zip(line, above)))
        above = line

    def chunk(kind, body):
        return (struct.pack(">I", len(body)) + kind + body
                + struct.pack(">I", zlib.crc32(kind + body)))

    with open(sys.argv[1], "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n"
                  + chunk(b"IHDR", struct.pack(">IIBBBBB", 2 * width, len(lines), 8, 2, 0, 0, 0))
                  + chunk(b"IDAT", zlib.compress(b"".join(differences), 9)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
