#!/usr/bin/env python3
"""Environments that load beside the frames. Headless: the picture depends neither on how long loading took nor on the number
of threads. With --window: black until the first one is there, whole; keys go through the folder in the order of names; a
damaged file keeps the picture and is reported; a file that changes on disk is taken up. Waits have generous limits, nothing is timed.

    environments.py WEFT COMPARE [--window]
"""
import os
import pathlib
import shutil
import subprocess
import sys
import threading
import time

from program import Report, run, temporary_folder

LIMIT = 120  # seconds for anything to happen
GRAPH = "graphs/glow.json"


def radiance(rgb, width=64, height=32):
    """A .hdr of one colour, in bytes: one shared exponent per texel, no run lengths."""
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


class Window:
    def __init__(self, weft, folder, environment):
        self.folder, self.log = folder, folder / "stderr.txt"
        command = [weft, "view", GRAPH, "--size", "160x90", "--no-ui", "--environment", environment]
        with open(self.log, "w") as log:
            self.process = subprocess.Popen([str(c) for c in command], cwd=folder, stderr=log, stdout=subprocess.DEVNULL,
                                            env={**os.environ, "WEFT_DATA": str(folder)})
        self.shots = 0

    def until(self, holds):
        end = time.monotonic() + LIMIT
        while time.monotonic() < end and self.process.poll() is None:
            if found := holds():
                return found
            time.sleep(0.05)
        return None

    def key(self, name):
        subprocess.run(["xdotool", "key", name], capture_output=True)

    def said(self):
        return self.log.read_text(errors="replace")

    def open(self):
        def find():
            found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", "^weft: "], capture_output=True, text=True)
            return found.stdout.split()
        found = self.until(find)
        if found:
            subprocess.run(["xdotool", "mousemove", "--window", found[-1], "80", "45"], capture_output=True)
        return found

    def shot(self):
        before, pressed = set(self.folder.glob("weft_*.png")), 0.0

        def look():
            nonlocal pressed
            if time.monotonic() - pressed > 5:
                pressed = time.monotonic()
                self.key("F12")
            return set(self.folder.glob("weft_*.png")) - before

        found = self.until(look)
        return max(found).read_bytes() if found else b""


def window(weft, compare, folder, report):
    def mean(picture):
        (folder / "shot.png").write_bytes(picture)
        return float(run(compare, "--describe", folder / "shot.png").out.split()[2])

    maps = folder / "maps"
    maps.mkdir()
    red, green, blue = radiance((220, 40, 40)), radiance((40, 220, 40)), radiance((40, 40, 220))
    (maps / "a_red.hdr").write_bytes(red)
    (maps / "b_green.HDR").write_bytes(green)
    (maps / "c_damaged.exr").write_bytes(b"not a picture")
    (maps / "notes.txt").write_text("not an environment")
    os.mkfifo(maps / "z_late.hdr")
    live = Window(weft, folder, maps / "z_late.hdr")
    try:
        if not report.check(live.open(), f"no window\n{live.said()}"):
            return
        report.check(mean(live.shot()) == 0, "the picture is not black while the first environment is on its way")
        waiting = threading.Event()
        threading.Thread(target=feed, args=(maps / "z_late.hdr", halves(radiance((200, 200, 200))),
                                            lambda: waiting.wait(LIMIT)), daemon=True).start()
        report.check(mean(live.shot()) == 0, "half an environment is shown")
        waiting.set()
        grey = live.until(lambda: (s := live.shot()) and mean(s) > 20 and s)
        report.check(grey, f"the first environment never comes\n{live.said()}")

        def goes(what, key, old, wanted=None):
            live.key(key)
            seen = live.until(lambda: (s := live.shot()) and (s == wanted if wanted else s != old) and s)
            report.check(seen, f"{what}: the picture is not what it should be\n{live.said()}")
            return seen or old

        first = goes("Page Down after the last: the first", "Next", grey)
        second = goes("Page Down: the second", "Next", first)
        report.check(mean(first) > 20 and mean(second) > 20, "a map is black")
        live.key("Next")
        report.check(live.until(lambda: "c_damaged.exr: error[W150]" in live.said()), f"a damaged file is not reported\n{live.said()}")
        report.check(live.shot() == second, "a damaged file changes the picture")
        goes("Page Up twice: the first again", "Prior", second, second)
        goes("Page Up twice: the first again", "Prior", second, first)
        (maps / "new.tmp").write_bytes(blue)
        (maps / "new.tmp").rename(maps / "a_red.hdr")
        seen = live.until(lambda: (s := live.shot()) and s not in (first, second, grey) and s)
        report.check(seen, f"a file that changed on disk is not taken up\n{live.said()}")
        live.key("Escape")
        live.until(lambda: False)
        report.check(live.process.poll() == 0, f"Escape: exit code {live.process.poll()}\n{live.said()}")
        report.check("W120" not in live.said(), live.said())
    finally:
        if live.process.poll() is None:
            live.process.kill()
            live.process.wait()


def main():
    weft, compare, report = sys.argv[1], sys.argv[2], Report()
    if "--inside" in sys.argv:  # the virtual display
        with temporary_folder() as name:
            folder = pathlib.Path(name)
            top = pathlib.Path(__file__).resolve().parents[2]
            for part in ("graphs", "shaders", "scenes", "materials"):
                shutil.copytree(top / part, folder / part)
            window(weft, compare, folder, report)
        report.end()
    if "--window" not in sys.argv:
        with temporary_folder() as name:
            headless(weft, pathlib.Path(name), report)
        report.end()
    if not shutil.which("xvfb-run") or not shutil.which("xdotool"):
        report.skip("xvfb-run or xdotool is not installed")
    inside = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1280x1024x24 -noreset", sys.executable, __file__, weft, compare, "--inside"],
                            capture_output=True, text=True)
    report.check(inside.returncode == 0, f"in a window:\n{inside.stdout}{inside.stderr}")
    report.end()


main()
