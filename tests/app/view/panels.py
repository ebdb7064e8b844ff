#!/usr/bin/env python3
"""The viewer's panels in a window of a virtual display: each opens, at content scales 1 and 2, and the picture beside them is on the screen
as F12 saves it, to the bit. A value and a pass changed on the command line are shown by F8 and written by the second, comments and
all; Ctrl Z gives the files back byte for byte; files of the installation stay as they are. Esc closes what is on top, and asks
before changes are lost; a preset that is saved there draws the same picture again. A right click gives a parameter the value of the file.
Events that come while a frame is drawn are all seen, in their order. Whose a drag is, is judged where it
begins, however fast the mouse got there; at rest in idle mode a drag turns the picture."""
import json
import os
import pathlib
import re
import shutil
import signal
import sys

from pictures import decode, read_png
from program import Report, run, temporary_folder
from screen import Screen
from window import Session, copy_of_tree, edit, inside_display, save

TABS = ["parameters", "passes", "selected", "times", "storage", "histogram", "messages", "pictures"]


def rgb_rows(shot):
    """Rows of RGB bytes, as Screen.read() has them."""
    width, channels, texels = decode(shot.read_bytes())
    planes = [texels[c::channels] for c in range(3)]
    rgb = bytearray(3 * len(planes[0]))
    rgb[0::3], rgb[1::3], rgb[2::3] = planes
    return [bytes(rgb[at:at + 3 * width]) for at in range(0, len(rgb), 3 * width)]


def panels(weft, folder, display, report, scale, size):
    width, screen = int(size.split("x")[0]), Screen(display)
    for pair in zip(TABS[:3], TABS[3:]) if scale == "1" else [TABS]:
        live = Session(weft, folder, "--ui-scale", scale, "--idle", "--panels", ",".join(pair), graph="graphs/glow.json", size=size)
        try:
            if not report.check(live.open(40, 40) and live.rest(0), f"no picture at rest\n{live.said()}"):
                continue
            live.tool("mousemove", 1279, 1023)
            live.act("p", "profile")
            shot = live.shot()
            picture = rgb_rows(shot)
            report.check(len(picture[0]) // 3 < width, f"scale {scale}: the picture has the whole window")

            def beside():
                rows = screen.read()[2]
                return all(bytes(rows[y][:len(row)]) == row for y, row in enumerate(picture))

            report.check(live.until(beside), f"scale {scale}, {pair}: the picture on the screen is another, or covered")
            live.act("p", "profile")
            live.leave(report)
            report.check(not live.said(), live.said())
        finally:
            live.stop()


def write_back(weft, folder, report):
    composite, post = folder / "graphs/effects/composite.json", folder / "graphs/post.json"
    files = (composite, post)
    before = [path.read_text() for path in files]
    arguments = ("--set", "exposure=1.25", "--set", "curve=aces", "--disable", "fxaa")
    live = Session(weft, folder, *arguments, data=False)
    try:
        if not report.check(live.open() and live.shot(), f"no picture\n{live.said()}"):
            return
        live.act("F8", "write_back")
        report.check([path.read_text() for path in files] == before, "the first F8 writes")
        live.act("Escape", "close")
        report.check(live.shot() and live.alive(), "Esc closes the window, not the question")
        live.act("F8", "write_back")
        live.key("F8")
        report.check(live.until(lambda: all(path.read_text() != text for path, text in zip(files, before))), f"F8 writes nothing\n{live.said()}")
        expected = re.sub(r'("exposure": *\{[^}\n]*"default": )[-\d.]+', r"\g<1>1.25", before[0])
        expected = re.sub(r'("curve": *\{ "default": )"neutral"', r'\g<1>"aces"', expected)
        report.check(composite.read_text() == expected, f"{composite.name} has\n{composite.read_text()}")
        changed = [a for a, b in zip(post.read_text().splitlines(), before[1].splitlines()) if a != b]
        report.check(len(changed) == 1 and "fxaa" in changed[0] and "false" in changed[0], f"other lines changed: {changed}")
        live.act("ctrl+z", "undo")
        report.check([path.read_text() for path in files] == before, "Ctrl Z does not give the files back")
        live.leave(report)
    finally:
        live.stop()
    for path, text in zip(files, before):
        path.write_text(text)
    live = Session(weft, folder, *arguments)  # now they are Weft's own
    try:
        if report.check(live.open() and live.shot(), f"no picture\n{live.said()}"):
            live.act("F8", "write_back")
            live.act("F8", "write_back")
            report.check("error[W196]" in live.said() and [path.read_text() for path in files] == before, "F8 writes over Weft's own files")
            live.leave(report)
    finally:
        live.stop()


def preset(weft, folder, report):
    """A right click takes back one parameter and leaves the other; F8 saves what is changed as a preset, and `render` draws its picture."""
    home, mine = folder / "home/weft", folder / "mine"
    shutil.rmtree(home, ignore_errors=True)
    (mine / "shaders").mkdir(parents=True)
    (mine / "two.json").write_text(TWO)
    (mine / "shaders/two.frag.glsl").write_text(TWO_SHADER)
    live = Session(weft, folder, "--idle", "--panels", "parameters", graph="mine/two.json", size="640x360", data=False)

    def right(y):
        """Whether a right click there changes something. Keys are taken in order: the panels have seen the click before the key."""
        live.tool("mousemove", "--window", live.window, 338, y)
        since = live.mark()
        live.tool("click", 3)
        live.act("b", "head_bob")
        return any(re.fullmatch(r"event \d+ change", line) for line in live.lines()[since:])

    try:
        if not report.check(live.open(40, 40) and live.rest(0), f"no picture at rest\n{live.said()}"):
            return
        shots = [live.shot().read_bytes()]
        for key, action in (("Up", "step exposure"), ("F2", "toggle bloom")):
            live.act(key, action)
            report.check(live.until(lambda: (s := live.shot().read_bytes()) not in shots and not shots.append(s)), f"{action} changes nothing")
        report.check(not right(350), "a right click beside the parameters changes something")
        report.check(live.until(lambda: live.shot().read_bytes() == shots[2]), "a right click changes the picture")
        rows = [y for y in range(40, 200, 6) if right(y)]
        report.check(len(rows) == 2, f"right clicks change something at {rows}, not at two rows")
        report.check(live.until(lambda: live.shot().read_bytes() == shots[0]), "right clicks do not give the values of the file")
        live.act("ctrl+z", "undo")
        report.check(live.until(lambda: live.shot().read_bytes() not in (shots[0], shots[2])), "Ctrl Z does not take back one right click")
        live.act("ctrl+z", "undo")
        report.check(live.until(lambda: live.shot().read_bytes() == shots[2]), "Ctrl Z does not take back both right clicks")
        live.act("F8", "write_back")
        live.click(60, 299)
        live.tool("type", "evening")
        report.check(live.click(260, 299), f"the button of the preset does nothing\n{live.lines()[-5:]}")
        file = home / "presets/evening.json"
        report.check(live.line(f"wrote {re.escape(str(file))}"), f"no preset is written\n{live.lines()[-5:]}\n{live.said()}")
        report.check(json.loads(file.read_text()) == {"name": "evening", "set": {"exposure": 1.5, "bloom": False}}, file.read_text())
        report.check((mine / "two.json").read_text() == TWO, "the graph is written, too")
        report.check(live.until(lambda: live.shot().read_bytes() == shots[2]), "the preset is another picture")
        command = live.line(r"weft render .* --size ([^ ]+) .*--preset ([^ ]+).*", live.key("c"))
        live.leave(report)  # nothing is unsaved
        if report.check(command and command[2] == str(file), f"C does not name the preset\n{live.lines()[-5:]}"):
            environment = {**os.environ, "XDG_CONFIG_HOME": str(folder / "home")}
            done = run(weft, "render", mine / "two.json", "--preset", "evening", "--size", command[1], "-o", folder / "evening.png", env=environment)
            report.check(done.code == 0 and (folder / "evening.png").read_bytes() == shots[2], f"render draws another picture with the preset\n{done.err}")
    finally:
        live.stop()


def save_camera(weft, folder, report):
    """K adds the view to the scene file, Ctrl Z gives the file back to the byte."""
    scene = folder / "seen.json"
    scene.write_text('{ // my scene\n  "cameras": { "front": { "position": [0, 1, 9], "target": [0, 0, 0] } },\n  "spheres": [] }\n')
    before = scene.read_text()
    live = Session(weft, folder, "--scene", scene, "--camera", "2,1,6,0,0,0,40", data=False)
    try:
        if not report.check(live.open() and live.shot(), f"no picture\n{live.said()}"):
            return
        live.act("k", "save_camera")
        if not report.check(live.until(lambda: "view_1" in scene.read_text()), f"K saves nothing\n{live.said()}"):
            return
        cameras = json.loads(scene.read_text().replace("// my scene", ""))["cameras"]
        view = cameras["view_1"]
        report.check(list(cameras) == ["front", "view_1"] and view["fov"] == 40 and [round(v, 4) for v in view["position"]] == [2, 1, 6], f"{cameras}")
        live.act("ctrl+z", "undo")
        report.check(live.until(lambda: scene.read_text() == before), "Ctrl Z does not give the scene back")
        scene.write_text('{ "cameras": [], "spheres": [] }')  # a mistake
        live.act("k", "save_camera")
        report.check(live.until(lambda: all(f"error[{code}]" in live.said() for code in ("W003", "W196"))) and "view_1" not in scene.read_text(), f"K in a file with mistakes\n{live.said()}")
        live.leave(report, 1)  # the files are wrong
    finally:
        live.stop()


def effects(weft, folder, report):
    """A box of the passes turns off a whole effect. Two clicks and a key that come while the program stands still are three."""
    live = Session(weft, folder, "--panels", "passes", "--idle", graph="graphs/pair.json", size="640x360")
    try:
        if not report.check(live.open(40, 40) and live.rest(0), f"no picture at rest\n{live.said()}"):
            return
        first = live.shot()
        rows = [y for y in range(60, 200, 8) if live.click(331, y)]
        report.check(rows, f"no box of the passes does anything\n{live.said()}")
        live.tool("mousemove", "--window", live.window, 40, 40)
        other = live.shot()
        report.check(rows and other.read_bytes() != first.read_bytes(), "a box changes nothing")
        before = live.mark()
        live.act("Escape", "close")
        report.check(live.alive() and live.shot(), "Esc ends the program with changes that are in no file")
        live.act("Escape", "close")
        for _ in rows:
            live.act("ctrl+z", "undo")
        report.check(live.until(lambda: live.shot().read_bytes() == first.read_bytes()), "Ctrl Z does not bring the picture back")
        before = live.mark()
        live.process.send_signal(signal.SIGSTOP)
        for _ in range(3):
            live.tool("mousemove", "--window", live.window, 331, rows[0], "click", 1, "key", "b")
        live.process.send_signal(signal.SIGCONT)
        report.check(live.until(lambda: sum(line.endswith("action head_bob") for line in live.lines()[before:]) == 3), "a key is lost")
        changes = [line for line in live.lines()[before:] if line.endswith(" change")]
        report.check(len(changes) == 3, f"three clicks while the program stands still are {len(changes)} changes")
        live.leave(report, unsaved=True)
    finally:
        live.process.send_signal(signal.SIGCONT)
        live.stop()


def pictures(weft, folder, display, report):
    """The strip has a picture of what each pass writes. A click on one selects the pass, which O opens in the editor, and Shift O its shader."""
    edited, screen = folder / "edited.txt", Screen(display)
    editor = f"printf '%s %s\\n' {{file}} {{line}} >> {edited}; exit 3"
    small = """    { "name": "small", "type": "fullscreen", "shader": "tint.frag.glsl", "read": { "source": "ldr" }, "write": { "result": "map.mip[5]" } },
    { "name": "show", "type": "fullscreen", "shader": "tint2.frag.glsl", "read": { "source": "ldr", "map": "map.mip[5]" }"""
    traced = PAIR.replace('{ "ldr":', '{ "map": { "texture": "rgba8", "size": [32, 64], "mips": 7 }, "ldr":', 1)
    traced = traced.replace('    { "name": "show", "type": "fullscreen", "shader": "tint.frag.glsl", "read": { "source": "ldr" }', small)
    (folder / "graphs/traced.json").write_text(traced)
    (folder / "shaders/tint2.frag.glsl").write_text(TINT.replace("source;", "source, map;").replace(".brga", ".brga + texelFetch(map, ivec2(0), 0)"))
    live = Session(weft, folder, "--idle", "--panels", "pictures", "--editor", editor, graph="graphs/traced.json", size="1100x400")

    def place(red, green, columns=range(130), top=252):
        """Of the first pixel of the first picture in the strip that has these, of the gradient that `base` writes."""
        return next(((x, y) for y, row in enumerate(screen.read()[2]) if top < y < 372 for x in columns
                     if max(abs(row[3 * x] - red), abs(row[3 * x + 1] - green), abs(row[3 * x + 2] - 64)) < 14), None)

    try:
        if not report.check(live.open(40, 40) and live.rest(0), f"no picture at rest\n{live.said()}"):
            return
        corners = [live.until(lambda c=c: place(*c)) for c in ((0, 0), (255, 0), (0, 255), (255, 255))]
        if not report.check(all(corners), f"the strip does not show what base writes: {corners}"):
            return
        report.check(corners[0][0] < corners[1][0] and corners[2][1] < corners[0][1], f"the picture of base is turned: {corners}")
        live.click(*corners[3])
        for key, line in (("o", "graphs/traced.json 3"), ("shift+o", "shaders/base.frag.glsl 3")):
            since = live.mark()
            live.key(key)
            report.check(live.event(r"edit .* ended with exit code 3", since) and edited.read_text().split("\n")[-2].endswith(line),
                         f"{key} does not edit {line}\n{live.lines()}")
        # X lists what each pass leaves at a pixel, but not those that write a small level of something else, as `small`; a click on a
        # row selects its pass.
        live.tool("mousemove", "--window", live.window, 100, 100)
        live.act("x", "trace_pixel")
        live.shot()
        for y in range(290, 372, 10):
            live.click(200, y)
            live.act("o", "edit_pass")
        rows = [pathlib.Path(line).name for line in dict.fromkeys(edited.read_text().split("\n")[2:-1])]
        report.check(rows == ["traced.json 3", "tints.json 3", "tints.json 4", "traced.json 6"], f"the passes at a pixel are {rows}")
        # In a narrow window all tabs are in one column. There, too, a click on a picture brings Selected to the front.
        live.stop()
        live = Session(weft, folder, "--idle", "--panels", "pictures", "--editor", "true", graph="graphs/traced.json", size="640x400")
        if not report.check(live.open(40, 40) and live.rest(0), f"no picture at rest\n{live.said()}"):
            return
        tab = screen.pixel(532, 12)
        live.click(400, 80)
        report.check(live.until(lambda: screen.pixel(532, 12) != tab), "a click on a picture leaves Pictures in front")
        report.check(live.until(lambda: place(128, 128, range(330, 630), 100)), "Selected does not show what was clicked")
        live.act("o", "edit_pass")
        report.check(any("traced.json:3 is in the editor" in line for line in live.lines()), f"no pass is selected\n{live.lines()}")
        live.leave(report)
    finally:
        live.stop()


PAIR = """{ "resources": { "ldr": { "texture": "rgba8", "size": "screen" }, "seen": { "texture": "rgba8", "size": "screen" } },
  "passes": [
    { "name": "base", "type": "fullscreen", "shader": "base.frag.glsl", "write": { "result": "ldr" } },
    { "include": "tints.json", "as": "tints", "bind": { "ldr": "ldr" } },
    { "name": "show", "type": "fullscreen", "shader": "tint.frag.glsl", "read": { "source": "ldr" }, "write": { "result": "seen" } } ],
  "present": "seen" }
"""
TINTS = """{ "inputs": ["ldr"], "resources": { "mid": { "texture": "rgba8", "size": "screen" } },
  "passes": [
    { "name": "first", "type": "fullscreen", "shader": "tint.frag.glsl", "read": { "source": "ldr" }, "write": { "result": "mid" } },
    { "name": "second", "type": "fullscreen", "shader": "tint.frag.glsl", "read": { "source": "mid" }, "write": { "result": "ldr" } } ] }
"""
BASE = "in vec2 uv;\nout vec4 result;\nvoid main() { result = vec4(uv, 0.25, 1.0); }\n"
TINT = "uniform sampler2D source;\nout vec4 result;\nvoid main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0).brga; }\n"


def drag(live, start):
    """To the left."""
    move = ("mousemove", "--window", live.window)
    live.tool(*move, *start, "mousedown", 1, *(word for x in (20, 40, 60) for word in (*move, start[0] - x, start[1])), "mouseup", 1)


def at_once(live, rest, start):
    """The mouse rests; then a movement to `start` and a drag from there come at once: the program sleeps meanwhile."""
    live.tool("mousemove", "--window", live.window, *rest)
    live.shot()  # a frame has seen where the mouse is
    live.process.send_signal(signal.SIGSTOP)
    drag(live, start)
    live.process.send_signal(signal.SIGCONT)
    return live.shot()


def hidden(weft, folder, report):
    picture, panel = (100, 100), (300, 172)  # the line at the bottom, where it does nothing
    live = Session(weft, folder, "--panels", "parameters", graph="graphs/glow.json")
    try:
        if not report.check(live.open(), f"no window\n{live.said()}"):
            return
        first = live.settled()
        same = lambda: (s := live.shot()) and s.read_bytes() == first.read_bytes()
        turns = lambda: live.until(lambda: not same())
        if not report.check(first, f"no picture\n{live.said()}"):
            return
        drag(live, panel)
        live.shot()
        report.check(same(), "a drag that begins in the panels turns the picture")
        for _ in range(8):
            report.check(at_once(live, picture, panel) and same(), "a drag that comes with the movement into the panels turns the picture")
            report.check(at_once(live, panel, picture) and turns(), "a drag that comes with the movement out of the panels is lost")
            live.act("r", "reset_camera")
            report.check(live.until(same), "the camera does not come back")
        live.act("space", "panels")
        first = live.settled()
        drag(live, panel)
        report.check(turns(), "a drag after the panels were hidden is lost")
        live.act("r", "reset_camera")
        report.check(live.until(same), "the camera does not come back")
        report.check(live.rest(live.key("i")), "idle mode never comes to rest")
        drag(live, panel)
        report.check(turns(), "a drag does not wake idle mode")
        live.tool("mousemove", "--window", live.window, 160, 90)
        report.check(live.rest(live.key("r")), "idle mode does not come to rest again")
        live.leave(report)
    finally:
        live.process.send_signal(signal.SIGCONT)
        live.stop()


BROKEN = """{
  "resources": { "a": { "texture": "rgba16f" }, "b": { "texture": "rgba16f" }, "ldr": { "texture": "rgba8" } },
  "passes": [
    { "name": "good", "shader": "broken.frag.glsl", "write": { "result": "a" }, "parameters": { "of": 1.0 } },
    { "name": "bad", "shader": "broken.frag.glsl", "write": { "result": "b" }, "parameters": { "of": { "default": -1.0 } } },
    { "name": "show", "shader": "broken_show.frag.glsl", "read": ["a", "b"], "write": { "result": "ldr" } } ],
  "present": "ldr"
}
"""


def scan(weft, folder, report):
    """N names the first pass whose results are not finite, until there is none."""
    (folder / "shaders/broken.frag.glsl").write_text(
        "layout(std140) uniform Parameters { float of; };\nin vec2 uv;\nout vec4 result;\nvoid main() { result = vec4(uv.x < 0.25 ? sqrt(of) : 1.0); }\n")
    (folder / "shaders/broken_show.frag.glsl").write_text(
        "uniform sampler2D a, b;\nin vec2 uv;\nout vec4 result;\nvoid main() { result = texture(a, uv) + texture(b, uv); }\n")
    save(folder / "graphs/broken.json", BROKEN)
    live = Session(weft, folder, "--idle", graph="graphs/broken.json")
    try:
        live.open(40, 40)
        live.key("n")
        report.check(live.event("scan pass 'bad' is the first with NaN or infinities: 25 % of the texels of 'b'"), f"NaN was not found\n{live.lines()}")
        since = live.mark()
        edit(folder / "graphs/broken.json", '"default": -1.0', '"default": 1.0')
        live.event("files good", since)
        live.key("n")
        report.check(live.event("scan no NaN and no infinity in what the passes write", since), f"NaN where none is\n{live.lines()}")
        live.leave(report)
    finally:
        live.stop()


def compare(weft, folder, display, report):
    """M keeps the picture: left of a line it is what it was, right of that what it is now, to the bit; the line can be dragged."""
    screen, base = Screen(display), folder / "shaders/base.frag.glsl"
    live = Session(weft, folder, "--idle", graph="graphs/pair.json", size="1280x400")
    try:
        if not report.check(live.open(40, 40) and live.rest(0), f"no picture at rest\n{live.said()}"):
            return
        shots = [rgb_rows(live.shot())]
        live.act("m", "compare")
        live.tool("mousemove", 1200, 300)  # away from the picture
        before = live.mark()
        save(base, BASE.replace("0.25", "0.75"))
        report.check(live.event("files good", before) and live.rest(before), f"the save is not seen\n{live.said()}")
        shots.append(rgb_rows(live.shot()))
        width = len(shots[0][0]) // 3
        report.check(shots[0] != shots[1], "the save changes nothing")

        def divided(at):
            rows, line = screen.read()[2], width * at // 8
            return all(rows[y][:3 * (line - 4)] == shots[0][y][:3 * (line - 4)] and rows[y][3 * (line + 4):3 * width] == shots[1][y][3 * (line + 4):] for y in range(len(shots[0])))

        report.check(live.until(lambda: divided(4)), "not divided in the middle")
        middle, y = width // 2, len(shots[0]) // 2
        live.process.send_signal(signal.SIGSTOP)  # a frame may take longer than a hand: the whole drag arrives in one
        live.tool("mousemove", middle, y, "mousedown", 1, "mousemove", width // 4, y, "mouseup", 1, "mousemove", 1200, 300)
        live.process.send_signal(signal.SIGCONT)
        report.check(live.until(lambda: divided(2)), "the line does not follow the mouse")
        before = live.act("F11", "full_screen") and live.mark()
        report.check(live.line("event \\d+ size 1280 1024"), f"F11 does not take the screen\n{live.lines()[-5:]}")
        live.act("F11", "full_screen")
        report.check(live.line("event \\d+ size 1280 400", before) and live.rest(before), f"F11 does not give the window back\n{live.lines()[-5:]}")
        live.act("m", "compare")
        report.check(live.until(lambda: all(screen.read()[2][y][:3 * width] == row for y, row in enumerate(shots[1]))), "the kept picture stays")
        live.leave(report)
    finally:
        live.stop()


def keys(weft, folder, display, report):
    """A file sets keys. They change parameters and presets, which Ctrl Z takes back, and show textures in place of the picture. Files that
    were opened are kept between runs. While the camera is moved there are fewer pixels."""
    home, screen = folder / "home/weft", Screen(display)
    shutil.rmtree(home, ignore_errors=True)
    (home / "presets").mkdir(parents=True)
    (home / "keys.json").write_text(KEYS)
    (home / "presets/dim.json").write_text('{ "set": { "exposure": 0.25 } }')
    (folder / "graphs/keyed.json").write_text(KEYED)
    (folder / "shaders/keyed.frag.glsl").write_text(
        "uniform sampler2D source;\nlayout(std140) uniform Parameters { float gain; };\nout vec4 result;\n"
        "void main() { result = gain * texelFetch(source, ivec2(gl_FragCoord.xy), 0); }\n")
    live = Session(weft, folder, "--idle", "--moving-scale", "0.5", graph="graphs/keyed.json", size="1100x400")

    def shown(shot):
        picture = [bytes(value for texel in row for value in texel[:3]) for row in read_png(shot.read_bytes())]
        return lambda: all(row[:len(part)] == part for row, part in zip(screen.read()[2][:160], picture))

    try:
        if not report.check(live.open(40, 40) and live.rest(0), f"no picture at rest\n{live.said()}"):
            return
        live.tool("mousemove", 1279, 1023)
        first = live.shot()
        for said in ("6:9: error[W011]", "7:3: error[W006]", "8:28: error[W004]"):
            report.check(f"home/weft/keys.json:{said}" in live.said(), f"{said} is not said\n{live.said()}")
        for key, action in (("u", "step exposure"), ("j", "step curve"), ("F2", "toggle bloom"), ("n", "toggle tints"), ("Right", "next_preset")):
            live.act(key, action)
            report.check(live.until(lambda: live.shot().read_bytes() != first.read_bytes()), f"{action} changes nothing\n{live.said()}")
            live.act("ctrl+z", "undo")
            report.check(live.until(lambda: live.shot().read_bytes() == first.read_bytes()), f"Ctrl Z does not take back {action}")
        report.check(live.until(shown(first)), "the picture is not on the screen")
        for key in ("h", "g"):
            live.key(key)
            report.check(live.until(lambda: not shown(first)()), f"{key} leaves the picture in its place")
            live.act(*(("Escape", "close") if key == "h" else ("g", "show_selected")))
            report.check(live.until(shown(first)) and live.alive(), f"the picture does not come back after {key}")
        report.check(live.line(r"weft render .*keyed.json --size \d+x\d+ .*--camera [-\d.,e]+", live.key("c")), f"C prints no command\n{live.lines()[-5:]}")
        since = live.mark()
        live.tool("mousemove", "--window", live.window, 200, 100)
        drag(live, (200, 100))
        report.check(live.event("scale 0.5", since) and live.event("scale 1", since), f"the scale does not follow the hand\n{live.lines()[-9:]}")
        live.tool("mousemove", 1279, 1023)
        picture = live.settled()
        live.act("ctrl+o", "open")
        report.check(live.until(lambda: not shown(picture)()), "no question is shown")
        live.key("Escape")
        report.check(live.until(shown(picture)) and live.alive(), "one Esc in the field does not close its question")
        live.act("ctrl+o", "open")
        since = live.mark()
        live.tool("type", "graphs/pair.json")
        live.process.send_signal(signal.SIGSTOP)  # the rest comes at once; the Esc behind Enter is the window's
        for key in ("Left", "Right", "Return", "Escape"):
            live.key(key)
        live.process.send_signal(signal.SIGCONT)
        report.check(live.event("closed", since), f"the Esc behind Enter is lost\n{live.lines()[-9:]}")
        report.check(live.event("opened graphs/pair.json", since), f"nothing is opened\n{live.lines()[-9:]}")
        acts = [line.split(" ", 2)[2] for line in live.lines()[since:] if " action " in line]
        report.check(acts == ["action close"], f"letters of a field do something\n{live.lines()[since:]}")
        live.until(lambda: not live.alive())
        report.check(live.process.poll() == 0, f"exit code {live.process.poll()}\n{live.said()}")
        report.check(sorted(path.name for path in home.iterdir()) == ["keys.json", "presets"], "a script leaves something for the next run")
    finally:
        live.process.send_signal(signal.SIGCONT)
        live.stop()


def places(weft, folder, report):
    """The window, its panels and the files that were opened are as they were in the run before; what is damaged is as if it was not there."""
    home, graph = folder / "home/weft", "graphs/pair.json"
    shutil.rmtree(home, ignore_errors=True)

    def run(*arguments, do=lambda live: None, **kinds):
        live = Session(weft, folder, *arguments, graph=graph, events=False, **kinds)
        try:
            said = live.open(40, 40) and live.shot() and live.line("weft render .* --size ([^ ]+) .*", live.key("c"))
            corner = re.search(r"Position: (-?\d+,-?\d+)", " ".join(live.tool("getwindowgeometry", live.window)))
            do(live)
            live.leave(report)
            return said and said[1], corner and corner[1]
        finally:
            live.stop()

    def change(live):
        live.tool("windowmove", live.window, 60, 50)
        live.tool("mousemove", "--window", live.window, 40, 40)
        live.key("space")
        live.tool("windowsize", live.window, 400, 300)
        report.check(live.until(lambda: " 400x300 " in live.line("weft render .*", live.key("c"))[0]), f"no size\n{live.lines()[-3:]}")

    first = run("--panels", "passes,times", size="", do=change)
    recent = (home / "recent").read_text()
    report.check(recent == f"{folder}/graphs/pair.json\n", recent)
    kept = (home / "places").read_text()
    report.check(kept.startswith("60 50 400 300\n0 times passes\n"), kept)
    report.check(run(size="") == ("400x300", "60,50"), "the window is another in the next run")
    report.check(run(size="300x200")[0] == "300x200", "--size is not the size")
    (home / "places").write_text(kept.replace("400", "4x0"))
    report.check(run("--panels", "passes", size="")[0] == first[0], "damaged places are taken up")


TWO = """{ "parameters": { "exposure": { "default": 1.0, "min": 0, "max": 2 }, "bloom": { "default": true } },
  "resources": { "ldr": { "texture": "rgba8", "size": "screen" } },
  "passes": [ { "name": "two", "type": "fullscreen", "shader": "two.frag.glsl", "write": { "result": "ldr" }, "parameters": { "gain": "$exposure * ($bloom ? 0.5 : 0.25)" } } ],
  "present": "ldr" }
"""
TWO_SHADER = "layout(std140) uniform Parameters { float gain; };\nin vec2 uv;\nout vec4 result;\nvoid main() { result = vec4(gain * uv, 0.25, 1.0); }\n"
KEYED = """{ "parameters": { "exposure": { "default": 1.0, "min": 0, "max": 4 }, "curve": { "default": "plain", "choices": ["plain", "dark"] },
    "bloom": { "default": true } },
  "resources": { "ldr": { "texture": "rgba8", "size": "screen" }, "seen": { "texture": "rgba8", "size": "screen" } },
  "passes": [
    { "name": "base", "type": "fullscreen", "shader": "base.frag.glsl", "write": { "result": "ldr" } },
    { "include": "tints.json", "as": "tints", "bind": { "ldr": "ldr" } },
    { "name": "keyed", "type": "fullscreen", "shader": "keyed.frag.glsl", "read": { "source": "ldr" }, "write": { "result": "seen" },
      "parameters": { "gain": "$exposure * ($curve == dark ? 0.5 : 1) * ($bloom ? 1 : 0.75)" } } ],
  "present": "seen" }
"""
KEYS = """{
  "U": { "step": "exposure", "by": -0.5 },
  "J": { "step": "curve" },
  "N": { "toggle": "tints" },
  "H": { "show": "ldr", "as": "scale" },
  "K": "flu",
  "J": null,
  "B": { "do": "head_bob", "speed": 2 }
}
"""


def main():
    weft, report = os.path.abspath(sys.argv[1]), Report()
    display = inside_display(report, weft, "none", __file__)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        copy_of_tree(folder)
        (folder / "graphs/pair.json").write_text(PAIR)
        (folder / "graphs/tints.json").write_text(TINTS)
        (folder / "shaders/base.frag.glsl").write_text(BASE)
        (folder / "shaders/tint.frag.glsl").write_text(TINT)
        panels(weft, folder, display, report, "1", "1100x400")
        panels(weft, folder, display, report, "2", "1280x720")
        for old in folder.glob("weft_*"):
            old.unlink()
        effects(weft, folder, report)
        pictures(weft, folder, display, report)
        preset(weft, folder, report)
        save_camera(weft, folder, report)
        write_back(weft, folder, report)
        hidden(weft, folder, report)
        scan(weft, folder, report)
        compare(weft, folder, display, report)
        keys(weft, folder, display, report)
        places(weft, folder, report)
    report.end()


main()
