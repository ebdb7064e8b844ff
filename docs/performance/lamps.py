#!/usr/bin/env python3
"""What lamps cost in graphs/deferred.json: prints one JSON, each pass in full-screen copies, for 1, 100 and 1,000 lamps.

    docs/performance/lamps.py [--build FOLDER] [--size WxH] [--spheres]

A floor with rocks fills the picture. `near`: lamps over the same floor that reach 0.35 each, so more of them are denser; `everywhere`: each lamp
reaches every pixel, clusters have nothing to rule out. `touched` is how many lamps a pixel goes through, on average, read from a picture
with show_lamps, whose scale ends at 64: where more than one pixel in a hundred is at its end, it is null, and `touched_over_64` is their share. With --spheres, ray-traced spheres fill the picture instead, whose pass is lit.spheres.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
sys.path.insert(0, str(TOP / "docs/gallery"))
from png import read_png

GRAPH = "graphs/deferred.json"
FEW = int(re.search(r'"few_lamps": (\d+)', (TOP / GRAPH).read_text()).group(1))  # lamps that go without clusters
GRIDS = {1: ([1, 1, 1], 0.32), 100: ([10, 1, 10], 0.32), 1000: ([20, 5, 10], 0.16)}
PASSES = ("lit.lighting", "lit.spheres", "light_clusters.lamps_in_tiles", "light_clusters.lamps_in_slices")


def scene_of(lamps, everywhere, spheres):
    count, spacing = GRIDS[lamps]
    models = TOP / "scenes/models"
    meshes = {"models": {"floor": {"file": str(models / "floor.obj"), "scale": 4},
                         "rocks": {"file": str(models / "rock.obj"), "count": [6, 1, 6], "spacing": 0.5, "scale": 0.4}}}
    balls = {"materials": {"gray": {"albedo": [0.5, 0.5, 0.5]}},
             "grid": {"count": [36, 1, 24], "spacing": 0.16, "radius": 0.1, "materials": ["gray"]}}
    return {
        "cameras": {"above": {"position": [0, 2.2, 1.6], "target": [0, 0, 0], "fov": 50}},
        **(balls if spheres else meshes),
        "lamp_grids": {"lamps": {"count": count, "spacing": spacing, "center": [0, 0.45, 0], "candela": 300,
                                 "range": 50 if everywhere else 0.35}},
    }


def linear(byte):
    x = byte / 255
    return x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4


def touched_in(path):
    """The mean number of lamps and the share of pixels at the end of the scale, from the colors of show_lamps: log2 of the number by 3, from
    blue (0) by green (1) to red (2). None of these has both red and blue, as the sky has: such pixels are left out."""
    channels, texels = read_png(path)
    total, pixels, at_end = 0.0, 0, 0
    for i in range(0, len(texels), channels):
        red, green, blue = (linear(c) for c in texels[i:i + 3])
        if min(red, blue) > 0.1:
            continue
        pixels += 1
        at_end += red > 0.995
        if max(red, green, blue) > 0.1:  # else none
            total += 2 ** (3 * (1 - blue if blue > red else 1 + red))
    return total / pixels, at_end / pixels


def run(build, command, *line):
    programs = {"render": ["app/weft", "render"], "bench": ["tests/bench/weft_bench", "bench"]}
    program, *words = programs[command] if build else ["run", command]
    done = subprocess.run([pathlib.Path(build or TOP) / program, *words, *map(str, line)], cwd=TOP, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    return done.stdout


def measure(build, size, lamps, everywhere, spheres, folder):
    scene, picture = folder / "scene.json", folder / "touched.png"
    scene.write_text(json.dumps(scene_of(lamps, everywhere, spheres)))
    touched, over = (lamps, 0) if everywhere else (None, 0)
    if not everywhere:
        sets = ["show_lamps=true", "bloom=false", "fxaa=false", "dither=false", "curve=linear", "composite.white=1"]
        run(build, "render", GRAPH, "--scene", scene, "--size", size, "--quiet", "-o", picture, *(w for s in sets for w in ("--set", s)))
        touched, over = touched_in(picture)
    bench = json.loads(run(build, "bench", "--frame", GRAPH, "--variant", "plain", "--scene", scene, "--size", size))
    plain, = bench["variants"]
    row = {"lamps": lamps, "reach": "everywhere" if everywhere else "near", "touched": round(touched, 2) if over <= 0.01 else None,
           "frame_copies": plain["copies"], "passes": {each["pass"]: each["copies"] for each in plain["passes"]}}
    if over > 0.01:
        row["touched_over_64"] = round(over, 2)
    if "cpu_copies" in plain:
        row["frame_cpu_copies"] = plain["cpu_copies"]
    return bench["device"], bench["copy_ms"], row


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", help="folder of a build; ./run when absent")
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--spheres", action="store_true")
    arguments = parser.parse_args()
    out = {"graph": GRAPH, "size": arguments.size, "rows": []}
    with tempfile.TemporaryDirectory() as folder:
        for everywhere in (False, True):
            for lamps in GRIDS:
                device, copy, row = measure(arguments.build, arguments.size, lamps, everywhere, arguments.spheres, pathlib.Path(folder))
                out["device"], row["copy_ms"] = device, copy
                out["rows"].append(row)
                missing = [name for name in PASSES if name not in row["passes"] and (lamps > FEW or "clusters" not in name)]
                if missing:
                    sys.exit(f"{lamps} lamps: the frame has no {', '.join(missing)}")
    print(json.dumps(out, indent=1))


if __name__ == "__main__":
    main()
