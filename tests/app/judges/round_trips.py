#!/usr/bin/env python3
"""What `weft expand` prints comes to the same plan as the graph it was made of, with nothing disabled, and with each pass, each include and each
last part of a name disabled. It renders the same picture, also of includes with a screen of their own.

    round_trips.py WEFT [--all] [--jobs N]      without --all a sample"""
import argparse
import concurrent.futures
import json
import pathlib
import random
import re
import shutil

from program import TOP, Report, run, temporary_folder

ROOTS = [f"graphs/{name}.json" for name in ("studio", "deferred", "studio_gi", "deferred_gi", "glow", "taa", "daylight", "bench_copy")] + ["tests/golden/vignette.json"]


def plain(name):
    return re.sub(r"[\]@]", "", re.sub(r"[.\[,]", "_", name.replace("#", "_v")))


def gist(plan):
    """Order, barriers and uses, with names as `expand` writes them, and bytes."""
    steps = [(plain(step["pass"]), step["update"], sorted(step["barriers"]), [(use["slot"], use["access"], use["kind"], use["attached"]) for use in step["uses"]])
             for step in plan["steps"]]
    return steps, sorted(plan["final_barriers"]), plan["bytes"]


def main():
    options = argparse.ArgumentParser()
    options.add_argument("weft", type=pathlib.Path)
    options.add_argument("--all", action="store_true")
    options.add_argument("--jobs", type=int, default=2)
    chosen, _ = options.parse_known_args()
    weft, report = chosen.weft.resolve(), Report()

    jobs = []
    for graph in ROOTS:
        plan = json.loads(run(weft, "plan", graph, "--format", "json").out)
        names = {step["pass"].split("[")[0] for step in plan["steps"]} | {entry["pass"].split("[")[0] for entry in plan["culled"]}
        names |= {name.rsplit(".", 1)[-1] for name in names} | {name.rsplit(".", 1)[0] for name in names if "." in name}
        jobs += [(graph, [])] + [(graph, ["--disable", name]) for name in sorted(names)]
    every = len(jobs)
    if not chosen.all:
        jobs = random.Random(1).sample(jobs, 40)

    with temporary_folder() as folder:
        def one(job):
            graph, settings = job
            plan = run(weft, "plan", graph, "--format", "json", *settings)
            if plan.code:
                return "refused", ""
            file = pathlib.Path(folder) / f"{pathlib.Path(graph).stem}{plain(''.join(settings))}.json"
            file.write_text(run(weft, "expand", graph, *settings).out)
            # Shaders are found beside a graph or in Weft's own folder.
            again = run(weft, "plan", file, "--format", "json")
            if again.code:
                return "lost", again.err
            # Nobody reads what it declares; levels are those of the plan, also where a disabled pass used them.
            if any("W089" in line and "levels" not in line for line in again.err.splitlines()):
                return "other", again.err
            first, second = gist(json.loads(plan.out)), gist(json.loads(again.out))
            return ("same", "") if first == second else ("other", next((f"{a} != {b}" for a, b in zip(first[0], second[0]) if a != b), f"{first[1:]} != {second[1:]}"))

        with concurrent.futures.ThreadPoolExecutor(chosen.jobs) as pool:
            results = list(pool.map(one, jobs))
        # The shaders beside a graph go with what is made of it.
        file, original = pathlib.Path(folder) / "upscale.json", TOP / "graphs/cookbook/upscale/upscale.json"
        shutil.copytree(original.parent / "shaders", file.parent / "shaders")
        file.write_text(run(weft, "expand", original, "--size", "96x64").out)
        for graph in (original, file):
            run(weft, "render", graph, "--size", "96x64", "--frames", "2", "-o", f"{file.parent}/{graph is file}.png")
        pictures = [(file.parent / f"{of}.png").read_bytes() for of in (False, True)]
        report.check(pictures[0] == pictures[1], "an include with a screen of its own looks otherwise when it is written out")
    for (graph, settings), (kind, why) in zip(jobs, results):
        report.check(kind in ("same", "refused"), f"{graph} {' '.join(settings)}: {kind}: {why}")
    print(f"{len(jobs)} of {every} trips: " + ", ".join(f"{sum(k == kind for k, _ in results)} {kind}" for kind in ("same", "refused", "lost", "other")))
    report.end()


main()
