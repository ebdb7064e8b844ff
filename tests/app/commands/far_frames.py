#!/usr/bin/env python3
"""A far frame of a set with gaps has the bytes that it has in a run from frame 0; graphs that remember nothing render it without the
frames before it, graphs that do run them all.

    far_frames.py WEFT
"""
import json
import pathlib
import sys

from program import Report, run, temporary_folder

SCENE = """{ "cameras": { "c": { "position": [0, 2, 8], "target": [0, 0, 0], "orbit": 30 } }, "spheres": [
  { "center": [0, 0, 0], "radius": 1, "material": { "albedo": [0.8, 0.3, 0.2], "roughness": 0.3 } },
  { "center": [2, 1, -1], "radius": 0.5, "material": { "albedo": [1, 0.9, 0.5], "metallic": 1, "roughness": 0.1 } } ] }
"""
# A `once` pass of what moves, and an age: kept from the first frame that ran, so the run must begin at 0.
KEPT = """{
  "resources": { "first": { "texture": "rgba16f", "size": "screen" }, "moving": { "texture": "rgba16f", "size": "screen" },
                 "ldr": { "texture": "rgba8", "size": "screen" } },
  "passes": [
    { "name": "sky", "type": "fullscreen", "shader": "sky/sky.frag.glsl", "read": { "environment": "@environment" },
      "write": { "radiance": "moving" } },
    { "name": "keep", "type": "blit", "update": "once", "read": { "source": "moving" }, "write": { "destination": "first" } },
    { "name": "composite", "type": "fullscreen", "shader": "composite/composite.frag.glsl", "read": { "color": "first" },
      "write": { "result": "ldr" } } ],
  "present": "ldr" }
"""
LAST = 40


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        (folder / "scene.json").write_text(SCENE)
        (folder / "kept.json").write_text(KEPT)
        common = ["--scene", folder / "scene.json", "--size", "64x36", "--quiet", "--stats"]
        cases = [("graphs/glow.json", [], 2), ("graphs/studio.json", ["--set", "motion_blur=true"], 2),
                 ("graphs/studio.json", ["--set", "auto_exposure=true"], LAST + 1),
                 (folder / "kept.json", [], LAST + 1)]
        for graph, more, frames in cases:
            label = f"{pathlib.Path(graph).name} {' '.join(more)}"
            alone = run(weft, "render", graph, "-o", folder / "alone_%d.png", "--frames", f"9,{LAST}", *more, *common)
            every = run(weft, "render", graph, "-o", folder / "f_%d.png", "--frames", f"0:{LAST}", *more, *common)
            if not report.check(alone.code == 0 and every.code == 0, f"{label}: {alone.err}{every.err}"):
                continue
            ran = json.JSONDecoder().raw_decode(alone.err[alone.err.index("{"):])[0]["times"]["frames_run"]
            report.check(ran == frames, f"{label}: {ran} frames ran, not {frames}")
            report.check((folder / f"alone_{LAST}.png").read_bytes() == (folder / f"f_{LAST}.png").read_bytes(),
                         f"{label}: frame {LAST} behind 9 is not frame {LAST} of a run")
            first = (folder / "f_0.png").read_bytes() == (folder / f"f_{LAST}.png").read_bytes()
            report.check(first == (graph == folder / "kept.json"), f"{label}: frames 0 and {LAST} are {'' if first else 'not '}the same")
    report.end()


main()
