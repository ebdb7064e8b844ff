#!/usr/bin/env python3
"""Presets of a user's own: which folder a name is found in, that `weft presets` lists them, that they bring their shaders, as every file of
a graph does, and that a graph may extend several files.

    own_presets.py WEFT
"""
import json
import os
import pathlib
import sys

from pictures import read_exr
from program import Report, run, temporary_folder

GRAPH = """{ "parameters": { "level": { "default": 0.25 } },
  "resources": { "ldr": { "texture": "rgba32f", "size": [2, 2] } },
  "passes": [ { "name": "fill", "type": "fullscreen", "shader": "fill.frag.glsl", "write": { "result": "ldr" }, "parameters": { "level": "$level" } } ],
  "present": "ldr" }
"""
FILL = "layout(std140) uniform Parameters { float level; };\nout vec4 result;\nvoid main() { result = vec4(level); }\n"
NEGATE = "uniform sampler2D source;\nout vec4 result;\nvoid main() { result = 1.0 - texelFetch(source, ivec2(gl_FragCoord.xy), 0); }\n"
STANZA = """{ "after": "fill", "name": "negate", "type": "fullscreen", "shader": "negate.frag.glsl", "read": { "source": "ldr" }, "write": { "result": "ldr" } }"""


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    with temporary_folder() as name:
        folder = pathlib.Path(name)

        def write(path, text):
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text)
            return folder / path

        graph = write("graphs/g.json", GRAPH)
        write("graphs/shaders/fill.frag.glsl", FILL)
        write("user/weft/presets/dim.json", '{ "description": "of the user", "set": { "level": 0.125 } }')
        write("user/weft/presets/cinema.json", '{ "description": "hides the bundled one", "set": { "level": 0.5 } }')
        write("mine/dim.json", '{ "description": "of the folder", "set": { "level": 0.0625 } }')
        write("mine/negative.json", f'{{ "extends": "dim.json", "passes": [ {STANZA} ] }}')
        write("mine/shaders/negate.frag.glsl", NEGATE)
        environment = {**os.environ, "XDG_CONFIG_HOME": str(folder / "user")}

        def shows(value, label, *arguments, of=graph):
            for command in ("check", "render"):
                output = ["-o", folder / "out.exr"] if command == "render" else []
                ran = run(weft, command, of, *output, *arguments, env=environment)
                if not report.check(ran.code == 0 and not ran.err, f"{label}: {command} {ran.code} {ran.err}"):
                    return
            got = read_exr((folder / "out.exr").read_bytes())[0][0][0]
            report.check(got == value, f"{label}: {got} instead of {value}")

        shows(0.25, "without a preset")
        shows(0.125, "a name in the user's folder", "--preset", "dim")
        shows(0.0625, "a name in the folder of the option", "--preset-folder", folder / "mine", "--preset", "dim")
        shows(0.5, "a user's preset before a bundled one", "--preset", "cinema")
        shows(0.9375, "a preset that extends another and brings its shader", "--preset-folder", folder / "mine", "--preset", "negative")
        shows(0.9375, "the same by its path", "--preset", folder / "mine/negative.json")
        shows(0.875, "later presets win", "--preset", folder / "mine/negative.json", "--preset", "dim")
        # Files of one graph in folders of their own: each brings the shaders beside it, and those of the nearer file win.
        over = write("over/it.json", '{ "extends": "../graphs/g.json", "set": { "level": 0.5 } }')
        shows(0.5, "an overlay in another folder", of=over)
        including = write("outer/it.json", """{ "resources": { "ldr": { "texture": "rgba32f", "size": [2, 2] } },
          "passes": [ { "include": "../part/part.json", "bind": { "target": "ldr" } } ], "present": "ldr" }""")
        write("part/part.json", """{ "inputs": ["target"],
          "passes": [ { "name": "one", "type": "fullscreen", "shader": "one.frag.glsl", "write": { "result": "target" } } ] }""")
        write("part/shaders/one.frag.glsl", "out vec4 result;\nvoid main() { result = vec4(0.75); }\n")
        shows(0.75, "a graph that is included from another folder", of=including)
        write("over/shaders/fill.frag.glsl", FILL.replace("vec4(level)", "vec4(level * 4.0)"))
        shows(2.0, "a shader beside the overlay hides that of the graph", of=over)
        words = run(weft, "check", "--no-shaders", including)
        report.check(words.code == 0, f"check --no-shaders of files in several folders: {words.err}")
        several = write("graphs/several.json", '{ "extends": ["g.json", "../user/weft/presets/dim.json", "../mine/dim.json"] }')
        shows(0.0625, "a graph that extends several files", of=several)
        listed = run(weft, "presets", "--json", "--preset-folder", folder / "mine", env=environment)
        found = {each["name"]: each["description"] for each in json.loads(listed.out)}
        report.check(found.get("dim") == "of the folder" and found.get("cinema") == "hides the bundled one" and "negative" in found and "evening" in found,
                     f"the list of presets: {found}")
        (folder / "a_file").touch()
        for command in (["check", graph, "--no-shaders"], ["presets"]):
            for wrong, says in (("nowhere", "does not exist"), ("a_file", "is actually a file")):
                ran = run(weft, *command, "--preset-folder", folder / wrong, env=environment)
                report.check(ran.code == 2 and says in ran.err and wrong in ran.err, f"{command[0]} --preset-folder {wrong}: {ran.code} {ran.err}")
        write("mine/foreign.json", '{ "set": { "sun_azimuth": 1, "levle": 2, "bokeh": 3 } }')
        ran = run(weft, "check", graph, "--no-shaders", "--preset", folder / "mine/foreign.json")
        report.check(ran.codes() == ["W044"] and len(ran.diagnostics) == 3 and "did you mean 'level'?" in ran.err, f"a preset of another graph: {ran.err}")
        missing = run(weft, "check", graph, "--preset", "cinma", env=environment)
        report.check(missing.code == 1 and missing.codes() == ["W001"] and "cinema" in missing.err, f"a name that nobody has: {missing.err}")
        # A folder where the command is started hides no preset; a file that cannot be read hides the bundled one here and there.
        write("dim/x.json", "{}")
        ran = run(weft, "check", graph, "--no-shaders", "--preset", "dim", folder=folder, env=environment)
        report.check(ran.code == 0, f"a folder of a preset's name: {ran.code} {ran.err}")
        (folder / "mine/evening.json").write_text("{")
        listed = run(weft, "presets", "--json", "--preset-folder", folder / "mine", env=environment)
        names = [each["name"] for each in json.loads(listed.out)]
        ran = run(weft, "check", graph, "--no-shaders", "--preset-folder", folder / "mine", "--preset", "evening", env=environment)
        report.check("evening" not in names and "negative" in names and "mine/evening.json" in listed.err and "mine/evening.json" in ran.err, f"{names} {listed.err} {ran.err}")
    report.end()


main()
