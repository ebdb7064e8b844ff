#!/usr/bin/env python3
"""`weft lsp` with a second editor that nobody here wrote: Emacs with eglot, with the configuration that docs/editors.md gives, does what emacs.el
says. What it saves passes `weft check`.

    emacs.py WEFT
"""
import os
import pathlib
import shutil
import subprocess
import sys

from program import TOP, Report, count_run, run, temporary_folder

HERE = pathlib.Path(__file__).resolve().parent
CONFIGURATION = TOP / "docs/editors/emacs.el"


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    if not shutil.which("emacs"):
        report.skip("no emacs: Emacs as an editor for weft lsp")
    with temporary_folder() as folder:
        place = pathlib.Path(folder, "with a space")
        shutil.copytree(HERE / "workspace", place)
        environment = {**os.environ, "PATH": f"{weft.parent}:{os.environ['PATH']}", "HOME": folder}
        emacs = ["emacs", "--batch"]
        if subprocess.run([*emacs, "--eval", "(require 'eglot)"], env=environment, capture_output=True).returncode != 0:
            report.skip("no eglot: Emacs as an editor for weft lsp")
        report.check(CONFIGURATION.read_text() in (TOP / "docs/editors.md").read_text(), "docs/editors.md shows docs/editors/emacs.el as it is")
        count_run()
        result = subprocess.run([*emacs, "-l", CONFIGURATION, "-l", HERE / "emacs.el"], cwd=place, env=environment, stdin=subprocess.DEVNULL,
                                capture_output=True, text=True)
        lines = (result.stdout + result.stderr).splitlines()
        report.check(result.returncode == 0 and any(line.endswith(" checks, 0 failed") for line in lines), "\n".join(lines))
        report.check('"light": "hdr"' in (place / "main.json").read_text(), "Emacs saved the renamed slot")
        report.check("out vec4 light;" in (place / "shaders/lsp/sky.frag.glsl").read_text(), "and its shader")
        checked = run(weft, "check", "--no-shaders", place / "main.json")
        report.check(checked.code == 0, checked.err)
    report.end()


main()
