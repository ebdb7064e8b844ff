#!/usr/bin/env python3
"""Whatever fails once, in turn: each open, read, write, close, sync, rename and directory listing (by strace), each allocation, thread and
OpenGL object of the program (by fail.cpp, preloaded). A run ends with what it was to make, or with a message and a non-zero exit code; then
each file is what it was before or whole, and nothing is left beside it. A viewer that reloads keeps its picture, and takes the next save.

    faults.py WEFT [COMMAND...] [--kinds KIND,...] [--most N] [--jobs N]

`--most`: of more than so many, the first half and as many spread over the rest.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "app"))
from program import TOP  # noqa: E402
from window import Session, display, save  # noqa: E402

# What fails, and how.
CALLS = {"openat": "EMFILE", "read": "EIO", "pread64": "EIO", "write": "ENOSPC", "pwrite64": "ENOSPC", "close": "EIO", "fsync": "EIO", "rename": "EACCES",
         "getdents64": "EIO", "newfstatat": "EACCES", "ftruncate": "EIO", "flock": "ENOLCK", "unlink": "EACCES", "mkdir": "EACCES"}
MADE = ("new", "thread", "gl")
CRASH = re.compile(r"terminate called|Assertion|Segmentation|Aborted|what\(\):|AddressSanitizer|runtime error")
LOADER = re.compile(r"error while loading shared libraries|cannot open shared object")

SHADER = """out vec4 result;
in vec2 uv;
#include "part.glsl"
layout(std140) uniform Parameters { float gain; };
void main() { result = vec4(shade(uv) * gain, 1.0); }
"""
PART = "vec3 shade(vec2 at) { return vec3(at, 0.5); }\n"
GRAPH = {"parameters": {"gain": {"default": 1.0}}, "resources": {"hdr": {"texture": "rgba16f", "history": 1}, "ldr": {"texture": "rgba8"}},
         "passes": [{"name": "paint", "shader": "paint.frag.glsl", "write": {"result": "hdr"}, "parameters": {"gain": "$gain"}},
                    {"include": "end.json"}], "present": "ldr"}
END = {"inputs": ["hdr", "ldr"], "passes": [{"name": "copy", "shader": "copy.frag.glsl", "read": {"source": "hdr", "before": "hdr@-1"}, "write": {"result": "ldr"}}]}
COPY = """out vec4 result;
in vec2 uv;
uniform sampler2D source, before;
void main() { result = mix(texture(source, uv), texture(before, uv), 0.25); }
"""
ISF = '/*{ "INPUTS": [ { "NAME": "level", "TYPE": "float" } ] }*/\nvoid main() { gl_FragColor = vec4(level); }\n'
CASES = {"cases": [{"name": "one", "graph": "graph.json", "size": "16x9"}]}


def lsp_text(folder):
    """A short session of an editor."""
    uri = (folder / "graph.json").as_uri()
    messages = [{"id": 1, "method": "initialize", "params": {"rootUri": folder.as_uri(), "capabilities": {}}}, {"method": "initialized", "params": {}},
                {"method": "textDocument/didOpen", "params": {"textDocument": {"uri": uri, "languageId": "json", "version": 1, "text": (folder / "graph.json").read_text()}}},
                {"id": 2, "method": "textDocument/hover", "params": {"textDocument": {"uri": uri}, "position": {"line": 0, "character": 20}}},
                {"id": 3, "method": "shutdown"}, {"method": "exit"}]
    bodies = [json.dumps({"jsonrpc": "2.0", **message}).encode() for message in messages]
    return b"".join(b"Content-Length: %d\r\n\r\n%s" % (len(body), body) for body in bodies)


SMALL = ["--size", "16x9", "--program-cache", "none"]
# name: arguments, whether it needs OpenGL, files that it makes or changes
COMMANDS = {
    "check": (["check", "graph.json"], True, []),
    "plan": (["plan", "graph.json"], False, []),
    "render": (["render", "graph.json", *SMALL, "--quiet", "-o", "out/a.exr"], True, ["out/a.exr"]),
    "sequence": (["render", "graph.json", *SMALL, "--frames", "0-3", "--quiet", "--manifest", "out/m.jsonl", "--checkpoint", "2", "--checkpoints", "out", "-o", "out/f_%04d.png"], True,
                 [f"out/f_000{i}.png" for i in range(4)]),
    "film": (["render", "graph.json", *SMALL, "--frames", "0-3", "--quiet", "-o", "out/film.mkv"], True, ["out/film.mkv"]),
    "dump": (["dump", "graph.json", "*", *SMALL, "-o", "out"], True, []),
    "report": (["report", "graph.json", *SMALL, "-o", "out/page.html"], True, []),
    "test": (["test", "small.cases.json", "--program-cache", "none"], True, []),
    "accept": (["test", "small.cases.json", "--accept", "--program-cache", "none"], True, ["one.png"]),
    "format": (["format", "loose.json"], False, ["loose.json"]),
    "import": (["import", "level.fs", "-o", "imported", "--overwrite"], False, ["imported/level.json", "imported/shaders/level/level.frag.glsl"]),
    "new": (["new", "pass", "fresh"], False, []),
    "lsp": (["lsp"], False, []),
}


def make_folder(folder):
    for name, value in (("graph.json", GRAPH), ("end.json", END), ("small.cases.json", CASES)):
        (folder / name).write_text(json.dumps(value))
    (folder / "loose.json").write_text(json.dumps(GRAPH) + "\n\n")
    (folder / "out").mkdir()
    (folder / "shaders").mkdir()
    for name, text in (("paint.frag.glsl", SHADER), ("part.glsl", PART), ("copy.frag.glsl", COPY)):
        (folder / "shaders" / name).write_text(text)
    (folder / "level.fs").write_text(ISF)


def files_of(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file() and p.name not in ("strace", "count")}


def is_json(text):
    try:
        return bool(json.loads(text))
    except ValueError:
        return False


class Faults:
    def __init__(self, weft, library, most, jobs):
        self.weft, self.library, self.most = os.path.abspath(weft), library, most
        self.pool = concurrent.futures.ThreadPoolExecutor(jobs)
        self.problems = []

    def run(self, name, kind="", n=0):
        """What the command leaves when the n-th of a kind fails: exit code, error text, files, whether anything failed, the trace."""
        arguments, _, _ = COMMANDS[name]
        with tempfile.TemporaryDirectory(prefix="weft_faults_") as where:
            folder = pathlib.Path(where).resolve() / "work"
            folder.mkdir()
            make_folder(folder)
            if name == "test":
                for golden in self.golden:
                    (folder / golden).write_bytes(self.golden[golden])
            before, trace, count = files_of(folder), folder.parent / "strace", folder.parent / "count"
            command, environment = [self.weft, *arguments], {**os.environ, "WEFT_DATA": str(TOP), "XDG_CACHE_HOME": str(self.cache)}
            if kind in MADE:
                environment |= {"LD_PRELOAD": str(self.library), "WEFT_FAIL": kind, "WEFT_FAIL_AT": str(n), "WEFT_FAIL_COUNT": str(count)}
            else:
                calls = [kind] if kind else list(CALLS)
                inject = [f"-einject={kind}:error={CALLS[kind]}:when={n}"] if kind else []
                command = ["strace", "-f", "-qq", "-o", str(trace), f"-etrace={','.join(calls)}", *inject, *command]
            try:
                done = subprocess.run(command, cwd=folder, env=environment, input=lsp_text(folder) if name == "lsp" else b"", capture_output=True, timeout=300)
                code, error = done.returncode, done.stderr.decode(errors="replace")
                error += done.stdout.decode(errors="replace") if name == "test" else ""  # where it says what failed
            except subprocess.TimeoutExpired:
                code, error = None, "no end after 300 s"
            said = trace.read_text(errors="replace") if trace.exists() else ""
            made = int(count.read_text()) if count.exists() else 0
            return {"code": code, "error": error, "before": before, "after": files_of(folder), "injected": "(INJECTED)" in said, "trace": said, "count": made}

    def judge(self, name, kind, n, run, whole):
        """A line for what does not hold; None else."""
        code, error = run["code"], run["error"]
        at = f"{name}: {kind} {n}: "
        if code == 127 and LOADER.search(error):
            return None  # the program never began
        if code not in (0, 1, 2, 3) or CRASH.search(error):
            return f"{at}exit code {code}\n{error[-800:]}"
        if code != 0 and not error.strip() and kind != "write" and name != "lsp":  # which answers in its own way
            return f"{at}exit code {code} without a word"
        for path in COMMANDS[name][2]:
            old, new = run["before"].get(path), run["after"].get(path)
            if code == 0 and new != whole.get(path):
                return f"{at}exit code 0, and {path} is not what it should be"
            if new not in (old, whole.get(path)):
                return f"{at}{path} is half made"
        if not all(is_json(line) for line in run["after"].get("out/m.jsonl", b"").splitlines(keepends=True) if line.endswith(b"\n")):
            return f"{at}a line of the manifest is half made"
        left = [path for path in run["after"] if path.endswith((".part", "~")) or "/." in "/" + path]
        # Where the removal itself fails, the file stays.
        if left and kind != "unlink":
            return f"{at}{left} left behind (exit code {code})"
        return None

    def numbers(self, first, last):
        all_of = list(range(first, last + 1))
        if len(all_of) <= self.most:
            return all_of
        half = self.most // 2
        step = max(1, (len(all_of) - half) // half)
        return all_of[:half] + all_of[half::step]

    def prepare(self, where):
        self.cache = where / "cache"
        self.cache.mkdir()
        accepted = self.run("accept")
        self.golden = {name: accepted["after"][name] for name in ("one.png", "one.passes")}

    def command(self, name, kinds):
        """One row: for each kind how often it was made to fail."""
        clean = self.run(name)
        whole, main = clean["after"], clean["trace"].split(" ", 1)[0]
        if clean["code"] != 0:
            self.problems.append(f"{name}: {clean['code']} without any fault\n{clean['error']}")
            return {}
        # Calls of the first thread; those of the loader come before it opens anything but libraries.
        calls, early = collections.Counter(), None
        for line in clean["trace"].splitlines():
            found = re.match(r"(\d+) +(\w+)\((.*)", line)
            if not found or found[1] != main:
                continue
            if early is None and found[2] == "openat" and not re.search(r"\.so|ld\.so", found[3]):
                early = calls.copy()
            calls[found[2]] += 1
        row = {}
        for kind in kinds:
            if (name, kind) == ("report", "close"):
                continue  # a call that strace fails is not made, and the pipe from Graphviz would never end
            if kind in MADE:
                if kind == "gl" and not COMMANDS[name][1]:
                    continue
                first, last = 1, self.run(name, kind)["count"]
            else:
                first, last = (early or collections.Counter())[kind] + 1, calls[kind]
            wanted = self.numbers(first, last)
            runs = list(self.pool.map(lambda n: (n, self.run(name, kind, n)), wanted))
            found = [text for n, run in runs if (text := self.judge(name, kind, n, run, whole))]
            self.problems += found
            row[kind] = (len(wanted), last, sum(run["code"] != 0 for _, run in runs), len(found))
            print(f"{name:9} {kind:11} {len(wanted):6} of {last:6}: {row[kind][2]:5} refused, {len(found)} wrong", flush=True)
            for text in found[:3]:
                print("  " + text.replace("\n", "\n  "), flush=True)
        return row


def reload_faults(faults, most):
    """A viewer in a virtual display: while a save is taken, something fails. It stays, and takes the next save."""
    with display() as environment, tempfile.TemporaryDirectory(prefix="weft_faults_") as where:
        os.environ.update(environment)
        folder = pathlib.Path(where)
        make_folder(folder)
        for kind in ("new", "gl", "thread"):
            wrong = n = 0
            for n in range(1, most + 1):
                trigger = folder / "now"
                trigger.unlink(missing_ok=True)
                (folder / "shaders/part.glsl").write_text(PART)
                os.environ.update({"LD_PRELOAD": str(faults.library), "WEFT_FAIL": kind, "WEFT_FAIL_AT": str(n), "WEFT_FAIL_AFTER": str(trigger), "WEFT_FAIL_COUNT": str(folder / "count")})
                session = Session(faults.weft, folder, graph="graph.json", size="64x36", data=False)
                for key in ("LD_PRELOAD", "WEFT_FAIL", "WEFT_FAIL_AT", "WEFT_FAIL_AFTER", "WEFT_FAIL_COUNT"):
                    os.environ.pop(key)
                try:
                    session.open()
                    ready = session.shot()
                    trigger.touch()
                    told = taken = None
                    for amount in ("0.25", "0.75"):  # the second one is taken, whatever failed in the first
                        before = session.mark()
                        save(folder / "shaders/part.glsl", PART.replace("0.5", amount))
                        told, taken = taken, session.event("files (?:good|wrong)", before)
                    ended = session.process.poll()
                    good = ended == 2 if ended is not None else told and taken and taken[0].endswith("good")
                    if not ready or not good or CRASH.search(session.said()):
                        wrong += 1
                        faults.problems.append(f"reload: {kind} {n}: {ended}, {told}, {taken}\n{session.said()[-600:]}")
                    if ended is None:
                        session.key("Escape")
                        session.until(lambda: not session.alive())
                finally:
                    session.stop()
                if (folder / "count").exists() and int((folder / "count").read_text()) < n:
                    break
            print(f"{'reload':9} {kind:11} {n:6}: {wrong} wrong", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("weft")
    parser.add_argument("commands", nargs="*")
    parser.add_argument("--kinds", default=",".join([*CALLS, *MADE]))
    parser.add_argument("--most", type=int, default=400)
    parser.add_argument("--jobs", type=int, default=2)
    asked = parser.parse_args()
    if not shutil.which("strace") or not shutil.which("c++"):
        print("skipped: strace or c++ is not installed")
        sys.exit(77)
    began = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="weft_faults_") as where:
        library = pathlib.Path(where) / "fail.so"
        subprocess.run(["c++", "-std=c++20", "-O1", "-shared", "-fPIC", "-o", library, HERE / "fail.cpp", "-ldl"], check=True)
        faults = Faults(asked.weft, library, asked.most, asked.jobs)
        faults.prepare(pathlib.Path(where))
        sums = collections.Counter()
        for name in asked.commands or [*COMMANDS, "reload"]:
            if name == "reload":
                reload_faults(faults, min(asked.most, 60))
                continue
            for kind, (tried, _, _, _) in faults.command(name, asked.kinds.split(",")).items():
                sums[kind] += tried
        print(f"{sum(sums.values())} faults in {time.monotonic() - began:.0f} s: " + ", ".join(f"{kind} {count}" for kind, count in sums.items()))
        print(f"{len(faults.problems)} wrong")
        sys.exit(1 if faults.problems else 0)


if __name__ == "__main__":
    main()
