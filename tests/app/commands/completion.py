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
    return set(re.findall(r"^  (?:-\w,)?(--[a-z][a-z-]*)", run(weft, *command.split(), "--help").out, re.M))


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    commands = re.findall(r"^  ([a-z]+) ", run(weft, "--help").out.split("Subcommands:")[1], re.M)
    report.check(len(commands) > 15, f"{commands}")
    inner = ["new pass"]  # commands of commands
    with temporary_folder() as folder:
        script = pathlib.Path(folder, "weft.bash")
        script.write_text(run(weft, "completion", "bash").out)
        report.check(set(complete(script, "weft", "")) == {*commands, "--help", "--version"}, f"{complete(script, 'weft', '')}")
        report.check(complete(script, "weft", "exp") == [c for c in commands if c.startswith("exp")], "weft exp")
        report.check(complete(script, "weft", "new", "") == ["pass"], f"{complete(script, 'weft', 'new', '')}")
        for command in [*commands, *inner]:
            offered, listed = set(complete(script, "weft", *command.split(), "--")), options_of(weft, command)
            report.check(offered == listed and listed, f"{command}: offered, not in --help {offered - listed}; in --help, not offered {listed - offered}")
        report.check(complete(script, "weft", "render", "g.json", "--backend", "o") == ["osmesa"], "a value")
        report.check(complete(script, "weft", "render", "--backend", "=", "e") == ["egl"], "--backend=e")
        report.check(set(complete(script, "weft", "check", "--format", "")) == {"text", "json", "sarif"}, "all values")
        report.check(complete(script, "weft", "check", "graphs/glo") == ["graphs/glow.json"], "a file")
        report.check(complete(script, "weft", "render", "--scene", "scenes/even") == ["scenes/evening.json"], "the file of an option")
        report.check(complete(script, "weft", "check", "--confine", "sha") == ["shaders"], "a folder")
        # Behind an option: a file, a folder, or neither. In a folder that has one of both, the file offers nothing where a folder is meant.
        here = pathlib.Path(folder, "here")
        here.joinpath("a_folder").mkdir(parents=True)
        here.joinpath("a_file").touch()
        kinds = {"file": ["a_file", "a_folder"], "folder": ["a_folder"], "number": []}
        for kind, words in (("file", "bench --frame"), ("file", "bench --edit"), ("file", "bench --workload"), ("file", "test --report"), ("file", "render -o"),
                            ("file", "render --trace"), ("file", "view --record"), ("file", "bisect --other-preset"), ("file", "new pass --graph"),
                            ("file", "check"), ("file", "test"), ("file", "import"), ("file", "lsp --scene"),
                            ("folder", "dump -o"), ("folder", "import --output"), ("folder", "test -o"), ("folder", "new pass -o"), ("folder", "render --program-cache"),
                            ("folder", "check --preset-folder"), ("folder", "new pass --confine"),
                            ("number", "fuzz --frame"), ("number", "bisect --frame"), ("number", "ablate --frame"), ("number", "render --fps"), ("number", "new pass --limit")):
            offered = sorted(complete(script, "weft", *words.split(), "a_" if kind != "number" else "", cwd=here))
            report.check(offered == kinds[kind], f"{words}: {offered} instead of {kinds[kind]}")
        pathlib.Path(folder, "two words.json").touch()
        report.check(complete(script, "weft", "check", "two", cwd=folder) == ["two words.json"], "a name with a space")
        for shell in ("zsh", "fish"):
            text = run(weft, "completion", shell)
            report.check(text.code == 0 and all(c in text.out for c in [*commands, "pass"]) and "osmesa" in text.out, shell)
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
        for command in [*commands, *inner]:
            section = re.search(rf"^\.SS weft {command}\b(.*?)(?=^\.S[SH])", plain, re.M | re.S)
            report.check(bool(section), f"the page has no section for {command}")
            if section:
                named = set(re.findall(r"\\fB(--[a-z-]+)\\fR", section.group(1)))
                report.check(named == options_of(weft, command), f"{command}: {named ^ options_of(weft, command)}")
        report.check(".SS weft new pass name" in plain, "what stands behind new pass")

    # An option that a command of a command has is no wrong one.
    result = run(weft, "new", "pass", "tint", "--graph", "g.json", "--bogus")
    report.check(result.code == 2 and result.err.startswith("weft new pass: unknown option '--bogus'") and "'--graph'" not in result.err, result.err)
    result = run(weft, "new", "pass", "tint", "--grap", "g.json")
    report.check(result.code == 2 and "did you mean '--graph'?" in result.err, result.err)
    result = run(weft, "new", "pass", "9", "--confine", ".", "--limit", "frames=7")
    report.check(result.code == 1 and result.codes() == ["W012"], f"new pass --confine --limit: {result.code} {result.err}")
    report.end()


main()
