#!/usr/bin/env python3
"""`weft completion` and `weft man`: bash completes with the script, really run; the page goes through groff without a warning and names every
command and option that --help names; zsh and fish read their scripts, where they are installed.

    completion.py WEFT
"""
import pathlib
import re
import shutil
import subprocess
import sys

from program import TOP, Report, run, temporary_folder

ASK = r"""
source "$1"; shift
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_weft
printf '%s\n' "${COMPREPLY[@]}"
"""


def complete(script, *words, cwd=TOP):
    """What bash offers for the last word."""
    done = subprocess.run(["bash", "-u", "-c", ASK, "bash", script, *words], cwd=cwd, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return [line for line in done.stdout.splitlines() if line]


def options_of(weft, command):
    """As --help lists them."""
    return set(re.findall(r"^  (?:-\w,)?(--[a-z][a-z-]*)", run(weft, command, "--help").out, re.M))


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    commands = re.findall(r"^  ([a-z]+) ", run(weft, "--help").out.split("Subcommands:")[1], re.M)
    report.check(len(commands) > 15, f"{commands}")
    with temporary_folder() as folder:
        script = pathlib.Path(folder, "weft.bash")
        script.write_text(run(weft, "completion", "bash").out)
        report.check(set(complete(script, "weft", "")) == {*commands, "--help", "--version"}, f"{complete(script, 'weft', '')}")
        report.check(complete(script, "weft", "exp") == [c for c in commands if c.startswith("exp")], "weft exp")
        for command in commands:
            offered, listed = set(complete(script, "weft", command, "--")), options_of(weft, command)
            report.check(offered == listed and listed, f"{command}: offered, not in --help {offered - listed}; in --help, not offered {listed - offered}")
        report.check(complete(script, "weft", "render", "g.json", "--backend", "o") == ["osmesa"], "a value")
        report.check(complete(script, "weft", "render", "--backend", "=", "e") == ["egl"], "--backend=e")
        report.check(set(complete(script, "weft", "check", "--format", "")) == {"text", "json", "sarif"}, "all values")
        report.check(complete(script, "weft", "check", "graphs/glo") == ["graphs/glow.json"], "a file")
        report.check(complete(script, "weft", "render", "--scene", "scenes/even") == ["scenes/evening.json"], "the file of an option")
        report.check(complete(script, "weft", "check", "--confine", "sha") == ["shaders"], "a folder")
        report.check(complete(script, "weft", "render", "--fps", "") == [], "a number")
        pathlib.Path(folder, "two words.json").touch()
        report.check(complete(script, "weft", "check", "two", cwd=folder) == ["two words.json"], "a name with a space")
        for shell in ("zsh", "fish"):
            text = run(weft, "completion", shell)
            report.check(text.code == 0 and all(c in text.out for c in commands) and "osmesa" in text.out, shell)
            path = pathlib.Path(folder, f"weft.{shell}")
            path.write_text(text.out)
            if shutil.which(shell):
                done = subprocess.run([shell, "-n", path], capture_output=True, text=True)
                report.check(done.returncode == 0 and not done.stderr, f"{shell}: {done.stderr}")
        report.check(run(weft, "completion", "csh").code == 2, "a shell that there is no script for")

        page = run(weft, "man")
        for tool in (["groff", "-man", "-Tutf8", "-ww", "-z"], ["mandoc", "-T", "lint", "-W", "warning"]):
            if shutil.which(tool[0]):
                done = subprocess.run(tool, input=page.out, capture_output=True, text=True)
                report.check(done.returncode == 0 and not done.stderr and (tool[0] == "groff" or not done.stdout), f"{tool}: {done.stderr}{done.stdout}")
        plain = page.out.replace("\\-", "-")
        for command in commands:
            section = re.search(rf"^\.SS weft {command}\b(.*?)(?=^\.S[SH])", plain, re.M | re.S)
            report.check(bool(section), f"the page has no section for {command}")
            if section:
                named = set(re.findall(r"\\fB(--[a-z-]+)\\fR", section.group(1)))
                report.check(named == options_of(weft, command), f"{command}: {named ^ options_of(weft, command)}")
    report.end()


main()
