#!/usr/bin/env python3
"""5,000 frames of the whole studio in a tiny window that is resized all the time: resident memory after the first fifth and at the
end must be the same but for BOUND, and no GL object is left."""
import os
import pathlib
import re
import sys

from program import TOP, Report, temporary_folder
from window import Session, inside_display

FRAMES = 5000
# A plan, its programs and textures at these sizes take about 3 MiB: two of them forgotten would show, and several hundred
# are made. Allocators need some room: runs without a leak move by up to 3 MiB either way.
BOUND = 6 << 20
SIZES = ((96, 64), (64, 48), (112, 80), (48, 96), (80, 80))


def resident(process):
    pages = int(pathlib.Path(f"/proc/{process.pid}/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def main():
    weft, compare, report = os.path.abspath(sys.argv[1]), sys.argv[2], Report()
    inside_display(report, weft, compare, __file__)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        live = Session(weft, folder, "--no-vsync", "--stats", "--max-frames", FRAMES, size="96x64", data=False,
                       graph=str(TOP / "graphs/studio.json"))
        samples, resizes = [], 0
        try:
            live.open()
            while live.alive():
                for width, height in SIZES:
                    resizes += bool(live.resize(width, height))  # waits until it is taken
                if live.alive():
                    samples.append(resident(live.process))
        finally:
            live.stop()
        frames = re.search(r'"frames": (\d+)', live.said())
        report.check(live.process.returncode == 0, f"exit code {live.process.returncode}\n{live.said()}")
        report.check(frames and int(frames.group(1)) == FRAMES, f"frames: {frames}\n{live.said()}")
        report.check('"gl_objects_left": "none"' in live.said(), live.said())
        if report.check(len(samples) >= 10, f"only {len(samples)} samples"):
            warm, end = max(samples[len(samples) // 5:len(samples) * 2 // 5]), max(samples[-(len(samples) // 5):])
            print(f"{FRAMES} frames, {resizes} resizes: {warm / 2**20:.1f} MiB after the first fifth, {end / 2**20:.1f} MiB at the end")
            report.check(end - warm < BOUND, f"grows by {(end - warm) / 2**20:.1f} MiB: {[s >> 10 for s in samples]}")
    report.end()


main()
