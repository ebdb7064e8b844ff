#!/usr/bin/env python3
"""What the viewer reads again. A file that became a pipe is refused on reload, the last good picture stays and Escape works; so does it
while an environment's pipe has no writer. An environment that is not there ends the program at its start; one that is opened in the window and
refused does not count at its end. A shader that appears before the one in use is taken, and so is that one when it vanishes and
comes back; what it includes is found beside the one it stands in for."""
import os
import re

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


def refused(weft, folder, report):
    live = Session(weft, folder, "--environment", "missing.hdr", graph="graphs/glow.json")
    try:
        live.until(lambda: not live.alive())
        report.check(live.process.poll() == 1 and "missing.hdr: error[W150]" in live.said() and not live.lines(),
                     f"a missing environment: exit code {live.process.poll()}, {live.lines()}\n{live.said()}")
    finally:
        live.stop()
    (folder / "broken.hdr").write_text("no picture")
    (folder / "broken.glb").write_text("no model")
    live = Session(weft, folder, graph="graphs/glow.json", size="1100x400")
    try:
        if not report.check(live.open(40, 40) and live.shot(), f"no window\n{live.said()}"):
            return
        for name, code in (("missing.hdr", "W150"), ("missing.glb", "W001"), ("broken.hdr", "W150"), ("broken.glb", "W002")):
            said, since = len(live.said()), live.mark()
            live.act("ctrl+o", "open")
            live.key("ctrl+a")
            live.tool("type", name)
            live.key("Return")
            report.check(live.event(f"opened {name}", since), f"{name} is not taken\n{live.lines()[-5:]}")
            report.check(live.until(lambda: re.search(rf"{name}(:\d+)*: error\[{code}\]", live.said()[said:])), f"{name}: no {code} in\n{live.said()[said:]}")
        report.check(live.event("files good", since), f"the scene before does not come back\n{live.lines()[-5:]}")
        live.leave(report)
    finally:
        live.stop()


def refused_by_the_graph(weft, folder, report):
    (folder / "few.json").write_text("""{ "resources": { "ldr": { "texture": "rgba8", "size": "screen" } },
      "passes": [ { "name": "sky", "shader": "sky/sky.frag.glsl", "enabled": "count(@spheres) < 200", "read": ["@environment"],
                    "write": { "radiance": "ldr" } } ], "present": "ldr" }""")
    (folder / "many.json").write_text('{ "grid": { "count": [20, 20, 1], "spacing": 1, "radius": 0.4, "materials": "materials/pbr_materials.json" } }')
    live = Session(weft, folder, graph="few.json", size="1100x400")
    try:
        if not report.check(live.open(40, 40) and live.shot(), f"no window\n{live.said()}"):
            return
        since = live.mark()
        live.act("ctrl+o", "open")
        live.tool("type", "many.json")
        live.key("Return")
        report.check(live.event("opened many.json", since) and live.event("files good", since), f"the scene before does not come back\n{live.lines()[-5:]}")
        report.check("'sky'" in live.said(), f"nothing is said of the scene\n{live.said()}")
        since = live.mark()
        (folder / "few.json").write_text((folder / "few.json").read_text() + "\n")
        report.check(live.event("files good", since), f"the graph is not read again\n{live.lines()[-5:]}")
        live.leave(report)
    finally:
        live.stop()


def appears_and_vanishes(weft, folder, report):
    mine = folder / "mine"
    mine.mkdir()
    (mine / "glow.json").write_text('{ "extends": "../graphs/glow.json" }\n')
    live = Session(weft, folder, "--no-ui", graph="mine/glow.json")
    try:
        if not report.check(live.open(), f"no window\n{live.said()}"):
            return
        first = live.settled()
        own = mine / "shaders/composite/composite.frag.glsl"
        text = (folder / "shaders/composite/composite.frag.glsl").read_text().replace("result = ", "result = vec4(0.2, 1.0, 0.2, 1.0) * ")
        shot = lambda: live.shot().read_bytes()
        own.parent.mkdir(parents=True)
        own.write_text(text)
        report.check(live.until(lambda: shot() != first.read_bytes()), f"a shader that appears is not seen\n{live.said()}")
        green = live.settled().read_bytes()
        own.unlink()
        report.check(live.until(lambda: shot() == first.read_bytes()), f"a shader that vanishes is not seen\n{live.said()}")
        own.write_text(text)
        report.check(live.until(lambda: shot() == green), f"a shader that comes back is not seen\n{live.said()}")
        live.leave(report)
    finally:
        live.stop()


run_parts(__file__, becomes_a_pipe, waits_for_a_pipe, refused, refused_by_the_graph, appears_and_vanishes)
