#!/usr/bin/env python3
"""Broken files of every kind, and wrong arguments: each run exits as expected with exactly the expected diagnostics, at a
place, writes nothing, and neither crashes nor prints anything else. With --sanitized the binary was built with
AddressSanitizer and UBSan, whose reports are failures too.

    broken_inputs.py WEFT [--sanitized]
"""
import os
import pathlib
import re
import struct
import sys

from program import TOP, Report, run, temporary_folder

GLOW, STUDIO = str(TOP / "graphs/glow.json"), str(TOP / "graphs/studio.json")
CRASH = re.compile(r"AddressSanitizer|LeakSanitizer|runtime error:|terminate called|Assertion|Segmentation|Aborted|what\(\):|^\s*#\d+ 0x", re.M)


def graph(size='"screen"', extra="", shader="sky/sky.frag.glsl", write="ldr", more="", resources=""):
    return f"""{{ "name": "broken",
  "resources": {{
    "ldr": {{ "texture": "rgba8", "size": {size}{extra} }}{resources} }},
  "passes": [
    {{ "name": "sky", "type": "fullscreen", "shader": "{shader}",
      "read": {{ "environment": "@environment" }}, "write": {{ "radiance": "{write}" }}{more} }} ],
  "present": "ldr" }}
"""


def shows(picture):
    return f"""{{ "resources": {{
    "photo": {{ "import": "image", "file": "{picture}" }}, "ldr": {{ "texture": "rgba8", "size": "screen" }} }},
  "passes": [ {{ "name": "show", "type": "blit", "read": {{ "source": "photo" }}, "write": {{ "destination": "ldr" }} }} ], "present": "ldr" }}
"""


SPHERE = '{ "spheres": [\n  { "center": [0, 0, 0], %s } ] }\n'
HDR_HEAD = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 128\n"

# Pictures that an import cannot take. (The texels of truncated.png cannot be read; of all others not even the header.)
PICTURES = (("W150", ("no_such.png", "shaders", "empty.hdr", "garbage.hdr", "truncated.hdr", "garbage.exr", "huge.exr", "truncated.png", "huge.png", "truncated.jpg",
                      "####.png")), ("W152", ("huge.hdr",)), ("W151", ("picture.gif",)))

# file -> contents
FILES = {
    "truncated.json": graph()[:150],
    "empty.json": "",
    "binary.json": b"\x89PNG\r\n\x1a\n\x00\xff\xfe",
    "deep.json": "[" * 100_000,
    "not_utf8.json": graph().replace("broken", "\udcff").encode("utf-8", "surrogateescape"),
    "number_for_string.json": graph().replace('"broken"', "42"),
    "list_for_object.json": graph(more=', "defines": ["A"]'),
    "object_for_size.json": graph(size='{ "width": 4 }'),
    "mips.json": graph(extra=', "mips": 1000000000', write="ldr.mip[0]"),
    "size.json": graph(size="1e9"),
    "layers.json": graph(extra=', "layers": 1e9'),
    "history.json": graph(extra=', "history": 1000000000'),
    "repeat.json": graph(more=', "repeat": { "i": [0, 1000000000] }'),
    "memory.json": graph(size="[16384, 16384]", extra=', "layers": 2000'),
    "block.json": graph(resources=',\n    "small": { "buffer": 64 }, "large": { "buffer": 2000000000 }',
                        more=' },\n    { "name": "fill", "type": "compute", "shader": "fill.comp.glsl", "threads": 1, "side_effect": true, "write": { "data": "large" }'),
    "shaders/fill.comp.glsl": "layout(local_size_x = 1) in;\nlayout(std430) buffer data { float values[]; };\nvoid main() { values[gl_GlobalInvocationID.x] = 1.0; }\n",
    "missing_shader.json": graph(shader="sky/no_such.frag.glsl"),
    "bad_shader.json": graph(shader="bad.frag.glsl"),
    "bad_include.json": graph(shader="include.frag.glsl"),
    "shaders/bad.frag.glsl": "uniform sampler2D environment;\nout vec4 radiance;\nvoid main() { radiance = nothing; }\n",
    "shaders/include.frag.glsl": '#include "no_such.glsl"\nuniform sampler2D environment;\nout vec4 radiance;\nvoid main() { radiance = vec4(1); }\n',
    "graph_and_shader.json": graph(shader="sky/no_such.frag.glsl").replace("rgba8", "rgba9"),
    "reserved_name.json": graph(write="ldrr").replace('"sky"', '"mip"'),
    "missing_include.json": graph(more=' }, { "include": "no_such.json"'),
    "misspelt_include.json": graph(more=' }, { "include": "lihgt.json"').replace("@environment", "light.map"),
    "light.json": '{ "passes": [] }',
    "own_include.json": graph(more=' }, { "include": "own_include.json"'),
    "unknown_key.json": graph(extra=', "formt": 1'),
    "unknown_resource.json": graph(write="ldrr"),
    "unknown_format.json": graph().replace("rgba8", "rgba9"),
    "nothing_presented.json": graph().replace(',\n  "present": "ldr"', ""),
    "zero_division.json": graph(size='"screen / 0"'),
    "truncated_scene.json": '{ "spheres": [',
    "unknown_material.json": SPHERE % '"material": "Unobtainium"',
    "negative_radius.json": SPHERE % '"radius": -1, "material": { "albedo": [1, 1, 1] }',
    "huge_grid.json": '{ "grid": { "count": [65536, 65536, 65536], "materials": ["m"] }, "materials": { "m": { "albedo": [1, 1, 1] } } }',
    "empty.hdr": b"",
    "garbage.hdr": bytes(range(256)) * 16,
    "truncated.hdr": HDR_HEAD + b"\x02\x02\x00\x80\x85\x11",
    "huge.hdr": HDR_HEAD.replace(b"64", b"1000000").replace(b"128", b"1000000"),
    "garbage.exr": b"\x76\x2f\x31\x01\x02\x00\x00\x00" + bytes(200),
    "huge.exr": b"\x76\x2f\x31\x01\x02\x00\x00\x00" + b"dataWindow\x00box2i\x00" + struct.pack("<i4i", 16, 0, 0, 2**31 - 1, 2**31 - 1) + b"\x00",
    "picture.gif": b"GIF89a",
    "truncated.png": (TOP / "tests/convert/references/mosaic.png").read_bytes()[:200],
    "huge.png": b"\x89PNG\r\n\x1a\n" + struct.pack(">I4s2I5B4x", 13, b"IHDR", 2**31 - 1, 2**31 - 1, 8, 6, 0, 0, 0),
    "truncated.jpg": b"\xff\xd8\xff\xe0\x00\x10JFIF\x00\x01\x01\x00\x00\x01\x00\x01\x00\x00\xff\xc0\x00\x0b\x08\x00\x10\x00\x10\x01\x01\x11\x00",
    **{f"{picture}.json": shows(picture) for _, pictures in PICTURES for picture in pictures},
    "truncated.fs": '/*{ "INPUTS": [ { "NAME": "a", "TYPE"',
    "deep.fs": "/*{ \"INPUTS\": " + "[" * 100_000 + "*/\nvoid main() {}\n",
    "binary.fs": b"\x00\xff\xfe{}*/" * 10,
    "stack.glsl": "//!HOOK MAIN\n//!BIND HOOKED\n//!WIDTH " + "HOOKED.w " * 10_000 + "\nvec4 hook() { return HOOKED_tex(HOOKED_pos); }\n",
    "texture.glsl": "//!TEXTURE T\n//!SIZE 1000000 1000000\n//!FORMAT rgba16f\n00\n\n//!HOOK MAIN\n//!BIND T\nvec4 hook() { return vec4(0.0); }\n",
    "short.cube": "LUT_3D_SIZE 2\n0 0 0\n1 1 1\n",
    "sun.hdr": b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n" + bytes([128, 128, 128, 160]) + bytes([128, 128, 128, 128]) * 7,
    "no_dollar.json": graph(more=', "enabled": "fog"').replace('"resources"', '"parameters": { "fog": { "default": true } }, "resources"', 1),
    "scren.json": graph(size='"scren/2"'),
    "swapped.json": graph().replace('"radiance": "ldr"', '"ldr": "radiance"'),
    "unit.json": graph(size='"screen px"'),
    "mips_word.json": graph(write="ldr.mips[0]"),
    "stage.json": graph(shader="sky/sky.glsl"),
    "a_file": "not a folder",
}

RENDER = ["--size", "64x36", "--program-cache", "none"]


def rendered(graph_file, *more):
    return ["render", graph_file, *RENDER, *(more if "-o" in more else ("-o", "out.png", *more))]


# (arguments, exit code, codes, places): all errors there are, as their codes and places with a space between. `place` is a regular expression for what stands before the severity. Code None: wrong
# usage, reported by the parser of the command line, where the place is the name of the option.
# A fifth element is text of the message.
CASES = [
    (rendered("truncated.json"), 1, "W002", r"truncated\.json:5:44"),
    (rendered("empty.json"), 1, "W002", r"empty\.json:1:1"),
    (rendered("binary.json"), 1, "W002", r"binary\.json:\d:1"),
    (rendered("deep.json"), 1, "W007", r"deep\.json:1:6\d"),
    (rendered("not_utf8.json"), 1, "W002", r"not_utf8\.json:1:1\d"),
    (rendered("no_such.json"), 1, "W001", r"no_such\.json"),
    (rendered("shaders"), 1, "W001", "shaders"),
    (["check", "shaders"], 1, "W001", "shaders"),
    (["check", "/dev/zero"], 1, "W001", "/dev/zero"),
    (["plan", "truncated.json"], 1, "W002", r"truncated\.json:5:44"),
    (["dot", "truncated.json"], 1, "W002", r"truncated\.json:5:44"),
    (rendered("number_for_string.json"), 1, "W003", r"number_for_string\.json:1:11"),
    (rendered("list_for_object.json"), 1, "W003", r"list_for_object\.json:6:93"),
    (rendered("object_for_size.json"), 1, "W003", r"object_for_size\.json:3:42"),
    (rendered("mips.json"), 1, "W048", r"mips\.json:3:60"),
    (rendered("size.json"), 1, "W048", r"size\.json:3:42"),
    (rendered("layers.json"), 1, "W048", r"layers\.json:3:62"),
    (rendered("history.json"), 1, "W048", r"history\.json:3:63"),
    (["check", "repeat.json", "--no-shaders"], 1, "W081", r"repeat\.json:\d+:\d+"),
    (rendered("memory.json"), 1, "W202", r"memory\.json:3:5"),
    (rendered("block.json"), 1, "W117", r"block\.json:4:32", "larger than a shader can see"),
    (rendered("missing_shader.json"), 1, "W100", r"missing_shader\.json:5:54"),
    (rendered("bad_shader.json"), 1, "W104", r"shaders/bad\.frag\.glsl:3:\d+"),
    # what is wrong with a graph does not hide its shaders, nor a bad name the rest of its pass
    (["check", "graph_and_shader.json"], 1, "W042 W100", r"graph_and_shader\.json:3:25 graph_and_shader\.json:5:54"),
    (["check", "reserved_name.json"], 1, "W012 W040", r"reserved_name\.json:5:15 reserved_name\.json:6:74"),
    (["check", "bad_shader.json"], 1, "W104", r"shaders/bad\.frag\.glsl:3:\d+"),
    (rendered("bad_include.json"), 1, "W101", r"shaders/include\.frag\.glsl:1:\d+"),
    (rendered("missing_include.json"), 1, "W001", r"missing_include\.json:6:\d+"),
    (rendered("misspelt_include.json"), 1, "W001", r"misspelt_include\.json:6:\d+", "did you mean 'light.json'?"),
    (rendered("misspelt_include.json", "--set", "gain=1", "--disable", "lamp"), 1, "W001", r"misspelt_include\.json:6:\d+"),
    (rendered("no_such/graph.json"), 1, "W001", r"no_such/graph\.json", "there is no folder 'no_such'"),
    (rendered(GLOW, "--preset", "cinemma"), 1, "W001", r".*/graphs/presets/cinemma\.json", "/graphs/presets/cinema.json'?"),
    (rendered("own_include.json"), 1, "W008", r"own_include\.json:6:\d+"),
    (rendered("unknown_key.json"), 1, "W004", r"unknown_key\.json:3:52"),
    (rendered("unknown_format.json"), 1, "W042", r"unknown_format\.json:3:25"),
    (rendered("zero_division.json"), 1, "W024", r"zero_division\.json:3:\d+"),
    (rendered("nothing_presented.json"), 1, "W188", r"nothing_presented\.json:1:1"),
    (rendered(str(TOP / "graphs/effects/fxaa.json")), 1, "W074", r".*/fxaa\.json:\d+:\d+"),
    *((rendered(GLOW, "--environment", image), 1, code, re.escape(image)) for code, images in (
        ("W150", ("no_such.hdr", "shaders", "empty.hdr", "garbage.hdr", "truncated.hdr", "garbage.exr", "huge.exr")),
        ("W152", ("huge.hdr",)), ("W151", ("picture.gif",))) for image in images),
    *((rendered(f"{picture}.json"), 1, code, rf"{re.escape(picture)}\.json:2:\d+", f"'{picture}'") for code, pictures in PICTURES for picture in pictures),
    *((["import", file, "-o", "imported"], 1, code, place) for file, code, place in (
        ("truncated.fs", "W220", r"truncated\.fs:1:1"), ("deep.fs", "W007", r"deep\.fs:1:\d+"), ("binary.fs", "W220", r"binary\.fs:1:1"),
        ("stack.glsl", "W225", r"stack\.glsl:3:\d+"), ("texture.glsl", "W225", r"texture\.glsl:2:1"), ("/dev/zero", "W001", "/dev/zero"))),
    (rendered(GLOW, "--scene", "no_such.json"), 1, "W001", r"no_such\.json"),
    (rendered(GLOW, "--scene", "shaders"), 1, "W001", "shaders"),
    (rendered(GLOW, "--scene", "truncated_scene.json"), 1, "W002", r"truncated_scene\.json:1:\d+"),
    (rendered(GLOW, "--scene", "unknown_material.json"), 1, "W161", r"unknown_material\.json:2:\d+"),
    (rendered(GLOW, "--scene", "negative_radius.json"), 1, "W160", r"negative_radius\.json:2:\d+"),
    (rendered(GLOW, "--scene", "huge_grid.json"), 1, "W160", r"huge_grid\.json:1:\d+"),
    *((rendered(GLOW, "-o", path), 1, "W180", re.escape(path)) for path in (
        "a_file/out.png", "/proc/out.png", "/proc/no/out.png", "shaders", "folder.png", "out.jpg")),
    (rendered(GLOW, "-o", "full.png"), 1, "W180", r"full\.png", "No space left on device"),
    (rendered(GLOW, "-o", "full.exr"), 1, "W180", r"full\.exr", "free some space"),
    *((rendered(GLOW, "-o", path, "--frames", "0:3"), 1, "W180", re.escape(path)) for path in ("out.png", "out_%s.png", "out_%d_%d.png")),
    (rendered(GLOW, "--set", "blom=false"), 1, "W044", "command line: --set blom=false", "did you mean 'bloom'?"),
    (rendered(STUDIO, "--set", "nosuch=1"), 1, "W044", "command line: --set nosuch=1", f"'weft params {STUDIO}' lists"),
    (rendered(GLOW, "--preset", "nosuch"), 1, "W001", r".*/graphs/presets/nosuch\.json", "cannot read"),
    (rendered(GLOW, "--preset", "no/such.json"), 1, "W001", r"no/such\.json", "there is no folder 'no'"),
    (rendered(STUDIO, "--set", "exposure="), 1, "W047", "command line: --set exposure=", "expected: a number from -10 to 10"),
    (rendered(STUDIO, "--set", "curve="), 1, "W047", "command line: --set curve=", "expected: one of linear, "),
    (rendered(GLOW, "--set", "bloom=maybe"), 1, "W047", "command line: --set bloom=maybe", "expected: true or false, as "),
    (rendered(GLOW, "--set", "bloom=yes"), 1, "W047", "command line: --set bloom=yes", "expected: true or false"),
    (rendered(GLOW, "--set", "bloom=0"), 1, "W047", "command line: --set bloom=0", "expected: true or false"),
    (rendered(GLOW, "--set", "threshold=99"), 1, "W048", "command line: --set threshold=99", "a number from 0 to 8, as "),
    (rendered(GLOW, "--set", "threshold=1,5"), 1, "W047", "command line: --set threshold=1,5", "a number from 0 to 8, as "),
    (rendered(GLOW, "--set", "threshold=2cd"), 1, "W047", "command line: --set threshold=2cd", "a number from 0 to 8, as "),
    (rendered(STUDIO, "--set", "subdivision=2.5"), 1, "W047", r"command line: --set subdivision=2\.5", "a whole number from 0 to 6, as "),
    (rendered(STUDIO, "--set", "curve=fimlic"), 1, "W047", "command line: --set curve=fimlic", "did you mean 'filmic'?"),
    (rendered(STUDIO, "--set", "lift=0,0,0"), 1, "W047", "command line: --set lift=0,0,0", "such as [0, 0, 0]"),
    (rendered(STUDIO, "--set", "lift=[0, 9, 0]"), 1, "W048", r"command line: --set lift=\[0, 9, 0\]", "a list of 3, each a number from -0.5 to 0.5"),
    (rendered(GLOW, "--disable", "compost"), 1, "W045", "command line: --disable compost", "did you mean 'composite'?"),
    (rendered(GLOW, "--disable", "bloom"), 1, "W084", "command line: --disable bloom", "--set bloom=VALUE"),
    (rendered(GLOW, "--disable", "composite"), 1, "W060", r".*/glow\.json:\d+:\d+"),
    (rendered(STUDIO, "--set", "lut=short.cube"), 1, "W154", r"short\.cube:3", "8 rows are needed"),
    (rendered(GLOW, "--backend", "vulkan"), 2, None, "--backend"),
    (rendered(GLOW, "--size", "0x36"), 2, None, "--size"),
    (rendered(GLOW, "--size", "99999x99999"), 2, None, "--size"),
    (rendered(GLOW, "--size", "large"), 2, None, "--size"),
    (rendered(GLOW, "--size", "32x18", "--size", "64x36"), 2, None, "--size: At Most 1 required"),
    # a variable of a script that is not set
    (["render", GLOW, "-o", ""], 2, None, "--output: expected the name of a file, found ''"),
    (["dump", GLOW, "*", "-o", ""], 2, None, "--output: expected the name of a folder, found ''"),
    (["new", "pass", "some", "--graph", GLOW, "-o", ""], 2, None, "--output: expected the name of a folder, found ''"),
    (["check", GLOW, "--scene", ""], 2, None, "--scene: expected the name of a file, found ''"),
    (["check", ""], 1, "W001", ".*", "the name is empty"),
    (["render", GLOW, "-o", "out.png", "--program-cache", GLOW], 2, None, "--program-cache", "is actually a file"),
    # a graph and a scene in each other's place
    (rendered(GLOW, "--scene", GLOW), 1, "W003", r".*/glow\.json:\d+:\d+", "it is a graph, not a scene"),
    (["new", "pass", "x", "-o", "made"], 1, "W012", "command line: new pass x", "none of the words mip, layer"),
    (["new", "pass", "a.b", "-o", "made"], 1, "W012", r"command line: new pass a\.b", "a letter, then letters, digits and '_'"),
    (rendered(GLOW, "--frames", "3:2"), 2, None, "--frames"),
    (rendered(GLOW, "--frames", "-1"), 2, None, "--frames"),
    (rendered(GLOW, "--set", "bloom"), 2, None, "--set"),
    (rendered(GLOW, "--frame", "5"), 2, None, "--frame"),
    (rendered(GLOW, "--sett=bloom=true"), 2, None, "--sett"),
    (rendered(GLOW, "--zzzzzzzz"), 2, None, "--zzzzzzzz"),
    # words that lost something, and no second message for what follows from the first
    (["check", "no_dollar.json"], 1, "W051", r"no_dollar\.json:6:\d+", "write '$fog' for the parameter"),
    (["check", "scren.json"], 1, "W023", r"scren\.json:3:\d+", "did you mean 'screen'?"),
    (["check", "swapped.json"], 1, "W040", r"swapped\.json:6:\d+", "known: ldr"),
    (["check", "unit.json"], 1, "W020", r"unit\.json:3:\d+"),
    (["check", "mips_word.json"], 1, "W040", r"mips_word\.json:6:\d+", "known: ldr"),
    (["check", "stage.json"], 1, "W100", r"stage\.json:5:\d+", "did you mean 'sky/sky.frag.glsl'?"),
    (["render", GLOW], 2, None, "--output"),
    (["render"], 2, None, "graph is required"),
    (["paint", GLOW], 2, None, "paint|subcommand"),
    ([], 2, None, "subcommand"),
]


def contents(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def check_case(report, weft, folder, arguments, code, expected, place, says=""):
    name = "weft " + " ".join(a.replace(str(TOP) + "/", "") for a in arguments)
    result = run(weft, *arguments, folder=folder)
    whole = f"{name}\n{result.out}{result.err}"
    report.check(result.code == code, f"exit code {result.code}, not {code}: {whole}")
    report.check(not CRASH.search(result.err + result.out), f"crash: {whole}")
    report.check(says in result.err + result.out, f"does not say {says!r}: {whole}")
    if expected is None:
        report.check(re.search(place, result.err + result.out) and not result.diagnostics, f"does not name {place}: {whole}")
        return
    errors = [d for d in result.diagnostics if d["severity"] == "error"]
    found = [(d["code"], ":".join(d[k] for k in ("place", "line", "column") if d[k])) for d in errors]
    codes = expected.split()
    fits = [code for code, _ in found] == codes and re.fullmatch(place, " ".join(at for _, at in found))
    report.check(fits, f"expected {expected} at '{place}', found {found}: {whole}")


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        (folder / "folder.png").mkdir()
        for full in ("full.png", "full.exr"):
            (folder / full).symlink_to("/dev/full")
        (folder / "shaders").mkdir()
        for file, text in FILES.items():
            (folder / file).write_bytes(text if isinstance(text, bytes) else text.encode())
        before = contents(folder)
        for case in CASES:
            check_case(report, weft, folder, *case)
            report.check(contents(folder) == before, f"{' '.join(case[0])}: wrote {sorted(set(contents(folder)) - set(before))}")
        # Without a display the files are reported too.
        nowhere = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        view = run(weft, "view", "no_such.json", folder=folder, env=nowhere)
        report.check(view.code == 3 and view.codes() == ["W001", "W110"], f"view without display: {view.code}\n{view.err}")
        # A note is no trouble, and --quiet leaves it out.
        sun = ["render", GLOW, "--environment", "sun.hdr", "--size", "64x36", "-o", "sun.png"]
        loud, quiet = run(weft, *sun, folder=folder), run(weft, *sun, "--quiet", folder=folder)
        report.check(loud.code == 0 and loud.codes("note") == ["W153"], f"sun.hdr: {loud.err}")
        report.check(quiet.code == 0 and not quiet.err, f"--quiet: {quiet.err}")
        # The same folder and options do make a picture, so that what failed above failed for its own reason.
        (folder / "good.json").write_text(graph())
        good = run(weft, *rendered("good.json"), folder=folder)
        report.check(good.code == 0 and (folder / "out.png").exists() and not good.err, f"good.json: {good.code}\n{good.err}")
        # The ending of a picture's name may be in capitals; what is written is the same.
        for name, same in (("OUT.PNG", "out.png"), ("a_%d.Exr", "a.exr")):
            good = run(weft, *rendered("good.json", "-o", name, "--frames", "0"), folder=folder)
            report.check(good.code == 0 and not good.err, f"{name}: {good.code}\n{good.err}")
            run(weft, *rendered("good.json", "-o", same), folder=folder)
            written = folder / name.replace("%d", "0")
            report.check(written.exists() and written.read_bytes() == (folder / same).read_bytes(), f"{name} is not {same}")
    report.end()


main()
