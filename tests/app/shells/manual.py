#!/usr/bin/env python3
"""`weft man`: the page goes through groff and mandoc without a warning, names every command and option that --help names, and carries the
version and its date.

    manual.py WEFT
"""
import pathlib
import re
import shutil
import subprocess
import sys

from completion import INNER, commands_of, options_of
from program import TOP, Report, run


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    if missing := [tool for tool, found in (("groff", shutil.which("groff")), ("mandoc", shutil.which("mandoc"))) if not found]:
        report.skip(f"{' and '.join(missing)} is not installed")
    page = run(weft, "man").out
    for tool in (["groff", "-man", "-Tutf8", "-ww", "-z"], ["mandoc", "-T", "lint", "-W", "warning"]):
        done = subprocess.run(tool, input=page, capture_output=True, text=True)
        report.check(done.returncode == 0 and not done.stderr and not done.stdout, f"{tool}: {done.stderr}{done.stdout}")
    plain = page.replace("\\-", "-")
    for command in [*commands_of(weft), *INNER]:
        section = re.search(rf"^\.SS weft {command}\b(.*?)(?=^\.S[SH])", plain, re.M | re.S)
        if report.check(section, f"the page has no section for {command}"):
            named = set(re.findall(r"\\fB(--[a-z-]+)\\fR", section.group(1)))
            report.check(named == options_of(weft, command), f"{command}: {named ^ options_of(weft, command)}")
    report.check(".SS weft new pass name" in plain, "what stands behind new pass")
    # The version of --version, and the day on which the changelog says that it came out.
    version = run(weft, "--version").out.split()[1]
    day = re.search(rf"^## (\d{{4}}-\d\d-\d\d): {re.escape(version)}\b", (TOP / "CHANGELOG.md").read_text(), re.M)
    if report.check(day, f"CHANGELOG.md has no section of version {version}"):
        report.check(f'.TH WEFT 1 "{day[1]}" "weft {version}"' in plain, f"no {version} of {day[1]} in {plain.splitlines()[1]}")
    report.end()


if __name__ == "__main__":
    main()
