#!/usr/bin/env python3
"""The import `image`: files that this test writes from the definitions of their formats come out texel by texel; sequences play, hold and
choose; what cannot be is said. The judge is tests/app/pictures.py, which shares nothing with Weft.

    images.py WEFT
"""
import json
import os
import pathlib
import sys

from pictures import exr, hdr, jpeg, png, read_exr
from program import Report, run, temporary_folder

COPY = """uniform sampler2D picture;
#ifdef LEVEL
const int kLevel = LEVEL;
#else
const int kLevel = 0;
#endif
out vec4 result;
void main() { result = texelFetch(picture, ivec2(gl_FragCoord.xy), kLevel); }
"""


def graph(file, more="", level=0):
    size = f"max(size(picture) / {1 << level}, 1)"
    return f"""{{
  "resources": {{ "picture": {{ "import": "image", "file": "{file}"{more} }},
                 "shown": {{ "texture": "rgba32f", "size": "{size}" }} }},
  "passes": [ {{ "name": "copy", "type": "fullscreen", "shader": "copy.frag.glsl", "defines": {{ "LEVEL": {level} }},
                "read": {{ "picture": "picture" }}, "write": {{ "result": "shown" }} }} ],
  "present": "shown" }}
"""


def decode(value):
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


class Bench:
    def __init__(self, weft, folder, report):
        self.weft, self.folder, self.report = weft, folder, report
        (folder / "shaders").mkdir()
        (folder / "shaders/copy.frag.glsl").write_text(COPY)

    def write(self, name, data):
        (self.folder / name).write_bytes(data)

    def render(self, file, more="", level=0, frames="0", output="out.exr", options=()):
        (self.folder / "graph.json").write_text(graph(file, more, level))
        return run(self.weft, "render", self.folder / "graph.json", "--size", "8x8", "--quiet", "--frames", frames,
                   "-o", self.folder / output, *options)

    def shows(self, file, wanted, label, more="", level=0, within=1e-6):
        ran = self.render(file, more, level)
        if not self.report.check(ran.code == 0, f"{label}: {ran.code}\n{ran.err}"):
            return
        got = read_exr((self.folder / "out.exr").read_bytes())
        same = len(got) == len(wanted) and all(
            len(a) == len(b) and all(abs(x - y) <= within * max(1, abs(y)) for s, t in zip(a, b) for x, y in zip(s, t)) for a, b in zip(got, wanted))
        self.report.check(same, f"{label}: {got} instead of {wanted}")

    def refuses(self, code, words, label, ran):
        self.report.check(ran.code == 1 and ran.codes() == [code] and all(word in ran.err for word in words),
                          f"{label}: exit code {ran.code}, not a {code} with {words}\n{ran.err}")


def check_kinds(bench):
    texels = [[((37 * x + 91 * y) % 256, (53 * x + 7) % 256, (200 - 31 * y) % 256, (255 - 29 * x) % 256) for x in range(7)] for y in range(5)]
    scaled = [[tuple(c / 255 for c in t) for t in row] for row in texels]
    bench.write("rgba.png", png(texels))
    bench.shows("rgba.png", scaled, "8 bits, four channels, as stored and upright")
    bench.shows("rgba.png", [[(*map(decode, t[:3]), t[3]) for t in row] for row in scaled], "8 bits decoded from sRGB", ', "srgb": true', within=2e-3)
    bench.write("rgb.png", png([[t[:3] for t in row] for row in texels]))
    bench.shows("rgb.png", [[(*t[:3], 1) for t in row] for row in scaled], "no alpha is 1")
    bench.write("gray.png", png([[t[:1] for t in row] for row in texels]))
    bench.shows("gray.png", [[(t[0], t[0], t[0], 1) for t in row] for row in scaled], "gray is red, green and blue")
    words = [[tuple(257 * c - (c > 3) * 100 for c in t) for t in row] for row in texels]
    bench.write("words.png", png(words, 16))
    wide = [[tuple(c / 65535 for c in t) for t in row] for row in words]
    bench.shows("words.png", wide, "16 bits keep their lower 8")
    bench.shows("words.png", [[(*map(decode, t[:3]), t[3]) for t in row] for row in wide], "16 bits decoded from sRGB", ', "srgb": true')
    stored = [[(200 + x, 100 + y, 50, 120 + 3 * x + y) for x in range(6)] for y in range(4)]
    bench.write("light.hdr", hdr(stored))
    bench.shows("light.hdr", [[(*(c * 2.0 ** (t[3] - 136) for c in t[:3]), 1) for t in row] for row in stored], "Radiance, from dim to 2^15")
    light = [[(x - 2.5, 1e5 * y + 0.25, 2.0 ** -x, 0.5) for x in range(6)] for y in range(3)]
    bench.write("light.exr", exr(light))
    bench.shows("light.exr", light, "OpenEXR, negative and above what a half holds", ', "srgb": true')
    halves = [[(x - 2.5, 64.0 * y, 2.0 ** -x, 0.5) for x in range(6)] for y in range(3)]
    bench.write("half.exr", exr(halves, half=True))
    bench.shows("half.exr", halves, "OpenEXR of halves")
    levels = [0, 40, -20, -10]
    bench.write("gray.jpg", jpeg(levels))
    bench.shows("gray.jpg", [[(*[(128 + levels[x // 8]) / 255] * 3, 1) for x in range(32)]] * 8, "JPEG of blocks of one level")
    bench.write("checks.png", png([[(100 * ((x + y) % 2) + 50 * (x // 4),) * 3 for x in range(8)] for y in range(4)]))
    bench.shows("checks.png", [[(*[(50 + 50 * (x // 2)) / 255] * 3, 1) for x in range(4)]] * 2, "the second level is the mean of four", ', "mips": true', 1, within=3e-3)
    bench.shows("checks.png", [[(*[75 / 255] * 3, 1)]], "the last level is one texel", ', "mips": true', 3, within=5e-3)


def check_sequences(bench):
    gray = {1: 10, 2: 20, 4: 40, 5: 50}  # 3 is missing
    for number, level in gray.items():
        bench.write(f"clouds.{number:04}.png", png([[(level,) * 3] * 3] * 2))
        bench.write(f"plain{number}.png", png([[(level,) * 3] * 3] * 2))

    def plays(file, more, frames, wanted, label, options=()):
        ran = bench.render(file, more, frames=f"0:{frames - 1}", output="f_%02d.exr", options=options)
        if bench.report.check(ran.code == 0, f"{label}: {ran.err}"):
            got = [round(255 * read_exr((bench.folder / f"f_{i:02}.exr").read_bytes())[0][0][0]) for i in range(frames)]
            bench.report.check(got == wanted, f"{label}: {got} instead of {wanted}")

    plays("clouds.####.png", "", 7, [10, 20, 20, 40, 50, 10, 20], "a sequence plays, shows the one before a gap, and loops")
    plays("clouds.%04d.png", ', "end": "hold"', 7, [10, 20, 20, 40, 50, 50, 50], "a sequence holds its last picture")
    plays("plain%d.png", ', "fps": 30', 6, [10, 10, 20, 20, 20, 20], "half as many pictures as frames", ["--fps", "60"])
    plays("clouds.####.png", ', "frame": 4', 2, [40, 40], "one picture of a sequence")
    bench.refuses("W072", ["no such picture", "from 1 to 5", "nearest is 2"], "a number that is missing", bench.render("clouds.####.png", ', "frame": 3'))
    bench.refuses("W072", ["chooses from a sequence", "rgba.png"], "a number of one file", bench.render("rgba.png", ', "frame": 3'))
    bench.refuses("W150", ["has no pictures", "rain.0001.png"], "a sequence of nothing", bench.render("rain.####.png"))
    bench.write("clouds.0006.png", png([[(60,) * 3] * 4] * 2))
    bench.refuses("W152", ["clouds.0006.png", "another size", "3 x 2", "4 x 2"], "a picture of another size", bench.render("clouds.####.png", frames="0:6", output="f_%02d.exr"))


def check_mistakes(bench):
    bench.refuses("W150", ["nothing.png"], "no file", bench.render("nothing.png"))
    # `check` says it, too, with the place of the name, also where the picture is optional, not read, or read by a disabled pass.
    text = graph("nothing.png").replace("max(size(picture) / 1, 1)", "8")
    for what, old, new in (("read", "", ""), ("optional", '"picture": "picture"', '"picture": "picture?"'), ("not read", '"read": { "picture": "picture" }, ', ""),
                           ("disabled", '"type": "fullscreen"', '"enabled": false, "type": "fullscreen"')):
        (bench.folder / "graph.json").write_text(text.replace(old, new))
        ran = run(bench.weft, "check", "--no-shaders", bench.folder / "graph.json")
        told = [(d["line"], d["column"]) for d in ran.diagnostics if d["code"] == "W150"]
        bench.report.check(ran.code == 1 and told == [("2", "59")], f"check of a missing picture that is {what}: {ran.code} {ran.err}")
    bench.write("picture.gif", b"GIF89a")
    bench.refuses("W151", ["picture.gif", ".png"], "a kind that is not known", bench.render("picture.gif"))
    whole = (bench.folder / "rgba.png").read_bytes()
    bench.write("cut.png", whole[:60])
    bench.refuses("W150", ["cut.png"], "a file that ends early", bench.render("cut.png"))
    bench.write("cut.hdr", (bench.folder / "light.hdr").read_bytes()[:-5])
    bench.refuses("W150", ["cut.hdr"], "an .hdr that ends early", bench.render("cut.hdr"))
    bench.write("huge.hdr", (bench.folder / "light.hdr").read_bytes().replace(b"+X 6", b"+X 40000"))
    bench.refuses("W152", ["huge.hdr", "too large"], "a size that no texture has", bench.render("huge.hdr"))
    os.mkfifo(bench.folder / "pipe.png")
    bench.refuses("W150", ["pipe.png"], "a pipe is not waited for", bench.render("pipe.png"))
    with temporary_folder() as other:
        outside = pathlib.Path(other) / "secret.0001.png"
        outside.write_bytes(whole)
        for file in (outside, outside.with_name("secret.####.png"), outside.with_name("nothing.####.png")):
            bench.refuses("W200", ["graph.json:"], f"{file.name} outside the folder",
                          bench.render(str(file), options=["--confine", bench.folder]))
    # Where the name was written: on the command line, in the default of a parameter, in the graph.
    for number, data in ((1, whole), (2, whole[:60])):
        bench.write(f"torn.{number}.png", data)
    by_parameter = json.loads(graph("$photo", ', "end": "$ending"'))
    by_parameter["parameters"] = {"photo": {"type": "file", "default": "rgba.png"}, "ending": {"type": "choice", "choices": ["loop", "hold"], "default": "loop"}}
    (bench.folder / "graph.json").write_text(json.dumps(by_parameter))
    for file, frames in (("cut.png", "0"), ("nothing.png", "0"), ("torn.%d.png", "0:1")):
        option = f"photo={bench.folder / file}"
        ran = run(bench.weft, "render", bench.folder / "graph.json", "--size", "8x8", "--quiet", "--frames", frames, "-o", bench.folder / "by_%d.exr", "--set", option, "--set", "ending=hold")
        bench.refuses("W150", [f"command line: --set {option}: error", file.replace("%d", "2")], f"{file} on the command line", ran)
    by_parameter["parameters"]["photo"]["default"] = "cut.png"
    lines = json.dumps(by_parameter, indent=1)
    (bench.folder / "graph.json").write_text(lines)
    place = next(str(i) for i, line in enumerate(lines.splitlines(), 1) if '"default": "cut.png"' in line)
    ran = run(bench.weft, "render", bench.folder / "graph.json", "--size", "8x8", "--quiet", "-o", bench.folder / "by.exr")
    bench.report.check(ran.code == 1 and [d["line"] for d in ran.diagnostics] == [place], f"cut.png as a default: {ran.err}")
    (bench.folder / "graph.json").write_text(graph("cut.png"))
    ran = run(bench.weft, "check", bench.folder / "graph.json", "--no-shaders")
    bench.report.check(ran.code == 0, f"check reads only the header: {ran.out}{ran.err}")
    optional = json.loads(graph(""))
    optional["passes"][0]["read"]["picture"] = "picture?"
    optional["resources"]["shown"]["size"] = 4
    (bench.folder / "graph.json").write_text(json.dumps(optional))
    (bench.folder / "shaders/copy.frag.glsl").write_text("#ifdef HAS_PICTURE\nuniform sampler2D picture;\n#endif\nout vec4 result;\n"
                                                         "void main() { result = vec4(0.25);\n#ifdef HAS_PICTURE\nresult = texelFetch(picture, ivec2(0), 0);\n#endif\n}\n")
    ran = run(bench.weft, "render", bench.folder / "graph.json", "--quiet", "-o", bench.folder / "out.exr")
    bench.report.check(ran.code == 0 and read_exr((bench.folder / "out.exr").read_bytes())[0][0][0] == 0.25, f"without a file there is no image: {ran.err}")


def main():
    report = Report()
    with temporary_folder() as name:
        bench = Bench(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(name), report)
        check_kinds(bench)
        check_sequences(bench)
        check_mistakes(bench)
    report.end()


main()
