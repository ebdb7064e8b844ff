#!/usr/bin/env python3
"""The gallery: each effect of gallery.json and models.json off and on, under one environment, as ../gallery.md, ../gallery_models.md and
../images/gallery/*.png.

    docs/gallery/gallery.py                 render everything anew with ./run and write the pages
    docs/gallery/gallery.py NAME ...        only the pictures of these entries, then the pages
    docs/gallery/gallery.py --references FOLDER ...
                                            as above; only with the reference files in FOLDER is the front view made anew
    docs/gallery/gallery.py --check WEFT    write nothing: the pages must be those that the files make, every picture
                                            must be there, every property must be a test, and every effect, rendered small,
                                            must change the picture

An entry: `name`; `graph`, where it is not the one of `all`; `effect`, its title; `off` and `on`, arguments for `weft render`; `both`, arguments of both; `says`, what
to see; `property`, [test file, beginning of the name of a test case]. Pictures made by equal arguments are made once.
"""
import hashlib
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

from png import read_png

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
PICTURES = TOP / "docs/images/gallery"
GALLERY, MODELS = (json.loads((HERE / f"{name}.json").read_text()) for name in ("gallery", "models"))
PAGES = {TOP / "docs/gallery.md": GALLERY, TOP / "docs/gallery_models.md": MODELS}
ENTRIES = [*GALLERY["entries"], *MODELS["entries"]]
ENVIRONMENT = GALLERY["environment"]


def graph_of(entry):
    return entry.get("graph", GALLERY["all"])


def arguments(entry, side):
    return shlex.split(" ".join(text for text in (graph_of(entry), entry.get("both", ""), entry.get(side, "")) if text))


def picture_of(entry, side):
    """What several entries may share has a name made from its arguments."""
    if side == "on" and "on" in entry:
        return f"{entry['name']}.png"
    line = " ".join(arguments(entry, side))
    return f"from_{hashlib.sha256(line.encode()).hexdigest()[:8]}.png"


def render(weft, entry, side, output, size=None):
    run_weft([*weft, "render", *arguments(entry, side), "--quiet", "-o", str(output), "--size", size or GALLERY["size"],
              "--environment", ENVIRONMENT])


def render_front(references):
    front = GALLERY["front"]
    run_weft([str(TOP / "run"), "render", GALLERY["all"], "--quiet", "-o", str(PICTURES / f"{front['name']}.png"), "--size", front["size"],
              *(text for key in ("materials", "environment") for text in (f"--{key}", str(references / front[key])))])


def run_weft(line):
    done = subprocess.run(line, cwd=TOP, capture_output=True, text=True)
    if done.returncode or "error[" in done.stderr:
        sys.exit(f"{' '.join(line)}\n{done.stderr}")


def cases(file):
    """The names of the test cases in a file; a name may be written in several literals."""
    text = re.sub(r'"\s*\n\s*"', "", (TOP / file).read_text())
    return re.findall(r'TEST_CASE(?:_FIXTURE)?\(\s*(?:\w+,\s*)?"([^"]*)"', text)


def case_of(entry):
    file, beginning = entry["property"]
    if file.endswith(".py"):  # words of what the script says it does
        return beginning if beginning in " ".join((TOP / file).read_text().split()) else None
    return next((case for case in cases(file) if case.startswith(beginning)), None)


def page(gallery):
    out = [gallery["about"], ""]
    chapter = None
    for entry in gallery["entries"]:
        if entry["chapter"] != chapter:
            chapter = entry["chapter"]
            out += [f"## {chapter}", ""]
        off, on = (entry.get(side) or "as it is" for side in ("off", "on"))
        both = f" Graph: `{entry['graph']}`." if "graph" in entry else ""
        both += f" Both: `{entry['both']}`." if entry.get("both") else ""
        out += [f"### {entry['effect']}", "", f"{entry['says']}{both}", "",
                f"| `{off}` | `{on}` |", "|---|---|",
                f"| ![off](images/gallery/{picture_of(entry, 'off')}) | ![on](images/gallery/{picture_of(entry, 'on')}) |", ""]
        out += [f"Held by `{entry['property'][0]}`: {case_of(entry)}.", ""]
    if front := gallery.get("front"):
        out += [f"## {front['effect']}", "", front["says"], "", f"![front view](images/gallery/{front['name']}.png)"]
    return "\n".join(out).rstrip() + "\n"


def all_pictures():
    pairs = {picture_of(entry, side) for entry in ENTRIES for side in ("off", "on")}
    return pairs | {f"{GALLERY['front']['name']}.png"}


def check(weft):
    problems = []
    for path, gallery in PAGES.items():
        if not path.exists() or path.read_text() != page(gallery):
            problems.append(f"docs/{path.name} is not what its file in docs/gallery makes; run docs/gallery/gallery.py")
    names = all_pictures()
    there = {path.name for path in PICTURES.glob("*.png")}
    problems += [f"{PICTURES.name}/{name} is not there" for name in sorted(names - there)]
    problems += [f"{PICTURES.name}/{name} belongs to no entry" for name in sorted(there - names)]
    for entry in ENTRIES:
        if not case_of(entry):
            problems.append(f"{entry['name']}: there is no test case {entry['property']}")
    with tempfile.TemporaryDirectory() as folder:
        made = {}
        for entry in ENTRIES:
            for side in ("off", "on"):
                key = picture_of(entry, side)
                if key not in made:
                    path = pathlib.Path(folder) / key
                    render([weft], entry, side, path, GALLERY["check_size"])
                    made[key] = read_png(path)[1]
            off, on = (made[picture_of(entry, side)] for side in ("off", "on"))
            changed = sum(a != b for a, b in zip(off, on)) / len(off)
            equal = entry.get("equal", False)
            if (changed > 0) == equal:
                problems.append(f"{entry['name']}: {changed:.2%} of the values differ, and {'none' if equal else 'some'} should")
            if max(on) == min(on):
                problems.append(f"{entry['name']}: the picture is one flat value")
    for problem in problems:
        print(problem)
    print(f"{len(ENTRIES)} entries, {len(problems)} problems")
    return 1 if problems else 0


def main():
    if sys.argv[1:2] == ["--check"]:
        sys.exit(check(sys.argv[2]))
    wanted, references = sys.argv[1:], None
    if wanted[:1] == ["--references"]:
        if len(wanted) < 2 or not pathlib.Path(wanted[1]).is_dir():
            sys.exit("--references needs a folder that exists")
        references, wanted = pathlib.Path(wanted[1]).resolve(), wanted[2:]
    PICTURES.mkdir(parents=True, exist_ok=True)
    known = [entry["name"] for entry in [*ENTRIES, GALLERY["front"]]]
    wanted = wanted or known
    unknown = set(wanted) - set(known)
    if unknown:
        sys.exit(f"no entry is called {', '.join(sorted(unknown))}")
    made = set()
    for entry in ENTRIES:
        for side in ("off", "on"):
            name = picture_of(entry, side)
            if entry["name"] in wanted and name not in made:
                render([str(TOP / "run")], entry, side, PICTURES / name)
                made.add(name)
                print(f"docs/images/gallery/{name}")
    front = GALLERY["front"]
    if front["name"] in wanted:
        if references:
            render_front(references)
            print(f"docs/images/gallery/{front['name']}.png")
        else:
            print(f"skipped: {front['name']} (its picture stays as it is: name its reference files with --references FOLDER)")
    names = all_pictures()
    for path in PICTURES.glob("*.png"):
        if path.name not in names:
            path.unlink()
    for path, gallery in PAGES.items():
        path.write_text(page(gallery))
        print(f"docs/{path.name}")


if __name__ == "__main__":
    main()
