"""Driving `weft view` in a window of a virtual display with xdotool: keys, drags, screenshots. Scripts wait for what the viewer says
(`--events`, docs/viewer.md) and never for a time but that of a fade; LIMIT only guards against hanging. inside_display() runs a test's script
again in a display of its own."""
import contextlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

from program import SANITIZED, SLOWER, TOP, Report, count_run, temporary_folder

LIMIT = 300 * SLOWER  # seconds for anything to happen
FADE = 0.3  # seconds, longer than graphs/fade.json takes; the window's time runs with the wall clock


class Session:
    """A viewer under way. Its events are numbered in the order they come: mark() is how many there are, event(…, since) waits for
    one after that."""

    def __init__(self, weft, folder, *arguments, graph="graphs/studio.json", size="320x180", data=True, events=True):
        self.folder, self.log, self.told = folder, folder / "stderr.txt", folder / "stdout.txt"
        homes = {name: str(folder / "home") for name in ("XDG_CONFIG_HOME", "XDG_STATE_HOME")}
        environment = {**os.environ, **homes, **({"WEFT_DATA": str(folder)} if data else {})}
        command = [weft, "view", graph, *(["--size", size] if size else []), "--program-cache", "none", *(["--events"] if events else []), *map(str, arguments)]
        count_run()
        with open(self.log, "w") as log, open(self.told, "w") as told:
            self.process = subprocess.Popen(list(map(str, command)), cwd=folder, env=environment, stderr=log, stdout=told)
        self.window = None

    def said(self):
        return self.log.read_text(errors="replace")

    def lines(self):
        """What it printed, whole lines only."""
        return self.told.read_text(errors="replace").split("\n")[:-1]

    def mark(self):
        return len(self.lines())

    def alive(self):
        return self.process.poll() is None

    def until(self, holds, pause=0.02):
        """The first thing true of `holds`, asked every `pause` seconds; None when time is up or the program has ended."""
        end = time.monotonic() + LIMIT
        while time.monotonic() < end:
            ended = not self.alive()  # asked first: what holds at the end is seen
            found = holds()
            if found:
                return found
            if ended:
                return None
            time.sleep(pause)
        return None

    def line(self, pattern, since=0):
        """The first line after `since` that is `pattern` as a whole, as a match; waits for it."""
        def look():
            return next((m for m in (re.fullmatch(pattern, line) for line in self.lines()[since:]) if m), None)

        return self.until(look)

    def event(self, what, since=0):
        return self.line(r"event (\d+) (?:" + what + ")", since)

    def leave(self, report, code=0, unsaved=False):
        """Closes the window as a person does; it is to end with `code`. `unsaved`: changes made there are dropped."""
        self.key("shift+Escape" if unsaved else "Escape")
        self.until(lambda: not self.alive())
        report.check(self.process.poll() == code, f"exit code {self.process.poll()}, not {code}\n{self.said()}")

    def stop(self):
        """For a finally: whatever happened."""
        if self.alive():
            self.process.kill()
            self.process.wait()

    def tool(self, *arguments):
        return subprocess.run(["xdotool", *map(str, arguments)], capture_output=True, text=True).stdout.split()

    def open(self, x=160, y=90):
        """Until the window is there and takes keys: the display gives them to what is under the pointer."""
        found = self.until(lambda: self.tool("search", "--onlyvisible", "--name", "^weft: "), 0.1)
        self.window = found[-1] if found else None
        if self.window:
            self.tool("mousemove", "--window", self.window, x, y)
        return self.window

    def key(self, name):
        """Presses a key; returns the mark before it."""
        before = self.mark()
        self.tool("key", name)
        return before

    def act(self, name, action):
        """Presses a key and waits until the viewer has done what is on it."""
        return self.event(f"action {action}", self.key(name))

    def shot(self, name="F12"):
        """The picture of a later frame, as a path. Keys are taken in order, so it shows what the keys before it did."""
        found = self.line(r"wrote (weft_.*\.(?:png|exr))", self.key(name))
        return self.folder / found[1] if found else None

    def resize(self, width, height):
        before = self.mark()
        self.tool("windowsize", self.window, width, height)
        return self.event(f"size {width} {height}", before)

    def click(self, x, y):
        """Until the panels have seen it. What it changed stands before that, as `change`: True when something did."""
        self.tool("mousemove", "--window", self.window, x, y)
        before = self.mark()
        self.tool("click", 1)
        clicked = self.event(r"click -?\d+ -?\d+", before)
        return bool(clicked) and any(re.fullmatch(r"event \d+ change", line) for line in self.lines()[before:])

    def rest(self, since):
        """In idle mode: until the picture stands still."""
        return self.event("resting", since)

    def opened(self, report):
        """The first picture that is at rest; None when there is no window or no picture, which is reported."""
        if not report.check(self.open(), f"no window\n{self.said()}"):
            return None
        first = self.settled()
        report.check(first, f"no picture\n{self.said()}")
        return first

    def settled(self):
        """The picture at rest: of two frames that are alike, with the whole time of a fade between them. Within a fade two may be
        alike by chance, also where it shows nothing: a picture mixed with itself is another by rounding."""
        shots = [self.shot()]

        def alike():
            time.sleep(FADE)
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
    """What a viewer reads, to be changed. The maps of the environment are small, so that they are made in little time."""
    for part in ("graphs", "shaders", "scenes", "materials"):
        shutil.copytree(TOP / part, folder / part)
    for name, size, small in (("ibl", '"size": 512', '"size": 32'), ("ibl", '"size": [1024, 512]', '"size": [128, 64]'),
                              ("daylight", '"size": [512, 256]', '"size": [128, 64]')):
        edit(folder / f"graphs/{name}.json", re.escape(size), small)


@contextlib.contextmanager
def display(frames=None):
    """A virtual display of this test alone: the environment to run a program in it. The X server chooses a number that is free and
    says it when it is ready; `frames` is the folder of its frame buffer."""
    listens, says = os.pipe()
    command = ["Xvfb", "-displayfd", str(says), "-screen", "0", "1280x1024x24", "-noreset", "-nolisten", "tcp"]
    server = subprocess.Popen(command + (["-fbdir", str(frames)] if frames else []), pass_fds=[says], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL)
    os.close(says)
    try:
        with os.fdopen(listens) as numbers:
            number = numbers.readline().strip()
        assert number, "Xvfb does not start"
        hidden = {k: v for k, v in os.environ.items() if k not in ("WAYLAND_DISPLAY", "XAUTHORITY")}
        yield {**hidden, "DISPLAY": f":{number}"}
    finally:
        server.terminate()
        server.wait()


def inside_display(report, weft, compare, script):
    """Unless inside already: runs `script` in a virtual display and ends. Inside: the folder of its frame buffer."""
    if "--inside" in sys.argv:
        return pathlib.Path(os.environ["WEFT_SCREEN"])
    if not shutil.which("Xvfb") or not shutil.which("xdotool"):
        report.skip("Xvfb or xdotool is not installed")
    if report.checks:
        report.sum_up()
        if report.problems:
            sys.exit(1)
    with tempfile.TemporaryDirectory(prefix="weft_screen_") as screen, display(screen) as environment:
        command = [sys.executable, script, weft, compare, *sys.argv[3:], "--inside", *(["--sanitized"] if SANITIZED else [])]
        done = subprocess.run(command, env={**environment, "WEFT_SCREEN": screen})
    sys.exit(done.returncode)


def run_parts(script, *parts):
    """What a script of the viewer consists of: each part gets the program, a tree of its own and the report."""
    weft, compare, report = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), Report()
    inside_display(report, weft, compare, script)
    for part in parts:
        with temporary_folder() as name:
            folder = pathlib.Path(name)
            copy_of_tree(folder)
            part(weft, folder, report)
    report.end()
