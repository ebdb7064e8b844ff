#!/usr/bin/env python3
"""The CPU's work for a frame: `weft dot --tasks` prints it as a graph that Graphviz takes, with the tables that each task reads and
writes, and `weft bench --tasks` measures it on one thread and on two, which make the same bytes. Times are reported, never judged."""
import json
import re
import shutil
import subprocess
import sys

from program import Report, run

FOX = "scenes/fox.json"
# Some of what each task works on, (reads, writes); and tasks of which the second waits for the first, at once or over others.
TABLES = {"animation": ({"animations"}, {"locals"}), "transforms": ({"nodes", "locals"}, {"world"}),
          "joints": ({"skins", "world"}, {"joints"}), "rows": ({"world", "joints"}, {"rows", "boxes"}),
          "views": ({"cameras", "scene box"}, {"views"}), "culling": ({"views", "boxes"}, {"visible rows"}), "sort keys": ({"boxes", "visible rows"}, {"keys"}),
          "draw order": ({"keys"}, {"visible rows"}), "commands": ({"rows", "visible rows"}, {"commands"}),
          "lights": ({"lights", "world"}, {"lights in the world"}), "probes": ({"sphere rows", "probe grid"}, {"probes"}),
          "decoding": ({"image files"}, {"texels"}), "contents": ({"texels"}, {"contents"})}
WAITS = [("animation", "transforms"), ("transforms", "rows"), ("rows", "scene box"), ("transforms", "lights"), ("lights", "views"), ("scene box", "views"), ("views", "culling"), ("culling", "sort keys"),
         ("sort keys", "draw order"), ("draw order", "commands"), ("probe grid", "probes"), ("decoding", "contents")]
FREE = [("transforms", "transforms before"), ("animation before", "animation"), ("commands", "probes")]


def drawing(weft, report):
    done = run(weft, "dot", "--tasks", "--scene", FOX)
    report.check(done.code == 0 and not done.err, f"dot --tasks: {done.code}\n{done.err}")
    report.check(run(weft, "dot", "--tasks", "--scene", FOX).out == done.out, "dot --tasks prints another graph the second time")
    parsed = subprocess.run(["dot", "-Tjson0"], input=done.out, capture_output=True, text=True)
    if not report.check(parsed.returncode == 0 and not parsed.stderr, f"Graphviz does not take it: {parsed.stderr}\n{done.out}"):
        return
    graph = json.loads(parsed.stdout)
    report.check("fox.json" in graph["label"] and re.search(r"\b1 animations, 1 skins", graph["label"]), f"title: {graph['label']}")
    nodes = {each["_gvid"]: each["label"].split("\\n") for each in graph["objects"] if re.fullmatch(r"t\d+", each["name"])}
    tasks = {}
    for lines in nodes.values():
        tables = [set(line.split(" ", 1)[1].split(", ")) if " " in line else set() for line in lines[1:]]
        report.check(len(lines) == 3 and lines[1].startswith("reads") and lines[2].startswith("writes"), f"a task: {lines}")
        tasks[lines[0]] = tables
    for name, (reads, writes) in TABLES.items():
        if report.check(name in tasks, f"no task '{name}' in {sorted(tasks)}"):
            report.check(reads <= tasks[name][0] and writes <= tasks[name][1], f"{name}: {tasks[name]}")
    after = {name: set() for name in tasks}
    for edge in graph["edges"]:
        first, second = (nodes[edge[end]][0] for end in ("tail", "head"))
        after[first].add(second)
        # Each edge names tables that one of the two writes.
        waited = set(edge["label"].split("\\n"))
        report.check(waited and waited <= tasks[first][1] | tasks[second][1], f"{first} -> {second}: {waited}")

    def reaches(first, second):
        return second in after[first] or any(reaches(each, second) for each in after[first])

    for first, second in WAITS:
        report.check(reaches(first, second), f"'{second}' does not wait for '{first}'")
    for first, second in FREE:
        report.check(not reaches(first, second), f"'{second}' waits for '{first}'")


def wrong_words(weft, report):
    for words, said in ((["dot"], "graph"), (["dot", "--tasks", "graphs/glow.json"], "--tasks"), (["bench", "--tasks", "--frame", "graphs/glow.json"], "--tasks")):
        done = run(weft, *words)
        report.check(done.code == 2 and said in done.err and not done.out, f"{words}: {done.code}\n{done.err}")
    missing = run(weft, "dot", "--tasks", "--scene", "no_such.json")
    report.check(missing.code == 1 and missing.codes() == ["W001"] and not missing.out, f"no scene: {missing.code}\n{missing.err}")
    missing = run(weft, "bench", "--tasks", "--scene", "no_such.json")
    report.check(missing.code == 1 and missing.codes() == ["W001"] and not missing.out, f"no scene: {missing.code}\n{missing.err}")


def bench(weft, report, scene, instances, visible):
    done = run(weft, "bench", "--tasks", *scene)
    if not report.check(done.code == 0 and not done.err, f"bench --tasks: {done.code}\n{done.err}"):
        return
    measured = json.loads(done.out)
    report.check(measured["instances"] == instances and measured["moving_nodes"] > 0, f"{measured}")
    report.check(measured["same_bytes"] is True, "two threads make other bytes than one")
    report.check([view["visible"] >= visible for view in measured["views"]] == [True] * 3, f"{measured['views']}")
    report.check([each["threads"] for each in measured["runs"]] == [1, 2], f"{measured['runs']}")
    for each in measured["runs"]:
        report.check(each["frame_us"] > 0 and each["cpu_us"] > 0, f"{each}")
        stages = [stage["stage"] for stage in each["stages"]]
        report.check({"animation", "transforms", "rows", "culling", "sort keys", "draw order", "commands"} <= set(stages), f"{stages}")
        report.check(all(stage["us"] >= 0 and stage["cpu_us"] >= 0 for stage in each["stages"]), f"{each}")


def main():
    weft, report = sys.argv[1], Report()
    if not shutil.which("dot"):
        report.skip("graphviz is not installed")
    drawing(weft, report)
    wrong_words(weft, report)
    bench(weft, report, ["--scene", FOX], 1, 1)
    bench(weft, report, [], 100000, 1000)
    report.end()


main()
