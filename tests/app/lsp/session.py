#!/usr/bin/env python3
"""`weft lsp` by a scripted session: each line of session.jsonl is a step, with the places that are asked about and what is expected
there. Then names of the bundled graphs are renamed, a folder of shaders comes and goes, and files change under a server.

    session.py WEFT

A place is LINE:CHARACTER, both from 0, characters in UTF-16; a range is FROM-TO. Steps:
    open FILE [text T]; change FILE with edits [[RANGE, TEXT]...]; close FILE
    said FILE is ["RANGE severity CODE"...]: what is published for it after the steps before
    complete FILE at PLACE has [...] lacks [...] replaces RANGE; hover FILE at PLACE has [...] at RANGE
    definition, references FILE at PLACE is ["FILE RANGE"...]; rename FILE at PLACE to NAME is {FILE: ["RANGE NEW"...]}, or refused TEXT
    symbols FILE is ["  NAME RANGE"...], two spaces for each level
"""
import json
import pathlib
import re
import shutil
import sys

from editor import Editor, flatten, range_text
from program import TOP, Report, temporary_folder

HERE = pathlib.Path(__file__).resolve().parent
SEVERITIES = {1: "error", 2: "warning", 3: "note"}


def locations(editor, result):
    return sorted(f"{editor.name(each['uri'])} {range_text(each['range'])}" for each in result or [])


def run_step(editor, step):
    """What is wrong, or nothing."""
    kind = next(iter(step))
    name = step[kind]
    if kind == "open":
        editor.open(name, step.get("text"))
    elif kind == "change":
        editor.change(name, step["edits"])
    elif kind == "close":
        editor.tell("textDocument/didClose", {"textDocument": {"uri": editor.uri(name)}})
    elif kind == "said":
        editor.settle(name)
        found = [f"{range_text(d['range'])} {SEVERITIES[d['severity']]} {d['code']}" for d in editor.published.get(name, {}).get("diagnostics", [])]
        return None if found == step["is"] else json.dumps(editor.published.get(name), indent=1)
    elif kind == "complete":
        items = {item["label"]: item for item in (editor.ask("textDocument/completion", editor.at(name, step["at"]))["result"] or {}).get("items", [])}
        wrong = [w for w in step.get("has", []) if w not in items] + [w for w in step.get("lacks", []) if w in items]
        ranges = {range_text(item["textEdit"]["range"]) for item in items.values()}
        return None if not wrong and ("replaces" not in step or ranges == {step["replaces"]}) else f"{wrong} {ranges} {sorted(items)}"
    elif kind == "hover":
        result = editor.ask("textDocument/hover", editor.at(name, step["at"]))["result"]
        if not step["has"]:
            return None if result is None else str(result)
        text = result["contents"]["value"] if result else ""
        good = all(part in text for part in step["has"]) and ("range" not in step or range_text(result["range"]) == step["range"])
        return None if good else json.dumps(result)
    elif kind in ("definition", "references"):
        params = editor.at(name, step["at"])
        found = locations(editor, editor.ask(f"textDocument/{kind}", params | {"context": {"includeDeclaration": True}})["result"])
        return None if found == sorted(step["is"]) else str(found)
    elif kind == "rename":
        message = editor.ask("textDocument/rename", editor.at(name, step["at"]) | {"newName": step["to"]})
        if "refused" in step:
            return None if step["refused"] in message.get("error", {}).get("message", "") else str(message)
        changes = {editor.name(uri): sorted(f"{range_text(e['range'])} {e['newText']}" for e in edits)
                   for uri, edits in message.get("result", {}).get("changes", {}).items()}
        return None if changes == {file: sorted(edits) for file, edits in step["is"].items()} else json.dumps(message)
    elif kind == "symbols":
        found = list(flatten(editor.ask("textDocument/documentSymbol", {"textDocument": {"uri": editor.uri(name)}})["result"]))
        return None if found == step["is"] else json.dumps(found)
    else:
        return "no such step"
    return None


def check_session(weft, report, folder):
    shutil.copytree(HERE / "workspace", folder / "workspace")
    editor = Editor(weft, folder / "workspace")
    capabilities = editor.ask("initialize", {"capabilities": {}, "rootUri": editor.uri("")})["result"]["capabilities"]
    report.check(capabilities["positionEncoding"] == "utf-16" and capabilities["textDocumentSync"]["change"] == 1, f"{capabilities}")
    editor.tell("initialized", {})
    for number, line in enumerate((HERE / "session.jsonl").read_text().splitlines(), 1):
        if line.strip():
            problem = run_step(editor, json.loads(line))
            report.check(problem is None, f"session.jsonl:{number}: {line}\n    {problem}")
    report.check(editor.end() == 0, "the exit code after shutdown")


def check_new_folder(weft, report, folder):
    """A folder of shaders that is made, and goes again, while a graph beside it is open."""
    editor = Editor(weft, folder)
    editor.ask("initialize", {"capabilities": {}, "rootUri": None})
    text = ('{"resources": {"hdr": {"texture": "rgba16f", "size": 1}}, "passes": [{"name": "sky", "type": "fullscreen", "shader": "lsp/sky.frag.glsl", '
            '"write": {"radiance": "hdr"}, "parameters": {"gain": 1}}], "present": "hdr"}')
    texts = {"one.json": text, "other.json": text}

    def codes():
        for name in texts:
            editor.settle(name)
        return [[d["code"] for d in editor.published.get(name, {}).get("diagnostics", [])] for name in texts]

    for name in texts:
        editor.open(name, texts[name])
    before = codes()
    report.check(before == [["W100"], ["W100"]], f"without shaders: {before}")
    shutil.copytree(HERE / "workspace/shaders", folder / "shaders")
    editor.change("other.json", [(None, text + "\n")])
    report.check(codes() == [[], []], f"with shaders: {codes()}")
    shutil.rmtree(folder / "shaders")
    editor.change("other.json", [(None, text)])
    report.check(codes() == before, f"without shaders again: {codes()}")
    editor.end()


def byte_of(text, where):
    """Of a position, in a text of ASCII up to there."""
    lines = text.split("\n")
    return sum(len(line) + 1 for line in lines[:where["line"]]) + where["character"]


def apply(folder, editor, changes):
    """A workspace edit, on disk."""
    for uri, edits in changes.items():
        path = folder / editor.name(uri)
        text = path.read_text()
        for edit in sorted(edits, key=lambda e: byte_of(text, e["range"]["start"]), reverse=True):
            text = text[:byte_of(text, edit["range"]["start"])] + edit["newText"] + text[byte_of(text, edit["range"]["end"]):]
        path.write_text(text)


def tree(folder):
    return {path.relative_to(folder): path.read_bytes() for part in ("graphs", "shaders") for path in sorted((folder / part).rglob("*")) if path.is_file()}


RENAMES = [  # in the bundled graphs: a file, what stands there, its part to rename
    ("graphs/lit.json", '"light_maps":', "light_maps"),               # a slot of many shaders
    ("graphs/effects/ground.json", '"casting_sun":', "casting_sun"),  # a resource
    ("graphs/effects/sky.json", '"name": "skybox"', "skybox"),        # a pass
    ("graphs/studio.json", '"subdivision":', "subdivision"),          # a parameter
    ("graphs/studio.json", '"sky_blur":', "sky_blur"),                # one that two graphs declare, and a file names that both include
    ("graphs/glow.json", '"result": "ldr"', "result"),                # a slot that most shaders have
]


def check_renames(weft, report, folder):
    """Renamed, the bundled graphs say what they said; renamed back, they are what they were."""
    for part in ("graphs", "shaders", "scenes", "materials"):
        shutil.copytree(TOP / part, folder / part)
    before = tree(folder)
    for name, needle, word in RENAMES:
        text = (folder / name).read_text()
        at = text.index(needle) + needle.index(word)
        where = f"{text.count(chr(10), 0, at)}:{at - text.rfind(chr(10), 0, at) - 1}"
        for old, new in ((word, f"{word}_renamed"), (f"{word}_renamed", word)):
            editor = Editor(weft, folder)
            editor.ask("initialize", {"capabilities": {}, "workspaceFolders": [{"uri": editor.uri(""), "name": "weft"}]})
            editor.open(name)
            answer = editor.ask("textDocument/rename", editor.at(name, where) | {"newName": new})
            if not report.check("result" in answer and answer["result"]["changes"], f"{name}: {old} to {new}: {answer}"):
                break
            apply(folder, editor, answer["result"]["changes"])
            editor.end()
            for graph in ("graphs/studio.json", "graphs/deferred.json", "graphs/glow.json"):
                editor = Editor(weft, folder)
                editor.ask("initialize", {"capabilities": {}, "rootUri": None})
                editor.open(graph)
                editor.settle(graph)
                said = [d["message"] for each in editor.published.values() for d in each["diagnostics"] if d["severity"] == 1]
                report.check(not said, f"{graph}, with {old} as {new} in {name}: {said[:3]}")
                editor.end()
            report.check((tree(folder) == before) == (new == word), f"{name}: {old} to {new}, and the files are {'other' if new == word else 'the same'}")


def check_kept(weft, report, folder):
    """What a server keeps of files that it has read gives the answers of one that has just begun."""
    texts = {
        "part.json": '{"inputs": ["hdr"], "parameters": {"force": {"default": 1, "max": 2}}, "resources": {"own": {"texture": "rgba16f", "size": "size(hdr)"}},\n'
                     ' "passes": [{"name": "q", "type": "blit", "read": {"source": "hdr"}, "write": {"destination": "own"}}]}',
        "over.json": '{"inputs": ["hdr"], "resources": {"a": {"texture": "rgba16f", "size": "size(hdr)"}}, "passes": [{"include": "part.json"},\n'
                     ' {"name": "mix", "type": "blit", "enabled": "$part.force > 0.5", "read": {"source": "part.own"}, "write": {"destination": "a"}}]}',
        "root.json": '{"resources": {"hdr": {"texture": "rgba16f", "size": "screen", "clear": 0}, "o": {"texture": "rgba16f", "size": "screen"}},\n'
                     ' "passes": [{"include": "over.json"}, {"include": "part.json", "as": "d"},\n'
                     '  {"name": "mix", "type": "blit", "read": {"source": "over.a"}, "write": {"destination": "o"}}], "present": "o"}',
        "also.json": '{"extends": "root.json", "set": {"over.part.force": 2}}'}
    for name, text in texts.items():
        (folder / name).write_text(text)
    open_texts = {}

    def start():
        editor = Editor(weft, folder)
        editor.ask("initialize", {"capabilities": {}, "rootUri": editor.uri("")})
        for name, text in open_texts.items():
            editor.open(name, text)
        return editor

    def answers(editor):
        found = []
        for name in texts:
            text = open_texts.get(name) or (folder / name).read_text()
            for quote in re.finditer('"', text):
                line = text.count("\n", 0, quote.end())
                where = editor.at(name, f"{line}:{quote.end() - text.rfind(chr(10), 0, quote.end()) - 1}")
                found += [editor.ask(f"textDocument/{method}", where).get("result") for method in ("hover", "definition", "references")]
        said = {name: sorted(json.dumps(d, sort_keys=True) for d in each["diagnostics"]) for name, each in editor.published.items() if each["diagnostics"]}
        return said, found

    old = start()
    part, renamed = texts["part.json"], texts["part.json"].replace("force", "other")
    steps = [("open", "root.json", texts["root.json"]), ("change", "root.json", texts["root.json"] + "\n"), ("save", "part.json", "\n\n" + part),
             ("change", "root.json", "\n" + texts["root.json"]), ("save", "part.json", renamed), ("save", "part.json", part), ("open", "part.json", part),
             ("change", "part.json", "\n" + renamed), ("change", "part.json", part[:40]), ("change", "part.json", "\n\n\n" + part),
             ("save", "over.json", "\n" + texts["over.json"]), ("close", "part.json", None)]
    for number, (what, name, text) in enumerate(steps):
        if what == "save":
            (folder / name).write_text(text)
            old.change("root.json", [(None, old.texts["root.json"] + " ")])  # nothing tells the server, so it looks when it is asked
            open_texts["root.json"] = old.texts["root.json"]
        elif what == "close":
            old.tell("textDocument/didClose", {"textDocument": {"uri": old.uri(name)}})
            del open_texts[name]
        else:
            open_texts[name] = text
            old.open(name, text) if what == "open" else old.change(name, [(None, text)])
        ours = answers(old)
        if any('"severity": 1' in d for each in ours[0].values() for d in each):
            continue  # of graphs with errors it knows more: what was before
        new = start()
        report.check(ours == answers(new), f"after step {number}, {what} {name}: not what a server says that begins now")
        new.end()
    old.end()


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    with temporary_folder() as folder:
        for name, check in (("session", check_session), ("bundled", check_renames), ("folders", check_new_folder), ("kept", check_kept)):
            pathlib.Path(folder, name).mkdir()
            check(weft, report, pathlib.Path(folder, name).resolve())
    report.end()


main()
