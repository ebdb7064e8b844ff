#!/usr/bin/env python3
"""`weft check` beyond text: JSON and SARIF say what the text says, --matrix and --all try the variations, --watch checks again after a save.

    check.py WEFT
"""
import collections
import contextlib
import json
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time

from program import SLOWER, TOP, Report, count_run, run, temporary_folder

BROKEN = "tests/bad_graphs/w040_unknown_resource.json"
SOUND = "tests/bad_graphs/w091_never_read.json"
GLOW = "graphs/glow.json"


def fields(diagnostic):
    return tuple(diagnostic.get(key) for key in ("file", "line", "column", "severity", "code", "message"))


def check_formats(weft, report):
    for graph in sorted((TOP / "tests/bad_graphs").glob("w0[0-9]*.json"))[::7] + [TOP / GLOW]:
        graph = str(graph.relative_to(TOP))
        text = run(weft, "check", "--no-shaders", graph)
        document = run(weft, "check", "--no-shaders", graph, "--format", "json")
        report.check(document.code == text.code and not document.err, f"{graph}: {document.code}\n{document.err}")
        data = json.loads(document.out)
        said = [(d["place"], int(d["line"] or 0), int(d["column"] or 0), d["severity"], d["code"]) for d in text.diagnostics]
        listed = [(d.get("file"), d.get("line", 0), d.get("column", 0), d["severity"], d["code"]) for d in data["diagnostics"]]
        report.check(said == listed, f"{graph}: text and JSON differ\n{said}\n{listed}")
        report.check(data["errors"] == sum(d["severity"] == "error" for d in text.diagnostics), f"{graph}: {data['errors']} errors")
        report.check(("plan" in data) == (text.code == 0), f"{graph}: {data.keys()}")

        sarif = json.loads(run(weft, "check", "--no-shaders", graph, "--format", "sarif").out)
        report.check(sarif["version"] == "2.1.0" and len(sarif["runs"]) == 1, f"{graph}: {sarif}")
        sarif_run = sarif["runs"][0]
        rules = [rule["id"] for rule in sarif_run["tool"]["driver"]["rules"]]
        report.check(rules == sorted(set(rules)), f"{graph}: rules {rules}")
        report.check([r["ruleId"] for r in sarif_run["results"]] == [d["code"] for d in data["diagnostics"]], f"{graph}: {sarif}")
        for result, diagnostic in zip(sarif_run["results"], data["diagnostics"]):
            report.check(rules[result["ruleIndex"]] == result["ruleId"], f"{graph}: {result}")
            report.check(result["level"] == diagnostic["severity"], f"{graph}: {result}")
            report.check(result["message"]["text"].startswith(diagnostic["message"]), f"{graph}: {result}")
            report.check("fix" not in diagnostic or diagnostic["fix"] in result["message"]["text"], f"{graph}: {result}")
            if "line" in diagnostic:
                place = result["locations"][0]["physicalLocation"]
                region = place["region"]
                report.check(region["startLine"] == diagnostic["line"] and region.get("startColumn") == diagnostic.get("column"), f"{graph}: {result}")
                report.check(place["artifactLocation"]["uri"] == diagnostic["file"], f"{graph}: {result}")


def check_words(weft, report):
    """Without OpenGL: what the words of the shaders tell, of the variant that is meant."""
    graph = "tests/bad_graphs/w183_image_format_of_a_variant.json"
    for arguments, code in ((["--set", "mode=a"], 0), (["--set", "mode=b"], 1)):
        done = run(weft, "check", "--no-shaders", graph, *arguments)
        report.check(done.code == code and done.codes() == ["W183"] * code, f"{arguments}: {done.code}\n{done.err}")
    every = run(weft, "check", "--no-shaders", graph, "--set", "mode=a", "--all")
    report.check(every.code == 1 and "(with --set mode=b)" in every.err, f"--all: {every.code}\n{every.err}")
    for graph in (GLOW, "graphs/studio_gi.json", "graphs/deferred_gi.json"):
        done = run(weft, "check", "--no-shaders", "--all", graph)
        report.check(done.code == 0 and not done.codes() and not done.codes("warning"), f"{graph}: {done.err}")
    # Instances of a stanza are looked at once, but passes that use one set are not instances of one pass.
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        (folder / "shaders").mkdir()
        (folder / "shaders/tint.frag.glsl").write_text("uniform sampler2D source;\nlayout(std140) uniform Parameters { float gain; };\nout vec4 result;\n"
                                                       "void main() { result = texelFetch(source, ivec2(0), 0) * gain; }\n")
        (folder / "sets.json").write_text("""{ "resources": { "a": { "texture": "rgba8", "size": 8, "clear": 1 }, "b": { "texture": "rgba8", "size": 8 }, "c": { "texture": "rgba8", "size": 8 } },
  "passes": [
    { "name": "one", "type": "fullscreen", "shader": "tint.frag.glsl", "read": { "source": "a" }, "write": { "result": "b" }, "parameters": { "gain": 2 } },
    { "name": "two", "type": "fullscreen", "shader": "tint.frag.glsl", "use": "tint", "write": { "result": "c" } },
    { "name": "three", "type": "fullscreen", "shader": "tint.frag.glsl", "use": "tint", "write": { "result": "c" }, "side_effect": true } ],
  "sets": { "tint": { "read": { "sauce": "b" }, "parameters": { "gane": 2 } } },
  "present": "c" }
""")
        done = run(weft, "check", "--no-shaders", folder / "sets.json")
        report.check(done.codes() == ["W181", "W182"], f"passes that use one set: {done.code}\n{done.err}")


def check_time(weft, report, *more):
    """A shader that reads the time, in passes that see none: told once for all repeats, and not of what only has the name."""
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        (folder / "shaders").mkdir()
        texts = {"moves": "float t() { return delta_time; }\nvoid main() { result = vec4(t()); }\n",
                 "seeds": "#define NOW frame\nvoid main() { result = vec4(float(NOW)); }\n",
                 "named": "float t(float time) { return time; }\nvoid main() { result = vec4(viewport, t(1.0), 1.0); }\n",
                 "still": "float unused() { return time; }\nvoid main() { result = vec4(viewport, 0.0, 1.0); }\n"}
        for stem, text in texts.items():
            (folder / f"shaders/{stem}.frag.glsl").write_text('#include "common/view.glsl"\nout vec4 result;\n' + text)
        (folder / "shaders/local.frag.glsl").write_text("out vec4 result;\nvoid main() { float time = 1.0; result = vec4(time); }\n")
        for shader, update, told in (("moves", "on_change", "delta_time"), ("moves", "once", "delta_time"), ("seeds", "once", "frame"), ("named", "once", None), ("still", "once", None),
                                     ("local", "once", None), ("moves", "always", None)):
            graph = folder / f"{shader}_{update}.json"
            graph.write_text(json.dumps({
                "resources": {"a": {"texture": "rgba8", "size": 8, "mips": 3}},
                "passes": [{"name": "draw", "type": "fullscreen", "shader": f"{shader}.frag.glsl", "update": update, "repeat": {"i": [0, 2]}, "write": {"result": "a.mip[i]"}, "side_effect": True}],
                "present": "a"}))
            done = run(weft, "check", graph, *more)
            report.check(done.code == 0 and done.codes("warning") == (["W083"] if told else []), f"{graph.name} {more}: {done.code}\n{done.err}")
            report.check(not told or f"its shader reads '{told}', which is 0 there" in done.err, f"{graph.name} {more}: {done.err}")


TONES = """{ "parameters": { "tone": { "default": "soft", "choices": ["soft", "hard"] } }, "resources": { "a": { "texture": "rgba8", "size": 8 }, "b": { "texture": "rgba8", "size": 8 } },
  "passes": [
    { "name": "one", "type": "fullscreen", "shader": "tone.frag.glsl", "write": { "result": "a" }, "defines": { "TONE": "$tone" } },
    { "name": "two", "type": "fullscreen", "shader": "tone.frag.glsl", "read": { "glow": "a" }, "write": { "result": "b" }, "defines": { "TONE": "$tone" } } ],
  "present": "b" }
"""
TONE = """out vec4 result;
#ifdef HAS_%s
uniform sampler2D glow;
#endif
void main() {
  result = vec4(0.0);
#if TONE == TONE_SOFT
  result += 1.0;
#elif TONE == TONE_%s
  result += 2.0;
#endif
#if defined(LATER) && LATER > 2
  result += 3.0;
#endif
}
"""


def check_conditions(weft, report):
    """Words of an #if that nothing defines are 0 to a compiler: told where they look misspelt, once for a shader and all its variants."""
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        (folder / "shaders").mkdir()
        (folder / "g.json").write_text(TONES)
        for slot, word, said in (("GLOW", "HARD", []), ("GLOW", "HRAD", ["9:15"]), ("Glow", "HARD", ["2:8"])):
            (folder / "shaders/tone.frag.glsl").write_text(TONE % (slot, word))
            for more in ([], ["--all"]):
                done = run(weft, "check", "--no-shaders", folder / "g.json", *more)
                places = [line.split(": warning[W187]")[0].split("glsl:")[1] for line in done.err.splitlines() if "warning[W187]" in line]
                report.check(done.code == 0 and places == said, f"{slot} {word} {more}: {done.code}\n{done.err}")
        report.check("did you mean 'HAS_GLOW'?" in done.err, done.err)


MANY = """{ "resources": { "maps": { "texture": "rgba8", "size": 4, "array": 17, "clear": 0 }, "a": { "texture": "rgba8" }, "b": { "texture": "rgba8" } },
  "passes": [ { "name": "many", "shader": "many.frag.glsl", "read": ["maps"], "write": { "one": "a", "other": "b" }, "side_effect": true } ], "present": "a" }
"""
SUM = """out vec4 one, other;
uniform sampler2D maps[17];
void main() {
  one = other = vec4(0.0);
  for (int i = 0; i < 17; ++i) one += texelFetch(maps[i], ivec2(0), 0);
}
"""


def check_device(weft, report):
    """What a pass needs beside what each device has: 17 samplers, of which OpenGL 4.5 guarantees 16 to a fragment shader."""
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        (folder / "g.json").write_text(MANY)
        (folder / "shaders").mkdir()
        (folder / "shaders/many.frag.glsl").write_text(SUM)
        done = run(weft, "check", folder / "g.json", "--device", "minimum")
        lines = [line.split() for line in done.out.splitlines() if " in 'many'" in line]
        report.check(["16", "fragment", "samplers", "17", "in", "'many',", "beyond"] in lines and ["8", "outputs", "2", "in", "'many'"] in lines, f"{done.code}\n{done.out}{done.err}")
        data = json.loads(run(weft, "check", folder / "g.json", "--device", "minimum", "--format", "json").out)["device"]
        done = run(weft, "check", folder / "g.json", "--device", "minimum", "--format", "sarif")
        report.check(done.code == 2 and "--format text or json" in done.err and not done.out, f"{done.code}\n{done.out}{done.err}")
        report.check({"what": "fragment samplers", "guaranteed": 16, "needed": 17, "pass": "many"} in data, f"{data}")


SILENT = """{ "parameters": { "shiny": { "default": false }, "tone": { "default": "soft", "choices": ["soft", "hard"] } },
  "resources": { "a": { "texture": "rgba8", "size": 8 }, "b": { "texture": "rgba8", "size": 8 } },
  "passes": [ { "name": "p", "type": "fullscreen", "shader": "p.frag.glsl", "side_effect": true, "write": { "result": "a", "other": "b" },
    "defines": { "SHINY": "$shiny", "TONE": "$tone" } } ], "present": "a" }
"""
QUIET = """out vec4 result, other;
#ifndef SHINY
#define SHINY 1
#endif
void both(float x) { result = other = vec4(x); }
void main() { both(SHINY == 1 || TONE == TONE_HARD ? 1.0 : 0.5); }
"""
LOUD = """out vec4 result, other;
#if TONE == TONE_HARD
#endif
void main() {
  result = vec4(0.5);
#ifdef SHINY
  result = vec4(1.0);
#endif
}
"""


def check_silent_words(weft, report):
    """What a shader ignores of its pass: an output that it never writes, a define that is 0 and asked for by #ifdef, and one that it does not have."""
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        (folder / "shaders").mkdir()
        for text, define, said in ((QUIET, "SHINY", []), (LOUD, "SHINY", ["W181", "W187"]), (QUIET, "SHINI", ["W187"])):
            (folder / "g.json").write_text(SILENT.replace('"SHINY"', f'"{define}"'))
            (folder / "shaders/p.frag.glsl").write_text(text)
            for options in (["--no-shaders"], ["--no-shaders", "--all"]):
                done = run(weft, "check", folder / "g.json", *options)
                report.check(done.code == 0 and sorted(done.codes("warning")) == said, f"{said} {options}: {done.code}\n{done.err}")
        report.check("did you mean 'SHINY'?" in done.err, done.err)


def check_scene_lists(weft, report):
    """Things of a scene that stand in no list that the graph draws are told, once, and by every command that shows the graph."""
    with temporary_folder() as name:
        scene = pathlib.Path(name, "scene.json")
        for lists, said in ((["transparent_spheres"], 1), (["spheres", "transparent_spheres"], 0), (["shadow_casters"], 0)):
            sphere = {"center": [0, 1, 0], "material": {"albedo": [1, 0, 0]}, "lists": lists}
            scene.write_text(json.dumps({"cameras": {"a": {"position": [0, 1, 10]}}, "spheres": [sphere]}))
            done = run(weft, "check", "--no-shaders", "graphs/studio.json", "--scene", scene)
            report.check(done.code == 0 and done.err.count("in the list 'transparent_spheres', which no pass of 'studio' draws") == said, f"{lists}: {done.err}")
            report.check(len(done.codes("warning")) == said, f"{lists}: {done.err}")


def check_off(weft, report):
    """Passes that are off are named: nobody has looked at their shaders. With --all only those that no switch turns on."""
    with temporary_folder() as name:
        graph = pathlib.Path(name, "g.json")
        graph.write_text(json.dumps({
            "parameters": {"more": {"default": False}}, "resources": {"a": {"texture": "rgba8", "size": [4, 4]}},
            "passes": [{"name": "fill", "shader": "a.frag.glsl", "write": {"result": "a"}},
                       {"name": "again", "shader": "a.frag.glsl", "write": {"result": "a"}, "enabled": "$more"},
                       {"name": "grow", "shader": "wrong.frag.glsl", "write": {"result": "a"}, "enabled": "size(a).x > 64"}],
            "present": "a"}))
        pathlib.Path(name, "shaders").mkdir()
        pathlib.Path(name, "shaders/a.frag.glsl").write_text("out vec4 result; void main() { result = vec4(1.0); }")
        pathlib.Path(name, "shaders/wrong.frag.glsl").write_text("out vec4 result; void main() { result = undeclared; }")
        for options, said in (([], "not looked at: 2 passes that are off, some of which --all switches on: again, grow"), (["--all"], "not looked at: 1 pass that is off with this scene: grow")):
            done = run(weft, "check", graph, *options)
            report.check(done.code == 0 and done.out.count(said) == 1 and done.out.count("not looked at") == 1, f"{options}: {done.code}\n{done.out}{done.err}")


def check_missing_shader(weft, report):
    """With --no-shaders a shader that is not there is no mistake, and not silent."""
    with temporary_folder() as name:
        graph = pathlib.Path(name, "g.json")
        graph.write_text(TONES)
        done = run(weft, "check", "--no-shaders", graph)
        report.check(done.code == 0 and done.out.count("not looked at: shader 'tone.frag.glsl' not found") == 1, f"{done.code}\n{done.out}{done.err}")
        done = run(weft, "check", "--no-shaders", graph, "--format", "json")
        report.check(done.code == 0 and json.loads(done.out)["not_looked_at"] == ["shader 'tone.frag.glsl' not found"], done.out)
        report.check("not looked at" not in run(weft, "check", "--no-shaders", GLOW).out, "a graph whose shaders are there")
        graph.write_text(TONES.replace('"glow": "a"', '"glow": "aa"'))
        report.check(run(weft, "check", "--no-shaders", graph).codes() == ["W040"], "an error of the graph makes one of its shaders")


def check_present(weft, report):
    """A pass in the place of a picture, on the command line as in a graph."""
    done = run(weft, "render", GLOW, "--size", "8x8", "--present", "glow_prefilter", "-o", "out/pass.png")
    report.check(done.code == 1 and "glow_prefilter" in done.err, f"--present of a pass: {done.code}\n{done.err}")


def check_strict(weft, report):
    codes = [run(weft, "check", SOUND, "--no-shaders", *more).code for more in ((), ("--strict",), ("--strict", "--format", "json"))]
    report.check(codes == [0, 1, 1], f"warnings with --strict: {codes}")


def check_shader(weft, report, *more):
    """A shader by itself: the stanza that is printed is one that the check of a graph takes."""
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        shaders = folder / "shaders"
        (shaders / "mix").mkdir(parents=True)
        shader = shaders / "mix/mix.frag.glsl"
        shader.write_text("uniform sampler2D one, other;\nlayout(std140) uniform Parameters { vec3 tint; bool on; };\nlayout(r32f) readonly uniform image2D grid;\n"
                          "in vec2 uv;\nout vec4 result;\nvoid main() {\n  result = texture(one, uv) * (on ? 1.0 : 0.5) * imageLoad(grid, ivec2(TILE)).r;\n"
                          "#ifdef HAS_OTHER\n  result += texture(other, uv);\n#endif\n  result.rgb *= tint;\n}\n")
        done = run(weft, "check", shader, "--format", "json", *more)
        stanza = json.loads(done.out)["stanza"]
        report.check(done.code == 0 and stanza["read"] == ["one", "other", "grid as image"] and stanza["write"] == ["result"], done.out)
        report.check(stanza["parameters"] == {"tint": [0, 0, 0], "on": False} and list(stanza["defines"]) == ["TILE"] and stanza["type"] == "fullscreen", done.out)
        textures = {name: {"texture": "r32f" if name == "grid" else "rgba8", "size": "screen", "clear": [0, 0, 0, 0]} for name in ("one", "other", "grid", "result")}
        (folder / "mix.json").write_text(json.dumps({"name": "mix", "resources": textures, "passes": [stanza], "present": "result"}))
        whole = run(weft, "check", folder / "mix.json", *more)
        report.check(whole.code == 0, f"the stanza in a graph: {whole.err}")
        shader.write_text(shader.read_text().replace("= tint;", "= tin;"))
        wrong = run(weft, "check", shader, *more)
        places = [(d["place"], int(d["line"]), d["code"]) for d in wrong.diagnostics]
        report.check(places == ([] if more else [(str(shader), 11, "W104")]), f"{places}")


def check_matrix(weft, report):
    result = run(weft, "check", "--no-shaders", GLOW, "--matrix", "--format", "json")
    matrix = json.loads(result.out)["matrix"]
    singles = [d for d in matrix["needed"] if d["with"].count("--disable") == 1]
    names = {d["with"] for d in singles}
    report.check(result.code == 0 and not matrix["broken"], f"matrix of {GLOW}: {matrix['broken']}")
    report.check(matrix["passes"] == 5 and "--disable composite" in names, f"{matrix}")
    free = matrix["passes"] - len(singles)
    report.check(matrix["pairs"] == free * (free - 1) // 2, f"{matrix}")
    report.check(matrix["values"] == 4, f"{matrix}")  # a switch, and the ends of a range
    # What it says of single passes is what --disable says.
    for needed in matrix["needed"]:
        alone = json.loads(run(weft, "check", "--no-shaders", GLOW, *needed["with"].split(), "--format", "json").out)
        report.check([fields(d) for d in alone["diagnostics"] if d["severity"] == "error"] == [fields(d) for d in needed["diagnostics"]], f"{needed}\n{alone}")

    with temporary_folder() as folder:
        graph = pathlib.Path(folder, "two_sources.json")
        graph.write_text(json.dumps({
            "parameters": {"part": {"type": "int", "default": 2, "min": 0, "max": 4}},
            "resources": {"a": {"texture": "rgba8", "size": 8}, "b": {"texture": "rgba8", "size": "8/$part"}, "hdr": ["a", "b"], "ldr": {"texture": "rgba8", "size": 8}},
            "passes": [{"name": name, "type": "fullscreen", "shader": "a.frag.glsl", "write": {"result": name}} for name in "ab"]
            + [{"name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "read": {"source": "hdr"}, "write": {"result": "ldr"}}],
            "present": "ldr"}))
        broken = run(weft, "check", "--no-shaders", graph, "--matrix")
        report.check(broken.code == 1 and "W024" in broken.codes(), f"a value that the file offers divides by zero: {broken.err}")
        report.check("with --set part=0" in broken.err and "needed: a or b: " in broken.out, broken.err + broken.out)
    studio = run(weft, "check", "--no-shaders", "graphs/studio.json", "--matrix")
    report.check(studio.code == 0 and "nothing else is refused" in studio.out, f"the matrix of the studio: {studio.err}")


def check_all(weft, report):
    few = json.loads(run(weft, "check", GLOW, "--format", "json").out)["shader_variants"]
    result = run(weft, "check", GLOW, "--all", "--format", "json")
    many = json.loads(result.out)
    report.check(result.code == 0 and many["shader_variants"] > few, f"--all compiles {many['shader_variants']} variants, without {few}")
    # A variant that only a parameter chooses: silent without --all.
    with temporary_folder() as folder:
        top = pathlib.Path(folder)
        (top / "shaders").mkdir()
        (top / "shaders/a.frag.glsl").write_text("out vec4 result;\nvoid main() {\n#if CURVE == CURVE_HARD\n  result = missing;\n#else\n  result = vec4(1.0);\n#endif\n}\n")
        graph = top / "curve.json"
        graph.write_text(json.dumps({
            "parameters": {"curve": {"type": "choice", "choices": ["soft", "hard"], "default": "soft"}},
            "resources": {"ldr": {"texture": "rgba8", "size": 8}},
            "passes": [{"name": "paint", "type": "fullscreen", "shader": "a.frag.glsl", "defines": {"CURVE": "$curve"}, "write": {"result": "ldr"}}],
            "present": "ldr"}))
        report.check(run(weft, "check", graph).code == 0, "the chosen variant is sound")
        found = run(weft, "check", graph, "--all")
        report.check(found.code == 1 and found.codes() == ["W104"] and "with --set curve=hard" in found.err, found.err)


def codes_until(process, wanted):
    """The codes of the first check that finds these, else of the last one. A save may be seen in two steps and checked twice."""
    codes = []
    while codes != wanted and (line := process.stdout.readline()):
        codes = sorted({d["code"] for d in json.loads(line)["diagnostics"]})
    return codes


@contextlib.contextmanager
def watching(weft, graph):
    """A check that goes on. One that never finds what is awaited is ended, and codes_until() gives what it found last."""
    count_run()
    process = subprocess.Popen([weft, "check", "--no-shaders", graph, "--watch", "--format", "json"], cwd=TOP, stdout=subprocess.PIPE, text=True)
    guard = threading.Timer(120 * SLOWER, process.kill)
    guard.start()
    try:
        yield process
    finally:
        guard.cancel()
        process.terminate()
        process.wait()


def check_watch(weft, report):
    broken = run(weft, "check", "--no-shaders", BROKEN).codes()
    report.check("W040" in broken, f"{broken}")

    def finds(process, wanted, when):
        found = codes_until(process, wanted)
        report.check(found == wanted, f"{when}: {found}")

    with temporary_folder() as folder:
        graph = pathlib.Path(folder, "graph.json")
        shutil.copy(TOP / BROKEN, graph)
        with watching(weft, graph) as process:
            finds(process, broken, "the broken graph")
            graph.write_text((TOP / SOUND).read_text())
            finds(process, ["W091"], "the sound one, written over it")
            # By renaming, as editors save.
            other = pathlib.Path(folder, "other.json")
            shutil.copy(TOP / BROKEN, other)
            other.rename(graph)
            finds(process, broken, "the broken one again, renamed")


def check_watch_from_the_start(weft, report):
    """A save while the first check runs is seen, wherever in that check it comes: the program is held up there."""
    for phase in range(30):
        with temporary_folder() as folder:
            graph = pathlib.Path(folder, "graph.json")
            shutil.copy(TOP / BROKEN, graph)
            with watching(weft, graph) as process:
                time.sleep(0.002 * phase)  # sweeps through the check; nothing is asked of when it comes
                process.send_signal(signal.SIGSTOP)
                graph.write_text((TOP / SOUND).read_text())
                process.send_signal(signal.SIGCONT)
                codes = codes_until(process, ["W091"])
                report.check(codes == ["W091"], f"{codes}")


def broken_chain(count):
    """As in tests/graph/expand/followers_test.cpp: pass i reads what pass i-1 wrote, and every tenth has a mistake, of five kinds in turn."""
    resources, passes = {"ldr": {"texture": "rgba8", "size": 8}}, []
    for i in range(count):
        mistake = i // 10 % 5 if i % 10 == 5 else None
        resources[f"r{i}"] = {"texture": "rgba9x" if mistake == 0 else "rgba8", "size": 8}
        source = f"nowhere{i}" if mistake == 1 else f"r{i - 1}"
        extra = {2: {"enabled": "$absent"}, 3: {"enabled": "soft"}, 4: {"repeat": {"k": [0, 0, 0]}}}.get(mistake, {})
        passes.append({"name": f"p{i}", "type": "fullscreen", "shader": "a.frag.glsl", **({"read": {"source": source}} if i else {}), "write": {"result": f"r{i}"}, **extra})
    passes.append({"name": "show", "type": "fullscreen", "shader": "a.frag.glsl", "read": {"source": f"r{count - 1}"}, "write": {"result": "ldr"}})
    return {"resources": resources, "passes": passes, "present": "ldr"}


def children_cpu():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def check_many_mistakes(weft, report):
    """1,000 passes with 100 mistakes: all 100, nothing that follows from them, in less than a second of processor time."""
    with temporary_folder() as folder:
        graph = pathlib.Path(folder, "chain.json")
        graph.write_text(json.dumps(broken_chain(1000), indent=1))
        (graph.parent / "shaders").mkdir()
        (graph.parent / "shaders/a.frag.glsl").write_text("uniform sampler2D source;\nout vec4 result;\nvoid main() { result = texelFetch(source, ivec2(0), 0); }\n")
        before = children_cpu()
        done = run(weft, "check", "--no-shaders", graph, "--format", "json", stdin=subprocess.DEVNULL)  # a child of this process, not of a fork server
        seconds = children_cpu() - before
        said = json.loads(done.out)["diagnostics"]
        codes = collections.Counter(d["code"] for d in said)
        report.check(done.code == 1 and codes == {"W042": 20, "W040": 20, "W022": 20, "W051": 20, "W048": 20}, f"{done.code}, {codes}")
        report.check(seconds < SLOWER, f"{seconds:.2f} s of processor time")
        print(f"1,000 passes with 100 mistakes: {seconds * 1000:.0f} ms of processor time")


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    if "--gl" in sys.argv:
        check_all(weft, report)
        check_off(weft, report)
        check_present(weft, report)
        check_device(weft, report)
        check_time(weft, report)
        check_shader(weft, report)
    else:
        check_formats(weft, report)
        check_words(weft, report)
        check_time(weft, report, "--no-shaders")
        check_conditions(weft, report)
        check_silent_words(weft, report)
        check_scene_lists(weft, report)
        check_missing_shader(weft, report)
        check_matrix(weft, report)
        check_strict(weft, report)
        check_shader(weft, report, "--no-shaders")
        check_many_mistakes(weft, report)
        check_watch(weft, report)
        check_watch_from_the_start(weft, report)
    report.end()


main()
