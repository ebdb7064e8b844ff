#!/usr/bin/env python3
"""What only time shows: saves under fire, many frames, one program cache for eight renders, and kills at any moment. Parts:

    saves    a viewer takes --saves saves as fast as they come, each seventh one wrong: it stays, its picture follows, its memory is flat
    frames   --frames frames of a graph with a history in one process: its memory is flat
    cache    eight renders at a time share one program cache, and some are killed: every picture is the same
    faults   faults.py: whatever fails once
    drivers  the bundled graphs by Mesa's zink over lavapipe, beside llvmpipe
    kills    format, import, test --accept, a sequence and write-back in the viewer, killed --kills times each: every file is what it was or whole

    soak.py WEFT [PART...] [--saves N] [--frames N] [--kills N]
"""
import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "app"))
import faults  # noqa: E402
from pictures import read_png  # noqa: E402
from program import TOP, Report  # noqa: E402
from window import Session, copy_of_tree, display, save  # noqa: E402

BOUND = 8 << 20  # bytes that a flat memory may move


def resident(pid):
    return int(pathlib.Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def is_flat(report, name, samples):
    """The greatest of the second fifth against that of the last."""
    part = max(1, len(samples) // 5)
    early, late = max(samples[part:2 * part] or [0]), max(samples[-part:] or [0])
    print(f"{name}: {early / 2**20:.1f} MiB after the first fifth, {late / 2**20:.1f} MiB at the end", flush=True)
    report.check(samples and late - early < BOUND, f"{name}: grows by {(late - early) / 2**20:.1f} MiB")


class Folder:
    """The files of faults.py in a folder of their own."""

    def __enter__(self):
        self.holder = tempfile.TemporaryDirectory(prefix="weft_soak_")
        folder = pathlib.Path(self.holder.name)
        faults.make_folder(folder)
        return folder

    def __exit__(self, *_):
        self.holder.cleanup()


def environment(folder):
    return {**os.environ, "WEFT_DATA": str(TOP), "XDG_CACHE_HOME": str(folder / "cache")}


def saves(weft, report, asked):
    with display() as shown, Folder() as folder:
        os.environ.update(shown)
        os.environ["WEFT_DATA"] = str(TOP)
        part = folder / "shaders/part.glsl"
        live = Session(weft, folder, "--no-vsync", graph="graph.json", size="64x36", data=False)
        samples, began = [], time.monotonic()
        try:
            report.check(live.open() and live.shot(), f"no picture\n{live.said()}")
            for i in range(asked.saves):
                wrong = i % 7 == 6
                save(part, "vec3 shade(vec2 at) { return vec3(at }\n" if wrong else faults.PART.replace("0.5", f"{(i % 97 + 1) / 100}"))
                time.sleep(random.random() * 0.1)
                if i % 50 == 49:
                    samples.append(resident(live.process.pid))
                if not live.alive():
                    break
            save(part, faults.PART.replace("0.5", "0.75"))
            shot = live.until(lambda: (found := live.shot()) and read_blue(found) in (191, 192) and found)
            report.check(shot, f"the last save is not seen\n{live.said()[-800:]}")
            print(f"saves: {asked.saves} in {time.monotonic() - began:.0f} s", flush=True)
            live.leave(report)
        finally:
            live.stop()
        is_flat(report, "saves", samples)


def read_blue(path):
    """Of the texel in the middle of a picture."""
    rows = read_png(path.read_bytes())
    return rows[len(rows) // 2][0][2]


def frames(weft, report, asked):
    with Folder() as folder:
        last, began, samples = asked.frames - 1, time.monotonic(), []
        process = subprocess.Popen([weft, "render", "graph.json", "--size", "16x8", "--frames", f"0-{last}", "--quiet", "-o", "film.mkv"], cwd=folder, env=environment(folder),
                                   stderr=subprocess.PIPE, text=True)
        while process.poll() is None:
            try:
                samples.append(resident(process.pid))
            except (FileNotFoundError, ProcessLookupError):
                break
            time.sleep(0.1)
        report.check(process.wait() == 0, f"frames: {process.returncode}\n{process.stderr.read()[-800:]}")
        told = subprocess.run(["ffprobe", "-v", "error", "-count_packets", "-show_entries", "stream=nb_read_packets", "-of", "csv=p=0", "film.mkv"], cwd=folder, capture_output=True, text=True)
        report.check(told.stdout.strip(", \n") == str(asked.frames), f"frames: {told.stdout} of {asked.frames}\n{told.stderr}")
        print(f"frames: {asked.frames} in {time.monotonic() - began:.0f} s", flush=True)
        is_flat(report, "frames", samples)


def cache(weft, report, asked):
    """Each round begins with an empty cache; half of the renders of each second round are killed."""
    graphs = [str(TOP / "graphs" / name) for name in ("glow.json", "daylight.json", "taa.json", "deferred.json")]
    pictures = {}
    with Folder() as folder:
        for turn in range(asked.rounds):
            shared = folder / f"programs_{turn // 2}"
            running = []
            for i in range(8):
                output = folder / f"{turn}_{i}.png"
                running.append((subprocess.Popen([weft, "render", graphs[i % len(graphs)], "--size", "48x27", "--program-cache", shared, "--quiet", "-o", output],
                                                 cwd=folder, env=environment(folder), stderr=subprocess.PIPE, text=True), graphs[i % len(graphs)], output))
            killed = set()
            for i in random.sample(range(8), 4 if turn % 2 == 0 else 0):
                time.sleep(random.random() * 0.2)
                running[i][0].kill()
                killed.add(i)
            for i, (process, graph, output) in enumerate(running):
                error = process.communicate()[1]
                if i in killed and not output.exists():
                    continue
                if report.check(i in killed or process.returncode == 0, f"cache: {graph}: {process.returncode}\n{error}"):
                    pictures.setdefault(graph, set()).add(hashlib.sha256(output.read_bytes()).hexdigest())
    report.check(len(pictures) == len(graphs) and all(len(found) == 1 for found in pictures.values()), f"cache: different pictures of one graph: {pictures}")
    print(f"cache: {8 * asked.rounds} renders, {len(pictures)} graphs, one picture each", flush=True)


def kill_command(weft, report, name, asked):
    """The command of faults.py, killed within the time that it takes; then run again, whole."""
    arguments, _, made = faults.COMMANDS[name]
    with Folder() as folder:
        began = time.monotonic()
        subprocess.run([weft, *arguments], cwd=folder, env=environment(folder), capture_output=True, check=True)
        takes = time.monotonic() - began
        whole = {path: (folder / path).read_bytes() for path in made}
    ended = 0
    for _ in range(asked.kills):
        with Folder() as folder:
            before = faults.files_of(folder)
            process = subprocess.Popen([weft, *arguments], cwd=folder, env=environment(folder), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(random.random() * takes * 1.1)
            ended += process.poll() is None
            process.kill()
            process.wait()
            after = faults.files_of(folder)
            for path in made:
                report.check(after.get(path) in (before.get(path), whole[path]), f"{name}: {path} is half made after a kill")
            again = subprocess.run([weft, *arguments], cwd=folder, env=environment(folder), capture_output=True, text=True)
            after = faults.files_of(folder)
            report.check(again.returncode == 0 and all(after.get(path) == whole[path] for path in made), f"{name}: not whole after the second run: {again.stderr}")
            left = [path for path in after if path.endswith(".part") or "/." in "/" + path]
            report.check(not left, f"{name}: {left} left behind after the second run")
    print(f"kills: {name}: {ended} of {asked.kills} runs killed", flush=True)


def kill_write_back(weft, report, asked):
    count = max(1, asked.kills // 10)  # each is a viewer
    with display() as shown, tempfile.TemporaryDirectory(prefix="weft_soak_") as where:
        os.environ.update(shown)
        folder = pathlib.Path(where)
        copy_of_tree(folder)
        files = (folder / "graphs/effects/composite.json", folder / "graphs/post.json")
        before, seen = [path.read_text() for path in files], set()
        for _ in range(count):
            for path, text in zip(files, before):
                path.write_text(text)
            live = Session(weft, folder, "--set", "exposure=1.25", "--set", "curve=aces", "--disable", "fxaa", data=False)
            try:
                report.check(live.open() and live.shot(), f"no picture\n{live.said()}")
                live.act("F8", "write_back")
                live.key("F8")
                time.sleep(random.random() * 0.15)
                live.process.kill()
                live.process.wait()
            finally:
                live.stop()
            for path, text in zip(files, before):
                now = path.read_text()
                changed = sum(a != b for a, b in zip(now.splitlines(), text.splitlines()))
                report.check(now.count("\n") == text.count("\n") and changed <= 2 and json_like(now), f"write-back: {path.name} is half made after a kill")
                seen.add((path.name, changed))
    print(f"kills: write-back: {count} viewers killed; files and lines changed: {sorted(seen)}", flush=True)


def json_like(text):
    """Of a graph file: JSON with comments."""
    return isinstance(json.loads(re.sub(r"^\s*//.*$", "", text, flags=re.MULTILINE)), dict)


def kills(weft, report, asked):
    for name in ("format", "import", "accept", "sequence"):
        kill_command(weft, report, name, asked)
    kill_write_back(weft, report, asked)


def faults_part(weft, report, asked):
    done = subprocess.run([sys.executable, HERE / "faults.py", weft])
    report.check(done.returncode in (0, 77), "faults: see above")


def drivers(weft, report, asked):
    """OpenGL by Vulkan, of another driver's code: pictures may differ where an edge falls, in one of a thousand pixels."""
    icd = next(iter(pathlib.Path("/usr/share/vulkan/icd.d").glob("lvp_icd*.json")), None)
    if not icd:
        print("skipped: drivers: lavapipe is not installed (mesa-vulkan-drivers)")
        return
    with Folder() as folder:
        # ZINK_INLINE_UNIFORMS: see tests/golden/second_driver.py.
        zink = {**environment(folder), "GALLIUM_DRIVER": "zink", "ZINK_INLINE_UNIFORMS": "0", "LIBGL_ALWAYS_SOFTWARE": "1", "VK_ICD_FILENAMES": str(icd),
                "XDG_RUNTIME_DIR": str(folder)}
        for graph in sorted((TOP / "graphs").glob("*.json")):
            if not any(word in graph.read_text() for word in ('"present"', '"extends"')):
                continue
            seen = []
            for name, backend, variables in (("llvmpipe", "osmesa", environment(folder)), ("zink", "egl", zink)):
                output = folder / f"{graph.stem}_{name}.png"
                done = subprocess.run([weft, "render", graph, "--size", "96x54", "--backend", backend, "--program-cache", "none", "--stats", "-o", output],
                                      cwd=folder, env=variables, capture_output=True, text=True)
                if "is a file to include" in done.stderr:
                    break
                if report.check(done.returncode == 0 and name in done.stderr + done.stdout, f"drivers: {graph.name}: {name}: {done.returncode}\n{done.stderr[-600:]}"):
                    seen.append([texel for row in read_png(output.read_bytes()) for texel in row])
            if len(seen) < 2:
                continue
            apart = [max(abs(a - b) for a, b in zip(one, other)) for one, other in zip(*seen)]
            over = sum(each > 2 for each in apart)
            print(f"drivers: {graph.name:24} by up to {max(apart):3} of 255, {over} of {len(apart)} pixels by more than 2", flush=True)
            report.check(over <= len(apart) // 1000, f"drivers: {graph.name}: {over} pixels differ")


PARTS = {"saves": saves, "frames": frames, "cache": cache, "kills": kills, "drivers": drivers, "faults": faults_part}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("weft")
    parser.add_argument("parts", nargs="*", choices=[[], *PARTS])
    parser.add_argument("--saves", type=int, default=5000)
    parser.add_argument("--frames", type=int, default=100_000)
    parser.add_argument("--rounds", type=int, default=20)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args()
    random.seed(asked.seed)
    report, weft = Report(), os.path.abspath(asked.weft)
    for name in asked.parts or PARTS:
        if name in ("saves", "kills") and not (shutil.which("Xvfb") and shutil.which("xdotool")):
            print(f"skipped: {name}: Xvfb or xdotool is not installed")
            continue
        PARTS[name](weft, report, asked)
    report.end()


if __name__ == "__main__":
    main()
