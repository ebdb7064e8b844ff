#!/usr/bin/env python3
"""`weft view` in a window of a virtual display: five frames, a screenshot that is a picture, exit code 0. Without a
display it says so instead."""
import os
import pathlib
import shutil
import sys

from program import Report, run, temporary_folder


def main():
    weft, compare, report = sys.argv[1], sys.argv[2], Report()
    bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    without = run(weft, "view", "graphs/glow.json", "--max-frames", "1", "--program-cache", "none", env=bare)
    report.check(without.code == 3 and without.codes() == ["W110"], f"without a display: {without.code}\n{without.err}")
    if not shutil.which("xvfb-run"):
        report.skip("xvfb-run is not installed")
        report.end()
    xvfb = ["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset"]
    with temporary_folder() as name:
        for graph in ("studio", "glow"):
            shot = pathlib.Path(name) / f"{graph}.png"
            done = run(weft, "view", f"graphs/{graph}.json", "--size", "640x360", "--max-frames", "5", "--screenshot", shot,
                       "--program-cache", "none", before=xvfb)
            report.check(done.code == 0, f"{graph}: exit code {done.code}\n{done.err}")
            report.check(not done.diagnostics, f"{graph}: {done.err}")
            if not report.check(shot.exists(), f"{graph}: no screenshot"):
                continue
            mean = run(compare, "--describe", shot)
            words = mean.out.split()
            report.check(mean.code == 0 and words[:2] == ["640", "360"], f"{graph}: {mean.out}{mean.err}")
            report.check(20 < float(words[2]) < 235 and float(words[3]) > 10, f"{graph}: mean and spread {words[2:]}")
    report.end()


main()
