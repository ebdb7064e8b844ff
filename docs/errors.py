#!/usr/bin/env python3
"""Makes docs/errors.md: the codes of engine/text/codes.json, with titles and explanations, and what the program prints for a
file of tests/bad_graphs. `weft explain W053` prints a section of the page.

    docs/errors.py [WEFT]         write the page (by ./run, or by the program WEFT)
    docs/errors.py --check WEFT   write nothing; say whether the page is what this makes
"""
import json
import os
import pathlib
import re
import subprocess
import sys

TOP = pathlib.Path(__file__).resolve().parents[1]
PAGE = TOP / "docs/errors.md"
BAD = TOP / "tests/bad_graphs"
HEAD = """# Errors

Every diagnostic code, in order: what it means and what mends it. `weft explain W053` prints one section. A diagnostic reads
`file:line:column: error[W012]: message`, followed by the pass and the resource concerned, what was expected, what was found, and the fix. Lines
and columns are counted from 1, columns in bytes; the value of an option is at `command line: --set bloom=yes`. Everything wrong is reported at
once. Control characters and broken UTF-8 are printed as `\\n`, `\\x1b`, `\\u{202e}`; long words and fields are cut.

`docs/errors.py` makes this page from `engine/text/codes.json` and the files of `tests/bad_graphs`. Codes are never reused.
"""


def printed(weft, entry):
    """What `weft check` says of the file without OpenGL, where it says the code once."""
    options = [word for option in ("set", "disable") for value in entry.get(option, []) for word in (f"--{option}", value)]
    done = subprocess.run([weft, "check", "--no-shaders", entry["file"], *options], cwd=BAD, capture_output=True, text=True,
                          env={**os.environ, "WEFT_DATA": str(TOP)})
    said = re.findall(r"^\S.*\n(?: .*\n)*", done.stdout + done.stderr, re.M)
    of_code = [text.rstrip("\n") for text in said if f"[{entry['code']}]: " in text.partition("\n")[0]]
    return of_code[0] if len(of_code) == 1 else None


def page(weft):
    codes = json.loads((TOP / "engine/text/codes.json").read_text())
    files = json.loads((BAD / "manifest.json").read_text())["files"]
    out = [HEAD]
    for code, row in codes.items():
        out += [f"## {code}: {row['title']}", "", row["text"], ""]
        example = next((text for entry in files if entry["code"] == code and (text := printed(weft, entry))), None)
        if example:
            out += ["```text", example, "```", ""]
    return "\n".join(out).rstrip("\n") + "\n"


def main():
    words = sys.argv[1:]
    check = words[:1] == ["--check"]
    made = page(pathlib.Path((words[check:] or [TOP / "run"])[0]).resolve())
    if not check:
        PAGE.write_text(made)
    elif made != PAGE.read_text():
        sys.exit("docs/errors.md is not what docs/errors.py makes; run it")


main()
