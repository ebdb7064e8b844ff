#!/usr/bin/env python3
"""Messages that no editor sends to `weft lsp`, files that no person writes, and what they cost.

    hostile.py WEFT
"""
import pathlib
import random
import re
import subprocess
import sys

from editor import Editor, cpu_seconds, flatten
from program import SLOWER, Report, count_run, temporary_folder


def framed(text):
    data = text if isinstance(text, bytes) else text.encode()
    return b"Content-Length: %d\r\n\r\n" % len(data) + data


HOSTILE = [  # bytes, the code of the error that answers
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
    (framed('{"jsonrpc":"2.0","id":1,"method":"no/such","params":' + "[" * 200_000 + "]" * 200_000 + "}"), -32601),
    (framed('{"jsonrpc":"2.0","id":1,"method":"no/such","params":' + '{"a":' * 200_000 + "0" + "}" * 200_000 + "}"), -32601),
    (framed('{"jsonrpc":"2.0","id":1,"method":"no/such","params":["\\\\\\"' + "[" * 1000 + '"]}'), -32601),
    (framed('{"jsonrpc":"2.0","id":1,"method":"textDocument/hover"}'), -32602),
    (framed('{"jsonrpc":"2.0","id":1,"method":"textDocument/hover","params":[1,2]}'), -32602),
    (framed('{"jsonrpc":"2.0","id":1,"method":"textDocument/hover","params":{"textDocument":{"uri":"http://x/y"},"position":{"line":0,"character":0}}}'), -32602),
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
         '{"sets": {"a": {"read": {"s": "x"}}, "b": 7}, "passes": [{"name": "a", "use": ["a", "b", "a"], "read": {"s": "x"}}, {"name": "b", "use": {}}]}', '"\\', '{"passes": 7, "resources": 7, "let": []}', "é😀" * 1000]
ENDS = [(b"", "without 'exit'"), (b"Content-Len", "within a header: 'Content-Len'"), (b"Content-Length: 5\r\n", "within a header"), (b"X: " + b"y" * 100_000 + b"\r\n\r\n", "within a header"),
        (b"Content-Length: 50\r\n\r\n{", "after 1 of 50 bytes"), *((header + b"\r\n\r\n{}", "at a header without 'Content-Length: '")
                                                                for header in (b"Content-Length: seven", b"Content-Length: -5", b"Content-Length: 99999999999999999999999", b"Content-Length: 99999999999",
                                                                               b"No header at all", b"Content-Type: text"))]


def check_hostile(weft, report, folder):
    editor = Editor(weft, folder)
    editor.ask("initialize", {"capabilities": {}, "rootUri": None})
    for data, code in HOSTILE:
        editor.send_bytes(data)
        answer = editor.receive()
        report.check(answer.get("error", {}).get("code") == code and answer["error"]["message"], f"{data[:120]}: {answer}")
    for data in IGNORED:
        editor.send_bytes(data)
    # Whatever a file holds, everything can be asked of every place of it.
    for text in TEXTS:
        editor.open("odd.json", text)
        for where in ("0:0", "0:1", "0:7", "0:24", "0:60", "0:200", "3:0"):
            for method in ("completion", "hover", "definition", "references"):
                answer = editor.ask(f"textDocument/{method}", editor.at("odd.json", where))
                report.check("result" in answer, f"{method} of {text[:60]!r} at {where}: {answer}")
            answer = editor.ask("textDocument/rename", editor.at("odd.json", where) | {"newName": "new name"})
            report.check("error" in answer, f"{answer}")
        editor.tell("textDocument/didClose", {"textDocument": {"uri": editor.uri("odd.json")}})
    editor.open("odd.json", "{}")
    for line in (-1, 1e99, "0", None):
        answer = editor.ask("textDocument/completion", {"textDocument": {"uri": editor.uri("odd.json")}, "position": {"line": line, "character": 0}})
        report.check(answer.get("error", {}).get("code") == -32602, f"line {line}: {answer}")
    editor.change("odd.json", [("0:1-0:1", "\"passes\": []")])
    editor.settle("odd.json")
    report.check(editor.published["odd.json"]["version"] == 2 and editor.end() == 0, f"{editor.published}")
    # Without shutdown the end of the input is an error, as is what is no header, and a sentence says where it came.
    for data, says in ENDS:
        count_run()
        ended = subprocess.run([weft, "lsp"], input=data, capture_output=True, timeout=60)
        text = ended.stderr.decode()
        report.check(ended.returncode == 1 and says in text and text.count("\n") == 1, f"the input {data!r} ends: {ended.returncode} {text}")


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
    many = ",\n".join(f'{{"include": "{i:040}.json"}}' for i in range(8000))
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


def check_shader_memory(weft, report, folder):
    """What is remembered of a shader's texts has a bound: typing in a large one does not take memory without end."""
    (folder / "shaders").mkdir()
    words = "".join(f"  x += float(name_{i:0150});\n" for i in range(4000))

    def text(i):
        return f"// {i}\nout vec4 result;\nvoid main() {{\n  float x = 0.0;\n{words}  result = vec4(x);\n}}\n"

    (folder / "shaders/typed.frag.glsl").write_text(text(0))
    (folder / "typed.json").write_text('{"resources": {"a": {"texture": "rgba8", "size": 4}}, "passes": [{"name": "p", "type": "fullscreen", '
                                       '"shader": "typed.frag.glsl", "write": {"result": "a"}}], "present": "a"}')
    editor = Editor(weft, folder)
    editor.ask("initialize", {"capabilities": {}, "rootUri": None})
    editor.open("typed.json")
    editor.open("shaders/typed.frag.glsl")
    kilobytes = []
    for i in range(1, 71):
        editor.change("shaders/typed.frag.glsl", [(None, text(i))])
        editor.settle("typed.json")
        kilobytes.append(int(re.search(r"VmRSS:\s+(\d+) kB", pathlib.Path(f"/proc/{editor.process.pid}/status").read_text())[1]))
    # Full after about 12 texts of 0.7 MB. From 30 on memory is used again.
    report.check(kilobytes[-1] - kilobytes[29] < 20_000 * SLOWER, f"40 texts of a shader took {kilobytes[-1] - kilobytes[29]} kB")
    editor.end()


def check_large(weft, report, folder):
    """A file of 10 MB has one message, its limit, and what is typed in it costs nothing more; below the limit it is looked at."""
    editor = Editor(weft, folder)
    editor.ask("initialize", {"capabilities": {}, "rootUri": None})
    editor.open("large.json", '{"resources": [' + ",".join(["1"] * 5_000_000) + "]}")
    editor.settle("large.json")
    said = [d["code"] for d in editor.published["large.json"]["diagnostics"]]
    report.check(said == ["W201"], f"10 MB: {said}")
    answer = editor.ask("textDocument/completion", editor.at("large.json", "0:5"))
    report.check("result" in answer, f"completion in 10 MB: {answer}")
    editor.change("large.json", [(None, '{"resources": []}')])
    editor.settle("large.json")
    said = [d["code"] for d in editor.published["large.json"]["diagnostics"]]
    report.check(said and "W201" not in said, f"17 bytes: {said}")
    # So is one that is included: a message where it is included, and no memory for what is in it.
    (folder / "below.json").write_text('{"resources": {' + ",".join(f'"r{i}": {{"texture": "rgba8"}}' for i in range(300_000)) + '}, "passes": []}')
    editor.open("above.json", '{"passes": [\n  { "include": "below.json" }]}')
    editor.settle("above.json")
    said = [(d["code"], d["range"]["start"]["line"]) for d in editor.published["above.json"]["diagnostics"]]
    report.check(("W201", 1) in said, f"an include of 8 MB: {said}")
    kilobytes = int(re.search(r"VmHWM:\s+(\d+) kB", pathlib.Path(f"/proc/{editor.process.pid}/status").read_text())[1])
    report.check(kilobytes < 200_000 * SLOWER, f"an include of 8 MB took {kilobytes} kB")
    editor.end()


def check_typing(weft, report, folder):
    """A graph as it is typed: its beginning up to any byte has an error at a line of it, a mistake before all else hides no message, and passes below an open comment are known."""
    editor = Editor(weft, folder)
    editor.ask("initialize", {"capabilities": {}, "rootUri": None})
    whole = (pathlib.Path(__file__).resolve().parents[3] / "graphs/glow.json").read_text()
    assert whole.isascii()

    def errors():
        editor.settle("typed.json")
        return [d for d in editor.published["typed.json"]["diagnostics"] if d["severity"] == 1]

    def completion(text):
        line, column = text.count("\n"), len(text) - text.rfind("\n") - 1
        answer = editor.ask("textDocument/completion", editor.at("typed.json", f"{line}:{column}"))
        report.check("result" in answer, f"completion behind {len(text)} bytes: {answer}")

    for fresh in (False, True):  # typed in one go, and opened as it is
        if not fresh:
            editor.open("typed.json", whole[:50])
        for size in range(50, len(whole.rstrip()), 50):
            text = whole[:size]
            if fresh:
                editor.tell("textDocument/didClose", {"textDocument": {"uri": editor.uri("typed.json")}})
                editor.open("typed.json", text)
            else:
                editor.change("typed.json", [(None, text)])
            found = errors()
            report.check(found, f"{size} bytes of glow.json have no error")
            # Where the text ends, or where begins what is never closed.
            lines = text.count("\n")
            report.check(all(d["range"]["start"]["line"] <= lines for d in found), f"{size} bytes of glow.json: {found}")
            completion(text)
    # A comment that is begun and not closed yet: one error, where it begins, and the passes below are known.
    editor.change("typed.json", [(None, whole)])
    for at in ("  \"$schema\"", "  \"threshold\""):
        text = whole.replace(at, "  /* " + at, 1)
        editor.change("typed.json", [(None, text)])
        found = errors()
        before = text[:text.index("/*")]
        begin = {"line": before.count("\n"), "character": len(before) - before.rfind("\n") - 1}
        report.check(len(found) == 1 and found[0]["code"] == "W002" and found[0]["range"]["start"] == begin, f"an open comment: {found}")
        answer = editor.ask("textDocument/documentSymbol", {"textDocument": {"uri": editor.uri("typed.json")}})
        report.check(any("composite" in symbol for symbol in flatten(answer["result"])), f"behind an open comment: {answer}")
    editor.change("typed.json", [(None, "/*\n" + whole)])
    found = errors()
    report.check(len(found) == 1 and found[0]["range"]["start"] == {"line": 0, "character": 0}, f"a comment around all: {found}")
    # Nothing of the graph is to be seen any more, and the file is still the one that was being typed.
    editor.change("typed.json", [(None, "{ \"")])
    report.check(errors(), "an open quote before all else has no error")
    editor.end()


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    with temporary_folder() as folder:
        for name, check in (("bounds", check_bounds), ("hints", check_hints), ("memory", check_shader_memory), ("typing", check_typing), ("large", check_large), ("odd", check_hostile)):
            pathlib.Path(folder, name).mkdir()
            check(weft, report, pathlib.Path(folder, name).resolve())
    report.end()


main()
