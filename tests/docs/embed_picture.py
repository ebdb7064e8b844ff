#!/usr/bin/env python3
"""Holds pictures of tests/docs/embed/extend.cpp against what `waves` and `fold` mean.

    embed_picture.py AT_0.png AT_0_AGAIN.png AT_1.png
"""
import math
import struct
import sys
import zlib

SIZE, SIDE = 40, 160  # of extend.json and extend.cpp: two pixels per texel in each quarter


def read_png(path):
    data = open(path, "rb").read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", f"{path} is no PNG"
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colors = struct.unpack(">IIBB", body[:10])
            assert (depth, colors) == (8, 6), f"{path}: {depth} bits, colour type {colors}, not 8-bit RGBA"
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    raw, rows, stride = zlib.decompress(packed), [], width * 4
    previous = bytearray(stride)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            a = row[i - 4] if i >= 4 else 0
            b, c = previous[i], previous[i - 4] if i >= 4 else 0
            p = a + b - c
            paeth = a if abs(p - a) <= abs(p - b) and abs(p - a) <= abs(p - c) else b if abs(p - b) <= abs(p - c) else c
            row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[kind]) & 255
        rows.append([tuple(row[x * 4:x * 4 + 4]) for x in range(width)])
        previous = row
    return rows


def check(path, time):
    rows = read_png(path)
    height, width = len(rows), len(rows[0])
    assert (width, height) == (SIDE, SIDE), f"{path}: {width} x {height}, not {SIDE} x {SIDE}"
    for y in range(height):
        for x in range(width):
            here = rows[y][x]
            assert here == rows[y][width - 1 - x] == rows[height - 1 - y][x], f"{path}: ({x}, {y}) is not mirrored"
            if x >= width // 2 or y < height // 2:
                continue
            # The lower left quarter: row 0 of the texture is its lowest.
            u, v = x // 2, (height - 1 - y) // 2
            wave = math.sin(0.2 * u + 0.1 * v + 3 * time)
            wanted = (255 * (0.5 + 0.5 * wave), 255 * u / SIZE, 255 * v / SIZE, 255)
            assert all(abs(a - b) <= 1 for a, b in zip(here, wanted)), f"{path}: ({x}, {y}) is {here}, not {wanted}"
    return rows


first, again, later = check(sys.argv[1], 0), check(sys.argv[2], 0), check(sys.argv[3], 1)
assert first == again, "two pictures of one time differ"
changed = sum(a != b for p, q in zip(first, later) for a, b in zip(p, q))
assert changed > 0.9 * SIDE * SIDE, f"only {changed} pixels changed with time"
print(f"embed: mirrored waves, {changed} of {SIDE * SIDE} pixels changed with time")
