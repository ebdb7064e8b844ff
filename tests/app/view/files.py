#!/usr/bin/env python3
"""What the viewer reads again. A file that became a pipe is refused on reload, the last good picture stays and Escape works; so does it
while an environment's pipe has no writer. Without inotify, really used up, saves are found by looking, which is said once."""
import os
import subprocess
import sys

from window import Session, edit, run_parts, save


def other_picture(live, old):
    return live.until(lambda: (s := live.shot()) and s.read_bytes() != old.read_bytes() and s)


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


def without_inotify(weft, folder, report):
    """In a user namespace of its own, which may have no instance."""
    used_up = 'echo 0 > /proc/sys/user/max_inotify_instances && exec "$@"'
    if subprocess.run(["unshare", "-Ur", "sh", "-c", used_up, "sh", "true"], capture_output=True).returncode != 0:
        report.skip("no user namespace to use up inotify in")
        return
    script = folder / "weft_without_inotify"
    script.write_text(f"#!/bin/sh\nexec unshare -Ur sh -c '{used_up}' sh '{weft}' \"$@\"\n")
    script.chmod(0o755)
    live = Session(str(script), folder, "--no-ui", "--idle", graph="graphs/glow.json")
    try:
        if not report.check(live.open(), f"no window\n{live.said()}"):
            return
        first = live.settled()
        edit(folder / "graphs/glow.json", r'"passes"', '"passes')
        report.check(live.until(lambda: "glow.json:" in live.said() and "error[W002]" in live.said()), f"a broken save is not found\n{live.said()}")
        text = (folder / "graphs/glow.json").read_text().replace('"passes', '"passes"', 1)
        save(folder / "graphs/glow.json", text)
        edit(folder / "shaders/composite/composite.frag.glsl", r"result = ", "result = vec4(0.2, 1.0, 0.2, 1.0) * ")
        report.check(first and other_picture(live, first), f"a changed shader is not found\n{live.said()}")
        report.check(live.said().count("note[W205]") == 1 and "no inotify instance" in live.said(), f"not said once how files are watched\n{live.said()}")
        live.leave(report)
    finally:
        live.stop()


run_parts(__file__, *([without_inotify] if "--without-inotify" in sys.argv else [becomes_a_pipe, waits_for_a_pipe]))
