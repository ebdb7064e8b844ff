#!/usr/bin/env python3
"""`weft diff A B --render`: its numbers against the two pictures as `weft render` writes them, with FLIP by the judge of tests/assets/images; the first
pass that differs; what -o writes, and what it never writes over.

    diff_render.py WEFT
"""
import json
import os
import pathlib
import shutil
import sys

from pictures import png, read_png
from program import TOP, Report, run, temporary_folder

sys.path.insert(0, str(TOP / "tests/assets/images"))
import flip_judge  # noqa: E402

SIZE = "32x18"
GLOW, VIGNETTE = "graphs/glow.json", "tests/golden/vignette.json"
NAMES = ["after.png", "before.png", "difference.png"]
# A texture of half the screen, in one of the colors.
HALF = {"resources": {"ldr": {"texture": "rgba8", "size": "screen", "clear": [1, 0, 0, 1]}}, "passes": [], "present": "ldr"}


def pixels_of(weft, graph, folder, *arguments):
    file = pathlib.Path(folder, "rendered.png")
    run(weft, "render", graph, "--size", SIZE, "--quiet", "-o", file, *arguments)
    return read_png(file.read_bytes())


def check_numbers(weft, report, folder):
    for more in ((), ("--set", "threshold=0.5"), ("--frame", "3")):
        shown = folder / "shown"
        done = run(weft, "diff", GLOW, VIGNETTE, "--render", "--size", SIZE, "--format", "json", "-o", shown, *more)
        if not report.check(done.code == 1 and not done.err, f"{more}: {done.code}\n{done.out}{done.err}"):
            continue
        json_ = json.loads(done.out)
        said = json_["pictures"]
        same_frame = [word.replace("--frame", "--frames") for word in more]
        before, after = (pixels_of(weft, graph, folder, *same_frame) for graph in (GLOW, VIGNETTE))
        report.check(sorted(f.name for f in shown.iterdir()) == NAMES, f"{list(shown.iterdir())}")
        for name, expected in (("before", before), ("after", after)):
            left = read_png((shown / f"{name}.png").read_bytes())
            report.check([[t[:3] for t in row] for row in left] == [[t[:3] for t in row] for row in expected], f"{more}: {name}.png is not what render writes")
        steps = {(x, y): max(abs(a - b) for a, b in zip(before[y][x], after[y][x])) for y in range(len(before)) for x in range(len(before[0]))}
        worst = max(steps.values())
        report.check(said["size_before"] == said["size_after"] == [32, 18], f"{said}")
        report.check(said["largest_difference"] == worst > 10 and steps[tuple(said["largest_difference_at"])] == worst, f"{more}: {worst}, but {said}")
        report.check(said["differing_pixels"] == sum(step > 0 for step in steps.values()), f"{more}: {said}")
        errors = flip_judge.flip([[t[:3] for t in row] for row in before], [[t[:3] for t in row] for row in after], 67.02064327658226)
        mean, peak = sum(errors) / len(errors), max(errors)
        x, y = said["flip_peak_at"]
        report.check(abs(said["flip"] - mean) < 1e-5 and abs(said["flip_peak"] - peak) < 1e-5 and abs(errors[32 * y + x] - peak) < 1e-5, f"{more}: {mean}, {peak}, but {said}")
        # The difference picture gets lighter where the error is larger.
        light = [sum(t) for row in read_png((shown / "difference.png").read_bytes()) for t in row]
        least, most = min(range(len(errors)), key=errors.__getitem__), max(range(len(errors)), key=errors.__getitem__)
        report.check(light[least] < light[most] and light[most] == max(light), f"{more}: difference.png is {light[least]} and {light[most]}")
        report.check(said["first"]["pass"] == "vignette" and said["first"]["kind"] == "added" and "vignette" in said["first"]["text"], f"{said['first']}")
        report.check(any(line.startswith("+ pass vignette:") for line in json_["plan"]), f"{json_['plan']}")
        shutil.rmtree(shown)


def check_text(weft, report, folder):
    same = run(weft, "diff", GLOW, GLOW, "--render", "--size", SIZE)
    report.check(same.code == 0 and same.out == "pictures: the same\nno pass differs\n", f"{same.code}\n{same.out}{same.err}")
    other = run(weft, "diff", GLOW, VIGNETTE, "--render", "--size", SIZE)
    report.check(other.code == 1 and "+ pass vignette" in other.out and "\npictures: FLIP 0." in other.out and "\nfirst that differs: pass 'vignette' writes 'scene'" in other.out, other.out + other.err)
    # The plans are the same, a constant is not: only the pictures tell.
    text = (TOP / GLOW).read_text()
    changed = folder / "glow.json"
    changed.write_text(text.replace('"threshold": { "default": 1.0', '"threshold": { "default": 0.25'))
    report.check(changed.read_text() != text, "glow.json has a threshold of 1.0")
    plans, pictures = (run(weft, "diff", GLOW, changed, "--size", SIZE, *more) for more in ((), ("--render",)))
    report.check(plans.code == 0 and not plans.out, f"{plans.code}\n{plans.out}{plans.err}")
    report.check(pictures.code == 1 and pictures.out.startswith("pictures: FLIP") and "first that differs: pass 'glow_prefilter' writes another 'glow'" in pictures.out, pictures.out + pictures.err)
    # Pictures of different sizes have no difference.
    for name, size in (("whole", "screen"), ("half", "screen/2")):
        (folder / f"{name}.json").write_text(json.dumps({**HALF, "resources": {"ldr": {**HALF["resources"]["ldr"], "size": size}},
                                                         "passes": [{"name": "touch", "type": "fullscreen", "shader": "touch.frag.glsl", "modify": {"result": "ldr"}}]}))
    (folder / "shaders").mkdir()
    (folder / "shaders/touch.frag.glsl").write_text("out vec4 result;\nvoid main() { result = vec4(1.0); }\n")
    # One of an earlier run goes; what is not of this command stays.
    target = folder / "sizes"
    for other, names in (("whole", NAMES), ("half", NAMES[:2])):
        sizes = run(weft, "diff", folder / "whole.json", folder / f"{other}.json", "--render", "--size", SIZE, "-o", target)
        report.check(sizes.code == (other == "half") and not sizes.err, f"{sizes.code}\n{sizes.out}{sizes.err}")
        report.check(sorted(f.name for f in target.iterdir() if f.name != "notes.txt") == names, f"whole and {other}: {list(target.iterdir())}")
        (target / "notes.txt").write_text("mine")
    report.check("pictures: of different sizes, 32x18 and 16x9" in sizes.out and (target / "notes.txt").is_file(), sizes.out)
    # A link of that name is an error; what it leads to stays.
    (target / "difference.png").symlink_to(target / "notes.txt")
    sizes = run(weft, "diff", folder / "whole.json", folder / "half.json", "--render", "--size", SIZE, "-o", target)
    report.check(sizes.code == 2 and sizes.codes() == ["W180"] and (target / "notes.txt").read_text() == "mine", f"{sizes.code}\n{sizes.err}")


def check_files(weft, report, folder):
    def diff(before, after, target):
        return run(weft, "diff", before, after, "--render", "--size", SIZE, "-o", target)

    # Nothing that is read is written over, also by a link, and then nothing is written at all.
    (folder / "photo.png").write_bytes(png([[(200, 100, 50)] * 4] * 4))
    graph = {"resources": {"photo": {"import": "image", "file": "photo.png"}, "ldr": {"texture": "rgba8", "size": "screen"}},
             "passes": [{"name": "show", "type": "blit", "read": {"source": "photo"}, "write": {"destination": "ldr"}}], "present": "ldr"}
    (folder / "photo.json").write_text(json.dumps(graph))
    kept = (folder / "photo.png").read_bytes()
    for name in NAMES:
        target = folder / f"over_{name}"
        target.mkdir()
        (target / name).symlink_to(folder / "photo.png")
        done = diff(folder / "photo.json", GLOW, target)
        report.check(done.code == 2 and done.codes() == ["W180"] and name in done.err, f"{name}: {done.code}\n{done.out}{done.err}")
        report.check((folder / "photo.png").read_bytes() == kept and [f.name for f in target.iterdir()] == [name], f"{name} was written over, or others were left")
    target = folder / "pipe"
    target.mkdir()
    os.mkfifo(target / "after.png")
    done = diff(GLOW, GLOW, target)
    report.check(done.code == 2 and done.codes() == ["W180"] and "a pipe" in done.err, f"{done.code}\n{done.err}")
    done = diff(GLOW, GLOW, folder / "photo.png/inside")
    report.check(done.code == 2 and done.codes() == ["W180"], f"{done.code}\n{done.err}")
    for graphs in ((GLOW, "tests/bad_graphs/w040_unknown_resource.json"), ("tests/bad_graphs/w040_unknown_resource.json", GLOW)):
        done = diff(*graphs, folder / "broken")
        report.check(done.code == 2 and done.codes() == ["W040"] and not done.out and not (folder / "broken").exists(), f"{graphs}: {done.code}\n{done.out}{done.err}")
    for option in (("-o", folder / "unused"), ("--frame", "1")):
        done = run(weft, "diff", GLOW, GLOW, *option)
        report.check(done.code == 2 and "--render" in done.err, f"{option} without --render: {done.code}\n{done.err}")


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    for check in (check_numbers, check_text, check_files):
        with temporary_folder() as folder:
            check(weft, report, pathlib.Path(folder))
    help_ = run(weft, "diff", "--help")
    report.check(help_.code == 0 and "--render" in help_.out and "Example: weft diff" in help_.out, help_.out)
    report.end()


main()
