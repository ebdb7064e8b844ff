#!/usr/bin/env python3
"""`weft report`: one page with all data in it, the same bytes each time, below 1 MB for the studio; what it says of a step is what `weft plan` says.

    report.py WEFT
"""
import json
import pathlib
import re
import shlex
import sys
import tempfile

from program import TOP, Report, run


def data_of(page):
    return json.loads(re.search(r'<script type="application/json" id="report">(.*?)</script>', page.read_text(), re.S)[1])


def main():
    weft, report = sys.argv[1], Report()
    with tempfile.TemporaryDirectory() as folder:
        first, second, both = (pathlib.Path(folder, name) for name in ("first.html", "second.html", "both.html"))
        small = ("--size", "320x180")
        for page in (first, second):
            done = run(weft, "report", "graphs/studio.json", *small, "-o", page)
            report.check(done.code == 0, done.err)
        texts = [page.read_text().replace(page.name, "page.html") for page in (first, second)]
        report.check(texts[0] == texts[1], "two pages of one graph differ")
        report.check(first.stat().st_size < 1_000_000, f"the page of the studio has {first.stat().st_size} bytes")
        report.check(not re.search(r'(src|href)="(?!data:)|url\(|@import|https?://(?!www\.w3\.org)', texts[0]), "the page names something that is not in it")
        state = data_of(first)["states"][0]
        plan = json.loads(run(weft, "plan", "graphs/studio.json", *small, "--format", "json", "--explain").out)
        report.check(state["plan"] == plan, "the page has another plan than `weft plan`")
        report.check(len(state["outputs"]) == len(state["passes"]) == len(plan["steps"]), "a step lacks its part")
        for step, outputs in zip(plan["steps"], state["outputs"]):
            written = {use["resource"] for use in step["uses"] if use["access"] != "read" and use["kind"] not in ("storage", "uniform") and use["attached"]}
            named = {re.sub(r"\.(mip|layer)\[.*|\.stencil$", "", output["name"]) for output in outputs}
            report.check(written == named, f"{step['pass']} writes {written}, shown are {named}")
        done = run(weft, "report", "graphs/studio.json", "graphs/glow.json", *small, "-o", both)
        compared = data_of(both)
        lines = run(weft, "diff", "graphs/studio.json", "graphs/glow.json", *small).out.splitlines()
        report.check(done.code == 0 and compared["difference"] == lines and "FLIP" in compared["pictures"], f"the difference: {compared['difference'][:5]}, `weft diff` says {lines[:5]}")
        lines = compared["difference"], compared["pictures"]
        page = pathlib.Path(folder, "a folder", "it's.html")
        done = run(weft, "diff", "--render", "graphs/studio.json", "graphs/glow.json", *small, "-o", page)
        compared = data_of(page)
        report.check(done.code == 1 and (compared["difference"], compared["pictures"]) == lines, f"the page of `diff`: {done.code} {done.err}\n{compared['difference'][:5]}")
        report.check(shlex.split(compared["command"]) == ["weft", "diff", "--render", "graphs/studio.json", "graphs/glow.json", *small, "-o", str(page)], f"the command: {compared['command']}")
        done = run(weft, "report", "graphs/glow.json", "--other-set", "bloom=false", *small, "-o", both)
        lines = run(weft, "diff", "graphs/glow.json", "--other-set", "bloom=false", *small).out.splitlines()
        report.check(done.code == 0 and lines and data_of(both)["difference"] == lines, f"a graph in other settings: {done.err}\n{lines}")
        done = run(weft, "report", "tests/bad_graphs/w040_picture_file.json", *small, "-o", pathlib.Path(folder, "bad.html"))
        report.check(done.code == 1 and not pathlib.Path(folder, "bad.html").exists(), f"of a broken graph: {done.code}\n{done.err}")
        kept = pathlib.Path(folder, "graph.json")
        kept.write_bytes((TOP / "graphs/glow.json").read_bytes())
        done = run(weft, "report", kept, *small, "-o", kept)
        report.check(done.code == 1 and kept.read_bytes() == (TOP / "graphs/glow.json").read_bytes(), "a page was written over the graph")
    report.end()


if __name__ == "__main__":
    main()
