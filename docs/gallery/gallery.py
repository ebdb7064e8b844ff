#!/usr/bin/env python3
"""The gallery: each effect of gallery.json off and on, under one environment. Makes ../gallery.md, a page per family beside this file, and
../images/gallery/*.png.

    docs/gallery/gallery.py                 render everything anew with ./run and write the pages
    docs/gallery/gallery.py NAME ...        only the pictures of these entries or families, then the pages
    docs/gallery/gallery.py --pages         no pictures, only the pages
    docs/gallery/gallery.py --references FOLDER ...
                                            as above; only with the reference files in FOLDER is the front view made anew
    docs/gallery/gallery.py --weft WEFT ... as above, by the program WEFT in place of ./run
    docs/gallery/gallery.py --old           render everything anew in a temporary folder and name the pictures that are no longer what is drawn
    docs/gallery/gallery.py --check WEFT    write nothing: the pages must be those that gallery.json makes, every picture must be there and made by
                                            the command beside it, every property must be a test, and every command, with a smaller size,
                                            must change the picture; the same for the page of defects.py

An entry: `name`; `graph`, where it is not the one of `all`; `effect`, its title; `off` and `on`, arguments for `weft render`; `both`, arguments of both;
`says`, what to see; `crop`, [x, y, width, height], where it is too fine to be seen in the whole picture: this part alone, enlarged to the whole size;
`property`, [test file, beginning of the name of a test case]. Pictures made by equal arguments are made once, and those that
must be equal are one file. Each picture holds, in a text chunk, the command that made it, and its crop.
"""
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

import defects
from png import read_png, read_size, read_text, write_png

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
PICTURES = TOP / "docs/images/gallery"
GALLERY = json.loads((HERE / "gallery.json").read_text())
FAMILIES, FRONT = GALLERY["families"], GALLERY["front"]
ENTRIES = [entry for family in FAMILIES for entry in family["entries"]]
SIDES = ("off", "on")


def arguments(entry, side):
    return " ".join(text for text in (entry.get("graph", GALLERY["all"]), entry.get("both"), entry.get(side)) if text)


def key_of(entry, side):
    """Equal for equal pictures."""
    return " ".join(map(str, [arguments(entry, side), *entry.get("crop", [])]))


def named():
    """Arguments -> picture: the name of the entry that has them on, else one made from the arguments."""
    names = {}
    for entry in ENTRIES:
        if entry.get("on") and not entry.get("equal"):
            names.setdefault(key_of(entry, "on"), f"{entry['name']}.png")
    for entry in ENTRIES:
        line = key_of(entry, "off")
        names.setdefault(line, f"from_{hashlib.sha256(line.encode()).hexdigest()[:8]}.png")
        if entry.get("equal"):
            names[key_of(entry, "on")] = names[line]
        line = key_of(entry, "on")
        names.setdefault(line, f"from_{hashlib.sha256(line.encode()).hexdigest()[:8]}.png")
    return names


NAMES = {}


def picture_of(entry, side):
    NAMES.update(NAMES or named())
    return NAMES[key_of(entry, side)]


def command_of(entry, side):
    return (f"./run render {arguments(entry, side)} --environment {GALLERY['environment']} --size {GALLERY['size']} "
            f"-o {'out' if entry.get('crop') else 'docs/images/gallery'}/{picture_of(entry, side)}")


def commands():
    """Picture -> the command that makes it, and its crop. Where pictures are equal, that of the first."""
    made = {}
    for entry in ENTRIES:
        for side in SIDES:
            made.setdefault(picture_of(entry, side), (command_of(entry, side), entry.get("crop")))
    return made


def scale_of(crop):
    return int(GALLERY["size"].split("x")[0]) // crop[2]


def command_of_front():
    return (f"./run render {GALLERY['all']} " + "".join(f'--{key} "$references/{FRONT[key]}" ' for key in ("materials", "environment"))
            + f"--size {FRONT['size']} -o docs/images/gallery/{FRONT['name']}.png")


def run(weft, command, options):
    """The command by the program `weft`, with other values of some of its options; `$references` is a folder."""
    words = [weft, *(os.path.expandvars(word) for word in shlex.split(command)[1:])]
    for option, value in options.items():
        words[words.index(option) + 1] = str(value)
    done = subprocess.run([*words, "--quiet"], cwd=TOP, capture_output=True, text=True)
    if done.returncode or "error[" in done.stderr:
        sys.exit(f"{shlex.join(words)}\n{done.stderr}")


def enlarged(channels, texels, width, crop):
    scale, rows = scale_of(crop), []
    for row in defects.crop_of(channels, texels, width, crop):
        rows += [b"".join(texel * scale for texel in row)] * scale
    return b"".join(rows)


def render(weft, command, picture, crop=None):
    """As small as a PNG can be made without loss, with its command in it."""
    with tempfile.TemporaryDirectory() as folder:
        drawn = pathlib.Path(folder) / "drawn.png"
        run(weft, command, {"-o": drawn})
        (channels, texels), width, said = read_png(drawn), read_size(drawn)[0], [("Command", command)]
        if crop:
            channels, texels, width, said = 3, enlarged(channels, texels, width, crop), crop[2] * scale_of(crop), [*said, ("Crop", str(crop))]
        write_png(picture, width, channels, texels, said)


def case_of(entry):
    file, beginning = entry["property"]
    if file.endswith(".py"):  # words of what the script says it does
        return beginning if beginning in " ".join((TOP / file).read_text().split()) else None
    return next((case for case in defects.cases(file) if case.startswith(beginning)), None)


def page(family):
    out = [f"# Gallery: {family['title']}", "", family["about"], "",
           "All families are in the [gallery](../gallery.md), what each parameter means is in [effects.md](../effects.md).", ""]
    chapter = None
    for entry in family["entries"]:
        if entry.get("chapter") != chapter:
            chapter = entry["chapter"]
            out += [f"## {chapter}", ""]
        pictures = " | ".join(f"![{side}](../images/gallery/{picture_of(entry, side)})" for side in SIDES)
        crop = entry.get("crop")
        shown = [f"Shown: {crop[2]} x {crop[3]} pixels from ({crop[0]}, {crop[1]}), {scale_of(crop)} times as large.", ""] if crop else []
        out += [f"{'###' if chapter else '##'} {entry['effect']}", "", entry["says"], "",
                "| " + " | ".join(f"`{entry.get(side) or 'as it is'}`" for side in SIDES) + " |", "|---|---|", f"| {pictures} |", "", *shown,
                "```text", *(command_of(entry, side) for side in SIDES), "```", "", f"Held by `{entry['property'][0]}`: {case_of(entry)}.", ""]
    if family["name"] == FRONT["family"]:
        out += [f"## {FRONT['effect']}", "", FRONT["says"], "", f"![front view](../images/gallery/{FRONT['name']}.png)", "",
                "```text", command_of_front(), "```"]
    return "\n".join(out).rstrip() + "\n"


def index():
    out = [GALLERY["about"], ""]
    for family in FAMILIES:
        entry, side = next(entry for entry in family["entries"] if entry["name"] == family["cover"]), family.get("side", "on")
        names = ", ".join(entry["effect"] for entry in family["entries"])
        out += [f"## [{family['title']}](gallery/{family['name']}.md)", "", family["about"].replace("](../", "]("), "", f"Shown: {names}.", "",
                f"![{entry['effect']}](images/gallery/{picture_of(entry, side)})", "", "```text", command_of(entry, side), "```", ""]
    return "\n".join(out).rstrip() + "\n"


def pages():
    return {TOP / "docs/gallery.md": index(), **{HERE / f"{family['name']}.md": page(family) for family in FAMILIES}}


def check_files():
    problems = []
    made, there = pages(), {*HERE.glob("*.md"), TOP / "docs/gallery.md"}
    problems += [f"{path.relative_to(TOP)} is not what docs/gallery/gallery.json makes; run docs/gallery/gallery.py --pages"
                 for path, text in made.items() if not path.exists() or path.read_text() != text]
    problems += [f"{path.relative_to(TOP)} belongs to no family; delete it" for path in sorted(there - set(made))]
    wanted = {**commands(), f"{FRONT['name']}.png": (command_of_front(), None)}
    found = {path.name for path in PICTURES.glob("*.png")}
    problems += [f"{PICTURES.name}/{name} is not there; run docs/gallery/gallery.py" for name in sorted(set(wanted) - found)]
    problems += [f"{PICTURES.name}/{name} belongs to no entry; delete it" for name in sorted(found - set(wanted))]
    for name in sorted(found & set(wanted)):
        command, crop = wanted[name]
        if (said := read_text(PICTURES / name, "Command")) != command:
            problems.append(f"{PICTURES.name}/{name} was made by another command; expected {command}, found {said}; run docs/gallery/gallery.py")
        if (said := read_text(PICTURES / name, "Crop")) != (str(crop) if crop else None):
            problems.append(f"{PICTURES.name}/{name} shows another part; expected {crop}, found {said}; run docs/gallery/gallery.py")
        size = re.search(r"--size (\S+)", command)[1]
        if "{}x{}".format(*read_size(PICTURES / name)) != size:
            problems.append(f"{PICTURES.name}/{name} is not {size}; run docs/gallery/gallery.py")
    problems += [f"{entry['name']}: there is no test case {entry['property']}" for entry in ENTRIES if not case_of(entry)]
    return problems


def check_effects(weft):
    problems, made = [], {}
    with tempfile.TemporaryDirectory() as folder:
        drawn = pathlib.Path(folder) / "drawn.png"
        for entry in ENTRIES:
            pair = []
            for side in SIDES:
                line = arguments(entry, side)
                if line not in made:
                    run(weft, command_of(entry, side), {"--size": GALLERY["check_size"], "-o": drawn})
                    made[line] = read_png(drawn)[1]
                pair.append(made[line])
            off, on = pair
            changed = sum(a != b for a, b in zip(off, on)) / len(off)
            equal = entry.get("equal", False)
            if (changed > 0) == equal:
                problems.append(f"{entry['name']}: {changed:.2%} of the values differ, and {'none' if equal else 'some'} should")
            if max(on) == min(on):
                problems.append(f"{entry['name']}: the picture is one flat value")
    return problems


def check(weft):
    problems = check_files() + check_effects(weft) + defects.check(weft)
    for problem in problems:
        print(problem)
    print(f"{len(ENTRIES)} entries, {len(defects.ENTRIES)} defects, {len(problems)} problems")
    return 1 if problems else 0


def name_old(weft):
    """Rendered on the same machine, a picture is the same to the bit; on another one, a value may be rounded otherwise."""
    old = 0
    with tempfile.TemporaryDirectory() as folder:
        new = pathlib.Path(folder) / "new.png"
        for name, (command, crop) in commands().items():
            render(weft, command, new, crop)
            pair = [read_png(path)[1] for path in (PICTURES / name, new)]
            differences = [abs(a - b) for a, b in zip(*pair)]
            if len(pair[0]) != len(pair[1]) or max(differences):
                old += 1
                print(f"{name}: {sum(map(bool, differences)) / len(differences):.2%} of the values differ, by {max(differences)} of 255 at most", flush=True)
    print(f"{old} of {len(commands())} pictures are no longer what is drawn")
    return 1 if old else 0


def make(weft, wanted, references):
    PICTURES.mkdir(parents=True, exist_ok=True)
    known = {family["name"]: family["entries"] for family in FAMILIES} | {entry["name"]: [entry] for entry in ENTRIES} | {FRONT["name"]: []}
    if unknown := set(wanted) - set(known):
        sys.exit(f"no entry and no family is called {', '.join(sorted(unknown))}")
    names = {picture_of(entry, side) for name in wanted or known for entry in known[name] for side in SIDES}
    for name, (command, crop) in commands().items():
        if name in names:
            render(weft, command, PICTURES / name, crop)
            print(f"docs/images/gallery/{name}", flush=True)
    if not wanted or FRONT["name"] in wanted:
        if references:
            os.environ["references"] = str(references)
            render(weft, command_of_front(), PICTURES / f"{FRONT['name']}.png")
            print(f"docs/images/gallery/{FRONT['name']}.png")
        else:
            print(f"skipped: {FRONT['name']} (its picture stays as it is: name its reference files with --references FOLDER)")


def main():
    if sys.argv[1:2] == ["--check"]:
        sys.exit(check(sys.argv[2]))
    wanted, references, weft = sys.argv[1:], None, str(TOP / "run")
    if wanted[:1] == ["--weft"] and len(wanted) > 1:
        weft, wanted = str(pathlib.Path(wanted[1]).resolve()), wanted[2:]
    if wanted == ["--old"]:
        sys.exit(name_old(weft))
    if wanted[:1] == ["--references"]:
        if len(wanted) < 2 or not pathlib.Path(wanted[1]).is_dir():
            sys.exit("--references needs a folder that exists")
        references, wanted = pathlib.Path(wanted[1]).resolve(), wanted[2:]
    if wanted != ["--pages"]:
        make(weft, wanted, references)
    names = {*commands(), f"{FRONT['name']}.png"}
    for path in PICTURES.glob("*.png"):
        if path.name not in names:
            path.unlink()
    for path, text in pages().items():
        path.write_text(text)
        print(path.relative_to(TOP))


if __name__ == "__main__":
    main()
