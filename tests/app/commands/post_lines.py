#!/usr/bin/env python3
"""graphs/post.json is a list of effects, one include a line. post_lines.py WEFT, from the source folder.

Each line but the composite's may be deleted, all of them may, and those that change `hdr` may stand in any order (tried: each next to each, before
and behind it): the studio still passes `check`. One that stands on the wrong side of the composite is named. A deleted
line gives the picture of the effect switched off. A moved one gives another order of passes."""
import pathlib
import re
import shutil
import sys

from program import Report, TOP, run, temporary_folder

LINE = re.compile(r'^    \{ "include": "(?:effects/)?(\w+)\.json".*$', re.M)
SWITCHES = {"depth_of_field": "dof", "taa": "taa", "motion_blur": "motion_blur", "bloom": "bloom", "exposure": "auto_exposure", "fxaa": "fxaa", "boxes": "boxes"}
LAST = ("fxaa", "boxes")  # they change `ldr`


def with_lines(text, lines):
    """The text with these include lines in place of its own."""
    first, last = (list(LINE.finditer(text))[i] for i in (0, -1))
    return text[:first.start()] + ",\n".join(line.rstrip(",") for line in lines) + "\n" + text[last.end() + 1:]


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        for part in ("graphs", "shaders"):
            shutil.copytree(TOP / part, folder / part)
        post, text = folder / "graphs/post.json", (TOP / "graphs/post.json").read_text().replace("device.window && ", "")
        lines = {found[1]: found[0] for found in LINE.finditer(text)}
        if not report.check(set(lines) == {*SWITCHES, "fade", "composite"}, f"name each effect in SWITCHES, and in LAST where it changes `ldr`: {list(lines)}"):
            report.end()
        everything = [word for switch in SWITCHES.values() for word in ("--set", f"{switch}=true")]

        def checked(lines, *arguments):
            post.write_text(with_lines(text, lines))
            made = run(weft, "check", folder / "graphs/studio.json", "--no-shaders", *arguments)
            # Parameters that only a deleted effect read change nothing any more, and W089 says so.
            names = [LINE.match(line)[1] for line in lines]
            said = set(re.findall(r"(?:error|warning)\[(W\d+)\]", made.err))
            report.check(made.code == 0 and bool(made.err) == bool(said) and said <= ({"W089"} if len(names) < len(SWITCHES) + 2 else set()), f"{names}: {made.err}")

        checked(list(lines.values()))
        report.check(post.read_text() == text, "the same lines give the same file")
        checked([lines["composite"]])
        for gone in (*SWITCHES, "fade"):
            checked([line for effect, line in lines.items() if effect != gone], *everything)
        behind = [lines["composite"], *(lines[effect] for effect in LAST)]
        # The fade stands in each place in turn.
        effects = [e for e in SWITCHES if e not in LAST]
        # Williams's design: in the rows and their mirror images each effect is next to each other one.
        count = len(effects)
        steps = [step // 2 if step % 2 == 0 else count - step // 2 for step in range(1, count + 1)]
        rows = [[effects[(first + step) % count] for step in steps] for first in range(count)]
        for i, order in enumerate([*rows, *(row[::-1] for row in rows)]):
            at = i % (len(order) + 1)
            checked([lines[effect] for effect in (*order[:at], "fade", *order[at:])] + behind, *everything)

        # What moves below the composite, or one of the last above it, reaches the picture no more: a warning names its passes.
        for effect in (*SWITCHES, "fade"):
            part = "dof" if effect == "depth_of_field" else effect
            moved = [lines[e] for e in lines if e not in (effect, "fxaa", "composite")]
            moved += [lines[effect], lines["composite"]] if effect in LAST else [lines["composite"], lines[effect], lines["fxaa"]]
            post.write_text(with_lines(text, moved))
            only = [word for e, switch in SWITCHES.items() for word in ("--set", f"{switch}={str(e == effect).lower()}")]
            made = run(weft, "check", folder / "graphs/studio.json", "--no-shaders", *only)
            told = [line for line in made.err.splitlines() if re.search(r"warning\[W(059|090|091)\]", line)]
            report.check(made.code == 0 and any(f"'post.{part}." in line for line in told), f"{effect} on the wrong side of the composite: {made.code}\n{made.err}")

        def passes():
            plan = run(weft, "plan", folder / "graphs/studio.json", *everything).out
            return re.findall(r"^  \d+ post\.(\w+)", plan, re.M)

        post.write_text(text)
        report.check(passes().index("dof") < passes().index("motion_blur"), f"before: {passes()}")
        post.write_text(with_lines(text, [lines[e] for e in ("motion_blur", "depth_of_field")] + behind))
        report.check(passes().index("motion_blur") < passes().index("dof"), f"after: {passes()}")

        def picture(lines, *arguments):
            post.write_text(with_lines(text, lines))
            made = run(weft, "render", folder / "graphs/studio.json", "--size", "96x54", "-o", folder / "a.png", *arguments)
            report.check(made.code == 0, made.err)
            return (folder / "a.png").read_bytes()

        whole = picture(lines.values())
        for effect in ("bloom", "fxaa"):
            without = picture([line for e, line in lines.items() if e != effect])
            report.check(without != whole, f"without {effect}'s line the picture is the same")
            report.check(without == picture(lines.values(), "--set", f"{SWITCHES[effect]}=false"), f"{effect}: no line is not `false`")
            report.check(without == picture(lines.values(), "--disable", effect), f"{effect}: no line is not --disable")
    report.end()


main()
