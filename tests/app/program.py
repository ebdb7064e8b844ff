"""Running the weft binary from tests: arguments in, exit code, output and diagnostics out. With --sanitized on the command line the
binary was built with AddressSanitizer and UBSan, and every report of theirs is a failure (tests/app/hostile/sanitize.sh)."""
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading

SANITIZED = "--sanitized" in sys.argv
# Times that guard against hanging are multiplied by this: also in the ctests that sanitize.sh runs, which get no argument.
SLOWER = 5 if SANITIZED or "ASAN_OPTIONS" in os.environ else 1
# What a command may take of memory. With the sanitizers, resident memory besides what the program asks for: bytes around each block (a
# small one takes up to three times its size), shadow of an eighth of everything, and 256 MB that were freed and are kept to find late uses.
MEMORY_BYTES = (2 if SANITIZED else 1) << 30
TOP = pathlib.Path(__file__).resolve().parents[2]
# Where graphs are: the bundled ones, and those of tests and tutorials.
GRAPH_FOLDERS = ("graphs", "tests/theory", "tests/runtime/graphs", "tests/imports/graphs", "tests/docs/embed", "tests/golden", "tests/app/lsp/workspace", "docs/tutorials")
REAL_HDR = TOP / "scenes/environments/spiaggia_di_mondello_1k.hdr"
DIAGNOSTIC = re.compile(r"^(?:(?P<place>.*?)(?::(?P<line>\d+)(?::(?P<column>\d+))?)?: )?(?P<severity>error|warning|note)\[(?P<code>W\d{3})\]: (?P<text>.*)$")


class Run:
    def __init__(self, process):
        self.code, self.out, self.err = process.returncode, process.stdout, process.stderr
        self.diagnostics = [m.groupdict() for m in map(DIAGNOSTIC.match, self.err.splitlines()) if m]

    def codes(self, severity="error"):
        return sorted({d["code"] for d in self.diagnostics if d["severity"] == severity})


class Sanitizers:
    """Their reports, which go to files (log_path), so that none hides behind an exit code that is expected or an output that nobody reads."""

    def __init__(self):
        found = re.search(r"(?:^|:)log_path=([^:]+)", os.environ.get("ASAN_OPTIONS", ""))
        assert found or not SANITIZED, "--sanitized needs ASAN_OPTIONS=log_path=…: see tests/app/hostile/sanitize.sh"
        self.path = pathlib.Path(found[1]) if found else None
        self.seen, self.runs = set(), 0
        self.new()

    def new(self):
        """The reports that were not there before, as texts."""
        files = sorted(set(self.path.parent.glob(self.path.name + ".*")) - self.seen) if SANITIZED else []
        self.seen.update(files)
        return [file.read_text(errors="replace") for file in files]

    def expect(self, pattern):
        """Removes the new reports that match: the run was to end in a known fault of a library."""
        for file in set(self.path.parent.glob(self.path.name + ".*")) - self.seen if SANITIZED else ():
            if re.search(pattern, file.read_text(errors="replace"), re.MULTILINE):
                file.unlink()


sanitizers = Sanitizers()


def count_run():
    """To be called by whoever starts the program in another way than run()."""
    sanitizers.runs += 1


def heed_signals():
    """For preexec_fn: SIGINT ends the program, also where this test runs in the background of a script, in which it is ignored."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class ForkServer:
    """Starts of one program, each a fork of one process (fork_server.c), which has loaded OSMesa when they draw. A command waits for the one
    before it: each thread has servers of its own."""
    LIBRARY = os.environ.get("WEFT_FORK_SERVER_LIBRARY")
    of_thread = threading.local()

    def __init__(self, weft, draws):
        self.client, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            environment = {"LD_PRELOAD": self.LIBRARY, "WEFT_FORK_SERVER": str(theirs.fileno()), "WEFT_FORK_SERVER_LOADS": "libOSMesa.so.8" if draws else ""}
            self.process = subprocess.Popen([weft], pass_fds=[theirs.fileno()], env={**os.environ, **environment})

    @classmethod
    def run(cls, command, folder, timeout):
        draws = bool(command[1:2]) and command[1] in ("check", "dump", "fuzz", "render", "report", "test") and "--no-shaders" not in command
        servers = vars(cls.of_thread)
        server = servers.get((command[0], draws))
        if not server or server.process.poll() is not None:
            server = servers[command[0], draws] = cls(command[0], draws)
        return server.answer(command, folder, timeout)

    def answer(self, command, folder, timeout):
        words = [len(command), folder, *command, *(f"{name}={value}" for name, value in os.environ.items())]
        with tempfile.TemporaryFile("w+", errors="replace") as out, tempfile.TemporaryFile("w+", errors="replace") as err:
            socket.send_fds(self.client, ["".join(f"{word}\0" for word in words).encode(errors="surrogateescape")], [0, out.fileno(), err.fileno()])
            self.client.settimeout(timeout)
            try:
                status = self.client.recv(4)
            except TimeoutError:
                self.process.kill()  # and with it what it runs
                raise subprocess.TimeoutExpired(command, timeout) from None
            assert status, f"the fork server ended: {command}"
            out.seek(0)
            err.seek(0)
            return subprocess.CompletedProcess(command, os.waitstatus_to_exitcode(int.from_bytes(status, sys.byteorder)), out.read(), err.read())


def run(weft, *arguments, before=(), folder=TOP, timeout=900 * SLOWER, **options):
    command = [*map(str, before), str(weft), *map(str, arguments)]
    if pathlib.Path(weft).name != "weft_compare":
        count_run()
    try:
        if ForkServer.LIBRARY and not before and not options and pathlib.Path(weft).name == "weft":
            return Run(ForkServer.run(command, folder, timeout))
        return Run(subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace", timeout=timeout, **options))
    except subprocess.TimeoutExpired:
        return Run(subprocess.CompletedProcess(command, None, "", f"no end after {timeout} s: {command}"))


class Report:
    """Collects what does not hold; end() prints it and exits."""

    def __init__(self):
        self.problems, self.checks, self.reports = [], 0, 0

    def check(self, holds, text):
        self.checks += 1
        if not holds:
            self.problems.append(text)
        self.look_for_reports(f"at or before the check: {text[:1000]}")
        return bool(holds)

    def look_for_reports(self, where):
        for found in sanitizers.new():
            self.reports += 1
            self.problems.append(f"a report of the sanitizers, {where}\n{found}")

    def skip(self, why):
        """Ends the test as skipped (exit code 77), which `./test` repeats in its last line. Only before the first check: ctest
        would call what ran and what did not run by one word, so what may be skipped is a test of its own."""
        assert not self.checks, f"skips after {self.checks} checks: {why}"
        self.look_for_reports("before this was skipped")
        if self.problems:
            self.end()
        print(f"skipped: {why}")
        sys.exit(77)

    def sum_up(self):
        self.look_for_reports("at the end")
        for text in self.problems:
            print(f"FAILED: {text}")
        print(f"{self.checks} checks, {len(self.problems)} failed")
        if SANITIZED:
            print(f"{sanitizers.runs} runs under sanitizers, {self.reports} reports", flush=True)

    def end(self):
        self.sum_up()
        sys.exit(1 if self.problems or not self.checks else 0)


def temporary_folder():
    return tempfile.TemporaryDirectory(prefix="weft_test_")
