#!/usr/bin/env python3
"""`weft params` and `weft presets`: every parameter with its type, value, range and label, every bundled preset with a line. And `weft explain CODE`.

    lists.py WEFT
"""
import json
import pathlib
import sys

from program import TOP, Report, run

STUDIO = "graphs/studio.json"


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()

    listed = run(weft, "params", STUDIO, "--json")
    report.check(listed.code == 0 and not listed.err, f"params: {listed.code}\n{listed.err}")
    parameters = {p["name"]: p for p in json.loads(listed.out)}
    report.check(len(parameters) > 50, f"{len(parameters)} parameters")
    bloom, exposure, curve = (parameters[f"post.{name}"] for name in ("bloom", "display.exposure", "display.curve"))
    report.check(bloom["type"] == "bool" and bloom["default"] is True and bloom["label"], f"{bloom}")
    report.check((exposure["type"], exposure["min"], exposure["max"]) == ("float", -10, 10), f"{exposure}")
    report.check(curve["type"] == "choice" and "filmic" in curve["choices"] and curve["default"] in curve["choices"], f"{curve}")
    # What is listed can be set, and changes nothing.
    sets = []
    for name, parameter in parameters.items():
        value = parameter["value"]
        if parameter["type"] != "file":
            sets += ["--set", f"{name}={value if isinstance(value, str) else json.dumps(value)}"]
    again = run(weft, "params", STUDIO, "--json", *sets)
    without = [[{key: value for key, value in p.items() if key != "from"} for p in json.loads(out)] for out in (listed.out, again.out)]
    report.check(without[0] == without[1], f"values set to what they are: {again.err}")
    # Where each value was written: the last word counts.
    told = {p["name"]: p["from"] for p in json.loads(run(weft, "params", STUDIO, "--preset", "plain", "--set", "dither=true", "--json").out)}
    report.check((told["post.bloom"], told["post.display.composite.dither"]) == ("preset", "command line"), f"{told}")
    report.check({p["from"] for p in parameters.values()} <= {"default", "file"}, f"{parameters}")

    text = run(weft, "params", STUDIO, "--set", "exposure=1.5", "--preset", "plain")
    rows = {line.split()[0]: line for line in text.out.splitlines()[1:]}
    report.check(set(rows) == set(parameters), f"text and JSON differ: {set(rows) ^ set(parameters)}")
    report.check(rows["post.display.exposure"].split()[1:4] == ["float", "1.5", "command"], rows["post.display.exposure"])
    report.check(rows["post.bloom"].split()[1:3] == ["bool", "false"], rows["post.bloom"])
    report.check("linear | " in rows["post.display.curve"], rows["post.display.curve"])
    broken = run(weft, "params", "tests/bad_graphs/w040_unknown_resource.json")
    report.check(broken.code == 1 and broken.codes() == ["W040"], f"a broken graph: {broken.code}\n{broken.err}")
    missing = run(weft, "params", "no_such.json")
    report.check(missing.code == 1 and missing.codes() == ["W001"], f"no graph: {missing.code}\n{missing.err}")

    files = sorted(p.stem for p in (TOP / "graphs/presets").glob("*.json"))
    presets = json.loads(run(weft, "presets", "--json").out)
    report.check([p["name"] for p in presets] == files, f"presets: {presets}")
    report.check(all(p["title"] and 10 < len(p["description"]) < 140 for p in presets), f"presets: {presets}")
    lines = run(weft, "presets").out.splitlines()
    report.check([line.split()[0] for line in lines] == files, f"presets: {lines}")
    report.check(all(p["description"] in line for p, line in zip(presets, lines)), f"presets: {lines}")

    explained = run(weft, "explain", "w053")
    report.check(explained.code == 0 and explained.out.startswith("W053: ") and "selector" in explained.out and "w053_" in explained.out and "W054" not in explained.out and "```" not in explained.out, f"{explained}")
    for word, said in (("W530", "there is no code W530; did you mean W0"), ("graphs/glow.json", "such as W053")):
        wrong = run(weft, "explain", word)
        report.check(wrong.code == 2 and not wrong.out and said in wrong.err, f"explain {word}: {wrong}")
    report.end()


main()
