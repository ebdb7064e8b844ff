#!/usr/bin/env python3
"""How fast `weft lsp` answers a change of a graph of 1,000 passes: a letter typed into a slot and taken back, from the message to the diagnostics. Prints
the time by the clock and in processor time of the server, and checks that each letter is answered with its own diagnostics.

    speed.py WEFT
"""
import json
import os
import pathlib
import shutil
import sys
import time

from editor import Editor, cpu_seconds
from program import Report, temporary_folder

HERE = pathlib.Path(__file__).resolve().parent
CHANGES = 40


def large_graph(count):
    passes = ",\n".join(f'    {{ "name": "p{i}", "type": "fullscreen", "shader": "lsp/show.frag.glsl", "read": {{ "source": "t{i - 1}" }}, "write": {{ "result": "t{i}" }} }}'
                        for i in range(1, count + 1))
    resources = ",\n".join(f'    "t{i}": {{ "texture": "rgba8", "size": 64{", " + chr(34) + "clear" + chr(34) + ": 0" if i == 0 else ""} }}' for i in range(count + 1))
    return f'{{\n  "resources": {{\n{resources}\n  }},\n  "passes": [\n{passes}\n  ],\n  "present": "t{count}"\n}}\n'


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    with temporary_folder() as name:
        folder = pathlib.Path(name).resolve()
        shutil.copytree(HERE / "workspace/shaders", folder / "shaders")
        editor = Editor(weft, folder)
        editor.ask("initialize", {"capabilities": {}, "rootUri": editor.uri("")})
        text = large_graph(1000)
        editor.open("large.json", text)
        editor.settle("large.json")
        lines = text.splitlines()
        line = next(i for i, t in enumerate(lines) if '"name": "p500"' in t)
        column = lines[line].index('"t499"') + 5
        times, before = [], cpu_seconds(editor)
        for i in range(CHANGES):
            began = time.perf_counter()
            editor.change("large.json", [(f"{line}:{column}-{line}:{column}", "x") if i % 2 == 0 else (f"{line}:{column}-{line}:{column + 1}", "")])
            while (message := editor.receive()).get("params", {}).get("version") != i + 2:
                pass
            times.append((time.perf_counter() - began) * 1000)
            report.check(bool(message["params"]["diagnostics"]) == (i % 2 == 0), f"change {i}: {message}")
        cpu = (cpu_seconds(editor) - before) * 1000 / CHANGES
        print(json.dumps({"passes": 1000, "bytes": len(text), "changes": CHANGES, "median_ms": round(sorted(times)[CHANGES // 2], 1), "max_ms": round(max(times), 1),
                          "mean_cpu_ms": round(cpu, 1), "load": round(os.getloadavg()[0], 1)}))
        report.check(editor.end() == 0, "the exit code after shutdown")
    report.end()


main()
