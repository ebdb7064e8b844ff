#!/usr/bin/env python3
"""A mirror dome on a plate, as geometry and as a normal map, some pixels wide, against the means of 8 x 8 pixels of a large picture,
by Hable's curve, of whose steps there may be 6.
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
WIDE, HIGH, SIDE = 60, 40, 256  # the small picture; texels of the normal map
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
    data, views, accessors, meshes = b"", [], [], []
    for mesh, (rows, corners) in enumerate(shapes):
        attributes = {}
        for name, kind, first, size in (("POSITION", "VEC3", 0, 3), ("NORMAL", "VEC3", 3, 3), ("TEXCOORD_0", "VEC2", 6, 2), ("", "SCALAR", 0, 1)):
            part = (b"".join(struct.pack(f"<{size}f", *row[first:first + size]) for row in rows) if name else
                    struct.pack(f"<{len(corners)}I", *corners))
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
            accessors.append({"bufferView": len(views) - 1, "componentType": 5126 if name else 5125, "count": len(rows if name else corners), "type": kind})
            data += part
            if name:
                attributes[name] = len(accessors) - 1
        meshes.append({"primitives": [{"attributes": attributes, "indices": len(accessors) - 1, "material": mesh}]})
    metal = {"pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.9, 0.9, 1], "metallicFactor": 1, "roughnessFactor": 0}}
    texels = []
    for y in range(SIDE):
        row = []
        for x in range(SIDE):
            u, v = (2 * x + 1 - SIDE) / (0.8 * SIDE), (SIDE - 2 * y - 1) / (0.8 * SIDE)
            n = (u, v, math.sqrt(max(1 - u * u - v * v, 0))) if u * u + v * v < 1 else (0, 0, 1)
            row.append(tuple(round(127.5 + 127.5 * c) for c in n))
        texels.append(row)
    (folder / "n.png").write_bytes(png(texels))
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "bufferViews": views, "accessors": accessors, "meshes": meshes,
                "nodes": [{"mesh": 0, "translation": [-0.6, 0, 0]}, {"mesh": 1, "translation": [0.6, 0, 0]}],
                "materials": [metal, metal | {"normalTexture": {"index": 0}}], "textures": [{"source": 0}], "images": [{"uri": "n.png"}],
                "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    (folder / "domes.gltf").write_text(json.dumps(document))
    (folder / "scene.json").write_text(json.dumps({
        "cameras": {"front": {"position": [0, 0, 8], "target": [0, 0, 0], "fov": 12}}, "models": {"domes": {"file": "domes.gltf"}}}))


def render(folder, times):
    out = folder / "out.png"
    subprocess.run([WEFT, "render", "graphs/deferred.json", "--scene", folder / "scene.json", "--set", "curve=filmic", "--set", "fxaa=false", "--set", "bloom=false",
                    "--environment", "scenes/environments/spiaggia_di_mondello_1k.hdr", "--size", f"{WIDE * times}x{HIGH * times}", "-o", out],
                   cwd=TOP, check=True)
    _, channels, texels = decode(out.read_bytes())
    return [LINEAR[c] for i, c in enumerate(texels) if i % channels < 3]


LINEAR = [c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in range(256)]


def shown(light):
    return 255 * (12.92 * light if light <= 0.0031308 else 1.055 * light ** (1 / 2.4) - 0.055)


def far_off(small, large, center):
    """Mean difference of 255 over what is inside the dome."""
    sum_of, count, per_unit = 0, 0, HIGH / (16 * math.tan(math.radians(6)))
    for y in range(HIGH):
        for x in range(WIDE):
            if math.hypot((x + 0.5 - WIDE / 2) / per_unit - center, (y + 0.5 - HIGH / 2) / per_unit) > 0.36:
                continue
            for c in range(3):
                cells = (large[((8 * y + j) * 8 * WIDE + 8 * x + i) * 3 + c] for j in range(8) for i in range(8))
                sum_of += abs(shown(small[(y * WIDE + x) * 3 + c]) - shown(sum(cells) / 64))
                count += 1
    return sum_of / count


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    write_scene(folder)
    small, large = render(folder, 1), render(folder, 8)
    for name, center in (("geometry", -0.6), ("normal map", 0.6)):
        off = far_off(small, large, center)
        print(f"{name}: {off:.2f} of 255")
        if off > 6:
            problems.append(f"{name}: {off:.2f} of 255 from 64 samples per pixel, not below 6")
print("\n".join(problems) or "normals in pixels: as many samples show them")
sys.exit(1 if problems else 0)
