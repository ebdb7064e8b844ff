#!/usr/bin/env python3
"""--trace writes what Perfetto opens: a JSON object with the frames and the passes that ran, on a CPU and a GPU row, with
names for the rows and counters; nothing overlaps within a row but a frame and its passes; the picture stays the same."""
import json
import pathlib
import sys

from program import Report, run, temporary_folder

FRAMES = 4


def spans(events, row, category):
    return [e for e in events if e.get("ph") == "X" and e["tid"] == row and e["cat"] == category]


def check_trace(report, path, steps):
    trace = json.loads(path.read_text())
    events = trace["traceEvents"]
    report.check(trace["displayTimeUnit"] == "ms", "displayTimeUnit")
    names = {(e["name"], e["tid"]): e["args"]["name"] for e in events if e["ph"] == "M"}
    report.check(names.get(("process_name", 1)) == "weft", f"names: {names}")
    report.check("CPU" in names.get(("thread_name", 1), "") and names.get(("thread_name", 2)) == "GPU", f"names: {names}")
    report.check(all(e["pid"] == 1 and e["ph"] in "MXC" for e in events), "phases")
    report.check(all(e["ts"] >= 0 and e["dur"] >= 0 for e in events if e["ph"] == "X"), "negative times")
    frames = spans(events, 1, "frame")
    report.check([f["args"]["frame"] for f in frames] == list(range(FRAMES)), f"frames: {[f['args'] for f in frames]}")
    for earlier, later in zip(frames, frames[1:]):
        report.check(earlier["ts"] + earlier["dur"] <= later["ts"] + 0.01, "frames overlap")
    for frame in frames:
        number = frame["args"]["frame"]
        for row in (1, 2):
            passes = [p for p in spans(events, row, "pass") if p["args"]["frame"] == number]
            report.check(len(passes) == frame["args"]["passes_run"], f"frame {number}, row {row}: {len(passes)} passes")
            report.check(all(steps[p["args"]["step"]] == p["name"] for p in passes), f"frame {number}: names of passes")
            starts = [p["ts"] for p in passes]
            report.check(starts == sorted(starts), f"frame {number}, row {row}: not in order")
            for p in passes:
                inside = p["ts"] >= frame["ts"] - 0.01 and (row == 2 or p["ts"] + p["dur"] <= frame["ts"] + frame["dur"] + 0.01)
                report.check(inside, f"frame {number}: {p['name']} lies outside of it")
    counters = {e["name"] for e in events if e["ph"] == "C"}
    report.check(counters == {"frame time (ms)", "passes", "storage (bytes)"}, f"counters: {counters}")
    report.check(sum(e["ph"] == "C" for e in events) == 3 * FRAMES, "a counter per frame")


def main():
    weft, report = sys.argv[1], Report()
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        common = ["render", "graphs/glow.json", "--size", "64x36", "--frames", f"0:{FRAMES - 1}", "--quiet", "--program-cache", "none"]
        plan = run(weft, "plan", "graphs/glow.json", "--size", "64x36", "--format", "json")
        steps = [step["pass"] for step in json.loads(plan.out)["steps"]]
        path = folder / "trace.json"
        traced = run(weft, *common, "-o", folder / "a_%d.png", "--trace", path)
        if report.check(traced.code == 0 and path.exists(), f"exit code {traced.code}\n{traced.err}"):
            check_trace(report, path, steps)
        longest = folder / ("t" * 250 + ".json")
        long = run(weft, *common, "-o", folder / "d_%d.png", "--trace", longest)
        if report.check(long.code == 0 and longest.exists(), f"a name of 255 bytes: {long.code}\n{long.err}"):
            check_trace(report, longest, steps)
        left = [file.name for file in folder.iterdir() if file.suffix not in (".json", ".png")]
        report.check(not left, f"temporary files are left: {left}")
        plain = run(weft, *common, "-o", folder / "b_%d.png")
        same = plain.code == 0 and all((folder / f"a_{i}.png").read_bytes() == (folder / f"b_{i}.png").read_bytes() for i in range(FRAMES))
        report.check(same, "the trace changes the picture")
        refused = run(weft, *common, "-o", folder / "c_%d.png", "--trace", folder / "no/such/trace.json")
        report.check(refused.code == 1 and refused.codes() == ["W180"], f"a trace that cannot be written: {refused.code} {refused.err}")
    report.end()


main()
