#!/usr/bin/env python3
"""`./run bench --edit GRAPH` prints what an edit costs: a live change builds no plan, by the viewer's own way. Times are reported, never judged."""
import json
import sys

from program import Report, run

COUNTS = ["live_parameters", "live_plans_built", "toggles"]
TIMES = ["live_us", "live_worst_us", "toggle_us", "toggle_worst_us", "save_us"]


def main():
    bench, report = sys.argv[2], Report()
    done = run(bench, "bench", "--edit", "graphs/glow.json", "--size", "64x32", "--scene", "scenes/empty.json")
    if report.check(done.code == 0 and not done.err, f"exit code {done.code}\n{done.err}"):
        found = json.loads(done.out)
        for key in COUNTS + TIMES:
            report.check(isinstance(found.get(key), (int, float)), f"no number '{key}': {found}")
        report.check(found["graph"] == "graphs/glow.json" and found["size"] == [64, 32], f"what was measured: {found}")
        report.check(found["live_parameters"] > 0 and found["toggles"] > 0, f"glow.json has both: {found}")
        report.check(all(found[key] > 0 for key in TIMES), f"times: {found}")
        report.check(found["live_plans_built"] == 0, f"a live change: {found}")
        print(done.out)
    done = run(bench, "bench", "--edit", "graphs/none.json")
    report.check(done.code == 1 and "W001" in done.err, f"a graph that is not there: {done.code} {done.err}")
    done = run(bench, "bench", "--edit", "graphs/glow.json", "--frame", "graphs/glow.json")
    report.check(done.code == 2, f"one of both: {done.code} {done.err}")
    report.end()


main()
