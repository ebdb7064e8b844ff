#!/usr/bin/env python3
"""`weft schema` held against python3-jsonschema, which shares no code with Weft: every bundled graph, overlay and preset, and every graph of the tests that
`weft check` takes, is valid; every broken graph whose mistake is one of form is not. CANNOT_SAY lists mistakes of form that the schema lets pass, and why; one that it
has learned to catch fails here, too.

    schema.py WEFT
"""
import importlib.util
import json
import pathlib
import re
import sys

from program import TOP, Report, run

# Codes of mistakes that lie in the form of a file: keys, types, words, names of the language.
OF_FORM = {"W003", "W004", "W005", "W011", "W012", "W018", "W042"}
CANNOT_SAY = {
    "w003_vector_too_short.json": "how long a default must be follows from \"type\"",
    "w003_default_of_wrong_type.json": "what a default may be follows from \"type\"",
    "w005_word_without_choices.json": "that a word needs \"choices\" follows from the kind of the default",
    "w012_define_of_glsl.json": "the reserved words of GLSL",
    "w012_word_of_glsl.json": "the reserved words of GLSL",
    "w012_include_prefix.json": "a prefix that comes from a file's name",
    "w018_pass_and_include.json": "that the file below has an include of this name",
    "w018_texture_and_buffer.json": "of what kind the file below declares it",
}


def without_comments(text):
    return re.sub(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', lambda m: m.group(0) if m.group(0)[0] == '"' else " ", text, flags=re.S)


def read(path):
    return json.loads(without_comments(path.read_text(encoding="utf-8-sig")))


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    if not importlib.util.find_spec("jsonschema"):
        report.skip("python3-jsonschema is not installed")
    import jsonschema
    schema = json.loads(run(weft, "schema").out)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)

    good = [*sorted((TOP / "graphs").rglob("*.json")), *sorted((TOP / "tests/golden").glob("*.json")), *sorted((TOP / "tests/app/lsp/workspace").glob("*.json"))]
    graphs = [path for path in good if {"passes", "set", "extends"} & set(read(path))]
    report.check(len(graphs) > 30, f"{len(graphs)} graphs")
    for path in graphs:
        errors = [f"{'/'.join(map(str, e.absolute_path))}: {e.message[:200]}" for e in validator.iter_errors(read(path))]
        report.check(not errors, f"{path.relative_to(TOP)} is valid: {errors[:3]}")

    caught, passed = set(), set()
    for entry in json.loads((TOP / "tests/bad_graphs/manifest.json").read_text())["files"]:
        if entry["code"] not in OF_FORM or "set" in entry or "in" in entry:
            continue
        (caught if list(validator.iter_errors(read(TOP / "tests/bad_graphs" / entry["file"]))) else passed).add(entry["file"])
    report.check(len(caught) > 20, f"{len(caught)} broken graphs are invalid")
    report.check(passed == set(CANNOT_SAY), f"valid, and not listed in CANNOT_SAY: {sorted(passed - set(CANNOT_SAY))}; listed, and invalid: {sorted(set(CANNOT_SAY) - passed)}")
    # What is no mistake of form is valid where it is JSON: the schema says nothing of names and numbers.
    print(f"{len(graphs)} graphs are valid, {len(caught)} broken ones are not, {len(passed)} are beyond it")
    report.end()


if __name__ == "__main__":
    main()
