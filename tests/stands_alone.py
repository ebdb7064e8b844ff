#!/usr/bin/env python3
"""Nothing in this folder names a folder beside it. Binary files are not looked at.

    stands_alone.py TOP
"""
import os
import pathlib
import re
import sys

LEFT_OUT = {".git", "build", "out", "__pycache__", ".cache"}
# That folder, however deep it is written. The word is put together here, so that this file does not name it.
OUTSIDE = re.compile(r"\.\./" + "shared" + r"\b")


def text_files(top):
    for folder, folders, names in os.walk(top):
        folders[:] = [f for f in folders if f not in LEFT_OUT and not f.startswith("build")]
        for name in names:
            path = pathlib.Path(folder) / name
            try:
                yield path.relative_to(top).as_posix(), path.read_text()
            except (UnicodeDecodeError, OSError):
                pass


def main():
    top = pathlib.Path(sys.argv[1]).resolve()
    problems, seen = [], 0
    for name, text in text_files(top):
        seen += 1
        for number, line in enumerate(text.splitlines(), 1):
            if OUTSIDE.search(line):
                problems.append(f"{name}:{number}: names a folder outside: {line.strip()[:120]}")
    print("\n".join(problems) or f"stands_alone: {seen} files, none names a folder outside")
    return 1 if problems or seen < 100 else 0


sys.exit(main())
