#!/usr/bin/env python3
"""A session with `weft view` in a window of a virtual display: a broken save keeps the picture and says what is wrong, the
fix is taken up, so are a changed shader, an include that was missing, and a changed scene; the window is resized and
dragged in; Escape closes it. Then: exit code 0, no message of the driver. Waits have generous limits, nothing is timed."""
import os
import pathlib
import re
import sys

from program import Report, run, temporary_folder
from window import Session, copy_of_tree, edit, inside_display, save


def session(weft, compare, folder, report):
    def describe(shot):
        words = run(compare, "--describe", shot).out.split()
        return (int(words[0]), int(words[1]), float(words[2]), float(words[3])) if len(words) >= 4 else (0, 0, 0.0, 0.0)

    def changes(what, old):
        """Takes pictures until one differs from `old`."""
        seen = live.until(lambda: (s := live.shot()) and s.read_bytes() != old.read_bytes() and s)
        report.check(seen, f"{what}: the picture stays as it was\n{live.said()}")
        return seen or old

    settings, composite = folder / "graphs/effects/composite.json", folder / "shaders/composite/composite.frag.glsl"
    live = Session(weft, folder)
    try:
        first = live.opened(report)
        if not first:
            return
        size = describe(first)
        report.check(size[:2] == (320, 180) and size[2] > 20 and size[3] > 10, f"first picture: {size}")

        for key in ("F1", "p", "F1", "p", "r"):
            live.key(key)
            beside = live.shot()
            report.check(beside and beside.read_bytes() == first.read_bytes(), f"{key} changes the picture under the panels")

        whole = edit(settings, r'"passes"', '"passes')
        report.check(live.until(lambda: "effects/composite.json:" in live.said()), "a broken save is not reported")
        same = live.shot()
        report.check(live.alive() and same and same.read_bytes() == first.read_bytes(), "a broken save changes the picture")
        save(settings, re.sub(r'("exposure": *\{[^}\n]*"default": )[-\d.]+', r"\g<1>2.5", whole))
        brighter = changes("the fix with more exposure", first)
        report.check(describe(brighter)[2] > size[2] + 5, f"exposure 2.5: mean {describe(brighter)[2]} after {size[2]}")

        text = composite.read_text()
        save(composite, text.replace("void main() {", "void main() {\n  nothing = 1;", 1))
        report.check(live.until(lambda: "error[W104]" in live.said()), "a shader that does not compile is not reported")
        save(composite, '#include "late.glsl"\n' + text)
        report.check(live.until(lambda: "error[W101]" in live.said()), "a missing include is not reported")
        save(composite, text.replace("void main() {", '#include "late.glsl"\nvoid main() {', 1)
             .replace("result = ", "result = late() * "))
        (folder / "shaders/composite/late.glsl").write_text("vec4 late() { return vec4(0.2, 1.0, 0.2, 1.0); }\n")
        green = changes("a shader with an include that comes late", brighter)
        save(folder / "shaders/composite/late.glsl", "vec4 late() { return vec4(1.0); }\n")
        white = changes("a changed include", green)

        edit(folder / "scenes/spheres.json", r'"spacing": [\d.]+', '"spacing": 3.5')
        apart = changes("a changed scene", white)

        graph, said = folder / "graphs/studio.json", len(live.said())
        kept = graph.read_text()
        graph.unlink()
        report.check(live.until(lambda: "error[W001]" in live.said()[said:] and "studio.json" in live.said()[said:]),
                     f"nobody says that the graph is gone\n{live.said()}")
        same = live.shot()
        report.check(same and same.read_bytes() == apart.read_bytes(), "without its file the picture changes")
        save(graph, re.sub(r"^\{", "{ // is back", kept))
        report.check(live.until(lambda: live.tool("getwindowname", live.window)[-1:] == ["graphs/studio.json"]),
                     f"the title still says that files have errors: {live.tool('getwindowname', live.window)}")
        same = live.shot()
        report.check(same and same.read_bytes() == apart.read_bytes(), "back again, the picture is another one")

        live.tool("mousemove", "--window", live.window, 100, 90)
        live.tool("mousedown", 1)
        for x in range(110, 200, 10):
            live.tool("mousemove", "--window", live.window, x, 90)
        live.tool("mouseup", 1)
        turned = changes("a drag", apart)
        for width, height in ((400, 300), (1, 1), (333, 77), (640, 200), (500, 260)) * 3:
            live.tool("windowsize", live.window, width, height)
        report.check(live.resize(420, 240) and live.resize(500, 260), "a size is never taken")
        resized = live.until(lambda: (s := live.shot()) and describe(s)[:2] == (500, 260) and s)
        report.check(resized and turned and resized.read_bytes() != turned.read_bytes(), f"a picture of 500x260 never comes\n{live.said()}")
        live.tool("mousemove", "--window", live.window, 160, 90)
        live.leave(report)
        report.check("W120" not in live.said(), live.said())
    finally:
        live.stop()


def closed_without_its_file(weft, folder, report):
    live = Session(weft, folder)
    try:
        if not report.check(live.open() and live.shot(), f"no picture\n{live.said()}"):
            return
        (folder / "graphs/studio.json").unlink()
        report.check(live.until(lambda: "error[W001]" in live.said()), f"nobody says that the graph is gone\n{live.said()}")
        live.leave(report, 1)
    finally:
        live.stop()


def main():
    weft, compare, report = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), Report()
    inside_display(report, weft, compare, __file__)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        copy_of_tree(folder)
        session(weft, compare, folder, report)
        closed_without_its_file(weft, folder, report)
    report.end()


main()
