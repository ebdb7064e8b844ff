#!/usr/bin/env python3
"""Shaders that kill a driver, take all memory or keep it busy for minutes: each is reported with its place, by `weft check` and
within a guard of processor time and memory; the viewer over whose shader one is saved keeps its last good picture and goes on,
and leaves no process behind. shaders.py WEFT COMPARE [--sanitized]. Nothing is timed but by the guard."""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

from program import DIAGNOSTIC, MEMORY_BYTES, SANITIZED, SLOWER, TOP, Report, count_run, run, sanitizers, temporary_folder
from window import Session, copy_of_tree, inside_display, save

SECONDS = 60 * SLOWER  # of processor time, of a command and what it starts
UNBOUND = ("--limit", "64")


def main_of(body, before=""):
    return f"in vec2 uv;\nout vec4 result;\n{before}void main() {{\n  float a = uv.x;\n  {body}\n}}\n"


def chain(line, count):
    return "".join(line.replace("$", str(i)).replace("%", str(i - 1)) + "\n" for i in range(1, count + 1))


SUM = main_of("result = vec4(" + "a + " * 100000 + "a);")
CASES = "\n".join(f"case {i}: result = vec4({i}.0); break;" for i in range(5000))
DOUBLE = "float f0(float x) { return x * uv.y; }\n" + chain("float f$(float x) { return f%(x) + f%(x + 1.0); }", 24)
CALLS = "float f0(float x) { return x * uv.y; }\n" + chain("float f$(float x) { return f%(x) + 1.0; }", 3000)
SINES = main_of("\n".join(f"a = sin(a) * uv.y + {i}.5;" for i in range(12000)) + "result = vec4(a);")
# name, shader, code, place behind the file's name, options
HOSTILE = [
    ("a sum", SUM, "W203", ":5:3", ()),
    ("brackets", main_of("result = vec4(" + "(" * 20000 + "a" + ")" * 20000 + ");"), "W203", ":5:3", ()),
    ("a macro that doubles", main_of("result = vec4(M24);", "#define M0 a\n" + chain("#define M$ M% + M%", 24)), "W203", ":30:3", ()),
    ("a macro that doubles nothing", main_of("M24()", "#define M0(x) x\n" + chain("#define M$(x) M%(x)M%(x)", 24)), "W204", "", ()),
    ("functions that double", main_of("result = vec4(f24(a));", DOUBLE), "W204", "", ()),
    ("a chain of calls", main_of("result = vec4(f3000(a));", CALLS), "W204", "", ()),
    ("a switch", main_of("switch (int(uv.x * 1e5)) {\n" + CASES + "}"), "W204", "", ()),
    ("an array", main_of("float b[100000];\n  b[int(uv.x * 1e5)] = a;\n  result = vec4(b[int(uv.y * 1e5)]);"), "W204", "", ()),
    ("two megabytes", main_of("result = vec4(a);", "// nothing\n" * 200000), "W203", "", ()),
    ("a circle", main_of("result = vec4(f(a));", "float g(float x);\nfloat f(float x) { return g(x); }\nfloat g(float x) { return f(x); }\n"),
     "W104", ":[34]:7", ()),
    ("a zero byte", main_of("result = vec4(a);\0"), "W104", ":5:20", ()),
    # What bounds do not catch, the process that tries it does.
    ("a sum without bounds", main_of("result = vec4(" + "a + " * 30000 + "a);"), "W204", "", UNBOUND),
    ("long work", SINES, "W204", "", ()),
]
# What a message says of the limit.
SAYS = {"a sum": "at most 500 brackets", "two megabytes": "at most 1048576 bytes", "brackets": "--limit 2",
        "long work": "at most 5 s of processor time for an unusual shader"}


def graph(shader, **keys):
    return json.dumps({"resources": {"ldr": {"texture": "rgba8", "size": "screen"}},
                       "passes": [{"name": "paint", "type": "fullscreen", "shader": shader, "write": {"result": "ldr"}, **keys}],
                       "present": "ldr"})


def guarded(report, name, weft, *arguments, folder):
    """Runs and holds what it used against the guard. The sanitizers map terabytes, so a trial cannot bound its address space, and grows until
    its processor time ends; in its place they refuse memory to what holds too much."""
    count_run()
    own = {"XDG_CACHE_HOME": str(folder / "cache")}  # nothing of a run before
    if SANITIZED:
        own["ASAN_OPTIONS"] = os.environ["ASAN_OPTIONS"] + ":soft_rss_limit_mb=1792:allocator_may_return_null=1"
    with open(folder / "err.txt", "w") as err:
        process = subprocess.Popen([weft, *arguments], cwd=folder, stdout=subprocess.DEVNULL, stderr=err,
                                   env={**os.environ, **own})
        watch = time.monotonic() + 500 * SLOWER
        pid = 0
        while pid == 0 and time.monotonic() < watch:
            pid, status, used = os.wait4(process.pid, os.WNOHANG)
            time.sleep(0.02)
        if pid == 0:
            process.kill()
            pid, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    sanitizers.expect(r"\A(?:==\d+==AddressSanitizer: soft rss limit (?:un)?exhausted [^\n]*\n+)+\Z")  # and nothing else
    said = (folder / "err.txt").read_text(errors="replace")
    spent = used.ru_utime + used.ru_stime
    report.check(spent < SECONDS, f"{name}: {spent:.1f} s of processor time")
    report.check(used.ru_maxrss * 1024 < MEMORY_BYTES, f"{name}: {used.ru_maxrss >> 10} MiB")
    print(f"{name:32} exit code {process.returncode}, {spent:5.1f} s, {used.ru_maxrss >> 10} MiB")
    sys.stdout.flush()
    return process.returncode, said


def commands(weft, folder, report):
    for name, shader, code, place, options in HOSTILE:
        (folder / "shaders").mkdir(exist_ok=True)
        (folder / "shaders/bomb.frag.glsl").write_text(shader)
        (folder / "g.json").write_text(graph("bomb.frag.glsl"))
        exit_code, said = guarded(report, name, weft, "check", "g.json", *options, folder=folder)
        errors = [m.groupdict() for m in map(DIAGNOSTIC.match, said.splitlines()) if m and m["severity"] == "error"]
        at = [d["code"] + (d["place"] or "") + "".join(":" + d[k] for k in ("line", "column") if d[k]) for d in errors]
        report.check(exit_code == 1, f"{name}: exit code {exit_code}\n{said}")
        report.check(at and re.fullmatch(code + r"shaders/bomb\.frag\.glsl" + place, at[0]), f"{name}: {at}\n{said}")
        report.check(SAYS.get(name, "") in said, f"{name}: not {SAYS.get(name)!r}\n{said}")
    # An unusual shader that is good is tried, and compiles; so is a bundled one where spheres are lit
    # by sun and lamps at once, hide light from each other, and have fog and probes.
    (folder / "shaders/many.frag.glsl").write_text(main_of("float b[200];\n  b[int(uv.x * 200.0)] = a;\n  result = vec4(b[int(uv.y * 200.0)]);"))
    (folder / "g.json").write_text(graph("many.frag.glsl"))
    (folder / "lit.json").write_text("""{ "sun": { "direction": [0.5, 0.6, 0.3], "lux": 60000 }, "ground": { "height": 0, "albedo": [0.4, 0.4, 0.4], "radius": 100 },
  "lamps": { "lamp": { "position": [1, 2, 1], "candela": 100 } },
  "spheres": [{ "center": [0, 1, 0], "radius": 1, "material": { "albedo": [1, 0.8, 0.3], "metallic": 1, "roughness": 0.1 } },
              { "center": [2, 1, 0], "radius": 1, "material": { "albedo": [0.8, 0.8, 0.8], "roughness": 0.5 } }] }""")
    lit = ["--scene", "lit.json", "--set", "occlusion=true"]
    much = [*lit, "--set", "fog=true", "--set", "motion_blur=true"]
    for graph_file, trials, options in (("g.json", 1, ()), (str(TOP / "graphs/studio.json"), 0, ()), (str(TOP / "graphs/studio.json"), 1, much),
                                        (str(TOP / "graphs/studio_gi.json"), 1, lit)):
        good = run(weft, "render", graph_file, "--size", "64x36", "-o", "out.png", "--stats", "--program-cache", "none", *options, folder=folder)
        report.check(good.code == 0 and f'"trials": {trials},' in good.err, f"{graph_file}: {good.code}\n{good.err}")
    # More work groups than the device takes: in both commands, where the threads stand.
    (folder / "shaders/count.comp.glsl").write_text("layout(local_size_x = 1, local_size_y = 2) in;\nlayout(std430) buffer data { uint n[]; };\nvoid main() { n[0] = 1u; }\n")
    (folder / "g.json").write_text("""{ "resources": { "b": { "buffer": 64 }, "ldr": { "texture": "rgba8", "size": "screen" } },
  "passes": [
    { "name": "count", "type": "compute", "shader": "count.comp.glsl", "write": { "data": "b" },
      "threads": [8, 400000] },
    { "name": "paint", "type": "fullscreen", "shader": "show.frag.glsl", "read": { "data": "b" }, "write": { "result": "ldr" } }
  ], "present": "ldr" }""")
    (folder / "shaders/show.frag.glsl").write_text("layout(std430) readonly buffer data { uint n[]; };\nout vec4 result;\nvoid main() { result = vec4(float(n[0])); }\n")
    for command in (["check", "g.json"], ["render", "g.json", "--size", "8x8", "-o", "out.png"]):
        result = run(weft, *command, folder=folder)
        found = [(d["code"], d["place"], d["line"]) for d in result.diagnostics]
        report.check(result.code == 1 and found == [("W206", "g.json", "4")], f"{command[0]}: {result.code}\n{result.err}")


def children(pid):
    found = []
    for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            found += map(int, task.read_text().split())
        except OSError:
            pass
    return found


def viewer(weft, folder, report):
    composite = folder / "shaders/composite/composite.frag.glsl"
    good = composite.read_text()
    greener = good[:good.rindex("}")] + "  result.rgb *= vec3(0.2, 1.0, 0.2);\n}\n"

    def session(code, terms, *options):
        bomb = good.replace("void main() {", "void main() {\n  float zero = 0.0;\n  result = vec4(" + "zero + " * terms + "zero);", 1)
        live = Session(weft, folder, *options, graph="graphs/glow.json")
        try:
            first = live.opened(report)
            if not first:
                return
            save(composite, bomb)
            report.check(live.until(lambda: f"error[{code}]" in live.said()), f"{code} is not reported\n{live.said()}")
            same = live.shot()
            report.check(live.alive() and same and same.read_bytes() == first.read_bytes(), f"{code}: the picture is another one")
            report.check(not children(live.process.pid), f"{code}: a process is left")
            save(composite, greener)
            report.check(live.until(lambda: (s := live.shot()) and s.read_bytes() != first.read_bytes()), f"{code}: the fix is not taken up")
            live.leave(report)
        finally:
            live.stop()
            save(composite, good)

    session("W203", 100000)
    session("W204", 30000, *UNBOUND)
    # Whoever ends the viewer ends the process with it.
    live = Session(weft, folder, *UNBOUND, graph="graphs/glow.json")
    try:
        if not report.check(live.open() and live.shot(), f"no picture\n{live.said()}"):
            return
        lines = "".join(f"  shade = sin(shade) * {i}.5;\n" for i in range(4000))
        save(composite, good.replace("void main() {", "void main() {\n  float shade = gl_FragCoord.x;\n" + lines, 1)
             .replace("\n}", "\n  result.r += shade;\n}"))
        begun = live.until(lambda: children(live.process.pid))
        if report.check(begun, f"nothing is tried\n{live.said()}"):
            live.process.send_signal(signal.SIGKILL)
            live.process.wait()
            end = time.monotonic() + 120
            while time.monotonic() < end and any(map(runs, begun)):
                time.sleep(0.05)
            report.check(time.monotonic() < end, "the process goes on without the viewer")
    finally:
        live.stop()


def runs(pid):
    try:
        return "\nState:\tZ" not in pathlib.Path(f"/proc/{pid}/status").read_text()
    except OSError:  # it has ended
        return False


def main():
    weft, compare, report = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), Report()
    if "--inside" not in sys.argv:
        with temporary_folder() as name:
            commands(weft, pathlib.Path(name), report)
    inside_display(report, weft, compare, __file__)
    with temporary_folder() as name:
        folder = pathlib.Path(name)
        copy_of_tree(folder)
        viewer(weft, folder, report)
    report.end()


main()
