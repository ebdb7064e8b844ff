#!/usr/bin/env python3
"""`./run` around a build that is pretended: silent when it is quick, how far it is on a terminal when it is not, the end of
the log when it fails; then the program with its arguments. And in a folder with spaces and quotes: what CMake is told has neither, and is
that folder. Needs no build of Weft.

    run_script.py WEFT
"""
import os
import pathlib
import pty
import shutil
import subprocess

from program import TOP, Report, temporary_folder

CMAKE = """#!/usr/bin/env bash
[ -z "${PRETEND_LOG:-}" ] || printf '%s\n' "$@" >>"$PRETEND_LOG"
for i in 1 2 3 4; do echo "[$i/4] Building thing $i"; if [ "$i" = 2 ] && [ -n "${PRETEND_DOOR:-}" ]; then read -r _ <"$PRETEND_DOOR"; fi; done
[ -z "${PRETEND_FAILURE:-}" ] || { echo "thing.cpp:1: error: pretended"; exit 1; }
"""
WEFT = '#!/usr/bin/env bash\necho "weft got $*"\n'
ODD = """it's a "test" folder"""
QUERY = "#!/usr/bin/env bash\necho installed\n"


def program(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(0o755)


def on_terminal(command, door, until, **options):
    """What a terminal gets of standard error, and standard output apart. The build waits at its door until `until` was shown."""
    ours, theirs = pty.openpty()
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=theirs, **options) as process:
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
        out = process.stdout.read()
    os.close(ours)
    return process.returncode, out.decode(), seen.decode()


def leads_into(path, folder):
    """False also for what others remove meanwhile."""
    try:
        return os.readlink(path).startswith(folder)
    except OSError:
        return False


def links_to(folder):
    return [path for path in pathlib.Path("/tmp").glob("weft_*") if leads_into(path, str(folder))]


def odd_folder(report, folder, environment):
    """Without WEFT_BUILD, so that the build is inside."""
    top = folder / ODD
    for name in ("run", "cmake/plain_path.sh"):
        (top / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(TOP / name, top / name)
    program(top / "build/release/app/weft", WEFT)
    log = folder / "told"
    environment = {key: value for key, value in environment.items() if key != "WEFT_BUILD"} | {"PRETEND_LOG": str(log)}
    try:
        for time in ("first", "second"):
            done = subprocess.run([str(top / "run"), "check", 'a "b".json'], capture_output=True, text=True, env=environment, cwd=folder)
            report.check((done.returncode, done.stdout, done.stderr) == (0, 'weft got check a "b".json\n', ""), f"odd folder, {time} time: {done}")
        told = log.read_text().splitlines()
        paths = [word for word in told if word.startswith("/")]
        report.check(told[:2] == ["-S", paths[0]] and told.count("--build") == 2, f"odd folder: cmake was told {told}")
        report.check(not any(set(path) & set(" '\"") for path in paths), f"odd folder: {paths}")
        report.check([os.path.realpath(path) for path in paths[:2]] == [str(top), str(top / "build/release")], f"odd folder: {paths}")
        link = pathlib.Path(paths[0])
        link.unlink()
        link.symlink_to(folder)
        stolen = subprocess.run([str(top / "run"), "check"], capture_output=True, text=True, env=environment, cwd=folder)
        report.check(stolen.returncode == 1 and f"{link} is to be your link to {top}" in stolen.stderr, f"a link of that name to elsewhere: {stolen}")
    finally:
        for path in links_to(folder):
            path.unlink()


def main():
    report = Report()
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        (folder / "cmake").mkdir()
        for part in ("run", "cmake/plain_path.sh"):
            shutil.copy(TOP / part, folder / part)
        program(folder / "bin/cmake", CMAKE)
        program(folder / "bin/dpkg-query", QUERY)
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
        odd_folder(report, folder, environment)
    report.end()


main()
