"""Running the weft binary from tests: arguments in, exit code, output and diagnostics out."""
import pathlib
import re
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
REAL_HDR = TOP / "scenes/environments/spiaggia_di_mondello_1k.hdr"
DIAGNOSTIC = re.compile(r"^(?:(?P<place>.*?)(?::(?P<line>\d+)(?::(?P<column>\d+))?)?: )?(?P<severity>error|warning|note)\[(?P<code>W\d{3})\]: (?P<text>.*)$")


class Run:
    def __init__(self, process):
        self.code, self.out, self.err = process.returncode, process.stdout, process.stderr
        self.diagnostics = [m.groupdict() for m in map(DIAGNOSTIC.match, self.err.splitlines()) if m]

    def codes(self, severity="error"):
        return sorted({d["code"] for d in self.diagnostics if d["severity"] == severity})


def run(weft, *arguments, before=(), folder=TOP, timeout=300, **options):
    command = [*map(str, before), str(weft), *map(str, arguments)]
    return Run(subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="replace", timeout=timeout, **options))


class Report:
    """Collects what does not hold; end() prints it and exits."""

    def __init__(self):
        self.problems, self.checks = [], 0

    def check(self, holds, text):
        self.checks += 1
        if not holds:
            self.problems.append(text)
        return bool(holds)

    def skip(self, why):
        """Ends the test as skipped (exit code 77), which `./test` repeats in its last line. Only before the first check: ctest
        would call what ran and what did not run by one word, so what may be skipped is a test of its own."""
        assert not self.checks, f"skips after {self.checks} checks: {why}"
        print(f"skipped: {why}")
        sys.exit(77)

    def end(self):
        for text in self.problems:
            print(f"FAILED: {text}")
        print(f"{self.checks} checks, {len(self.problems)} failed")
        sys.exit(1 if self.problems or not self.checks else 0)


def temporary_folder():
    return tempfile.TemporaryDirectory(prefix="weft_test_")
