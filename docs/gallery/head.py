#!/usr/bin/env python3
"""The pictures at the head of README: ../images/dusk.webp, strips.webp (five of its steps, each above its JSON) and
halftone.webp (an effect is typed). Needs Debian's packages `python3-pil`, `webp`
and `fonts-dejavu-core`.

    docs/gallery/head.py WEFT
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from PIL import Image, ImageDraw, ImageFont

from webp import write_webp

HERE = pathlib.Path(__file__).resolve().parent
TOP = HERE.parents[1]
IMAGES = TOP / "docs/images"
SCENE = ["--scene", "scenes/dusk.json", "--environment", "scenes/environments/venice_sunset.exr", "--preset", "dusk"]
PLAIN = ["--set", "bloom=false", "--set", "curve=linear", "--set", "grading=false", "--set", "vignette=false", "--set", "exposure=1"]
FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf"
BACK, INK, FAINT = (24, 26, 31), (214, 218, 224), (130, 138, 150)

# Title, file, what is shown of a stanza of it (… for what is left out), and how the picture of this step is asked for.
STRIPS = [
    ("G-buffer", "graphs/deferred.json", ['{ "name": "surfaces",', '  "list": "opaque",', '  "modify": ["normal", "base",', '    "depth", …] }'], ["--present", "base"]),
    ("light", "graphs/deferred_lit.json", ['{ "name": "lighting",', '  "use": "lights",', '  "read": ["normal", "base",', '    "depth", …] }'],
     [*PLAIN, "--set", "ao=false", "--set", "dof=false"]),
    ("occlusion", "graphs/deferred.json", ['{ "include":', ' "effects/ambient_occlusion.json",', '  "enabled": "$ao" }'], ["--present", "visible"]),
    ("lens", "graphs/post.json", ['{ "include":', '  "effects/depth_of_field.json",', '  "enabled": "$dof" }'], [*PLAIN, "--set", "ao=true"]),
    ("film", "graphs/presets/dusk.json", ['{ "curve": "agx",', '  "grading": true,', '  "contrast": 1.3,', '  "saturation": 1.3, … }'], []),
]


def read(path):
    return json.loads(re.sub(r"^\s*//.*$|(?<=[,\]}])\s+//.*$", "", (TOP / path).read_text(), flags=re.M))


def says(whole, part):
    """Whether each value of `part` stands in `whole` under its key, and each element of its lists."""
    if isinstance(part, dict):
        return isinstance(whole, dict) and all(key in whole and says(whole[key], value) for key, value in part.items())
    return all(value in whole for value in part) if isinstance(part, list) else whole == part


def render(weft, folder, graph, options, size):
    png = folder / "drawn.png"
    subprocess.run([weft, "render", graph, *SCENE, *options, "--size", size, "-o", png, "--quiet"], cwd=TOP, check=True)
    return Image.open(png).convert("RGB")


def save(folder, name, picture):
    picture.save(folder / "whole.png")
    write_webp(IMAGES / name, folder / "whole.png", {"command": "docs/gallery/head.py"})


def strips(weft, folder):
    wide, high, gap, text = 320, 860, 4, 132
    font, title = ImageFont.truetype(FONT, 15), ImageFont.truetype(FONT, 22)
    whole = Image.new("RGB", (len(STRIPS) * (wide + gap) - gap, high + text), BACK)
    draw = ImageDraw.Draw(whole)
    for i, (name, path, lines, options) in enumerate(STRIPS):
        shown, graph = json.loads("\n".join(lines).replace(", …", "")), read(path)
        assert any(says(stanza, shown) for stanza in [graph.get("set", {}), *graph.get("passes", [])]), f"{path} does not say {shown}"
        x, left = i * (wide + gap), 310 + i * wide
        whole.paste(render(weft, folder, "graphs/deferred.json", options, "1920x1080").crop((left, 0, left + wide, high)), (x, 0))
        draw.text((x + 10, 10), name, INK, title, stroke_width=3, stroke_fill=BACK)
        for row, line in enumerate(lines):
            draw.text((x + 6, high + 14 + 27 * row), line, INK, font)
    save(folder, "strips.webp", whole)


def loop(weft, folder):
    stanza = [line for line in (TOP / "docs/tutorials/halftone.json").read_text().splitlines() if "passes" not in line][2:-2]
    wide, high, text = 960, 540, 96
    font = ImageFont.truetype(FONT, 14)
    pictures = [render(weft, folder, "graphs/deferred.json", [], f"{wide}x{high}"), render(weft, folder, "docs/tutorials/halftone.json", [], f"{wide}x{high}"),
                render(weft, folder, "docs/tutorials/halftone.json", ["--set", "dot_size=12"], f"{wide}x{high}")]
    frames, times = [], []

    def add(picture, lines, time, cursor=True):
        frame = Image.new("RGB", (wide, high + text), BACK)
        frame.paste(pictures[picture], (0, 0))
        draw = ImageDraw.Draw(frame)
        for row, line in enumerate(lines):
            draw.text((8, high + 14 + 24 * row), line, INK, font)
        if cursor:
            x = 8 + draw.textlength(lines[-1], font)
            draw.rectangle((x, high + 14 + 24 * (len(lines) - 1), x + 8, high + 30 + 24 * (len(lines) - 1)), FAINT)
        frames.append(frame)
        times.append(time)

    stanza = [line[3:] for line in stanza]
    typed = "\n".join(stanza)
    add(0, [""], 1200)
    for end in range(0, len(typed), 5):
        add(0, typed[:end].split("\n"), 60)
    add(0, stanza, 500)
    add(1, stanza, 2500, False)
    add(2, [line.replace('"default": 6', '"default": 12') for line in stanza], 2500, False)
    frames[0].save(IMAGES / "halftone.webp", save_all=True, append_images=frames[1:], duration=times, loop=0, quality=80, method=6, minimize_size=True)


def main():
    weft = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        save(folder, "dusk.webp", render(weft, folder, "graphs/deferred.json", [], "1280x720"))
        strips(weft, folder)
        loop(weft, folder)


main()
