#!/usr/bin/env python3
"""Every command on every file of graphs/ and on every broken graph of tests/bad_graphs: none crashes, each exits as docs/limits.md says, and what is
wrong is said with a place. Prints a line for each file: what each command ended with, and the codes of what it said; then a table of exit codes.

    every_graph.py WEFT [--all] [--cpu] [--only PART] [--jobs N]

A graph that `check` takes is taken by all commands; one that it refuses is refused by all, with the same codes. The manifest of the broken graphs says
which code is told at which place. --all: all files and the commands that draw, which takes a while; else a few files. --cpu: nothing is drawn.
--only: files with this in their path. --jobs: so many files at a time.
"""
import argparse
import collections
import concurrent.futures
import contextlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys

from drivers import drivers_of, watched
from program import TOP, Report, count_run, run, temporary_folder
from window import display

import schema

sys.path.insert(0, str(TOP / "tests/app/lsp"))
from editor import Editor  # noqa: E402

CRASH = re.compile(r"terminate called|Assertion|Segmentation|Aborted|what\(\):|AddressSanitizer|runtime error")
SMALL = ["--size", "64x36"]
GLOW = "graphs/glow.json"
# Commands that compare end with 2 where a graph is wrong.
WRONG = {"test plan": 2, "test picture": 2, "diff": 2, "diff to": 2, "diff render": 2, "bisect": 2, "bisect set": 2, "fuzz": 2}
# These end with 1 where something differs, or say what is wrong on standard output.
EXIT_ALONE = {"diff to", "bisect set", "bisect in any order", "diff render in any order", "test plan", "test picture", "sarif", "check json"}
FEW_BAD, FEW_GOOD = 12, {GLOW, "graphs/gi.json", "graphs/presets/cinema.json"}


class Sheet:
    """The runs of one file, and its line of the table."""

    def __init__(self, weft, report, path, more=()):
        self.weft, self.report, self.path, self.more, self.cells = weft, report, path, list(more), {}
        self.watching = None  # a folder, while what is loaded is looked at

    def run(self, column, *arguments):
        done = run(self.weft, *arguments, **({"env": watched(self.watching)} if self.watching else {}))
        name = f"{column} of {self.path}"
        self.report.check(0 <= done.code <= 3 and not CRASH.search(done.err), f"{name}: crash, {done.code}\n{done.err[-3000:]}")
        codes = done.codes("error") + done.codes("warning")
        self.cells[column] = " ".join([str(done.code), *codes])
        self.report.check(bool(done.codes("error")) == (done.code != 0) or column in EXIT_ALONE, f"{name}: exit code {done.code} with {codes}\n{done.err[-3000:]}")
        for said in done.diagnostics:
            placed = said["place"] and (said["line"] or said["place"].startswith("command line") or said["code"] == "W001")
            self.report.check(said["severity"] == "note" or placed, f"{name}: no place in {said}")
        return done

    def graph(self, column, command, *arguments, code=0, sound=True):
        """A command on the graph: it ends with `code`, or as the command does where a graph is wrong."""
        done = self.run(column, *command.split(), self.path, *arguments, *self.more)
        expected = code if sound else (WRONG.get(column, 1),)
        expected = expected if isinstance(expected, tuple) else (expected,)
        self.report.check(done.code in expected, f"{column} of {self.path}: exit code {done.code}, not {expected}\n{done.out[-2000:]}{done.err[-3000:]}")
        return done

    def open_in_editor(self, sound):
        """What the language server says of the file is what `check` says. It knows no settings, and a preset only as part of a graph."""
        editor = Editor(self.weft, TOP)
        editor.ask("initialize", {"capabilities": {}, "rootUri": None})
        editor.open(self.path, (TOP / self.path).read_bytes().decode(errors="replace"))
        editor.settle(self.path)
        # The server looks for shaders, too, which `check --no-shaders` does not.
        codes = sorted({d["code"] for each in editor.published.values() for d in each["diagnostics"] if d["severity"] == 1} - {"W100"})
        code = editor.end()
        self.cells["lsp"] = " ".join([str(code), *codes])
        self.report.check(code == 0 and (sound is None or bool(codes) != sound), f"{self.path} in an editor: {code} {codes}")

    def text(self):
        return f"{self.path}: " + ", ".join(f"{column} {cell}" for column, cell in self.cells.items())


def other_setting(parameters):
    """One parameter set to another value that it may have."""
    for p in parameters:
        if p["type"] == "bool":
            return f"{p['name']}={json.dumps(not p['value'])}"
        if p["type"] == "float" and "min" in p and "max" in p:
            return f"{p['name']}={p['min'] if p['value'] != p['min'] else p['max']}"
        if p["type"] == "choice":
            return f"{p['name']}={next(word for word in p['choices'] if word != p['value'])}"
    return None


def names_of(sheet):
    """A pass, a resource and a parameter of a sound graph, a setting that changes it, whether it presents anything, whether any pass runs, and a texture that a pass
    writes."""
    plan = json.loads(run(sheet.weft, "plan", sheet.path, "--format", "json", *sheet.more).out)
    parameters = json.loads(run(sheet.weft, "params", sheet.path, "--json", *sheet.more).out)
    names = [step["pass"] for step in plan["steps"][:1]] + [r["name"] for r in plan["resources"][:1]] + [p["name"] for p in parameters[:1]]
    texture = next((use["resource"] for step in plan["steps"] for use in step["uses"] if use["kind"] == "color" and use["attached"]), None)
    return names, other_setting(parameters), bool(plan["steps"] and plan.get("present")), bool(plan["steps"]), texture


def check_case(sheet, folder, column, more, sound):
    """`weft test` with a case of this graph: its golden is written, and then found the same."""
    cases = pathlib.Path(folder, column)
    cases.mkdir()
    settings = dict(zip(sheet.more[::2], sheet.more[1::2]))
    case = {"name": "one", "graph": str(TOP / sheet.path), **more}
    if "--disable" in settings:
        case["disable"] = [settings["--disable"]]
    if "--set" in settings:
        name, value = settings["--set"].split("=", 1)
        case["set"] = {name: value if value.isalpha() else json.loads(value)}
    (cases / "one.cases.json").write_text(json.dumps({"cases": [case]}))
    for option in (["--accept"], []) if sound else ([],):
        done = sheet.run(column, "test", cases, *option)
        # A graph with warnings is accepted, and differs.
        expected = (0, 1) if sound else (2,)
        sheet.report.check(done.code in expected and (done.code != 1 or "it has warnings" in done.out), f"{column} of {sheet.path}: {done.code}\n{done.out}{done.err}")


def check_json(sheet, checked):
    """`check` as JSON, once and with --watch, which does not end by itself, says what it says as text."""
    done = sheet.graph("check json", "check --no-shaders --format json", code=checked.code, sound=True)
    found = json.loads(done.out)
    codes = {d["code"] for d in found["diagnostics"] if d["severity"] == "error"}
    sheet.report.check(codes == set(checked.codes()) and (found["errors"] > 0) == (done.code != 0) and not done.err, f"{sheet.path} as JSON: {codes}, as text {checked.codes()}\n{done.err}")
    count_run()
    command = [sheet.weft, "check", "--no-shaders", "--format", "json", "--watch", sheet.path, *sheet.more]
    with subprocess.Popen(list(map(str, command)), cwd=TOP, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, errors="replace") as watching:
        line = watching.stdout.readline()
        watching.terminate()
        code = watching.wait()
    sheet.cells["check watch"] = "watches" if code == -signal.SIGTERM else str(code)
    sheet.report.check(code == -signal.SIGTERM and line.startswith("{") and json.loads(line) == found, f"check --watch of {sheet.path} ends with {code}, and says\n{line}, not\n{done.out}")


def check_import(sheet, folder):
    """A graph is none of the files that `import` takes: it says so, and writes nothing."""
    target = pathlib.Path(folder, "imported")
    done = sheet.run("import", "import", sheet.path, "-o", target)
    sheet.report.check(done.code == 1 and not target.exists(), f"import of {sheet.path}: {done.code}\n{done.out}{done.err}")


def check_view(sheet, sound):
    """Two frames in a window, black where the graph presents nothing; what is wrong with the graph ends it, because nobody could mend it in time."""
    if "DISPLAY" not in os.environ:
        sheet.cells["view"] = "skipped"
        return
    sheet.graph("view", "view --max-frames 2", *SMALL, sound=sound)


def run_on_cpu(sheet, folder, sound, fits):
    """`fits`: without OpenGL, nothing is wrong between the graph and the words of its shaders."""
    sheet.graph("matrix", "check --no-shaders --matrix", sound=sound and fits)
    sarif = sheet.graph("sarif", "check --no-shaders --format sarif", sound=sound and fits)
    results = json.loads(sarif.out)["runs"][0]["results"]
    sheet.report.check(any(result["level"] == "error" for result in results) != (sound and fits), f"{sheet.path} as SARIF: {results[:3]}")
    check_case(sheet, folder, "test plan", {"plan": True}, sound)
    names, *rest = names_of(sheet) if sound else (["composite"], None, False, False, None)
    for name in names:
        sheet.graph("explain", "explain", name, sound=sound)
    sheet.graph("diff", "diff", sheet.path, sound=sound)
    sheet.graph("diff to", "diff", GLOW, code=(0, 1), sound=sound)
    for column, command in (("plan", "plan"), ("plan json", "plan --format json --explain"), ("dot", "dot"), ("params", "params")):
        done = sheet.graph(column, command, sound=sound)
        sheet.report.check(bool(done.out) == sound, f"{column} of {sheet.path} prints {done.out[:200]!r}")
    return rest


def fills_by_atomics(path):
    """Whether a shader beside the graph fills a list by atomics: two runs may fill it in another order, for the same picture."""
    shaders = pathlib.Path(TOP, path).parent / "shaders"
    return any("atomic" in file.read_text() for file in shaders.rglob("*.glsl"))


def compare_with_itself(sheet, column, command, shown):
    if shown and fills_by_atomics(sheet.path):
        done = sheet.graph(f"{column} in any order", command, *SMALL, code=(0, 1))
    else:
        done = sheet.graph(column, command, *SMALL, code=0 if shown else 2)
    sheet.report.check(not shown or "pictures: the same" in done.out, f"{column} of {sheet.path}: {done.out[-2000:]}")


def run_on_device(sheet, folder, other, shown, runs, texture):
    sheet.graph("check all", "check --all")
    # What presents nothing cannot be shown or compared.
    for column, command, more in (("render", "render", ["--quiet", "-o", f"{folder}/picture.png"]), ("fuzz", "fuzz", ["--runs", "1"]),
                                  ("report", "report", ["-o", f"{folder}/page.html"])):
        sheet.graph(column, command, *more, *SMALL, code=0 if shown else WRONG.get(column, 1))
    check_case(sheet, folder, "test picture", {"size": SMALL[1]}, shown)
    check_view(sheet, True)
    compare_with_itself(sheet, "bisect", "bisect", shown)
    compare_with_itself(sheet, "diff render", f"diff --render {sheet.path}", shown)
    if texture:
        for column, more in (("render name", ["-o", f"{texture}={folder}/texture.exr"]), ("render present", ["--present", texture, "-o", f"{folder}/present.png"])):
            sheet.graph(column, "render --quiet", *more, *SMALL)
        left = [pathlib.Path(folder, name) for name in ("texture.exr", "present.png")]
        sheet.report.check(all(file.is_file() and file.stat().st_size > 0 for file in left), f"{sheet.path}: render of '{texture}' leaves {[f.name for f in left if f.is_file()]}")
    if other:
        sheet.graph("bisect set", "bisect", "--other-set", other, *SMALL, code=(0, 1) if shown else 2)
    dumped = sheet.graph("dump", "dump", "*", "-o", f"{folder}/dump", *SMALL, code=0 if runs else 1)
    files = [line.split("  ")[0] for line in dumped.out.splitlines()]
    sheet.report.check(bool(files) == runs and all(pathlib.Path(file).stat().st_size > 0 for file in files), f"dump of {sheet.path}: {files[:3]}")


def refuse_on_device(sheet, folder):
    """What draws refuses a wrong graph, too, before it opens OpenGL, and leaves nothing. The viewer alone has its window by then."""
    left = pathlib.Path(folder, "left")
    sheet.watching = temporary = pathlib.Path(folder, "watched")
    temporary.mkdir()
    for column, command, more in (("check all", "check --all", []), ("render", "render --quiet", ["-o", f"{left}.png"]), ("dump", "dump", ["*", "-o", left]),
                                  ("fuzz", "fuzz", ["--runs", "1"]), ("bisect", "bisect", [])):
        sheet.graph(column, command, *more, *([] if column == "check all" else SMALL), sound=False)
    sheet.graph("diff render", "diff --render", sheet.path, *SMALL, "-o", left, sound=False)
    check_case(sheet, folder, "test picture", {"size": SMALL[1]}, False)
    sheet.watching = None
    drivers = drivers_of(temporary)  # None: the linker said nothing, so nobody knows
    sheet.report.check(drivers == [], f"{sheet.path} is wrong, and something draws: {drivers}")
    check_view(sheet, False)
    found = list(pathlib.Path(folder).glob("left*"))
    sheet.report.check(not found, f"{sheet.path} is wrong, and leaves {found}")


def check_new(sheet, folder, sound):
    """`new pass` behind this graph. Only what it reads of the file can be wrong: a mistake that shows later does not refuse it."""
    target = pathlib.Path(folder, "new")
    done = sheet.run("new pass", "new", "pass", "every_one", "--graph", sheet.path, "-o", target)
    sheet.report.check(done.code == 0 or not target.exists(), f"new pass behind {sheet.path} leaves files")
    if done.code == 0 and sound:
        again = run(sheet.weft, "check", "--no-shaders", target / "every_one.json", *sheet.more)
        sheet.report.check(again.code == 0, f"{sheet.path} with a new pass: {again.err[-3000:]}")


def is_graph(path):
    """Of a preset and a scene an editor says only whether they are JSON; of one in which no "passes" or "extends" can be made out nothing; what it sends is UTF-8."""
    try:
        graph = schema.read(TOP / path)
    except UnicodeDecodeError:
        return False
    except ValueError:
        before = (TOP / path).read_bytes().split(b"/*")[0]
        return b'"passes"' in before or b'"extends"' in before
    return isinstance(graph, dict) and bool({"passes", "extends"} & set(graph))


def look_at(weft, report, path, draws, more=(), told=None):
    """`told`: the code of a broken graph and its place, as the manifest has them."""
    sheet = Sheet(weft, report, path, more)
    with temporary_folder() as folder:
        on_cpu = told is None or told["stage"] not in ("shader", "render")
        checked = sheet.run("check", "check", "--no-shaders", path, *more)
        fits = told is None or not told.get("words")
        sound = checked.code == 0 or not fits
        if told and on_cpu:
            place = (f"tests/bad_graphs/{told.get('in', told['file'])}", told["line"], told["column"], told["code"])
            found = [("" if told["line"] == 0 else d["place"], int(d["line"] or 0), int(d["column"] or 0), d["code"]) for d in checked.diagnostics]
            report.check((place if told["line"] else ("", 0, 0, told["code"])) in found, f"{path}: {place} is not told, but {found}")
        elif told and not fits:
            found = [(d["place"], int(d["line"] or 0), int(d["column"] or 0), d["code"]) for d in checked.diagnostics]
            place = (f"tests/bad_graphs/{told['file']}", told["line"], told["column"], told["code"])
            report.check(found == [place], f"{path}: without shaders {place} is not told, but {found}")
        elif told:
            report.check(sound and not checked.codes(), f"{path}: without shaders, {checked.code} {checked.err}")
        # What the editor has of shaders depends on the mistake; settings of the command line it has not.
        sheet.open_in_editor(sound and fits if on_cpu and not more and is_graph(path) else None)
        check_json(sheet, checked)
        check_import(sheet, folder)
        of_graph = run_on_cpu(sheet, folder, sound, fits)
        check_new(sheet, folder, sound and fits)
        formatted = sheet.run("format", "format", "--check", path)
        if told is None:
            report.check(formatted.code == 0, f"{path} is laid out: {formatted.err}")
        if draws and told and not on_cpu:
            drawn = sheet.run("check all", "render" if told["stage"] == "render" else "check", path, *more, *(["-o", f"{folder}/a.png"] if told["stage"] == "render" else []))
            report.check(drawn.code == 1 and told["code"] in drawn.codes(), f"{path}: {told['code']} is not told\n{drawn.err}")
        elif draws and told is None and sound:
            run_on_device(sheet, folder, *of_graph)
        elif draws and not sound:
            refuse_on_device(sheet, folder)
    return sheet


def print_table(good, bad):
    """Of each command, how many files it ended with which exit code."""
    print(f"| command | {len(good)} files of graphs/ | {len(bad)} broken graphs |\n|---|---|---|")
    for column in dict.fromkeys(column for sheet in [*good, *bad] for column in sheet.cells):
        counts = [collections.Counter(sheet.cells[column].split()[0] for sheet in sheets if column in sheet.cells) for sheets in (good, bad)]
        print(f"| {column} | " + " | ".join(", ".join(f"{code}: {n}" for code, n in sorted(each.items())) for each in counts) + " |")


def check_alone(weft, report):
    """The commands that take no graph. Returns their line of the table."""
    sheet = Sheet(weft, report, "no file")
    for column, command in (("schema", "schema"), ("types", "types"), ("presets", "presets")):
        done = sheet.run(column, *command.split())
        report.check(done.code == 0 and done.out and not done.err, f"{command}: {done.code}\n{done.err}")
    return sheet


@contextlib.contextmanager
def a_display(wanted):
    """For `view`: a virtual one. Without it, `view` is said to be skipped."""
    if not wanted or not shutil.which("Xvfb"):
        os.environ.pop("DISPLAY", None)
        yield
        return
    with display() as environment:
        os.environ.clear()
        os.environ.update(environment)
        yield


def look_at_all(weft, report, good, bad, draws, jobs):
    """One sheet for each file, printed as it comes."""
    def look(entry):
        if isinstance(entry, str):
            return look_at(weft, report, entry, draws)
        more = [word for option in ("set", "disable") for value in entry.get(option, []) for word in (f"--{option}", value)]
        return look_at(weft, report, f"tests/bad_graphs/{entry['file']}", draws, more, entry)

    sheets = []
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for sheet in pool.map(look, [*good, *bad]):
            sheets.append(sheet)
            print(sheet.text(), flush=True)
    return sheets[: len(good)], sheets[len(good) :]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("weft", type=pathlib.Path)
    for flag in ("--all", "--cpu", "--sanitized"):
        parser.add_argument(flag, action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--jobs", type=int, default=1)
    options, report = parser.parse_args(), Report()
    weft = options.weft.resolve()
    good = [str(path.relative_to(TOP)) for path in sorted((TOP / "graphs").rglob("*.json"))]
    bad = [entry for entry in json.loads((TOP / "tests/bad_graphs/manifest.json").read_text())["files"]]
    good = [path for path in good if options.only in path and (options.all or path in FEW_GOOD)]
    bad = [entry for entry in bad if options.only in f"tests/bad_graphs/{entry['file']}"]
    bad = bad if options.all else bad[5::max(1, len(bad) // FEW_BAD)]
    report.check(good or bad, f"no file has '{options.only}' in its path")
    draws = options.all and not options.cpu
    print(check_alone(weft, report).text(), flush=True)
    with a_display(draws):
        if draws and "DISPLAY" not in os.environ:
            print("skipped: view, because Xvfb is not installed")
        sheets = look_at_all(weft, report, good, bad, draws, options.jobs)
    print_table(*sheets)
    print(f"{len(good)} files of graphs/, {len(bad)} broken graphs")
    report.end()


if __name__ == "__main__":
    main()
