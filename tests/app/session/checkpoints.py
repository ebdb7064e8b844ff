#!/usr/bin/env python3
"""weft render --checkpoint: a run that begins with a checkpoint writes the files of the whole run, byte for byte; one that does not fit,
or is damaged anywhere, is named and not used. (tests/runtime/frame/checkpoint_gl_test.cpp has every kind of state and graph.)

    checkpoints.py WEFT [--judge GRAPH FRAMES SHARDS SIZE]

--judge, by hand: FRAMES whole, in SHARDS that each begin with a checkpoint, and in runs that are killed until all is there."""
import pathlib
import random
import shutil
import subprocess
import sys
import time

from program import TOP, Report, run, temporary_folder

GRAPH = TOP / "tests/runtime/graphs/checkpoint.json"
COMMON = ["--scene", "scenes/empty.json", "--size", "16x16", "--quiet"]


def begins_at(result):
    """The first frame that ran, by --stats, of a run whose last frame is 9."""
    return 10 - int(result.err.split('"frames_run": ')[1].split(",")[0])


def files_of(folder, kind="*"):
    return {f.name: f.read_bytes() for f in sorted(folder.glob(f"f_*.{kind}"))}


def check_options(weft, report, folder):
    whole, parts, saved = folder / "whole", folder / "parts", folder / "whole/checkpoints"
    for kind in ("exr", "png"):
        result = run(weft, "render", GRAPH, *COMMON, "--frames", "0:9", "--checkpoint", "4", "-o", whole / f"f_%d.{kind}")
        report.check(result.code == 0 and not result.err, f"whole: {result.err}")
    names = sorted(f.name for f in saved.iterdir())
    report.check(names == ["checkpoint_000004.checkpoint", "checkpoint_000008.checkpoint"], f"saved: {names}")
    before = {f.name: f.read_bytes() for f in saved.iterdir()}

    def rest(label, frames, begin, *arguments, words=(), code=0, kind="exr", where=saved):
        result = run(weft, "render", GRAPH, *COMMON, "--frames", frames, "--stats", "--checkpoints", where, *arguments,
                     "-o", parts / f"f_%d.{kind}")
        report.check(result.code == code, f"{label}: exit code {result.code}\n{result.err}")
        report.check(all(w in result.err for w in words), f"{label}: no {words} in\n{result.err}")
        if code == 0:
            report.check(begins_at(result) == begin, f"{label}: begins with frame {begins_at(result)}, not {begin}")
            report.check("W001" in result.err or not words, f"{label}: {result.err}")
        return result

    for kind in ("exr", "png"):
        rest("from 8", "8:9", 8, kind=kind)
        rest("from 4", "4:9", 4, kind=kind)
        report.check(all(files_of(whole, kind)[n] == b for n, b in files_of(parts, kind).items()), f"{kind}: frames differ")
    rest("saves again", "5:9", 4, "--checkpoint", "4")
    report.check({f.name: f.read_bytes() for f in saved.iterdir()} == before, "a checkpoint of a rest is another one")
    # With a manifest: what was read for it is no file that decides pixels.
    done = folder / "done"
    for begin in (0, 8):
        result = run(weft, "render", GRAPH, *COMMON, "--frames", "1-9x4", "--stats", "--skip-done", "--checkpoints", saved, "-o", done / "f_%d.exr")
        report.check(result.code == 0 and "W001" not in result.err and begins_at(result) == begin, f"--skip-done: not from {begin}\n{result.err}")
        report.check(all(files_of(whole, "exr")[n] == b for n, b in files_of(done, "exr").items()) and len(files_of(done, "exr")) == 3, "--skip-done: frames differ")
        (done / "f_9.exr").unlink()
    rest("another option", "9", 0, "--set", "beat=2", words=["2 checkpoints cannot be used", "of other files or options"])
    rest("another clock", "9", 0, "--fps", "30", words=["of other files or options"])
    rest("another texture is kept", "9", 0, "-o", f"third={parts / 'third.exr'}", words=["of other files or options"])
    named = {"where": saved / "checkpoint_000004.checkpoint"}
    rest("named", "9", 4, **named)
    rest("named, does not fit", "9", 4, "--set", "beat=2", **named, code=1, words=["error[W001]", "of other files or options"])
    rest("named, too late", "2", 4, **named, code=1, words=["error[W001]", "is of frame 4"])
    rest("named, not there", "9", 4, where=saved / "no.checkpoint", code=1, words=["error[W001]", "cannot be read"])

    rest("no folder", "9", 0, where=folder / "absent", words=["warning[W001]", "there is no folder"])

    eight, good = saved / "checkpoint_000008.checkpoint", before["checkpoint_000008.checkpoint"]
    flipped = lambda at: good[:at] + bytes([good[at] ^ 16]) + good[at + 1:]
    for label, damaged, words in [
            ("empty", b"", "is no checkpoint"), ("torn", good[:9000], "is not whole"), ("longer", good + b"\0", "is not whole"),
            ("another size in it", flipped(8), "is not whole"), ("another frame in it", flipped(40), "is damaged"),
            ("a bit of the state", flipped(700), "is damaged"), ("the last bit", flipped(len(good) - 1), "is damaged"),
            ("no magic", flipped(0), "is no checkpoint"), ("settings", flipped(16), "other files or options"),
            ("build", flipped(24), "another build"), ("driver", flipped(32), "another driver"),
            ("of another frame", before["checkpoint_000004.checkpoint"], "is of frame 4")]:
        eight.write_bytes(damaged)
        rest(label, "9", 4, words=["1 checkpoint cannot be used", words])
        report.check(files_of(parts, "exr")["f_9.exr"] == files_of(whole, "exr")["f_9.exr"], f"{label}: another picture")
    with open(eight, "r+b") as file:  # with holes
        file.write(good)
        file.truncate(1 << 40)
    rest("huge", "9", 4, words=["is larger than one of this graph"])
    eight.unlink()
    eight.mkdir()
    rest("a folder", "9", 4, words=["cannot be read"])
    eight.rmdir()
    eight.symlink_to(folder / "elsewhere")
    rest("a link in the way of one to save", "7", 4, "--checkpoint", "8", code=1, words=["error[W180]", "is no plain file"])
    report.check(not (folder / "elsewhere").exists(), "a link was followed")


def check_others(weft, report, folder):
    """Without anything to remember nothing is saved; a copy of the files elsewhere is the same graph, a changed one is not."""
    result = run(weft, "render", "graphs/daylight.json", "--size", "8x8", "--frames", "0:3", "--checkpoint", "1", "-o", folder / "d_%d.png")
    report.check(result.code == 0 and not (folder / "checkpoints").exists(), f"nothing is remembered: {result.err}")
    for name in ("a", "b"):
        for part in ("graphs/checkpoint.json", "shaders/checkpoint", "shaders/math"):
            (folder / name / part).parent.mkdir(parents=True, exist_ok=True)
            copy = shutil.copytree if (GRAPH.parents[1] / part).is_dir() else shutil.copy
            copy(GRAPH.parents[1] / part, folder / name / part)
    render = lambda name, *arguments: run(weft, "render", folder / name / "graphs/checkpoint.json", *COMMON, "--checkpoints", folder / "saved", *arguments)
    render("a", "--frames", "0:3", "--checkpoint", "4", "-o", folder / "f_%d.png")
    result = render("b", "--frames", "9", "--stats", "-o", folder / "g.png")
    report.check(begins_at(result) == 4, f"a copy elsewhere: {result.err}")
    shader = folder / "b/shaders/checkpoint/show.frag.glsl"
    shader.write_text(shader.read_text().replace("10.0 *", "11.0 *"))
    result = render("b", "--frames", "9", "--stats", "-o", folder / "g.png")
    report.check(begins_at(result) == 0 and "of other files or options" in result.err, f"another shader: {result.err}")


def judge(weft, report, folder, graph, frames, shards, size):
    frames, shards = int(frames), int(shards)
    each = frames // shards
    base = [weft, "render", graph, "--size", size, "--quiet"]
    times = {}

    def timed(label, action):
        start = time.monotonic()
        action()
        times[label] = time.monotonic() - start

    def call(name, first, last, *more):
        return subprocess.run([*base, "--frames", f"{first}:{last}", *more, "-o", folder / name / "f_%04d.exr"], check=True, cwd=TOP)

    timed("whole", lambda: call("whole", 0, frames - 1))
    timed("whole, saving", lambda: call("saving", 0, frames - 1, "--checkpoint", str(each)))
    saved = folder / "saving/checkpoints"

    def run_shards():
        for i in random.sample(range(shards), shards):
            call("shards", i * each, (i + 1) * each - 1, "--checkpoints", saved)

    timed("shards", run_shards)
    kills = 0

    def run_killed():
        nonlocal kills
        while len(files_of(folder / "killed", "exr")) < frames:
            done = {int(n[2:6]) for n in files_of(folder / "killed", "exr")}
            first = min(set(range(frames)) - done)
            process = subprocess.Popen([*base, "--frames", f"{first}:{frames - 1}", "--checkpoint", str(each), "-o", folder / "killed/f_%04d.exr"], cwd=TOP)
            try:
                process.wait(timeout=random.uniform(0.3, 0.15 * times["whole"] + 0.7))
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
                kills += 1

    timed("killed", run_killed)
    whole = files_of(folder / "whole", "exr")
    report.check(len(whole) == frames, f"{len(whole)} frames")
    for name in ("saving", "shards", "killed"):
        report.check(files_of(folder / name, "exr") == whole, f"{name}: frames differ")
    again = folder / "killed/checkpoints"
    report.check(all(f.read_bytes() == (saved / f.name).read_bytes() for f in again.glob("*.checkpoint")), "checkpoints differ")
    report.check(not [f for f in again.iterdir() if f.suffix != ".checkpoint"] or kills, "something else lies beside the checkpoints")
    bytes_each = max(f.stat().st_size for f in saved.iterdir())
    print(f"{graph}: {frames} frames of {size}, {len(set(whole.values()))} different ones, {shards} shards, {kills} kills; "
          f"a checkpoint has {bytes_each:,} bytes; " + ", ".join(f"{label} {seconds:.1f} s" for label, seconds in times.items()))


def main():
    weft, report = sys.argv[1], Report()
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        if "--judge" in sys.argv:
            judge(weft, report, folder, *sys.argv[3:])
        else:
            check_options(weft, report, folder)
            check_others(weft, report, folder)
    report.end()


main()
