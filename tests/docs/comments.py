#!/usr/bin/env python3
"""Comments in C++, shaders and graphs name only files that exist: `words.h`, `shaders/bounds.h`, `docs/shaders.md`. A name with folders
must be the end of a path, and a `*` in it stands for anything. A file of shaders/ begins with a comment. Usage: comments.py TOP"""
import fnmatch
import pathlib
import re
import sys

FOLDERS = ("engine", "importers", "app", "shaders", "graphs", "tests/docs/embed")
SUFFIXES = {".h", ".cpp", ".glsl", ".json"}
COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|//([^\n]*)')
NAME = re.compile(r"(?<![\w./*-])[\w*][\w./*-]*\.(?:h|cpp|glsl|json|md|py)\b(?!\.?\w)")
OUTSIDE = {"linux/magic.h", "GL/gl.h", "osmesa.h"}  # headers of the system and of libraries


def main() -> int:
    top = pathlib.Path(sys.argv[1])
    parts = ("app", "cmake", "docs", "engine", "graphs", "importers", "materials", "scenes", "shaders", "tests", "words")
    files = [f"/{path.relative_to(top).as_posix()}" for part in parts for path in (top / part).rglob("*") if path.is_file()]
    files += [f"/{path.name}" for path in top.iterdir() if path.is_file()]
    known, problems, names = {file.rsplit("/", 1)[1] for file in files}, [], 0
    for folder in FOLDERS:
        for path in sorted((top / folder).rglob("*")):
            if path.suffix not in SUFFIXES:
                continue
            text = path.read_text()
            if folder == "shaders" and not text.startswith("//"):
                problems.append(f"{path.relative_to(top)}:1: begin with what it is, and with its slots and parameters")
            for number, line in enumerate(text.splitlines(), 1):
                for comment in COMMENT.findall(line):
                    for name in NAME.findall(comment):
                        names += 1
                        plain = "/" not in name and "*" not in name
                        found = name in known if plain else any(fnmatch.fnmatchcase(file, f"*/{name}") for file in files)
                        if not found and name not in OUTSIDE:
                            problems.append(f"{path.relative_to(top)}:{number}: a comment names {name}, which does not exist; "
                                            "name the file that has it now")
    print("\n".join(problems) or f"comments: {names} names of files, each exists")
    return 1 if problems or names < 100 else 0


sys.exit(main())
