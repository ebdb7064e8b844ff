#!/usr/bin/env python3
"""Imports the files of cases.json, renders them, and holds the pictures against those of other players (references/, made by
judges/references.py). With --table, or where one is off, prints a row for each. Each imported graph also passes `weft format --check` and `weft check`.

    agreement.py WEFT [--table]
"""
import json
import pathlib
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parent / "app"))
from pictures import read_png  # noqa: E402
from program import run  # noqa: E402


def rgb_of(path):
    """(width, height) and the red, green and blue of all texels."""
    rows = read_png(path.read_bytes())
    return (len(rows[0]), len(rows)), [c for row in rows for texel in row for c in texel[:3]]


def difference(a, b):
    """(mean, largest) of 255."""
    each = [abs(x - y) for x, y in zip(a, b)]
    return sum(each) / len(each), max(each)


def weft(binary, *arguments):
    done = run(binary, *arguments)
    if done.code != 0:
        raise SystemExit(f"weft {' '.join(map(str, arguments))}: exit {done.code}\n{done.err}")
    return done


def main():
    binary = sys.argv[1]
    manifest = json.loads((FOLDER / "cases.json").read_text())
    size = "x".join(map(str, manifest["size"]))
    rows, problems = [], []
    with tempfile.TemporaryDirectory() as temporary:
        top = pathlib.Path(temporary)
        for case in manifest["cases"]:
            name, out = case["name"], top / case["name"]
            images = case.get("images", {} if case["file"].endswith(".fs") else {"picture": "card.png"})
            pictures = [word for image, file in images.items() for word in ("--image", f"{image}={FOLDER / 'pictures' / file}")]
            weft(binary, "import", FOLDER / case["file"], "-o", out, *pictures)
            graph = out / f"{name}.json"
            weft(binary, "format", "--check", graph)
            said = weft(binary, "check", graph, "--size", size).err
            if said:
                problems.append(f"{name}: check says\n{said}")
            shown = top / f"{name}.png"
            weft(binary, "render", graph, "--size", size, "--frames", case.get("frame", 0), "--quiet", "-o", shown)
            (got, rgb), (expected, expected_rgb) = rgb_of(shown), rgb_of(FOLDER / "references" / f"{name}.png")
            if got != expected:
                problems.append(f"{name}: {got} instead of {expected}")
                continue
            mean, largest = difference(rgb, expected_rgb)
            rows.append(f"| `{case['file']}` | {case['shows']} | {mean:.3f} | {largest} |")
            if mean > case["mean"] or largest > case["largest"]:
                problems.append(f"{name}: mean difference {mean:.3f} (at most {case['mean']}), largest {largest} (at most {case['largest']})")
    if "--table" in sys.argv or problems:
        print("\n".join(rows))
    print("\n".join(problems))
    return 1 if problems else 0


sys.exit(main())
