#!/usr/bin/env python3
"""Files of strangers: what Weft opens, what it prints, and how long it takes. Pipes wherever a path may stand; every way out of a
folder that reading is confined to, with the same answer whether or not there is a file; text that tries to forge messages; many
wrong names; many messages. A run that hangs is ended by its limit, and is a failure; nothing else is timed.

    files.py WEFT [--cache] [--sanitized]
"""
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import threading

from program import MEMORY_BYTES, SLOWER, TOP, Report, count_run, run, sanitizers, temporary_folder

LIMIT = 600 * SLOWER  # seconds; far beyond what any of these takes
SHADER = "out vec4 result;\nvoid main() { result = vec4(1); }\n"


TABLE_SHADER = "uniform sampler3D table;\nout vec4 result;\nvoid main() { result = texelFetch(table, ivec3(0), 0); }\n"


def graph(shader="good.frag.glsl", passes=(), name="g", **more):
    own = {"name": "paint", "type": "fullscreen", "shader": shader, "write": {"result": "ldr"}}
    return {"name": name, "resources": {"ldr": {"texture": "rgba8", "size": "screen"}}, "passes": [own, *passes], "present": "ldr", **more}


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text if isinstance(text, str) else json.dumps(text, indent=1))
    return path


def table(path):
    """Only a frame reads it: a graph to be rendered, whose shader is TABLE_SHADER."""
    return {"parameters": {"lut": {"type": "file", "default": path}},
            "resources": {"ldr": {"texture": "rgba8", "size": "screen"}, "table": {"import": "cube_lut", "file": "$lut"}},
            "passes": [{"name": "paint", "type": "fullscreen", "shader": "table.frag.glsl", "read": {"table": "table"}, "write": {"result": "ldr"}}],
            "present": "ldr"}


def command_for(file):
    """That reads everything there is behind a graph."""
    name = pathlib.Path(file)
    return ["render", file, "--size", "8x8", "--program-cache", "none", "-o", "never.png"] if "table" in name.name else ["check", file]


def limited(weft, *arguments, **options):
    done = run(weft, *arguments, timeout=LIMIT, **options)
    return None if done.code is None else done


def pipes(weft, folder, report):
    pipe = folder / "pipe"
    os.mkfifo(pipe)
    os.mkfifo(folder / "pipe.json")
    os.mkfifo(folder / "pipe.cube")
    (folder / "shaders").mkdir()
    os.mkfifo(folder / "shaders/pipe.frag.glsl")
    write(folder / "shaders/good.frag.glsl", SHADER)
    write(folder / "shaders/includes.frag.glsl", '#include "../pipe"\n' + SHADER)
    write(folder / "shaders/includes_folder.frag.glsl", '#include "parts"\n' + SHADER)
    (folder / "shaders/parts").mkdir()
    write(folder / "include.json", graph(passes=[{"include": "pipe.json"}]))
    write(folder / "extends.json", {"extends": "pipe.json"})
    write(folder / "shader.json", graph("pipe.frag.glsl"))
    write(folder / "shader_include.json", graph("includes.frag.glsl"))
    write(folder / "folder_include.json", graph("includes_folder.frag.glsl"))
    write(folder / "good.json", graph())
    write(folder / "library.json", {"library": "pipe.json"})
    write(folder / "shaders/table.frag.glsl", TABLE_SHADER)
    write(folder / "table.json", table("pipe.cube"))
    device = write(folder / "device.json", graph(passes=[{"include": "/dev/zero"}]))
    cases = [("include.json", [], "W001"), ("extends.json", [], "W001"), ("shader.json", [], "W100"), ("good.json", ["--scene", "library.json"], "W001"),
             ("shader_include.json", [], "W101"), ("folder_include.json", [], "W101"), ("table.json", [], "W001"), (device.name, [], "W001")]
    for name, arguments, code in cases:
        done = limited(weft, *command_for(name), *arguments, folder=folder)
        if report.check(done, f"{name}: hangs"):
            report.check(done.code == 1 and done.codes() == [code], f"{name}: {done.code} {done.codes()}\n{done.err}")
            kind = {"folder_include.json": "it is a directory", device.name: "it is a device"}.get(name, "it is a pipe")
            report.check(kind in done.err, f"{name}: not said what it is\n{done.err}")
    # The command line may name a pipe, once: also where it is read a second time after an error.
    for text, expected in ((graph(), 0), (graph("no_such.frag.glsl"), 1)):
        writer = threading.Thread(target=lambda: pipe.write_text(json.dumps(text)), daemon=True)
        writer.start()
        done = limited(weft, "check", pipe, folder=folder)
        if report.check(done, "a graph through a pipe: hangs"):
            report.check(done.code == expected and "pipe, which" not in done.err, f"a graph through a pipe: {done.code}\n{done.err}")
        writer.join(LIMIT)
    count_run()
    command = f"exec {shlex.quote(str(weft))} plan <(cat {shlex.quote(str(folder))}/good.json)"
    done = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True, timeout=LIMIT)
    report.check(done.returncode == 0 and "plan g" in done.stdout, f"plan <(generate): {done.returncode}\n{done.stderr}")


def large(weft, folder, report):
    """Three gigabytes, of which a file system keeps nothing, wherever a path may stand: refused before they fill the memory."""
    for name in ("large.json", "large.cube", "shaders/large.frag.glsl", "shaders/large.glsl"):
        write(folder / name, "{}")
        os.truncate(folder / name, 3 << 30)
    # 6 Mi vertices of 0.4 kB: an accessor without a buffer view is zeros.
    write(folder / "large.gltf", {"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                                  "accessors": [{"componentType": 5126, "count": 6291450, "type": "VEC3"}]})
    write(folder / "shaders/good.frag.glsl", SHADER)
    write(folder / "shaders/includes.frag.glsl", '#include "large.glsl"\n' + SHADER)
    write(folder / "shaders/table.frag.glsl", TABLE_SHADER)
    write(folder / "good.json", graph())
    write(folder / "include.json", graph(passes=[{"include": "large.json"}]))
    write(folder / "extends.json", {"extends": "large.json"})
    write(folder / "shader.json", graph("large.frag.glsl"))
    write(folder / "shader_include.json", graph("includes.frag.glsl"))
    write(folder / "library.json", {"library": "large.json"})
    write(folder / "table.json", table("large.cube"))
    cases = [("large.json", [], "W201"), ("include.json", [], "W201"), ("extends.json", [], "W201"), ("shader.json", [], "W203"),
             ("shader_include.json", [], "W103"), ("table.json", [], "W201"), ("good.json", ["--preset", "large.json"], "W201"),
             ("good.json", ["--scene", "large.json"], "W201"), ("good.json", ["--scene", "library.json"], "W201"),
             ("good.json", ["--materials", "large.json"], "W201"), ("good.json", ["--scene", "large.gltf"], "W164")]
    for name, arguments, code in cases:
        count_run()
        with open(folder / "said.txt", "w+") as said:
            process = subprocess.Popen([weft, *command_for(name), *arguments], cwd=folder, stdout=said, stderr=said)
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            said.seek(0)
            text = said.read()
        what = f"{name} {arguments}: {process.returncode}, {used.ru_maxrss >> 10} MiB\n{text}"
        report.check(process.returncode == 1 and f"error[{code}]" in text and "large" in text, what)
        report.check(used.ru_maxrss << 10 < MEMORY_BYTES, what)


def program_cache(weft, folder, report):
    """A cache whose files became pipes: misses, and nothing is written into them."""
    cache = folder / "cache"
    write(folder / "shaders/good.frag.glsl", SHADER)
    write(folder / "good.json", graph())
    render = ["render", "good.json", "--size", "16x16", "--program-cache", cache, "--stats", "-o", "a.png"]
    first = limited(weft, *render, folder=folder)
    if first is None or first.code != 0:
        return report.check(False, f"a first run: {first and first.err or 'hangs'}")
    if not list(cache.glob("*.bin")):
        report.skip("the driver gives no program binaries")
    for binary in cache.glob("*.bin"):
        binary.unlink()
        os.mkfifo(binary)
    done = limited(weft, *render, folder=folder)
    report.check(done and done.code == 0, f"a cache of pipes: {done and done.err or 'hangs'}")


def confinement(weft, folder, report):
    inside, outside = folder / "pr", folder / "out"
    write(inside / "shaders/good.frag.glsl", SHADER)
    write(inside / "shaders/table.frag.glsl", TABLE_SHADER)
    write(inside / "graph.json", graph())
    write(inside / "below/included.json", {"passes": []})
    outside.mkdir()
    (inside / "link_out").symlink_to(outside)

    def check(file, *arguments):
        return limited(weft, *command_for(file), "--confine", "pr", *arguments, folder=folder)

    good = write(inside / "good.json", graph(passes=[{"include": "below/included.json"}]))
    done = check("pr/good.json")
    report.check(done and done.code == 0, f"confined, a good graph: {done and done.err}")
    done = check(str(TOP / "graphs/studio.json"))
    report.check(done and done.code == 0, f"confined, a bundled graph: {done and done.err}")
    done = check("pr/good.json", "--preset", "cinema")
    report.check(done and "W200" not in done.codes(), f"confined, a bundled preset: {done and done.err}")

    ways = {"up": "../out/{}", "absolute": f"{outside}/{{}}", "link": "link_out/{}", "around": "below/../../out/{}"}
    shader_ways = {"up": "../../out/{}", "absolute": f"{outside}/{{}}", "link": "../link_out/{}"}
    kinds = {}
    for way, path in ways.items():
        kinds[f"include {way}"] = (path, "secret.json", lambda p: graph(passes=[{"include": p}]), [])
        kinds[f"extends {way}"] = (path, "secret.json", lambda p: {"extends": p}, [])
        kinds[f"table {way}"] = (path, "x.cube", table, ["table"])
        kinds[f"library {way}"] = (path, "m.json", lambda p: {"library": p}, ["scene"])
    for way, path in shader_ways.items():
        kinds[f"shader {way}"] = (path, "x.frag.glsl", lambda p: graph(p), [])
        kinds[f"#include {way}"] = (path, "x.glsl", lambda p: graph("includes.frag.glsl"), ["shader"])
    for kind, (path, name, make, how) in kinds.items():
        answers = []
        for there in (True, False):
            target = outside / name
            target.unlink(missing_ok=True)
            (outside / (name + "x")).write_text("near by")
            if there:
                target.write_text(SHADER if name.endswith("glsl") else '{ "passes": [] }')
            named = path.format(name)
            if "shader" in how:
                write(inside / "shaders/includes.frag.glsl", f'#include "{named}"\n{SHADER}')
            file = write(inside / ("table.json" if "table" in how else "hostile.json"), make(named))
            arguments = ["pr/graph.json", "--scene", f"pr/{file.name}"] if "scene" in how else [f"pr/{file.name}"]
            done = check(*arguments)
            if not report.check(done, f"{kind}: hangs"):
                break
            answers.append(done.err)
            report.check(done.code == 1 and done.codes() == ["W200"], f"{kind}, {there}: {done.code} {done.codes()}\n{done.err}")
            report.check(all(d["line"] for d in done.diagnostics if d["code"] == "W200"), f"{kind}: no place\n{done.err}")
            report.check("'pr'" in done.err and "--confine FOLDER" in done.err and name + "x" not in done.err, f"{kind}: {done.err}")
        report.check(len(set(answers)) == 1, f"{kind}: the answer tells whether the file is there\n{answers}")
    # Not even that a link leads back in is reported.
    (outside / "back.json").symlink_to(inside / "back.json")
    write(inside / "back.json", graph(passes=[{"include": "../out/back.json"}]))
    done = check("pr/back.json")
    report.check(done and done.codes() == ["W200"], f"a link outside that leads back: {done and done.err}")
    # What the person named is free.
    write(outside / "shaders/good.frag.glsl", SHADER)
    own = write(outside / "own.json", graph(shader=str(inside / "shaders/good.frag.glsl")))
    done = check(own)
    report.check(done and done.code == 0, f"a graph outside that the command line names: {done and done.err}")
    done = limited(weft, "check", "--confine", "no_such", good, folder=folder)
    report.check(done and done.code == 2 and "no_such" in done.err, f"a folder that is not there: {done and done.err}")
    done = limited(weft, "check", write(inside / "free.json", graph(passes=[{"include": "../out/secret.json"}])), folder=folder)
    report.check(done and "W200" not in done.err, f"without --confine: {done and done.err}")


EVIL = "x\nother.json:1:1: error[W001]: forged\x1b[2J\u009b31m\u202e"


def harmless(stream):
    bad = any((ord(c) < 32 and c != "\n") or 0x7F <= ord(c) < 0xA0 or c in "\u202e\u2066" for c in stream)
    return not bad and "\nother.json" not in stream and not stream.startswith("other.json")


def forgery(weft, folder, report):
    write(folder / "shaders/good.frag.glsl", SHADER)
    write(folder / "shaders/error.frag.glsl", "#error forged \x1b[2J\x9b\n" + SHADER)
    files = {
        "type.json": {**graph(), "passes": [{"name": "p", "type": EVIL, "write": {"r": "ldr"}}]},
        "resource.json": {**graph(), "resources": {EVIL: {"texture": "rgba8"}}},
        "path.json": graph(EVIL),
        "include.json": graph(passes=[{"include": EVIL}]),
        "error.json": graph("error.frag.glsl"),
        "key.json": {**graph(), EVIL: 1},
        EVIL.replace("/", "") + ".json": {"passes": 1},
        "plan.json": graph(name=EVIL, parameters={"a": {"type": "float", "default": 1, "label": EVIL, "doc": EVIL}}),
        "choice.json": graph(parameters={"a": {"type": "choice", "choices": [EVIL, "b"], "default": EVIL}}),
    }
    for name, text in files.items():
        write(folder / name, text)
        for command in (["check"], ["plan", "--explain"], ["plan", "--format", "json"], ["dot"], ["params"], ["params", "--json"]):
            done = limited(weft, *command, name, folder=folder)
            if not report.check(done, f"{command} {name!r}: hangs"):
                continue
            for stream in (done.out, done.err):
                report.check(harmless(stream), f"{command} {name!r}: {stream[:600]!r}")
            if "json" in command[-1] and done.code == 0:
                json.loads(done.out)
    # What the command line itself says wrong.
    wrong = [["check", EVIL], [EVIL], ["check", "type.json", "--" + EVIL], ["check", "type.json", EVIL], ["check", "plan.json", "--set", EVIL], ["check", "plan.json", "--set", EVIL + "=1"],
             ["check", "plan.json", "--set", "a=" + EVIL], ["check", "plan.json", "--disable", EVIL], ["check", "plan.json", "--size", EVIL],
             ["check", "plan.json", "--preset", EVIL], ["check", "plan.json", "--preset", "./" + EVIL], ["check", "plan.json", "--limit", EVIL], ["check", "plan.json", "--confine", EVIL],
             ["check", "plan.json", "--scene", EVIL], ["check", "plan.json", "--camera", EVIL], ["check", "plan.json", "--materials", EVIL],
             ["render", "plan.json", "--backend", EVIL, "-o", "a.png"], ["render", "plan.json", "--frames", EVIL, "-o", "a.png"],
             ["render", "plan.json", "--fps", EVIL, "-o", "a.png"], ["render", "plan.json", "-o", EVIL],
             ["render", "plan.json", "--environment", EVIL, "-o", "a.png"], ["render", "plan.json", "--environment", EVIL + ".hdr", "-o", "a.png"],
             ["view", "plan.json", "--panels", EVIL]]
    for arguments in wrong:
        done = limited(weft, *arguments, folder=folder)
        if report.check(done, f"{arguments}: hangs"):
            report.check(done.code in (1, 2) and done.err, f"{arguments}: {done.code}")
            report.check(not done.out and harmless(done.err), f"{arguments}: prints {done.out!r} {done.err!r}")
    # Statistics with a name that is no UTF-8 in them.
    count_run()
    done = subprocess.run([os.fsencode(weft), b"render", b"plan.json", b"--size", b"8x8", b"--stats", b"--program-cache", b"none", b"-o", b"\xff\x9b.png"],
                          cwd=folder, capture_output=True, timeout=LIMIT)
    report.check(done.returncode == 0, f"a picture whose name is no UTF-8: {done.returncode} {done.stderr!r}")
    stats = done.stderr.decode()
    report.check("outputs" in json.JSONDecoder().raw_decode(stats[stats.index("{"):])[0], "--stats is no JSON")


def many(weft, folder, report):
    """What took from seconds to minutes: the limit of the run is what fails."""
    names = [f"resource_{i * 7919}" for i in range(1000)]
    resources = {name: {"texture": "rgba8", "size": "screen"} for name in [*names, "ldr"]}
    passes = [{"name": f"p{i}", "type": "fullscreen", "shader": "good.frag.glsl", "read": {"a": name.replace("resource", "ressource")},
               "write": {"result": "ldr"}} for i, name in enumerate(names)]
    write(folder / "shaders/good.frag.glsl", SHADER)
    write(folder / "names.json", {"resources": resources, "passes": passes, "present": "ldr"})
    done = limited(weft, "check", "names.json", "--no-shaders", folder=folder)
    report.check(done and done.code == 1 and "did you mean 'resource_0'?" in done.err, f"1,000 misspelt names: {done and done.err[:500]}")
    if done:
        # A note counts what is left out, and says that after a thousand errors no more were looked for.
        report.check(len(done.diagnostics) == 101 and done.diagnostics[-1]["code"] == "W208" and "no more were looked for" in done.err,
                     f"{len(done.diagnostics)} messages")
        report.check(len(done.err) < 100_000, f"{len(done.err)} bytes of messages")
        more = limited(weft, "check", "names.json", "--no-shaders", "--limit", "64", folder=folder)
        report.check(more and len(more.diagnostics) >= 1000 and "messages are left out" not in more.err, "--limit diagnostics does not raise it")
    # Errors are not hidden behind warnings: 300 culled passes are reported before the one error behind them in the file.
    culled = [{"name": f"c{i}", "type": "fullscreen", "shader": "good.frag.glsl", "write": {"result": "spare"}} for i in range(300)]
    write(folder / "culled.json", {"resources": {"ldr": resources["ldr"], "spare": resources["ldr"]},
                                   "passes": [*culled, {"name": "last", "type": "fullscreen", "shader": "none.frag.glsl", "write": {"result": "ldr"}}],
                                   "present": "ldr"})
    done = limited(weft, "check", "culled.json", folder=folder)
    report.check(done and done.code == 1 and done.codes() == ["W100"] and done.codes("note") == ["W208"],
                 f"errors behind warnings: {done and (done.code, done.codes(), done.codes('note'))}")

    materials = [{"name": f"material {i * 7919}", "albedo": [1, 1, 1], "metallic": 0, "roughness": 1} for i in range(3000)]
    spheres = [{"center": [i, 0, 0], "radius": 1, "material": f"unknown thing {i}"} for i in range(3000)]
    write(folder / "materials.json", materials)
    write(folder / "scene.json", {"library": "materials.json", "spheres": spheres})
    write(folder / "good.json", graph())
    done = limited(weft, "check", "good.json", "--no-shaders", "--scene", "scene.json", folder=folder)
    report.check(done and done.codes() == ["W161"], f"3,000 unknown materials: {done and done.err[:500]}")

    write(folder / "key.json", {**graph(), "k" * 10_485_760: 1})
    done = limited(weft, "check", "key.json", "--no-shaders", folder=folder)
    report.check(done and done.codes() == ["W201"] and "10485760 bytes" in done.err, f"a key of 10 MB: {done and done.err[:500]}")

    for i in range(200):
        write(folder / f"shaders/f{i}/a.frag.glsl", SHADER)
    write(folder / "missing.json", graph(passes=[{"name": f"m{i}", "type": "fullscreen", "shader": f"f{i % 200}/b.frag.glsl", "write": {"result": "ldr"}}
                                                 for i in range(1000)], present="none"))  # else only what runs is looked at
    done = limited(weft, "check", "missing.json", "--limit", "64", folder=folder)
    hints = done.err.count("a.frag.glsl'?") if done else 0
    report.check(done and "W100" in done.codes() and hints >= 1000, f"1,000 missing shaders: {hints} hints\n{done and done.err[:800]}")


def models(weft, folder, report):
    """Files on which Assimp 5.2.5 dies, or takes gigabytes: one message each, and nothing of them is left."""
    for path in sorted((TOP / "tests/app/hostile/models").glob("*.fbx")):
        shutil.copy(path, folder)
        done = limited(weft, "check", str(TOP / "graphs/deferred.json"), "--no-shaders", "--scene", path.name, folder=folder)
        # Assimp frees a key's value twice: its own fault, in a process of its own, and what the file is here for.
        sanitizers.expect(r"double-free on [^\n]*\n +#0 [^\n]*weft-fbx\+[^\n]*\n +#1 [^\n]*libassimp\.so")
        report.check(done and done.code == 1 and done.codes() == ["W164"], f"{path.name}: {done and (done.code, done.err[:500])}")


def links(weft, folder, report):
    """What a command fills by a name of its own is never a link that a stranger left."""
    (folder / "strangers").mkdir()
    write(folder / "victim", "precious")
    write(folder / "strangers/good.json", graph())
    write(folder / "strangers/shaders/good.frag.glsl", SHADER)
    write(folder / "strangers/a.cases.json", {"cases": [{"name": "p", "graph": "good.json", "plan": True}]})
    write(folder / "a.fs", '/*{ "INPUTS": [{ "NAME": "level", "TYPE": "float", "DEFAULT": 0.5 }], "CREDIT": "me", "CREDIT": "I" }*/\n'
          "void main() { gl_FragColor = vec4(level); }\n")
    for what, link, to, arguments in (("a golden", "strangers/p.txt", "../victim", ["test", "strangers", "--accept", "--confine", "strangers"]),
                                      ("a graph", "made/a.json", "../victim", ["import", "a.fs", "-o", "made", "--overwrite"]),
                                      ("a folder", "made/shaders", "..", ["import", "a.fs", "-o", "made", "--overwrite"])):
        (folder / link).parent.mkdir(exist_ok=True)
        (folder / link).symlink_to(to)
        done = run(weft, *arguments, folder=folder)
        kept = (folder / "victim").read_text() == "precious" and not (folder / "a").exists()
        report.check(done.code in (1, 2) and "W180" in done.codes() and kept, f"{what} that is a link: {done.code}, {kept}\n{done.err}")
        (folder / link).unlink()
    done = run(weft, "import", "a.fs", "-o", "made", folder=folder)
    report.check(done.code == 0 and done.codes() == [] and "warning[W006]" in done.err, f"a key that stands twice: {done.code}\n{done.err}")
    write(folder / "large.fs", '/*{ "INPUTS": [], "PASSES": [{ "TARGET": "t", "WIDTH": "$WIDTH", "HEIGHT": "4294967295" }, {}] }*/\n'
          "void main() { gl_FragColor = vec4(1.0); }\n")
    done = run(weft, "import", "large.fs", "-o", "made", folder=folder)
    report.check(done.code == 1 and "W048" in done.codes(), f"import of what check refuses: {done.code}\n{done.err}")


def main():
    weft, report = os.path.abspath(sys.argv[1]), Report()
    for part in [program_cache] if "--cache" in sys.argv else (pipes, large, confinement, forgery, many, models, links):
        with temporary_folder() as name:
            part(weft, pathlib.Path(name), report)
    report.end()


main()
