#!/usr/bin/env python3
"""Outputs tell the truth. What cannot be written (a full device, a closed stream, a limit of the file system) is reported with
W180 and exit code 1, by every command that prints and every file that is written, and leaves no half file; a reader that goes
away is no error. Frames are counted before they run, numbers that are none are refused, no output is a file that the run reads,
folders of patterns are made, pictures of NaN are told, and a table that is missing is reported where somebody named it.

    outputs.py WEFT [--sanitized]
"""
import json
import math
import os
import pathlib
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import zlib

from program import SLOWER, TOP, Report, Run, count_run, run, temporary_folder
from window import display

GLOW, STUDIO = str(TOP / "graphs/glow.json"), str(TOP / "graphs/studio.json")
CRASH = re.compile(r"terminate called|Assertion|Segmentation|Aborted|what\(\):")
SMALL = ["--size", "64x36", "--program-cache", "none", "--quiet"]
ADD = 'out vec4 result;\nin vec2 uv;\nlayout(std140) uniform Parameters { float zero; };\n'
SOME = ADD + "void main() { result = vec4(gl_FragCoord.x > 4.0 && gl_FragCoord.x < 5.0 ? zero / zero : 0.5, gl_FragCoord.y < 1.0 ? 1.0 / zero : 0.5, 0.5, 1.0); }\n"


def plain(fmt="rgba16f", shader="some.frag.glsl", more=""):
    return f"""{{ "parameters": {{ "zero": {{ "type": "float", "default": 0 }}{more} }},
  "resources": {{ "hdr": {{ "texture": "{fmt}", "size": "screen" }} }},
  "passes": [ {{ "name": "paint", "type": "fullscreen", "shader": "{shader}", "write": {{ "result": "hdr" }},
                 "parameters": {{ "zero": "$zero" }} }} ],
  "present": "hdr" }}
"""


class Hostile:
    def __init__(self, weft, folder, report):
        self.weft, self.folder, self.report = weft, folder, report

    def run(self, *arguments, **options):
        """As program.run, in the test's folder; streams and limits may be given."""
        if options:
            options = {"cwd": self.folder, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "errors": "replace", "timeout": 900 * SLOWER, **options}
            count_run()
            done = subprocess.run([str(self.weft), *map(str, arguments)], **options)
            done.stdout, done.stderr = done.stdout or "", done.stderr or ""
            found = Run(done)
        else:
            found = run(self.weft, *arguments, folder=self.folder)
        self.report.check(found.code >= 0 and not CRASH.search(found.out + found.err), f"{self.name(arguments)}: crash, {found.code}\n{found.err}")
        return found

    def name(self, arguments):
        return "weft " + " ".join(str(a).replace(str(TOP) + "/", "") for a in arguments)

    def refused(self, code, *arguments, says="", exit_code=1, **options):
        done = self.run(*arguments, **options)
        good = done.code == exit_code and (code is None or done.codes() == [code]) and says in done.err
        self.report.check(good, f"{self.name(arguments)}: not {exit_code}, {code}, {says!r} but {done.code}: {done.out}{done.err}")
        return done

    def works(self, *arguments, **options):
        done = self.run(*arguments, **options)
        self.report.check(done.code == 0, f"{self.name(arguments)}: {done.code}\n{done.err}")
        return done

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def files(self, *left_out):
        return {str(p.relative_to(self.folder)): p.read_bytes() for p in self.folder.rglob("*") if p.is_file() and p.name not in left_out}


def small_files(size):
    """No file that the program writes grows beyond `size` bytes: a full disk that needs no rights."""
    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)
    return limit


def printing(test):
    report = test.report
    commands = [["plan", GLOW], ["plan", GLOW, "--format", "json", "--explain"], ["dot", GLOW], ["params", STUDIO], ["params", STUDIO, "--json"],
                ["presets"], ["presets", "--json"], ["types"], ["schema"], ["check", GLOW, "--no-shaders"], ["--help"], ["render", "--help"],
                ["--version"]]
    for command in commands:
        whole = test.works(*command)
        report.check(whole.out, f"{test.name(command)} prints nothing")
        with open("/dev/full", "w") as full:
            test.refused("W180", *command, stdout=full, says="standard output: No space left on device")
        test.refused("W180", *command, stdout=None, preexec_fn=lambda: os.close(1), says="standard output: Bad file descriptor")
        left, right = os.pipe()
        os.close(left)
        gone = test.run(*command, stdout=right)
        os.close(right)
        report.check(gone.code == 141 and not gone.err, f"{test.name(command)}, its reader gone: {gone.code}\n{gone.err}")
        with open("/dev/full", "w") as full:
            quiet = test.run(*command, stderr=full)
            report.check(quiet.code == 0 and quiet.out == whole.out, f"{test.name(command)} needs standard error")
    # Messages and counters that nobody can read are no success either.
    with open("/dev/full", "w") as full:
        lost = test.run("render", GLOW, *SMALL, "-o", "stats.png", "--stats", stderr=full)
        report.check(lost.code == 1 and (test.folder / "stats.png").exists(), f"--stats to a full device: {lost.code}")
        wrong = test.run("render", GLOW, "--frames", "x", "-o", "a.png", stderr=full)
        report.check(wrong.code == 2, f"a wrong option, told to a full device: {wrong.code}")
    left, right = os.pipe()
    os.close(left)
    test.works("render", GLOW, *SMALL[:-1], "-o", "bar_%d.png", "--frames", "0:2", stderr=right)
    os.close(right)


def full_disk(test):
    report = test.report
    for name in ("full.png", "full.exr"):
        (test.folder / name).symlink_to("/dev/full")
    for name in ("full.png", "full.exr"):
        test.refused("W180", "render", GLOW, *SMALL, "-o", name, says="No space left on device")
    before = test.files("fine.png")
    limited = {"preexec_fn": small_files(4096)}
    test.refused("W180", "render", GLOW, *SMALL, "-o", "large.exr", says="File too large", **limited)
    report.check(test.files("fine.png") == before, f"half files are left: {sorted(set(test.files()) - set(before))}")
    # A cache that cannot be written is slow and not wrong.
    cache = test.folder / "cache"
    done = test.works("render", GLOW, "--size", "16x9", "--quiet", "-o", "cached.png", "--program-cache", cache, **{"preexec_fn": small_files(2048)})
    left = [p.name for p in cache.rglob("*") if p.is_file()]
    report.check(not done.err and all(p.endswith(".bin") for p in left), f"the program cache on a full disk: {left}\n{done.err}")
    again = test.works("render", GLOW, "--size", "16x9", "--quiet", "--stats", "-o", "again.png", "--program-cache", cache)
    report.check(json.loads(again.err)["programs"]["binary_rejects"] == 0, f"half binaries: {again.err}")
    report.check((test.folder / "cached.png").read_bytes() == (test.folder / "again.png").read_bytes(), "other pixels")
    test.refused("W180", "render", GLOW, *SMALL, "-o", "n" * 300 + ".png")


def counts(test):
    far = "4294967295"
    test.works("dump", GLOW, "ldr", *SMALL, "--frames", far, "-o", "last", timeout=300)
    test.works("render", GLOW, *SMALL, "--frames", "0:3", "-o", "f_%d.png")
    test.works("render", GLOW, *SMALL, "--frames", f"4294967294:{far}", "-o", "last_%d.png")
    test.report.check((test.folder / f"last_{far}.png").exists(), "the last frame there is")
    for bad in ("4294967296", "0:4294967296", "-1", "1:0", "1e3", ""):
        test.refused(None, "render", GLOW, *SMALL, "--frames", bad, "-o", "f_%d.png", exit_code=2, says="--frames")
    for bad in ("4294967296", "-1", "nan", "1e3"):
        test.refused(None, "view", GLOW, "--max-frames", bad, exit_code=2, says="expected a number of frames")


def numbers(test):
    for bad in ("nan", "inf", "-inf", "NAN", "1e999", "0", "60fps", ""):
        test.refused(None, "render", GLOW, *SMALL, "--fps", bad, "-o", "a.png", exit_code=2, says=f"expected a number from 1 to 1000, found '{bad}'")
        test.refused(None, "view", GLOW, "--fps", bad, exit_code=2, says="expected a number from 1 to 1000")
        test.refused(None, "view", GLOW, "--render-scale", bad, exit_code=2, says="expected a number from 0.1 to 4")
        test.refused(None, "view", GLOW, "--ui-scale", bad, exit_code=2, says="expected a number from 0.25 to 8")
    test.works("render", GLOW, *SMALL, "--fps", "23.976", "-o", "fps.png")
    for bad in ("nan", "inf", "-inf", "1e999", "-1e999"):
        done = test.refused("W047", "render", STUDIO, *SMALL, "--set", f"exposure={bad}", "-o", "a.png", says=f"command line: --set exposure={bad}")
        test.report.check("expected: a number from -10 to 10" in done.err and "did you mean" not in done.err, f"--set exposure={bad}: {done.err}")
    test.refused("W047", "render", STUDIO, *SMALL, "--set", "lift=[0, nan, 0]", "-o", "a.png")


def overwriting(test):
    report, folder = test.report, test.folder
    top = folder / "own"
    for part in ("graphs", "shaders", "scenes", "materials"):
        shutil.copytree(TOP / part, top / part)
    (top / "map.exr").write_bytes(b"")
    hdr = top / "sun.hdr"
    hdr.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n" + bytes([128, 128, 128, 128]) * 8)
    graph, post = top / "graphs/studio.json", top / "graphs/post.json"
    shader = top / "shaders/composite/composite.frag.glsl"
    preset = next((top / "graphs/presets").glob("*.json"))
    scene, materials = top / "scenes/spheres.json", top / "materials/pbr_materials.json"
    cube = test.write("own/table.cube", "LUT_3D_SIZE 2\n" + "".join(f"{r} {g} {b}\n" for b in (0, 1) for g in (0, 1) for r in (0, 1)))
    (top / "linked.json").symlink_to(post)
    linked = top / "picture.png"
    linked.symlink_to(shader)
    before = test.files()
    own = ["render", graph, *SMALL, "--scene", scene, "--environment", hdr, "--preset", preset, "--set", f"lut={cube}", "--materials", materials]
    for target in (graph, post, shader, preset, scene, materials, cube, hdr, top / "linked.json",
                   top / "graphs/../graphs/studio.json"):
        over = folder / "over.png"
        over.symlink_to(target)
        test.refused("W180", *own, "-o", over, says="which this run reads", env={**os.environ, "WEFT_DATA": str(top)})
        over.unlink()
    test.refused("W180", *own, "-o", linked, says="-o would write over", env={**os.environ, "WEFT_DATA": str(top)})
    report.check(test.files() == before, "something was written")
    for other in ("same.png", "./same.png", folder / "same.png", "own/../same.png"):
        test.refused("W180", "render", GLOW, *SMALL, "-o", "same.png", "-o", f"scene={other}", says="would write one file")
    test.refused("W180", "render", GLOW, *SMALL, "-o", "p_%03d.png", "--frames", "0:2", "-o", "scene=p_%03d.png", says="would write one file")
    test.works("render", GLOW, *SMALL, "-o", "p_%03d.png", "--frames", "0:1")  # what is there already is replaced
    return top


def folders(test):
    report, folder = test.report, test.folder
    test.works("render", GLOW, *SMALL, "-o", "deep/%04d/f.png", "--frames", "0:2")
    test.works("render", GLOW, *SMALL, "-o", "a/b/f_%04d.exr", "--frames", "5:6")
    test.works("render", GLOW, *SMALL, "-o", "c/d/f.png")
    for name in ("deep/0000/f.png", "deep/0001/f.png", "deep/0002/f.png", "a/b/f_0005.exr", "a/b/f_0006.exr", "c/d/f.png"):
        report.check((folder / name).exists(), f"{name} is missing")
    test.write("deep2/2", "a file where a folder is to be")
    test.refused("W180", "render", GLOW, *SMALL, "-o", "deep2/%d/f.png", "--frames", "0:4", says="cannot make the folder 'deep2/2'")
    for bad in ("x_%s.png", "x_%n.png", "x_%d_%d.png", "%d/x_%d.png", "x_%.png", "x_%", "x_%4x.png", "x_%*d.png", "x_%0999d.png", "x_%%.png"):
        for frames in (["--frames", "0:1"], []):
            test.refused("W180", "render", GLOW, *SMALL, "-o", bad, *frames, says="is no pattern for frame numbers")
    test.refused("W180", "render", GLOW, *SMALL, "-o", "x.png", "--frames", "0:1", says="several frames would all be written to 'x.png'")
    report.check(not list(folder.glob("x*")), "something was written")


def exr_values(path):
    """All floats of an .exr of 32-bit scanlines, as the format's specification says: ZIP or none."""
    data, at, attributes = path.read_bytes(), 8, {}
    while data[at]:
        name, kind, rest = data[at:].split(b"\0", 2)
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    left, low, right, high = struct.unpack("<4i", attributes[b"dataWindow"])
    lines = {0: 1, 2: 1, 3: 16}[attributes[b"compression"][0]]
    chunks = (high - low) // lines + 1
    values = []
    for offset in struct.unpack_from(f"<{chunks}Q", data, at + 1):
        size = struct.unpack_from("<i", data, offset + 4)[0]
        block = data[offset + 8:offset + 8 + size]
        try:
            packed = bytearray(zlib.decompress(block))
        except zlib.error:
            packed = None  # it was not worth packing
        if packed is not None:
            for i in range(1, len(packed)):
                packed[i] = (packed[i - 1] + packed[i] - 128) & 255
            half = (len(packed) + 1) // 2
            block = bytearray(len(packed))
            block[0::2], block[1::2] = packed[:half], packed[half:]
        values += struct.unpack(f"<{len(block) // 4}f", block)
    return values


def strange_pixels(test):
    report, folder = test.report, test.folder
    test.write("shaders/some.frag.glsl", SOME)
    for fmt in ("rgba16f", "rgba32f"):
        graph = test.write(f"{fmt}.json", plain(fmt))
        for kind in ("png", "exr"):
            output = folder / f"{fmt}.{kind}"
            done = test.works("render", graph, "--size", "8x4", "-o", output, "--stats", "--program-cache", "none")
            # Column 4 is NaN, 4 pixels; the lowest row infinite in 8, of which one is NaN as well.
            report.check(done.codes("warning") == ["W207"] and len(done.diagnostics) == 1, f"{output.name}: {done.err}")
            report.check("11 pixels of the picture are NaN or infinite, the first at x 4, y 0 from the upper left" in done.err, f"{output.name}: {done.err}")
            report.check("found: NaN in 4 and infinity in 7" in done.err and "resource: hdr" in done.err, f"{output.name}: {done.err}")
            stats = json.JSONDecoder().raw_decode(done.err[done.err.index("{"):])[0]["pictures"] if "{" in done.err else {}
            report.check(stats == {"written": 1, "with_nan_or_infinity": 1, "pixels_nan_or_infinite": 11}, f"{output.name}: {stats}")
            report.check(output.exists(), f"{output.name} is not written")
        several = test.works("render", graph, "--size", "8x4", "-o", f"{fmt}_%d.png", "--frames", "0:4", "--quiet", "--program-cache", "none")
        report.check(several.err.count("W207") == 1 and f"{fmt}_0.png: warning" in several.err and "4 more of the pictures" in several.err, several.err)
        fine = test.works("render", graph, "--size", "8x4", "-o", "fine.exr", "--set", "zero=1", "--program-cache", "none")
        report.check(not fine.err, fine.err)
        values = exr_values(folder / f"{fmt}.exr")
        report.check(sum(math.isnan(v) for v in values) == 4 and sum(math.isinf(v) for v in values) == 8, f"{fmt}.exr: other values: {values}")
    # 8 bits hold no NaN: nothing to tell, whatever the driver makes of it.
    eight = test.works("render", test.write("rgba8.json", plain("rgba8")), "--size", "8x4", "-o", "eight.png", "--stats", "--program-cache", "none")
    report.check(not eight.diagnostics and '"with_nan_or_infinity": 0' in eight.err, eight.err)


def missing_tables(test):
    test.write("preset.json", '{\n  "set": {\n    "exposure": 1,\n    "lut":   "tables/missing.cube"\n  }\n}\n')
    done = test.refused("W001", "check", STUDIO, "--preset", "preset.json", "--no-shaders", says="tables/missing.cube': no such file")
    test.report.check("preset.json:4:14: error[W001]" in done.err, done.err)
    test.refused("W001", "check", STUDIO, "--set", "lut=missing.cube", "--no-shaders", says="command line: --set lut=missing.cube: error[W001]")
    # The last word is what is reported.
    test.refused("W001", "check", STUDIO, "--preset", "preset.json", "--set", "lut=other.cube", "--no-shaders",
                 says="command line: --set lut=other.cube: error[W001]")
    text = plain(more=',\n    "table": { "type": "file", "default": "none.cube" }').replace(
        '"resources": {', '"resources": {\n    "cube": { "import": "cube_lut", "file": "$table" },')
    text = text.replace('"write": { "result"', '"read": { "cube": "cube as linear" }, "write": { "result"')
    test.write("default.json", text)
    done = test.refused("W001", "check", "default.json", "--no-shaders")
    test.report.check("default.json:2:43: error[W001]" in done.err, done.err)
    test.write("good.cube", "LUT_3D_SIZE 2\n" + "0 0 0\n" * 8)
    test.works("check", STUDIO, "--set", "lut=good.cube", "--no-shaders")


def viewer(test, top):
    report, folder = test.report, test.folder
    bare = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
    told = test.refused("W110", "view", GLOW, "--program-cache", "none", exit_code=3, env=bare, says="xvfb-run -a")
    report.check("osmesa" not in told.err and "weft render" in told.err, told.err)
    told = test.refused(None, "view", GLOW, "--backend", "osmesa", "--program-cache", "none", exit_code=2, env=bare, says="needs a window")
    report.check("xvfb-run -a" in told.err, told.err)
    for bad in ("r_%s.png", "r.png", "r_%d.gif"):
        test.refused("W180", "view", GLOW, "--record", bad, env=bare)
    with display() as environment:
        view = {"env": environment}
        short = ["view", GLOW, "--size", "64x36", "--program-cache", "none", "--no-ui"]
        for name in ("full.png", "full.exr"):
            test.refused("W180", *short, "--max-frames", "2", "--screenshot", name, says="No space left on device", **view)
        (folder / "rec").mkdir()
        (folder / "rec/f_1.png").symlink_to("/dev/full")
        test.refused("W180", *short, "--max-frames", "3", "--record", "rec/f_%d.png", says="No space left on device", **view)
        report.check((folder / "rec/f_0.png").exists() and not (folder / "rec/f_2.png").exists(), "a recording ends where the disk is full")
        own = ["view", top / "graphs/glow.json", *short[2:]]
        own_view = {"env": {**environment, "WEFT_DATA": str(top)}}
        for target in (top / "graphs/glow.json", top / "shaders/composite/composite.frag.glsl", top / "scenes/spheres.json"):
            before = target.read_bytes()
            link = folder / "over.png"
            link.symlink_to(target)
            test.refused("W180", *own, "--max-frames", "2", "--screenshot", link, says="which this run reads", **own_view)
            link.unlink()
            report.check(target.read_bytes() == before, f"{target} is written over")
        link = folder / "shot.png"
        link.symlink_to(top / "graphs/glow.json")
        test.refused("W180", *own, "--max-frames", "2", "--screenshot", link, says="which this run reads", **own_view)
        test.refused("W180", *short, "--max-frames", "2", "--screenshot", "h_1.png", "--record", "h_%d.png", says="would write one file", **view)
        test.works(*short, "--max-frames", "2", "--record", "%d/g/f.png", **view)
        report.check((folder / "0/g/f.png").exists() and (folder / "1/g/f.png").exists(), "a recording into many folders")
        strange = test.works("view", "rgba16f.json", *short[2:], "--max-frames", "3", "--screenshot", "strange_%02d.exr", "--record", "strange/%d.png", **view)
        report.check(strange.err.count("W207") == 2 and "strange_02.exr: warning[W207]" in strange.err and "2 more of the pictures" in strange.err, strange.err)
        report.check((folder / "strange_02.exr").exists(), "a screenshot of NaN")


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    if not shutil.which("Xvfb"):
        report.skip("Xvfb is not installed")
    with temporary_folder() as name:
        test = Hostile(weft, pathlib.Path(name), report)
        (test.folder / "shaders").mkdir()
        printing(test)
        full_disk(test)
        counts(test)
        numbers(test)
        top = overwriting(test)
        folders(test)
        strange_pixels(test)
        missing_tables(test)
        viewer(test, top)
    report.end()


main()
