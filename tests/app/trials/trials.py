#!/usr/bin/env python3
"""weft test, bisect, fuzz and new: exit codes, places of mistakes, what they find and what they leave behind.

    trials.py WEFT
"""
import json
import os
import pathlib
import re
import shutil
import sys

from fuzzing import GLOW, HALF, HALF_SHADERS, SIZE, check_fuzz, write_graph
from pictures import png
from program import TOP, Report, run, temporary_folder


def write_cases(folder, cases, **top):
    (folder / "some.cases.json").write_text(json.dumps({"defaults": {"size": SIZE}, **top, "cases": cases}, indent=2))


def write_mask(path, width, height, white):
    path.write_bytes(png([[(255 if white(x, y) else 0,) for x in range(width)] for y in range(height)]))


def check_defaults(weft, report, folder):
    """A graph among the defaults is that of every case that has none of its own."""
    write_cases(folder, [{"name": "one", "plan": True}, {"name": "two", "plan": True}], defaults={"size": SIZE, "graph": GLOW})
    result = run(weft, "test", folder, "--accept")
    report.check(result.code == 0 and "2 written" in result.out, f"{result.code}\n{result.out}{result.err}")


def check_test(weft, report, folder):
    def test(*arguments):
        return run(weft, "test", folder, *arguments)

    cases = [{"name": "glow", "graph": GLOW}, {"name": "plan", "graph": GLOW, "plan": True},
             {"name": "two", "graph": GLOW, "frames": [3, 0], "set": {"threshold": 2}}]
    write_cases(folder, cases)
    result = test()
    report.check(result.code == 1 and result.out.count("--accept") == 4 and "3 cases: 3 FAILED" in result.out, f"without goldens: {result.code}\n{result.out}{result.err}")
    result = test("--accept")
    report.check(result.code == 0 and "3 written" in result.out, f"accept: {result.code}\n{result.out}{result.err}")
    names = sorted(f.name for f in folder.iterdir())
    report.check(names == ["glow.passes", "glow.png", "plan.txt", "some.cases.json", "two.passes", "two_0000.png", "two_0003.png"], f"{names}")
    before = {name: (folder / name).read_bytes() for name in names}
    result = test()
    report.check(result.code == 0 and "3 cases: 3 ok" in result.out and not result.err, f"again: {result.code}\n{result.out}{result.err}")
    result = test("--accept")
    report.check(result.code == 0 and "3 cases: 3 ok" in result.out, f"accepted again: {result.out}")
    report.check(before == {name: (folder / name).read_bytes() for name in names}, "accepting what is the same changes a file")
    record = (folder / "two.passes").read_text()
    report.check(record.startswith("weft passes 2\ndriver ") and re.findall(r"^frame \d+$", record, re.M) == ["frame 0", "frame 3"], record[:200])

    # A picture that differs: the first pass is named, the page holds it, and the files are there.
    cases[0]["set"] = {"threshold": 0.25}
    write_cases(folder, cases)
    page, left = folder / "page.html", folder / "left"
    result = test("--report", page, "-o", left, "--only", "glow")
    report.check(result.code == 1 and "first that differs: pass 'glow_prefilter' writes another 'glow' in frame 0" in result.out, f"{result.code}\n{result.out}{result.err}")
    report.check("1 case: 1 FAILED" in result.out, result.out)
    text = page.read_text()
    report.check(text.count("data:image/png;base64,") == 3 and "glow_prefilter" in text and not re.search('(src|href)="http', text), f"page of {len(text)} bytes")
    report.check(sorted(f.name for f in left.iterdir()) == ["glow.png", "glow_flip.png"], f"{list(left.iterdir())}")
    # Bounds: each of them alone refuses, all of them wide accept.
    wide = {"flip": 1, "flip_peak": 1, "step": 255, "fraction": 1}
    for key in (None, *wide):
        cases[0]["tolerance"] = {**wide, **({key: 0} if key else {})}
        write_cases(folder, cases)
        result = test("--only", "glow")
        report.check(result.code == (1 if key else 0), f"tolerance {key}: {result.code}\n{result.out}")
    # A mask leaves out what differs.
    write_mask(folder / "none.png", 64, 36, lambda x, y: False)
    write_mask(folder / "half.png", 64, 36, lambda x, y: x < 32)
    write_mask(folder / "small.png", 8, 8, lambda x, y: True)
    del cases[0]["tolerance"]
    for mask, code in (("none.png", 0), ("half.png", 1), ("small.png", 2)):
        cases[0]["mask"] = mask
        write_cases(folder, cases)
        result = test("--only", "glow")
        report.check(result.code == code, f"mask {mask}: {result.code}\n{result.out}{result.err}")
    report.check("W152" in result.err and "some.cases.json:" in result.err and "expected: 64x36" in result.err, result.err)
    # A plan that differs, and a record of another driver.
    cases[0] = {"name": "glow", "graph": GLOW, "set": {"threshold": 0.25}}
    cases[1]["size"] = "320x180"
    write_cases(folder, cases)
    result = test("--only", "plan")
    report.check(result.code == 1 and re.search(r"line \d+ is '", result.out), f"{result.out}")
    (folder / "glow.passes").write_text(re.sub("driver .*", "driver another", (folder / "glow.passes").read_text()))
    result = test("--only", "glow")
    report.check(result.code == 1 and "first that differs" not in result.out, f"another driver: {result.out}")
    (folder / "glow.passes").write_text("weft passes 2\ndriver x\nframe 0\nnonsense\n")
    result = test("--only", "glow")
    report.check(result.code == 2 and "glow.passes:4:1: error[W003]" in result.err, f"damaged record: {result.err}")
    result = test("--accept")
    report.check(result.code == 0 and "changed: FLIP" in result.out, f"accept says how much: {result.out}")
    report.check(test().code == 0, "after accepting")


def check_mistakes(weft, report, folder):
    """Each mistake in a case file has its place; all are told at once."""
    graph = run(weft, "test", GLOW)
    report.check(graph.code == 2 and "W005" in graph.codes() and "cases" in graph.err, f"a graph: {graph.code} {graph.err}")
    text = """{
  "defaults": { "size": "64x36" },
  "cases": [
    { "name": "a/b", "graph": "g.json" },
    { "name": "twice", "graph": "g.json" }, { "name": "twice", "graph": "g.json" },
    { "nam": "x", "graph": "g.json" },
    { "name": "size", "graph": "g.json", "size": "64" },
    { "name": "frames", "graph": "g.json", "frames": [] },
    { "name": "frame", "graph": "g.json", "frame": -1 },
    { "name": "flip", "graph": "g.json", "tolerance": { "flip": 2, "steps": 1 } },
    { "name": "plan", "graph": "g.json", "plan": true, "mask": "m.png" },
    { "name": "set", "graph": "g.json", "set": { "bloom": null } }
  ]
}
"""
    (folder / "bad.cases.json").write_text(text)
    result = run(weft, "test", folder)
    told = {(int(d["line"] or 0), d["code"]) for d in result.diagnostics}
    expected = {(4, "W012"), (5, "W009"), (6, "W004"), (6, "W005"), (7, "W013"), (8, "W013"), (9, "W013"), (10, "W013"), (10, "W004"), (11, "W014"), (12, "W003")}
    report.check(result.code == 2 and told == expected, f"{result.code} {sorted(told ^ expected)}\n{result.err}")
    write = (folder / "bad.cases.json").write_text
    write('{ "cases": [\n  { "name": "no", "graph": "nothing.json" },\n  { "name": "set", "graph": "%s",\n    "set": { "bloom": 7 } } ] }' % GLOW)
    result = run(weft, "test", folder)
    report.check(result.code == 2 and "2 BROKEN" in result.out, f"{result.out}{result.err}")
    report.check(re.search(r"bad\.cases\.json:4:23: error\[W\d+\].*\(case 'set'\)", result.err), f"a setting has the place of its value: {result.err}")
    report.check("nothing.json" in result.err, result.err)
    (folder / "bad.cases.json").unlink()
    result = run(weft, "test", folder)
    report.check(result.code == 2 and "no file of cases" in result.err, f"{result.err}")


def check_files(weft, report, folder):
    """What it reads is never written over, every case is found, and names that it found forge no lines."""
    def test(*arguments, code=2, says=""):
        result = run(weft, "test", folder, *arguments)
        report.check(result.code == code and says in result.out + result.err, f"{arguments}: {result.code}\n{result.out}{result.err}")
        return result

    write_cases(folder, [{"name": "glow", "graph": GLOW}])
    test("--accept", code=0)
    write_cases(folder, [{"name": "glow", "graph": GLOW, "set": {"threshold": 0.25}}])
    before = {f.name: f.read_bytes() for f in folder.iterdir()}
    test("-o", folder, says="W180")
    for name in before:
        test("--report", folder / name, says="W180")
    report.check(before == {f.name: f.read_bytes() for f in folder.iterdir()}, "a file that is read was written over")
    # Nor what only a graph reads, nor, where that is not known because a case is broken, what is no page.
    own = write_graph(folder, "own", HALF.replace("half.frag", "ok_flip.frag"), {name.replace("half", "ok_flip"): text for name, text in HALF_SHADERS.items()})
    write_cases(folder, [{"name": "ok", "graph": str(own)}])
    kept = {f: f.read_bytes() for f in own.parent.rglob("*.*") if f.is_file()}
    for file in kept:
        test("--report", file, says="W180")
    # A picture that a graph reads, in the place of the difference: the case fails and the picture stays.
    with temporary_folder() as read:
        read = pathlib.Path(read)
        photo = read / "look_flip.png"
        write_mask(photo, 64, 36, lambda x, y: x < 32)
        shows = {"resources": {"photo": {"import": "image", "file": photo.name}, "ldr": {"texture": "rgba8", "size": "screen"}},
                 "passes": [{"name": "show", "type": "blit", "read": {"source": "photo"}, "write": {"destination": "ldr"}}], "present": "ldr"}
        (read / "shows.json").write_text(json.dumps(shows))
        write_cases(folder, [{"name": "look", "graph": str(read / "shows.json")}])
        test("--accept", code=0)
        write_mask(photo, 64, 36, lambda x, y: x < 16)
        now = photo.read_bytes()
        left = test("-o", read, says="which this run reads")
        report.check("FAILED  look" in left.out and "look_flip.png" in left.err and photo.read_bytes() == now, f"{left.out}{left.err}")
        for file in folder.glob("look*"):
            file.unlink()
    write_cases(folder, [{"name": "ok", "graph": str(own)}])
    own.write_text(own.read_text() + "}")
    test("--report", folder / "page.html")
    test("--report", folder / "page.html")
    report.check("<title>weft test</title>" in (folder / "page.html").read_text(), "the page has its head")
    report.check(all(f.read_bytes() == text for f, text in kept.items() if f != own), "what a graph reads was written over")
    shutil.rmtree(own.parent)
    (folder / "page.html").unlink()
    write_cases(folder, [{"name": "glow", "graph": GLOW, "set": {"threshold": 0.25}}])
    (folder / "gone.cases.json").symlink_to("nowhere")
    test(says="gone.cases.json")
    (folder / "gone.cases.json").unlink()
    (folder / "glow.png").write_bytes(b"")
    test("--accept", code=0, says="1 written")
    test(code=0)
    # A pipe in the place of a golden is neither waited for nor written to.
    for name in ("glow.png", "glow.passes"):
        kept = (folder / name).read_bytes()
        (folder / name).unlink()
        os.mkfifo(folder / name)
        result = run(weft, "test", folder, "--accept", timeout=120)
        report.check(result.code == 2 and result.codes() == ["W180"] and "a pipe" in result.err and name in result.err, f"{name} is a pipe: {result.code}\n{result.out}{result.err}")
        (folder / name).unlink()
        (folder / name).write_bytes(kept)
    forged = folder / "a\x1b[31mb\nok      all"
    forged.mkdir()
    shutil.copy(folder / "some.cases.json", forged / "other.cases.json")
    result = test(code=1)
    report.check("\x1b" not in result.out and "\nok      all" not in result.out, repr(result.out))
    shutil.rmtree(forged)
    # A case that is broken by its mask, its own golden that is not there yet, leaves no golden and no record.
    for mask, frames in (("none.png", [0]), ("lone.png", [0]), ("none.png", [0, 1])):
        write_cases(folder, [{"name": "lone", "graph": GLOW, "mask": mask, "frames": frames}])
        broken = test("--accept", says=mask)
        report.check(("BROKEN" in broken.out or broken.codes() == ["W180"]) and "anew" not in broken.out and not list(folder.glob("lone*")), f"{broken.out} {list(folder.glob('lone*'))}")

    # --accept writes over no golden of another case, no mask, no picture or text that a graph reads, and nothing of cases that do not run.
    shown = {"resources": {"photo": {"import": "image", "file": "sky.png"}, "ldr": {"texture": "rgba8", "size": "screen"}},
             "passes": [{"name": "show", "type": "blit", "read": {"source": "photo"}, "write": {"destination": "ldr"}}], "present": "ldr"}
    shown = write_graph(folder, "shown", json.dumps(shown), {})
    shown.rename(folder / "shown.json")
    write_mask(folder / "sky.png", 64, 36, lambda x, y: True)
    (folder / "over.txt").write_text(json.dumps({"extends": GLOW, "set": {"threshold": 2}}))
    (folder / "top.json").write_text(json.dumps({"extends": "over.txt", "set": {"bloom": False}}))
    sky = {"name": "sky", "graph": "shown.json"}
    for cases, code, only in (([{"name": "a", "graph": GLOW, "frames": [0, 1]}, {"name": "a_0001", "graph": GLOW, "frame": 1}], "W180", []),
                              ([{"name": "sky", "graph": GLOW, "mask": "sky.png"}], "W180", []), ([sky], "W180", []),
                              ([{"name": "over", "graph": "top.json", "plan": True}], "W180", []),
                              ([{"name": "sky", "graph": GLOW}, {"name": "other", "graph": GLOW, "mask": "sky.png"}], "W180", ["--only", "sky"])):
        write_cases(folder, cases)
        before = {f.name: f.read_bytes() for f in folder.iterdir() if f.is_file()}
        refused = test("--accept", *only)
        report.check(refused.codes() == [code] and before == {f.name: f.read_bytes() for f in folder.iterdir() if f.is_file()}, f"{cases}: {refused.err}")
    write_cases(folder, [{**sky, "name": "elsewhere"}])
    test("--accept", code=0)
    # A golden that is a link is not followed, and not written through; without it, it is written anew.
    write_cases(folder, [{"name": "plan", "graph": GLOW, "plan": True}])
    with temporary_folder() as elsewhere:
        (folder / "plan.txt").symlink_to(f"{elsewhere}/plan.txt")
        (folder / "plan.txt").write_text("another plan\n")
        test("--confine", folder, says="W200")
        test("--accept", "--confine", folder, says="is a link")
        report.check((folder / "plan.txt").read_text() == "another plan\n", "a golden was written through a link")
    (folder / "plan.txt").unlink()
    test("--accept", code=0, says="1 written")
    test(code=0)
    (folder / "plan.txt").unlink()

    # Words of a person's own folder, and of the one where the command is started, are no presets of a case.
    (folder / "own/weft/presets").mkdir(parents=True)
    (folder / "own/weft/presets/mine.json").write_text('{ "set": { "threshold": 7 } }')
    own = {"folder": folder, "env": {**os.environ, "XDG_CONFIG_HOME": str(folder / "own")}}
    preset = {"name": "preset", "graph": str(TOP / "graphs/studio.json"), "plan": True}
    write_cases(folder, [{**preset, "preset": ["plain"]}])
    test("--accept", code=0)
    for place in ("plain", "own/weft/presets/plain.json"):
        (folder / place).write_text('{ "set": {} }')
    result = run(weft, "test", folder, **own)
    report.check(result.code == 0, f"a case's preset depends on who runs it: {result.out}{result.err}")
    write_cases(folder, [{**preset, "preset": ["mine"]}])
    result = run(weft, "test", folder, **own)
    report.check(result.code == 2 and result.codes() == ["W001"], f"a preset that only one person has: {result.out}{result.err}")

    # Records and plans move no cursor, however they came about.
    write_cases(folder, [{"name": "forged", "graph": GLOW}])
    test("--accept", code=0)
    write_cases(folder, [{"name": "forged", "graph": GLOW, "set": {"threshold": 0.25}}, {"name": "long", "graph": GLOW, "plan": True}])
    (folder / "long.txt").write_text("x" * 100000 + "\n")
    record = (folder / "forged.passes").read_text()
    (folder / "forged.passes").write_text(record.replace("frame 0\n", f"frame 0\n{'0' * 16}\t\x1b]0;title\x07\thdr\n"))
    result = test(code=1, says="\\x1b]0;title")
    report.check(not set("\x1b\x07") & set(result.out) and len(result.out) < 4000, f"{len(result.out)} {result.out[:4000]!r}")

    # Of two frames that are far from each other only those two run, where nothing is remembered.
    far = [0, 4294967295]
    write_cases(folder, [{"name": "far", "graph": GLOW, "frames": far}])
    test("--accept", code=0, says="1 written")
    report.check({"far_0000.png", "far_4294967295.png"} <= {f.name for f in folder.iterdir()}, f"{list(folder.iterdir())}")

    # A picture of NaN has a warning, and so differs.
    nan = {"resources": {"picture": {"texture": "rgba16f", "size": [8, 8]}}, "present": "picture",
           "passes": [{"name": "nan", "type": "fullscreen", "shader": "nan.frag.glsl", "write": {"result": "picture"}}]}
    write_graph(folder, "nan", json.dumps(nan), {"nan.frag.glsl": "in vec2 uv;\nout vec4 result;\nvoid main() { result = vec4(sqrt(-1.0 - uv.x)); }\n"})
    write_cases(folder, [{"name": "nan", "graph": "nan/graph.json"}])
    test("--accept", code=0, says="W207")
    test(code=1, says="W207")


def check_bisect(weft, report, folder):
    same = run(weft, "bisect", GLOW, "--size", SIZE)
    report.check(same.code == 0 and "no pass differs" in same.out, f"{same.out}{same.err}")
    result = run(weft, "bisect", GLOW, "--size", SIZE, "--other-set", "threshold=0.25")
    report.check(result.code == 1 and "first that differs: pass 'glow_prefilter'" in result.out and "FLIP" in result.out, result.out + result.err)
    result = run(weft, "bisect", GLOW, "--size", SIZE, "--other-disable", "glow_up")
    # Then nothing needs the smaller levels, either: their passes are culled, which is not the cause.
    report.check(result.code == 1 and "pass 'glow_up[4]' no longer writes 'glow'" in result.out, result.out + result.err)
    # Two graphs: what the second one adds.
    result = run(weft, "bisect", GLOW, TOP / "tests/golden/vignette.json", "--size", SIZE)
    report.check(result.code == 1 and "pass 'vignette' writes 'scene' in frame 0, which it did not" in result.out, result.out + result.err)
    report.check(run(weft, "bisect", GLOW, folder / "none.json").code == 2, "a graph that is not there")
    # Where each mistake was written.
    for option, text, code in (("--other-set", "threshld=3", "W044"), ("--set", "threshld=3", "W044"), ("--other-disable", "glow_upp", "W045")):
        result = run(weft, "bisect", GLOW, "--size", SIZE, option, text)
        report.check(result.code == 2 and [(d["place"], d["code"]) for d in result.diagnostics] == [(f"command line: {option} {text}", code)], f"{option}: {result.code} {result.err}")


def check_new(weft, report, folder):
    result = run(weft, "new", "pass", "mip", "-o", folder / "word")
    report.check(result.code != 0 and result.codes() == ["W012"] and not (folder / "word").exists(), f"a reserved word: {result.code}\n{result.out}{result.err}")
    for graph in (None, "graphs/studio.json", "graphs/deferred.json"):
        here = folder / pathlib.Path(graph or "default").stem
        made = run(weft, "new", "pass", "tint", "-o", here, *(["--graph", graph] if graph else []))
        report.check(made.code == 0 and not made.err, f"{graph}: {made.out}{made.err}")
        files = sorted(str(f.relative_to(here)) for f in here.rglob("*") if f.is_file())
        report.check(files == ["shaders/tint/tint.frag.glsl", "tint.json"], f"{files}")
        done = run(weft, "render", here / "tint.json", "--size", SIZE, "--quiet", "-o", here / "with.png")
        base = run(weft, "render", graph or GLOW, "--size", SIZE, "--quiet", "-o", here / "without.png")
        none = run(weft, "render", here / "tint.json", "--size", SIZE, "--quiet", "--set", "tint.strength=0", "-o", here / "none.png")
        report.check(done.code == base.code == none.code == 0 and not done.err, f"{graph}: {done.err}{base.err}{none.err}")
        if done.code == base.code == none.code == 0:
            pictures = [(here / f"{name}.png").read_bytes() for name in ("with", "without", "none")]
            report.check(pictures[0] != pictures[1] == pictures[2], f"{graph}: the pass does what it says")
    again = run(weft, "new", "pass", "tint", "-o", here)
    report.check(again.code == 1 and "W180" in again.err, f"nothing is written over: {again.code}\n{again.err}")
    mine = folder / "graph"
    made = run(weft, "new", "graph", "glint", "-o", mine)
    checked = run(weft, "check", mine / "glint.json", "--strict")
    report.check(made.code == checked.code == 0 and not checked.err, f"new graph: {made.err}{checked.err}")
    for strength in ("1", "0"):
        run(weft, "render", mine / "glint.json", "--size", SIZE, "--quiet", "--set", f"glint.strength={strength}", "-o", mine / f"{strength}.png")
    report.check((mine / "1.png").read_bytes() != (mine / "0.png").read_bytes(), "new graph: the effect does what it says")
    again = run(weft, "new", "graph", "glint", "-o", mine)
    report.check(again.code == 1 and "W180" in again.err, f"new graph writes over: {again.code}\n{again.err}")
    report.check(run(weft, "new", "graph", "x", "--graph", GLOW, "-o", mine).code == 2, "a new graph extends none")
    for name, code in (("9lives", "W012"), ("sky", "W009")):
        wrong = run(weft, "new", "pass", name, "-o", folder / "wrong")
        report.check(wrong.code == 1 and code in wrong.err and not (folder / "wrong").exists(), f"{name}: {wrong.err}")


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    for check in (check_test, check_defaults, check_mistakes, check_files, check_bisect, check_fuzz, check_new):
        with temporary_folder() as folder:
            check(weft, report, pathlib.Path(folder))
    for command in ("test", "diff", "fuzz"):
        help_ = run(weft, command, "--help")
        report.check(help_.code == 0 and f"Example: weft {command}" in help_.out, help_.out)
    report.check("Example: weft new" in run(weft, "new", "pass", "--help").out, "new pass --help")
    report.end()


main()
