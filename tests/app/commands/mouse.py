#!/usr/bin/env python3
"""The mouse in commands: `--mouse` and the key of test cases, every texel of what a shader makes of it against the definition in
docs/shaders.md, Shadertoy's iMouse as the tutorial defines it, and what is no mouse.

    mouse.py WEFT
"""
import json
import math
import os
import pathlib
import sys

from pictures import read_exr
from program import TOP, Report, run, temporary_folder

STATE = "tests/imports/graphs/mouse.json"
WIDTH, HEIGHT = 24, 16
TOY = """#include "shadertoy.glsl"
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
  fragColor = vec4(distance(fragCoord, iMouse.xy) < 4.0, distance(fragCoord, abs(iMouse.zw)) < 2.0, iMouse.z > 0.0, iMouse.w > 0.0);
}
"""
TOY_GRAPH = """{
  "resources": { "ldr": { "texture": "rgba16f", "size": "screen" } },
  "passes": [ { "name": "image", "type": "fullscreen", "shader": "tutorials/marks.frag.glsl", %s"write": { "fragColor": "ldr" } } ],
  "present": "ldr" }
"""


def state(x=0.0, y=0.0, down=False, frame=0):
    """The row of @mouse in a headless run: a held button went down in frame 0, where the mouse still is."""
    pressed = (x, y) if down else (0.0, 0.0)
    return {"position": (x, y), "dragged": pressed, "pressed": pressed, "down": float(down), "clicked": float(down and frame == 0)}


def of_state(row):
    """What tests/imports/shaders/mouse/state.frag.glsl makes of it."""
    even, odd = (*row["position"], *row["dragged"]), (*row["pressed"], row["down"], row["clicked"])
    return [[odd if x % 2 else even for x in range(WIDTH)] for _ in range(HEIGHT)]


def of_toy(row):
    """What TOY draws, by the definition of iMouse: xy where the mouse was last while held, |zw| where it went down, z and w negative unless it is
    held and unless it just went down."""
    def texel(x, y):
        near = lambda point, radius: float(math.dist((x + 0.5, y + 0.5), point) < radius)
        return near(row["dragged"], 4), near(row["pressed"], 2), row["down"], row["clicked"]

    return [[texel(x, HEIGHT - 1 - y) for x in range(WIDTH)] for y in range(HEIGHT)]  # the top row first


class Bench:
    def __init__(self, weft, folder, report):
        self.weft, self.folder, self.report = weft, folder, report

    def render(self, graph, *options):
        return run(self.weft, "render", graph, "--size", f"{WIDTH}x{HEIGHT}", "--quiet", "--backend", "osmesa", "-o", self.folder / "a_%d.exr", *options)

    def shows(self, label, graph, wanted, *options, frame=0):
        done = self.render(graph, *options)
        if self.report.check(done.code == 0, f"{label}: {done.code}\n{done.err}"):
            got = [[tuple(texel) for texel in row] for row in read_exr((self.folder / f"a_{frame}.exr").read_bytes())]
            wrong = [(x, y, got[y][x], wanted[y][x]) for y in range(HEIGHT) for x in range(WIDTH) if got[y][x] != wanted[y][x]]
            self.report.check(not wrong, f"{label}: of {len(wrong)} texels x, y, found and wanted: {wrong[:4]}")


def check_option(bench):
    bench.shows("no mouse", STATE, of_state(state()), "--frames", "0:0")
    bench.shows("a mouse that points", STATE, of_state(state(12.5, 3.25)), "--mouse", "12.5,3.25", "--frames", "0:1", frame=1)
    for frame in (0, 1):
        bench.shows(f"a held button, frame {frame}", STATE, of_state(state(7, 15, True, frame)), "--mouse", "7,15,down", "--frames", "0:1", frame=frame)
    bench.shows("a held button, frame 3 alone", STATE, of_state(state(7, 15, True, 3)), "--mouse", "7,15,down", "--frames", "3:3", frame=3)


def check_toy(bench):
    shaders = bench.folder / "shaders/tutorials"
    shaders.mkdir(parents=True)
    (shaders / "shadertoy.glsl").write_text((TOP / "docs/tutorials/shaders/tutorials/shadertoy.glsl").read_text())
    (shaders / "marks.frag.glsl").write_text(TOY)
    graph = bench.folder / "toy.json"
    graph.write_text(TOY_GRAPH % '"read": { "mouse": "@mouse" }, ')
    # The disc around the middle of a pixel, and not its mirror image in y.
    bench.shows("a toy", graph, of_toy(state(6.5, 4.5, True)), "--mouse", "6.5,4.5,down", "--frames", "0:0")
    bench.shows("a toy, a frame later", graph, of_toy(state(6.5, 4.5, True, 1)), "--mouse", "6.5,4.5,down", "--frames", "1:1", frame=1)
    bench.shows("a toy that nobody touched", graph, of_toy(state(6.5, 4.5)), "--mouse", "6.5,4.5", "--frames", "0:0")
    graph.write_text(TOY_GRAPH % "")
    done = bench.render(graph, "--frames", "0:0")
    bench.report.check(done.code == 1 and "iMouse" in done.err and "marks.frag.glsl" in done.err, f"a toy without the slot: {done.code} {done.err}")


def check_wrong(bench):
    for text in ("", "7", "7,", ",7", "7,7,7", "7,7,up", "7,7,down,down", "-1,7", "7,16385", "nan,7", "inf,7", "7;7", " 7,7", "0x7,7"):
        done = bench.render(STATE, "--mouse", text)
        bench.report.check(done.code == 2 and "--mouse" in done.err and "X,Y,down" in done.err, f"--mouse {text!r}: {done.code} {done.err}")
    done = run(bench.weft, "plan", STATE, "--mouse", "1,1")
    bench.report.check(done.code == 2 and "--mouse" in done.err, f"a command that draws nothing: {done.code} {done.err}")


def check_cases(bench):
    def cases(mouse):
        file = bench.folder / "a.cases.json"
        file.write_text(json.dumps({"cases": [{"name": "held", "graph": str(TOP / STATE), "size": "4x2", "mouse": mouse}]}))
        return file

    # A golden has 8 bits: 1 of 255 and 0 differ, 1 and more do not.
    accepted = run(bench.weft, "test", cases("1,0.5,down"), "--accept")
    bench.report.check(accepted.code == 0, f"--accept: {accepted.code} {accepted.err}")
    same, other = run(bench.weft, "test", cases("1,0.5,down")), run(bench.weft, "test", cases("0,0.5"))
    bench.report.check(same.code == 0, f"the same mouse: {same.code} {same.out} {same.err}")
    bench.report.check(other.code == 1 and "state" in other.out + other.err, f"another mouse: {other.code} {other.out} {other.err}")
    wrong = run(bench.weft, "test", cases("here"))
    bench.report.check(wrong.code == 2 and "the mouse: expected X,Y or X,Y,down" in wrong.err, f"no mouse: {wrong.code} {wrong.err}")


def check_other_commands(bench):
    done = run(bench.weft, "dump", STATE, "state", "--size", "4x2", "--mouse", "3,1", "--backend", "osmesa", "-o", bench.folder / "dump")
    found = next((bench.folder / "dump").glob("*.exr"), None) if done.code == 0 else None
    bench.report.check(found and read_exr(found.read_bytes())[0][0][:2] == (3, 1), f"dump: {done.code} {done.err} {found}")
    done = run(bench.weft, "fuzz", STATE, "--size", "4x2", "--runs", "1", "--mouse", "3,1,down", "--backend", "osmesa")
    bench.report.check(done.code == 0, f"fuzz: {done.code} {done.out} {done.err}")
    for command, words in ((("types",), ["mouse", "position", "dragged", "pressed", "clicked"]), (("explain", STATE, "state"), ["@mouse"]),
                           (("plan", STATE), ["state"]), (("check", STATE, "--no-shaders"), [])):
        done = run(bench.weft, *command)
        bench.report.check(done.code == 0 and all(word in done.out for word in words), f"{command}: {done.code} {done.out[-1500:]} {done.err}")
    # A field that the table does not have, and an argument that the import does not take.
    (bench.folder / "shaders").mkdir(exist_ok=True)
    (bench.folder / "shaders/odd.frag.glsl").write_text("struct M { vec2 place; };\nlayout(std430) readonly buffer mouse { M m[]; };\n"
                                                        "out vec4 result;\nvoid main() { result = m[0].place.xyxy; }\n")
    graph = json.loads((TOP / STATE).read_text().replace("  // What @mouse says, as numbers; made anew only when it says something else.\n", ""))
    graph["passes"][0]["shader"] = "odd.frag.glsl"
    file = bench.folder / "odd.json"
    file.write_text(json.dumps(graph))
    done = run(bench.weft, "check", file)
    bench.report.check("W186" in done.codes() and "position" in done.err, f"another field: {done.code} {done.err}")
    graph["resources"]["mouse"] = {"import": "mouse", "button": 2}
    file.write_text(json.dumps(graph))
    done = run(bench.weft, "check", file, "--no-shaders")
    bench.report.check(done.code == 1 and "button" in done.err, f"an argument: {done.code} {done.err}")


def main():
    weft, report = os.path.abspath(sys.argv[1]), Report()
    for part in (check_option, check_toy, check_wrong, check_cases, check_other_commands):
        with temporary_folder() as name:
            part(Bench(weft, pathlib.Path(name), report))
    report.end()


main()
