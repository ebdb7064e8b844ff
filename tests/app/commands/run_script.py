#!/usr/bin/env python3
"""`./run` around a build that is pretended: silent when it is quick, how far it is on a terminal when it is not, the end of
the log when it fails; then the program with its arguments. It asks before it installs on a terminal and nowhere else, and takes what the
tests need only for them. All in a folder with a space. Needs no build of Weft.

    run_script.py WEFT
"""
import os
import pathlib
import pty
import subprocess

from program import TOP, Report, temporary_folder

CMAKE = """#!/usr/bin/env bash
[ -z "${PRETEND_LOG:-}" ] || printf '%s\n' "$@" >>"$PRETEND_LOG"
for i in 1 2 3 4; do echo "[$i/4] Building thing $i"; if [ "$i" = 2 ] && [ -n "${PRETEND_DOOR:-}" ]; then read -r _ <"$PRETEND_DOOR"; fi; done
[ -z "${PRETEND_FAILURE:-}" ] || { echo "thing.cpp:1: error: pretended"; exit 1; }
"""
WEFT = '#!/usr/bin/env bash\necho "weft got $*"\n'
QUERY = """#!/usr/bin/env bash
for package in "${@:3}"; do
  [[ " ${PRETEND_MISSING:-} " = *" $package "* ]] || echo "$package installed"
done
"""
INSTALL = """#!/usr/bin/env bash
[ "$1" = install ] && printf '%s\n' "${@:2}" >>"$PRETEND_INSTALLED"
exit 0
"""


def program(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)


def on_terminal(command, door, until, answer=None, **options):
    """What a terminal gets of standard error, and standard output apart. The build waits at its door until `until` was shown; a question is
    answered when it was."""
    ours, theirs = pty.openpty()
    with subprocess.Popen(command, stdin=theirs, stdout=subprocess.PIPE, stderr=theirs, **options) as process:
        os.close(theirs)
        seen = b""
        while True:
            try:
                part = os.read(ours, 4096)
            except OSError:  # nobody writes any more
                break
            if not part:
                break
            seen += part
            if door and until in seen:
                door = door.write_text("go on\n") and None
            if answer and until in seen:
                os.write(ours, answer)
                answer = None
        out = process.stdout.read()
    os.close(ours)
    return process.returncode, out.decode(), seen.decode()


def installing(report, folder, command, environment):
    """Who is asked, and what is installed."""
    log = folder / "installed"
    missing = dict(environment, PRETEND_MISSING="g++ doctest-dev", PRETEND_INSTALLED=str(log))
    missing.pop("CI", None)

    def installed():
        words = log.read_text().split() if log.exists() else []
        log.unlink(missing_ok=True)
        return [word for word in words if not word.startswith("-")]

    question = b"[y/N]"
    code, out, seen = on_terminal(command, None, question, answer=b"n\n", env=missing, cwd=folder)
    report.check((code, out, installed()) == (1, "", []) and "nothing was installed" in seen and "g++" in seen and "doctest" not in seen, f"no: {code} {seen!r}")
    code, out, seen = on_terminal(command, None, question, answer=b"y\n", env=missing, cwd=folder)
    report.check((code, installed()) == (0, ["g++"]) and out.startswith("weft got"), f"yes: {code} {seen!r}")
    for what, words, more in (("--yes", ["--yes"], {}), ("CI", [], {"CI": "true"})):
        code, out, seen = on_terminal([*command[:2], *words, *command[2:]], None, b"", env=missing | more, cwd=folder)
        report.check((code, installed()) == (0, ["g++"]) and question.decode() not in seen, f"{what}: {code} {seen!r}")
    done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, env=missing, cwd=folder)
    report.check((done.returncode, installed()) == (0, ["g++"]), f"without a terminal: {done}")
    done = subprocess.run([*command[:2], "--tests", "--install-only"], capture_output=True, text=True, stdin=subprocess.DEVNULL, env=missing, cwd=folder)
    report.check((done.returncode, done.stdout, installed()) == (0, "", ["g++", "doctest-dev"]), f"--tests: {done}")


def configuring(report, folder, command, environment):
    """What CMake is told in a new folder and in one that is there."""
    log = folder / "told"
    told = {}
    for what, words, there in (("new", ["--setup-only"], False), ("new, with tests", ["--tests", "--setup-only"], False), ("there", ["--setup-only"], True),
                               ("there, with tests", ["--tests", "--setup-only"], True)):
        (folder / "build/build.ninja").unlink(missing_ok=True)
        if there:
            (folder / "build/build.ninja").write_text("")
        done = subprocess.run([*command[:2], *words], capture_output=True, text=True, stdin=subprocess.DEVNULL, env=dict(environment, PRETEND_LOG=str(log)), cwd=folder)
        report.check((done.returncode, done.stdout) == (0, ""), f"{what}: {done}")
        told[what] = log.read_text().splitlines()
        log.unlink()
    place = ["-S", str(folder), "-B", str(folder / "build")]
    for what, options, absent, target in (
            ("new", ["-DWEFT_TESTS=OFF"], ["-DWEFT_TESTS=ON", "-DWEFT_WERROR=ON"], "weft"), ("new, with tests", ["-DWEFT_TESTS=ON", "-DWEFT_WERROR=ON"], [], "all"),
            ("there", [], ["-S"], "weft"), ("there, with tests", ["-DWEFT_TESTS=ON"], ["-DWEFT_WERROR=ON"], "all")):
        words = told[what]
        report.check(("-S" not in words or words[:4] == place) and set(options) <= set(words) and not set(absent) & set(words) and words[-1] == target, f"{what}: CMake was told {words}")


def main():
    report = Report()
    with temporary_folder() as name:
        folder = pathlib.Path(name) / "a folder"
        folder.mkdir()
        text = (TOP / "run").read_text()
        report.check("every=10 first=10" in text, "a line every ten seconds")
        (folder / "run").write_text(text.replace("every=10 first=10", "every=1 first=1"))  # which takes a second here
        program(folder / "bin/cmake", CMAKE)
        program(folder / "bin/dpkg-query", QUERY)
        program(folder / "bin/apt-get", INSTALL)
        program(folder / "bin/sudo", '#!/usr/bin/env bash\nexec "$@"\n')
        program(folder / "build/app/weft", WEFT)
        (folder / "build/build.ninja").write_text("")
        environment = dict(os.environ, PATH=f"{folder / 'bin'}:{os.environ['PATH']}", WEFT_BUILD=str(folder / "build"))
        command = ["bash", str(folder / "run"), "check", "a b.json"]

        quick = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=folder)
        report.check((quick.returncode, quick.stdout, quick.stderr) == (0, "weft got check a b.json\n", ""), f"quick: {quick}")
        os.mkfifo(folder / "door")
        slow = dict(environment, PRETEND_DOOR=str(folder / "door"))
        code, out, seen = on_terminal(command, folder / "door", b"2 of 4 (50 %)", env=slow, cwd=folder)
        report.check(code == 0 and out == "weft got check a b.json\n", f"slow: {code} {out}")
        report.check("run: building, 2 of 4 (50 %)" in seen and "\n" not in seen, f"on a terminal: {seen!r}")
        report.check(seen.endswith("\r\033[K"), f"the line is not taken away: {seen!r}")
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=slow, cwd=folder) as plain:
            line = plain.stderr.readline()
            (folder / "door").write_text("go on\n")
            rest = plain.stderr.read()
        lines = (line + rest).decode().splitlines()
        report.check(plain.returncode == 0 and lines and set(lines) == {"run: building, 2 of 4 (50 %)"}, f"without a terminal, a line now and then: {lines}")
        bad = subprocess.run(command, capture_output=True, text=True, cwd=folder,
                             env=dict(environment, PRETEND_FAILURE="1"))
        report.check(bad.returncode == 1 and "error: pretended" in bad.stderr and "the build failed" in bad.stderr and not bad.stdout,
                     f"a build that fails: {bad}")
        installing(report, folder, command, environment)
        configuring(report, folder, command, environment)
    report.end()


main()
