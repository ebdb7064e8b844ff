#!/usr/bin/env python3
"""What a person does in the viewer besides saving files: looks through cameras, turns, flies and lets go,
changes the render scale, records until the disk is full, lets it idle; starts with files that have errors and saves the
fix; keeps tweaks that a changed file no longer takes out of its way. At the end no GL object is left. The time from a save to the
picture on the screen is measured and printed, not judged."""
import os
import pathlib
import re
import signal
import sys
import time

from program import Report, run, temporary_folder
from screen import Screen
from window import Session, copy_of_tree, edit, inside_display, save

DIFFERENT = 2  # 8-bit steps of the mean, for pictures that are to look different


class Eyes:
    def __init__(self, compare):
        self.compare = compare

    def describe(self, shot):
        """Width, height, mean and spread of a picture."""
        words = run(self.compare, "--describe", shot).out.split()
        return (int(words[0]), int(words[1]), float(words[2]), float(words[3])) if len(words) >= 4 else (0, 0, 0.0, 0.0)


def close(live, report, code=0, left=True):
    live.leave(report, code)
    report.check("W120" not in live.said(), live.said())
    if left:
        report.check('"gl_objects_left": "none"' in live.said(), f"objects are left\n{live.said()[-1500:]}")


def differs(live, old, report, what):
    seen = live.until(lambda: (s := live.shot()) and s.read_bytes() != old.read_bytes() and s)
    report.check(seen, f"{what}: the picture stays as it was\n{live.said()}")
    return seen or old


def settles(live, wanted, report, what):
    """Takes pictures until one is `wanted` to the byte."""
    seen = live.until(lambda: (s := live.shot()) and s.read_bytes() == wanted.read_bytes() and s)
    report.check(seen, f"{what}: the picture of before never comes back\n{live.said()}")


def look_around(live, eyes, report):
    first = live.settled()
    if not report.check(first, f"no first picture\n{live.said()}"):
        return
    described = eyes.describe(first)
    report.check(described[2] > 15 and described[3] > 10, f"first picture: {described}")
    seen = {first.read_bytes()}
    for key in "2345":
        live.key(key)
        shot = live.until(lambda: (s := live.shot()) and s.read_bytes() not in seen and s)
        if report.check(shot, f"camera {key}: a picture that was there before\n{live.said()}"):
            seen.add(shot.read_bytes())
            report.check(eyes.describe(shot)[3] > 5, f"camera {key}: {eyes.describe(shot)}")
    live.key("r")
    settles(live, first, report, "R after the cameras")

    live.act("f", "fly")
    live.tool("keydown", "w")
    differs(live, first, report, "flying forward")
    live.tool("keyup", "w")
    ahead = live.settled()
    live.tool("mousemove_relative", "--", 20, 10)  # says where the mouse is: the first after the capture is no movement
    live.tool("mousemove_relative", "--", 60, 20)
    turned = differs(live, ahead, report, "the captured mouse")
    live.act("Escape", "close")  # lets go, and does not close
    report.check(live.shot() and live.alive(), "Escape in flight ends the program")
    live.key("r")
    settles(live, first, report, "R after a flight")
    report.check(turned.read_bytes() != first.read_bytes(), "flight ends where it began")

    live.key("minus")
    small = live.until(lambda: (s := live.shot()) and eyes.describe(s)[:2] == (480, 270) and s)
    report.check(small, "render scale 0.75 never comes")
    live.key("equal")
    settles(live, first, report, "render scale 1 again")

    report.check((exr := live.shot("shift+F12")) and exr.suffix == ".exr" and exr.exists(), "Shift F12 writes no .exr")
    for key in ("v", "v", "b", "b", "p", "p", "F1", "F1"):
        live.key(key)
    settles(live, first, report, "after switches that do not change pictures")


def record(live, report):
    live.act("F10", "record")
    folder = live.folder / "record_1"
    report.check(live.until(lambda: (folder / "f_00003.png").exists()), f"F10 records nothing\n{live.said()}")
    ended = live.line(r"wrote (\d+) frames to record_1/f_%05d.png", live.key("F10"))
    live.shot()
    count = len(list(folder.glob("*.png")))
    report.check(ended and int(ended[1]) == count, f"F10 does not stop the recording: {ended}, {count} files")
    # What is to be written next has no place beside it. The program stands still meanwhile.
    second = live.folder / "record_2"
    begun = live.key("F10")
    if report.check(live.until(lambda: (second / "f_00000.png").exists()), "the second recording does not begin"):
        os.kill(live.process.pid, signal.SIGSTOP)
        at = len(list(second.glob("f_*.png")))
        for frame in range(at + 1, at + 10):  # the one before may be under way
            (second / f".f_{frame:05}.png.part").mkdir()
        os.kill(live.process.pid, signal.SIGCONT)
        ended = live.line(r"wrote (\d+) frames to record_2/f_%05d.png", begun)
        report.check(ended and int(ended[1]) in (at, at + 1), f"what cannot be written at frame {at + 1} ends the recording: {ended}")
        report.check(live.until(lambda: "error[W180]" in live.said()), f"it is not reported\n{live.said()}")
    report.check(live.alive() and live.shot(), "it ends the program")


def idle(live, report):
    def frame_of(shot):
        return int(re.match(r"weft_(\d+)", shot.name).group(1))

    if not report.check(live.rest(live.key("i")), "idle mode never comes to rest"):
        return
    rest = live.shot()
    report.check(frame_of(live.shot()) == frame_of(rest), "a frame is drawn at rest")
    report.check(live.rest(live.key("2")), "idle mode does not come to rest again")
    woken = live.shot()
    report.check(frame_of(woken) > frame_of(rest) and woken.read_bytes() != rest.read_bytes(), "a key does not wake it")
    before = live.mark()
    edit(live.folder / "scenes/spheres.json", r'"spacing": [\d.]+', '"spacing": 3.1')
    report.check(live.event("files good", before) and live.rest(before), f"a saved file does not wake it\n{live.said()}")
    last = live.shot()
    report.check(frame_of(last) > frame_of(woken) and last.read_bytes() != woken.read_bytes(), "a saved file shows nothing new")
    live.act("i", "idle")


def start_broken(weft, folder, eyes, report):
    graph = folder / "graphs/glow.json"
    whole = graph.read_text()
    for part, path in (("graph", graph), ("scene", folder / "scenes/spheres.json")):
        good = path.read_text()
        save(path, good.replace("{", "{{", 1))
        live = Session(weft, folder, "--stats", graph="graphs/glow.json")
        try:
            report.check(live.open(), f"{part}: no window for a broken file\n{live.said()}")
            report.check(live.until(lambda: "waiting" in " ".join(live.tool("getwindowname", live.window))), f"{part}: no notice")
            report.check(f"{path.name}:" in live.said(), f"{part}: the terminal does not say what is wrong\n{live.said()}")
            live.tool("windowsize", live.window, 400, 250)
            save(path, good)
            live.until(lambda: "waiting" not in " ".join(live.tool("getwindowname", live.window)))
            shot = live.shot()
            report.check(shot and eyes.describe(shot)[3] > 5, f"{part}: no picture after the fix\n{live.said()}")
            close(live, report)
        finally:
            live.stop()
    save(graph, whole.replace("{", "{{", 1))
    live = Session(weft, folder, "--stats", graph="graphs/glow.json")
    try:
        live.open()
        live.until(lambda: "waiting" in " ".join(live.tool("getwindowname", live.window)))
        live.tool("key", "--window", live.window, "Escape")
        close(live, report, code=1)
    finally:
        save(graph, whole)
        live.stop()


def lose_a_tweak(weft, folder, screen, report):
    """And measures how long a save takes to be on the screen."""
    graph = folder / "graphs/glow.json"
    whole = graph.read_text()
    live = Session(weft, folder, "--stats", "--no-ui", "--set", "strength=0.9", "--disable", "tint", graph="graphs/lost.json")
    lost = folder / "graphs/lost.json"
    try:
        report.check(live.open(), f"no window\n{live.said()}")
        with_tweak = live.shot()
        save(lost, TWEAKED.replace('"tint"', '"hue"').replace("strength", "power"))
        save(folder / "shaders/lost.frag.glsl", LOST_SHADER.replace("strength", "power"))
        report.check(live.until(lambda: "warning[W044]" in live.said() and "warning[W045]" in live.said()),
                     f"a tweak that is lost is not reported\n{live.said()}")
        without = differs(live, with_tweak, report, "a file without the tweaked parameter")
        save(folder / "shaders/lost.frag.glsl", LOST_SHADER)
        save(lost, TWEAKED)
        settles(live, with_tweak, report, "the tweak, when its parameter is back")
        report.check(without.read_bytes() != with_tweak.read_bytes(), "the tweak shows")
        live.tool("mousemove", 1200, 1000)  # the display draws its cursor into the picture, and takes it away to draw below
        waits = []
        for value in range(12):
            before = screen.pixels()
            text = LOST_SHADER.replace("0.25", f"{0.3 + 0.05 * value:.2f}")
            start = time.monotonic()
            save(folder / "shaders/lost.frag.glsl", text)
            if not live.until(lambda: screen.pixels() != before):
                break
            waits.append(1e3 * (time.monotonic() - start))
        if waits:
            print(f"from a save to the screen, 320x180, one pass: {sorted(waits)[len(waits) // 2]:.0f} ms in the median of "
                  f"{len(waits)}, {max(waits):.0f} ms at most (looked at every 20 ms)")
        live.tool("mousemove", "--window", live.window, 160, 90)
        close(live, report)
    finally:
        save(graph, whole)
        live.stop()


def lose_a_table(weft, folder, report):
    """A table that goes away keeps the last good picture: its value is no wrong one, and is not left out."""
    table = folder / "dark.cube"
    save(table, "LUT_3D_SIZE 2\n" + "".join(f"{r / 4} {g / 4} {b / 4}\n" for b in (0, 1) for g in (0, 1) for r in (0, 1)))
    closed = folder / "closed.png"  # of the last frame, also when a person ends the program
    live = Session(weft, folder, "--stats", "--no-ui", "--set", f"lut={table}", "--screenshot", closed, size="160x90")
    try:
        report.check(live.open(80, 45), f"no window\n{live.said()}")
        dark, before = live.settled(), live.mark()
        text = table.read_text()
        table.unlink()
        report.check(live.event("files wrong", before), "nobody notices that the table is gone")
        report.check(f"command line: --set lut={table}: error[W001]" in live.said() and "left out" not in live.said(), live.said())
        report.check(live.shot().read_bytes() == dark.read_bytes(), "without its table the picture changes")
        before = live.mark()
        save(table, text.replace("0.25", "0.5"))
        report.check(live.event("files good", before), f"the table that is back is not taken up\n{live.said()}")
        last = live.settled()
        report.check(last.read_bytes() != dark.read_bytes(), "the other table does not show")
        close(live, report)
        report.check(closed.exists() and closed.read_bytes() == last.read_bytes(), "--screenshot of a window that a person closes")
    finally:
        live.stop()


TWEAKED = """{
  "parameters": { "strength": { "type": "float", "default": 0.2, "min": 0, "max": 1 } },
  "resources": { "ldr": { "texture": "rgba8", "size": "screen" } },
  "passes": [
    { "name": "base", "type": "fullscreen", "shader": "lost.frag.glsl", "write": { "result": "ldr" }, "parameters": { "strength": "$strength" } },
    { "name": "tint", "type": "fullscreen", "shader": "tint.frag.glsl", "read": { "source": "ldr" }, "write": { "result": "ldr" } }
  ],
  "present": "ldr"
}
"""
LOST_SHADER = """layout(std140) uniform Parameters { float strength; };
in vec2 uv;
out vec4 result;
void main() { result = vec4(strength, uv.x, 0.25, 1.0); }
"""
TINT_SHADER = """uniform sampler2D source;
out vec4 result;
void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0).bgra; }
"""


def main():
    weft, compare, report = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), Report()
    screen, eyes = Screen(inside_display(report, weft, compare, __file__)), Eyes(compare)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        copy_of_tree(folder)
        save(folder / "graphs/lost.json", TWEAKED)
        save(folder / "shaders/lost.frag.glsl", LOST_SHADER)
        save(folder / "shaders/tint.frag.glsl", TINT_SHADER)
        live = Session(weft, folder, "--stats", graph="graphs/studio.json", size="640x360")
        try:
            report.check(live.open(), f"no window\n{live.said()}")
            look_around(live, eyes, report)
            idle(live, report)
            record(live, report)
            close(live, report, code=1)  # the full disk
        finally:
            live.stop()
        start_broken(weft, folder, eyes, report)
        lose_a_tweak(weft, folder, screen, report)
        lose_a_table(weft, folder, report)
    report.end()


main()
