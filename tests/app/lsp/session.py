#!/usr/bin/env python3
"""`weft lsp` by a scripted session: each line of session.jsonl is a step, with the places that are asked about and what is expected
there. Then messages that no editor sends.

    session.py WEFT

A place is LINE:CHARACTER, both from 0, characters in UTF-16; a range is FROM-TO. Steps:
    open FILE [text T]; change FILE with edits [[RANGE, TEXT]...]; close FILE
    said FILE is ["RANGE severity CODE"...]: what is published for it after the steps before
    complete FILE at PLACE has [...] lacks [...] replaces RANGE; hover FILE at PLACE has [...] at RANGE
    definition, references FILE at PLACE is ["FILE RANGE"...]; rename FILE at PLACE to NAME is {FILE: ["RANGE NEW"...]}, or refused TEXT
    symbols FILE is ["  NAME RANGE"...], two spaces for each level
"""
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import urllib.parse

from program import SLOWER, TOP, Report, count_run, temporary_folder

HERE = pathlib.Path(__file__).resolve().parent
SEVERITIES = {1: "error", 2: "warning", 3: "note"}


def range_text(r):
    return f"{r['start']['line']}:{r['start']['character']}-{r['end']['line']}:{r['end']['character']}"


def place(text):
    line, character = text.split(":")
    return {"line": int(line), "character": int(character)}


def range_of(text):
    start, end = text.split("-")
    return {"start": place(start), "end": place(end)}


class Editor:
    """The other side: asks, and keeps what is published."""

    def __init__(self, weft, folder):
        count_run()
        self.folder, self.number, self.versions, self.published = folder, 0, {}, {}
        self.process = subprocess.Popen([weft, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=folder)

    def uri(self, name):
        return "file://" + urllib.parse.quote(str(self.folder / name))

    def name(self, uri):
        path = pathlib.Path(urllib.parse.unquote(uri.removeprefix("file://")))
        return str(path.relative_to(self.folder)) if path.is_relative_to(self.folder) else str(path)

    def send_bytes(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        data = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.send_bytes(b"Content-Length: %d\r\n\r\n" % len(data) + data)

    def receive(self):
        length = 0
        while (line := self.process.stdout.readline().strip()):
            length = int(line.split(b":")[1])
        assert length, "the server ended"
        message = json.loads(self.process.stdout.read(length))
        if message.get("method") == "textDocument/publishDiagnostics":
            self.published[self.name(message["params"]["uri"])] = message["params"]
        return message

    def ask(self, method, params):
        self.number += 1
        self.send({"id": self.number, "method": method, "params": params})
        while (message := self.receive()).get("id") != self.number:
            pass
        return message

    def tell(self, method, params):
        self.send({"method": method, "params": params})

    def at(self, name, where):
        return {"textDocument": {"uri": self.uri(name)}, "position": place(where)}

    def open(self, name, text=None):
        self.versions[name] = 1
        text = (self.folder / name).read_text() if text is None else text
        self.tell("textDocument/didOpen", {"textDocument": {"uri": self.uri(name), "languageId": "json", "version": 1, "text": text}})

    def change(self, name, edits):
        self.versions[name] += 1
        self.tell("textDocument/didChange", {"textDocument": {"uri": self.uri(name), "version": self.versions[name]},
                                             "contentChanges": [{"range": range_of(r), "text": t} if r else {"text": t} for r, t in edits]})

    def settle(self, name):
        """Answers come after what was published before."""
        self.ask("textDocument/documentSymbol", {"textDocument": {"uri": self.uri(name)}})

    def end(self):
        self.ask("shutdown", None)
        self.tell("exit", None)
        self.process.stdin.close()
        return self.process.wait(timeout=60)


def flatten(symbols, depth=0):
    for symbol in symbols:
        yield "  " * depth + symbol["name"] + " " + range_text(symbol["selectionRange"])
        yield from flatten(symbol.get("children", []), depth + 1)


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
    answer = editor.ask("textDocument/hover", editor.at("main.json", "0:0"))
    report.check(answer["error"]["code"] == -32002, f"before initialize: {answer}")
    capabilities = editor.ask("initialize", {"capabilities": {}, "rootUri": editor.uri("")})["result"]["capabilities"]
    report.check(capabilities["positionEncoding"] == "utf-16" and capabilities["textDocumentSync"]["change"] == 2, f"{capabilities}")
    editor.tell("initialized", {})
    for number, line in enumerate((HERE / "session.jsonl").read_text().splitlines(), 1):
        if line.strip():
            problem = run_step(editor, json.loads(line))
            report.check(problem is None, f"session.jsonl:{number}: {line}\n    {problem}")
    report.check(editor.end() == 0, "the exit code after shutdown")


def framed(text):
    data = text if isinstance(text, bytes) else text.encode()
    return b"Content-Length: %d\r\n\r\n" % len(data) + data


HOSTILE = [  # bytes, the code of the error that answers
    (b"Content-Length: seven\r\n\r\n", -32700),
    (b"Content-Length: -5\r\n\r\n", -32700),
    (b"Content-Length: 99999999999999999999999\r\n\r\n", -32700),
    (b"No header at all\r\n\r\n", -32700),
    (b"X: " + b"y" * 100_000 + b"\r\n\r\n", -32700),
    (b"Content-Type: text\r\n\r\n", -32700),
    (framed("{"), -32700),
    (framed(""), -32700),
    (framed(b"\xff\xfe\x00{}"), -32700),
    (framed("[" * 100_000), -32700),
    (framed("[]"), -32600),
    (framed("17"), -32600),
    (framed("{}"), -32600),
    (framed('{"jsonrpc":"2.0","id":{"a":1},"method":"shutdown"}'), -32600),
    (framed('{"jsonrpc":"2.0","id":1,"method":17}'), -32600),
    (framed('{"jsonrpc":"2.0","id":1,"method":"no/such","params":{}}'), -32601),
    (framed('{"jsonrpc":"2.0","id":1,"method":"no/such","params":' + "[" * 200_000 + "]" * 200_000 + "}"), -32700),
    (framed('{"jsonrpc":"2.0","id":1,"method":"no/such","params":' + '{"a":' * 200_000 + "0" + "}" * 200_000 + "}"), -32700),
    (framed('{"jsonrpc":"2.0","id":1,"method":"no/such","params":' + "[" * 499 + "]" * 499 + "}"), -32601),
    (framed('{"jsonrpc":"2.0","id":1,"method":"no/such","params":["\\\\\\"' + "[" * 1000 + '"]}'), -32601),
    (framed('{"jsonrpc":"2.0","id":1,"method":"textDocument/hover"}'), -32602),
    (framed('{"jsonrpc":"2.0","id":1,"method":"textDocument/hover","params":[1,2]}'), -32602),
    (framed('{"jsonrpc":"2.0","id":1,"method":"textDocument/hover","params":{"textDocument":{"uri":"http://x/y"},"position":{"line":0,"character":0}}}'), -32602),
    (framed('{"jsonrpc":"2.0","id":1,"method":"textDocument/rename","params":{"textDocument":{"uri":"file:///x.json"},"position":{"line":-1,"character":0},"newName":"a"}}'), -32602),
    (framed('{"jsonrpc":"2.0","id":1,"method":"textDocument/completion","params":{"textDocument":{"uri":"file:///x.json"},"position":{"line":1e99,"character":0}}}'), -32602),
    (b"Content-Length: 68000000\r\n\r\n" + b" " * 68_000_000, -32700),
    (framed('{"jsonrpc":"2.0","id":"again","method":"initialize","params":{}}'), -32600),
]
IGNORED = [  # notifications have no answer
    framed('{"jsonrpc":"2.0","method":"textDocument/didOpen","params":{}}'),
    framed('{"jsonrpc":"2.0","method":"textDocument/didChange","params":{"textDocument":{"uri":"file:///never/opened.json"},"contentChanges":[{"text":"{}"}]}}'),
    framed('{"jsonrpc":"2.0","method":"textDocument/didChange","params":{"textDocument":{"uri":"file:///never/opened.json"},"contentChanges":17}}'),
    framed('{"jsonrpc":"2.0","method":"no/such","params":null}'),
    framed('{"jsonrpc":"2.0","method":"workspace/didChangeWatchedFiles","params":{"changes":' + "[" * 400 + "]" * 400 + "}}"),
    framed('{"jsonrpc":"2.0","method":"workspace/didChangeWatchedFiles","params":{"changes":{"uri":7}}}'),
    framed('{"jsonrpc":"2.0","method":"$/cancelRequest","params":{"id":7}}'),
    framed('{"jsonrpc":"2.0","id":3,"result":null}'),
]
TEXTS = ["", "{", '{"passes": [{"name": "', "[" * 50_000, '{"a":' * 50_000, "\0\0\0", '{"passes": [' + '{"name": "a", "type": "fullscreen", "shader": "a", "read": {"x": "@@[[", "y": ".", "z": "a.."}},' * 50,
         '{"resources": {"a": ["a", "b"], "b": "a"}, "passes": [], "present": "a.b.c.mip[$"}', '{"extends": "odd.json"}', '{"passes": [{"include": "odd.json"}]}',
         '{"passes": [{"name": "a", "like": "b", "read": {"s": "x"}}, {"name": "b", "like": "a"}]}', '"\\', '{"passes": 7, "resources": 7, "let": []}', "é😀" * 1000]
ENDS = [(b"", "without 'exit'"), (b"Content-Len", "within the header of a message, which begins 'Content-Len'"), (b"Content-Length: 5\r\n", "within the header"),
        (b"Content-Length: 50\r\n\r\n{", "after 1 of 50 bytes"), (b"Content-Length: 99999999999\r\n\r\n{", "of 99999999999 bytes")]


def check_hostile(weft, report, folder):
    editor = Editor(weft, folder)
    editor.ask("initialize", {"capabilities": {}, "rootUri": None})
    for data, code in HOSTILE:
        editor.send_bytes(data)
        answer = editor.receive()
        report.check(answer.get("error", {}).get("code") == code and answer["error"]["message"], f"{data[:120]}: {answer}")
    # A body of whose length nothing is known: behind it the next message is found again, the first of its kind or the third.
    for body in (b"{}", b'{"jsonrpc": "2.0",\n "id": 1,\n "method": "shutdown"}', b'{"text": "' + b"x" * 10_000 + b'"}'):
        for header in (b"Content-Length: abc", b"Content-Type: text"):
            editor.send_bytes(header + b"\r\n\r\n" + body)
            report.check(editor.receive().get("error", {}).get("code") == -32700, f"{header} {body[:40]}")
            answer = editor.ask("no/such", {})
            report.check(answer.get("error", {}).get("code") == -32601, f"after {header} {body[:40]}: {answer}")
    for data in IGNORED:
        editor.send_bytes(data)
    # Whatever a file holds, everything can be asked of every place of it.
    for text in TEXTS:
        editor.open("odd.json", text)
        for where in ("0:0", "0:1", "0:7", "0:24", "0:60", "0:200", "3:0"):
            for method in ("completion", "hover", "definition", "references", "prepareRename"):
                answer = editor.ask(f"textDocument/{method}", editor.at("odd.json", where))
                report.check("result" in answer, f"{method} of {text[:60]!r} at {where}: {answer}")
            answer = editor.ask("textDocument/rename", editor.at("odd.json", where) | {"newName": "new name"})
            report.check("error" in answer, f"{answer}")
        editor.tell("textDocument/didClose", {"textDocument": {"uri": editor.uri("odd.json")}})
    editor.open("odd.json", "{}")
    editor.change("odd.json", [("5:0-2:0", "x"), ("0:1-0:1", "\"passes\": []")])
    editor.settle("odd.json")
    report.check(editor.published["odd.json"]["version"] == 2 and editor.end() == 0, f"{editor.published}")
    # Without shutdown the end of the input is an error, and a sentence says where it came.
    for data, says in ENDS:
        count_run()
        ended = subprocess.run([weft, "lsp"], input=data, capture_output=True, timeout=60)
        text = ended.stderr.decode()
        report.check(ended.returncode == 1 and says in text and text.count("\n") == 1, f"the input {data!r} ends: {ended.returncode} {text}")


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


def check_bounds(weft, report, folder):
    """What grows faster than the text, or without end, in files that no person writes."""
    editor = Editor(weft, folder)
    editor.ask("initialize", {"capabilities": {}, "rootUri": None})

    def spent(name, where):
        """Processor seconds for the definition of what stands there."""
        editor.settle(name)
        before = cpu_seconds(editor)
        answer = editor.ask("textDocument/definition", editor.at(name, where))
        report.check("result" in answer, f"{name}: {answer}")
        return cpu_seconds(editor) - before

    # Two ways on at each step, again and again: as many look-ups as there are names, not as there are ways.
    name = "a." * 8 + "b"
    circle = '{{"extends": "circle.json", "passes": [{{"include": "circle.json", "as": "a"}}{}], {}}}'
    for what, text in {"resource": circle.format("", f'"present": "{name}"'), "parameter": circle.format("", f'"let": {{"c": "${name}"}}'),
                       "pass": circle.format(f', {{"name": "c", "after": "{name}"}}', '"let": {}')}.items():
        editor.open("circle.json", text)
        seconds = spent("circle.json", f"0:{text.index(name) + len(name)}")
        report.check(seconds < 2 * SLOWER, f"a {what} in a circle of files took {seconds} s of processor time")
    # More files than a graph may include: the others are not looked for, and none is compared with all.
    many = ", ".join(f'{{"include": "{i:040}.json"}}' for i in range(8000))
    before = cpu_seconds(editor)
    editor.open("circle.json", f'{{"passes": [{many}]}}')
    editor.settle("circle.json")
    seconds = cpu_seconds(editor) - before
    report.check(seconds < 4 * SLOWER, f"8,000 includes took {seconds} s of processor time")
    # Each part of a dotted name is a mention of all before it: not of parts without end.
    editor.open("circle.json", f'{{"passes": [], "present": "{"a." * 40000}b"}}')
    editor.settle("circle.json")
    report.check("result" in editor.ask("textDocument/hover", editor.at("circle.json", "0:50")), "hover in a name of 40,001 parts")
    kilobytes = int(re.search(r"VmHWM:\s+(\d+) kB", pathlib.Path(f"/proc/{editor.process.pid}/status").read_text())[1])
    report.check(kilobytes < 600_000 * SLOWER, f"a name of 40,001 parts took {kilobytes} kB")
    # Places in one long line: those that Python counts, and not each from the beginning of the line.
    seconds = {}
    for between in ("\n", ""):
        text = '{"passes": [], "resources": {' + f", {between}".join(f'/* é😀 */ "r{i}": {{"texture": "rgba8", "size": 1}}' for i in range(6000)) + "}}"
        editor.open("long.json", text)
        editor.settle("long.json")
        before = cpu_seconds(editor)
        answer = editor.ask("textDocument/documentSymbol", {"textDocument": {"uri": editor.uri("long.json")}})
        seconds[between] = cpu_seconds(editor) - before
        found = [symbol for symbol in flatten(answer["result"]) if symbol.startswith("  r")]
        expected, line, column, at = [], 0, 0, 0
        for match in re.finditer(r'(?<=")r\d+', text):
            passed = text[at:match.start()].split("\n")
            line, column, at = line + len(passed) - 1, len(passed[-1].encode("utf-16-le")) // 2 + (column if len(passed) == 1 else 0), match.start()
            expected.append(f"  {match[0]} {line}:{column}-{line}:{column + len(match[0])}")
        report.check(found == expected and len(found) == 6000, f"symbols of a long line: {[pair for pair in zip(found, expected) if pair[0] != pair[1]][:3]}")
    report.check(seconds[""] < 4 * seconds["\n"] + 0.5, f"processor seconds for the symbols of 6,000 lines and of one: {seconds}")
    editor.end()


def check_hints(weft, report, folder):
    """Names that are near to a misspelt one are said, however many were compared before."""
    editor = Editor(weft, folder)
    editor.ask("initialize", {"capabilities": {}, "rootUri": None})
    # 400 million steps are the budget of one run. Names of the same letters, as long as names may be, take the most.
    order = random.Random(1)
    names = ["n" + "".join(order.sample("ab" * 100, 200)) for _ in range(1040)]
    resources = ", ".join(f'"{name}": {{"texture": "rgba8", "size": 1}}' for name in names[:1000])
    unknown = ", ".join(f'"s{i}": "{name}"' for i, name in enumerate(names[1000:]))
    editor.open("spent.json", f'{{"resources": {{{resources}}}, "passes": [{{"name": "a", "type": "fullscreen", "shader": "x.frag.glsl", "read": {{{unknown}}}}}]}}')
    editor.settle("spent.json")
    editor.open("hint.json", '{"resources": {"picture": {"texture": "rgba8", "size": 1}}, "passes": [], "present": "pictrue"}')
    editor.settle("hint.json")
    said = [d["message"] for d in editor.published["hint.json"]["diagnostics"]]
    report.check(any("did you mean 'picture'?" in message for message in said), f"no hint: {said}")
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
    ("graphs/lit.json", '"brdf": "brdf as linear"', "brdf"),          # a slot of many shaders
    ("graphs/lit.json", '"ground_sky":', "ground_sky"),               # a resource
    ("graphs/lit.json", '"name": "skybox"', "skybox"),                # a pass
    ("graphs/studio.json", '"sky_blur":', "sky_blur"),                # a parameter
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


def cpu_seconds(editor):
    """What the server has used: on a busy machine the clock says little."""
    fields = pathlib.Path(f"/proc/{editor.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    with temporary_folder() as folder:
        check_session(weft, report, pathlib.Path(folder).resolve())
        pathlib.Path(folder, "bundled").mkdir()
        check_renames(weft, report, pathlib.Path(folder, "bundled").resolve())
        pathlib.Path(folder, "bounds").mkdir()
        check_bounds(weft, report, pathlib.Path(folder, "bounds").resolve())
        pathlib.Path(folder, "folders").mkdir()
        check_new_folder(weft, report, pathlib.Path(folder, "folders").resolve())
        check_hints(weft, report, pathlib.Path(folder, "bounds").resolve())
        pathlib.Path(folder, "odd").mkdir()
        check_hostile(weft, report, pathlib.Path(folder, "odd").resolve())
    report.end()


if __name__ == "__main__":
    main()
