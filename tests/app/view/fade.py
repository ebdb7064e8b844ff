#!/usr/bin/env python3
"""Environments that fade in a window: a recording, whose time is counted in frames, shows the old one whole, then a quarter of a
second of steps that only ever get brighter, then the new one whole and nothing more. Idle mode stays awake until a fade is over and sleeps
after it. Waits have generous limits, nothing is timed."""
import os
import pathlib
import re
import sys

from program import TOP, Report, run, temporary_folder
from window import Session, inside_display

FPS = 60
STEPS = 15  # 0.25 s of frames; the last of them is the new environment


def radiance(gray, width=64, height=32):
    """A .hdr of one gray, in bytes: one shared exponent per texel, no run lengths."""
    texel = bytes([gray, gray, gray, 128])
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + texel * (width * height)


def main():
    weft, compare, report = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), Report()
    inside_display(report, weft, compare, __file__)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        (folder / "maps").mkdir()
        (folder / "maps/a_dark.hdr").write_bytes(radiance(40))
        (folder / "maps/b_bright.hdr").write_bytes(radiance(200))
        live = Session(weft, folder, "--no-ui", "--stats", "--fps", FPS, "--environment", folder / "maps/a_dark.hdr",
                       "--preset", TOP / "tests/small_maps.json", size="96x54", data=False, graph=TOP / "graphs/studio.json")

        def mean(picture):
            return float(run(compare, "--describe", picture).out.split()[2])

        def frame_of(shot):
            return int(re.match(r"weft_(\d+)", shot.name).group(1))

        def bytes_of(recorded):
            return [f.read_bytes() for f in sorted((folder / "record_1").glob("f_*.png"))[recorded]]

        try:
            if not report.check(live.open(), f"no window\n{live.said()}"):
                return report.end()
            live.event("environment .*")  # black while the first is on its way
            dark = live.settled()
            if not report.check(dark, f"no first picture\n{live.said()}"):
                return report.end()
            live.act("F10", "record")
            live.until(lambda: (folder / "record_1/f_00003.png").exists())
            live.key("Next")
            done = live.until(lambda: len(last := bytes_of(slice(-4, -1))) == 3 and last[0] != dark.read_bytes() and len(set(last)) == 1)
            live.act("F10", "record")
            bright = live.settled()
            if report.check(done and bright, f"the second environment never comes\n{live.said()}"):
                files = sorted((folder / "record_1").glob("f_*.png"))
                fading = [f for f in files if f.read_bytes() not in (dark.read_bytes(), bright.read_bytes())]
                kinds = "".join("f" if f in fading else "d" if f.read_bytes() == dark.read_bytes() else "b" for f in files)
                report.check(re.fullmatch("d+f+b+", kinds), f"old, fading, new, frame by frame: {kinds}")
                report.check(len(fading) in (STEPS - 1, STEPS), f"{len(fading)} frames of fade")
                means = [mean(f) for f in (dark, *fading, bright)]
                report.check(all(a < b for a, b in zip(means, means[1:])), f"means: {means}")

            report.check(live.rest(live.key("i")), "idle mode never comes to rest")
            before = live.key("Prior")
            report.check(live.event("environment .*a_dark.hdr", before), "the first environment never comes back")
            report.check(live.rest(before), "idle mode does not sleep after a fade")
            end, later = live.shot(), live.shot()
            report.check(end and end.read_bytes() == dark.read_bytes(), "idle mode sleeps before the fade is over")
            report.check(end and later and frame_of(end) == frame_of(later), "frames are drawn at rest")
            live.leave(report)
            report.check('"gl_objects_left": "none"' in live.said() and "W120" not in live.said(), live.said())
        finally:
            live.stop()
    report.end()


main()
