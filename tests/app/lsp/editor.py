"""The other side of `weft lsp` for tests: an editor that asks, and keeps what is published."""
import json
import os
import pathlib
import subprocess
import urllib.parse

from program import count_run


def range_text(r):
    return f"{r['start']['line']}:{r['start']['character']}-{r['end']['line']}:{r['end']['character']}"


def place(text):
    line, character = text.split(":")
    return {"line": int(line), "character": int(character)}


def offset_of(text, where):
    """Of LINE:CHARACTER in a text; characters in UTF-16."""
    line, character = map(int, where.split(":"))
    lines = text.splitlines(keepends=True)[:line + 1]
    last = lines[line].encode("utf-16-le")[:2 * character].decode("utf-16-le") if line < len(lines) else ""
    return sum(map(len, lines[:line])) + len(last)


class Editor:
    """The other side: asks, and keeps what is published."""

    def __init__(self, weft, folder):
        count_run()
        self.folder, self.number, self.versions, self.texts, self.published = folder, 0, {}, {}, {}
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
        text = self.texts[name] = (self.folder / name).read_text() if text is None else text
        self.tell("textDocument/didOpen", {"textDocument": {"uri": self.uri(name), "languageId": "json", "version": 1, "text": text}})

    def change(self, name, edits):
        """Edits are (RANGE or None for the whole, new text); the server gets the whole text."""
        text = self.texts[name]
        for where, new in edits:
            begin, end = (offset_of(text, each) for each in where.split("-")) if where else (0, len(text))
            text = text[:begin] + new + text[end:]
        self.texts[name] = text
        self.versions[name] += 1
        self.tell("textDocument/didChange", {"textDocument": {"uri": self.uri(name), "version": self.versions[name]}, "contentChanges": [{"text": text}]})

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


def cpu_seconds(editor):
    """What the server has used: on a busy machine the clock says little."""
    fields = pathlib.Path(f"/proc/{editor.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
