#!/usr/bin/env python3
"""The whole studio in a tiny window that is resized 300 times: resident memory after the first fifth and at the end must be the same but for
BOUND, and no GL object is left."""
import os
import pathlib
import re
import sys

from program import TOP, Report, temporary_folder
from window import Session, inside_display

ROUNDS = 60
# A plan, its programs and textures at these sizes take about 3 MiB: two of them forgotten would show, and several hundred
# are made. Allocators need some room: runs without a leak move by up to 3 MiB either way.
BOUND = 6 << 20
SIZES = ((96, 64), (64, 48), (112, 80), (48, 96), (80, 80))  # none is the first size of the window: a window that has its size says nothing


def resident(process):
    pages = int(pathlib.Path(f"/proc/{process.pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def main():
    weft, compare, report = os.path.abspath(sys.argv[1]), sys.argv[2], Report()
    inside_display(report, weft, compare, __file__)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        live = Session(weft, folder, "--no-vsync", "--stats", size="128x96", data=False,
                       graph=str(TOP / "graphs/studio.json"))
        samples, resizes = [], 0
        try:
            report.check(live.open(), f"no window\n{live.said()}")
            while live.alive() and len(samples) < ROUNDS:
                for width, height in SIZES:
                    resizes += bool(live.resize(width, height))  # waits until it is taken
                if live.alive():
                    samples.append(resident(live.process))
            live.leave(report)
        finally:
            live.stop()
        frames = re.search(r'"frames": (\d+)', live.said())
        report.check(resizes == ROUNDS * len(SIZES) and frames and int(frames.group(1)) >= resizes, f"{resizes} resizes, frames: {frames}\n{live.said()}")
        report.check('"gl_objects_left": "none"' in live.said(), live.said())
        if report.check(len(samples) == ROUNDS, f"only {len(samples)} samples"):
            warm, end = max(samples[len(samples) // 5:len(samples) * 2 // 5]), max(samples[-(len(samples) // 5):])
            print(f"{frames.group(1)} frames, {resizes} resizes: {warm / 2**20:.1f} MiB after the first fifth, {end / 2**20:.1f} MiB at the end")
            report.check(end - warm < BOUND, f"grows by {(end - warm) / 2**20:.1f} MiB: {[s >> 10 for s in samples]}")
    report.end()


main()
