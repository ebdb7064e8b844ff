#!/usr/bin/env python3
"""Frames of a graph that remembers, drawn by several processes that share a manifest, some of them ended by signals: what --skip-done
then draws is what is missing, and all files are those of one run, to the byte. No signal leaves half a file.

    sequences.py WEFT
"""
import json
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import time
import zlib

from pictures import png
from program import SLOWER, TOP, Report, count_run, heed_signals, run, temporary_folder

ADD = """uniform sampler2D still, map;
out vec4 result;
void main() { result = texelFetch(still, ivec2(0), 0) + texelFetch(map, ivec2(0), 0); }
"""
PICTURES = """{ "resources": { "still": { "import": "image", "file": "still.png" }, "map": { "import": "image", "file": "map.##.png" },
                 "ldr": { "texture": "rgba8", "size": "screen" } },
  "passes": [ { "name": "add", "type": "fullscreen", "shader": "add.frag.glsl", "read": ["still", "map"], "write": { "result": "ldr" } } ],
  "present": "ldr" }
"""
COMMON = ["--size", "24x16", "--program-cache", "none"]
LAST = 19


class Bench:
    def __init__(self, weft, folder, report):
        self.weft, self.folder, self.report = weft, folder, report
        for name in ("trail.json", "shaders/tutorials/trail.frag.glsl", "shaders/tutorials/show_level.frag.glsl"):
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes((TOP / "docs/tutorials" / name).read_bytes())
        self.render = ["render", folder / "trail.json", *COMMON]

    def works(self, *arguments):
        done = run(self.weft, *self.render, *arguments, folder=self.folder)
        self.report.check(done.code == 0, f"{arguments}: {done.code}\n{done.err}")
        return done

    def start(self, *arguments):
        count_run()
        return subprocess.Popen([str(self.weft), *map(str, self.render), *map(str, arguments)], cwd=self.folder, stderr=subprocess.PIPE, text=True, preexec_fn=heed_signals)

    def ended(self, process, code):
        error = process.communicate(timeout=300 * SLOWER)[1]
        self.report.check(process.returncode == code, f"{process.args}: {process.returncode}, not {code}\n{error}")
        return error

    def lines(self, name):
        return [json.loads(line) for line in (self.folder / name).read_text().splitlines()]


def fnv(data):
    value = 0xcbf29ce484222325
    for byte in data:
        value = (value ^ byte) * 0x100000001b3 & (1 << 64) - 1
    return f"{value:016x}"


def is_whole(path):
    """A .png whose parts all have their checksums, up to the last."""
    data, at, kind = path.read_bytes(), 8, b""
    while at + 12 <= len(data):
        size = int.from_bytes(data[at:at + 4], "big")
        kind, end = data[at + 4:at + 8], at + 12 + size
        if zlib.crc32(data[at + 4:end - 4]) != int.from_bytes(data[end - 4:end], "big"):
            return False
        at = end
    return kind == b"IEND" and at == len(data)


def shards(bench, whole):
    report, folder = bench.report, bench.folder
    output = ["-o", "s/f_%02d.png", "-o", "mean=s/mean_%02d.exr"]
    (folder / "s").mkdir()
    (folder / "s/.f_02.png.part").write_text("left by a run that was killed")
    both = [bench.start(*output, "--manifest", "s/f_.frames.jsonl", "--frames", frames) for frames in ("0-18x3,7", "1-19x3,2-17x3")]
    for process in both:
        bench.ended(process, 0)
    files = lambda: {path.name: path.read_bytes() for path in (folder / "s").glob("*.png")}
    report.check(files() == whole, f"shards: {sorted(files())}")
    report.check(not list((folder / "s").glob(".*.part")), "what a killed run left stays")
    lines = bench.lines("s/f_.frames.jsonl")
    report.check(sorted(line["frame"] for line in lines) == sorted([*range(LAST + 1), 7]), f"lines of {[line['frame'] for line in lines]}")
    for line in lines:
        for name in (f"f_{line['frame']:02}.png", f"mean_{line['frame']:02}.exr"):
            report.check(line["files"][name] == fnv((folder / "s" / name).read_bytes()), f"the hash of {name}: {line}")
    report.check(len({line["settings"] for line in lines}) == 1, "the settings of shards differ")
    line = lines[0]
    report.check(line["host"] == socket.gethostname() and line["seconds"] > 0 and "--frames" in line["command"] and
                 re.fullmatch(r"\d+\.\d+\.\d+ \([0-9a-f]{16}\)", line["weft"]) and line["driver"], f"a line: {line}")
    # One file is gone, one damaged, a line torn.
    (folder / "s/f_03.png").unlink()
    damaged = bytearray((folder / "s/mean_11.exr").read_bytes())
    damaged[-1] ^= 1
    (folder / "s/mean_11.exr").write_bytes(damaged)
    with (folder / "s/f_.frames.jsonl").open("a") as manifest:
        manifest.write('{"frame":5,"fi')
    untouched = folder / "s/f_04.png"
    before = untouched.stat().st_mtime_ns
    gather = bench.works(*output, "--skip-done", "--frames", f"0-{LAST}", "--stats")
    report.check("20 frames: 18 done already, 2 drawn\n" in gather.err and '"frames_run": 12,' in gather.err, f"gather: {gather.err}")
    report.check(files() == whole and untouched.stat().st_mtime_ns == before, "gather writes other files than those that are missing")
    # The folder may be another, and what says nothing of pixels.
    (folder / "s").rename(folder / "moved")
    bench.render[-1] = folder / "cache"
    again = bench.works(*(word.replace("s/", "moved/") for word in output), "--skip-done", "--frames", f"0-{LAST}", "--stats")
    report.check("20 frames: 20 done already, 0 drawn\n" in again.err and '"frames_run": 0,' in again.err, f"all done: {again.err}")
    # A shader was edited.
    with (folder / "shaders/tutorials/trail.frag.glsl").open("a") as shader:
        shader.write("// edited\n")
    edited = bench.works(*(word.replace("s/", "moved/") for word in output), "--skip-done", "--frames", "0-1")
    report.check("2 frames of 'moved/f_.frames.jsonl' drawn before with other settings" in edited.err and "2 frames: 0 done already, 2 drawn\n" in edited.err, f"edited: {edited.err}")
    # The manifest is none of the files that are read.
    wrong = run(bench.weft, *bench.render, "-o", "x.png", "--manifest", "trail.json", folder=folder)
    report.check(wrong.code == 1 and wrong.codes() == ["W180"] and "which this run reads" in wrong.err, f"a graph as manifest: {wrong.err}")


def pictures(bench):
    """What a graph shows by the import `image` decides pixels, too: the bytes of a picture, time and size of those of a sequence."""
    report, folder = bench.report, bench.folder
    (folder / "shaders/add.frag.glsl").write_text(ADD)
    (folder / "trail.json").write_text(PICTURES)
    for name in ("still", "map.00", "map.01", "map.02"):
        (folder / f"{name}.png").write_bytes(png([[(len(name), 40, 80)] * 4] * 4))
    for change, done in ((lambda: None, 0), (lambda: (folder / "still.png").write_bytes((folder / "still.png").read_bytes()), 3),
                         (lambda: (folder / "map.02.png").write_bytes(png([[(9, 9, 9)] * 4] * 4)), 0), (lambda: (folder / "still.png").write_bytes(png([[(9, 9, 9)] * 4] * 4)), 0)):
        change()
        told = bench.works("-o", "p/%d.png", "--frames", "0-2", "--skip-done")
        report.check(f"3 frames: {done} done already, {3 - done} drawn\n" in told.err, f"pictures: not {done} but {told.err}")
    report.check((folder / "p/frames.jsonl").exists(), "a manifest of files without a stem")
    # A name that is no UTF-8, as an old camera or archive leaves it.
    for done in (0, 3):
        told = bench.works("-o", b"p/caf\xe9_%d.png".decode(errors="surrogateescape"), "--frames", "0-2", "--skip-done")
        report.check(f"3 frames: {done} done already" in told.err, f"not UTF-8: {told.err}")
    os.mkfifo(folder / "pipe")
    wrong = run(bench.weft, *bench.render, "-o", "x.png", "--manifest", "pipe", folder=folder)
    report.check(wrong.code == 1 and "the manifest 'pipe' is no plain file" in wrong.err, f"a pipe as manifest: {wrong.err}")


def signals(bench):
    report, folder = bench.report, bench.folder
    for name, number, manifest, says in (("int", signal.SIGINT, True, r"(\d+) of 1000001 frames written; the same command with --skip-done goes on\n"),
                                         ("term", signal.SIGTERM, False, r"(\d+) of 1000001 frames written; go on with --frames (\d+)-1000000\n"),
                                         ("kill", signal.SIGKILL, True, None)):
        (folder / name).mkdir()
        process = bench.start("-o", f"{name}/f_%d.png", "--frames", "0:1000000", *(["--manifest", f"{name}/m"] if manifest else []))
        deadline = time.monotonic() + 120 * SLOWER
        while len(list((folder / name).glob("f_*.png"))) < 5 and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(number)
        error = bench.ended(process, 128 + number if says else -number)
        files = list((folder / name).glob("f_*.png"))
        report.check(len(files) >= 5 and all(map(is_whole, files)), f"{name}: half files")
        if manifest:
            text = (folder / name / "m").read_text()
            listed = [json.loads(line)["frame"] for line in text.splitlines() if says or line.endswith("}")]
            report.check(listed == list(range(len(listed))) and len(files) - len(listed) in ((0,) if says else (0, 1)), f"{name}: {len(files)} files, {text[-300:]}")
        if says:
            said = re.search(says, error)
            report.check(said and int(said[1]) == len(files) and said[1] == said[said.lastindex if not manifest else 1], f"{name}: {len(files)} files\n{error}")
            report.check(not list((folder / name).glob(".*")), f"{name}: a temporary file stays")


def to_a_pipe(bench):
    """A picture that goes into a pipe has no hash, and nobody waits for it."""
    pipe = bench.folder / "pipe.png"
    os.mkfifo(pipe)
    reader = subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE)
    bench.works("-o", pipe, "--manifest", "pipe.jsonl")
    bench.report.check(reader.communicate(timeout=300 * SLOWER)[0].startswith(b"\x89PNG"), "no picture comes through the pipe")
    bench.report.check(bench.lines("pipe.jsonl")[0]["files"] == {"pipe.png": ""}, "the hash of a pipe")


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    with temporary_folder() as name:
        bench = Bench(weft, pathlib.Path(name), report)
        bench.works("-o", "whole/f_%02d.png", "--frames", f"0:{LAST}", "--quiet")
        whole = {path.name: path.read_bytes() for path in (bench.folder / "whole").iterdir()}
        report.check(len(whole) == LAST + 1 and len(set(whole.values())) == LAST + 1, f"one run: {sorted(whole)}")
        shards(bench, whole)
        signals(bench)
        pictures(bench)
        to_a_pipe(bench)
    report.end()


main()
