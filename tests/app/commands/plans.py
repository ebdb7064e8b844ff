#!/usr/bin/env python3
"""`weft explain` and `weft diff`: passes and resources of the bundled graphs can be explained, and a graph differs in nothing from itself.
Buffers fit a storage block of every device, also in large pictures.

    plans.py WEFT
"""
import json
import pathlib
import re
import sys

from program import Report, run

HELMET = ["--scene", "scenes/helmet_alone.json"]
GRAPHS = {"graphs/glow.json": [], "graphs/studio.json": [], "graphs/studio_gi.json": [], "graphs/deferred.json": HELMET, "graphs/deferred_gi.json": HELMET}


def plan_of(weft, graph, *arguments):
    return json.loads(run(weft, "plan", graph, "--format", "json", *arguments).out)


def check_explain(weft, report, graph, arguments):
    plan = plan_of(weft, graph, *arguments)
    names = [step["pass"] for step in plan["steps"]][::9] + [r["name"] for r in plan["resources"]][::17]
    for name in names[::2]:
        told = run(weft, "explain", graph, name, *arguments)
        report.check(told.code == 0 and f" {name}: " in told.out.splitlines()[0], f"explain {name} of {graph}: {told.code}\n{told.out}{told.err}")
    unknown = run(weft, "explain", graph, "no_such_thing", *arguments)
    report.check(unknown.code == 1 and unknown.codes() == ["W045"], f"{unknown.err}")


def check_diff(weft, report):
    same = run(weft, "diff", "graphs/studio.json", "graphs/studio.json")
    report.check(same.code == 0 and not same.out, f"a graph and itself: {same.out}")
    other = run(weft, "diff", "graphs/studio.json", "graphs/studio_gi.json")
    report.check(other.code == 1 and "+ pass " in other.out and "~ bytes allocated" in other.out, other.out)
    plans = [plan_of(weft, f"graphs/{name}.json") for name in ("studio", "studio_gi")]
    passes = [{step["pass"] for step in plan["steps"]} for plan in plans]
    told = {m.group(2): m.group(1) for m in re.finditer(r"^([+-]) pass (\S+):", other.out, re.M)}
    report.check({n for n, sign in told.items() if sign == "+"} == passes[1] - passes[0], other.out)
    report.check({n for n, sign in told.items() if sign == "-"} == passes[0] - passes[1], other.out)
    bytes_told = re.search(r"~ bytes allocated: (\d+) before, now (\d+)", other.out)
    report.check(bytes_told and [int(b) for b in bytes_told.groups()] == [plan["bytes"]["allocated"] for plan in plans], other.out)
    broken = run(weft, "diff", "graphs/studio.json", "tests/bad_graphs/w040_unknown_resource.json")
    report.check(broken.code == 2 and broken.codes() == ["W040"], f"{broken.code}\n{broken.err}")


LEAST_BLOCK = 1 << 27  # bytes: what GL_MAX_SHADER_STORAGE_BLOCK_SIZE is at least (OpenGL 4.5, Implementation Dependent Values)


def check_buffers(weft, report):
    """The lists of highlights grow with the picture, and the most where discs, and so tiles, are small."""
    for size in ("3840x2160", "7680x4320", "8192x8192"):
        for radius in (8, 9, 13, 32):
            settings = ["--size", size, "--set", "dof=true", "--set", f"largest_bokeh={radius}"]
            plan = plan_of(weft, "graphs/studio.json", *settings)
            buffers = {r["name"]: r["bytes"] for r in plan["resources"] if "offset" in r}
            report.check("post.dof.highlights" in buffers and max(buffers.values()) <= LEAST_BLOCK, f"{settings}: {buffers}")


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    for graph, arguments in GRAPHS.items():
        check_explain(weft, report, graph, arguments)
    check_diff(weft, report)
    check_buffers(weft, report)
    report.end()


main()
