#!/usr/bin/env python3
"""`weft bench --workload` on the workload files of tests/graph/workloads: storage equals its lower bound and the known sums,
nothing is culled that is needed. Times are reported, never judged."""
import gzip
import json
import pathlib
import sys

from program import TOP, Report, run, temporary_folder

# Passes that are kept, and bytes that they need at least, by hand from their lifetimes.
KNOWN = {"layered_100.json": (76, 132470528), "layered_1000.json": (910, 208740864), "layered_10000.json": (9330, 304857856)}
KEYS = ["passes_kept", "read_ns_per_pass", "validate_ns_per_pass", "compile_ns_per_pass", "barriers", "bytes_declared",
        "bytes_allocated", "bytes_lower_bound", "nlohmann_parse_ns_per_pass"]


def check(report, name, result):
    for key in KEYS:
        report.check(isinstance(result.get(key), (int, float)), f"{name}: no number '{key}'")
    report.check(result["bytes_allocated"] == result["bytes_lower_bound"],
                 f"{name}: {result['bytes_allocated']} bytes where {result['bytes_lower_bound']} would do")
    report.check(0 < result["bytes_allocated"] <= result["bytes_declared"], f"{name}: bytes out of order")
    report.check(result["passes_kept"] > 0, f"{name}: nothing kept")


def unpacked(folder):
    """The workload files; the large ones are kept packed."""
    kept = TOP / "tests/graph/workloads"
    for path in kept.glob("*.json.gz"):
        (folder / path.stem).write_bytes(gzip.decompress(path.read_bytes()))
    return sorted([*kept.glob("*.json"), *folder.glob("*.json")], key=lambda path: path.name)


def main():
    weft, report = sys.argv[1], Report()
    with temporary_folder() as name:
        files = unpacked(pathlib.Path(name))
        report.check(len(files) == 9, f"{len(files)} workloads, expected 9")
        check_files(weft, files, report)
    report.end()


def check_files(weft, files, report):
    for path in files:
        done = run(weft, "bench", "--workload", path)
        if not report.check(done.code == 0 and not done.err, f"{path.name}: exit code {done.code}\n{done.err}"):
            continue
        result = json.loads(done.out)
        check(report, path.name, result)
        report.check(result["barriers"] == 0, f"{path.name}: {result['barriers']} barriers between raster passes")
        if path.name in KNOWN:
            found = result["passes_kept"], result["bytes_allocated"]
            report.check(found == KNOWN[path.name], f"{path.name}: passes and bytes {found}, not {KNOWN[path.name]}")
        compute = result.get("compute")
        if report.check(isinstance(compute, dict), f"{path.name}: no compute form"):
            report.check(compute["barriers"] > 0, f"{path.name}: no barrier between compute passes")
            report.check(compute["bytes_allocated"] == compute["bytes_lower_bound"], f"{path.name}, compute: bytes above the bound")


main()
