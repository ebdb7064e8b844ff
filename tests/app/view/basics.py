#!/usr/bin/env python3
"""`weft view` without a display: it says so. With --window, in a virtual display: five frames, a screenshot that is a picture,
exit code 0, and a recording that equals what `weft render` makes.

    basics.py WEFT COMPARE [--window]
"""
import json
import os
import pathlib
import shutil
import sys

from program import TOP, Report, run, temporary_folder
from window import display


def said(done):
    """But for how files are watched, which depends on what else runs."""
    return [d for d in done.diagnostics if d["code"] != "W205"]


def main():
    weft, compare, report = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), Report()
    if "--window" in sys.argv:
        in_window(weft, compare, report)
    else:
        without_display(weft, report)
    report.end()


def without_display(weft, report):
    bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    without = run(weft, "view", "graphs/glow.json", "--max-frames", "1", "--program-cache", "none", env=bare)
    report.check(without.code == 3 and without.codes() == ["W110"], f"without a display: {without.code}\n{without.err}")
    wrong = run(weft, "view", "graphs/glow.json", "--screenshot", "shot.jpg", env=bare)
    report.check(wrong.code == 1 and wrong.codes() == ["W180"], f"--screenshot shot.jpg: {wrong.code}\n{wrong.err}")


def in_window(weft, compare, report):
    if not shutil.which("Xvfb"):
        report.skip("Xvfb is not installed")
    with temporary_folder() as name, display() as environment:
        for graph in ("studio", "glow"):
            shot = pathlib.Path(name) / f"{graph}.png"
            done = run(weft, "view", f"graphs/{graph}.json", "--size", "640x360", "--max-frames", "5", "--screenshot", shot,
                       "--wait-for-assets",
                       "--program-cache", "none", env=environment)
            report.check(done.code == 0, f"{graph}: exit code {done.code}\n{done.err}")
            report.check(not said(done), f"{graph}: {done.err}")
            if not report.check(shot.exists(), f"{graph}: no screenshot"):
                continue
            mean = run(compare, "--describe", shot)
            words = mean.out.split()
            report.check(mean.code == 0 and words[:2] == ["640", "360"], f"{graph}: {mean.out}{mean.err}")
            report.check(20 < float(words[2]) < 235 and float(words[3]) > 10, f"{graph}: mean and spread {words[2:]}")
        wide_parameters(weft, pathlib.Path(name), environment, report)
        recording(weft, compare, pathlib.Path(name), environment, report)


WIDE = """{
  "parameters": {
    "seed": { "type": "int", "default": 7, "min": 0, "max": 2147483647 },
    "bits": { "type": "int", "default": 4294967295, "min": 0, "max": 4294967295 },
    "free": { "type": "int", "default": 1e30 },
    "size": { "type": "float", "default": 0.5, "min": -1e308, "max": 1.7e308 },
    "tint": { "type": "vec3", "default": [0.5, 1e30, -1e30], "min": -1e300, "max": 1e300 } },
  "resources": { "ldr": { "texture": "rgba8", "size": "screen" } },
  "passes": [
    { "name": "base", "type": "fullscreen", "shader": "wide.frag.glsl", "write": { "result": "ldr" },
      "parameters": { "seed": "$seed", "bits": "$bits", "free": "$free", "size": "$size", "tint": "$tint" } } ],
  "present": "ldr"
}
"""
WIDE_SHADER = """layout(std140) uniform Parameters { int seed; uint bits; int free; float size; vec3 tint; };
in vec2 uv;
out vec4 result;
void main() { result = vec4(seed == 7, bits == 0xffffffffu, free == 0x7fffffff, 1) * size * uv.x + vec4(0.0001 * tint.x); }
"""


def wide_parameters(weft, folder, environment, report):
    """Parameters with the widest ranges and values: the panel takes them all."""
    (folder / "shaders").mkdir()
    (folder / "shaders/wide.frag.glsl").write_text(WIDE_SHADER)
    (folder / "wide.json").write_text(WIDE)
    done = run(weft, "view", "wide.json", "--size", "640x480", "--max-frames", "4", "--program-cache", "none", env=environment, folder=folder)
    report.check(done.code == 0 and not said(done), f"wide parameters: exit code {done.code}\n{done.err}")


def recording(weft, compare, folder, environment, report):
    """--record is `weft render --frames`, with a moving camera, blur of its motion and an exposure that adapts."""
    scene = folder / "orbit.json"
    text = (TOP / "scenes/spheres.json").read_text().replace("../materials", json.dumps(str(TOP / "materials"))[1:-1])
    scene.write_text(text.replace('"target": [0, 0, 0], "fov": 60 }', '"target": [0, 0, 0], "fov": 60, "orbit": 90 }', 1))
    graph = ["graphs/studio.json", "--scene", scene, "--size", "160x90", "--set", "motion_blur=true", "--set", "auto_exposure=true",
             "--fps", "24", "--program-cache", "none"]
    done = run(weft, "view", *graph, "--record", folder / "rec/f_%02d.png", "--max-frames", "6", "--screenshot", folder / "end.exr",
               "--render-scale", "1", "--stats", env=environment)
    report.check(done.code == 0 and '"gl_objects_left": "none"' in done.err, f"recording: {done.code}\n{done.err}")
    same = run(weft, "render", *graph, "-o", folder / "ren/f_%02d.png", "--frames", "0:5", "--quiet")
    report.check(same.code == 0, same.err)
    pictures = [[folder / f"{kind}/f_{i:02}.png" for kind in ("rec", "ren")] for i in range(6)]
    for recorded, rendered in pictures:
        if report.check(recorded.exists() and rendered.exists(), f"{recorded} or {rendered} is missing"):
            report.check(recorded.read_bytes() == rendered.read_bytes(), f"{recorded.name} differs from weft render's")
    report.check(pictures[0][0].read_bytes() != pictures[5][0].read_bytes(), "the camera stands still")
    report.check((folder / "end.exr").exists(), "no .exr")
    half = run(weft, "view", *graph, "--max-frames", "1", "--screenshot", folder / "half.png", "--render-scale", "0.5", env=environment)
    report.check(run(compare, "--describe", folder / "half.png").out.split()[:2] == ["80", "45"], f"render scale: {half.err}")


main()
