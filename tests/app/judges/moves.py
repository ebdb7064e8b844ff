#!/usr/bin/env python3
"""The judge of moves: whichever pass or include moves to whichever place in its file, the picture follows or a message says what is lost.

    moves.py WEFT [--all] [--only PART] [--seed N] [--pictures N] [--jobs N]

Takes every pass, include and group of every file of graphs/, its cookbook and tests/golden, and moves it to every other place in its list, as an author does: by its text. The
graph that has the file as a part is then planned anew. One of three things must hold: the graph is refused with a coded error; or each pass that ran before
still runs, and each slot that it read still has something; or a warning names the pass that no longer reaches the picture, or the slot. Every file is tried with the
defaults of its graph and with every switch on, in a scene that has everything. Without --all a sample of the moves is tried. --pictures: so many moves that are
accepted are drawn, too: no OpenGL error and no black picture where the graph says nothing."""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import shutil

from pictures import decode
from program import TOP, Report, run, temporary_folder

# A root that has the file as a part; files that are roots themselves stand for themselves.
ROOTS = ("studio", "deferred", "studio_gi", "deferred_gi", "glow", "taa", "gi", "daylight", "bench_copy")
MODELS = TOP / "scenes/models"
# A scene with meshes that blend and do not, spheres, a ground, a sun and more lamps than are looped over.
EVERYTHING = {"cameras": {"a": {"position": [0, 2, 8], "target": [0, 0.5, 0]}}, "ground": {"height": -1}, "sun": {"direction": [0.3, 1, 0.2], "lux": 70000},
              "spheres": [{"center": [x, 0, z], "material": {"albedo": [0.5, 0.5, 0.5]}, "lists": ["spheres", "shadow_casters"]} for x in (-2, 0, 2) for z in (-2, 0)],
              "models": {"a": {"file": "ROCK"}, "b": {"file": "FOX"}, "glass": {"file": "FLOOR", "lists": ["transparent"]}},
              "lamps": {f"l{x}": {"position": [x, 2, 1], "candela": 400, "shadow": x == 0} for x in range(12)}}


def scan(text):
    """The offsets of what stands in the list "passes" of a graph file: of the list, and of each entry from its first to behind its last character."""
    at, depth, starts, entries, begin, key = 0, [], None, [], None, ""
    while at < len(text):
        c = text[at]
        if text.startswith("//", at):
            at = text.find("\n", at)
            continue
        if text.startswith("/*", at):
            at = text.find("*/", at) + 2
            continue
        if c == '"':
            end = at + 1
            while text[end] != '"':
                end += 2 if text[end] == "\\" else 1
            if len(depth) == 1:
                key = text[at + 1:end]
            at = end + 1
            continue
        if c in "[{":
            if starts is not None and len(depth) == 2 and c == "{":
                begin = at
            depth.append(c)
            if len(depth) == 2 and key == "passes" and c == "[":
                starts = at
        elif c in "]}":
            depth.pop()
            if starts is not None and len(depth) == 2 and begin is not None:
                entries.append((begin, at + 1))
                begin = None
            elif starts is not None and len(depth) == 1:
                return starts, at, entries
        at += 1
    return None, None, []


def scan_list(text, group):
    """As scan(), of the list of the group that is entry `group`, or with None of the file's own."""
    whole = scan(text)
    if group is None:
        return whole
    at, end = whole[2][group]
    start, last, entries = scan(text[at:end])
    return start if start is None else at + start, last if last is None else at + last, [(at + a, at + b) for a, b in entries]


def moved(text, group, source, target):
    """The text with entry `source` of a list at the place `target`; comments within the list go, those inside entries stay."""
    start, end, entries = scan_list(text, group)
    parts = [text[a:b] for a, b in entries]
    parts.insert(target, parts.pop(source))
    return text[:start + 1] + "\n    " + ",\n    ".join(parts) + "\n  " + text[end:]


def label(text, entry):
    part = text[entry[0]:entry[1]]
    found = re.search(r'"name":\s*"([^"]+)"', part) or re.search(r'"include":\s*"([^"]+)"', part)
    return found[1] if found else part[:40]


def name_of(text, entry):
    """How an overlay calls the entry."""
    part = text[entry[0]:entry[1]]
    found = re.search(r'"(?:name|as)":\s*"([^"]+)"', part)
    return found[1] if found else pathlib.Path(re.search(r'"include":\s*"([^"]+)"', part)[1]).stem


def overlay(root, text, group, source, target):
    """The same move said by an overlay, or None: a group has no name, and what stands at the edge of a loop is not in it."""
    start, _, entries = scan_list(text, group)
    loops = group is not None and '"repeat"' in text[scan(text)[2][group][0]:start]
    names = [None if scan(text[a:b])[0] is not None else name_of(text, (a, b)) for a, b in entries]
    name = names.pop(source)
    if loops or name is None or names[min(target, len(names) - 1)] is None:
        return None
    place = {"before": names[target]} if target < len(names) else {"after": names[-1]}
    return json.dumps({"extends": root.name, "passes": [{"name": name, **place}]})


def parts_of(path, seen=None):
    """The files that a graph is made of, itself first."""
    seen = {} if seen is None else seen
    if path in seen:
        return seen
    text = seen[path] = path.read_text()
    for name in re.findall(r'"(?:include|extends)":\s*"([^"]+)"', text):
        parts_of((path.parent / name).resolve(), seen)
    return seen


class Planned:
    """What a graph comes to: which passes run, what each of their slots reads, what is said."""

    def __init__(self, weft, folder, root, settings):
        done = run(weft, "plan", root, "--format", "json", *settings, folder=folder, timeout=120)
        self.code, self.said, self.refused = done.code, done.err, done.code != 0
        self.coded = any(d["severity"] == "error" and d["code"] for d in done.diagnostics)
        self.runs, self.reads, self.steps = {}, collections.defaultdict(dict), []
        self.writers = collections.defaultdict(set)
        if self.refused:
            return
        plan = json.loads(done.out)
        self.steps = [step["pass"] for step in plan["steps"]]
        for step in plan["steps"]:
            stanza = step["pass"].split("[")[0]
            self.runs[stanza] = self.runs.get(stanza, 0) + 1
            for use in step["uses"]:
                if use["access"] == "read":
                    self.reads[stanza].setdefault(use["slot"], use["resource"])
                else:
                    self.writers[use["resource"]].add(stanza)
        self.warnings = " ".join(d["text"] for d in done.diagnostics if d["severity"] == "warning")
        # What a message says beyond its first line belongs to it.
        self.warnings += done.err

    def names(self, word):
        return re.search(rf"'{re.escape(word)}(\[[^']*\])?'", self.warnings) is not None


def judge(before, after):
    """What was lost without a word: passes, slots."""
    if after.refused:
        return [] if after.coded else [("refused without a code", after.said[:200])]

    def told(name, seen=frozenset()):
        """It is named; or all that read what it wrote do not run either, and are told of: one mistake, one message."""
        made = {resource for resource, writers in before.writers.items() if name in writers}
        readers = {stanza for stanza, slots in before.reads.items() if stanza != name and made & set(slots.values())} - seen
        return after.names(name) or bool(readers) and all(reader not in after.runs and told(reader, seen | {name}) for reader in readers)

    lost = [("pass", name) for name, count in before.runs.items() if after.runs.get(name, 0) < count and not told(name)]
    # A list of passes names the first of them and counts the rest.
    counted = set()
    if len(lost) <= sum(map(int, re.findall(r" and (\d+) more", after.warnings))):
        counted, lost = {name for _, name in lost}, []
    for name, slots in before.reads.items():
        if name not in after.runs:
            continue
        for slot in sorted(slots.keys() - after.reads[name].keys()):
            # The pass that reads, or one that wrote what it read.
            if not any(after.names(told) or told in counted for told in (name, *before.writers[slots[slot]])):
                lost.append(("slot", f"{name}.{slot}"))
    return lost


def switches(weft, root):
    """Every switch of a graph on."""
    parameters = json.loads(run(weft, "params", root, "--json").out)
    return [word for p in parameters if p["type"] == "bool" for word in ("--set", f"{p['name']}=true")]


def main():
    options = argparse.ArgumentParser()
    options.add_argument("weft", type=pathlib.Path)
    options.add_argument("--all", action="store_true")
    options.add_argument("--only", default="")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--sample", type=int, default=160)
    options.add_argument("--pictures", type=int, default=0)
    options.add_argument("--jobs", type=int, default=2)
    options.add_argument("--list", type=pathlib.Path, help="write what is lost in silence to this file, as JSON")
    chosen, _ = options.parse_known_args()
    weft, report = chosen.weft.resolve(), Report()

    roots = [TOP / f"graphs/{name}.json" for name in ROOTS] + sorted(TOP.glob("tests/golden/*.json"))
    roots = [r for r in roots if r.exists() and not r.name.endswith(".cases.json")]
    roots += sorted(p for p in TOP.glob("graphs/*.json") if p not in roots)  # what is part of another graph is no root of its own
    roots += sorted(TOP.glob("graphs/cookbook/*/*.json"))
    parts = {root: parts_of(root) for root in roots}
    owner = {}
    for root in roots:
        for path in parts[root]:
            if path.is_relative_to(TOP):
                owner.setdefault(path, root)

    jobs = []
    for path, root in owner.items():
        if chosen.only not in str(path.relative_to(TOP)):
            continue
        text = path.read_text()
        for configuration in ("defaults", "everything"):
            for group in (None, *range(len(scan(text)[2]))):
                count = len(scan_list(text, group)[2])
                jobs += [(root, path, configuration, group, a, b) for a in range(count) for b in range(count) if a != b]
    every = len(jobs)
    if not chosen.all:
        jobs = random.Random(chosen.seed).sample(jobs, min(chosen.sample, len(jobs)))

    with temporary_folder() as name:
        base = pathlib.Path(name).resolve()
        scene = base / "everything.json"
        scene.write_text(json.dumps(EVERYTHING).replace("ROCK", f"{MODELS}/rock.obj").replace("FOX", f"{MODELS}/Fox.glb").replace("FLOOR", f"{MODELS}/floor.obj"))
        settings, before = {}, {}
        for root in {job[0] for job in jobs}:
            settings[root, "defaults"] = []
            settings[root, "everything"] = ["--scene", scene, *switches(weft, root)]
            for configuration in ("defaults", "everything"):
                before[root, configuration] = Planned(weft, TOP, root, settings[root, configuration])

        # One copy of what graphs are made of for each thread, in which one file at a time is another.
        copies = []
        for index in range(chosen.jobs):
            copy = base / f"copy{index}"
            for part in ("graphs", "tests/golden", "shaders"):
                shutil.copytree(TOP / part, copy / part, ignore=shutil.ignore_patterns("*.png", "*.passes"))
            copies.append(copy)

        def one(job):
            root, path, configuration, group, source, target = job
            if before[root, configuration].refused:
                return job, [], None
            copy, text = copies.pop(), path.read_text()
            file = copy / path.relative_to(TOP)
            try:
                file.write_text(moved(text, group, source, target))
                after = Planned(weft, copy, copy / root.relative_to(TOP), settings[root, configuration])
                lost = judge(before[root, configuration], after)
                if lost and not after.refused:  # a long message is shortened on a terminal
                    done = run(weft, "check", copy / root.relative_to(TOP), "--no-shaders", "--format", "json", *settings[root, configuration], folder=copy, timeout=120)
                    after.warnings = " ".join(" ".join(map(str, d.values())) for d in json.loads(done.out)["diagnostics"])
                    lost = judge(before[root, configuration], after)
                file.write_text(text)
                said = overlay(root, text, group, source, target) if path == root and '"extends"' not in text else None
                if said:
                    laid = file.parent / "laid.json"
                    laid.write_text(said)
                    over = Planned(weft, copy, laid, settings[root, configuration])
                    # What the move of the text makes wrong may have no place in an overlay: a pass that is `like` one that now stands below.
                    if over.refused != after.refused and "W017" not in after.said or over.steps != after.steps and not after.refused:
                        lost.append(("overlay", f"refused {after.refused}, as overlay {over.refused} {over.said[:300]}"))
            finally:
                file.write_text(text)
                copies.append(copy)
            return job, lost, after

        with concurrent.futures.ThreadPoolExecutor(chosen.jobs) as pool:
            done = list(pool.map(one, jobs))

        for (root, configuration), plan in sorted(before.items(), key=str):
            own = owner.get(root) == root and root.stem in ROOTS
            report.check(not plan.refused or not own, f"{root.name}, {configuration}: {plan.said}")
            report.check(not own or "warning[W09" not in plan.said, f"{root.name}, {configuration}, as it is: {plan.said}")
        kinds, written = collections.Counter(), []
        for (root, path, configuration, group, source, target), lost, after in done:
            text = path.read_text()
            entries = scan_list(text, group)[2]
            where = f"{path.relative_to(TOP)} of {root.stem}, {configuration}: '{label(text, entries[source])}' from {source} to {target}"
            state = "skipped" if after is None else "refused" if after.refused else "silent" if lost else "warned" if after.said else "same"
            kinds[state] += 1
            for what, which in lost:
                kinds[f"lost {what}"] += 1
            if lost:
                written.append({"move": where, "lost": lost})
            report.check(not lost, f"{where}: {', '.join(f'{what} {which}' for what, which in lost[:6])}")
        if chosen.list:
            chosen.list.write_text(json.dumps(written, indent=1))

        def picture(folder, root, configuration):
            made = run(weft, "render", folder / root.relative_to(TOP), "--size", "64x36", "--quiet", "-o", base / "a.png", *settings[root, configuration])
            if made.code:
                return None, made.err
            texels = decode((base / "a.png").read_bytes())[2]
            return sum(texels) / len(texels), made.err

        accepted = [d for d in done if d[2] is not None and not d[2].refused]
        drawn = random.Random(chosen.seed).sample(accepted, min(chosen.pictures, len(accepted)))
        levels = {}
        for job, _, after in drawn:
            root, path, configuration, group, source, target = job
            if (root, configuration) not in levels:
                levels[root, configuration] = picture(TOP, root, configuration)[0]
            before_level, text = levels[root, configuration], path.read_text()
            if before_level is None:  # presents nothing
                continue
            file = copies[0] / path.relative_to(TOP)
            file.write_text(moved(text, group, source, target))
            level, said = picture(copies[0], root, configuration)
            file.write_text(text)
            where = f"picture of {path.relative_to(TOP)} of {root.stem}, {configuration}: {source} to {target}"
            if not report.check(level is not None, f"{where}: {said}") or "warning[" in after.said:
                continue
            report.check(0.7 * before_level < level < 1.4 * before_level, f"{where}: mean level {level:.1f} where it was {before_level:.1f}, and nothing is said")
        if drawn:
            print(f"{len(drawn)} pictures")
    print(f"{len(jobs)} of {every} moves: " + ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items())))
    report.end()


main()
