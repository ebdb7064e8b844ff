#!/usr/bin/env python3
"""Holds README.md, CONTRIBUTING.md, docs/*.md, docs/tutorials/*.md and docs/gallery/*.md against the program: every fenced snippet is executed or compared.
PAGE may be a folder. Of pages of graphs/cookbook the commands run small and for 10 frames at most, on a copy of their folder that lies elsewhere.

Usage: docs_test.py SOURCE_DIR BINARY_DIR [--part PART...] [--clone] [PAGE...]

A fence says its language, then, where needed, what it is: ```json fragment or ```glsl shaders/x/y.frag.glsl.
  sh            part run: run with `bash -eu` in a copy of the tree. `./run X` is the built weft there, `view` under xvfb-run with
                --max-frames 3. Not run, and only these: `./run` alone, `./run --setup-only` and `--install-only`, git, cmake, ctest and ninja,
                whose presets must be there; `./test ARGS` must select at least one test. Pictures are made smaller, and `--frames 0:59`
                is shortened to 0:2.
                Part view instead where a line is `./run view`.
  LANGUAGE PATH the block stands, line by line, in that file (leading spaces apart); a .cpp is the whole file
  json          must parse. Part run: with "passes" it is a graph, for `weft check`; with "cameras", "grid" or "spheres" a scene,
                checked with graphs/glow.json
  json fragment must parse inside { } or [ ]
  glsl          part glsl: compiles as a fragment shader
  text          shown, not checked here
Part pages is all that needs no programs; links between pages, and files named in `inline code`, must be there. Without
--part: all parts. A part that lacks what it needs is skipped as a whole (exit code 77), so each that may be is a
ctest of its own. With --clone the checks are made in a clone of HEAD with nothing beside it, over which changes of tracked files are laid
that are not committed yet; the weft of BINARY_DIR runs there on the data of the clone.
"""
import argparse
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

PARTS = ("pages", "glsl", "run", "view")
parser = argparse.ArgumentParser()
parser.add_argument("source", type=pathlib.Path)
parser.add_argument("binary", type=pathlib.Path)
parser.add_argument("pages", nargs="*")
parser.add_argument("--part", action="append", choices=PARTS)
parser.add_argument("--clone", action="store_true")
OPTIONS = parser.parse_args()
TOP, BINARY = OPTIONS.source.resolve(), OPTIONS.binary.absolute()
WANTED = OPTIONS.part or list(PARTS)
CTEST = "ctest"  # comes with cmake
WEFT = BINARY / "app/weft"
# The maps that reflections are made with, in the copy of the tree: nobody looks at pictures of snippets.
SMALL_MAPS = (("ibl.json", '"size": 512', '"size": 32'), ("ibl.json", '"size": [1024, 512]', '"size": [128, 64]'))
FENCE = re.compile(r"^```([^\n`]*)\n(.*?)^```[ ]*$", re.M | re.S)
LANGUAGES = {"sh", "json", "glsl", "cpp", "cmake", "text"}
DATA = ("graphs", "shaders", "materials", "scenes", "docs", "tests/docs", "tests/golden", "tests/imports", "tests/convert", "tests/app/trials",
        "app/commands", "app/report")

RUN = """#!/usr/bin/env bash
case "${{1:-}}" in
  "" | --setup-only | --install-only) echo "not run: ./run $*" ;;
  view) exec xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" {weft} "$@" --max-frames 3 ;;
  bench) exec {bench} "$@" ;;
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


def place(path, copy):
    """A copy of a file; of a picture or a model, which no command writes over, a link."""
    if os.path.getsize(path) >= 100_000:
        try:
            os.link(path, copy)
            return copy
        except OSError:  # on another file system
            pass
    return shutil.copy(path, copy)


class Sandbox:
    """A copy of the tree whose ./run and ./test use what is already built. One serves all pages: restore() after each."""

    def __init__(self, folder):
        self.root = folder / "weft"
        self.root.mkdir()
        for name in DATA:
            shutil.copytree(TOP / name, self.root / name, ignore=shutil.ignore_patterns("__pycache__"), copy_function=place)
        for name, size, small in SMALL_MAPS:
            path = self.root / "graphs" / name
            assert size in (text := path.read_text()), f"{path} has no {size}"
            path.write_text(text.replace(size, small))
        write_program(self.root / "run", RUN.format(weft=shlex.quote(str(WEFT)), bench=shlex.quote(str(BINARY / "tests/bench/weft_bench"))))
        write_program(self.root / "test", TEST.format(ctest=shlex.quote(shutil.which(CTEST)), binary=shlex.quote(str(BINARY))))
        tools = folder / "tools"
        tools.mkdir()
        for name in ("git", "cmake", "ctest", "ninja"):
            write_program(tools / name, SHIM)
        self.env = {**os.environ, "WEFT_DATA": str(self.root), "PATH": f"{tools}:{os.environ['PATH']}"}
        self.env.pop("DISPLAY", None)
        self.made = self.entries()

    def entries(self):
        """What is below the root, but for the two programs: of a file its time and size, of a folder None."""
        found = {}
        for folder, folders, files in os.walk(self.root):
            found |= {os.path.join(folder, name): None for name in folders}
            for path in (os.path.join(folder, name) for name in files if folder != str(self.root)):
                there = os.lstat(path)
                found[path] = there.st_mtime_ns, there.st_size
        return found

    def restore(self):
        """Removes what a page has made, and copies again what it has changed or moved."""
        there = self.entries()
        for path in (path for path, state in there.items() if self.made.get(path, ()) != state):
            shutil.rmtree(path, ignore_errors=True) if there[path] is None else pathlib.Path(path).unlink(missing_ok=True)
        for path in sorted(path for path, state in self.made.items() if there.get(path, ()) != state):
            if self.made[path] is None:
                os.mkdir(path)
            else:
                place(TOP / os.path.relpath(path, self.root), path)
                self.made[path] = os.lstat(path).st_mtime_ns, os.lstat(path).st_size

    def shell(self, script):
        # "! COMMAND" in a page says that it ends with 1; any other code, of a crash too, is a mistake.
        script = re.sub(r"^! (.*)$", r"{ \1 && exit 1; } || [ $? = 1 ]", script, flags=re.M)
        result = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=self.root, env=self.env, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600)
        return None if result.returncode == 0 else f"exit {result.returncode}\n{result.stdout[-3000:]}"

    def copied(self, script, entry):
        """The commands of a page of the cookbook: on a copy of its folder, with nothing of it left where it was, and small."""
        copy = f"graphs/own/{entry}"
        if not (self.root / copy).exists():
            (self.root / "graphs/own").mkdir(exist_ok=True)
            (self.root / "graphs/cookbook" / entry).rename(self.root / copy)
        script = re.sub(r" --size \d+x\d+", "", script).replace(f"graphs/cookbook/{entry}/", f"{copy}/")
        return re.sub(r"^(\./run render .*)$", r"mkdir -p out; \1 --size 64x36", script.replace("--frames 60", "--frames 10"), flags=re.M)

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
    if not sandbox or "run" not in WANTED or not isinstance(value, dict):
        return None
    if "passes" in value:
        path = sandbox.root / f"graphs/snippet_{number}.json"
        path.write_text(body)
        shaders = [p["shader"] for p in value["passes"] if "shader" in p]
        present = all(list((sandbox.root / "shaders").glob(s if s.endswith(".glsl") else s + ".*"))
                      for p in value["passes"] if (s := p.get("shader")))
        return sandbox.weft("check", path, *([] if present and shaders else ["--no-shaders"]))
    if {"cameras", "grid", "spheres"} & set(value):
        path = sandbox.root / f"scenes/snippet_{number}.json"
        path.write_text(body)
        return sandbox.weft("check", "--no-shaders", "graphs/glow.json", "--scene", path)
    return None


def check_glsl(body, folder):
    path = folder / "snippet.frag"
    path.write_text("#version 450 core\n" + body + ("" if "void main()" in body else "void main() {}\n"))
    result = subprocess.run(["glslangValidator", str(path)], capture_output=True, text=True)
    return None if result.returncode == 0 else result.stdout


def parts_of(language, info, body):
    """The parts of the test that look at a block."""
    if "/" in info or language not in ("sh", "glsl", "json"):
        return {"pages"}
    if language == "json":
        return {"pages", "run"}
    if language == "glsl":
        return {"glsl"}
    return {"view" if re.search(r"^\./run view", body, re.M) else "run"}


def make_small(script):
    """The commands with fewer frames, a quarter of the width and height of what is wider than 160 pixels, and smaller shadow maps."""
    script = script.replace("--frames 0:59", "--frames 0:2").replace("shadow_texels=8192", "shadow_texels=1024")
    return re.sub(r"(--size )(\d+)x(\d+)", lambda m: f"{m[1]}{int(m[2]) // 4}x{int(m[3]) // 4}" if int(m[2]) > 160 else m[0], script)


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
        return sandbox.shell(make_small(body))
    return None


def check_references(page, text):
    """Links and file names, and that every fence is closed."""
    problems = []
    if text.count("\n```") + text.startswith("```") != 2 * len(FENCE.findall(text)):
        problems.append("a fence is not closed")
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


def check_effects():
    """docs/effects.md names every effect that comes as an include."""
    text = (TOP / "docs/effects.md").read_text()
    return [f"does not name graphs/effects/{path.name}" for path in sorted((TOP / "graphs/effects").glob("*.json")) if f"effects/{path.name}" not in text]


def compare_problems(problems, expected):
    """For a page that lists, in a comment, the problems it has."""
    missed = [e for e in expected if not any(e in p for p in problems)]
    wrong = [p for p in problems if not any(e in p for e in expected)]
    print("\n".join([f"not found: {e}" for e in missed] + [f"not expected: {p}" for p in wrong]) or f"docs: {len(problems)} problems, as expected")
    return 1 if missed or wrong else 0


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def skip_what_cannot_run():
    if {"run", "view"} & set(WANTED) and not WEFT.exists():
        skip("no weft is built here: configured with WEFT_GL=OFF")
    if "glsl" in WANTED and not shutil.which("glslangValidator"):
        skip("glslangValidator is not installed")
    if "view" in WANTED and not shutil.which("xvfb-run"):
        skip("xvfb-run is not installed")


def try_git(*words):
    bare = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}  # of a hook that runs this
    return subprocess.run(["git", "-C", TOP, *words], capture_output=True, text=True, env=bare)


def git(*words):
    done = try_git(*words)
    if done.returncode:
        sys.exit(f"git {' '.join(map(str, words))}: exit {done.returncode}\n{done.stderr}")
    return done.stdout


def clone_into(folder):
    """HEAD of the checkout, then what is changed in its tracked files."""
    git("clone", "--quiet", TOP, folder)
    head = git("rev-parse", "HEAD").strip()
    git("-C", folder, "checkout", "--quiet", "--detach", head)
    changed = [name for name in git("diff", "--name-only", "-z", "HEAD").split("\0") if name]
    for name in changed:
        (folder / name).unlink(missing_ok=True)
        if (TOP / name).exists():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(TOP / name, folder / name)
    print(f"docs: a clone of {head[:12]}" + (f" with {len(changed)} files as they are changed here" if changed else ""))


def run_in_clone():
    if not shutil.which("git"):
        skip("git is not installed, so there is no clone")
    if not (TOP / ".git").exists():
        skip("the source tree is no git checkout, so there is no clone")
    if (found := try_git("rev-parse", "HEAD")).returncode:  # of another owner, or nothing is committed yet
        skip(f"git does not read this checkout: {found.stderr.strip().splitlines()[0]}")
    with tempfile.TemporaryDirectory(prefix="weft_test_") as temporary:
        clone = pathlib.Path(temporary) / "weft"
        clone_into(clone)
        parts = [word for part in WANTED for word in ("--part", part)]
        return subprocess.run([sys.executable, clone / "tests/docs/docs_test.py", clone, BINARY, *parts, *OPTIONS.pages]).returncode


def main():
    skip_what_cannot_run()
    if OPTIONS.clone:
        return run_in_clone()
    pages = [page for p in OPTIONS.pages for page in (sorted((TOP / p).rglob("*.md")) if (TOP / p).is_dir() else [TOP / p])] or [TOP / "README.md", TOP / "CONTRIBUTING.md", *(page for folder in ("docs", "docs/tutorials", "docs/gallery") for page in sorted((TOP / folder).glob("*.md")))]
    problems, counts, sandbox = [], {}, None
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for page in pages:
            name = page.relative_to(TOP)
            text = page.read_text()
            if "pages" in WANTED:
                problems += [f"{name}: {p}" for p in check_references(page, text)]
            here = folder / str(pages.index(page))
            here.mkdir()
            runs = {"run", "view"} & set(WANTED) & {part for match in FENCE.finditer(text) for part in parts_of(*(word.strip() for word in match.group(1).strip().partition(" ")[::2]), match.group(2))}
            if runs:
                sandbox.restore() if sandbox else (sandbox := Sandbox(folder))
            for number, match in enumerate(FENCE.finditer(text)):
                language, _, info = match.group(1).strip().partition(" ")
                if not parts_of(language, info.strip(), match.group(2)) & set(WANTED):
                    continue
                line = text.count("\n", 0, match.start()) + 1
                counts[language] = counts.get(language, 0) + 1
                body = sandbox.copied(match.group(2), page.parent.name) if sandbox and page.is_relative_to(TOP / "graphs/cookbook") else match.group(2)
                problem = check_block(language, info.strip(), body, sandbox, here, number)
                if problem:
                    problems.append(f"{name}:{line}: {problem}")
    if TOP / "docs/overview.md" in pages and "pages" in WANTED:
        problems += [f"docs/overview.md: {p}" for p in check_overview()] + [f"docs/effects.md: {p}" for p in check_effects()]
    if expected := re.search(r"<!-- problems:\n(.*?)-->", "".join(p.read_text() for p in pages), re.S):
        return compare_problems(problems, expected.group(1).split("\n")[:-1])
    print("\n".join(problems) or f"docs: {len(pages)} pages, " + ", ".join(f"{n} {l}" for l, n in sorted(counts.items())))
    return 1 if problems or not counts else 0


sys.exit(main())
