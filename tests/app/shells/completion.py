#!/usr/bin/env python3
"""`weft completion`: bash, zsh and fish, really run, offer with the script what --help lists, and files and folders where these are meant.

    completion.py WEFT bash|zsh|fish
"""
import pathlib
import re
import shutil
import subprocess
import sys

from program import TOP, Report, run, temporary_folder
from shells import ask

FOUND = {"bash": shutil.which("bash"), "zsh": shutil.which("zsh"), "fish": shutil.which("fish")}
INNER = ["new pass"]  # commands of commands
# Behind an option: a file, a folder, or neither. In a folder that has one of both, the file offers nothing where a folder is meant.
KINDS = {"file": ["a_file", "a_folder"], "folder": ["a_folder"], "number": []}
MEANT = (("file", "bench --frame"), ("file", "bench --edit"), ("file", "test --report"), ("file", "render -o"),
         ("file", "render --trace"), ("file", "view --record"), ("file", "bisect --other-preset"), ("file", "new pass --graph"),
         ("file", "check"), ("file", "test"), ("file", "import"), ("file", "lsp --scene"),
         ("folder", "dump -o"), ("folder", "import --output"), ("folder", "test -o"), ("folder", "new pass -o"), ("folder", "render --program-cache"),
         ("folder", "check --preset-folder"), ("folder", "new pass --confine"),
         ("number", "fuzz --frame"), ("number", "bisect --frame"), ("number", "ablate --frame"), ("number", "render --fps"), ("number", "new pass --limit"))


def options_of(weft, command):
    """As --help lists them."""
    return set(re.findall(r"^  (?:-\w,)?(--[a-z][a-z-]*)", run(weft, *command.split(), "--help").out, re.M))


def commands_of(weft):
    return re.findall(r"^  ([a-z]+) ", run(weft, "--help").out.split("Subcommands:")[1], re.M)


def check_shell(weft, shell, report, folder):
    commands = commands_of(weft)
    report.check(len(commands) > 15, f"{commands}")
    script = pathlib.Path(folder, f"weft.{shell}")
    script.write_text(run(weft, "completion", shell).out)
    read = subprocess.run([FOUND[shell], "-n", script], capture_output=True, text=True)
    report.check(read.returncode == 0 and not read.stderr, f"{shell}: {read.stderr}")

    wanted = {f"weft {command} --": sorted(options_of(weft, command)) for command in [*commands, *INNER]}
    report.check(all(wanted.values()), f"commands without options: {wanted}")
    wanted |= {"weft ": sorted(commands), "weft --": ["--help", "--version"], "weft exp": sorted(c for c in commands if c.startswith("exp")),
               "weft new ": ["pass"], "weft render g.json --backend o": ["osmesa"], "weft render --backend=e": ["egl"],
               "weft check --format ": ["json", "sarif", "text"], "weft check graphs/glo": ["glow.json"],
               "weft render --scene scenes/even": ["evening.json"], "weft check --confine sha": ["shaders"]}
    for (line, expected), offered in zip(wanted.items(), ask(shell, script, list(wanted), TOP, folder)):
        # An option that takes a value may stand as `--backend=egl`; options beside commands are no mistake.
        offered = sorted({word.split("=")[-1] if "=" in line else word.rstrip("=") for word in offered})
        if line == "weft ":
            offered = [word for word in offered if not word.startswith("--")]
        report.check(offered == expected, f"'{line}': offered {offered}, expected {expected}")

    here = pathlib.Path(folder, "here")
    here.joinpath("a_folder").mkdir(parents=True)
    here.joinpath("a_file").touch()
    lines = [f"weft {words} {'a_' if kind != 'number' else ''}" for kind, words in MEANT]
    for (kind, words), offered in zip(MEANT, ask(shell, script, lines, here, folder)):
        report.check(offered == KINDS[kind], f"{words}: {offered} instead of {KINDS[kind]}")
    here.joinpath("two words.json").touch()
    offered = ask(shell, script, ["weft check two"], here, folder)[0]
    report.check(offered == ["two words.json"], f"a name with a space: {offered}")


def check_mistakes(weft, report):
    report.check(run(weft, "completion", "csh").code == 2, "a shell that there is no script for")
    # An option that a command of a command has is no wrong one.
    result = run(weft, "new", "pass", "tint", "--graph", "g.json", "--bogus")
    report.check(result.code == 2 and result.err.startswith("weft new pass: unknown option '--bogus'") and "'--graph'" not in result.err, result.err)
    result = run(weft, "new", "pass", "tint", "--grap", "g.json")
    report.check(result.code == 2 and "did you mean '--graph'?" in result.err, result.err)
    result = run(weft, "new", "pass", "9", "--confine", ".", "--limit", "frames=7")
    report.check(result.code == 1 and result.codes() == ["W012"], f"new pass --confine --limit: {result.code} {result.err}")


def main():
    weft, shell, report = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], Report()
    if not FOUND[shell]:
        report.skip(f"{shell} is not installed")
    with temporary_folder() as folder:
        check_shell(weft, shell, report, folder)
    if shell == "bash":
        check_mistakes(weft, report)
    report.end()


if __name__ == "__main__":
    main()
