#!/usr/bin/env python3
"""Every C++ file is as clang-format makes it with .clang-format. Usage: format.py TOP. Skips (77) without clang-format 14: others
break lines elsewhere."""
import pathlib
import re
import shutil
import subprocess
import sys

VERSION = "14"  # of Debian 12
FOLDERS = ("engine", "importers", "app", "tests")


def main() -> int:
    top = pathlib.Path(sys.argv[1])
    program = shutil.which(f"clang-format-{VERSION}") or shutil.which("clang-format")
    said = subprocess.run([program, "--version"], capture_output=True, text=True).stdout if program else ""
    if f"version {VERSION}." not in said:
        print(f"skipped: no clang-format {VERSION} (found: {said.strip() or 'none'})")
        return 77
    files = sorted(str(f.relative_to(top)) for folder in FOLDERS for f in (top / folder).rglob("*") if f.suffix in {".h", ".cpp"})
    said = subprocess.run([program, "--dry-run", "--Werror", "--style=file", *files], cwd=top, capture_output=True, text=True)
    bad = sorted(set(re.findall(r"^(\S+?):\d+:\d+: error: code should be clang-formatted", said.stderr, re.M)))
    for name in bad:
        print(f"{name}: not as clang-format makes it; clang-format -i {name}")
    if said.returncode != 0 and not bad:
        print(said.stderr)
    if said.returncode == 0:
        print(f"format: {len(files)} files as clang-format {VERSION} makes them")
    return said.returncode


sys.exit(main())
