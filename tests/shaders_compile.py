#!/usr/bin/env python3
"""Every shader named by a graph is valid GLSL, in the variants its slots, parameters and defines can ask for.

Usage: shaders_compile.py SOURCE_DIR [GRAPH...]; default: every .json with passes below graphs/, tests/golden and tests/theory.
Per pass: everything connected and all optional left out, with the values of the defines in all combinations where these are few, else
in pairs (a number has one, `max(…, 1)` stands for 1 and 2); each optional input, each output and each parameter left out alone, with the
first values of all defines and with the last. Needs glslangValidator; exits 77 (skipped) without it.
"""
import functools
import itertools
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

TOP = pathlib.Path(sys.argv[1]).resolve()
STAGES = ("vert", "frag", "comp")


def strip_comments(text):
    pattern = r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/'
    return re.sub(pattern, lambda m: m.group(0) if m.group(0)[0] == '"' else " ", text, flags=re.S)


def shader_folders(graph):
    return [graph.parent / "shaders", graph.parent.parent / "shaders", TOP / "shaders"]


def find_shader(graph, name):
    for folder in shader_folders(graph):
        if (folder / name).is_file():
            return folder / name
    return None


def expand(path, roots, seen_stack=()):
    """Lines of a shader with its includes in place, without comments: of 300 MB of variants half would be these."""
    if path in seen_stack:
        raise ValueError(f"{path}: includes itself")
    out = []
    for number, line in enumerate(strip_comments(path.read_text()).splitlines(), 1):
        found = re.match(r'\s*#\s*include\s+"([^"]+)"', line)
        if not found:
            out += [line] if line.strip() else []
            continue
        options = [root / found.group(1) for root in [path.parent, *roots]]
        target = next((option for option in options if option.is_file()), None)
        if target is None:
            raise ValueError(f"{path}:{number}: no file {found.group(1)}")
        out += expand(target, roots, (*seen_stack, path))
    return out


# Optional inputs that are there whenever the pass is.
NEVER_EMPTY = {"fog/surfaces.frag.glsl": {"air"}}


def define_name(name):
    return re.sub(r"\W", "_", name).upper()


def by_name(value):
    """A list of names and objects as the object that it is short for."""
    if isinstance(value, dict):
        return value
    return {k: v for item in value for k, v in (item if isinstance(item, dict) else {re.match(r"[@$]?(?:\w+\.(?!mip|layer|face))*(\w+)", item)[1]: item}).items()}


def sets_of(graph):
    """Those of the file and of the files that it extends."""
    desc = json.loads(strip_comments(graph.read_text()))
    below = desc.get("extends", [])
    return {name: held for file in ([below] if isinstance(below, str) else below) for name, held in sets_of(graph.parent / file).items()} | desc.get("sets", {})


SHARED = ("read", "write", "modify", "parameters", "defines", "state")


def spread(stanzas):
    """The passes of groups with what the group says, and all others."""
    for group in stanzas:
        for stanza in group.get("passes", [group]):
            if stanza is not group:
                for key, held in group.items():
                    if key == "use":
                        stanza[key] = [*([held] if isinstance(held, str) else held), *([stanza[key]] if isinstance(stanza.get(key), str) else stanza.get(key, []))]
                    elif key != "passes":
                        stanza[key] = {**by_name(held), **by_name(stanza.get(key, {}))} if key in SHARED else stanza.get(key, held)
            yield stanza


def passes_of(graph):
    """Each with what it has of sets and of its group."""
    desc = json.loads(strip_comments(graph.read_text()))
    sets = sets_of(graph)
    for stanza in spread(desc.get("passes", [])):
        used = stanza.get("use", [])
        for group in ("read", "write", "modify", "parameters"):
            stanza[group] = by_name(stanza.get(group, {}))
        for name in [used] if isinstance(used, str) else used:
            for group, held in sets[name].items():
                shared = group in SHARED
                stanza[group] = {**by_name(held), **stanza.get(group, {})} if shared else held
        if "shader" in stanza:
            yield stanza, desc


def constants_of(graphs):
    """The numbers that a `let` names, as text. Includes see those of their includers: so they are gathered from all files."""
    lets = [json.loads(strip_comments(graph.read_text())).get("let", {}) for graph in graphs]
    return {f"${name.split('.')[-1]}": str(value) for let in lets for name, value in let.items() if isinstance(value, int)}


def variants(stanza, desc, constants):
    """Dictionaries of defines."""
    slots, optional = [], []
    inputs = [name for item in desc.get("inputs", []) for name in ([item] if isinstance(item, str) else item)]
    may_be_empty = {name.split()[0] for name in inputs if name.endswith("?")} - NEVER_EMPTY.get(stanza["shader"] if isinstance(stanza["shader"], str) else "", set())
    for access in ("read", "write", "modify"):
        for slot, ref in stanza.get(access, {}).items():
            slots.append(slot)
            if access != "read" or str(ref).rstrip().endswith("?") or re.match(r"\w*", str(ref))[0] in may_be_empty:
                optional.append(slot)
    parameters, choices = [], {}
    for name, value in stanza.get("parameters", {}).items():
        if isinstance(value, dict) and value.get("define"):
            choices[define_name(name)] = [{define_name(name): "0"}, {define_name(name): "1"}]
        else:
            parameters.append(name)
    for name, value in stanza.get("defines", {}).items():
        name = define_name(name)
        source = desc.get("parameters", {}).get(str(value).lstrip("$"), {}) if str(value).startswith("$") else {}
        number = desc.get("let", {}).get(str(value).lstrip("$"), value)
        if isinstance(number, (int, float)) and not isinstance(number, bool):
            choices[name] = [{name: str(number)}]
        elif "choices" in source:
            named = {f"{name}_{define_name(c)}": str(i) for i, c in enumerate(source["choices"])}
            choices[name] = [{name: str(i), **named} for i in range(len(source["choices"]))]
        elif str(value) in constants:
            choices[name] = [{name: constants[value]}]
        elif re.fullmatch(r"max\(.*, 1\)", str(number)):
            choices[name] = [{name: "1"}, {name: "2"}]
        else:
            choices[name] = [{name: "0"}, {name: "1"}]
    everything = {f"HAS_{define_name(n)}": "1" for n in slots + parameters}
    base = [everything]
    for left_out in optional + parameters:
        base.append({k: v for k, v in everything.items() if k != f"HAS_{define_name(left_out)}"})
    dropped = {f"HAS_{define_name(n)}" for n in optional + parameters}
    base.append({k: v for k, v in everything.items() if k not in dropped})
    found = combinations(list(choices.values()))
    for combination in found:
        extra = {k: v for part in combination for k, v in part.items()}
        for has in base if combination in (found[0], found[-1]) else (base[0], base[-1]):
            yield {**has, **extra}


def combinations(choices):
    """All of them up to 64; beyond, every value of each with the others first, all at their last, and every pair of them."""
    if math.prod(len(values) for values in choices) <= 64:
        return list(itertools.product(*choices))
    first, last = [values[0] for values in choices], [values[-1] for values in choices]
    found = [first]
    for i, values in enumerate(choices):
        for value in values[1:]:
            found += [base[:i] + [value] + base[i + 1:] for base in (first, last)]
    for i, j in itertools.combinations(range(len(choices)), 2):
        found.append([last[k] if k in (i, j) else first[k] for k in range(len(choices))])
    return [*found, last]


@functools.cache
def body_of(path, roots):
    """The expanded text, and the words in it: a define that is none of them changes nothing."""
    lines = expand(path, roots)
    return lines, set(re.findall(r"\w+", "\n".join(lines)))


def validate(jobs):
    """jobs: (path of the text, its lines, where it stands); one run of the validator for all. Yields problems."""
    result = subprocess.run(["glslangValidator", *(str(path) for path, _, _ in jobs)], capture_output=True, text=True)
    errors, current = {}, None
    names = {str(path) for path, _, _ in jobs}
    for line in result.stdout.splitlines():
        if line.strip() in names:
            current = line.strip()
        elif "ERROR" in line and current:
            errors.setdefault(current, []).append(line.strip())
    if result.returncode != 0 and not errors:
        yield f"glslangValidator: {result.stdout}{result.stderr}"
    for path, text, where in jobs:
        for line in errors.get(str(path), [])[:4]:
            at = re.search(r":(\d+):", line)
            number = int(at.group(1)) if at else 0
            yield f"{where}\n    {line}" + (f"\n      > {text[number - 1].strip()}" if 0 < number <= len(text) else "")


def main():
    if not shutil.which("glslangValidator"):
        print("skipped: glslangValidator is not installed")
        return 77
    graphs = [pathlib.Path(g).resolve() for g in sys.argv[2:]]
    if not graphs:
        for folder in ("graphs", "tests/golden", "tests/theory"):
            graphs += sorted(g for g in (TOP / folder).rglob("*.json") if '"passes"' in g.read_text())
    done, problems, used, jobs, constants = set(), [], set(), [], constants_of(graphs)
    with tempfile.TemporaryDirectory() as temporary:
        for graph in graphs:
            roots = tuple(shader_folders(graph))
            for stanza, desc in passes_of(graph):
                name, where = stanza["shader"], f"{graph.relative_to(TOP)}: pass {stanza['name']}"
                names = list(name.values()) if isinstance(name, dict) else [name]
                if not isinstance(name, dict) and not name.endswith(".glsl"):
                    names = [f"{name}.vert.glsl", f"{name}.frag.glsl"]
                for one in names:
                    path = find_shader(graph, one)
                    if path is None:
                        problems.append(f"{where}: no shader {one}")
                        continue
                    used.add(path)
                    stage = path.name.split(".")[-2]
                    if stage not in STAGES:
                        problems.append(f"{where}: {one}: no stage in the name")
                        continue
                    for defines in variants(stanza, desc, constants):
                        try:
                            lines, words = body_of(path, roots)
                        except ValueError as reason:
                            problems.append(f"{where}: {reason}")
                            break
                        defines = {name: value for name, value in defines.items() if name in words}
                        key = (path, tuple(sorted(defines.items())))
                        if key in done:
                            continue
                        done.add(key)
                        text = ["#version 450 core", *(f"#define {name} {value}" for name, value in defines.items()), *lines]
                        file = pathlib.Path(temporary) / f"{len(jobs)}.{stage}"
                        file.write_text("\n".join(text) + "\n")
                        jobs.append((file, text, f"{where}: {path.relative_to(TOP)} with {defines}"))
        problems += validate(jobs)
    unused = sorted(p for p in (TOP / "shaders").rglob("*.*.glsl") if p.name.split(".")[-2] in STAGES and p not in used)
    problems += [f"{p.relative_to(TOP)}: no graph uses it" for p in unused]
    print("\n".join(problems) or f"shaders_compile: {len(used)} shaders, {len(done)} variants")
    return 1 if problems or not done else 0


sys.exit(main())
