#!/usr/bin/env python3
"""The viewer's panels in a window of a virtual display: each opens, at content scales 1 and 2, and the picture under them
stays the same to the bit; a trace of the session holds its frames; a value and a pass changed on the command line are
written into the files with F8, comments and all, and what was changed is the file's from then on."""
import json
import os
import pathlib
import re
import sys

from program import Report, temporary_folder
from window import Session, copy_of_tree, inside_display

KEYS = ["F4", "F5", "F6", "F7"]


def panels(weft, folder, report, scale):
    live = Session(weft, folder, "--ui-scale", scale, "--panels", "inspector,profiler,storage,histogram", "--trace", "session.json")
    try:
        if not report.check(live.open(), f"no window\n{live.said()}"):
            return
        first = live.settled()
        if not report.check(first, f"no picture\n{live.said()}"):
            return
        for key in [*KEYS, "F2", "F3", "p", *KEYS, "F2", "F3"]:
            live.key(key)
            beside = live.shot()
            report.check(beside and beside.read_bytes() == first.read_bytes(), f"scale {scale}: {key} changes the picture under the panels")
        live.act("F9", "trace")  # ends the trace that --trace began
        live.act("F9", "trace")  # begins another
        live.shot()
        live.act("F9", "trace")
        traces = list(folder.glob("weft_*.trace.json"))
        live.leave(report)
        report.check(not live.said(), live.said())
        for path in [folder / "session.json", *(traces or [])]:
            events = json.loads(path.read_text())["traceEvents"]
            frames = [e for e in events if e.get("cat") == "frame"]
            report.check(frames and all(any(e.get("cat") == "pass" and e["args"]["frame"] == f["args"]["frame"] for e in events) for f in frames),
                         f"{path.name}: {len(frames)} frames")
        report.check(traces, "F9 wrote no trace")
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


def main():
    weft, report = os.path.abspath(sys.argv[1]), Report()
    inside_display(report, weft, "none", __file__)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        copy_of_tree(folder)
        for scale in ("1", "2"):
            panels(weft, folder, report, scale)
            for old in [*folder.glob("weft_*"), *folder.glob("session.json")]:
                old.unlink()
        write_back(weft, folder, report)
    report.end()


main()
