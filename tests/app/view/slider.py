#!/usr/bin/env python3
"""A slider of the viewer is moved eighty times, each time until the picture has followed: no plan is built for it, and
nothing is allocated. The same of the bundled picture, with fewer moves."""
import json
import os
import pathlib
import sys

from program import SANITIZED, TOP, Report, temporary_folder
from screen import Screen
from window import Session, inside_display

MOVES = 80
MOVES_OF_STUDIO = 16
GRAB = (61, 133, 224)  # Dear ImGui's slider grab, dark style; brighter while it is held
GRAPH = """{ "name": "slider",
  "parameters": { "level": { "type": "float", "default": 0.5, "min": 0, "max": 1 } },
  "resources": { "picture": { "texture": "rgba8", "size": "screen" } },
  "passes": [ { "name": "fill", "type": "fullscreen", "shader": "level.frag.glsl", "write": { "result": "picture" },
                "parameters": { "level": "$level" } } ],
  "present": "picture" }"""
SHADER = """layout(std140) uniform Parameters { float level; };
out vec4 result;
void main() { result = vec4(vec3(level), 1.0); }
"""


def find_grabs(screen):
    """A place in the grab of each slider on the screen, from the top."""
    width, height, rows = screen.read()
    found = [(x, y) for y in range(0, height, 3) for x in range(0, width // 2)
             if all(abs(rows[y][3 * x + c] - GRAB[c]) <= 3 for c in range(3))]
    sliders = []
    for x, y in found:
        if sliders and y - sliders[-1][-1][1] <= 3:
            sliders[-1].append((x, y))
        else:
            sliders.append([(x, y)])
    return [each[len(each) // 2] for each in sliders]


def find_grab(screen):
    """That of the first slider; None when there is none."""
    return next(iter(find_grabs(screen)), None)


def session(weft, folder, display, report, moves):
    """Counters of a session in which the slider was moved."""
    live = Session(weft, folder, "--panels", "parameters", "--stats", graph="slider.json", size="640x360", data=False)
    screen = Screen(display)
    try:
        if not report.check(live.open() and live.shot(), f"no picture\n{live.said()}"):
            return None
        grab = live.until(lambda: find_grab(screen))
        if not report.check(grab, "no slider on the screen"):
            return None
        x, y = grab
        look = (100, 200)  # of the picture, beside the panels
        live.tool("mousemove", x + 40, y)
        # Beside the grab, which comes to the mouse: a change to wait for. On the grab, the press may change the value or not, and a wait that
        # takes its change for that of the first move sees each move one too early.
        steps = [("press", ["mousedown", 1]), *((f"move {i}", ["mousemove", x + 30 - abs(i % 120 - 60), y]) for i in range(moves))]
        for name, step in steps if moves else ():
            before = screen.pixel(*look)
            live.tool(*step)
            if not report.check(live.until(lambda: screen.pixel(*look) != before), f"{name}: the picture stays {before}"):
                return None
        if moves:
            live.tool("mouseup", 1)
        live.leave(report, unsaved=moves > 0)
        text = live.said()
        return json.loads(text[text.index("{"):])
    finally:
        live.stop()


def studio(weft, folder, display, report):
    """sky_rotation of graphs/studio.json, below the sliders of two parameters that change the plan. The viewer says of each frame in which
    a panel changed something; when each of these was a value that was set at once, none of them built a plan."""
    live = Session(weft, folder, "--panels", "parameters", "--stats", "--no-vsync", "--render-scale", "0.25",
                   "--preset", TOP / "tests/small_maps.json", size="640x800", data=False, graph=TOP / "graphs/studio.json")
    screen = Screen(display)
    try:
        if not report.check(live.open() and live.event("shown"), f"no picture\n{live.said()}"):
            return
        if not report.check(live.until(lambda: len(find_grabs(screen)) > 2), "no three sliders on the screen"):
            return
        x, y = find_grabs(screen)[2]
        live.tool("mousemove", x + 20, y)
        moves = [("mousemove", x - 20 + abs(i % 40 - 20), y) for i in range(1, MOVES_OF_STUDIO)]
        for i, step in enumerate([("mousedown", 1), *moves]):
            before = live.mark()
            live.tool(*step)
            if not report.check(live.event("change", before), f"studio, move {i}: no parameter changes\n{live.said()}"):
                return
        live.tool("mouseup", 1)
        live.leave(report, unsaved=True)
        changes = sum(line.endswith(" change") for line in live.lines())
        text = live.said()
        stats = json.loads(text[text.index("{"):])
        report.check(stats["live_values_set"] == changes >= MOVES_OF_STUDIO,
                     f"studio: {changes} changes, of which {stats['live_values_set']} built no plan")
    finally:
        live.stop()


def main():
    weft, report = os.path.abspath(sys.argv[1]), Report()
    display = inside_display(report, weft, "none", __file__)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        (folder / "shaders").mkdir()
        (folder / "shaders/level.frag.glsl").write_text(SHADER)
        (folder / "slider.json").write_text(GRAPH)
        still = session(weft, folder, display, report, 0)
        moved = session(weft, folder, display, report, MOVES)
        if still and moved:
            report.check(still["live_values_set"] == 0 and moved["live_values_set"] > MOVES,
                         f"values set: {still['live_values_set']}, {moved['live_values_set']}")
            report.check(0 < moved["plans_built"] == still["plans_built"],
                         f"plans built: {still['plans_built']} without a move, {moved['plans_built']} with {MOVES}")
        studio(weft, folder, display, report)
    report.end()


main()
