#!/usr/bin/env python3
"""The page of `weft report` in a browser that nobody here wrote: Chromium, driven by playwright-core, does what page.cjs says, and what a reader sees then
is what `weft plan`, `diff` and `render` say. axe-core judges accessibility. CONTRIBUTING.md says where these come from.

    page.py WEFT
"""
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from pictures import read_png
from program import TOP, Report, run, temporary_folder

HERE = pathlib.Path(__file__).resolve().parent
GRAPH = ("graphs/studio.json", "--size", "160x90")
OTHER = ("--other-set", "post.bloom=false")


def main():
    weft, report = sys.argv[1], Report()
    environment = {**os.environ, "NODE_PATH": os.pathsep.join(filter(None, (str(TOP / "build/node_modules"), os.environ.get("NODE_PATH"))))}
    chromium, node = shutil.which("chromium"), shutil.which("node")
    if not chromium or not node:
        report.skip("no Chromium or no Node: the page of weft report in a browser")
    if subprocess.run([node, "-e", "require('playwright-core'); require.resolve('axe-core/axe.min.js')"], env=environment, capture_output=True).returncode != 0:
        report.skip("no playwright-core or no axe-core: the page of weft report in a browser")
    with temporary_folder() as folder:
        page, picture = pathlib.Path(folder, "a #page.html"), pathlib.Path(folder, "after.png")
        done = run(weft, "report", *GRAPH, *OTHER, "-o", page)
        report.check(done.code == 0, done.err)
        session = subprocess.run([node, HERE / "page.cjs", chromium, page], env={**environment, "HOME": folder}, capture_output=True, text=True)
        if not report.check(session.returncode == 0, session.stderr):
            report.end()
        seen = json.loads(session.stdout)
        plans = [json.loads(run(weft, "plan", *GRAPH, *settings, "--format", "json").out) for settings in ((), ("--set", "post.bloom=false"))]
        before, after = ([step["pass"] for step in plan["steps"]] for plan in plans)
        report.check(not seen["errors"] and not seen["accessibility"], f"{seen['errors']}\n" + "\n".join(seen["accessibility"]))
        report.check(all(url.startswith(page.parent.as_uri()) for url in seen["requests"]), f"the page asks for {seen['requests']}")

        def whole(columns, names):
            return [step for column in columns for step in column] == list(range(len(names)))
        report.check(seen["selectedFirst"] == "post.fxaa.smooth" == after[-1], f"selected at first: {seen['selectedFirst']}")
        report.check(whole(seen["columns"], after) and seen["inView"] == len(seen["columns"]), f"columns: {seen['columns']}, in view {seen['inView']}")
        ibl = [step for step, name in enumerate(after) if name.startswith("ibl.")]
        report.check(seen["foldedAtFirst"] == "false" and ibl in seen["columns"], f"ibl is no column: {seen['columns']}")
        report.check(whole(seen["opened"], after) and len(seen["opened"]) > len(seen["columns"]) and seen["foldedAgain"] == seen["columns"], f"open {seen['opened']}, folded again {seen['foldedAgain']}")
        report.check(any(text.startswith("post.fxaa.find_edges") for text in seen["found"]), f"found: {seen['found']}")
        report.check(seen["searched"] == ["post.fxaa.find_edges", "#post.fxaa.find_edges"], f"searched: {seen['searched']}")
        report.check(seen["left"] == after[after.index("post.fxaa.find_edges") - 1], f"left of find_edges: {seen['left']}")
        report.check(seen["down"] in {resource["name"] for resource in plans[1]["resources"]}, f"a row: {seen['down']}")
        report.check(seen["tree"] == "lit.sky.skybox" and seen["byAddress"] == "post.display.composite", f"{seen['tree']}, by its address {seen['byAddress']}")
        report.check(shlex.split(seen["command"]) == ["weft", "report", *GRAPH, *OTHER, "-o", str(page)], f"copied: {seen['command']}")
        file, line = seen["copiedFile"].rsplit(":", 1)
        report.check("main()" in (TOP / file).read_text().splitlines()[int(line) - 1], f"copied: {seen['copiedFile']}")
        report.check(f"editor://{file}#{line}" in seen["links"], f"links: {seen['links']}")
        report.check(seen["difference"] == [run(weft, "diff", *GRAPH, *OTHER).out.rstrip("\n")], f"difference: {seen['difference']}")
        report.check(seen["wipe"] == [True, True, False], f"the wipe: {seen['wipe']}")
        gone = {name for name in before if name not in after}
        first = {column[0]: {before[step] for step in column} for column in seen["columnsBefore"]}
        marked = {name for mark, step in seen["marksBefore"] if mark == "−" for name in first[step]}
        report.check(gone and marked == gone and "≠" in "".join(seen["marksAfter"]), f"gone are {gone}, marked {seen['marksBefore']} and {seen['marksAfter']}")
        run(weft, "render", *GRAPH, "--set", "post.bloom=false", "-o", picture)
        rows = read_png(picture.read_bytes())
        x, y, *texel = (float(number) for number in re.findall(r"[-+.\de]+", seen["texel"]))
        pixel = rows[len(rows) - 1 - int(y)][int(x)]
        report.check(y > 45 and x > 45, f"right and above the middle: {seen['texel']}")
        report.check([round(255 * value) for value in texel[:3]] == list(pixel[:3]), f"the loupe says {seen['texel']}, the picture is {pixel}")
        report.check(min(seen["grounds"][0][:3]) > 200 and max(seen["grounds"][1][:3]) < 60, f"grounds, light and dark: {seen['grounds']}")
        report.check(seen["printed"] == [True, 0], f"printed: {seen['printed']}")
    report.end()


main()
