#!/usr/bin/env python3
"""Environments that load beside the frames. Headless: the picture depends neither on how long loading took nor on the number
of threads. With --window: black until the first one is there, whole; keys go through the folder in the order of names; a
damaged file keeps the picture and is reported; a file that changes on disk is taken up. Waits have generous limits, nothing is timed.

    environments.py WEFT COMPARE [--window]
"""
import os
import pathlib
import sys
import threading
import time

from program import Report, run, temporary_folder
from window import Session, copy_of_tree, inside_display

GRAPH = "graphs/glow.json"


def radiance(rgb, width=64, height=32):
    """A .hdr of one color, in bytes: one shared exponent per texel, no run lengths."""
    texel = bytes([*rgb, 128])
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + texel * (width * height)


def feed(pipe, portions, between=lambda: None):
    """Writes a named pipe in portions; opening it waits for the reader."""
    with open(pipe, "wb", buffering=0) as out:
        for portion in portions:
            out.write(portion)
            between()


def halves(data):
    return data[: len(data) // 2], data[len(data) // 2 :]


def headless(weft, folder, report):
    data = radiance((40, 90, 200))
    (folder / "file.hdr").write_bytes(data)
    pictures = {}
    for threads in ("0", "1", "2"):
        for slow in (False, True):
            name = folder / "file.hdr"
            if slow:
                name = folder / f"pipe{threads}.hdr"
                os.mkfifo(name)
                threading.Thread(target=feed, args=(name, halves(data), lambda: time.sleep(0.2)), daemon=True).start()
            output = folder / f"f{threads}{slow}_%d.png"
            done = run(weft, "render", "graphs/studio.json", "--environment", name, "--size", "96x54", "--frames", "0:2", "--quiet",
                       "--wait-for-assets", "-o", output, env={**os.environ, "LP_NUM_THREADS": threads})
            report.check(done.code == 0, f"{threads} threads, slow {slow}: {done.code}\n{done.err}")
            files = [folder / f"f{threads}{slow}_{frame}.png" for frame in range(3)]
            pictures[threads, slow] = [f.read_bytes() if f.exists() else b"" for f in files]
    first = pictures["0", False]
    report.check(all(first), "a frame is missing")
    for how, frames in pictures.items():
        report.check(frames == first, f"threads and slow loading {how}: other pixels")
    refused = run(weft, "render", GRAPH, "--environment", folder, "-o", folder / "no.png")
    report.check(refused.code == 1 and refused.codes() == ["W150"], f"a folder without a window: {refused.code}\n{refused.err}")


def window(weft, compare, folder, report):
    def mean(picture):
        return float(run(compare, "--describe", picture).out.split()[2])

    maps = folder / "maps"
    maps.mkdir()
    red, green, blue = radiance((220, 40, 40)), radiance((40, 220, 40)), radiance((40, 40, 220))
    (maps / "a_red.hdr").write_bytes(red)
    (maps / "b_green.HDR").write_bytes(green)
    (maps / "c_damaged.exr").write_bytes(b"not a picture")
    (maps / "notes.txt").write_text("not an environment")
    # A file that comes late: a pipe without a name in any folder, so that writing it is no change of a watched file.
    reads, writes = os.pipe()
    (maps / "z_late.hdr").symlink_to(f"/proc/{os.getpid()}/fd/{reads}")
    begin, end = halves(radiance((200, 200, 200)))
    live = Session(weft, folder, "--no-ui", "--environment", maps / "z_late.hdr", graph=GRAPH, size="160x90")
    try:
        if not report.check(live.open(80, 45), f"no window\n{live.said()}"):
            return
        report.check(mean(live.shot()) == 0, "the picture is not black while the first environment is on its way")
        before = live.mark()
        os.write(writes, begin)
        report.check(mean(live.shot()) == 0, "half an environment is shown")
        os.write(writes, end)
        os.close(writes)
        report.check(live.event("environment .*z_late.hdr", before), f"the first environment never comes\n{live.said()}")
        gray = live.settled()
        report.check(mean(gray) > 20, "the first environment is black")

        def goes(what, key, name, old, wanted=None):
            shown = live.event(f"environment .*{name}", live.key(key))
            seen = live.settled()
            good = shown and seen and (seen.read_bytes() == wanted.read_bytes() if wanted else seen.read_bytes() != old.read_bytes())
            report.check(good, f"{what}: the picture is not what it should be\n{live.said()}")
            return seen or old

        first = goes("Page Down after the last: the first", "Next", "a_red.hdr", gray)
        second = goes("Page Down: the second", "Next", "b_green.HDR", first)
        report.check(mean(first) > 20 and mean(second) > 20, "a map is black")
        # A damaged file ends its request too, and the one before stays.
        kept = goes("Page Down: a damaged file", "Next", "b_green.HDR", second, second)
        report.check("c_damaged.exr: error[W150]" in live.said(), f"a damaged file is not reported\n{live.said()}")
        goes("Page Up twice: the first again", "Prior", "b_green.HDR", kept, second)
        goes("Page Up twice: the first again", "Prior", "a_red.hdr", second, first)
        before = live.mark()
        (maps / "new.tmp").write_bytes(blue)
        (maps / "new.tmp").rename(maps / "a_red.hdr")
        report.check(live.event("environment .*a_red.hdr", before), f"a file that changed on disk is not taken up\n{live.said()}")
        seen = live.settled()
        report.check(seen and seen.read_bytes() not in [s.read_bytes() for s in (first, second, gray)], "a file that changed on disk does not show")
        live.leave(report)
        report.check("W120" not in live.said(), live.said())
    finally:
        live.stop()


def main():
    weft, compare, report = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), Report()
    if "--window" not in sys.argv:
        with temporary_folder() as name:
            headless(weft, pathlib.Path(name), report)
        report.end()
    inside_display(report, weft, compare, __file__)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        copy_of_tree(folder)
        window(weft, compare, folder, report)
    report.end()


main()
