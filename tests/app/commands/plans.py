#!/usr/bin/env python3
"""`weft explain`, `weft diff` and `weft expand` on every bundled graph: an expanded graph gives the same plan, differs in nothing from
itself, and every pass and resource of a plan can be explained. Buffers fit a storage block of every device, also in large pictures.

    plans.py WEFT
"""
import json
import pathlib
import re
import sys

from program import TOP, Report, run, temporary_folder

HELMET = ["--scene", "scenes/helmet_alone.json"]
GRAPHS = {"graphs/glow.json": [], "graphs/studio.json": [], "graphs/studio_gi.json": [], "graphs/deferred.json": HELMET, "graphs/deferred_gi.json": HELMET}


def plain(name):
    return re.sub(r"[.\[,]", "_", name).replace("]", "").replace("@", "").replace("#", "_v")


def plan_of(weft, graph, *arguments):
    return json.loads(run(weft, "plan", graph, "--format", "json", *arguments).out)


def plain_resource(name):
    """An element stays one: "maps[3]#2" is "maps_v2[3]"."""
    array, index, version = re.fullmatch(r"@?([^\[#]*)(\[\d+\])?(#\d+)?", name).groups()
    return array.replace(".", "_") + (version or "").replace("#", "_v") + (index or "")


def outline(plan, rename, rename_resource):
    """What a frame does, with names as these functions give them."""
    def where(text):
        name, part, history = re.fullmatch(r"(@?[^@]*?)((?:\.(?:mip|layer)\[[\d.]+\])*(?:\.depth|\.stencil)?)(@-\d+)?", text).groups()
        return rename_resource(name) + part + (history or "") if name else ""
    steps = []
    for step in plan["steps"]:
        uses = [(u["access"], u["kind"], u["slot"], where(u["range"]), u["attached"]) for u in step["uses"]]
        frame = step.get("framebuffer")
        steps.append((rename(step["pass"]), step["update"], step.get("slices", 1), step["barriers"], [where(c) for c in step["clears"]],
                      uses, frame and (frame["size"], [where(c) for c in frame["color"]], where(frame["depth"]))))
    return steps, plan["bytes"], plan["storages"], plan["final_barriers"], where(plan["present"])


def check_expand(weft, report, graph, arguments, folder):
    expanded = run(weft, "expand", graph, *arguments)
    if not report.check(expanded.code == 0 and expanded.out, f"expand {graph}: {expanded.code}\n{expanded.err}"):
        return
    file = pathlib.Path(folder, pathlib.Path(graph).name)
    file.write_text(expanded.out)
    checked = run(weft, "check", "--no-shaders", file, *arguments)
    if not report.check(checked.code == 0, f"the expanded {graph} is a graph: {checked.err[:3000]}"):
        return
    before, after = outline(plan_of(weft, graph, *arguments), plain, plain_resource), outline(plan_of(weft, file, *arguments), str, str)
    for what, old, new in zip(("steps", "bytes", "storages", "final barriers", "present"), before, after):
        if what == "steps":
            for one, other in zip(old, new):
                report.check(one == other, f"{graph}, expanded:\n{one}\n{other}")
        report.check(old == new, f"{graph}, expanded: other {what}" + ("" if what == "steps" else f"\n{old}\n{new}"))
    report.check(run(weft, "expand", file, *arguments).out == expanded.out, f"{graph}: the expanded file expands to another one")
    report.check(run(weft, "format", "--check", file).code == 0, f"{graph}: the expanded file is not laid out")


def check_explain(weft, report, graph, arguments):
    plan = plan_of(weft, graph, *arguments)
    names = [step["pass"] for step in plan["steps"]][::9] + [r["name"] for r in plan["resources"]][::17]
    for name in names[::2]:
        told = run(weft, "explain", graph, name, *arguments)
        report.check(told.code == 0 and f" {name}: " in told.out.splitlines()[0], f"explain {name} of {graph}: {told.code}\n{told.out}{told.err}")
    unknown = run(weft, "explain", graph, "no_such_thing", *arguments)
    report.check(unknown.code == 1 and unknown.codes() == ["W045"], f"{unknown.err}")


def check_diff(weft, report):
    same = run(weft, "diff", "graphs/studio.json", "graphs/studio.json")
    report.check(same.code == 0 and not same.out, f"a graph and itself: {same.out}")
    other = run(weft, "diff", "graphs/studio.json", "graphs/studio_gi.json")
    report.check(other.code == 1 and "+ pass " in other.out and "~ bytes allocated" in other.out, other.out)
    plans = [plan_of(weft, f"graphs/{name}.json") for name in ("studio", "studio_gi")]
    passes = [{step["pass"] for step in plan["steps"]} for plan in plans]
    told = {m.group(2): m.group(1) for m in re.finditer(r"^([+-]) pass (\S+):", other.out, re.M)}
    report.check({n for n, sign in told.items() if sign == "+"} == passes[1] - passes[0], other.out)
    report.check({n for n, sign in told.items() if sign == "-"} == passes[0] - passes[1], other.out)
    bytes_told = re.search(r"~ bytes allocated: (\d+) before, now (\d+)", other.out)
    report.check(bytes_told and [int(b) for b in bytes_told.groups()] == [plan["bytes"]["allocated"] for plan in plans], other.out)
    broken = run(weft, "diff", "graphs/studio.json", "tests/bad_graphs/w040_unknown_resource.json")
    report.check(broken.code == 2 and broken.codes() == ["W040"], f"{broken.code}\n{broken.err}")


LEAST_BLOCK = 1 << 27  # bytes: what GL_MAX_SHADER_STORAGE_BLOCK_SIZE is at least (OpenGL 4.5, Implementation Dependent Values)


def check_buffers(weft, report):
    """The lists of highlights grow with the picture, and the most where discs, and so tiles, are small."""
    for size in ("3840x2160", "7680x4320", "8192x8192"):
        for radius in (8, 9, 13, 32):
            settings = ["--size", size, "--set", "dof=true", "--set", f"largest_bokeh={radius}"]
            plan = plan_of(weft, "graphs/studio.json", *settings)
            buffers = {r["name"]: r["bytes"] for r in plan["resources"] if "offset" in r}
            report.check("post.dof.highlights" in buffers and max(buffers.values()) <= LEAST_BLOCK, f"{settings}: {buffers}")


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    with temporary_folder() as folder:
        for graph, arguments in GRAPHS.items():
            check_expand(weft, report, graph, arguments, folder)
            check_explain(weft, report, graph, arguments)
    check_diff(weft, report)
    check_buffers(weft, report)
    report.end()


main()
