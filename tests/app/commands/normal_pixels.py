#!/usr/bin/env python3
"""Metal domes of several roughnesses, in one column as geometry and in the other as normal maps of plates, 10 to 20 pixels wide: against the
means of 8 x 8 pixels of a large picture, and the columns against each other, by Hable's curve, of whose steps there may be 6.
normal_pixels.py WEFT"""
import base64
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from pictures import decode, png  # noqa: E402

TOP = pathlib.Path(__file__).resolve().parents[3]
WEFT = sys.argv[1]
ROUGH = (0, 0.1, 0.2, 0.35, 0.5)
SIDE = 256  # texels of the normal map
problems = []


def dome():
    """Positions, normals, texture coordinates and triangles: the upper half of a sphere of radius 0.4."""
    across, down, rows, corners = 96, 48, [], []
    for j in range(down + 1):
        for i in range(across + 1):
            theta, phi = math.pi / 2 * j / down, 2 * math.pi * i / across
            n = (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))
            rows.append(tuple(0.4 * c for c in n) + n + (0, 0))
    for j in range(down):
        for i in range(across):
            a, b = j * (across + 1) + i, (j + 1) * (across + 1) + i
            corners += [a, b, a + 1, a + 1, b, b + 1]
    return rows, corners


def write_scene(folder):
    plate = [(x / 2, y / 2, 0, 0, 0, 1, (x + 1) / 2, (1 - y) / 2) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    shapes = [dome(), (plate, [0, 1, 2, 0, 2, 3])]
    data, views, accessors, made = b"", [], [], []
    for rows, corners in shapes:
        attributes = {}
        for name, kind, first, size in (("POSITION", "VEC3", 0, 3), ("NORMAL", "VEC3", 3, 3), ("TEXCOORD_0", "VEC2", 6, 2), ("", "SCALAR", 0, 1)):
            part = (b"".join(struct.pack(f"<{size}f", *row[first:first + size]) for row in rows) if name else
                    struct.pack(f"<{len(corners)}I", *corners))
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
            accessors.append({"bufferView": len(views) - 1, "componentType": 5126 if name else 5125, "count": len(rows if name else corners), "type": kind})
            data += part
            if name:
                attributes[name] = len(accessors) - 1
        made.append({"attributes": attributes, "indices": len(accessors) - 1})
    metals = [{"pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.9, 0.9, 1], "metallicFactor": 1, "roughnessFactor": rough}} for rough in ROUGH]
    meshes = [{"primitives": [made[column] | {"material": len(ROUGH) * column + i}]} for i in range(len(ROUGH)) for column in (0, 1)]
    texels = []
    for y in range(SIDE):
        row = []
        for x in range(SIDE):
            u, v = (2 * x + 1 - SIDE) / (0.8 * SIDE), (SIDE - 2 * y - 1) / (0.8 * SIDE)
            n = (u, v, math.sqrt(max(1 - u * u - v * v, 0))) if u * u + v * v < 1 else (0, 0, 1)
            row.append(tuple(round(127.5 + 127.5 * c) for c in n))
        texels.append(row)
    (folder / "n.png").write_bytes(png(texels))
    nodes = [{"mesh": 2 * i + column, "translation": [1.2 * column - 0.6, 1.2 * (len(ROUGH) / 2 - i - 0.5), 0]} for i in range(len(ROUGH)) for column in (0, 1)]
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "bufferViews": views, "accessors": accessors,
                "meshes": meshes, "nodes": nodes, "materials": metals + [metal | {"normalTexture": {"index": 0}} for metal in metals],
                "textures": [{"source": 0}], "images": [{"uri": "n.png"}],
                "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    (folder / "domes.gltf").write_text(json.dumps(document))
    (folder / "scene.json").write_text(json.dumps({  # from so far away that both columns are seen alike
        "cameras": {"front": {"position": [0, 0, 80], "target": [0, 0, 0], "fov": math.degrees(2 * math.atan(0.6 * len(ROUGH) / 80))}},
        "models": {"domes": {"file": "domes.gltf"}}}))


def render(folder, cell):
    """A picture with cells of so many pixels, 1.2 units, in two columns: linear light."""
    out = folder / "out.png"
    subprocess.run([WEFT, "render", "graphs/deferred.json", "--scene", folder / "scene.json", "--set", "curve=filmic", "--set", "fxaa=false", "--set", "bloom=false", "--set", "ao=false",
                    "--environment", "scenes/environments/spiaggia_di_mondello_1k.hdr", "--size", f"{2 * cell}x{len(ROUGH) * cell}", "-o", out],
                   cwd=TOP, check=True)
    _, channels, texels = decode(out.read_bytes())
    return [LINEAR[c] for i, c in enumerate(texels) if i % channels < 3]


LINEAR = [c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in range(256)]


def shown(light):
    return 255 * (12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055)


def compare(cell, small, large):
    """Of each roughness: mean differences of 255 inside the domes, of both columns and between them."""
    for row, rough in enumerate(ROUGH):
        off, count = [0, 0, 0], 0
        for y in range(cell):
            for x in range(cell):
                if math.hypot(x + 0.5 - cell / 2, y + 0.5 - cell / 2) > 0.3 * cell:
                    continue
                for c in range(3):
                    seen = []
                    for column in (0, 1):
                        left, top = column * cell + x, row * cell + y
                        seen.append(shown(small[(top * 2 * cell + left) * 3 + c]))
                        cells = (large[((8 * top + j) * 16 * cell + 8 * left + i) * 3 + c] for j in range(8) for i in range(8))
                        off[column] += abs(seen[-1] - shown(sum(cells) / 64))
                    off[2] += abs(seen[1] - seen[0])
                    count += 1
        line = f"{cell * 2 // 3} pixels, roughness {rough}: " + ", ".join(
            f"{name} {part / count:.2f}" for name, part in zip(("geometry", "normal map", "between them"), off))
        print(line)
        if max(off if rough else off[:2]) > 6 * count:  # mirrors show the steps of the normal map's 8 bits
            problems.append(line + " of 255, not below 6")


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    write_scene(folder)
    for cell in (15, 24, 30):
        compare(cell, render(folder, cell), render(folder, 8 * cell))
print("\n".join(problems) or "normals in pixels: as many samples show them")
sys.exit(1 if problems else 0)
