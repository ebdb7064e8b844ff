#!/usr/bin/env python3
"""Defects of the picture before and now: makes ../defects.md and ../images/defects/*.png from defects.json.

    docs/gallery/defects.py                 render what is now with ./run, and write the page
    docs/gallery/defects.py NAME ...        only these entries
    docs/gallery/defects.py --pages         no pictures, only the page
    docs/gallery/defects.py --weft WEFT ... as above, by the program WEFT in place of ./run
    docs/gallery/defects.py --values        print the mean light of parts of the pictures here, where an entry says which
    docs/gallery/defects.py --before FOLDER WEFT [NAME ...]
                                            render what was before, with the program WEFT on the data of FOLDER, a checkout of the commit that
                                            defects.json names

docs/gallery/gallery.py --check looks after this page, too. An entry: `name`; `title`; `was` and `now`, what to see; `shots`, each with the `arguments` of
`weft render`, its `size` and the `crops` of it to show (each x, y, width, height), and `before`, the arguments where they were others; `scale`, how many times as large
a crop is shown; `channels`, whether red, green and blue are shown each by itself, too; `values`, parts of the first crop whose light
--values prints; `judge`, a script that prints what these should be; `figures`, rows of what is measured, before, now, and the bar; `test`,
[test file, beginning of the name of a test case, program below build/release]: what prints the figures.
"""
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

from png import read_png, read_size, read_text, write_png

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
PICTURES = TOP / "docs/images/defects"
PAGE = TOP / "docs/defects.md"
DEFECTS = json.loads((HERE / "defects.json").read_text())
ENTRIES = DEFECTS["entries"]
GAP, GREY = 4, 128


def commands_of(entry):
    several = len(entry["shots"]) > 1
    return [f"./run render {shot['arguments']} --size {shot['size']} -o out/{entry['name']}{f'_{i}' if several else ''}.png"
            for i, shot in enumerate(entry["shots"])]


def commands_before(entry):
    return [re.sub(r"(?<=render ).*(?= --size)", shot.get("before", shot["arguments"]), command) for command, shot in zip(commands_of(entry), entry["shots"])]


def render(command, weft, data, picture):
    """Paths of the command are those of this tree, but for graphs, which are those of `data`."""
    words = shlex.split(command)[1:]
    words[1:2] = [str(data / words[1])]
    words[words.index("-o") + 1] = str(picture)
    done = subprocess.run([*weft, *words, "--quiet"], cwd=TOP, capture_output=True, text=True, env={**os.environ, "WEFT_DATA": str(data)})
    if done.returncode or "error[" in done.stderr:
        sys.exit(f"{shlex.join(words)}\n{done.stderr}")


def crop_of(channels, texels, width, crop):
    """Rows of RGB."""
    x, y, wide, high = crop
    rows = []
    for row in range(y, y + high):
        part = texels[(row * width + x) * channels:(row * width + x + wide) * channels]
        rows.append([part[i:i + 3] for i in range(0, len(part), channels)])
    return rows


def beside(crops):
    high = max(map(len, crops))
    gap = [bytes([GREY] * 3)] * GAP
    rows = []
    for y in range(high):
        row = []
        for crop in crops:
            row += (gap if row else []) + (crop[y] if y < len(crop) else [bytes([GREY] * 3)] * len(crop[0]))
        rows.append(row)
    return rows


def enlarge(rows, scale):
    return [[texel for texel in row for _ in range(scale)] for row in rows for _ in range(scale)]


def sheet(entry, crops):
    """The crops side by side, enlarged; below them, or beside where they are narrow, their red, green and blue as greys."""
    scale = entry["scale"]
    parts = [crops]
    if entry.get("channels"):
        parts += [[[[bytes([texel[c]] * 3) for texel in row] for row in crop] for crop in crops] for c in range(3)]
    sheets = [beside([enlarge(crop, scale) for crop in part]) for part in parts]
    if len(sheets[0][0]) <= 240:
        return beside(sheets)
    rows = sheets[0]
    for part in sheets[1:]:
        rows += [[bytes([GREY] * 3)] * len(rows[0])] * GAP + part
    return rows


def make(wanted, side, weft, data):
    PICTURES.mkdir(parents=True, exist_ok=True)
    if unknown := set(wanted) - {entry["name"] for entry in ENTRIES}:
        sys.exit(f"no entry is called {', '.join(sorted(unknown))}")
    for entry in ENTRIES:
        if wanted and entry["name"] not in wanted:
            continue
        lines, crops = (commands_before if side == "before" else commands_of)(entry), []
        with tempfile.TemporaryDirectory() as folder:
            for line, shot in zip(lines, entry["shots"]):
                drawn = pathlib.Path(folder) / "drawn.png"
                render(line, weft, data, drawn)
                channels, texels = read_png(drawn)
                crops += [crop_of(channels, texels, read_size(drawn)[0], crop) for crop in shot["crops"]]
        rows = sheet(entry, crops)
        picture = PICTURES / f"{entry['name']}_{side}.png"
        write_png(picture, len(rows[0]), 3, b"".join(texel for row in rows for texel in row), [("Command", "\n".join(lines))])
        print(picture.relative_to(TOP), flush=True)


def print_values():
    """Linear, as shares of white; of the pictures as they are in the repository."""
    linear = [v / 255 / 12.92 if v <= 10 else ((v / 255 + 0.055) / 1.055) ** 2.4 for v in range(256)]
    for entry in ENTRIES:
        for side in ("before", "now") if "values" in entry else ():
            picture, scale = PICTURES / f"{entry['name']}_{side}.png", entry["scale"]
            channels, texels = read_png(picture)
            for part in entry["values"]:
                rows = crop_of(channels, texels, read_size(picture)[0], [n * scale for n in part])
                light = [sum(linear[texel[c]] for row in rows for texel in row) / (len(rows) * len(rows[0])) for c in range(3)]
                print(f"{entry['name']}, {side}, {part}: red, green, blue", ", ".join(f"{c:.4f}" for c in light))


def cases(file):
    """The names of the test cases in a file; a name may be written in several literals."""
    text = re.sub(r'"\s*\n\s*"', "", (TOP / file).read_text())
    return re.findall(r'TEST_CASE(?:_FIXTURE)?\(\s*(?:\w+,\s*)?"([^"]*)"', text)


def page():
    out = [DEFECTS["about"], ""]
    for entry in ENTRIES:
        lines, before = commands_of(entry), commands_before(entry)
        file, beginning, program = entry["test"]
        out += [f"## {entry['title']}", "", f"**Before:** {entry['was']}", "", f"![before](images/defects/{entry['name']}_before.png)", "",
                f"**Now:** {entry['now']}", "", f"![now](images/defects/{entry['name']}_now.png)", ""]
        crops = dict.fromkeys("{2} x {3} pixels from ({0}, {1})".format(*crop) for shot in entry["shots"] for crop in shot["crops"])
        out += [f"Shown: {'; '.join(crops)}, {entry['scale']} times as large" + (": in colour, then red, green and blue, each as greys." if entry.get("channels") else "."), ""]
        out += ["```text", *lines, "```", ""]
        if before != lines:
            out += ["Before, the same was written so:", "", "```text", *before, "```", ""]
        out += ["| measured | before | now | must be |", "|---|---|---|---|", *(f"| {' | '.join(row)} |" for row in entry["figures"]), "",
                f"This prints the figures (`{file}`):", "",
                "```text", f"cmake --build build/release --target {program.rsplit('/')[-1]}",
                f"build/release/{program} -s -tc='{beginning.split(',')[0]}*'", *(["docs/gallery/defects.py --values"] if "values" in entry else []),
                *([entry["judge"]] if "judge" in entry else []), "```", ""]
        if entry.get("left"):
            out += [f"What is left: {entry['left']}", ""]
    return "\n".join(out).rstrip() + "\n"


def check(weft):
    """What is wrong with the page, its pictures, its tests, and its commands, by `weft check`."""
    problems = []
    if not PAGE.exists() or PAGE.read_text() != page():
        problems.append("docs/defects.md is not what docs/gallery/defects.json makes; run docs/gallery/defects.py --pages")
    wanted = {f"{entry['name']}_{side}.png": "\n".join(lines)
              for entry in ENTRIES for side, lines in (("now", commands_of(entry)), ("before", commands_before(entry)))}
    found = {path.name for path in PICTURES.glob("*.png")}
    problems += [f"images/defects/{name} is not there; run docs/gallery/defects.py" for name in sorted(set(wanted) - found)]
    problems += [f"images/defects/{name} belongs to no entry; delete it" for name in sorted(found - set(wanted))]
    problems += [f"images/defects/{name} was made by other commands; expected {wanted[name]}, found {said}; run docs/gallery/defects.py"
                 for name in sorted(found & set(wanted)) if (said := read_text(PICTURES / name, "Command")) != wanted[name]]
    for entry in ENTRIES:
        file, beginning, program = entry["test"]
        if not any(case.startswith(beginning) for case in cases(file)):
            problems.append(f"{entry['name']}: {file} has no test case that begins with {beginning}")
        folder, name = program.rsplit("/", 1)  # of several programs of a folder, CMakeLists.txt has only what their names do not share
        if not re.search(rf"\b(?:{name}|{name.removeprefix('theory_').removesuffix('_test')})\b", (TOP / folder / "CMakeLists.txt").read_text()):
            problems.append(f"{entry['name']}: there is no program {program}")
        for command in commands_of(entry):
            words = shlex.split(re.sub(r" (?:--frames|-o) \S+", "", command))[2:]
            done = subprocess.run([weft, "check", "--no-shaders", *words], cwd=TOP, capture_output=True, text=True)
            if done.returncode or "error[" in done.stderr:
                problems.append(f"{entry['name']}: {command}\n{done.stderr}")
    return problems


def main():
    wanted, side, weft, data = sys.argv[1:], "now", [str(TOP / "run")], TOP
    if wanted[:1] == ["--weft"] and len(wanted) > 1:
        weft, wanted = [str(pathlib.Path(wanted[1]).resolve())], wanted[2:]
    if wanted[:1] == ["--before"]:
        if len(wanted) < 3 or not pathlib.Path(wanted[1], "graphs").is_dir():
            sys.exit("--before needs a folder that has graphs, and the program")
        data, weft, side, wanted = pathlib.Path(wanted[1]).resolve(), [str(pathlib.Path(wanted[2]).resolve())], "before", wanted[3:]
    if wanted == ["--values"]:
        return print_values()
    if wanted != ["--pages"]:
        make(wanted, side, weft, data)
    PAGE.write_text(page())
    print(PAGE.relative_to(TOP))


if __name__ == "__main__":
    main()
