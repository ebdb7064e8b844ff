"""Driving `weft view` in a window of a virtual display with xdotool: keys, drags, screenshots; waits have generous limits and
nothing is timed. inside_display() runs a test's script again under xvfb-run."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

from program import TOP

LIMIT = 120  # seconds for anything to happen


class Session:
    def __init__(self, weft, folder, *arguments, graph="graphs/studio.json", size="320x180", data=True):
        self.folder, self.log = folder, folder / "stderr.txt"
        environment = {**os.environ, **({"WEFT_DATA": str(folder)} if data else {})}
        command = [weft, "view", graph, "--size", size, "--program-cache", "none", *map(str, arguments)]
        with open(self.log, "w") as log:
            self.process = subprocess.Popen(command, cwd=folder, env=environment, stderr=log, stdout=subprocess.DEVNULL)
        self.window = None

    def said(self):
        return self.log.read_text(errors="replace")

    def alive(self):
        return self.process.poll() is None

    def until(self, holds):
        """The first thing true of `holds`; None when time is up or the program has ended."""
        end = time.monotonic() + LIMIT
        while time.monotonic() < end:
            found = holds()
            if found:
                return found
            if not self.alive():
                return None
            time.sleep(0.05)
        return None

    def leave(self, report, code=0):
        """Closes the window as a person does; it is to end with `code`."""
        self.key("Escape")
        self.until(lambda: not self.alive())
        report.check(self.process.poll() == code, f"exit code {self.process.poll()}, not {code}\n{self.said()}")

    def stop(self):
        """For a finally: whatever happened."""
        if self.alive():
            self.process.kill()
            self.process.wait()

    def tool(self, *arguments):
        return subprocess.run(["xdotool", *map(str, arguments)], capture_output=True, text=True).stdout.split()

    def open(self):
        found = self.until(lambda: self.tool("search", "--onlyvisible", "--name", "^weft: "))
        self.window = found[-1] if found else None
        self.tool("mousemove", "--window", self.window, 160, 90)
        return self.window

    def key(self, name):
        self.tool("key", name)

    def shot(self):
        """The picture of a later frame, as a path."""
        before, pressed = set(self.folder.glob("weft_*.png")), 0.0

        def look():
            nonlocal pressed
            if time.monotonic() - pressed > 5:  # a key may come before the window takes any
                pressed = time.monotonic()
                self.key("F12")
            return set(self.folder.glob("weft_*.png")) - before

        found = self.until(look)
        return max(found) if found else None

    def settled(self):
        """The picture at rest: of two later frames that are alike. While an environment fades in, no two are."""
        shots = [self.shot()]

        def alike():
            shots.append(self.shot())
            return all(shots[-2:]) and shots[-1].read_bytes() == shots[-2].read_bytes()

        return shots[-1] if self.until(alike) else None


def edit(path, pattern, text):
    """As editors save: a file beside it, then a rename."""
    before = path.read_text()
    after = re.sub(pattern, lambda _: text, before, count=1)
    assert after != before, f"nothing to edit in {path}"
    save(path, after)
    return before


def save(path, text):
    beside = path.with_name(path.name + "~")
    beside.write_text(text)
    beside.rename(path)


def copy_of_tree(folder):
    """What a viewer reads, to be changed."""
    for part in ("graphs", "shaders", "scenes", "materials"):
        shutil.copytree(TOP / part, folder / part)


def inside_display(report, weft, compare, script):
    """Unless inside already: runs `script` under a virtual display and ends. Inside: the folder of its frame buffer."""
    if "--inside" in sys.argv:
        return pathlib.Path(os.environ["WEFT_SCREEN"])
    if not shutil.which("xvfb-run") or not shutil.which("xdotool"):
        report.skip("xvfb-run or xdotool is not installed")
    with tempfile.TemporaryDirectory(prefix="weft_screen_") as screen:
        xvfb = ["xvfb-run", "-a", "-s", f"-screen 0 1280x1024x24 -noreset -fbdir {screen}"]
        command = [*xvfb, sys.executable, script, weft, compare, *sys.argv[3:], "--inside"]
        sys.exit(subprocess.run(command, env={**os.environ, "WEFT_SCREEN": screen}).returncode)
