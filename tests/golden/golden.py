#!/usr/bin/env python3
"""Golden pictures and plans of manifest.json, rendered anew and compared with the committed files.

    golden.py WEFT COMPARE OUT            compare; exit 1 when something moved, with what was made left in OUT
    golden.py WEFT COMPARE OUT --update   write the goldens: the only thing that does

Pictures may differ by `tolerance.step` of 255 in `tolerance.fraction` of their pixels, so that another build of Mesa
passes; on one build they are equal to the byte. Plans are text and must be equal.
Also holds the proof of the vignette example: one stanza and one GLSL file more than graphs/glow.json.
"""
import difflib
import json
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]


def command(weft, verb, entry):
    line = [weft, verb, entry["graph"], "--size", entry["size"]]
    for name, value in entry.get("sets", {}).items():
        line += ["--set", f"{name}={value}"]
    for name in entry.get("disables", []):
        line += ["--disable", name]
    for name in entry.get("presets", []):
        line += ["--preset", name]
    if entry.get("scene"):
        line += ["--scene", entry["scene"]]
    if entry.get("camera"):
        line += ["--camera", entry["camera"]]
    if entry.get("environment"):
        line += ["--environment", entry["environment"]]
    return line


def execute(line):
    return subprocess.run(list(map(str, line)), cwd=TOP, capture_output=True, text=True)


def check_picture(weft, compare, out, entry, tolerance, update):
    golden, actual = HERE / entry["image"], out / entry["image"]
    made = HERE / entry["image"] if update else actual
    made.unlink(missing_ok=True)
    done = execute([*command(weft, "render", entry), "--frames", entry["frame"], "--quiet", "--program-cache", out / "programs", "-o", made])
    if done.returncode or done.stderr:
        return f"exit code {done.returncode}\n{done.stderr}"
    if update:
        return None
    if not golden.exists():
        return f"there is no {golden}: look at {actual}, then run golden.py with --update"
    difference = out / ("difference_" + entry["image"])
    allowed = entry.get("tolerance", tolerance)
    found = execute([compare, actual, golden, allowed["step"], allowed["fraction"], difference])
    if found.returncode:
        return f"{found.stdout}{found.stderr}actual: {actual}\ndifference, 16 times as bright: {difference}"
    for leftover in (actual, difference):
        leftover.unlink(missing_ok=True)
    return None


def check_plan(weft, out, entry, update):
    golden, actual = HERE / entry["text"], out / entry["text"]
    done = execute(command(weft, "plan", entry))
    if done.returncode:
        return f"exit code {done.returncode}\n{done.stderr}"
    if update:
        golden.write_text(done.stdout)
        return None
    expected = golden.read_text() if golden.exists() else ""
    if done.stdout == expected:
        actual.unlink(missing_ok=True)
        return None
    actual.write_text(done.stdout)
    lines = difflib.unified_diff(expected.splitlines(), done.stdout.splitlines(), str(golden), str(actual), lineterm="")
    return "\n".join(list(lines)[:60])


def read_graph(path):
    return json.loads(re.sub(r"^\s*//.*$", "", path.read_text(), flags=re.M))


def check_vignette():
    """tests/golden/vignette.json is graphs/glow.json with one stanza more, whose shader is the only one beside it."""
    base, example = read_graph(TOP / "graphs/glow.json"), read_graph(HERE / "vignette.json")
    for graph in (base, example):
        graph.pop("name"), graph.pop("$schema")
    added = [stanza for stanza in example["passes"] if stanza not in base["passes"]]
    if len(added) != 1:
        return f"{len(added)} stanzas differ from graphs/glow.json"
    example["passes"].remove(added[0])
    if example != base:
        return "without its stanza it is not graphs/glow.json"
    files = [str(f.relative_to(HERE / "shaders")) for f in (HERE / "shaders").rglob("*") if f.is_file()]
    if files != [added[0]["shader"]]:
        return f"its shaders are {files}, its stanza names {added[0]['shader']}"
    if (TOP / "shaders" / added[0]["shader"]).exists():
        return "its shader is a bundled one"
    return None


def main():
    weft, compare, out = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    update = "--update" in sys.argv[4:]
    out.mkdir(parents=True, exist_ok=True)
    manifest = json.loads((HERE / "manifest.json").read_text())
    failures = []

    def say(name, problem):
        print(f"{'FAILED' if problem else 'written' if update else 'ok':8}{name}", flush=True)
        if problem:
            print(problem)
            failures.append(name)

    say("vignette.json is one stanza and one GLSL file", check_vignette())
    for entry in manifest["plans"]:
        say(entry["text"], check_plan(weft, out, entry, update))
    for entry in manifest["pictures"]:
        say(entry["image"], check_picture(weft, compare, out, entry, manifest["tolerance"], update))
    named = {e["image"] for e in manifest["pictures"]} | {e["text"] for e in manifest["plans"]}
    stray = sorted(f.name for f in HERE.iterdir() if f.suffix in (".png", ".txt") and f.name not in named | {"CMakeLists.txt"})
    if stray:
        say("no files without an entry: " + ", ".join(stray), "remove them or give them entries")
    size = sum(f.stat().st_size for f in HERE.rglob("*") if f.is_file())
    if size > 1_500_000:
        say("size", f"{size} bytes of goldens: above 1.5 MB")
    sys.exit(1 if failures else 0)


main()
