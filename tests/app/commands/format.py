#!/usr/bin/env python3
"""`weft format`: every bundled graph, overlay and preset, and every graph of the tests, is laid out as it says; what it does to files.
format.py WEFT, from the source folder.

Any change of white space comes back, one file at a time and several at once; --check writes nothing and names the first line that
differs; broken files are reported as everywhere and stay as they are; a file that cannot be written stays whole; no line of a bundled graph
is longer than 120 characters."""
import json
import os
import pathlib
import re
import shutil
import sys

from program import GRAPH_FOLDERS, Report, TOP, run, temporary_folder

STRIP = re.compile(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', re.S)


def graphs():
    for folder in GRAPH_FOLDERS:
        if folder == "tests/app/lsp/workspace":  # as somebody typed them
            continue
        for path in sorted((TOP / folder).rglob("*.json")):
            if folder == "graphs" or re.search('"(passes|extends)":', path.read_text()):
                yield path


def value_of(text):
    return json.loads(STRIP.sub(lambda m: m[1] or " ", text))


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    files = list(graphs())
    report.check(len(files) > 40, f"{len(files)} files")
    held = run(weft, "format", "--check", *files)
    report.check(held.code == 0 and not held.err and not held.out, f"not laid out: {held.out}{held.err}")
    for path in (p for p in files if p.is_relative_to(TOP / "graphs")):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            report.check(len(line) <= 120, f"{path}:{number}: {len(line)} characters")

    with temporary_folder() as name:
        folder = pathlib.Path(name)
        copies = []
        for i, path in enumerate(files):
            copies.append(folder / f"{i}.json")
            text = path.read_text()
            # Comments end at their line's end, so only lines without any are joined and spread.
            spread = re.sub(r'^(?!.*(//|/\*)) *(.*)$', lambda m: "\t" + m[2].replace(", ", " ,   ").replace("{ ", "{"), text, flags=re.M)
            copies[-1].write_text(spread if value_of(spread) == value_of(text) else text + "\n\n")
        checked = run(weft, "format", "--check", *copies, "--limit", "10")
        report.check(checked.code == 1 and checked.codes() == ["W197"], f"--check: {checked.code}\n{checked.err}")
        report.check(len(checked.diagnostics) == len(copies), f"{len(checked.diagnostics)} of {len(copies)} reported")
        formatted = run(weft, "format", *copies)
        report.check(formatted.code == 0 and formatted.out.split() == [str(c) for c in copies], f"{formatted.out}{formatted.err}")
        for path, copy in zip(files, copies):
            report.check(copy.read_text() == path.read_text(), f"{path} does not come back")
        again = run(weft, "format", *copies)
        report.check(again.code == 0 and again.out == "", f"a second time: {again.out}{again.err}")

        graph = folder / "graph.json"
        graph.write_text('{\n  "name": "a",\n  "passes": [ ]\n}\n')
        told = run(weft, "format", "--check", graph)
        wanted = f"{graph}:3:1: error[W197]: the file is not laid out as `weft format` does it\n    fix: weft format {graph}\n"
        report.check(told.code == 1 and told.err == wanted, f"the first line that differs:\n{told.err}")
        report.check("[ ]" in graph.read_text(), "--check writes")

        # A pass that is like another, in words of the first edition, is written out whole; comments stay.
        old = folder / "old.json"
        old.write_text("""{
  "resources": { "a": { "texture": "rgba8", "size": 8, "clear": 0 }, "b": { "texture": "rgba8", "size": 8 }, "c": { "texture": "rgba8", "size": 8 } },
  "passes": [
    { "name": "one", "type": "fullscreen", "shader": "one.frag.glsl", "read": { "source": "a", "more": "a as linear" }, // of one
      "write": { "result": "b" }, "parameters": { "gain": { "default": 2.0 }, "bias": 1 }, "defines": { "ONE": 1 } },
    { "name": "two", "like": "one", // keeps the gain
      "read": { "source": null, /* , */ "third": "b" }, "write": { "result": "c" }, "defines": { "ONE": null } },
    { "name": "three", "like": "two", "shader": "three.frag.glsl", "parameters": null, "side_effect": true },
    { "name": "four", "like": "nobody" }
  ],
  "present": "c"
}
""")
        told = run(weft, "check", "--no-shaders", old)
        report.check(told.err.count("[W004]") == told.err.count("error[") == 3, f"a file of the first edition: {told.err}")
        report.check(run(weft, "format", old).code == 0, "a file of the first edition")
        new = value_of(old.read_text())["passes"]
        two = {"name": "two", "type": "fullscreen", "shader": "one.frag.glsl", "read": {"more": "a as linear", "third": "b"}, "write": {"result": "c"},
               "parameters": {"gain": "$one.gain", "bias": 1}}
        three = {key: value for key, value in two.items() if key != "parameters"} | {"name": "three", "shader": "three.frag.glsl", "side_effect": True}
        report.check(new[1:] == [two, three, {"name": "four", "like": "nobody"}], old.read_text())
        report.check(all(text in old.read_text() for text in ("// of one", "// keeps the gain", "/* , */")), old.read_text())

        good = graph.read_text()
        for broken, code in (('{ "name": "a" "passes": [] }', "W002"), ('{ "name": 1, "name": 2 }', "W006"), ("[" * 80 + "]" * 80, "W007"), ("", "W002")):
            bad = folder / "bad.json"
            bad.write_text(broken)
            graph.write_text(good)
            both = run(weft, "format", bad, graph)
            report.check(both.code == 1 and both.codes() == [code], f"{broken!r}: {both.code}\n{both.err}")
            report.check(bad.read_text() == broken, f"{broken!r} was changed")
            report.check("[ ]" not in graph.read_text(), "the file behind a broken one was left out")
        missing = run(weft, "format", folder / "no_such.json")
        report.check(missing.code == 1 and missing.codes() == ["W001"], missing.err)

        # A link goes on leading to its file, permissions stay.
        graph.write_text(good)
        graph.chmod(0o640)
        (folder / "link.json").symlink_to(graph)
        linked = run(weft, "format", folder / "link.json")
        report.check(linked.code == 0 and (folder / "link.json").is_symlink() and "[ ]" not in graph.read_text(), linked.err)
        report.check(graph.stat().st_mode & 0o777 == 0o640, "permissions")
        # A disk that is full: the file is as it was, and nothing lies beside it.
        graph.write_text(good + " " * 5000)
        full = run("bash", "-c", 'ulimit -f 0; exec "$0" format "$1"', weft, graph)
        report.check(full.code == 1 and full.codes() == ["W180"], f"no room: {full.code}\n{full.err}")
        report.check(graph.read_text() == good + " " * 5000, "no room: the file changed")
        report.check(not [p for p in folder.iterdir() if p.suffix != ".json"], f"left behind: {list(folder.iterdir())}")
    report.end()


main()
