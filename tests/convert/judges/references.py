#!/usr/bin/env python3
"""Makes tests/convert/references: what players that are not Weft show of the files of cases.json. ISF files by npm's
interactive-shader-format in Chromium (software WebGL), user shaders by mpv under Xvfb. A judge that is not installed is skipped
aloud. CI does not run this; it compares with the pictures.

    references.py NODE_MODULES [NAME...]

NODE_MODULES is a folder where `npm install interactive-shader-format puppeteer-core` ran.
"""
import json
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "app"))
from pictures import png, read_png  # noqa: E402

FOLDER = pathlib.Path(__file__).resolve().parents[1]
PICTURES = FOLDER / "pictures"
MPV = ["--no-config", "--vo=gpu", "--gpu-context=x11egl", "--osc=no", "--osd-level=0", "--audio=no", "--pause", "--keep-open=yes",
       "--no-border", "--no-keepaspect-window", "--dither-depth=no", "--scale=bilinear", "--dscale=bilinear", "--correct-downscaling=no",
       "--linear-downscaling=no", "--sigmoid-upscaling=no", "--target-trc=auto", "--really-quiet"]


def ask_isf(modules, chromium, case, size, out):
    images = {**case.get("images", {}), **case.get("imported", {})}
    raw = out.with_suffix(".raw")
    subprocess.run(["node", str(FOLDER / "judges/isf_page.js"), modules, chromium, *map(str, size), str(case["frame"]),
                    str(FOLDER / case["file"]), str(raw), *(f"{name}={PICTURES / file}" for name, file in images.items())],
                   check=True, timeout=180)
    rgba, (width, height) = raw.read_bytes(), size
    raw.unlink()
    texel = [tuple(rgba[at:at + 3]) for at in range(0, len(rgba), 4)]
    out.write_bytes(png([texel[width * y:width * (y + 1)] for y in reversed(range(height))]))


def ask_mpv(case, size, out):
    with tempfile.TemporaryDirectory() as folder:
        door = pathlib.Path(folder) / "door"
        shot = pathlib.Path(folder) / "shot.png"
        command = ["xvfb-run", "-a", "-s", "-screen 0 800x600x24", "mpv", *MPV, f"--geometry={size[0]}x{size[1]}", f"--input-ipc-server={door}",
                   f"--glsl-shaders={FOLDER / case['file']}", str(PICTURES / "card.png")]
        player = subprocess.Popen(command, stdin=subprocess.DEVNULL)
        try:
            deadline = time.monotonic() + 40
            while not door.exists() and time.monotonic() < deadline:
                time.sleep(0.05)
            with socket.socket(socket.AF_UNIX) as line:
                line.connect(str(door))
                talk = line.makefile("rw")

                def tell(*words):
                    talk.write(json.dumps({"command": words, "request_id": 7}) + "\n")
                    talk.flush()
                    while True:
                        answer = json.loads(talk.readline())
                        if answer.get("request_id") == 7:
                            return answer

                while time.monotonic() < deadline:
                    shown = tell("get_property", "osd-dimensions").get("data") or {}
                    if [shown.get("w"), shown.get("h")] == size and not shown.get("mt") and tell("get_property", "vo-configured").get("data"):
                        break
                    time.sleep(0.05)
                answer = tell("screenshot-to-file", str(shot), "window")
                while answer["error"] != "success" and time.monotonic() < deadline:  # nothing is shown yet
                    time.sleep(0.2)
                    answer = tell("screenshot-to-file", str(shot), "window")
                assert answer["error"] == "success", answer
                tell("quit")
            player.wait(timeout=30)
        finally:
            if player.poll() is None:
                player.terminate()
        rows = read_png(shot.read_bytes())
        assert [len(rows[0]), len(rows)] == size, (len(rows[0]), len(rows))
        out.write_bytes(png([[texel[:3] for texel in row] for row in rows]))


def main():
    modules, *names = sys.argv[1:]
    manifest = json.loads((FOLDER / "cases.json").read_text())
    chromium = shutil.which("chromium")
    have_isf = chromium and shutil.which("node") and (pathlib.Path(modules) / "interactive-shader-format").is_dir()
    have_mpv = shutil.which("mpv") and shutil.which("xvfb-run")
    for case in manifest["cases"]:
        if names and case["name"] not in names:
            continue
        isf = case["file"].endswith(".fs")
        if not (have_isf if isf else have_mpv):
            print(f"skipped: {case['name']}, its judge is not installed")
            continue
        out = FOLDER / "references" / (case["name"] + ".png")
        if isf:
            ask_isf(str(pathlib.Path(modules).resolve()), chromium, case, manifest["size"], out)
        else:
            ask_mpv(case, manifest["size"], out)
        print(out.relative_to(FOLDER), flush=True)


if __name__ == "__main__":
    main()
