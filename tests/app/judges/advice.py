#!/usr/bin/env python3
"""What `weft check` says to do, done: the message goes away, and following the messages ends within five steps.
advice.py WEFT [--mutants N] [--seed S] [--tell], from the source folder.

In copies of the bundled graphs one word is misspelt at a time (a key, a reference, a resource, a parameter, a pass, a type, a format, an
import, a path); of the studio, passes are disabled. A mistake is one error; an input that is misspelt is not tried, for two files name it. Where the fix names a word to write, or passes
to disable, it is applied. The bad graphs' fixes are applied as well. --tell prints each mutant that fails, and counts by kind."""
import collections
import json
import pathlib
import random
import re
import shutil
import sys

from program import Report, TOP, run, temporary_folder

STEPS = 5
SAMPLE = 40
KINDS = {
    "reference": re.compile(r'"[a-z_]\w*": "@?(?P<word>[a-z]\w{2,})(?=[."\[@ ])(?=[^"]*")'),
    "key": re.compile(r'[{,]\s*"(?P<word>name|type|shader|enabled|read|write|modify|parameters|defines|state|repeat|update|threads|texture|size|mips|clear|history|include|default|choices|label)":'),
    "variable": re.compile(r'\$(?P<word>[a-z]\w{2,})'),
    "resource": re.compile(r'^ {4}"(?P<word>[a-z]\w{2,})": +\{ "(?:texture|buffer|import)"', re.M),
    "parameter": re.compile(r'^ {4}"(?P<word>[a-z]\w{2,})": +\{ (?:"type"|"default")', re.M),
    "type": re.compile(r'"type": "(?P<word>fullscreen|compute|draw|blit|mipmap)"'),
    "format": re.compile(r'"texture": "(?P<word>\w+)"'),
    "import": re.compile(r'"import": "(?P<word>\w+)"'),
    "include": re.compile(r'"include": "(?:effects/)?(?P<word>\w+)\.json"'),
    "shader": re.compile(r'"shader": "\w+/(?P<word>\w+)'),
    "word": re.compile(r'"(?:update|blend|depth_test|cull|geometry)": "(?P<word>\w+)"'),
}
# Roots that include most of what there is.
ROOTS = ("studio.json", "deferred.json", "studio_gi.json", "deferred_gi.json", "glow.json", "taa.json")
ERROR = re.compile(r"^(?:(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+): )?(?:command line: [^\n]*?: )?error\[(?P<code>W\d{3})\]: (?P<text>[^\n]*)(?P<more>(?:\n    [^\n]*)*)", re.M)


CHANGED = set()  # files that a fix was written into


def restore(folder):
    """The files of a copy of the source folder, as they are there."""
    for path in CHANGED:
        path.write_bytes((TOP / path.relative_to(folder)).read_bytes())
    CHANGED.clear()


class Said:
    def __init__(self, match):
        self.file, self.code, self.text = match["file"], match["code"], match["text"]
        self.line, self.column = int(match["line"] or 0), int(match["column"] or 0)
        fix = re.search(r"\n    fix: (.*)", match["more"])
        self.fix = fix[1] if fix else ""

    def key(self):
        return self.code, self.text

    def __str__(self):
        return f"{self.file}:{self.line}:{self.column} {self.code} {self.text} | fix: {self.fix}"


def misspell(word, chance):
    at = chance.randrange(1, len(word) - 1) if len(word) > 2 else 0
    kind = chance.choice(("swap", "drop", "double"))
    if kind == "swap" and word[at] != word[at + 1]:
        return word[:at] + word[at + 1] + word[at] + word[at + 2:]
    if kind == "drop":
        return word[:at] + word[at + 1:]
    return word[:at] + word[at] + word[at:]


def closure(path, folder, seen=None):
    seen = set() if seen is None else seen
    if path not in seen and path.exists():
        seen.add(path)
        for name in re.findall(r'"(?:include|extends)": "([^"]+)"', path.read_text()):
            closure((path.parent / name).resolve(), folder, seen)
    return seen


def errors_of(weft, root, disables):
    result = run(weft, "check", "--no-shaders", root, *(part for name in disables for part in ("--disable", name)))
    return [*map(Said, ERROR.finditer(result.err))], result


def write_at(said, word, whole=False):
    """`word` in place of the one that the message quotes, in the line of its place, behind its column; False when that is not there."""
    path = pathlib.Path(said.file)
    lines = path.read_text().splitlines(keepends=True)
    line = lines[said.line - 1]
    head, tail = line[:said.column - 1], line[said.column - 1:]
    found = []
    for a, b in re.findall(r"'([^']*)'|\"([^\"]*)\"", said.text):
        bad = (a or b).lstrip("$@")
        if bad and bad != word:
            found += [match.span() for match in re.finditer(rf"(?<![\w.]){re.escape(bad)}(?!\w)", tail) if match.start() < 60]
    if found:
        begin, end = min(found)
        lines[said.line - 1] = head + tail[:begin] + word.lstrip("$@") + tail[end:]
        path.write_text("".join(lines))
        CHANGED.add(path.resolve())
        return True
    return False


def apply(said, disables):
    """Whether the fix is mechanical, and was applied."""
    meant = re.match(r"""(?:did you mean|write the whole name,|write) (?:the import )?['"]([^'"]+)['"]""", said.fix)
    if meant and said.file and not re.search("[…(]", meant[1]):
        return write_at(said, meant[1])
    off = re.match(r"(?:.*, or )?disable ((?:'[^']+'(?:, | and )?)+) too", said.fix)
    if off:
        disables += re.findall("'([^']+)'", off[1])
        return True
    return False


class Judge:
    def __init__(self, weft, report, tell):
        self.weft, self.report, self.tell = weft, report, tell
        self.found = collections.Counter()
        self.tried = collections.Counter()

    def fault(self, kind, label, errors):
        self.found[kind] += 1
        text = f"{kind}: {label}\n    " + "\n    ".join(map(str, errors[:4]))
        if self.tell:
            print(text)
        self.report.check(False, text)

    def follow(self, label, root, disables=(), errors=None):
        """Follows the messages of a graph in a folder that may be changed; `errors`, where they are known."""
        disables = list(disables)
        if errors is None:
            errors, _ = errors_of(self.weft, root, disables)
        for _ in range(STEPS):
            if not errors:
                return
            before = None
            for said in errors:
                if apply(said, disables):
                    before = said
                    break
            if before is None:
                return  # a person decides
            self.tried["fixes"] += 1
            errors, _ = errors_of(self.weft, root, disables)
            if before.key() in (said.key() for said in errors):
                return self.fault("the fix does not work", label, [before])
        if errors:
            self.fault("no end after five steps", label, errors)

    def mutants(self, count, seed):
        chance = random.Random(seed)
        with temporary_folder() as folder:
            folder = pathlib.Path(folder).resolve()
            shutil.copytree(TOP / "graphs", folder / "graphs")
            (folder / "shaders").symlink_to(TOP / "shaders")
            graphs = folder / "graphs"
            roots = {root: closure(graphs / root, folder) for root in ROOTS}
            made = 0
            while made < count:
                root = chance.choice(ROOTS)
                path = chance.choice(sorted(roots[root]))
                kind = chance.choice(sorted(KINDS))
                text = path.read_text()
                places = [m for m in KINDS[kind].finditer(text) if "//" not in text[text.rfind("\n", 0, m.start()) + 1:m.start()]]
                if not places:
                    continue
                place = chance.choice(places)
                word = place["word"]
                wrong = misspell(word, chance)
                if wrong == word or wrong in text:
                    continue
                made += 1
                begin, end = place.span("word")
                path.write_text(text[:begin] + wrong + text[end:])
                label = f"{kind} '{word}' as '{wrong}' in {path.name} of {root}, line {text.count(chr(10), 0, begin) + 1} (drawn by chance: perhaps an old fault)"
                errors, result = errors_of(self.weft, graphs / root, [])
                self.tried["mutants"] += 1
                self.tried["told"] += bool(errors)
                self.report.check(result.code in (0, 1), f"{label}: exit code {result.code}")
                if len(errors) > 1:
                    self.fault(f"{'three or more' if len(errors) > 2 else 'two'} messages", label, errors)
                self.follow(label, graphs / root, errors=errors)
                CHANGED.add(path)
                restore(folder)

    def disables(self):
        """What people switch off in the studio, singly and in pairs."""
        with temporary_folder() as folder:
            folder = pathlib.Path(folder).resolve()
            shutil.copytree(TOP / "graphs", folder / "graphs")
            (folder / "shaders").symlink_to(TOP / "shaders")
            for names in (["composite"], ["composite", "fxaa"], ["post"], ["post", "lit"], ["post.display"], ["ibl"], ["skybox", "billboards"],
                          ["post.fxaa.find_edges"], ["post.bloom"], ["fog", "ibl"], ["lit", "ibl"]):
                self.follow(" ".join(names), folder / "graphs/studio.json", names)
                restore(folder)

    def bad_graphs(self):
        with temporary_folder() as folder:
            folder = pathlib.Path(folder).resolve()
            shutil.copytree(TOP / "tests/bad_graphs", folder / "tests/bad_graphs")
            for entry in json.loads((TOP / "tests/bad_graphs/manifest.json").read_text())["files"]:
                if entry["stage"] not in ("read", "expand"):
                    continue
                self.tried["bad graphs"] += 1
                self.follow(entry["file"], folder / "tests/bad_graphs" / entry["file"], entry.get("disable", ()))
                restore(folder)


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    value = lambda name, absent: int(sys.argv[sys.argv.index(name) + 1]) if name in sys.argv else absent
    judge = Judge(weft, report, "--tell" in sys.argv)
    judge.disables()
    judge.bad_graphs()
    judge.mutants(value("--mutants", SAMPLE), value("--seed", 25))
    print(dict(judge.tried), dict(judge.found))
    report.end()


if __name__ == "__main__":
    main()
