#!/usr/bin/env python3
"""`weft schema` held against python3-jsonschema, which shares no code with Weft: every bundled graph, overlay and preset, and every graph of the tests that
`weft check` takes, is valid. Of the broken graphs, all of them, those whose mistake is one of form are not valid, and those with any other mistake are: the schema
knows keys, types and words, and nothing of names, numbers and other files. CANNOT_SAY lists mistakes of form that it lets pass, SEES other mistakes that it
finds, PYTHON_READS what is no JSON but to Python's reader, each with the reason. One that is listed and behaves otherwise fails here, too.

    schema.py WEFT
"""
import importlib.util
import json
import pathlib
import re
import sys

from program import GRAPH_FOLDERS, TOP, Report, run

# Codes of mistakes that lie in the form of a file: keys, types, words, names of the language.
OF_FORM = {"W003", "W004", "W005", "W011", "W012", "W018", "W042"}
CANNOT_SAY = {
    "w003_vector_too_short.json": "how long a default must be follows from \"type\"",
    "w003_default_of_wrong_type.json": "what a default may be follows from \"type\"",
    "w005_word_without_choices.json": "that a word needs \"choices\" follows from the kind of the default",
    "w012_define_of_glsl.json": "the reserved words of GLSL",
    "w012_define_of_a_function.json": "the functions of GLSL",
    "w012_reserved_define.json": "names that the engine defines",
    "w005_set_without_type.json": "what the sets of a pass hold",
    "w005_pass_without_type.json": "that a pass has a shader or a type, which a group may say for it",
    "w012_two_underscores.json": "names that GLSL keeps for itself",
    "w012_word_of_glsl.json": "the reserved words of GLSL",
    "w012_list.json": "what an item of a list may be follows from the key",
    "w012_include_prefix.json": "a prefix that comes from a file's name",
    "w042_choice.json": "which words a choice may give",
    "w018_pass_and_include.json": "that the file below has an include of this name",
    "w018_texture_and_buffer.json": "of what kind the file below declares it",
}
SEES = {
    "w007_deep.json": "it is a list, and a graph is an object",
    "w014_group_in_group.json": "a group is no pass",
    "w014_two_kinds.json": "each kind of resource has keys of its own",
    "w019_remove.json": "the keys of an overlay do not stand in a graph without \"extends\"",
    "w026_every.json": "the words of \"update\"",
}
PYTHON_READS = {
    "w002_huge_number.json": "a number beyond all floating-point numbers is infinite there",
    "w002_nan.json": "NaN is a number there",
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

    good = [path for folder in GRAPH_FOLDERS for path in sorted((TOP / folder).rglob("*.json"))]
    graphs = [path for path in good if isinstance(read(path), dict) and {"passes", "set", "extends"} & set(read(path))]
    report.check(len(graphs) > 80, f"{len(graphs)} graphs")
    for path in graphs:
        errors = [f"{'/'.join(map(str, e.absolute_path))}: {e.message[:200]}" for e in validator.iter_errors(read(path))]
        report.check(not errors, f"{path.relative_to(TOP)} is valid: {errors[:3]}")

    caught, passed, unread = set(), set(), set()
    entries = json.loads((TOP / "tests/bad_graphs/manifest.json").read_text())["files"]
    for entry in entries:
        try:
            graph = read(TOP / "tests/bad_graphs" / entry["file"])
        except ValueError:  # no JSON, or no UTF-8
            unread.add(entry["file"])
        else:
            (passed if validator.is_valid(graph) else caught).add(entry["file"])

    def same(found, expected, what):
        report.check(found == expected, f"{what}: {sorted(found - expected)} should not be, {sorted(expected - found)} should")

    of_form = {entry["file"] for entry in entries if entry["code"] in OF_FORM}
    no_json = {entry["file"] for entry in entries if entry["code"] == "W002"}
    report.check(len(entries) > 200 and len(of_form) > 30 and len(no_json) > 10, f"{len(entries)} broken graphs, {len(of_form)} with mistakes of form, {len(no_json)} that are no JSON")
    report.check(set(CANNOT_SAY) <= of_form and not set(SEES) & of_form and set(PYTHON_READS) <= no_json, "an exception that is none")
    same(unread, no_json - set(PYTHON_READS), "no JSON to Python")
    same(caught, of_form - set(CANNOT_SAY) | set(SEES), "invalid by the schema")
    print(f"{len(graphs)} graphs are valid. Of {len(entries)} broken ones {len(unread)} are no JSON, {len(caught)} are not valid, {len(passed)} are: {len(CANNOT_SAY)} mistakes of form are beyond the schema")
    report.end()


if __name__ == "__main__":
    main()
