#!/usr/bin/env python3
"""Holds README.md, CONTRIBUTING.md and docs/*.md against the program: every fenced snippet is executed or compared.

Usage: docs_test.py SOURCE_DIR BINARY_DIR [PAGE...]

A fence says its language, then, where needed, what it is: ```json fragment or ```glsl shaders/x/y.frag.glsl.
  sh            run with `bash -eu` in a copy of the tree. `./run X` is the built weft there, `view` under xvfb-run with
                --max-frames 3. Not run, and only these: `./run` alone, `./run --setup-only`, git, cmake, ctest and ninja,
                whose presets must be there; `./test ARGS` must select at least one test. `--frames 0:59` is shortened to 0:2.
  LANGUAGE PATH the block stands, line by line, in that file (leading spaces apart); a .cpp is the whole file
  json          with "passes": a graph, for `weft check`; with "cameras", "grid" or "spheres": a scene, checked with
                graphs/glow.json; else it must parse
  json fragment must parse inside { } or [ ]
  glsl          compiles as a fragment shader
  text          shown, not checked here
Links between pages, and files named in `inline code`, must be there. Commands on files of ../shared are left out
where that is absent. Without a weft in BINARY_DIR (WEFT_GL=OFF), sh and the checks of graphs and scenes are left out,
and the output says so.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

TOP, BINARY = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
CTEST = "ctest"  # comes with cmake
WEFT = BINARY / "app/weft"
FENCE = re.compile(r"^```([^\n`]*)\n(.*?)^```[ ]*$", re.M | re.S)
LANGUAGES = {"sh", "json", "glsl", "cpp", "cmake", "text"}
DATA = ("graphs", "shaders", "materials", "scenes", "docs", "tests")

RUN = """#!/usr/bin/env bash
case "${{1:-}}" in
  "" | --setup-only) echo "not run: ./run $*" ;;
  view) exec xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" {weft} "$@" --max-frames 3 ;;
  *) exec {weft} "$@" ;;
esac
"""
TEST = """#!/usr/bin/env bash
n=$({ctest} --test-dir {binary} -N "$@" | sed -n 's/^Total Tests: //p')
[ "${{n:-0}}" -gt 0 ] || {{ echo "./test $* selects no test" >&2; exit 1; }}
"""
SHIM = '#!/usr/bin/env bash\necho "not run: $(basename "$0") $*"\n'


def strip_comments(text):
    pattern = r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/'
    return re.sub(pattern, lambda m: m.group(0) if m.group(0)[0] == '"' else " ", text, flags=re.S)


def write_program(path, text):
    path.write_text(text)
    path.chmod(0o755)


class Sandbox:
    """A copy of the tree whose ./run and ./test use what is already built."""

    def __init__(self, folder):
        self.root = folder / "weft"
        self.root.mkdir()
        for name in DATA:
            shutil.copytree(TOP / name, self.root / name)
        write_program(self.root / "run", RUN.format(weft=WEFT))
        write_program(self.root / "test", TEST.format(ctest=shutil.which(CTEST), binary=BINARY))
        tools = folder / "tools"
        tools.mkdir()
        for name in ("git", "cmake", "ctest", "ninja"):
            write_program(tools / name, SHIM)
        if (TOP / "../shared").is_dir():
            (folder / "shared").symlink_to((TOP / "../shared").resolve())
        self.env = {**os.environ, "WEFT_DATA": str(self.root), "PATH": f"{tools}:{os.environ['PATH']}"}
        self.env.pop("DISPLAY", None)

    def shell(self, script):
        result = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=self.root, env=self.env, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600)
        return None if result.returncode == 0 else f"exit {result.returncode}\n{result.stdout[-3000:]}"

    def weft(self, *args):
        result = subprocess.run([WEFT, *args], cwd=self.root, env=self.env, capture_output=True, text=True, timeout=300)
        return None if result.returncode == 0 else f"weft {' '.join(map(str, args))}: exit {result.returncode}\n{result.stderr}"


def check_excerpt(body, path):
    if not path.is_file():
        return f"no file {path.relative_to(TOP)}"
    whole = path.read_text()
    if path.suffix == ".cpp":
        return None if body == whole else f"is not the text of {path.relative_to(TOP)}"
    squeeze = lambda text: "\n".join(line.strip() for line in text.strip().splitlines())
    return None if squeeze(body) in squeeze(whole) else f"does not stand in {path.relative_to(TOP)}"


def check_json(body, info, sandbox, number):
    text = strip_comments(body)
    if info == "fragment":
        for form in ("{%s}", "[%s]"):
            try:
                json.loads(form % text.strip().rstrip(","))
                return None
            except ValueError as error:
                problem = error
        return f"parses neither inside {{ }} nor inside [ ]: {problem}"
    try:
        value = json.loads(text)
    except ValueError as error:
        return str(error)
    if not sandbox or not isinstance(value, dict):
        return None
    if "passes" in value:
        path = sandbox.root / f"graphs/snippet_{number}.json"
        path.write_text(body)
        shaders = [p["shader"] for p in value["passes"] if "shader" in p]
        present = all(list((sandbox.root / "shaders").glob(s if p.get("type") != "draw" else s + ".*"))
                      for p in value["passes"] if (s := p.get("shader")))
        return sandbox.weft("check", path, *([] if present and shaders else ["--no-shaders"]))
    if {"cameras", "grid", "spheres"} & set(value):
        path = sandbox.root / f"scenes/snippet_{number}.json"
        path.write_text(body)
        return sandbox.weft("check", "--no-shaders", "graphs/glow.json", "--scene", path)
    return None


def check_glsl(body, folder):
    if not shutil.which("glslangValidator"):
        return "skip: glslangValidator is not installed"
    path = folder / "snippet.frag"
    path.write_text("#version 450 core\n" + body + ("" if "void main()" in body else "void main() {}\n"))
    result = subprocess.run(["glslangValidator", str(path)], capture_output=True, text=True)
    return None if result.returncode == 0 else result.stdout


def check_block(language, info, body, sandbox, folder, number):
    if language not in LANGUAGES:
        return f"a fence must say one of {sorted(LANGUAGES)}, found '{language}'"
    if "/" in info:
        return check_excerpt(body, TOP / info)
    if language == "json":
        return check_json(body, info, sandbox, number)
    if language == "glsl":
        return check_glsl(body, folder)
    if language in ("cpp", "cmake"):
        return "name the file this stands in: ```cpp tests/docs/…"
    if language == "sh":
        presets = re.findall(r"^\s*(?:cmake|ctest)\b.*--preset[ =](\S+)", body, flags=re.M)
        known = {p["name"] for p in json.loads((TOP / "CMakePresets.json").read_text())["configurePresets"] if not p.get("hidden")}
        if unknown := set(presets) - known:
            return f"no preset {sorted(unknown)} in CMakePresets.json"
        if not sandbox:
            return "skip: no weft is built here"
        if "xvfb-run" not in body and re.search(r"\./run view", body) and not shutil.which("xvfb-run"):
            return "skip: xvfb-run is not installed"
        if "../shared/" in body and not (TOP / "../shared").is_dir():
            rest = "\n".join(line for line in body.splitlines() if "../shared/" not in line)
            return sandbox.shell(rest) or "skip: no ../shared, so not the commands that take files from it"
        return sandbox.shell(body.replace("--frames 0:59", "--frames 0:2"))
    return None


def check_references(page, text):
    """Links and file names."""
    problems = []
    prose = FENCE.sub("", text)
    for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", prose):
        if not (page.parent / target).exists():
            problems.append(f"link to {target}, which is not there")
    for code in re.findall(r"`([^`\n]+)`", prose):
        if re.fullmatch(r"(?:engine|app|tests|graphs|docs|shaders|scenes|materials|cmake)/[\w./-]+", code):
            if not (TOP / code).exists():
                problems.append(f"names {code}, which is not there")
    return problems


def check_overview():
    """docs/overview.md has every folder that holds code."""
    path = TOP / "docs/overview.md"
    text = path.read_text() if path.is_file() else ""
    folders = [p for top in ("engine", "shaders") for p in (TOP / top).iterdir() if p.is_dir()]
    names = [str(p.relative_to(TOP)) for p in folders if any(p.iterdir()) and p.name != "__pycache__"]
    return [f"does not name {name}" for name in sorted(names) if name not in text]


def compare_problems(problems, expected):
    """For a page that lists, in a comment, the problems it has."""
    missed = [e for e in expected if not any(e in p for p in problems)]
    wrong = [p for p in problems if not any(e in p for e in expected)]
    print("\n".join([f"not found: {e}" for e in missed] + [f"not expected: {p}" for p in wrong]) or f"docs: {len(problems)} problems, as expected")
    return 1 if missed or wrong else 0


def main():
    pages = [TOP / p for p in sys.argv[3:]] or [TOP / "README.md", TOP / "CONTRIBUTING.md", *sorted((TOP / "docs").glob("*.md"))]
    problems, skipped, counts = [], [], {}
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        if not WEFT.exists():
            skipped.append("sh, graphs and scenes everywhere: no weft is built here")
        for page in pages:
            name = page.relative_to(TOP)
            text = page.read_text()
            if text.count("\n```") + text.startswith("```") != 2 * len(FENCE.findall(text)):
                problems.append(f"{name}: a fence is not closed")
            problems += [f"{name}: {p}" for p in check_references(page, text)]
            here = folder / page.stem
            here.mkdir()
            sandbox = Sandbox(here) if WEFT.exists() else None
            for number, match in enumerate(FENCE.finditer(text)):
                language, _, info = match.group(1).strip().partition(" ")
                line = text.count("\n", 0, match.start()) + 1
                counts[language] = counts.get(language, 0) + 1
                problem = check_block(language, info.strip(), match.group(2), sandbox, here, number)
                if problem and problem.startswith("skip: "):
                    skipped.append(f"{name}:{line}: {problem[6:]}")
                elif problem:
                    problems.append(f"{name}:{line}: {problem}")
    if TOP / "docs/overview.md" in pages:
        problems += [f"docs/overview.md: {p}" for p in check_overview()]
    for line in skipped:
        print(f"skipped {line}")
    if expected := re.search(r"<!-- problems:\n(.*?)-->", "".join(p.read_text() for p in pages), re.S):
        return compare_problems(problems, expected.group(1).split("\n")[:-1])
    print("\n".join(problems) or f"docs: {len(pages)} pages, " + ", ".join(f"{n} {l}" for l, n in sorted(counts.items())))
    return 1 if problems or not counts else 0


sys.exit(main())
