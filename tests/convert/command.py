#!/usr/bin/env python3
"""weft import as a command: what it writes and prints, that it replaces nothing unasked and writes nothing after an error, that
messages of the shader compiler keep the lines of the original, that reading can be confined, and what some functions of the originals compute.

    command.py WEFT
"""
import os
import pathlib
import resource
import sys
import tempfile

from pictures import png, read_png
from program import TOP, run

WEFT = sys.argv[1]
ISF = """/*{
  "INPUTS": [ { "NAME": "level", "TYPE": "float", "DEFAULT": 0.5 } ]
}*/
void main() {
  float half_ = level * 0.5;
  gl_FragColor = vec4(halff_);
}
"""
HOOK = """//!HOOK MAIN
//!BIND HOOKED
vec4 hook() { return HOOKED_texOff(0); }
//!HOOK MAIN
//!BIND HOOKED
vec4 hook() {
  return HOOKED_texOff(0) * gainn;
}
"""
LINEAR_MEAN = """//!HOOK MAIN
//!BIND HOOKED
//!DESC mean of two texels in linear light
vec4 hook() {
  vec4 a = linearize(HOOKED_texOff(vec2(0.0)));
  vec4 b = linearize(HOOKED_texOff(vec2(1.0, 0.0)));
  return delinearize(0.5 * (a + b));
}
"""
CUBIC = """/*{ "ISFVSN": "2", "INPUTS": [ { "NAME": "gain", "TYPE": "float", "DEFAULT": 4.0, "MIN": 0.0, "MAX": 8.0 } ] }*/
void main() {
  float x = isf_FragNormCoord.x - 0.5;
  gl_FragColor = vec4(vec3(0.5 + gain * pow(x, 3.0)), 1.0);
}
"""


def files_in(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


def check_dials(top):
    """tests/convert/mpv/dials.glsl, which Debian's mpv does not take: stripes of two pixels, every other one times `gain`, all times the number of frames."""
    card = read_png((TOP / "tests/convert/pictures/card.png").read_bytes())
    made = run(WEFT, "import", "tests/convert/mpv/dials.glsl", "-o", top / "dials", "--image", f"picture={TOP / 'tests/convert/pictures/card.png'}")
    assert made.code == 0 and "LUMA" in made.err, made.err
    for options, frame, gain in (([], 0, 0.5), ([], 1, 0.5), (["--set", "gain=0.25"], 2, 0.25)):
        done = run(WEFT, "render", top / "dials/dials.json", "--size", f"{len(card[0])}x{len(card)}", "--frames", frame, *options, "--quiet", "-o", top / "dials.png")
        assert done.code == 0, done.err
        for row, shown in zip(card, read_png((top / "dials.png").read_bytes())):
            for x, (texel, found) in enumerate(zip(row, shown)):
                factor = (1 if x % 4 < 2 else gain) * (frame + 1)
                assert all(abs(min(255, c * factor) - f) <= 1 for c, f in zip(texel[:3], found)), f"frame {frame}, x {x}: {texel} times {factor} is {found}"
    said = run(WEFT, "render", top / "dials/dials.json", "--set", "gain=2.5", "-o", top / "dials.png")
    assert said.code == 1 and "0 to 2" in said.err + said.out, said.err


def check_formulas(top):
    """linearize() and delinearize() of mpv are sRGB's curve, and pow() of ISF takes a negative number to a whole power."""
    def linear(level):
        return level / 255 / 12.92 if level / 255 <= 0.04045 else ((level / 255 + 0.055) / 1.055) ** 2.4

    def shown(value):
        return 255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055)

    pair = ((250, 4, 128), (10, 0, 60))
    (top / "two.png").write_bytes(png([[*pair] * 4] * 4))
    for name, text, options, wanted in (
            ("mean.glsl", LINEAR_MEAN, ["--image", f"picture={top / 'two.png'}"], lambda x: [shown((linear(a) + linear(b)) / 2) for a, b in zip(*(pair if x < 7 else (pair[1],) * 2))]),
            ("cubic.fs", CUBIC, [], lambda x: [255 * (0.5 + 4 * ((x + 0.5) / 8 - 0.5) ** 3)] * 3)):
        (top / name).write_text(text)
        made = run(WEFT, "import", top / name, "-o", top / "formulas", *options)
        assert made.code == 0, made.err
        done = run(WEFT, "render", made.out.strip(), "--size", "8x4", "--quiet", "-o", top / "formula.png")
        assert done.code == 0 and not done.err, done.err
        for row in read_png((top / "formula.png").read_bytes()):
            for x, texel in enumerate(row):
                assert all(abs(f - w) <= 1 for f, w in zip(texel, wanted(x))), f"{name}, x {x}: {texel} instead of {wanted(x)}"


def main():
    with tempfile.TemporaryDirectory() as temporary:
        top = pathlib.Path(temporary)
        out = top / "out"
        done = run(WEFT, "import", "tests/convert/isf/corners.fs", "-o", out)
        assert done.code == 0 and done.out == f"{out}/corners.json\n" and not done.err, done.err
        shaders = ["corners.frag.glsl", "corners.fs.glsl", "corners.vert.glsl", "corners.vs.glsl", "isf.glsl"]
        assert files_in(out) == ["corners.json", *(f"shaders/corners/{name}" for name in shaders)], files_in(out)
        # Without a picture it is a graph, too.
        assert run(WEFT, "check", out / "corners.json", "--size", "32x32").err.count("[W") == 0

        # Nothing is replaced unasked.
        mine = out / "corners.json"
        mine.write_text("mine")
        again = run(WEFT, "import", "tests/convert/isf/corners.fs", "-o", out)
        assert again.code == 1 and again.codes() == ["W180"] and mine.read_text() == "mine", again.err
        assert run(WEFT, "import", "tests/convert/isf/corners.fs", "-o", out, "--overwrite").code == 0 and mine.read_text() != "mine"
        other = run(WEFT, "import", "tests/convert/isf/corners.fs", "-o", out, "--name", "second")
        assert other.code == 0 and (out / "second.json").exists(), other.err
        assert run(WEFT, "import", "tests/convert/isf/corners.fs", "-o", out, "--name", "../up").codes() == ["W012"]

        # The .vs beside a file is no path of the command line: it is confined, and no pipe.
        beside = top / "beside"
        beside.mkdir()
        (beside / "x.fs").write_text(ISF)
        (top / "secret.txt").write_text("secret")
        (beside / "x.vs").symlink_to(top / "secret.txt")
        outside = run(WEFT, "import", beside / "x.fs", "-o", top / "stolen", "--confine", beside)
        assert outside.code == 1 and outside.codes() == ["W200"] and not (top / "stolen").exists(), outside.err
        (beside / "x.vs").unlink()
        os.mkfifo(beside / "x.vs")
        pipe = run(WEFT, "import", beside / "x.fs", "-o", top / "stolen")
        assert pipe.code == 1 and pipe.codes() == ["W001"] and not (top / "stolen").exists(), pipe.err

        # After an error nothing is written.
        bad = run(WEFT, "import", "tests/convert/bad/w221_audio.fs", "-o", top / "none")
        assert bad.code == 1 and bad.codes() == ["W221"] and not (top / "none").exists(), bad.err
        missing = run(WEFT, "import", top / "no.fs", "-o", top / "none")
        assert missing.code == 1 and missing.codes() == ["W001"], missing.err
        wrong = run(WEFT, "import", "tests/convert/isf/negative.fs", "-o", top / "none", "--image", "imputImage=x.png")
        assert wrong.code == 1 and wrong.codes() == ["W044"] and "inputImage" in wrong.err, wrong.err
        # A full disk is said, and leaves no file. The files are of 500 to 3000 bytes.
        def limited():
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))

        full = run(WEFT, "import", "tests/convert/isf/corners.fs", "-o", top / "full/deep", preexec_fn=limited)
        assert full.code == 1 and full.codes() == ["W180"] and "File too large" in full.err and ".weft" not in full.err, full.err
        before = {name: (out / name).read_bytes() for name in files_in(out)}
        assert not files_in(top / "full/deep"), files_in(top / "full/deep")
        # A link is not followed, and its file stays; a pipe is not waited for.
        (top / "far.json").write_text("mine")
        (out / "corners.json").unlink()
        (out / "corners.json").symlink_to(top / "far.json")
        linked = run(WEFT, "import", "tests/convert/isf/corners.fs", "-o", out, "--overwrite")
        assert linked.code == 1 and linked.codes() == ["W180"] and (top / "far.json").read_text() == "mine", linked.err
        (out / "corners.json").unlink()
        os.mkfifo(out / "corners.json")
        pipe = run(WEFT, "import", "tests/convert/isf/corners.fs", "-o", out, "--overwrite", timeout=60)
        assert pipe.code == 1 and pipe.codes() == ["W180"] and "a pipe" in pipe.err, pipe.err
        assert not (top / "none").exists()

        # Messages keep the lines.
        for name, text, line in (("wrong.fs", ISF, 6), ("wrong.hook", HOOK, 7)):
            (top / name).write_text(text)
            imported = run(WEFT, "import", top / name, "-o", top / "wrong", "--overwrite")
            said = run(WEFT, "check", top / "wrong/wrong.json")
            assert imported.code == 1 and imported.codes() == said.codes(), imported.err
            assert said.code == 1 and any(d["line"] == str(line) and d["code"] == "W104" for d in said.diagnostics), said.err

        # The .vs beside the file is the only other file that is read.
        confined = run(WEFT, "import", TOP / "tests/convert/isf/corners.fs", "-o", top / "confined", "--confine", top)
        assert confined.code == 0, confined.err

        check_dials(top)
        check_formulas(top)
        help_text = run(WEFT, "import", "--help").out
        assert "Example: weft import" in help_text, help_text
    print("import: files, refusals, lines and help")
    return 0


sys.exit(main())
