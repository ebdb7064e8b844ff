#!/usr/bin/env python3
"""The presets of graphs/presets: their tables are what make_luts.py writes, and each is a look of its own on the studio.

Usage: presets.py WEFT, from the source folder.
Each preset passes `check`; renders from another working directory, so that its table is found beside it; differs from the
picture without preset and from every other one; and is a picture: neither flat, nor mostly black or white. One that is for
another graph than the studio is held against that graph. Pictures are drawn with small maps of the environment.
"""
import pathlib
import subprocess
import sys
import tempfile

from program import TOP, run

sys.path.insert(0, str(TOP / "docs/gallery"))
from png import read_png  # noqa: E402

WEFT = pathlib.Path(sys.argv[1]).resolve()
PRESETS = sorted((TOP / "graphs/presets").glob("*.json"))
# Which are for another graph, on which scene, and how different they look at least: mean step of 255.
STUDIO = ("graphs/studio.json", None, 1)
OTHERS = {"point_probes": ("graphs/studio_gi.json", "docs/gallery/bounce.json", 0.02)}
failures = []


def expect(what, held):
    if not held:
        failures.append(what)
        print("FAILED", what)


def pixels_of(path):
    """RGB bytes of a PNG."""
    channels, texels = read_png(path)
    return bytes(value for i, value in enumerate(texels) if i % channels < 3)


def difference(a, b):
    return sum(abs(x - y) for x, y in zip(a, b)) / len(a)


def main():
    luts = subprocess.run([sys.executable, TOP / "graphs/presets/luts/make_luts.py", "--check"], capture_output=True, text=True)
    expect("the tables are what make_luts.py writes: " + luts.stdout, luts.returncode == 0)
    expect("there are at least eight presets", len(PRESETS) >= 8)
    pictures = {}
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        plain = [(None, STUDIO), *((None, other) for other in dict.fromkeys(OTHERS.values()))]
        for preset, on in [*plain, *((preset, OTHERS.get(preset.stem, STUDIO)) for preset in PRESETS)]:
            graph, scene, _ = on
            name = preset.stem if preset else f"no preset on {pathlib.Path(graph).stem}"
            over = ["--preset", preset] if preset else []
            over += ["--scene", TOP / scene] if scene else []
            checked = run(WEFT, "check", graph, *over)
            expect(f"{name} passes check\n{checked.err}", checked.code == 0 and not checked.err)
            image = folder / f"{name}.png"
            done = run(WEFT, "render", TOP / graph, "--preset", TOP / "tests/small_maps.json", *over, "--size", "128x72", "--frames", "1:1",
                       "--program-cache", folder / "programs", "-o", image, folder=folder)
            expect(f"{name} renders\n{done.err}", done.code == 0 and image.exists())
            if not image.exists():
                continue
            pixels = pixels_of(image)
            pictures[name] = (on, pixels)
            mean = sum(pixels) / len(pixels)
            spread = sum(abs(p - mean) for p in pixels) / len(pixels)
            extreme = sum(p in (0, 255) for p in pixels) / len(pixels)
            print(f"{name}: mean {mean:.0f}, deviation {spread:.0f}, {100 * extreme:.1f} % clipped")
            expect(f"{name} is a picture", 15 < mean < 240 and spread > 8 and extreme < 0.15)
    names = list(pictures)
    for i, a in enumerate(names):
        for b in names[:i]:
            (on, mine), (other, theirs) = pictures[a], pictures[b]
            expect(f"{a} looks different from {b}", on != other or difference(mine, theirs) > on[2])
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
