#!/usr/bin/env python3
"""What commands load before they need OpenGL: nothing of it. A command that draws nothing loads no OpenGL driver, and one that draws refuses a
wrong graph before it loads one; a sound graph is drawn with one, so that the look into the dynamic linker is known to see it.

    before_opengl.py WEFT
"""
import pathlib
import sys

from drivers import drivers_of, watched
from program import Report, run, temporary_folder

GLOW, WRONG = "graphs/glow.json", "tests/bad_graphs/w004_width.json"
SMALL = ["--size", "64x36"]


def drivers(weft, *arguments):
    """What ended, and the drivers that it loaded."""
    with temporary_folder() as folder:
        done = run(weft, *arguments, env=watched(folder))
        return done, drivers_of(folder)


def main():
    weft, report = sys.argv[1], Report()
    if drivers(weft, "--version")[1] is None:
        report.skip("the dynamic linker does not say what it loads")
    with temporary_folder() as folder:
        for command in (["--version"], ["check", "--no-shaders", GLOW], ["plan", GLOW], ["check", WRONG]):
            done, found = drivers(weft, *command)
            report.check(done.code == (WRONG in command) and not found, f"{command}: {done.code}, loads {found}\n{done.err}")
        cases = pathlib.Path(folder, "cases")
        cases.mkdir()
        (cases / "a.cases.json").write_text(f'{{"cases": [{{"name": "a", "graph": "{pathlib.Path(WRONG).resolve()}", "size": "64x36"}}]}}')
        for code, *command in ((1, "render", WRONG, "-o", f"{folder}/a.png"), (1, "dump", WRONG, "*", "-o", f"{folder}/b"), (2, "fuzz", WRONG),
                               (2, "bisect", WRONG), (2, "bisect", GLOW, WRONG), (2, "diff", "--render", WRONG, GLOW), (2, "diff", "--render", GLOW, WRONG)):
            done, found = drivers(weft, *command, *SMALL)
            report.check(done.code == code and done.codes() == ["W004"] and not found, f"{command}: {done.code}, loads {found}\n{done.err}")
        done, found = drivers(weft, "test", cases)
        report.check(done.code == 2 and "W004" in done.codes() and not found, f"test: {done.code}, loads {found}\n{done.out}{done.err}")
        done, found = drivers(weft, "render", "--quiet", GLOW, *SMALL, "-o", f"{folder}/a.png", "--backend", "osmesa")
        report.check(done.code == 0 and found, f"a sound graph is drawn without a driver: {done.code}, {found}\n{done.err}")
        piped = run(weft, "render", "--quiet", "/dev/stdin", *SMALL, "-o", f"{folder}/piped.png", input=pathlib.Path(GLOW).read_text())
        report.check(piped.code == 0, f"a graph that can be read once: {piped.code}\n{piped.err}")
    report.end()


main()
