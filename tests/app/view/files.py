#!/usr/bin/env python3
"""What the viewer reads again. A file that became a pipe is refused on reload, the last good picture stays and Escape works; so does it
while an environment's pipe has no writer."""
import os

from window import Session, run_parts, save


def becomes_a_pipe(weft, folder, report):
    live = Session(weft, folder, "--no-ui", graph="graphs/glow.json")
    try:
        if not report.check(live.open(), f"no window\n{live.said()}"):
            return
        first = live.settled()
        for file, code in (("graphs/glow.json", "W001"), ("shaders/composite/composite.frag.glsl", "W100"), ("scenes/spheres.json", "W001")):
            path, said = folder / file, len(live.said())
            text = path.read_text()
            os.mkfifo(folder / "pipe~")
            (folder / "pipe~").rename(path)
            report.check(live.until(lambda: f"error[{code}]" in live.said()[said:] and "it is a pipe" in live.said()[said:]),
                         f"{file} became a pipe, and nobody says so\n{live.said()}")
            same = live.shot()
            report.check(first and same and same.read_bytes() == first.read_bytes(), f"{file} became a pipe: the picture changes")
            save(path, text)
            report.check(live.until(lambda: live.tool("getwindowname", live.window)[-1:] == ["graphs/glow.json"]),
                         f"{file} is back, and the title still says that files have errors\n{live.said()}")
        live.leave(report)
    finally:
        live.stop()


def waits_for_a_pipe(weft, folder, report):
    os.mkfifo(folder / "never.hdr")
    live = Session(weft, folder, "--no-ui", "--environment", "never.hdr", graph="graphs/glow.json")
    try:
        if report.check(live.open() and live.shot(), f"no picture while an environment is awaited\n{live.said()}"):
            live.leave(report)
    finally:
        live.stop()


run_parts(__file__, becomes_a_pipe, waits_for_a_pipe)
