#!/usr/bin/env python3
"""Holds pictures of tests/docs/embed/extend.cpp against what `waves` and `fold` mean.

    embed_picture.py AT_0.png AT_0_AGAIN.png AT_1.png
"""
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "app"))
from pictures import read_png  # noqa: E402

SIZE, SIDE = 40, 160  # of extend.json and extend.cpp: two pixels per texel in each quarter


def check(path, time):
    rows = read_png(pathlib.Path(path).read_bytes())
    height, width = len(rows), len(rows[0])
    assert (width, height) == (SIDE, SIDE), f"{path}: {width} x {height}, not {SIDE} x {SIDE}"
    for y in range(height):
        for x in range(width):
            here = rows[y][x]
            assert len(here) == 4, f"{path}: {len(here)} channels, not RGBA"
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
