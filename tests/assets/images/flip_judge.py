#!/usr/bin/env python3
"""Weft's FLIP against a second implementation, written from the definition and as plainly as that: every filter is two-dimensional and
normalized as a whole, nothing is separated. "FLIP: A Difference Evaluator for Alternating Images", Andersson, Nilsson, Akenine-Möller,
Oskarsson, Åström, Fairchild, HPG 2020; the numbers are those of the paper and its tables.

    flip_judge.py WEFT_COMPARE
"""
import math
import pathlib
import random
import subprocess
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parents[3] / "docs/gallery"))
from png import encode  # noqa: E402

# ---- color ----
TO_XYZ = ((10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794),
          (2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897),
          (1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382))
# The inverse, by another way than Weft's: the numbers that NVIDIA publishes, to nine digits.
TO_RGB = ((3.241003275, -1.537398934, -0.498615861), (-0.969224334, 1.875930071, 0.041554224), (0.055639423, -0.204011202, 1.057148933))
WHITE = (0.950428545, 1.0, 1.088900371)


def times(matrix, v):
    return [sum(m * x for m, x in zip(row, v)) for row in matrix]


def linear(srgb):
    return srgb / 12.92 if srgb <= 0.04045 else ((srgb + 0.055) / 1.055) ** 2.4


def ycxcz(rgb):
    x, y, z = (v / w for v, w in zip(times(TO_XYZ, rgb), WHITE))
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def rgb_of(opponent):
    y = (opponent[0] + 16) / 116
    return times(TO_RGB, [v * w for v, w in zip((y + opponent[1] / 500, y, y - opponent[2] / 200), WHITE)])


def hunt_lab(rgb):
    def f(t):
        return t ** (1 / 3) if t > (6 / 29) ** 3 else t / (3 * (6 / 29) ** 2) + 4 / 29
    x, y, z = (f(v / w) for v, w in zip(times(TO_XYZ, rgb), WHITE))
    lightness = 116 * y - 16
    return lightness, 0.01 * lightness * 500 * (x - y), 0.01 * lightness * 200 * (y - z)


def hyab(a, b):
    return abs(a[0] - b[0]) + math.sqrt((a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2)


# ---- filters: dictionaries from offsets to weights ----
CSF = ([(1, 0.0047)], [(1, 0.0053)], [(34.1, 0.04), (13.5, 0.025)])


def sensitivity(channel, density):
    radius = math.ceil(3 * math.sqrt(0.04 / (2 * math.pi ** 2)) * density)
    weights = {}
    for y in range(-radius, radius + 1):
        for x in range(-radius, radius + 1):
            d2 = (x / density) ** 2 + (y / density) ** 2
            weights[x, y] = sum(a * math.sqrt(math.pi / b) * math.exp(-math.pi ** 2 * d2 / b) for a, b in CSF[channel])
    whole = sum(weights.values())
    return {at: w / whole for at, w in weights.items()}


def detector(kind, density):
    deviation = 0.5 * 0.082 * density
    radius = math.ceil(3 * deviation)
    weights = {}
    for y in range(-radius, radius + 1):
        for x in range(-radius, radius + 1):
            g = math.exp(-(x * x + y * y) / (2 * deviation ** 2))
            weights[x, y] = -x * g if kind == "edge" else (x * x / deviation ** 2 - 1) * g
    positive, negative = sum(w for w in weights.values() if w > 0), -sum(w for w in weights.values() if w < 0)
    return {at: w / (positive if w > 0 else negative) for at, w in weights.items()}


def turned(weights):
    return {(y, x): w for (x, y), w in weights.items()}


def apply(plane, weights):
    height, width = len(plane), len(plane[0])
    columns = range(width)
    out = [[0.0] * width for _ in range(height)]
    for (dx, dy), w in weights.items():
        if w == 0:
            continue
        source = [min(max(x + dx, 0), width - 1) for x in columns]
        for y in range(height):
            row, to = plane[min(max(y + dy, 0), height - 1)], out[y]
            for x in columns:
                to[x] += w * row[source[x]]
    return out


# ---- the metric ----
def side(image, density):
    opponent = [[ycxcz([linear(c / 255) for c in texel]) for texel in row] for row in image]
    planes = [apply([[texel[i] for texel in row] for row in opponent], sensitivity(i, density)) for i in range(3)]
    colors = [[hunt_lab([min(max(c, 0), 1) for c in rgb_of(texel)]) for texel in zip(*rows)] for rows in zip(*planes)]
    y = [[(texel[0] + 16) / 116 for texel in row] for row in opponent]
    features = []
    for kind in ("edge", "point"):
        weights = detector(kind, density)
        a, b = apply(y, weights), apply(y, turned(weights))
        features.append([[math.hypot(u, v) for u, v in zip(*rows)] for rows in zip(a, b)])
    return colors, features


def flip(reference, test, density):
    (colors, features), (others, their_features) = side(reference, density), side(test, density)
    largest = hyab(hunt_lab((0, 1, 0)), hunt_lab((0, 0, 1))) ** 0.7
    knee, out = 0.4 * largest, []
    for y, row in enumerate(colors):
        for x, color in enumerate(row):
            e = hyab(color, others[y][x]) ** 0.7
            e = 0.95 / knee * e if e < knee else 0.95 + (e - knee) / (largest - knee) * 0.05
            f = max(abs(mine[y][x] - theirs[y][x]) for mine, theirs in zip(features, their_features))
            out.append(e ** (1 - math.sqrt(f / math.sqrt(2))))
    return out


# ---- pictures ----
def write_png(path, image):
    path.write_bytes(encode(len(image[0]), 3, bytes(c for row in image for texel in row for c in texel)))


def picture(width, height, texel):
    return [[tuple(min(max(int(c), 0), 255) for c in texel(x, y)) for x in range(width)] for y in range(height)]


def pairs():
    """Name, reference, test, pixels per degree."""
    dice = random.Random(7)
    noise = picture(24, 17, lambda x, y: [dice.randrange(256) for _ in range(3)])
    other = picture(24, 17, lambda x, y: [dice.randrange(256) for _ in range(3)])
    ramp = picture(33, 9, lambda x, y: (8 * x, 20 * y, 255 - 7 * x))
    black, white = picture(11, 11, lambda x, y: (0, 0, 0)), picture(11, 11, lambda x, y: (255, 255, 255))
    dot = picture(11, 11, lambda x, y: (255, 255, 255) if (x, y) == (5, 5) else (0, 0, 0))
    edge = picture(21, 13, lambda x, y: (230, 30, 60) if x < 10 else (20, 120, 40))
    moved = picture(21, 13, lambda x, y: (230, 30, 60) if x < 11 else (20, 120, 40))
    green, blue = picture(7, 5, lambda x, y: (0, 255, 0)), picture(7, 5, lambda x, y: (0, 0, 255))
    one_more = picture(33, 9, lambda x, y: (8 * x + 1, 20 * y, 255 - 7 * x))
    usual = 0.7 * 3840 / 0.7 * math.pi / 180
    return [("noise", noise, other, usual), ("noise, near", noise, other, 20), ("a ramp and one step more", ramp, one_more, usual),
            ("black and white", black, white, usual), ("a dot", black, dot, usual), ("an edge that moves", edge, moved, usual),
            ("an edge that moves, from afar", edge, moved, 110), ("green and blue", green, blue, usual), ("the same", ramp, ramp, usual)]


def main():
    compare, problems, worst = sys.argv[1], [], 0.0
    with tempfile.TemporaryDirectory(prefix="weft_flip_") as folder:
        a, b = pathlib.Path(folder) / "a.png", pathlib.Path(folder) / "b.png"
        for name, reference, test, density in pairs():
            write_png(a, reference), write_png(b, test)
            done = subprocess.run([compare, "--flip", a, b, repr(density)], capture_output=True, text=True)
            found, expected = [float(line) for line in done.stdout.split()], flip(reference, test, density)
            if len(found) != len(expected) or done.returncode:
                problems.append(f"{name}: {len(found)} pixels, not {len(expected)}\n{done.stderr}")
                continue
            difference = max(abs(x - y) for x, y in zip(found, expected))
            worst = max(worst, difference)
            mean = sum(expected) / len(expected)
            print(f"{name}: mean {mean:.6f}, from {min(expected):.4f} to {max(expected):.4f}, differs by {difference:.1e}")
            if difference > 2e-6:
                problems.append(f"{name}: differs by {difference}")
            if (mean == 0) != (name == "the same"):
                problems.append(f"{name}: mean {mean}")
    print("\n".join(f"FAILED: {problem}" for problem in problems) or f"all agree, to {worst:.1e}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
