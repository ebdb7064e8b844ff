#!/usr/bin/env python3
"""What `weft farm` writes, without a scheduler: the script for Slurm is run with an `sbatch` that only writes down what it is told, the
template for Open Job Description is held against the schema of its specification; tasks of both are run and draw each frame once. All
names are such as a shell or a template would take in another way.

    farm.py WEFT
"""
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

from program import TOP, Report, run, temporary_folder

# Of wiki/2023-09-Template-Schemas.md in github.com/OpenJobDescription/openjd-specifications: what a template without extensions may
# say, as far as Weft says it.
NAME = {"type": "string", "pattern": r"^[^\u0000-\u001f\u007f-\u009f]{1,64}\Z"}
IDENTIFIER = {"type": "string", "pattern": r"^[A-Za-z_][A-Za-z0-9_]{0,63}\Z"}
WORD = {"type": "string", "pattern": r"^[^\u0000-\u001f\u007f-\u009f]*\Z"}


def thing(required, **optional):
    return {"type": "object", "required": list(required), "properties": {**required, **optional}, "additionalProperties": False}


def some(items, most=None):
    return {"type": "array", "minItems": 1, "items": items, **({"maxItems": most} if most else {})}


SCRIPT = thing({"actions": thing({"onRun": thing({"command": {**WORD, "minLength": 1}}, args={"type": "array", "items": WORD})})},
               embeddedFiles=some(thing({"name": IDENTIFIER, "type": {"const": "TEXT"}, "data": {"type": "string", "minLength": 1}})))
PARAMETER = thing({"name": IDENTIFIER, "type": {"const": "INT"}, "range": {"type": "string", "pattern": r"^\d+-\d+\Z"}})
TEMPLATE = thing({"specificationVersion": {"const": "jobtemplate-2023-09"}, "name": NAME,
                  "steps": some(thing({"name": NAME, "script": SCRIPT}, dependencies=some(thing({"dependsOn": NAME})),
                                      parameterSpace=thing({"taskParameterDefinitions": some(PARAMETER, 16)})))})
HOSTILE = "it's \"$(id) `id` $HOME\n{{Param.X}} }} %s \\ ä"
SBATCH = """#!/bin/bash
printf '%s\\0' "$@" >>"$SAID"
printf '\\1\\0' >>"$SAID"
[ -z "$FAILS" ] && echo "$((41 + $(tr -cd '\\1' <"$SAID" | wc -c)));cluster"
"""
SET, FRAMES = "0-4,7-11x2", [0, 1, 2, 3, 4, 7, 9, 11]


class Bench:
    def __init__(self, weft, folder, report):
        self.weft, self.folder, self.report = weft, folder, report
        self.home = folder / HOSTILE
        shutil.copytree(TOP / "docs/tutorials/shaders", self.home / "shaders")
        for name in ("trail", "toy"):
            shutil.copy(TOP / f"docs/tutorials/{name}.json", self.home / f"{name} {{{{ '.json")
        (folder / "bin").mkdir()
        (folder / "bin/sbatch").write_text(SBATCH)
        (folder / "bin/sbatch").chmod(0o755)

    def farm(self, kind, graph, out, *arguments):
        return run(self.weft, "farm", kind, f"{graph} {{{{ '.json", "--size", "8x6", "--frames", SET, "--per-task", "3", "-o", f"{out}/f'{{{{_%d.png",
                   "--program-cache", "none", *arguments, folder=self.home, env=self.environment())

    def environment(self, **more):
        return {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "SAID": str(self.folder / "said"), "FAILS": "", **more}

    def bash(self, script, *arguments, **more):
        return subprocess.run(["bash", script, *arguments], cwd=self.folder, capture_output=True, text=True, env=self.environment(**more))

    def said(self):
        """The words of each call of sbatch since the last time."""
        path = self.folder / "said"
        calls = path.read_bytes().decode().split("\0\1\0") if path.exists() else [""]
        path.unlink(missing_ok=True)
        return [call.split("\0") for call in calls[:-1]]

    def drawn(self, out):
        return sorted(int(re.search(r"_(\d+)\.png", path.name)[1]) for path in (self.home / out).glob("*.png"))


def chunks_of(script):
    """The frames of each task."""
    sets = re.search(r"^frames=\((.*)\)$", script, re.M)[1].split()
    expand = lambda part: (lambda m: list(range(int(m[1]), int(m[2] or m[1]) + 1, int(m[3] or 1))))(re.fullmatch(r"(\d+)(?:-(\d+))?(?:x(\d+))?", part))
    return [[frame for part in each.split(",") for frame in expand(part)] for each in sets]


def slurm(bench):
    report = bench.report
    for graph, in_order in (("toy", False), ("trail", True)):
        out = f"{graph}'s {HOSTILE[:20]}"
        written = bench.farm("slurm", graph, out)
        script = bench.home / out / "farm.sbatch.sh"
        text = script.read_text()
        report.check(written.code == 0 and written.err == "" and not bench.said(), f"{graph}: {written.out}{written.err}")
        report.check(bench.farm("slurm", graph, out, "--script", "-").out == text, f"{graph}: another script on standard output")
        report.check(subprocess.run(["bash", "-n", script]).returncode == 0, f"{graph}: bash -n\n{text}")
        chunks = chunks_of(text)
        report.check(sum(chunks, []) == FRAMES and [len(each) for each in chunks] == [3, 3, 2], f"{graph}: {chunks}")
        report.check(all(line.isprintable() for line in text.splitlines()), f"{graph}: control characters\n{text}")
        report.check((" --checkpoint=3 " in text) == in_order, f"{graph}: checkpoints\n{text}")
        submitted = bench.bash(script, "--partition=a b")
        report.check(submitted.returncode == 0 and submitted.stderr == "", f"{graph}: {submitted.stdout}{submitted.stderr}")
        common = ["--parsable", "--requeue", f"--chdir={bench.home / out}", "--output=%x_%j.log"]
        call = lambda job, *words, role: [*common, f"--job-name=weft_{job}", *words, "--partition=a b", str(script), *role]
        tasks = [call("render", "--array=0-2", role=["task"])]
        if in_order:
            tasks = [call("render", *([f"--dependency=afterany:{41 + i}"] if i else []), role=["task", str(i)]) for i in range(3)]
        expected = [*tasks, call("gather", f"--dependency=afterany:{41 + len(tasks)}", role=["gather"])]
        report.check((said := bench.said()) == expected, f"{graph}: sbatch is told {said}\nnot {expected}")
        for i, chunk in enumerate(chunks):
            done = bench.bash(script, "task", str(i)) if in_order else bench.bash(script, "task", SLURM_ARRAY_TASK_ID=str(i))
            report.check(done.returncode == 0 and bench.drawn(out) == sorted(sum(chunks[:i + 1], [])), f"{graph}: task {i}: {bench.drawn(out)}\n{done.stderr}")
        gather = bench.bash(script, "gather")
        report.check(gather.returncode == 0 and gather.stderr.endswith("8 frames: 8 done already, 0 drawn\n"), f"{graph}: gather: {gather.stderr}")
        report.check(bench.farm("slurm", graph, out, "--submit").code == 0 and len(bench.said()) == len(expected), f"{graph}: --submit")
        failed = bench.bash(script, FAILS="yes")
        report.check(failed.returncode != 0 and len(bench.said()) == 1, f"{graph}: goes on after sbatch has failed")
    (bench.home / "trail {{ '.json").unlink()
    failed = bench.bash(script, "task", "0")
    report.check(failed.returncode == 1 and re.findall(r"try (\d) of 3 of frames 0-2: exit code 1\n", failed.stderr) == ["1", "2", "3"], f"tries: {failed.stderr}")
    shutil.copy(TOP / "docs/tutorials/trail.json", bench.home / "trail {{ '.json")


def resolved(text, values):
    """A format string of a template."""
    parts = re.split(r"\{\{([^{}]*)\}\}", text)
    assert not any(brace in part for part in parts[::2] for brace in ("{{", "}}")), text
    return "".join(values[part.strip()] if i % 2 else part for i, part in enumerate(parts))


def openjd(bench):
    report = bench.report
    for graph, tasks in (("toy", 3), ("trail", 1)):
        out = f"openjd of {graph} {HOSTILE.replace('%s', '')}"
        written = bench.farm("openjd", graph, out)
        report.check(written.code == 0, f"openjd: {written.err}")
        template = json.loads((bench.home / out / "farm.openjd.json").read_text())
        if importlib.util.find_spec("jsonschema"):
            import jsonschema
            problems = [error.message for error in jsonschema.Draft202012Validator(TEMPLATE).iter_errors(template)]
            report.check(not problems, f"openjd: {problems}")
        report.check([step["name"] for step in template["steps"]] == ["render", "gather"] and template["steps"][1]["dependencies"] == [{"dependsOn": "render"}],
                     f"openjd: {template}")
        for step in template["steps"]:
            space = step.get("parameterSpace", {"taskParameterDefinitions": [{"name": "None", "range": "0-0"}]})["taskParameterDefinitions"][0]
            first, last = map(int, space["range"].split("-"))
            report.check(last - first + 1 == (tasks if step["name"] == "render" else 1), f"openjd: {space}")
            for value in range(first, last + 1):
                values = {"Task.File.Run": str(bench.folder / "run.sh"), f"Task.Param.{space['name']}": str(value)}
                (bench.folder / "run.sh").write_text(resolved(step["script"]["embeddedFiles"][0]["data"], {}))
                action = step["script"]["actions"]["onRun"]
                done = subprocess.run([resolved(word, values) for word in (action["command"], *action["args"])], cwd=bench.folder, capture_output=True, text=True)
                report.check(done.returncode == 0, f"openjd: {step['name']}: {done.stderr}")
        report.check(bench.drawn(out) == FRAMES and done.stderr.endswith("8 frames: 8 done already, 0 drawn\n"), f"openjd: {bench.drawn(out)}\n{done.stderr}")


def refused(bench):
    report = bench.report
    for code, says, arguments in (
            (2, "is one film of all frames", ("-o", "x.mkv")),
            (1, "expected at most 1000 tasks, found 1500\n    fix: --per-task 2", ("-o", "x/%d.png", "--frames", "0-1499", "--per-task", "1")),
            (1, "--script would write over", ("-o", "x/%d.png", "--script", "toy {{ '.json")),
            (2, "--submit is for slurm", ("-o", "x/%d.png", "--submit", "--script", "-")),
            (2, "unknown option '--per-tusk'; did you mean '--per-task'?", ("-o", "x/%d.png", "--per-tusk", "3")),
            (2, "--frames is required", ("-o", "x/%d.png"))):
        frames = () if "--frames" in arguments or "required" in says else ("--frames", "0-9")
        done = run(bench.weft, "farm", "slurm", "toy {{ '.json", "--size", "8x6", *frames, *arguments, folder=bench.home)
        report.check(done.code == code and says in done.err and not bench.said(), f"{arguments}: {done.code}\n{done.err}")


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    with temporary_folder() as name:
        bench = Bench(weft, pathlib.Path(name), report)
        slurm(bench)
        openjd(bench)
        refused(bench)
    report.end()


main()
