#!/usr/bin/env python3
"""`render -o NAME=FILE`, `render --present NAME` and `dump`: what is written has the values that the shaders compute, judged by
tests/app/pictures.py; also of textures that nothing else reads, of whole numbers, depth, versions and levels. And progress on a pipe.

    dump.py WEFT
"""
import os
import pathlib
import re
import struct
import sys

from pictures import read_exr, read_png
from program import Report, run, temporary_folder

GRAPH = """{
  "resources": {
    "hdr":   { "texture": "rgba32f", "size": [8, 4] },
    "ids":   { "texture": "r32ui", "size": [8, 4] },
    "deep":  { "texture": "depth32f", "size": [8, 4] },
    "pair":  { "texture": "rg32f", "size": [8, 4] },
    "chain": { "texture": "r32f", "size": [8, 4], "mips": 3, "layers": 2 },
    "table": { "buffer": 16 },
    "ldr":   { "texture": "rgba8", "size": [8, 4] } },
  "passes": [
    { "name": "ramp", "type": "fullscreen", "shader": "ramp.frag.glsl", "write": { "result": "hdr", "ids": "ids", "pair": "pair" } },
    { "name": "deep", "type": "fullscreen", "shader": "deep.frag.glsl", "write": { "depth": "deep" }, "state": { "depth_test": "always" } },
    { "name": "chain", "type": "fullscreen", "shader": "level.frag.glsl", "repeat": { "l": [0, 1], "m": [0, 2] },
      "write": { "result": "chain.mip[m].layer[l]" }, "parameters": { "amount": "10 * l + m" } },
    { "name": "table", "type": "compute", "shader": "table.comp.glsl", "threads": 4, "write": { "table": "table" } },
    { "name": "double", "type": "fullscreen", "shader": "double.frag.glsl", "read": { "source": "hdr" }, "write": { "result": "hdr" } },
    { "name": "add", "type": "fullscreen", "shader": "level.frag.glsl", "modify": { "result": "hdr" }, "state": { "blend": "add" },
      "parameters": { "amount": 100 } },
    { "name": "show", "type": "fullscreen", "shader": "show.frag.glsl", "read": { "source": "hdr" }, "write": { "result": "ldr" } } ],
  "present": "ldr" }
"""
SHADERS = {
    "ramp.frag.glsl": "#ifdef HAS_IDS\nout uint ids;\n#endif\n#ifdef HAS_PAIR\nout vec2 pair;\n#endif\nout vec4 result;\nvoid main() {\n"
                      "  vec2 p = floor(gl_FragCoord.xy);\n  result = vec4(p, 0.5, 1.0);\n#ifdef HAS_IDS\n  ids = uint(p.x) + 8u * uint(p.y);\n#endif\n"
                      "#ifdef HAS_PAIR\n  pair = vec2(p.y, -p.x);\n#endif\n}\n",
    "deep.frag.glsl": "void main() { gl_FragDepth = floor(gl_FragCoord.x) / 8.0; }\n",
    "level.frag.glsl": "layout(std140) uniform Parameters { float amount; };\nout vec4 result;\nvoid main() { result = vec4(amount); }\n",
    "table.comp.glsl": "layout(local_size_x = 4) in;\nlayout(std430) buffer table { uint values[]; };\n"
                       "void main() { values[gl_GlobalInvocationID.x] = 3u * gl_GlobalInvocationID.x + 7u; }\n",
    "double.frag.glsl": "uniform sampler2D source;\nout vec4 result;\nvoid main() { result = 2.0 * texelFetch(source, ivec2(gl_FragCoord.xy), 0); }\n",
    "show.frag.glsl": "uniform sampler2D source;\nout vec4 result;\nvoid main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0) / 255.0; }\n",
}
RAMP = [[(float(x), float(3 - y), 0.5, 1.0) for x in range(8)] for y in range(4)]
DOUBLED = [[tuple(2 * c for c in t) for t in row] for row in RAMP]
ADDED = [[tuple(c + 100 for c in t) for t in row] for row in DOUBLED]


class Bench:
    def __init__(self, weft, folder, report):
        self.weft, self.folder, self.report = weft, folder, report
        (folder / "shaders").mkdir()
        for name, text in SHADERS.items():
            (folder / "shaders" / name).write_text(text)
        (folder / "graph.json").write_text(GRAPH)

    def command(self, command, *arguments):
        return run(self.weft, command, self.folder / "graph.json", "--quiet", *arguments)

    def is_exr(self, name, wanted, label):
        file = self.folder / name
        got = read_exr(file.read_bytes()) if file.exists() else "no file"
        self.report.check(got == wanted, f"{label}: {got} instead of {wanted}")

    def bytes_of(self, name):
        file = self.folder / name
        return file.read_bytes() if file.exists() else None


def check_outputs(bench):
    folder, wanted = bench.folder, {
        "hdr": ADDED, "hdr#1": RAMP, "hdr#2 after double": DOUBLED, "ids": [[(float(x + 8 * (3 - y)),) for x in range(8)] for y in range(4)],
        "deep": [[(x / 8,) for x in range(8)]] * 4, "pair": [[(float(3 - y), float(-x), 0.0) for x in range(8)] for y in range(4)],
        "chain.mip[1].layer[1]": [[(11.0,)] * 4] * 2}
    outputs = [argument for i, name in enumerate(wanted) for argument in ("-o", f"{name}={folder}/o{i}.exr")]
    ran = bench.command("render", "-o", folder / "plain.png", *outputs)
    bench.report.check(ran.code == 0 and not ran.codes(), f"several outputs: {ran.code} {ran.err}")
    for i, (name, rows) in enumerate(wanted.items()):
        bench.is_exr(f"o{i}.exr", rows, f"-o {name}=o{i}.exr")
    plain = bench.bytes_of("plain.png")
    alone = bench.command("render", "-o", folder / "alone.png")
    bench.report.check(alone.code == 0 and plain and plain == bench.bytes_of("alone.png"), f"the picture beside other outputs is another: {alone.err}")
    ran = bench.command("render", "-o", f"ids={folder}/f_%02d.exr", "--frames", "3:4")
    bench.report.check(ran.code == 0, f"frames of a texture: {ran.err}")
    for frame in (3, 4):
        bench.is_exr(f"f_{frame:02}.exr", wanted["ids"], f"frame {frame}")


def check_present(bench):
    folder = bench.folder
    ran = bench.command("render", "--present", "deep", "-o", folder / "deep.png")
    bench.report.check(ran.code == 0, f"--present deep: {ran.err}")
    rows = read_png(bench.bytes_of("deep.png"))
    # The range of what is there, 0 to 7/8, from black to white.
    bench.report.check(all(abs(t[c] - 255 * x / 7) <= 1 for row in rows for x, t in enumerate(row) for c in range(3)), f"depth as a picture: {rows[0]}")
    ran = bench.command("render", "--present", "ids", "-o", folder / "ids.png", "-o", f"deep={folder}/deep_too.png")
    rows = read_png(bench.bytes_of("ids.png"))
    bench.report.check(ran.code == 0 and all(abs(t[0] - 255 * (x + 8 * (3 - y)) / 31) <= 1 for y, row in enumerate(rows) for x, t in enumerate(row)),
                       f"whole numbers as a picture: {ran.err} {rows}")
    bench.report.check(bench.bytes_of("deep.png") == bench.bytes_of("deep_too.png"), "-o deep=FILE is another picture than --present deep")


def check_dump(bench):
    folder = bench.folder
    ran = run(bench.weft, "dump", folder / "graph.json", "hdr*", "-o", folder / "dumped")
    listed = sorted(line.split("  ")[0] for line in ran.out.splitlines())
    names = [pathlib.Path(name).name for name in listed]
    bench.report.check(ran.code == 0 and len(names) == 3, f"the versions of hdr, each after each writer: {ran.code} {names} {ran.err}")
    found = {kind: next((f"dumped/{name[:-4]}.exr" for name in names if kind in name), "none") for kind in ("hdr_ramp", "hdr-2_double", "hdr-2_add")}
    for (kind, name), rows in zip(found.items(), (RAMP, DOUBLED, ADDED)):
        bench.is_exr(name, rows, f"dump of {kind}")
    for pick, name in (("hdr#1", "hdr_ramp"), ("hdr after double", "hdr-2_double"), ("hdr", "hdr-2_add")):
        bench.command("render", "--present", pick, "-o", folder / "pick.png")
        bench.report.check(bench.bytes_of("pick.png") and bench.bytes_of("pick.png") == bench.bytes_of(found[name].replace(".exr", ".png")),
                           f"--present '{pick}' is another picture than the dump of {name}")
    text = GRAPH.replace('"threads": 4,', '"threads": 4, "side_effect": true,').replace('"repeat": { "l"', '"side_effect": true, "repeat": { "l"')
    (folder / "all.json").write_text(text)
    ran = run(bench.weft, "dump", folder / "all.json", "table", "ch?in", "-o", folder / "all", "--frames", "2", "--quiet")
    made = sorted(file.name for file in (folder / "all").iterdir()) if ran.code == 0 else []
    bench.report.check(ran.code == 0 and not ran.out and len(made) == 13, f"a table and six levels: {made} {ran.err}")
    table = [file for file in made if file.endswith(".bin")]
    bench.report.check(len(table) == 1 and bench.bytes_of(f"all/{table[0]}") == struct.pack("<4I", 7, 10, 13, 16), f"the bytes of a buffer: {table}")
    level = [file for file in made if ".mip2.layer1.exr" in file]
    if bench.report.check(len(level) == 1, f"the last level of the second layer: {made}"):
        bench.is_exr(f"all/{level[0]}", [[(12.0,)] * 2], "the last level of the second layer")


def check_mistakes(bench):
    def refuses(code, words, *arguments, exit_code=1):
        ran = bench.command(*arguments)
        bench.report.check(ran.code == exit_code and all(word in ran.err for word in words) and (not code or ran.codes() == [code]),
                           f"{arguments}: exit code {ran.code}, not {exit_code} and {code} with {words}\n{ran.err}")

    file = bench.folder / "x.exr"
    refuses("W040", ["'hrd'", "did you mean 'hdr'"], "render", "-o", f"hrd={file}")
    refuses("W052", ["#1 to #2"], "render", "-o", f"hdr#3={file}")
    refuses("W052", ["level 0 to 2"], "render", "-o", f"chain.mip[3]={file}")
    refuses("W054", ["history"], "render", "-o", f"hdr@-1={file}")
    refuses("W045", ["ramp"], "render", "-o", f"hdr#1 after add={file}")
    refuses("W180", ["is a buffer", "weft dump"], "render", "-o", f"table={file}")
    refuses("W180", ["unknown kind of image"], "render", "-o", f"hdr={bench.folder}/x.gif")
    refuses("W180", ["would write one file"], "render", "-o", f"hdr={file}", "-o", f"ids={file}")
    refuses("W040", ["'hd-r' cannot name a resource", "did you mean 'hdr'", "./a=b.png"], "render", "-o", f"hd-r={file}")
    refuses("W040", ["'hdr.mip[x]' cannot name a resource", "'glow.mip[2]'"], "render", "-o", f"hdr.mip[x]={file}")
    refuses("W040", ["'nothing*'"], "dump", "nothing*", "-o", bench.folder / "none")
    refuses("W040", ["nobody reads it", "'chain'"], "dump", "hdr", "chain", "-o", bench.folder / "none")
    refuses("W040", ["nobody reads it", "render -o ids="], "dump", "ids", "-o", bench.folder / "none")  # its pass runs
    refuses(None, ["NAME=FILE"], "render", "-o", "a.png", "-o", "b.png", exit_code=2)
    refuses(None, ["-o FILE"], "render", "--present", "hdr", "-o", f"ids={file}", exit_code=2)
    refuses(None, ["--present takes"], "render", "--present", "hdr.mip[x]", "-o", file, exit_code=2)
    bench.report.check(not file.exists(), "something was written after an error")
    ran = bench.command("render", "-o", bench.folder / "a=b.exr")
    bench.report.check(ran.code == 0 and (bench.folder / "a=b.exr").exists(), f"a path with = in it: {ran.code} {ran.err}")


def check_places(bench):
    """What dump finds in its folder is neither waited for nor an input that it writes over, and a name of a folder forges no line."""
    folder = bench.folder / "places"

    def dump(into):
        return run(bench.weft, "dump", bench.folder / "graph.json", "hdr", "-o", into, timeout=60)

    names = [pathlib.Path(line.split("  ")[0]).name for line in dump(folder).out.splitlines()]
    bench.report.check(len(names) == 3 and all(name.endswith(".png") for name in names), f"{names}")
    spot = folder / names[1]
    before = (bench.folder / "shaders/double.frag.glsl").read_bytes()
    for made, says in ((os.mkfifo, "a pipe"), (os.mkdir, "a folder"), (lambda path: os.symlink("/dev/null", path), "is a link"),
                       (lambda path: os.symlink(bench.folder / "shaders/double.frag.glsl", path), "is a link")):
        spot.unlink()
        made(spot)
        ran = dump(folder)
        bench.report.check(ran.code == 1 and ran.codes() == ["W180"] and says in ran.err and str(spot) in ran.err, f"{says} in the folder: {ran.code} {ran.err}")
        if says == "a folder":
            spot.rmdir()
            spot.touch()
    bench.report.check((bench.folder / "shaders/double.frag.glsl").read_bytes() == before, "dump wrote over a shader")
    forged = dump(bench.folder / "a\x1b[31mb\nc")
    bench.report.check(forged.code == 0 and "\x1b" not in forged.out and len(forged.out.splitlines()) == 3, f"{forged.out!r} {forged.err}")


def check_progress(bench):
    ran = run(bench.weft, "render", bench.folder / "graph.json", "-o", bench.folder / "p_%d.png", "--frames", "0:5")
    bench.report.check(ran.code == 0 and "frames" not in ran.err and not set("\r\x1b") & set(ran.err), f"a quick run says nothing on a pipe: {ran.err!r}")


def main():
    report = Report()
    with temporary_folder() as name:
        bench = Bench(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(name), report)
        for check in (check_outputs, check_present, check_dump, check_mistakes, check_places, check_progress):
            check(bench)
    report.end()


main()
