#!/usr/bin/env python3
"""Spheres with glTF's material extensions, in one light from one direction and in light from everywhere, against the equations of the
extensions: KHR_materials_ior, specular, clearcoat, sheen, anisotropy and iridescence. Lobes are integrated here by sampling, thin films wavelength by
wavelength. The maps of the extensions: against spheres whose factors are what the maps hold. material_layers.py WEFT [PICTURE]"""
import base64
import functools
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from pictures import exr, png, read_exr  # noqa: E402

TOP = pathlib.Path(__file__).resolve().parents[3]
WEFT = sys.argv[1]
PIXELS, SPACING, RADIUS = 128, 2.2, 1.0  # per unit of SPACING / 2
POINTS = ((0.15, -0.1), (0.13, 0.32), (0.3, 0.2), (-0.5, 0.1), (0.1, 0.5), (0.2, 0.72), (-0.3, -0.6), (0.8, 0.1), (-0.75, 0.4))
problems = []

BLACK = {"baseColorFactor": [0, 0, 0, 1], "metallicFactor": 0, "roughnessFactor": 0.4}
METAL = {"baseColorFactor": [0.9, 0.5, 0.3, 1], "metallicFactor": 1, "roughnessFactor": 0.3}
WHITE = {"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0, "roughnessFactor": 1}
# name, pbrMetallicRoughness, extensions, how far from the equations in a light from one direction and from everywhere, of the greatest value. Of
# rough metals Weft puts back what single scattering loses; films have one color for all normals of a rough surface.
SPHERES = [
    ("none", BLACK, {}, 0.02, 0.02),
    ("ior", BLACK, {"ior": {"ior": 1.9}}, 0.02, 0.02),
    ("specular", BLACK, {"specular": {"specularFactor": 0.6, "specularColorFactor": [1, 0.5, 0.2]}}, 0.02, 0.02),
    ("clearcoat", BLACK, {"clearcoat": {"clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.3}}, 0.02, 0.02),
    ("sheen", BLACK, {"sheen": {"sheenColorFactor": [0.2, 0.5, 0.9], "sheenRoughnessFactor": 0.5}, "specular": {"specularFactor": 0}}, 0.01, 0.03),
    ("sheen on white", WHITE, {"sheen": {"sheenColorFactor": [0.9, 0.2, 0.2], "sheenRoughnessFactor": 0.4}, "specular": {"specularFactor": 0}}, 0.02, 0.05),
    ("anisotropy", BLACK, {"anisotropy": {"anisotropyStrength": 0.7, "anisotropyRotation": 0.5}}, 0.02, 0.08),
    ("iridescence", METAL, {"iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.5, "iridescenceThicknessMaximum": 320}}, 0.08, 0.08),
    ("film on black", BLACK, {"iridescence": {"iridescenceFactor": 0.8, "iridescenceIor": 1.8, "iridescenceThicknessMaximum": 450}}, 0.08, 0.08)]

# Bytes of an sRGB texel and its linear color; a turn of grooves and its direction in bytes; a normal of a coat.
COLOR = (244, 188, 124)
LINEAR = [((c / 255 + 0.055) / 1.055) ** 2.4 for c in COLOR]
GROOVES = (239, 189)
TURN = math.atan2(2 * GROOVES[1] / 255 - 1, 2 * GROOVES[0] / 255 - 1)
TILTED = (168, 92, 237)
FLAT, TILT = (0.0, 0.0, 1.0), tuple(2 * c / 255 - 1 for c in TILTED)
THIN = {"iridescenceIor": 1.5, "iridescenceThicknessMinimum": 100}
DENSE = {"attenuationDistance": 0.5, "attenuationColor": [0.9, 0.4, 0.2]}
CLEAR = {"transmissionFactor": 1}
GLASS = {"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0, "roughnessFactor": 0}
BEFORE = {"glossinessFactor": 0.6, "specularFactor": [0.2, 0.2, 0.2]}
# name of the map, pbrMetallicRoughness, extensions with factors, extensions with a map whose one texel, 153 / 255 = 0.6, makes the same factors: in
# the map's channel, with others beside it.
MAPS = [
    ("specular", BLACK, {"specular": {"specularFactor": 0.6}}, {"specular": {"specularTexture": (10, 200, 30, 153)}}),
    ("specularColor", BLACK, {"specular": {"specularColorFactor": LINEAR}}, {"specular": {"specularColorTexture": (*COLOR, 90)}}),
    ("clearcoat", BLACK, {"clearcoat": {"clearcoatFactor": 0.6}}, {"clearcoat": {"clearcoatFactor": 1, "clearcoatTexture": (153, 20, 30, 90)}}),
    ("clearcoatRoughness", BLACK, {"clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.6}},
     {"clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 1, "clearcoatRoughnessTexture": (5, 153, 230, 90)}}),
    ("clearcoatNormal", BLACK, {"specular": {"specularFactor": 0}, "clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.5}},
     {"specular": {"specularFactor": 0}, "clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.5, "clearcoatNormalTexture": (*TILTED, 90)}}),
    ("sheenColor", BLACK, {"sheen": {"sheenColorFactor": LINEAR, "sheenRoughnessFactor": 0.5}},
     {"sheen": {"sheenColorFactor": [1, 1, 1], "sheenRoughnessFactor": 0.5, "sheenColorTexture": (*COLOR, 90)}}),
    ("sheenRoughness", BLACK, {"sheen": {"sheenColorFactor": [1, 1, 1], "sheenRoughnessFactor": 0.6}},
     {"sheen": {"sheenColorFactor": [1, 1, 1], "sheenRoughnessFactor": 1, "sheenRoughnessTexture": (10, 80, 30, 153)}}),
    ("anisotropy", BLACK, {"anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": TURN}},
     {"anisotropy": {"anisotropyStrength": 1, "anisotropyTexture": (*GROOVES, 153, 90)}}),
    ("iridescence", METAL, {"iridescence": {**THIN, "iridescenceFactor": 0.6}}, {"iridescence": {**THIN, "iridescenceFactor": 1, "iridescenceTexture": (153, 10, 200, 90)}}),
    ("iridescenceThickness", METAL, {"iridescence": {**THIN, "iridescenceFactor": 1, "iridescenceThicknessMaximum": 280}},
     {"iridescence": {**THIN, "iridescenceFactor": 1, "iridescenceThicknessMaximum": 400, "iridescenceThicknessTexture": (10, 153, 220, 90)}}),
    ("transmission", GLASS, {"transmission": {"transmissionFactor": 0.6}}, {"transmission": {**CLEAR, "transmissionTexture": (153, 10, 220, 90)}}),
    ("thickness", GLASS, {"transmission": CLEAR, "volume": {**DENSE, "thicknessFactor": 0.6}},
     {"transmission": CLEAR, "volume": {**DENSE, "thicknessFactor": 1, "thicknessTexture": (10, 153, 220, 90)}}),
    ("diffuse", {}, {"pbrSpecularGlossiness": {**BEFORE, "diffuseFactor": [*LINEAR, 1]}}, {"pbrSpecularGlossiness": {**BEFORE, "diffuseTexture": (*COLOR, 255)}}),
    ("specularGlossiness", {}, {"pbrSpecularGlossiness": {"diffuseFactor": [0.1, 0.2, 0.3, 1], "specularFactor": LINEAR, "glossinessFactor": 0.6}},
     {"pbrSpecularGlossiness": {"diffuseFactor": [0.1, 0.2, 0.3, 1], "specularGlossinessTexture": (*COLOR, 153)}})]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def unit(a):
    length = math.sqrt(dot(a, a))
    return a[0] / length, a[1] / length, a[2] / length


def add(a, b):
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


TO_LIGHT = unit((0.25, 0.6, 0.75))
TO_EYE = (0.0, 0.0, 1.0)


# ---- the scene

def sphere_rows(down):
    """Positions, which are normals, tangents and triangles of a sphere around Y."""
    across = 2 * down
    normals, tangents, corners = [], [], []
    for j in range(down + 1):
        for i in range(across + 1):
            theta, phi = math.pi * j / down, 2 * math.pi * i / across
            normals.append((math.sin(theta) * math.sin(phi), math.cos(theta), math.sin(theta) * math.cos(phi)))
            tangents.append((math.cos(phi), 0.0, -math.sin(phi), 1.0))
    for j in range(down):
        for i in range(across):
            a, b = j * (across + 1) + i, (j + 1) * (across + 1) + i
            corners += [a, b, a + 1, a + 1, b, b + 1]
    return normals, tangents, corners


def write_scene(path, light, down, *rows):
    """Rows of spheres, downwards. Of each its material, in which a tuple is a map of that one texel, and its normal in the tangent space of a sphere."""
    normals, tangents, corners = sphere_rows(down)
    tilts = sorted({tilt for row in rows for *_, tilt in row})
    tilted = [[unit(tuple(dot(tilt, axes) for axes in zip(t, cross(n, t), n))) for n, t in zip(normals, tangents)] for tilt in tilts]
    lists = [(corners, "SCALAR"), (normals, "VEC3"), (tangents, "VEC4"), ([(0.5, 0.5)] * len(normals), "VEC2"), *((found, "VEC3") for found in tilted)]
    parts = [struct.pack(f"<{len(corners)}I", *corners), *(b"".join(struct.pack(f"<{len(row)}f", *row) for row in found) for found, _ in lists[1:])]
    views = [{"buffer": 0, "byteOffset": sum(map(len, parts[:i])), "byteLength": len(part)} for i, part in enumerate(parts)]
    accessors = [{"bufferView": i, "componentType": 5126 if i else 5125, "count": len(found), "type": kind} for i, (found, kind) in enumerate(lists)]
    materials, images, meshes, nodes = [], [], [], []

    def mapped(value):
        if isinstance(value, dict):
            return {key: mapped(inner) for key, inner in value.items()}
        if not isinstance(value, tuple):
            return value
        images.append({"uri": "data:image/png;base64," + base64.b64encode(png([[value]])).decode()})
        return {"index": len(images) - 1}

    for y, row in enumerate(rows):
        for x, (base, layers, tilt) in enumerate(row):
            nodes.append({"mesh": len(meshes), "translation": [SPACING * x, -SPACING * y, 0]})
            attributes = {"POSITION": 1, "TANGENT": 2, "TEXCOORD_0": 3, "NORMAL": 4 + tilts.index(tilt)}
            meshes.append({"primitives": [{"attributes": attributes, "indices": 0, "material": len(materials)}]})
            materials.append({"pbrMetallicRoughness": base, "extensions": {"KHR_materials_" + key: mapped(value) for key, value in layers.items()}})
    width, height = len(rows[0]), len(rows)
    nodes.append({"camera": 0, "name": "far", "translation": [SPACING * (width - 1) / 2, -SPACING * (height - 1) / 2, 200]})
    document = {"asset": {"version": "2.0"}, "bufferViews": views, "accessors": accessors, "materials": materials, "meshes": meshes, "nodes": nodes,
                "images": images, "textures": [{"source": i} for i in range(len(images))],
                "cameras": [{"type": "orthographic", "orthographic": {"xmag": SPACING / 2 * width, "ymag": SPACING / 2 * height, "znear": 1, "zfar": 9000}}],
                "buffers": [{"byteLength": sum(map(len, parts)), "uri": "data:application/octet-stream;base64," + base64.b64encode(b"".join(parts)).decode()}]}
    # An irradiance of 1; without any light a model has a sun.
    lamp = {"type": "directional", "intensity": 10000} if light else {"type": "point", "intensity": 1e-6}
    document["extensions"] = {"KHR_lights_punctual": {"lights": [lamp]}}
    axis, angle = unit(cross(TO_EYE, TO_LIGHT)), math.acos(TO_LIGHT[2])
    nodes.append({"extensions": {"KHR_lights_punctual": {"light": 0}}, "rotation": [x * math.sin(angle / 2) for x in axis] + [math.cos(angle / 2)]})
    path.write_text(json.dumps(document))


# ---- the equations

def schlick(f0, f90, cosine):
    return tuple(f + (f90 - f) * (1 - cosine) ** 5 for f in f0)


@functools.cache
def frame_of(n, turn):
    t = unit((n[2], 0.0, -n[0]))
    b = cross(n, t)
    along = tuple(math.cos(turn) * x + math.sin(turn) * y for x, y in zip(t, b))
    return along, cross(n, along), n


def ggx(alphas, frame, v, l):
    """Distribution times visibility."""
    h = unit(add(v, l))
    (tv, bv, nv), (tl, bl, nl), (th, bh, nh) = ((dot(frame[0], w), dot(frame[1], w), dot(frame[2], w)) for w in (v, l, h))
    at, ab = alphas
    distribution = 1 / (math.pi * at * ab * ((th / at) ** 2 + (bh / ab) ** 2 + nh * nh) ** 2)
    masked = nl * math.sqrt((at * tv) ** 2 + (ab * bv) ** 2 + nv * nv) + nv * math.sqrt((at * tl) ** 2 + (ab * bl) ** 2 + nl * nl)
    return distribution * 0.5 / masked


def wyman(nm):
    """CIE 1931 color-matching functions (Wyman, Sloan and Shirley, JCGT 2013)."""
    def lobe(mean, low, high):
        return math.exp(-0.5 * ((nm - mean) * (low if nm < mean else high)) ** 2)
    return (1.056 * lobe(599.8, 0.0264, 0.0323) + 0.362 * lobe(442.0, 0.0624, 0.0374) - 0.065 * lobe(501.1, 0.0490, 0.0382),
            0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322), 1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725))


WAVES = [(nm, wyman(nm)) for nm in range(380, 781, 5)]
WHOLE = tuple(sum(cmf[c] for _, cmf in WAVES) for c in range(3))


def interface(n1, n2, cosine):
    sine2 = (n1 / n2) ** 2 * (1 - cosine * cosine)
    if sine2 >= 1:
        return 1.0, 1.0
    inner = math.sqrt(1 - sine2)
    return ((n1 * cosine - n2 * inner) / (n1 * cosine + n2 * inner)) ** 2, ((n2 * cosine - n1 * inner) / (n2 * cosine + n1 * inner)) ** 2


def film(f0, ior, thickness, cosine):
    """Airy's formula at each wavelength; what interferes as a color of equal energy, relative to white."""
    inner = math.sqrt(1 - (1 - cosine * cosine) / ior ** 2)
    colors = []
    for channel in range(3):
        base = (1 + math.sqrt(f0[channel])) / (1 - math.sqrt(f0[channel]))
        first, second = (sum(interface(*pair)) / 2 for pair in ((1.0, ior, cosine), (ior, base, inner)))
        shift = math.pi + (math.pi if base < ior else 0)
        r1, r2 = math.sqrt(first), math.sqrt(second)

        def reflected(nm):
            phase = 4 * math.pi * ior * thickness * inner / nm + shift
            c = 2 * r1 * r2 * math.cos(phase)
            return 1 - (1 - first) * (1 - second) / (1 + first * second - c)
        level = first + (1 - first) ** 2 * second / (1 - first * second)
        xyz = [sum((reflected(nm) - level) * cmf[c] for nm, cmf in WAVES) / WHOLE[1] for c in range(3)]
        rows = ((3.2404542, -1.5371385, -0.4985314), (-0.9692660, 1.8760108, 0.0415560), (0.0556434, -0.2040259, 1.0572252))
        colors.append(max(0.0, level + dot(rows[channel], xyz)))
    return tuple(colors)


@functools.cache
def sheen_lambda(x, alpha):
    k = (1 - alpha) ** 2
    a, b, c, d, e = (q + (p - q) * k for p, q in ((25.3245, 21.5473), (3.32435, 3.82987), (0.16801, 0.19823), (-1.27393, -1.97760), (-4.85967, -4.32054)))
    def fit(y):
        return a / (1 + b * y ** c) + d * y + e
    return math.exp(fit(x)) if x < 0.5 else math.exp(2 * fit(0.5) - fit(1 - x))


def sheen(roughness, n, v, l):
    alpha = roughness * roughness
    h, nv, nl = unit(add(v, l)), dot(n, v), dot(n, l)
    sine = math.sqrt(max(0.0, 1 - dot(n, h) ** 2))
    distribution = (2 + 1 / alpha) * sine ** (1 / alpha) / (2 * math.pi)
    return distribution / ((1 + sheen_lambda(nv, alpha) + sheen_lambda(nl, alpha)) * 4 * nv * nl)


known = {}


def sheen_reflectance(roughness, cosine):
    key = (roughness, round(cosine, 2))
    if key not in known:
        v = (math.sqrt(1 - key[1] ** 2), 0.0, key[1])
        known[key] = sum(sheen(roughness, (0, 0, 1), v, l) * weight * l[2] for l, weight in directions(40, (0, 0, 1)))
    return known[key]


@functools.cache
def directions(count, n):
    """Evenly over the hemisphere around n, each with its solid angle."""
    found = []
    a = unit(cross((0.3, 0.9, 0.1), n))
    b = cross(n, a)
    for i in range(count):
        z = (i + 0.5) / count
        for j in range(2 * count):
            phi, s = math.pi * (j + 0.5) / count, math.sqrt(1 - z * z)
            found.append((tuple(s * math.cos(phi) * a[c] + s * math.sin(phi) * b[c] + z * n[c] for c in range(3)), math.pi / count ** 2))
    return found


def material(base, layers):
    """brdf(n, v, l), rgb."""
    color, metallic = base["baseColorFactor"][:3], base["metallicFactor"]
    specular = layers.get("specular", {})
    factor, ior = specular.get("specularFactor", 1), layers.get("ior", {}).get("ior", 1.5)
    f0 = [min(1, ((ior - 1) / (ior + 1)) ** 2 * c) * factor for c in specular.get("specularColorFactor", (1, 1, 1))]
    f0, f90 = (color, 1) if metallic else (f0, factor)
    alpha = base["roughnessFactor"] ** 2
    brushed = layers.get("anisotropy", {})
    alphas = (alpha + (1 - alpha) * brushed.get("anisotropyStrength", 0) ** 2, alpha)
    coat, cloth, thin = (layers.get(name, {}) for name in ("clearcoat", "sheen", "iridescence"))

    def fresnel(cosine):
        out = schlick(f0, f90, cosine)
        if not thin:
            return out
        key = (id(thin), round(cosine, 2))
        if key not in known:
            known[key] = film(f0, thin["iridescenceIor"], thin["iridescenceThicknessMaximum"], max(key[1], 0.01))
        return tuple(a + thin["iridescenceFactor"] * (b - a) for a, b in zip(out, known[key]))

    def brdf(n, v, l):
        h = unit(add(v, l))
        frame, reflected = frame_of(n, brushed.get("anisotropyRotation", 0)), fresnel(dot(v, h))
        lobe, diffuse = ggx(alphas, frame, v, l), (1 - metallic) * (1 - max(reflected)) / math.pi
        out = [r * lobe + diffuse * c for r, c in zip(reflected, color)]
        if cloth:
            tint, rough = cloth["sheenColorFactor"], cloth["sheenRoughnessFactor"]
            left = 1 - max(tint) * max(sheen_reflectance(rough, dot(n, v)), sheen_reflectance(rough, dot(n, l)))
            out = [left * o + t * sheen(rough, n, v, l) for o, t in zip(out, tint)]
        if coat:
            share = coat["clearcoatFactor"] * schlick((0.04,), 1, dot(n, v))[0]
            rough = coat["clearcoatRoughnessFactor"] ** 2
            out = [(1 - share) * o + share * ggx((rough, rough), frame, v, l) for o in out]
        return out
    return brdf


def leaves(brdf, n, v, everywhere):
    """Radiance towards the eye."""
    lights = directions(32, n) if everywhere else [(TO_LIGHT, 1)]
    return [sum(parts) for parts in zip(*([f * dot(n, l) * weight for f in brdf(n, v, l)] for l, weight in lights))]


def check(picture, graph, everywhere):
    height = len(picture)
    for i, (name, base, layers, one, all_of) in enumerate(SPHERES):
        brdf, seen, right = material(base, layers), [], []
        for x, y in POINTS[::2] if everywhere else POINTS:
            column, row = int((SPACING * (i + 0.5) + x) / SPACING * height), int((0.5 - y / SPACING) * height)
            at = ((column + 0.5) / height * SPACING - SPACING * (i + 0.5), (0.5 - (row + 0.5) / height) * SPACING)
            n = (*at, math.sqrt(1 - math.hypot(*at) ** 2))
            if not everywhere and dot(n, TO_LIGHT) < 0.15:
                continue
            right += leaves(brdf, n, TO_EYE, everywhere)
            seen += picture[row][column][:3]
        worst = max(abs(a - b) for a, b in zip(seen, right)) / max(right)
        print(f"{graph}, {'everywhere' if everywhere else 'one light'}, {name}: {worst:.4f}")
        if worst > (all_of if everywhere else one):
            problems.append(f"{graph}, {'everywhere' if everywhere else 'one light'}, {name}: off by {worst:.3f}: {[round(s, 4) for s in seen]} instead of {[round(r, 4) for r in right]}")


def check_maps(picture):
    """Both rows look alike. Glass shows some of what is beside it, so it knows its row."""
    size = len(picture) // 2
    for i, (name, _, layers, _) in enumerate(MAPS):
        pairs = [(a, b) for y in range(size) for x in range(size) if math.hypot(x - size / 2, y - size / 2) < size / 3
                 for a, b in zip(picture[y][i * size + x][:3], picture[size + y][i * size + x][:3])]
        worst = max(abs(a - b) for a, b in pairs) / max(a for a, _ in pairs)
        print(f"map {name}: {worst:.4f}")
        if worst > (0.02 if "transmission" in layers else 0.005):
            problems.append(f"map {name}: off by {worst:.3f}")


def render(folder, graph, rows, pixels, options, picture):
    made = subprocess.run([WEFT, "render", TOP / f"graphs/{graph}.json", "--scene", folder / "m.gltf", "--camera", "far", "--environment", folder / "e.exr",
                           "--size", f"{pixels * len(rows[0])}x{pixels * len(rows)}", "--set", "bloom=false", "--backend", "osmesa", *options,
                           "-o", f"hdr={folder / 'h.exr'}", *(["-o", sys.argv[2] + f"_{picture}.png"] if len(sys.argv) > 2 else [])], capture_output=True, text=True)
    if made.returncode != 0 or made.stderr:
        problems.append(f"{graph}: {made.stderr}")
    return read_exr((folder / "h.exr").read_bytes()) if made.returncode == 0 else None


with tempfile.TemporaryDirectory() as folder:
    folder = pathlib.Path(folder)
    plain = ["--set", "ao=false", "--set", "mesh_shadows=false"]
    spheres = [(base, layers, FLAT) for _, base, layers, *_ in SPHERES]
    for everywhere in (False, True):
        write_scene(folder / "m.gltf", not everywhere, 80, spheres)
        (folder / "e.exr").write_bytes(exr([[(1.0 if everywhere else 0.0,) * 4] * 16] * 8))
        for graph, options in (("deferred", plain), ("studio", [])):
            picture = render(folder, graph, [spheres], PIXELS, options, f"{graph}_{everywhere}")
            if picture:
                check(picture, graph, everywhere)
    factors = [(base, layers, TILT if name == "clearcoatNormal" else FLAT) for name, base, layers, _ in MAPS]
    maps = [(base, layers, FLAT) for _, base, _, layers in MAPS]
    write_scene(folder / "m.gltf", True, 30, factors, maps)
    (folder / "e.exr").write_bytes(exr([[(0.4, 0.5, 0.2, 1.0)] * 16] * 8))
    picture = render(folder, "deferred", [factors, maps], 48, plain, "maps")
    if picture:
        check_maps(picture)
print("\n".join(problems) or "material layers: as the extensions say")
sys.exit(1 if problems else 0)
