#!/usr/bin/env python3
"""Pictures of small models against what glTF 2.0 says, computed here texel by texel: wrap modes of samplers, unlit colors, the back of a
normal map, edges of triangles, a scene whose meshes all blend, moving morph targets, cameras of a floor and of the file. model_pictures.py WEFT"""
import base64
import json
import math
import pathlib
import struct
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from pictures import png, read_exr, read_png  # noqa: E402
from program import TOP, run  # noqa: E402

WEFT = sys.argv[1]
WIDTH, HEIGHT = 96, 64
TILT = (0.6, 0.0, 0.8)
problems = []


def uri(kind, data):
    return f"data:{kind};base64,{base64.b64encode(data).decode()}"


class Model:
    """Quads from -1 to 1 in the plane z = 0, uv from `low` to `high` (v down), twice as much in a second set, each a node."""

    def __init__(self, materials, **more):
        self.bytes = b""
        self.json = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": [], "meshes": [], "nodes": [], "materials": materials, **more}

    def accessor(self, kind, component, rows):
        size = {5126: "f", 5123: "H"}[component]
        data = b"".join(struct.pack(f"<{len(row)}{size}", *row) for row in rows)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + b"\0" * (-len(data) % 4)
        self.json["accessors"].append({"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component, "count": len(rows), "type": kind})
        return len(self.json["accessors"]) - 1

    def ball(self, material, steps=60, **node):
        """A sphere of radius 1, of 2 * steps * steps triangles."""
        turns = [math.tau * i / steps for i in range(steps + 1)]
        points = [(math.sin(a / 2) * math.cos(b), math.cos(a / 2), -math.sin(a / 2) * math.sin(b)) for a in turns for b in turns]
        corners = [i * (steps + 1) + j + k for i in range(steps) for j in range(steps) for k in (0, steps + 1, 1, 1, steps + 1, steps + 2)]
        attributes = {name: self.accessor("VEC3", 5126, points) for name in ("POSITION", "NORMAL")}
        indices = self.accessor("SCALAR", 5123, [(corner,) for corner in corners])
        self.json["meshes"].append({"primitives": [{"attributes": attributes, "indices": indices, "material": material}]})
        self.json["nodes"].append({"mesh": len(self.json["meshes"]) - 1, **node})
        return self

    def quad(self, material, normal=(0, 0, 1), low=0.0, high=1.0, **node):
        corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        span = lambda c: (c + 1) / 2 * (high - low) + low  # noqa: E731
        attributes = {
            "POSITION": self.accessor("VEC3", 5126, [(x, y, 0) for x, y in corners]),
            "NORMAL": self.accessor("VEC3", 5126, [normal] * 4),
            "TANGENT": self.accessor("VEC4", 5126, [(1, 0, 0, 1)] * 4),
            "TEXCOORD_0": self.accessor("VEC2", 5126, [(span(x), span(-y)) for x, y in corners]),
            "TEXCOORD_1": self.accessor("VEC2", 5126, [(2 * span(x), 2 * span(-y)) for x, y in corners])}
        indices = self.accessor("SCALAR", 5123, [(0, 1, 2, 0, 2, 3)[i:i + 1] for i in range(6)])
        self.json["meshes"].append({"primitives": [{"attributes": attributes, "indices": indices, "material": material}]})
        self.json["nodes"].append({"mesh": len(self.json["meshes"]) - 1, **node})
        return self

    def render(self, folder, *options, **more):
        return self.render_frames(folder, (0,), *options, **more)[0]

    def render_frames(self, folder, frames, *options, graph="deferred.json"):
        self.json["buffers"] = [{"byteLength": len(self.bytes), "uri": uri("application/octet-stream", self.bytes)}]
        path = folder / "m.gltf"
        path.write_text(json.dumps(self.json))
        made = run(WEFT, "render", TOP / "graphs" / graph, "--scene", path, "--size", f"{WIDTH}x{HEIGHT}", "--set", "bloom=false", "--set", "fxaa=false",
                   "--set", "curve=filmic", "--backend", "osmesa", "--preset", TOP / "tests/small_maps.json", "--frames", ",".join(map(str, frames)),
                   *options, "-o", folder / "m_%d.png")
        if made.code != 0 or made.err:
            problems.append(f"{options}: {made.err}")
        return [[[texel[:3] for texel in row] for row in read_png((folder / f"m_{frame}.png").read_bytes())] for frame in frames]


def expect(what, good):
    if not good:
        problems.append(what)


def wrapped(mode, x):
    """Texel of 2 that glTF's wrap mode shows at x, in texels: OpenGL 4.5, table 8.20."""
    i = int(x // 1)
    return {33071: min(max(i, 0), 1), 33648: [0, 1, 1, 0][i % 4], 10497: i % 2}[mode]


def check_wrap(folder):
    colors = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0)]
    image = png([colors[:2], colors[2:]])
    for s, t in ((33071, 33648), (33648, 10497), (10497, 33071)):
        model = Model([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "extensions": {"KHR_materials_unlit": {}}}],
                      images=[{"uri": uri("image/png", image)}], textures=[{"source": 0, "sampler": 0}],
                      samplers=[{"wrapS": s, "wrapT": t, "magFilter": 9728}])
        picture = model.quad(0, low=-1.0, high=2.0).render(folder)
        # The quad is as high as 1 / 1.08 of the picture: of 6 x 6 cells the middles.
        for cell_y in range(6):
            for cell_x in range(6):
                at = [(c + 0.5) / 6 * 2 - 1 for c in (cell_x, cell_y)]
                seen = picture[int(HEIGHT / 2 + at[1] * HEIGHT / 2 / 1.08)][int(WIDTH / 2 + at[0] * HEIGHT / 2 / 1.08)]
                color = colors[2 * wrapped(t, cell_y - 2) + wrapped(s, cell_x - 2)]
                expect(f"wrap {s}, {t}: {seen} in cell {cell_x}, {cell_y} instead of {color}",
                       all((seen[c] > 140) == (color[c] == 255) for c in range(3)))


def check_colors(folder):
    unlit = {"doubleSided": True, "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.3, 0.1, 1]}, "extensions": {"KHR_materials_unlit": {}}}
    turned = [0, 0.5, 0, 0.8660254]  # by 60 degrees
    for graph in ("deferred.json", "studio.json"):
        picture = Model([unlit]).quad(0, translation=[-1.2, 0, 0]).quad(0, translation=[1.2, 0, 0], rotation=turned).render(folder, graph=graph)
        left, right = picture[HEIGHT // 2][28], picture[HEIGHT // 2][67]
        expect(f"{graph}: unlit surfaces differ by their direction: {left} and {right}", max(abs(a - b) for a, b in zip(left, right)) <= 1)
        glass = {"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0, 0, 0.9]}}
        red, _, blue = Model([glass]).quad(0).render(folder, graph=graph)[HEIGHT // 2][WIDTH // 2]
        expect(f"{graph}: a scene of glass alone is not drawn", red > blue + 60)


def check_second_uvs(folder):
    """Maps of a material with coordinates of their own: what shines is seen as it is without the other map."""
    images = [{"uri": uri("image/png", png(rows))} for rows in ([[(0, 0, 0)]], [[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 255)]])]
    shared = {"images": images, "samplers": [{"magFilter": 9728}], "textures": [{"source": 0}, {"source": 1, "sampler": 0}]}
    shines = {"index": 1, "texCoord": 1, "extensions": {"KHR_texture_transform": {"offset": [0.25, 0.5], "rotation": 0.5}}}
    for graph in ("deferred.json", "studio.json"):
        both, alone = (Model([{"pbrMetallicRoughness": base, "emissiveTexture": shines, "emissiveFactor": [1, 1, 1]}], **shared).quad(0).render(folder, graph=graph)
                       for base in ({"baseColorTexture": {"index": 0}}, {"baseColorFactor": [0, 0, 0, 1]}))
        apart = sum(max(abs(a - b) for a, b in zip(left, right)) > 1 for lefts, rights in zip(both, alone) for left, right in zip(lefts, rights))
        expect(f"{graph}: {apart} pixels of a map with its own coordinates differ", apart == 0)
        expect(f"{graph}: the map does not shine", len({texel for row in both for texel in row}) > 20)


def check_backs(folder):
    """A map that tilts the normal, and vertices that have that normal: the same from both sides."""
    texel = bytes(round((c + 1) / 2 * 255) for c in TILT)
    normal = tuple(c / 255 * 2 - 1 for c in texel)
    metal = {"doubleSided": True, "pbrMetallicRoughness": {"roughnessFactor": 0.3}}
    for camera in ("front", "back"):
        mapped = Model([{**metal, "normalTexture": {"index": 0}}], images=[{"uri": uri("image/png", png([[tuple(texel)]]))}], textures=[{"source": 0}])
        by_map, by_vertices = (model.quad(0, **more).render(folder, "--camera", camera) for model, more in ((mapped, {}), (Model([metal]), {"normal": normal})))
        worst = max(abs(a - b) for rows in zip(by_map, by_vertices) for pixels in zip(*rows) for a, b in zip(*pixels))
        middle = max(abs(a - b) for a, b in zip(by_map[HEIGHT // 2][WIDTH // 2], by_vertices[HEIGHT // 2][WIDTH // 2]))
        expect(f"{camera}: {middle} and {worst} of 255 between the map and the vertices", middle <= 2 and worst <= 4)


def check_edges(folder):
    """Normals that turn within a pixel widen the roughness; triangles that end there do not, whatever maps others have."""
    model = Model([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}, {"pbrMetallicRoughness": {"roughnessFactor": 0.4}}],
                  images=[{"uri": uri("image/png", png([[(0, 0, 0)]]))}], textures=[{"source": 0}])
    model.quad(0, translation=[-1.2, 0, 0]).ball(1, translation=[1.2, 0, 0]).render(folder, "-o", f"metallic_roughness={folder}/r.exr")
    seen = [texel[1] for row in read_exr((folder / "r.exr").read_bytes())[27:37] for texel in row[57:67]]
    expect(f"roughness 0.4 is {min(seen):.3f} to {max(seen):.3f}", max(abs(each - 0.4) for each in seen) < 0.01)


def check_cameras(folder):
    red = {"pbrMetallicRoughness": {"baseColorFactor": [0.9, 0, 0, 1]}, "emissiveFactor": [1, 0, 0]}
    for rotation in ([-0.70710678, 0, 0, 0.70710678], [0.70710678, 0, 0, 0.70710678], [0, 0.70710678, 0, 0.70710678], [0, 1, 0, 0]):
        r, _, b = Model([red]).quad(0, rotation=rotation).render(folder)[HEIGHT // 2][WIDTH // 2]
        expect(f"a quad turned by {rotation} is not seen", r > b + 60)
    model = Model([red], cameras=[{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1}}]).quad(0)
    model.json["nodes"].append({"camera": 0, "name": "far off", "translation": [1, 0, 10]})
    picture = model.render(folder, "--camera", "far off")
    # The middle of the quad is 1 to the left at a distance of 10; half the height of the picture is tan(0.3) there.
    x = WIDTH / 2 - 1 / 10 / 0.30934 * HEIGHT / 2
    edge = 1 / 10 / 0.30934 * HEIGHT / 2
    for at, inside in ((x, True), (x - edge + 2, True), (x - edge - 2, False), (x + edge - 2, True), (x + edge + 2, False)):
        r, _, b = picture[HEIGHT // 2][int(at)]
        expect(f"the camera of the file: column {at}", (r > b + 60) == inside)


# Weights of two targets at these times, with the tangents that cubic splines also have: (in-tangents, values, out-tangents).
TIMES = (0.0, 0.4, 1.0)
KEYS = (((0, 0), (0.0, 0.5), (1, -2)), ((2, 1), (1.0, -0.25), (-3, 2)), ((-1, 0.5), (0.25, 1.25), (0, 0)))


def weight_at(how, target, time):
    """glTF 2.0, appendix C: of an animation that plays round and round."""
    time %= TIMES[-1]
    k = max(i for i in range(2) if TIMES[i] <= time)
    span = TIMES[k + 1] - TIMES[k]
    t = (time - TIMES[k]) / span
    (_, before, leaving), (arriving, after, _) = ([row[target] for row in key] for key in KEYS[k:k + 2])
    if how == "STEP":
        return before
    if how == "LINEAR":
        return (1 - t) * before + t * after
    return ((2 * t**3 - 3 * t**2 + 1) * before + span * (t**3 - 2 * t**2 + t) * leaving
            + (-2 * t**3 + 3 * t**2) * after + span * (t**3 - t**2) * arriving)


def check_morphs(folder):
    """The first target moves the right corners by 0.8 to the right, the second all by 0.6 upwards: edges and motion."""
    red = {"pbrMetallicRoughness": {"baseColorFactor": [0.9, 0, 0, 1]}, "emissiveFactor": [1, 0, 0]}
    fps, slope = 10, 0.30934  # the tangent of half the camera's angle
    unit = HEIGHT / 2 / 10 / slope  # pixels
    for how in ("LINEAR", "STEP", "CUBICSPLINE"):
        for graph, skinned in (("deferred.json", False), ("studio.json", False), ("deferred.json", True)):
            model = Model([red], cameras=[{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1}}]).quad(0)
            model.json["nodes"].append({"camera": 0, "name": "lens", "translation": [0, 0, 10]})
            primitive = model.json["meshes"][0]["primitives"][0]
            primitive["targets"] = [{"POSITION": model.accessor("VEC3", 5126, [(0, 0, 0), (0.8, 0, 0), (0.8, 0, 0), (0, 0, 0)])},
                                    {"POSITION": model.accessor("VEC3", 5126, [(0, 0.6, 0)] * 4)}]
            if skinned:  # by a joint at the origin
                primitive["attributes"] |= {"JOINTS_0": model.accessor("VEC4", 5123, [(0, 0, 0, 0)] * 4),
                                            "WEIGHTS_0": model.accessor("VEC4", 5126, [(1, 0, 0, 0)] * 4)}
                model.json["nodes"][0]["skin"] = 0
                model.json["skins"] = [{"joints": [2]}]
                model.json["nodes"].append({})
            rows = [row for key in KEYS for row in (key if how == "CUBICSPLINE" else key[1:2])]
            sampler = {"input": model.accessor("SCALAR", 5126, [(t,) for t in TIMES]), "interpolation": how,
                       "output": model.accessor("SCALAR", 5126, [(number,) for row in rows for number in row])}
            model.json["animations"] = [{"samplers": [sampler], "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}]
            frames = (2, 5, 9, 17)
            also = ("-o", f"velocity={folder}/v_%d.exr") if graph == "deferred.json" else ()
            pictures = model.render_frames(folder, frames, "--camera", "lens", "--fps", str(fps), *also, graph=graph)
            for frame, picture in zip(frames, pictures):
                (x, y), before = ([weight_at(how, target, f / fps) for target in (0, 1)] for f in (frame, frame - 1))
                case = f"{graph}, {how}{', skinned' * skinned}, frame {frame}"
                left, right, low, top = -1, 1 + 0.8 * x, -1 + 0.6 * y, 1 + 0.6 * y
                middle = ((left + right) / 2, (low + top) / 2)
                column, row = (lambda at: int(WIDTH / 2 + at * unit)), (lambda at: int(HEIGHT / 2 - at * unit))
                for at, inside in ((left, 1), (right, -1)):
                    for off in (2, -2):
                        r, _, b = picture[row(middle[1])][column(at) + off]
                        expect(f"{case}: column {column(at) + off}, edge at {WIDTH / 2 + at * unit:.1f}", (r > b + 60) == (off * inside > 0))
                for at, inside in ((top, 1), (low, -1)):
                    for off in (2, -2):
                        r, _, b = picture[row(at) + off][column(middle[0])]
                        expect(f"{case}: row {row(at) + off}, edge at {HEIGHT / 2 - at * unit:.1f}", (r > b + 60) == (off * inside > 0))
                if also:  # of the pixel there, in parts of the picture
                    px, py = column(middle[0]), row(middle[1])
                    u = ((px + 0.5 - WIDTH / 2) / unit + 1) / (right + 1)
                    wanted = (u * 0.8 * (x - before[0]) * unit / WIDTH, 0.6 * (y - before[1]) * unit / HEIGHT)
                    seen = read_exr((folder / f"v_{frame}.exr").read_bytes())[py][px][:2]
                    expect(f"{case}: motion {seen} instead of {wanted}", max(abs(a - b) for a, b in zip(seen, wanted)) < 1e-3)


def check_lost_normals(folder):
    """Half a target takes the normals away: as where the file is morphed when it is read, no NaN."""
    for graph in ("deferred.json", "studio.json"):
        model = Model([{"pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.2, 0.1, 1], "metallicFactor": 0}}]).quad(0)
        primitive = model.json["meshes"][0]["primitives"][0]
        primitive["targets"] = [{"NORMAL": model.accessor("VEC3", 5126, [(0, 0, -2)] * 4)}]
        model.json["meshes"][0]["weights"] = [0.5]
        still = model.render(folder, graph=graph)
        sampler = {"input": model.accessor("SCALAR", 5126, [(0.0,), (1.0,)]), "output": model.accessor("SCALAR", 5126, [(0.5,), (0.5,)])}
        model.json["animations"] = [{"samplers": [sampler], "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}]
        moving = model.render(folder, graph=graph)
        worst = max(abs(a - b) for rows in zip(still, moving) for pixels in zip(*rows) for a, b in zip(*pixels))
        expect(f"{graph}, normals of length 0: off by {worst} of 255", worst <= 3)


with tempfile.TemporaryDirectory() as name:
    for check in (check_wrap, check_colors, check_second_uvs, check_morphs, check_lost_normals, check_backs, check_edges, check_cameras):
        check(pathlib.Path(name))
print("\n".join(problems) or "model pictures: as glTF says")
sys.exit(1 if problems else 0)
