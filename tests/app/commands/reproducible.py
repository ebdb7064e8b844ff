#!/usr/bin/env python3
"""The same command gives the same bytes: run to run, cold and warm program cache, OSMesa and EGL, whole and part of a
range of frames. And the picture of the real environment at 1920x1080 is made without a word from the driver."""
import pathlib
import sys

from program import REAL_HDR, Report, run, temporary_folder

STUDIO = "graphs/studio.json"


def render(report, weft, label, output, *arguments):
    result = run(weft, "render", STUDIO, "-o", output, *arguments)
    report.check(result.code == 0, f"{label}: exit code {result.code}\n{result.err}")
    report.check("W120" not in result.err, f"{label}: the driver reports\n{result.err}")
    # W153 is about the input: two texels of the real environment are beyond half floats.
    loud = [d for d in result.diagnostics if d["severity"] == "error" or d["code"] != "W153"]
    report.check(not loud, f"{label}: {result.err}")
    path = pathlib.Path(output)
    return path.read_bytes() if path.exists() else b""


def has_backend(report, weft, backend, folder):
    result = run(weft, "render", "graphs/daylight.json", "--size", "8x8", "--backend", backend, "--program-cache", "none",
                 "-o", folder / "probe.png")
    return report.check(result.code == 0, f"{backend}: {result.err}")


def check_environment(report, weft, folder, name, size, arguments, backends):
    pictures = {}
    for backend in backends:
        cache = folder / f"cache_{name}_{backend}"
        common = ["--size", size, "--backend", backend, "--program-cache", cache, *arguments]
        pictures[backend] = render(report, weft, f"{name}, {backend}, cold cache", folder / f"{name}_{backend}.png", *common)
        report.check(any(cache.rglob("*")), f"{backend}: nothing was written to {cache}")
        warm = render(report, weft, f"{name}, {backend}, warm cache", folder / f"{name}_{backend}_warm.png", *common)
        report.check(warm == pictures[backend], f"{name}, {backend}: a warm program cache changes the picture")
    first = next(iter(pictures.values()), b"")
    report.check(len(first) > 100_000, f"{name}: a picture of {len(first)} bytes")
    for backend, picture in pictures.items():
        report.check(picture == first, f"{name}: {backend} and {backends[0]} differ")


# The camera turns, and one sphere moves: every frame is another picture.
MOVING = """{
  "name": "moving",
  "cameras": { "turn": { "position": [0, 1, 20], "orbit": 60 } },
  "grid": { "count": [4, 3, 2], "spacing": 3, "materials": ["white"] },
  "materials": { "white": { "albedo": [1, 1, 1], "metallic": 1, "roughness": 0.3 } },
  "spheres": [{ "center": [0, 5, 3], "material": "white", "velocity": [10, 0, 0] }]
}
"""


def check_frames(report, weft, folder):
    scene = folder / "moving.json"
    scene.write_text(MOVING)
    common = ["--scene", scene, "--size", "320x180", "--program-cache", folder / "cache_frames", "--quiet"]
    render(report, weft, "frames 0:3", folder / "f_%04d.png", "--frames", "0:3", *common)
    files = [folder / f"f_{frame:04}.png" for frame in range(4)]
    if not report.check(all(f.exists() for f in files), "frames 0:3 did not write four files"):
        return
    report.check(not (folder / "f_0004.png").exists(), "a frame too many")
    alone = render(report, weft, "frame 3", folder / "alone.png", "--frames", "3", *common)
    report.check(alone == files[3].read_bytes(), "frame 3 alone differs from frame 3 of 0:3")
    again = render(report, weft, "frame 0", folder / "zero.png", *common)
    report.check(again == files[0].read_bytes(), "frame 0 alone differs from frame 0 of 0:3")
    report.check(len({f.read_bytes() for f in files}) == 4, "some frames are the same although the camera turns")


def main():
    weft, report = sys.argv[1], Report()
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        backends = [b for b in ("osmesa", "egl") if has_backend(report, weft, b, folder)]
        check_environment(report, weft, folder, "daylight", "960x540", [], backends)
        check_environment(report, weft, folder, "real", "1920x1080", ["--environment", REAL_HDR], backends)
        check_frames(report, weft, folder)
    report.end()


main()
