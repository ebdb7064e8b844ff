#!/usr/bin/env python3
"""`weft lsp` with an editor that nobody here wrote: Neovim, with the configuration that docs/editors.md gives, does what neovim.lua says. What it
saves passes `weft check`.

    neovim.py WEFT
"""
import os
import pathlib
import shutil
import subprocess
import sys

from program import TOP, Report, count_run, run, temporary_folder

HERE = pathlib.Path(__file__).resolve().parent
CONFIGURATION = TOP / "docs/editors/neovim.lua"


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    if not shutil.which("nvim"):
        report.skip("no nvim: Neovim as an editor for weft lsp")
    report.check(CONFIGURATION.read_text() in (TOP / "docs/editors.md").read_text(), "docs/editors.md shows docs/editors/neovim.lua as it is")
    with temporary_folder() as folder:
        place = pathlib.Path(folder, "with a space")
        shutil.copytree(HERE / "workspace", place)
        count_run()
        environment = {**os.environ, "PATH": f"{weft.parent}:{os.environ['PATH']}", "HOME": folder, "XDG_CACHE_HOME": folder, "XDG_DATA_HOME": folder, "XDG_STATE_HOME": folder}
        result = subprocess.run(["nvim", "--headless", "-i", "NONE", "-n", "-u", CONFIGURATION, "-c", f"luafile {HERE / 'neovim.lua'}"],
                                cwd=place, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        lines = (result.stdout + result.stderr).replace("\r", "").splitlines()
        report.check(result.returncode == 0 and any(line.endswith(" checks, 0 failed") for line in lines), "\n".join(lines))
        report.check('"light": "hdr"' in (place / "main.json").read_text(), "Neovim saved the renamed slot")
        report.check("out vec4 light;" in (place / "shaders/lsp/sky.frag.glsl").read_text(), "and its shader")
        checked = run(weft, "check", "--no-shaders", place / "main.json")
        report.check(checked.code == 0, checked.err)
    report.end()


main()
