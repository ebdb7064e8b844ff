#!/usr/bin/env python3
"""--stats prints the outputs of the last frame: as many numbers as they hold, whole ones as such, by their full names, and
none that are off. Asking for them changes no picture."""
import json
import sys

from program import Report, run, temporary_folder

GRAPH = "tests/runtime/graphs/outputs.json"
POST = "tests/runtime/graphs/toggle.json"


def main():
    weft = sys.argv[1]
    report = Report()
    with temporary_folder() as folder:
        def outputs(graph, *more):
            done = run(weft, "render", graph, "--size", "16x16", "--scene", "scenes/empty.json", "--quiet", "--stats", *more)
            report.check(done.code == 0, f"{graph} {more}: {done.err}")
            return json.loads(done.err)["outputs"]

        found = outputs(GRAPH, "--frames", "4", "--set", "amount=3", "-o", f"{folder}/a.png")
        report.check(list(found) == ["sum", "counts", "field", "shown", "before"], f"names: {list(found)}")
        report.check(found["sum"] == [5, 10, 3, 0] and found["before"] == [4, 8, 3, 0], f"sum: {found['sum']}")
        report.check(found["counts"] == [5, 6, 7, 8] and found["field"] == [0, 1, 2, -10, -9, -8], f"whole: {found}")
        report.check(all(isinstance(n, int) for n in found["counts"] + found["field"]), "whole numbers print as such")
        report.check(found["shown"] == [3] * (16 * 16 * 4), "a texture's texels")
        found = outputs(GRAPH, "--set", "whole=false", "-o", f"{folder}/b.png")
        report.check("field" not in found and found["sum"] == [1, 2, 1, 0], f"field is off: {found}")

        report.check(outputs(POST, "-o", f"{folder}/off.png") == {}, "post.json has none when all is off")
        found = outputs(POST, "--set", "auto_exposure=true", "-o", f"{folder}/auto.png")
        report.check(list(found) == ["post.exposure", "post.histogram"], f"names: {list(found)}")
        factor, target, mean, _ = found["post.exposure"]
        # the first frame is adapted at once; cleared to (0.5, 0.25, 0.125): luminance 0.294, to be brought to 0.18
        report.check(factor == target and abs(mean - 0.294) < 0.01 and abs(factor - 0.18 / mean) < 1e-3, f"exposure: {found['post.exposure']}")
        report.check(sum(found["post.histogram"]) == 4 * 4 * 64, "a sample in 4 x 4 texels, 64 each")
        found = outputs(POST, "--set", "histogram=true", "-o", f"{folder}/histogram.png")
        report.check(list(found) == ["post.histogram"], f"names: {list(found)}")
        same = open(f"{folder}/off.png", "rb").read() == open(f"{folder}/histogram.png", "rb").read()
        report.check(same, "the histogram changes the picture")
    report.end()


main()
