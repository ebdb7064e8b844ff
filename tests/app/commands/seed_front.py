#!/usr/bin/env python3
"""The front view beside the reference picture: sphere for sphere at the same place, with colours in the same order.

Usage: seed_front.py WEFT REFERENCES. Skipped where REFERENCES has no such picture. The reference has another tone curve, other filtering and hard
edges, so pixels are not compared: see docs/seed_front.md.
"""
import json
import math
import pathlib
import sys

from program import TOP, Report, run, temporary_folder

sys.path.insert(0, str(TOP / "docs/gallery"))
from png import read_png  # noqa: E402

WIDTH, HEIGHT = 1280, 720
DISC = 16      # pixels around a centre whose mean is a sphere's colour
PATCH = 44     # half the side of the patch that is aligned, 4 to 10 pixels beyond the silhouette
SHIFT = 4
INSIDE = 20    # pixels around a centre in which what is reflected is looked at


def rows_of(path):
    """Rows of RGB bytes of a picture of WIDTH x HEIGHT."""
    n, texels = read_png(path)
    assert n >= 3 and len(texels) == WIDTH * HEIGHT * n
    colors = list(zip(texels[0::n], texels[1::n], texels[2::n]))
    return [colors[y * WIDTH:(y + 1) * WIDTH] for y in range(HEIGHT)]


def centers():
    """Where the middles of the spheres are: column, row, x, y in pixels; the perspective image of a sphere is not centred
    on that of its centre."""
    focal = HEIGHT / 2 / math.tan(math.radians(30))
    for row in range(10):
        for column in range(10):
            x, y, z, r = (column - 4.5) * 2.5, (4.5 - row) * 2.5, 20, 1
            scale = focal * z / (z * z - r * r)
            yield column, row, WIDTH / 2 + x * scale, HEIGHT / 2 - y * scale


def mean_color(picture, x, y):
    sums, count = [0, 0, 0], 0
    for j in range(-DISC, DISC + 1):
        for i in range(-DISC, DISC + 1):
            if i * i + j * j > DISC * DISC:
                continue
            texel = picture[int(y) + j][int(x) + i]
            for c in range(3):
                sums[c] += texel[c]
            count += 1
    return [s / count for s in sums]


def edges(picture, x, y, reach):
    """How much neighbours differ, on every second pixel of a square."""
    out = {}
    for j in range(-reach, reach + 1):
        row, below = picture[int(y) + j], picture[int(y) + j + 1]
        for i in range(-reach, reach + 1):
            a, b, c = row[int(x) + i], row[int(x) + i + 1], below[int(x) + i]
            out[i, j] = min(sum(abs(a[k] - b[k]) + abs(a[k] - c[k]) for k in range(3)), 120)
    return out


def contrast(picture, x, y):
    """How much the brightness of neighbours differs within a sphere, of its mean."""
    brightness = lambda texel: 0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2]
    differences, mean = 0, 0
    for j in range(-INSIDE, INSIDE + 1):
        row, below = picture[int(y) + j], picture[int(y) + j + 1]
        for i in range(-INSIDE, INSIDE + 1):
            if i * i + j * j > INSIDE * INSIDE:
                continue
            here = brightness(row[int(x) + i])
            differences += abs(here - brightness(row[int(x) + i + 1])) + abs(here - brightness(below[int(x) + i]))
            mean += here
    return differences / mean


def best_shift(ours, theirs, x, y):
    # Only a ring about the silhouette: what is reflected inside differs.
    ring = [(i, j) for i in range(-PATCH, PATCH + 1, 2) for j in range(-PATCH, PATCH + 1, 2)
            if 24 <= math.hypot(i, j) <= PATCH]
    a, b = edges(ours, x, y, PATCH), edges(theirs, x, y, PATCH + SHIFT)

    def likeness(shift):
        return sum(a[p] * b[p[0] + shift[0], p[1] + shift[1]] for p in ring)

    shifts = [(i, j) for i in range(-SHIFT, SHIFT + 1) for j in range(-SHIFT, SHIFT + 1)]
    return max(shifts, key=likeness)


def ranks(values):
    order = sorted(range(len(values)), key=lambda i: values[i])
    out = [0] * len(values)
    for rank, i in enumerate(order):
        out[i] = rank
    return out


def correlation(a, b):
    """Spearman's."""
    n = len(a)
    return 1 - 6 * sum((p - q) ** 2 for p, q in zip(ranks(a), ranks(b))) / (n * (n * n - 1))


def main():
    weft, references, report = sys.argv[1], pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else ""), Report()
    if not (references / "seed_front_720.png").exists():
        report.skip("no references: configure with -DWEFT_REFERENCES=FOLDER")
    with temporary_folder() as folder:
        picture = pathlib.Path(folder) / "front.png"
        done = run(weft, "render", "graphs/studio.json", "--materials", references / "seed_materials.json", "--environment",
                   references / "procedural_env_2k.hdr", "--size", f"{WIDTH}x{HEIGHT}", "--quiet", "-o", picture)
        report.check(done.code == 0, f"render: exit code {done.code}\n{done.err}")
        if done.code:
            report.end()
        ours = rows_of(picture)
    theirs = rows_of(references / "seed_front_720.png")

    whole = [c for c in centers() if PATCH + SHIFT + 1 < c[3] < HEIGHT - PATCH - SHIFT - 2]
    report.check(len(whole) == 80, f"{len(whole)} spheres are whole in the picture, expected 80")
    shifts = [best_shift(ours, theirs, x, y) for _, _, x, y in whole]
    aligned = sum(max(abs(i), abs(j)) <= 1 for i, j in shifts)
    print(f"aligned within a pixel: {aligned} of {len(whole)}; others {[(w[:2], s) for w, s in zip(whole, shifts) if max(map(abs, s)) > 1]}")
    report.check(aligned >= 76, f"only {aligned} of {len(whole)} silhouettes lie within a pixel of the reference's")

    a, b = [mean_color(ours, x, y) for _, _, x, y in whole], [mean_color(theirs, x, y) for _, _, x, y in whole]
    for name, weights in (("brightness", (0.2126, 0.7152, 0.0722)), ("red against green", (1, -1, 0)), ("blue against green", (0, -1, 1))):
        value = correlation(*([sum(w * c for w, c in zip(weights, color)) for color in colors] for colors in (a, b)))
        print(f"{name}: rank correlation {value:.3f}")
        report.check(value > 0.9, f"{name} of the spheres: rank correlation {value:.3f}")

    # docs/seed_front.md says how much more or less blurred metals are here.
    metals = json.loads((references / "seed_materials.json").read_text())
    for least, most, low, high in ((0, 0.1, 1.5, 3), (0.25, 1, 0.2, 0.85)):
        ratios = [contrast(ours, x, y) / contrast(theirs, x, y) for column, row, x, y in whole
                  if (metal := metals[row * 10 + column])["metallic"] == 1 and least <= metal["roughness"] <= most]
        print(f"metals of roughness {least} to {most}: {len(ratios)}, neighbours differ {min(ratios):.2f} to {max(ratios):.2f} times as much as there")
        report.check(len(ratios) >= 3 and low < min(ratios) and max(ratios) < high,
                     f"metals of roughness {least} to {most}: expected {low} to {high} times the reference's contrast, found {min(ratios):.2f} to {max(ratios):.2f}")
    report.end()


main()
