#!/usr/bin/env python3
"""The gallery: each effect of gallery.json off and on, under one environment. Makes ../gallery.md, a page per family beside this file, and
../images/gallery/*.webp. Pictures are written by cwebp (Debian's package `webp`).

    docs/gallery/gallery.py                 render everything with ./run, keep each picture that looks as before, and write the pages
    docs/gallery/gallery.py NAME ...        only the pictures of these entries or families, then the pages
    docs/gallery/gallery.py --pages         no pictures, only the pages
    docs/gallery/gallery.py --weft WEFT ... as above, by the program WEFT in place of ./run
    docs/gallery/gallery.py --old           render everything in a temporary folder and name the pictures that look different now
    docs/gallery/gallery.py --check WEFT    write nothing: the pages must be those that gallery.json makes, every picture must be there and made by
                                            its command, those of a pair must differ, and `weft check` must take every command

An entry: `name`; `graph`, where it is not the one of `all`; `effect`, its title; `off` and `on`, arguments for `weft render`; `both`, arguments of both;
`says`, what to see; `crop`, [x, y, width, height], where it is too fine to be seen in the whole picture: this part alone, enlarged to the whole size.
Pictures made by equal arguments are made once, and those that must be equal are one file. Each picture holds the command that made it, and its crop.
"""
import hashlib
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

from png import read_png, read_size as size_of_png, write_png
from webp import chunks, read_size, read_webp, read_words, write_webp

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
PICTURES = TOP / "docs/images/gallery"
GALLERY = json.loads((HERE / "gallery.json").read_text())
FAMILIES = GALLERY["families"]
ENTRIES = [entry for family in FAMILIES for entry in family["entries"]]
SIDES = ("off", "on")
SEEN = 6  # of 255: a picture looks different where the mean of a block of 8 x 8 pixels differs by more


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
            names.setdefault(key_of(entry, "on"), f"{entry['name']}.webp")
    for entry in ENTRIES:
        line = key_of(entry, "off")
        names.setdefault(line, f"from_{hashlib.sha256(line.encode()).hexdigest()[:8]}.webp")
        if entry.get("equal"):
            names[key_of(entry, "on")] = names[line]
        line = key_of(entry, "on")
        names.setdefault(line, f"from_{hashlib.sha256(line.encode()).hexdigest()[:8]}.webp")
    return names


NAMES = {}


def picture_of(entry, side):
    NAMES.update(NAMES or named())
    return NAMES[key_of(entry, side)]


def command_of(entry, side):
    return (f"./run render {arguments(entry, side)} --environment {GALLERY['environment']} --size {GALLERY['size']} "
            f"-o out/{picture_of(entry, side).removesuffix('.webp')}.png")


def commands():
    """Picture -> the command that makes it, and its crop. Where pictures are equal, that of the first."""
    made = {}
    for entry in ENTRIES:
        for side in SIDES:
            made.setdefault(picture_of(entry, side), (command_of(entry, side), entry.get("crop")))
    return made


def scale_of(crop):
    return int(GALLERY["size"].split("x")[0]) // crop[2]


def run(weft, command, options):
    """The command by the program `weft`, with other values of some of its options."""
    words = [weft, *shlex.split(command)[1:]]
    for option, value in options.items():
        words[words.index(option) + 1] = str(value)
    done = subprocess.run([*words, "--quiet"], cwd=TOP, capture_output=True, text=True)
    if done.returncode or "error[" in done.stderr:
        sys.exit(f"{shlex.join(words)}\n{done.stderr}")


def enlarged(channels, texels, width, crop):
    """The part as RGB, each texel a square."""
    (x, y, wide, high), scale, rows = crop, scale_of(crop), []
    for row in range(y, y + high):
        part = texels[(row * width + x) * channels:(row * width + x + wide) * channels]
        rows += [b"".join(part[at:at + 3] * scale for at in range(0, len(part), channels))] * scale
    return b"".join(rows)


def blocks(picture, width):
    """Means of blocks of 8 x 8 pixels, channel by channel."""
    channels, texels = picture
    stride, sums = width * channels, {}
    for at in range(0, len(texels) // 8 * 8, channels):
        y, x = at // stride // 8, at % stride // channels // 8
        for channel in range(3):
            sums[y, x, channel] = sums.get((y, x, channel), 0) + texels[at + channel]
    return {key: total / 64 for key, total in sums.items()}


def difference(old, new):
    """The largest difference of two blocks at one place, of 255; 255 where there is no old picture or it has another size."""
    if not old.exists() or read_size(old) != read_size(new):
        return 255
    pair = [blocks(read_webp(path), read_size(path)[0]) for path in (old, new)]
    return max(abs(value - pair[1][key]) for key, value in pair[0].items())


def render(weft, command, picture, crop=None):
    with tempfile.TemporaryDirectory() as folder:
        drawn = pathlib.Path(folder) / "drawn.png"
        run(weft, command, {"-o": drawn})
        if crop:
            (channels, texels), width = read_png(drawn), size_of_png(drawn)[0]
            write_png(drawn, crop[2] * scale_of(crop), 3, enlarged(channels, texels, width, crop))
        write_webp(picture, drawn, words_of(command, crop))


def words_of(command, crop):
    return {"command": command, **({"crop": crop} if crop else {})}


def page(family):
    out = [f"# Gallery: {family['title']}", "", family["about"], "",
           f"[Gallery](../gallery.md), [parameters](../effects.md). Commands go on with `--environment {GALLERY['environment']} --size {GALLERY['size']} -o FILE`.", ""]
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
                "```text", f"./run render {arguments(entry, 'on')}", "```", ""]
    return "\n".join(out).rstrip() + "\n"


def index():
    out = [GALLERY["about"], ""]
    for family in FAMILIES:
        entry, side = next(entry for entry in family["entries"] if entry["name"] == family["cover"]), family.get("side", "on")
        names = ", ".join(entry["effect"] for entry in family["entries"])
        out += [f"## [{family['title']}](gallery/{family['name']}.md)", "", f"{family['about'].replace('](../', '](')} Shown: {names}.", "",
                f"![{entry['effect']}](images/gallery/{picture_of(entry, side)})", ""]
    return "\n".join(out).rstrip() + "\n"


def pages():
    return {TOP / "docs/gallery.md": index(), **{HERE / f"{family['name']}.md": page(family) for family in FAMILIES}}


def check_files():
    problems = []
    made, there = pages(), {*HERE.glob("*.md"), TOP / "docs/gallery.md"}
    problems += [f"{path.relative_to(TOP)} is not what docs/gallery/gallery.json makes; run docs/gallery/gallery.py --pages"
                 for path, text in made.items() if not path.exists() or path.read_text() != text]
    problems += [f"{path.relative_to(TOP)} belongs to no family; delete it" for path in sorted(there - set(made))]
    wanted = commands()
    found = {path.name for path in PICTURES.glob("*.webp")}
    problems += [f"{PICTURES.name}/{name} is not there; run docs/gallery/gallery.py" for name in sorted(set(wanted) - found)]
    problems += [f"{PICTURES.name}/{name} belongs to no entry; delete it" for name in sorted(found - set(wanted))]
    for name in sorted(found & set(wanted)):
        command, crop = wanted[name]
        if (found_words := read_words(PICTURES / name)) != words_of(command, crop):
            problems.append(f"{PICTURES.name}/{name} was made otherwise; expected {words_of(command, crop)}, found {found_words}; run docs/gallery/gallery.py")
        size = re.search(r"--size (\S+)", command)[1]
        if "{}x{}".format(*read_size(PICTURES / name)) != size:
            problems.append(f"{PICTURES.name}/{name} is not {size}; run docs/gallery/gallery.py")
    return problems


def picture_in(name):
    return next(body for kind, body in chunks((PICTURES / name).read_bytes()) if kind == b"VP8 ")


def check_effects(weft):
    """Each pair shows a difference, or none where it says so, and Weft takes each command as it is now."""
    problems = []
    for entry in ENTRIES:
        off, on = (picture_in(picture_of(entry, side)) for side in SIDES)
        if (off == on) != entry.get("equal", False):
            problems.append(f"{entry['name']}: the pictures are {'equal' if off == on else 'not equal'}")
    for line in dict.fromkeys(re.sub(r" --(frames|present) ('[^']*'|\S+)", "", arguments(entry, side)) for entry in ENTRIES for side in SIDES):
        done = subprocess.run([weft, "check", "--no-shaders", *shlex.split(line)], cwd=TOP, capture_output=True, text=True)
        if done.returncode:
            problems.append(f"weft check {line}\n{done.stderr}")
    return problems


def check(weft):
    problems = check_files() or check_effects(weft)
    for problem in problems:
        print(problem)
    print(f"{len(ENTRIES)} entries, {len(problems)} problems")
    return 1 if problems else 0


def name_old(weft):
    old = 0
    with tempfile.TemporaryDirectory() as folder:
        new = pathlib.Path(folder) / "new.webp"
        for name, (command, crop) in commands().items():
            render(weft, command, new, crop)
            if (seen := difference(PICTURES / name, new)) > SEEN:
                old += 1
                print(f"{name}: a block of 8 x 8 pixels differs by {seen:.0f} of 255", flush=True)
    print(f"{old} of {len(commands())} pictures look different now")
    return 1 if old else 0


def make(weft, wanted):
    """A picture that looks as it did keeps its bytes, unless its command is another one."""
    PICTURES.mkdir(parents=True, exist_ok=True)
    known = {family["name"]: family["entries"] for family in FAMILIES} | {entry["name"]: [entry] for entry in ENTRIES}
    if unknown := set(wanted) - set(known):
        sys.exit(f"no entry and no family is called {', '.join(sorted(unknown))}")
    names = {picture_of(entry, side) for name in wanted or known for entry in known[name] for side in SIDES}
    with tempfile.TemporaryDirectory() as folder:
        new = pathlib.Path(folder) / "new.webp"
        for name, (command, crop) in commands().items():
            if name in names:
                render(weft, command, new, crop)
                old = PICTURES / name
                if not old.exists() or read_words(old) != read_words(new) or difference(old, new) > SEEN:
                    old.write_bytes(new.read_bytes())
                    print(f"docs/images/gallery/{name}", flush=True)


def main():
    if sys.argv[1:2] == ["--check"]:
        sys.exit(check(sys.argv[2]))
    wanted, weft = sys.argv[1:], str(TOP / "run")
    if wanted[:1] == ["--weft"] and len(wanted) > 1:
        weft, wanted = str(pathlib.Path(wanted[1]).resolve()), wanted[2:]
    if wanted == ["--old"]:
        sys.exit(name_old(weft))
    if wanted != ["--pages"]:
        make(weft, wanted)
    for path in PICTURES.glob("*.webp"):
        if path.name not in commands():
            path.unlink()
    for path, text in pages().items():
        path.write_text(text)
        print(path.relative_to(TOP))


if __name__ == "__main__":
    main()
