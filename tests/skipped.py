#!/usr/bin/env python3
"""One line: which tests of a run were skipped or disabled, and why. A test that skips prints `skipped: WHY` and exits with 77.

    skipped.py RESULTS    RESULTS: what ctest --output-junit wrote; nothing is printed where it wrote nothing (ctest -N)
"""
import pathlib
import re
import sys
import xml.etree.ElementTree


def reason(case):
    if case.get("status") == "disabled":
        return "disabled in this build"
    output = case.findtext("system-out") or ""
    reasons = list(dict.fromkeys(re.findall(r"^skipped: (.+?)\s*$", output, re.M)))
    return "; ".join(reasons) or "it does not say why"


def main():
    text = pathlib.Path(sys.argv[1]).read_text(errors="replace")
    if not text.strip():
        return
    cases = list(xml.etree.ElementTree.fromstring(text).iter("testcase"))
    if not cases:
        return
    skipped = [f"{case.get('name')} ({reason(case)})" for case in cases if case.find("skipped") is not None or case.get("status") == "disabled"]
    print("skipped: " + (", ".join(skipped) or "nothing"))


main()
