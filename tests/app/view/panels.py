#!/usr/bin/env python3
"""The viewer's panels in a window of a virtual display: each opens, at content scales 1 and 2, and the picture under them
stays the same to the bit; a value and a pass changed on the command line are
written into the files with F8, comments and all, and what was changed is the file's from then on. Whose a drag is, is judged where it begins,
however fast the mouse got there; at rest in idle mode a drag turns the picture."""
import os
import pathlib
import re
import signal
import sys

from program import Report, temporary_folder
from window import Session, copy_of_tree, inside_display

KEYS = ["F4", "F5", "F6", "F7"]


def panels(weft, folder, report, scale):
    live = Session(weft, folder, "--ui-scale", scale, "--panels", "inspector,profiler,storage,histogram")
    try:
        first = live.opened(report)
        if not first:
            return
        for key in [*KEYS, "F2", "F3", "p", *KEYS, "F2", "F3"]:
            live.key(key)
            beside = live.shot()
            report.check(beside and beside.read_bytes() == first.read_bytes(), f"scale {scale}: {key} changes the picture under the panels")
        live.leave(report)
        report.check(not live.said(), live.said())
    finally:
        live.stop()


def write_back(weft, folder, report):
    composite, post = folder / "graphs/effects/composite.json", folder / "graphs/post.json"
    files = (composite, post)
    before = [path.read_text() for path in files]
    live = Session(weft, folder, "--set", "exposure=1.25", "--set", "curve=aces", "--disable", "fxaa")
    try:
        if not report.check(live.open() and live.shot(), f"no picture\n{live.said()}"):
            return
        live.key("F8")
        report.check(live.until(lambda: all(path.read_text() != text for path, text in zip(files, before))), f"F8 writes nothing\n{live.said()}")
        expected = re.sub(r'("exposure": *\{[^}\n]*"default": )[-\d.]+', r"\g<1>1.25", before[0])
        expected = re.sub(r'("curve": *\{ "default": )"filmic"', r'\g<1>"aces"', expected)
        report.check(composite.read_text() == expected, f"{composite.name} has\n{composite.read_text()}")
        changed = [a for a, b in zip(post.read_text().splitlines(), before[1].splitlines()) if a != b]
        report.check(len(changed) == 1 and "fxaa" in changed[0] and "false" in changed[0], f"other lines changed: {changed}")
        live.leave(report)
    finally:
        live.stop()
    for path, text in zip(files, before):
        path.write_text(text)


def drag(live, start=(280, 5)):
    """To the left; by default along the bar at the top, which does nothing where no menu stands."""
    live.tool("mousemove", "--window", live.window, *start)
    live.tool("mousedown", 1)
    for x in (20, 40, 60):
        live.tool("mousemove", "--window", live.window, start[0] - x, start[1])
    live.tool("mouseup", 1)


def at_once(live, rest, start):
    """The mouse rests; then a movement to `start` and a drag from there come at once: the program sleeps meanwhile."""
    live.tool("mousemove", "--window", live.window, *rest)
    live.shot()  # a frame has seen where the mouse is
    live.process.send_signal(signal.SIGSTOP)
    drag(live, start)
    live.process.send_signal(signal.SIGCONT)
    return live.shot()


def hidden(weft, folder, report):
    live = Session(weft, folder, graph="graphs/glow.json")
    try:
        if not report.check(live.open(), f"no window\n{live.said()}"):
            return
        first = live.settled()
        same = lambda: (s := live.shot()) and s.read_bytes() == first.read_bytes()
        turns = lambda: live.until(lambda: not same())
        if not report.check(first, f"no picture\n{live.said()}"):
            return
        drag(live)
        live.shot()
        report.check(same(), "a drag that begins in the panels turns the picture")
        for _ in range(8):
            report.check(at_once(live, (160, 150), (280, 5)) and same(), "a drag that comes with the movement into the panels turns the picture")
            report.check(at_once(live, (280, 5), (160, 150)) and turns(), "a drag that comes with the movement out of the panels is lost")
            live.act("r", "reset_camera")
            report.check(live.until(same), "the camera does not come back")
        live.act("space", "panels")
        drag(live)
        report.check(turns(), "a drag after the panels were hidden is lost")
        live.act("r", "reset_camera")
        report.check(live.until(same), "the camera does not come back")
        report.check(live.rest(live.key("i")), "idle mode never comes to rest")
        drag(live)
        report.check(turns(), "a drag does not wake idle mode")
        live.tool("mousemove", "--window", live.window, 160, 90)
        report.check(live.rest(live.key("r")), "idle mode does not come to rest again")
        live.leave(report)
    finally:
        live.process.send_signal(signal.SIGCONT)
        live.stop()


def main():
    weft, report = os.path.abspath(sys.argv[1]), Report()
    inside_display(report, weft, "none", __file__)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        copy_of_tree(folder)
        for scale in ("1", "2"):
            panels(weft, folder, report, scale)
            for old in folder.glob("weft_*"):
                old.unlink()
        write_back(weft, folder, report)
        hidden(weft, folder, report)
    report.end()


main()
