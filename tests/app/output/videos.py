#!/usr/bin/env python3
"""Films by ffmpeg: an .mkv has the pixels of the pictures, an .mp4 what players take; what fails is told in ffmpeg's words, and leaves
no file.

    videos.py WEFT
"""
import json
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import time

from pictures import decode
from program import SLOWER, TOP, Report, count_run, heed_signals, run, temporary_folder

GRAPH = str(TOP / "docs/tutorials/trail.json")
FAILING = """#!/bin/sh
head -c 100 >/dev/null
echo "first line" >&2
echo "the disk is on strike" >&2
exit 7
"""


def small_files():
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))


def stream_of(path):
    done = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", path], capture_output=True, text=True)
    return json.loads(done.stdout)["streams"][0] if done.returncode == 0 else {"error": done.stderr}


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    if not shutil.which("ffmpeg"):
        report.skip("ffmpeg is not installed")
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        render = ["render", GRAPH, "--program-cache", "none", "--quiet"]

        def refused(code, says, *arguments, **options):
            done = run(weft, *render, *arguments, folder=folder, **options)
            report.check(done.code == code and says in done.err, f"{arguments}: {done.code}\n{done.err}")
            return done

        films = ["--frames", "3-11x2", "--size", "34x18", "--fps", "23.976", "-o", "film.mkv", "-o", "ldr=f_%d.png", "-o", "mean=mean.mp4"]
        done = run(weft, *render, *films, folder=folder)
        report.check(done.code == 0, f"films: {done.err}")
        pixels = subprocess.run(["ffmpeg", "-v", "error", "-i", folder / "film.mkv", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], capture_output=True)
        wanted = b""
        for frame in range(3, 12, 2):
            _, channels, texels = decode((folder / f"f_{frame}.png").read_bytes())
            wanted += b"".join(texels[i:i + 3] for i in range(0, len(texels), channels))
        report.check(pixels.stdout == wanted, f"film.mkv has other pixels: {len(pixels.stdout)} bytes, {pixels.stderr}")
        for file, codec, pixel in (("film.mkv", "ffv1", "bgr0"), ("mean.mp4", "h264", "yuv420p")):
            found = stream_of(folder / file)
            report.check((found.get("codec_name"), found.get("pix_fmt"), found.get("width"), found.get("height"), found.get("nb_read_frames"), found.get("r_frame_rate"))
                         in ((codec, pixel, 34, 18, "5", "2997/125"), (codec, pixel, 34, 18, "5", "24000/1001")), f"{file}: {found}")
        again = (folder / "mean.mp4").read_bytes()
        run(weft, *render, *films, folder=folder)
        report.check((folder / "mean.mp4").read_bytes() == again, "another run makes other bytes")
        before = sorted(path.name for path in folder.iterdir())
        report.check(not [file for file in before if file.startswith(".")], f"temporary files: {before}")

        refused(2, "--skip-done is for pictures", "-o", "a.mp4", "--skip-done")
        refused(2, "has no place for a number", "-o", "a_%d.mp4")
        refused(1, "an even width and height, not 33x18", "-o", "a.mp4", "--size", "33x18")
        (folder / "bin").mkdir()
        env = {**os.environ, "PATH": str(folder / "bin")}
        refused(1, "apt-get install ffmpeg", "-o", "a.mp4", env=env)
        (folder / "bin/ffmpeg").write_text(FAILING)
        (folder / "bin/ffmpeg").chmod(0o755)
        env["PATH"] += ":" + os.environ["PATH"]
        told = refused(1, "found: first line; the disk is on strike", "-o", "film.mkv", "--frames", "0-999", env=env)
        report.check(told.codes() == ["W180"] and "ffmpeg ended with exit code 7" in told.err, told.err)
        (folder / "bin/ffmpeg").write_text("#!/bin/sh\ncat >/dev/null\n")
        refused(1, "the program ffmpeg wrote nothing", "-o", "film.mkv", env=env)
        # A full disk, which ffmpeg may notice in the end only: as a limit to sizes of files.
        full = refused(1, "ffmpeg ended with exit code 1", "-o", "a.mp4", "--size", "64x36", "--frames", "0-2", preexec_fn=small_files)
        report.check("File too large" in full.err, full.err)
        count_run()
        process = subprocess.Popen([str(weft), *render, "-o", "long.mp4", "--size", "64x36", "--frames", "0-1000000"], cwd=folder, stderr=subprocess.PIPE, text=True, start_new_session=True, preexec_fn=heed_signals)
        deadline = time.monotonic() + 120 * SLOWER
        part = folder / ".long.mp4.part"
        while not (part.exists() and part.stat().st_size) and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        os.killpg(process.pid, signal.SIGINT)  # as Ctrl-C does
        error = process.communicate(timeout=120 * SLOWER)[1]
        report.check(process.returncode == 130 and "'long.mp4' is not written" in error, f"SIGINT: {process.returncode}\n{error}")
        # A second signal ends a run at once, whichever it is.
        (folder / "bin/ffmpeg").write_text(f"#!/bin/sh\nhead -c 1 >/dev/null\n: >{folder}/bin/began\nwhile kill -0 $PPID; do sleep 0.1; done\n")
        count_run()
        process = subprocess.Popen([str(weft), *render, "-o", "long.mkv", "--size", "200x200"], cwd=folder, stderr=subprocess.PIPE, text=True, env=env, preexec_fn=heed_signals)
        while not (folder / "bin/began").exists() and process.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        while "a second signal" not in (process.stderr.readline() or "a second signal"):
            pass
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=120 * SLOWER)
        report.check(process.returncode == -signal.SIGTERM, f"SIGTERM after SIGINT: {process.returncode}")
        (folder / ".long.mkv.part").unlink()
        shutil.rmtree(folder / "bin")
        report.check(sorted(path.name for path in folder.iterdir()) == before, f"what failed leaves files: {sorted(folder.iterdir())}")
    report.end()


main()
