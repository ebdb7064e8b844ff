#!/usr/bin/env python3
"""A graph that reads the mouse, in a window: it sees where the pointer is over the picture, the left button and where that went down, to the
pixel and from the lower left corner; panels keep what is theirs; the left button turns the camera with Ctrl only; in idle mode a
pointer that moves wakes it. A graph that does not read the mouse sleeps on. A click while files are loaded or an import is on its way is seen once."""
import json
import os
import pathlib
import re
import signal
import sys

from pictures import read_exr
from program import TOP, Report, temporary_folder
from window import Session, inside_display

WIDTH, HEIGHT = 320, 180
GRAPH = """{ "name": "mouse",
  "parameters": { "level": { "type": "float", "default": 0.5, "min": 0, "max": 1 } },
  "resources": { "state": { "texture": "rgba32f", "size": "screen" } },
  "passes": [ { "name": "state", "type": "fullscreen", "shader": "state.frag.glsl", "read": { "mouse": "@mouse" }, "write": { "result": "state" },
                "parameters": { "level": "$level" } } ],
  "present": "state" }"""
SHADER = """#include "common/view.glsl"
#include "common/mouse.glsl"
layout(std140) uniform Parameters { float level; };
out vec4 result;
void main() {
  Mouse m = mouse_state[0];
  int column = int(gl_FragCoord.x) % 3;
  result = column == 0 ? vec4(m.position, m.dragged) : column == 1 ? vec4(m.pressed, float(m.down), float(m.clicked)) : vec4(eye, level);
}
"""
BLIND = """{ "name": "blind", "resources": { "shown": { "texture": "rgba8", "size": "screen" } },
  "passes": [ { "name": "fill", "type": "fullscreen", "shader": "fill.frag.glsl", "write": { "result": "shown" } } ], "present": "shown" }"""


def at(x, y):
    """The middle of a pixel of the window, counted from its upper left corner, as gl_FragCoord counts."""
    return x + 0.5, HEIGHT - 0.5 - y


class Eyes:
    """What the shader saw in a later frame."""

    def __init__(self, live):
        self.live = live

    def look(self):
        shot = self.live.shot("shift+F12")
        even, odd, third = read_exr(shot.read_bytes(), 1)[0][:3]
        return {"position": even[:2], "dragged": even[2:], "pressed": odd[:2], "down": odd[2], "eye": third[:3]}

    def until(self, **wanted):
        return self.live.until(lambda: (s := self.look()) and all(s[key] == value for key, value in wanted.items()) and s)

    def until_other_eye(self, eye):
        return self.live.until(lambda: (s := self.look()) and s["eye"] != eye and s)


def follows(live, report):
    eyes = Eyes(live)
    move = lambda x, y: live.tool("mousemove", "--window", live.window, x, y)
    for x, y in ((40, 30), (0, HEIGHT - 1), (WIDTH - 1, 0)):  # GLFW keeps a movement to 0, 0 to itself
        move(x, y)
        report.check(eyes.until(position=at(x, y), dragged=(0, 0), pressed=(0, 0), down=0), f"a pointer at {x}, {y}: {eyes.look()}")
    # A drag: it began at one place and is at another.
    eye = eyes.look()["eye"]
    move(60, 50)
    live.tool("mousedown", 1)
    report.check(eyes.until(position=at(60, 50), dragged=at(60, 50), pressed=at(60, 50), down=1), f"a button that went down: {eyes.look()}")
    move(200, 100)
    seen = eyes.until(position=at(200, 100), dragged=at(200, 100), pressed=at(60, 50), down=1)
    report.check(seen, f"a drag: {eyes.look()}")
    move(WIDTH + 30, 100)
    report.check(eyes.until(position=(WIDTH, HEIGHT - 100.5), down=1), f"a drag out of the window ends at its edge: {eyes.look()}")
    move(200, 100)
    eyes.until(position=at(200, 100))
    live.tool("mouseup", 1)
    move(100, 90)
    seen = eyes.until(position=at(100, 90), dragged=at(200, 100), pressed=at(60, 50), down=0)
    report.check(seen and seen["eye"] == eye, f"after a drag, which turns no camera ({eye}): {eyes.look()}")
    # With Ctrl it is the camera's.
    live.tool("keydown", "ctrl")
    live.tool("mousedown", 1)
    move(160, 90)
    turned = eyes.until_other_eye(eye)
    live.tool("mouseup", 1)
    live.tool("keyup", "ctrl")
    report.check(turned and turned["down"] == 0 and turned["pressed"] == at(60, 50), f"Ctrl and a drag turn the camera: {turned}")


def leaves_panels_alone(live, report):
    eyes = Eyes(live)
    move = lambda x, y: live.tool("mousemove", "--window", live.window, x, y)
    line = 28  # pixels, below the picture
    place = lambda x, y: (at(x, y)[0], at(x, y)[1] - line)
    move(WIDTH // 2 - 4, HEIGHT // 2)
    before = eyes.until(position=place(WIDTH // 2 - 4, HEIGHT // 2))
    if not report.check(before, f"a pointer beside the panels: {eyes.look()}"):
        return
    move(WIDTH - 20, 60)  # the panels are at the right
    live.shot()
    live.click(WIDTH - 20, 60)
    seen = eyes.look()
    report.check(all(seen[key] == before[key] for key in before if key != "eye"), f"a click on a panel is the picture's: {before} {seen}")
    move(40, 20)
    report.check(eyes.until(position=place(40, 20), pressed=before["pressed"]), f"a pointer that left the panel: {eyes.look()}")


def wakes(live, report):
    frame_of = lambda shot: int(re.match(r"weft_(\d+)", shot.name)[1])
    move = lambda x, y: live.tool("mousemove", "--window", live.window, x, y)
    if not report.check(live.rest(live.key("i")), f"idle mode never comes to rest\n{live.said()}"):
        return
    rest = live.shot("shift+F12")
    report.check(frame_of(live.shot()) == frame_of(rest), "a frame is drawn at rest")
    before = live.mark()
    move(33, 44)
    report.check(live.event("awake", before) and live.rest(before), f"a pointer that moves does not wake it\n{live.lines()[before:]}")
    seen = Eyes(live).look()
    report.check(seen["position"] == at(33, 44), f"after it woke: {seen}")
    before = live.mark()
    live.tool("click", 1)
    report.check(live.event("awake", before) and live.rest(before), "a click does not wake it")
    seen = Eyes(live).look()
    report.check(seen["pressed"] == at(33, 44) and seen["down"] == 0, f"after a click: {seen}")


def sleeps(live, report):
    frame_of = lambda shot: int(re.match(r"weft_(\d+)", shot.name)[1])
    if not report.check(live.rest(0), f"a graph without the mouse never comes to rest\n{live.said()}"):
        return
    rest = live.shot()
    live.tool("mousemove", "--window", live.window, 50, 60)
    live.tool("mousemove", "--window", live.window, 55, 65)
    report.check(frame_of(live.shot()) == frame_of(rest), "a graph that does not read the mouse is drawn when that moves")


COUNT = """#include "common/mouse.glsl"
uniform sampler2D before;
#ifdef LIGHT
uniform sampler2D environment;
#endif
out vec4 result;
void main() {
  Mouse m = mouse_state[0];
  result = vec4(texelFetch(before, ivec2(gl_FragCoord.xy), 0).x + float(m.clicked), m.pressed, 1.0);
#ifdef LIGHT
  result.w = texelFetch(environment, ivec2(0), 0).r;
#endif
}
"""


def counting(environment):
    """A graph that counts clicks, and waits for an environment or does not."""
    read = {"mouse": "@mouse", "before": "counted@-1", **({"environment": "@environment"} if environment else {})}
    return json.dumps({"name": "counting", "resources": {"counted": {"texture": "rgba32f", "size": "screen", "history": 1, "first": [0, 0, 0, 0]}},
                       "passes": [{"name": "count", "type": "fullscreen", "shader": "count.frag.glsl", **({"defines": {"LIGHT": 1}} if environment else {}),
                                   "read": read, "write": {"result": "counted"}}], "present": "counted"})


def radiance(gray, width=8, height=4):
    """A .hdr of one gray, in bytes."""
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + bytes([gray] * 3 + [128]) * (width * height)


class Clicks:
    """What the counting graph has seen."""

    def __init__(self, live):
        self.live = live

    def look(self):
        clicks, *rest = read_exr(self.live.shot("shift+F12").read_bytes(), 1)[0][0]
        return {"clicks": clicks, "pressed": tuple(rest[:2])}

    def come_to(self, number, place):
        """Waits until there are so many, and takes one more picture: none may follow."""
        wanted = {"clicks": number, "pressed": place}
        return self.live.until(lambda: self.look() == wanted) and self.look() == wanted


def click(live, x, y):
    live.tool("mousemove", "--window", live.window, x, y, "click", 1)


def counts_clicks(weft, folder, report):
    """One click is one, whatever the viewer is busy with when it comes."""
    (folder / "shaders/count.frag.glsl").write_text(COUNT)
    scene = (TOP / "scenes/one_sphere.json").read_bytes()
    for what, environment in (("the scene is loaded", False), ("the environment is on its way", True)):
        (folder / "counting.json").write_text(counting(environment))
        # A pipe without a name in any folder, so that writing it is no change of a watched file.
        reads, writes = os.pipe()
        late = folder / ("late.hdr" if environment else "late.json")
        late.symlink_to(f"/proc/{os.getpid()}/fd/{reads}")
        data = radiance(90) if environment else scene
        options = ["--environment", late] if environment else ["--scene", late]
        live = Session(weft, folder, "--no-ui", *options, graph="counting.json", size=f"{WIDTH}x{HEIGHT}", data=False)
        try:
            if not report.check(live.open(), f"no window while {what}\n{live.said()}"):
                continue
            shown = not environment or live.shot()
            click(live, 70, 40)
            shown = shown and (not environment or live.shot())  # of a frame behind the click; nothing was drawn in it
            report.check(shown, f"no picture while {what}\n{live.said()}")
            os.write(writes, data)
            os.close(writes)
            seen = Clicks(live)
            report.check(seen.come_to(1, at(70, 40)), f"a click while {what}: {seen.look()}\n{live.said()}")
            # Pressed and released while the program stands still.
            os.kill(live.process.pid, signal.SIGSTOP)
            click(live, 90, 60)
            os.kill(live.process.pid, signal.SIGCONT)
            report.check(seen.come_to(2, at(90, 60)), f"a click while the program stands still: {seen.look()}")
            live.leave(report)
        finally:
            live.stop()
            os.close(reads)


def main():
    weft, compare, report = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), Report()
    inside_display(report, weft, compare, __file__)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        (folder / "shaders").mkdir()
        (folder / "shaders/state.frag.glsl").write_text(SHADER)
        (folder / "shaders/fill.frag.glsl").write_text("out vec4 result;\nvoid main() { result = vec4(0.25); }\n")
        (folder / "mouse.json").write_text(GRAPH)
        (folder / "blind.json").write_text(BLIND)
        for graph, options, parts in (("mouse.json", ["--no-ui"], (follows, wakes)), ("mouse.json", ["--panels", "passes"], (leaves_panels_alone,)),
                                      ("blind.json", ["--no-ui", "--idle"], (sleeps,))):
            live = Session(weft, folder, *options, graph=graph, size=f"{WIDTH}x{HEIGHT}", data=False)
            try:
                if report.check(live.open() and live.shot(), f"no picture\n{live.said()}"):
                    for part in parts:
                        part(live, report)
                    live.leave(report)
            finally:
                live.stop()
        counts_clicks(weft, folder, report)
    report.end()


main()
