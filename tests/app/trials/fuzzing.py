"""`weft fuzz` of graphs whose mistakes are known, and these graphs; for trials.py."""
import re

from program import TOP, run

SIZE = "64x36"
GLOW = str(TOP / "graphs/glow.json")
HALF = """{ "resources": { "picture": { "texture": "rgba16f", "size": "screen" }, "ldr": { "texture": "rgba8", "size": "screen" } },
  "passes": [
    { "name": "half", "type": "fullscreen", "shader": "half.frag.glsl", "write": { "result": "picture" } },
    { "name": "show", "type": "fullscreen", "shader": "show.frag.glsl", "read": { "source": "picture" }, "write": { "result": "ldr" } } ],
  "present": "ldr" }"""
HALF_SHADERS = {"half.frag.glsl": "in vec2 uv;\nout vec4 result;\nvoid main() { if (uv.y > 0.5) discard; result = vec4(uv, 0.5, 1.0); }\n",
                "show.frag.glsl": "uniform sampler2D source;\nout vec4 result;\n"
                                  "void main() { vec4 c = texelFetch(source, ivec2(gl_FragCoord.xy), 0); result = c.r >= 0.0 && c.r < 9.0 ? c : vec4(1.0); }\n"}
# Two passes add to a buffer by a slot that says `read`.
ORDER = """{ "resources": { "sum": { "buffer": 16 }, "a": { "buffer": 16 }, "b": { "buffer": 16 }, "ldr": { "texture": "rgba8", "size": "screen" } },
  "passes": [
    { "name": "begin", "type": "compute", "shader": "begin.comp.glsl", "threads": 1, "write": { "total": "sum" } },
    { "name": "add", "type": "compute", "shader": "add.comp.glsl", "threads": 1, "read": { "total": "sum" }, "write": { "done": "a" } },
    { "name": "double", "type": "compute", "shader": "double.comp.glsl", "threads": 1, "read": { "total": "sum" }, "write": { "done": "b" } },
    { "name": "show", "type": "fullscreen", "shader": "show.frag.glsl", "read": { "total": "sum", "one": "a", "two": "b" }, "write": { "result": "ldr" } } ],
  "present": "ldr" }"""
COMPUTE = "layout(local_size_x = 1) in;\nlayout(std430) %sbuffer total { float value[4]; };\n"
ORDER_SHADERS = {"begin.comp.glsl": COMPUTE % "" + "void main() { for (int i = 0; i < 4; ++i) value[i] = 0.25; }\n",
                 "add.comp.glsl": COMPUTE % "" + "layout(std430) buffer done { float ready[4]; };\nvoid main() { value[0] += 0.1; for (int i = 0; i < 4; ++i) ready[i] = 0.0; }\n",
                 "double.comp.glsl": COMPUTE % "" + "layout(std430) buffer done { float ready[4]; };\nvoid main() { value[0] *= 2.0; for (int i = 0; i < 4; ++i) ready[i] = 0.0; }\n",
                 "show.frag.glsl": "layout(std430) buffer total { float value[4]; };\nlayout(std430) buffer one { float first[4]; };\nlayout(std430) buffer two { float second[4]; };\n"
                                   "out vec4 result;\nvoid main() { result = vec4(vec3(value[0] + first[0] + second[0]), 1.0); }\n"}


def write_graph(folder, name, graph, shaders):
    (folder / name / "shaders").mkdir(parents=True)
    (folder / name / "graph.json").write_text(graph)
    for shader, text in shaders.items():
        (folder / name / "shaders" / shader).write_text(text)
    return folder / name / "graph.json"


def check_fuzz(weft, report, folder):
    for graph in (GLOW, TOP / "tests/golden/vignette.json"):
        result = run(weft, "fuzz", graph, "--size", SIZE, "--runs", "2")
        report.check(result.code == 0 and "12 runs of" in result.out and "every picture is the same" in result.out, f"{graph}: {result.out}{result.err}")
    # A pass that promises to write everything and writes half of it.
    half = write_graph(folder, "half", HALF, HALF_SHADERS)
    result = run(weft, "fuzz", half, "--size", SIZE, "--runs", "1")
    report.check(result.code == 1 and "pass 'half' writes another 'picture'" in result.out and "--poison nan" in result.out, result.out + result.err)
    repeat_it(weft, report, result, half)
    (half.parent / "shaders/half.frag.glsl").write_text(HALF_SHADERS["half.frag.glsl"].replace("if (uv.y > 0.5) discard; ", ""))
    half.write_text(HALF.replace('"present": "ldr"', '"present": "picture"'))
    result = run(weft, "fuzz", half, "--size", SIZE, "--seed", "0", "--share", "on", "--poison", "nan")
    report.check(result.code == 0 and result.out == "1 run of 1 pass in 1 order: every picture is the same\n", result.out + result.err)
    # Passes that depend on each other without saying so are not drawn at all.
    result = run(weft, "fuzz", write_graph(folder, "order", ORDER, ORDER_SHADERS), "--size", SIZE, "--runs", "6")
    report.check(result.code == 2 and "'total' is read, and the shader 'double.comp.glsl' may write it" in result.err, f"{result.code}: {result.out}{result.err}")


def repeat_it(weft, report, result, graph):
    options = re.search(r"repeat: the same command with (.*)", result.out)
    if report.check(options, result.out):
        again = run(weft, "fuzz", graph, "--size", SIZE, *options[1].split())
        report.check(again.code == 1 and again.out.splitlines()[0] == result.out.splitlines()[0], f"{options[1]}: {again.code}\n{again.out}{again.err}")
