"""Graphs of any size, as {file name: text or value}, for graphs.py: each function makes one dimension large."""
import json

SMALL = {"texture": "rgba8", "size": 8}
PASS = {"type": "fullscreen", "shader": "a.frag.glsl"}


def graph(resources=None, passes=(), **more):
    last = {**PASS, "name": "last", "write": {"result": "ldr"}}
    return {"resources": {**(resources or {}), "ldr": SMALL}, "passes": [*passes, last], "present": "ldr", **more}


def reader(source, **more):
    """A pass that runs and reads `source`."""
    return {**PASS, "name": "reader", "side_effect": True, "read": {"source": source}, "write": {"result": "ldr"}, **more}


def text(value):
    return json.dumps(value, separators=(",", ":"))


def alternatives_in_a_row(n):
    chain = {f"a{i}": [f"a{i + 1}"] for i in range(n - 1)}
    return {"g.json": graph({**chain, f"a{n - 1}": ["ldr"]}, [reader("a0?")])}


def alternatives_of_two(n):
    lists = {f"{side}{i}": [f"x{i + 1}", f"y{i + 1}"] for i in range(n) for side in "xy"}
    return {"g.json": graph({**lists, f"x{n}": SMALL, f"y{n}": SMALL}, [reader("x0?")])}


def history_of_alternatives_of_two(n):
    """Bound to an input that wants a history of each resource that the list may mean."""
    files = alternatives_of_two(n)
    files["g.json"]["passes"].insert(0, {"include": "part.json", "as": "part", "bind": {"in": "x0"}})
    return {**files, "part.json": {"inputs": [{"in": {"history": 1}}], "resources": {"kept": SMALL}, "passes": [{**reader("in@-1"), "write": {"result": "kept"}}]}}


def size_of_alternatives_of_two(n):
    files = alternatives_of_two(n)
    files["g.json"]["resources"].update({f"{side}{n}": ["ldr if false"] for side in "xy"})
    files["g.json"]["let"] = {"known": "has(x0)"}
    files["g.json"]["passes"][0] = {**PASS, "name": "reader", "write": {"result": "ldr"}, "enabled": "$known"}
    return files


def includes_in_a_row(n):
    files = {f"f{i}.json": {"passes": [{"include": f"f{i + 1}.json", "as": "n"}]} for i in range(1, n - 1)}
    return {"g.json": graph({}, [{"include": "f1.json", "as": "n"}]), **files, f"f{n - 1}.json": {"passes": []}}


def includes_twice(n):
    two = lambda i: [{"include": f"f{i}.json", "as": side} for side in "ab"]
    files = {f"f{i}.json": {"passes": two(i + 1)} for i in range(1, n)}
    return {"g.json": graph({}, two(1)), **files, f"f{n}.json": {"passes": []}}


def includes_beside(n):
    return {"g.json": graph({}, [{"include": "f.json", "as": f"n{i}"} for i in range(n)]), "f.json": {"passes": []}}


def includes_of_much(n, values):
    return {"g.json": graph({}, [{"include": "f.json", "as": f"n{i}"} for i in range(n)]),
            "f.json": {"let": {f"l{i}": 1 for i in range(values)}, "passes": []}}


def extends_in_a_row(n):
    files = {f"f{i}.json": {"extends": f"f{i + 1}.json"} for i in range(1, n)}
    return {"g.json": {"extends": "f1.json"}, **files, f"f{n}.json": graph()}


def extends_of_two(n):
    """2^n ways through lists that end in files that are not there."""
    files = {f"{name}{i}.json": {"extends": [f"a{i + 1}.json", f"b{i + 1}.json"], "set": {}} for i in range(1, n) for name in "ab"}
    return {"g.json": {"extends": ["f.json", "a1.json"]}, "f.json": graph(), **files}


def extends_of_much(n, values):
    files = extends_in_a_row(n)
    files[f"f{n}.json"]["let"] = {f"l{i}": 1 for i in range(values)}
    return files


def overlay_of_much(names, entries):
    return {"g.json": {"extends": "f.json", "parameters": {f"p{i}": {"default": 2} for i in range(entries)}},
            "f.json": graph(parameters={f"p{i}": {"type": "float", "default": 1} for i in range(names)})}


def lets_in_a_row(n):
    lets = {f"l{i}": f"$l{i + 1} + 1" for i in range(n - 1)}
    return {"g.json": graph({"a": {**SMALL, "size": "$l0"}}, let={**lets, f"l{n - 1}": 1})}


def lets_in_a_cycle(n):
    return {"g.json": graph({"a": {**SMALL, "size": "$l0"}}, let={f"l{i}": f"$l{(i + 1) % n} + 1" for i in range(n)})}


def ages_in_a_row(n):
    lets = {f"l{i}": f"$l{i + 1}" for i in range(n - 1)}
    return {"g.json": graph({}, [{**PASS, "name": "p", "side_effect": True, "write": {"result": "ldr"}, "parameters": {"k": "$l0"}}],
                            let={**lets, f"l{n - 1}": "age(ldr)"})}


def ages_doubled(n):
    files = ages_in_a_row(n)
    files["g.json"]["let"].update({f"l{i}": f"$l{i + 1} + $l{i + 1}" for i in range(n - 1)})
    return files


def sizes_in_a_row(n):
    chain = {f"t{i}": {**SMALL, "size": f"size(t{i + 1})"} for i in range(n - 1)}
    return {"g.json": graph({**chain, f"t{n - 1}": SMALL})}


def conditions_in_a_row(n):
    chain = {f"a{i}": [f"ldr if has(a{i + 1})"] for i in range(n - 1)}
    return {"g.json": graph({**chain, f"a{n - 1}": ["ldr"]}, [{**PASS, "name": "p", "enabled": "has(a0)", "write": {"o": "ldr"}}])}


def binds_in_a_row(n):
    part = {"inputs": ["map"], "passes": []}
    stanzas = [{"include": "f.json", "as": f"n{i}", "bind": {"map": f"n{i + 1}.map"}} for i in range(n - 1)]
    return {"g.json": graph({}, [*stanzas, {"include": "f.json", "as": f"n{n - 1}", "bind": {"map": "ldr"}}, reader("n0.map?")]), "f.json": part}


def tall_lets(n, height):
    """Each let stands at the bottom of a tall expression of the one before."""
    lets = {f"l{i}": f"$l{i + 1}" + " + 1" * height for i in range(n - 1)}
    return {"g.json": graph({"a": {**SMALL, "size": "$l0"}}, let={**lets, f"l{n - 1}": 1})}


def repeat_of(indices):
    return {"g.json": graph({}, [{**PASS, "name": "p", "repeat": {f"i{i}": [0, 0] for i in range(indices)}, "write": {"result": "ldr"}}])}


def repeat_to(n, **more):
    return {"g.json": graph({"a": {**SMALL, "clear": 0}}, [{**PASS, "name": "p", "repeat": {"i": [1, n]}, "read": {"s": "a"}, "write": {"r": "a"}, **more},
                                                           reader("a")])}


def passes_that_read_all_before(n):
    resources = {f"r{i}": SMALL for i in range(n)}
    passes = [{**PASS, "name": f"p{i}", "read": {f"s{j}": f"r{j}" for j in range(i)}, "write": {"o": f"r{i}"}} for i in range(n)]
    return {"g.json": {"resources": resources, "passes": passes, "present": f"r{n - 1}"}}


def layers_read_by_disabled(layers, passes, history=""):
    resources = {"a": {**SMALL, "layers": layers, **({"history": 1} if history else {})}}
    off = {**PASS, "name": "off", "enabled": False, "repeat": {"i": [1, passes]}, "read": {f"s{j}": f"a{history}" for j in range(100)}, "write": {"r": "ldr"}}
    return {"g.json": graph(resources, [{**PASS, "name": "fill", "repeat": {"i": [0, layers - 1]}, "write": {"r": "a.layer[i]"}}, off, reader("a")])}


def small_passes(n):
    return {"g.json": graph({"a": {**SMALL, "clear": 0}}, [*({**PASS, "name": f"p{i}", "read": {"s": "a"}, "write": {"r": "a"}} for i in range(n)), reader("a")])}


def slots_of_one_pass(n):
    return {"g.json": graph({"a": {**SMALL, "clear": 0}}, [{**PASS, "name": "p", "side_effect": True, "read": {f"s{i}": "a" for i in range(n)}, "write": {"r": "ldr"}}])}


def images_of_one_texture(n):
    """Each slot of one pass stores to a layer of one texture, and each is held against the others."""
    return {"g.json": graph({"a": {**SMALL, "layers": 2048}}, [{"name": "p", "type": "compute", "shader": "a.comp.glsl", "side_effect": True, "threads": 1,
                                                                "write": {f"s{i}": f"a.layer[{i % 2048}] as image" for i in range(n)}}])}


def layers_read_again(writers, readers):
    """A texture of which each layer has another writer is read whole: every reader sees them all."""
    write = {**PASS, "name": "writer", "repeat": {"i": [0, writers - 1]}, "write": {"o": "a.layer[i]"}}
    read = {**PASS, "name": "r", "repeat": {"i": [1, readers]}, "side_effect": True, "read": {"s": "a"}, "write": {"o": "ldr"}}
    return {"g.json": graph({"a": {**SMALL, "layers": writers}}, [write, read])}


def textures(n, **more):
    names = [f"t{i}" for i in range(n)]
    passes = [{**PASS, "name": f"p{i}", "write": {"o": name}} for i, name in enumerate(names)]
    final = {**PASS, "name": "final", "side_effect": True, "read": {f"s{i}": name for i, name in enumerate(names)}, "write": {"o": "ldr"}}
    return {"g.json": graph({name: {"texture": "rgba32f", "size": 8000, **more} for name in names}, [*passes, final])}


def unknown_names(resources, passes):
    return {"g.json": graph({f"r{i}": SMALL for i in range(resources)}, [{**PASS, "name": f"p{i}", "read": {"s": f"q{i}"}, "write": {"o": "ldr"}} for i in range(passes)])}


def unknown_keys(n):
    return {"g.json": graph({}, [{**PASS, "name": "p", "write": {"o": "ldr"}, **{f"key{i}": 1 for i in range(n)}}])}


def long_key(n):
    return {"g.json": graph({"a" * n: SMALL})}


def long_pass_name(n):
    return {"g.json": graph({}, [{**PASS, "name": "p" * n, "write": {"o": "ldr"}}])}


def long_keys_in_depth(n):
    value = "x"
    for _ in range(40):
        value = {"k" * 250: value, **({f"x{i}": i for i in range(n)} if value == "x" else {})}
    return {"g.json": graph(**{"presentt": value})}


def long_expression(n):
    return {"g.json": graph({"a": {**SMALL, "size": "max(" + ",".join("1" for _ in range(n)) + ")"}})}


def long_list(n):
    return {"g.json": graph({"a": {**SMALL, "size": "[" + ",".join("1" for _ in range(n)) + "]"}})}


def wide_expression(n):
    names = [f"$p{i}" for i in range(n)]
    while len(names) > 1:
        names = [f"max({','.join(names[i:i + 8])})" if len(names[i:i + 8]) > 1 else names[i] for i in range(0, len(names), 8)]
    return {"g.json": graph({"a": {**SMALL, "size": names[0]}}, parameters={f"p{i}": {"type": "float", "default": 8} for i in range(n)})}


def many(kind, n):
    values = {"parameters": {"type": "float", "default": 1}, "resources": SMALL, "let": 1}
    more = {kind: {f"n{i}": values[kind] for i in range(n)}}
    return {"g.json": graph(more["resources"]) if kind == "resources" else graph(**more)}


def imports(n):
    return {"g.json": graph({f"i{i}": {"import": "camera", "jitter": i} for i in range(n)})}


def sliced_groups(n):
    resources = {f"r{i}": SMALL for i in range(n)}
    first = [{**PASS, "name": f"a{i}", "update": "once", "slices": 2, "write": {"o": f"r{i}"}} for i in range(n)]
    second = [{**PASS, "name": f"b{i}", "update": "once", "slices": 2, "read": {"s": f"r{i}"}, "write": {"o": f"r{i}"}} for i in range(n)]
    return {"g.json": graph(resources, [*first, *second])}


def blanks(n):
    return {"g.json": " \n" * (n // 2) + text(graph())}


def values_of(n):
    return {"g.json": '{"resources":{"a":[' + ",".join(["0"] * n) + "]}}"}


def passes_of_one_set(n, defines):
    sets = {"all": {"defines": {f"D{i}": 1 for i in range(defines)}}}
    return {"g.json": graph({}, [{**PASS, "name": f"p{i}", "use": "all", "write": {"o": "ldr"}} for i in range(n)], sets=sets)}


def overlay_on_sets(n, defines):
    over = {"extends": "base.json", "passes": [{"name": f"p{i}", "defines": {"D0": 2}} for i in range(n)]}
    return {"base.json": passes_of_one_set(n, defines)["g.json"], "g.json": json.dumps(over)}


def parameters_of_one_pass(n, repeats):
    stanza = {**PASS, "name": "p", "repeat": {"i": [1, repeats]}, "side_effect": True, "write": {"o": "ldr"}, "parameters": {f"k{i}": "i" for i in range(n)}}
    return {"g.json": graph({}, [stanza])}


def terms_of_one_pass(n, repeats):
    stanza = {**PASS, "name": "p", "repeat": {"i": [1, repeats]}, "side_effect": True, "write": {"o": "ldr"}, "parameters": {"k": "i" + " + i" * n}}
    return {"g.json": graph({}, [stanza])}
