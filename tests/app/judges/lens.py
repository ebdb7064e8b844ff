#!/usr/bin/env python3
"""The judge of depth of field: against the mean of sharp pictures from places all over the lens, each shifted so that what is in focus stays.

    lens.py WEFT [--only NAME] [--points 256] [--size 960x540] [--keep FOLDER]

The sharp pictures are Weft's, with two pixels along a pixel, and what they judge has temporal anti-aliasing; the judge's own part is how they are added
up: that of a thin lens. Where one half of the places and the other differ by more than 8 of 255, and 4 pixels around, nothing is judged, since 256 places
do not suffice for a glint; nor at the border, where places look beyond it. Printed: of 255 after x / (1 + x) and gamma 2.2, of the worst channel, the
mean, the 99th percentile, and how many are over 32. --keep: the mean, Weft's picture and eight times their difference, side by side. Needs numpy, and up to an hour for all."""
import argparse
import json
import math
import pathlib
import re
import struct
import sys
import zlib

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from pictures import encode  # noqa: E402
from program import REAL_HDR, TOP, run, temporary_folder  # noqa: E402

BATCH = 32  # pictures on disk at a time
FINER = 2
SETTLED = 23  # the frame in which anti-aliasing has
MEAN, PERCENTILE, OVER = 1.2, 12, 0.001


def bars(folder):
    """Slanted bars of 8 mm, a screen of them, before the helmets."""
    lines = []
    for i in range(9):
        x, lean = (i - 4) * 0.035, 0.05
        for dx, y in ((0, 0), (0.008, 0), (0.008 + lean, 0.5), (lean, 0.5)):
            lines.append(f"v {x + dx - 0.13:.4f} {y:.4f} 1.1")
        lines.append("f -4 -3 -2 -1")
    (folder / "bars.obj").write_text("vn 0 0 1\n" + "\n".join(lines) + "\n")
    return {"models": {"bars": {"file": str(folder / "bars.obj"), "material": {"albedo": [0.7, 0.3, 0.1], "roughness": 0.6}}}}


# Name: graph, scene, camera, lens (focal length mm, f-number, focus in world units, blades), arguments, and what is added to the scene.
HELMETS = {"position": [-0.28, 0.37, 2.05], "target": [0, 0.315, 0], "near": 0.01}
PLAIN = ("--set=ao=false",)  # slow, and it depends on the place
PORTRAIT_FOV = 2 * math.degrees(math.atan(12 / 85))
CASES = {
    "wall": ("studio", "spheres", {"position": [0, 0, 20], "target": [0, 0, 0], "fov": 60}, (85, 1.4, 8, 0), (), None),
    "close": ("studio", "../docs/gallery/close", {"position": [0, 0.6, 7], "target": [0, 0, 0], "fov": 40}, (85, 1.4, 7.02, 0), (), None),
    "evening": ("studio", "evening", {"position": [1.9, 1.75, 17.6], "target": [0.32, 0.77, 0], "fov": 24.8}, (135, 1.4, 14, 0), ("--preset", "evening"), None),
    "helmets": ("deferred", "helmets", HELMETS | {"fov": PORTRAIT_FOV}, (85, 1.4, 0, 0), ("--preset", "portrait", *PLAIN), None),
    "bars": ("deferred", "helmets", HELMETS | {"fov": 25}, (50, 1.4, 2.05, 6), PLAIN, bars),
    "rack": ("deferred", "helmets", HELMETS | {"fov": 25}, (85, 2, 2.7, 0), PLAIN, None),
}


def read_exr(path):
    """As read_exr() of pictures.py, R, G and B alone, by numpy: there are hundreds of large ones."""
    data = path.read_bytes()
    at, attributes = 8, {}
    while data[at]:
        name, after = data[at:data.index(b"\0", at)].decode(), data.index(b"\0", data.index(b"\0", at) + 1) + 1
        size = struct.unpack_from("<I", data, after)[0]
        attributes[name] = data[after + 4:after + 4 + size]
        at = after + 4 + size
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels, rest = [], attributes["channels"]
    while rest[0]:
        name, rest = rest.split(b"\0", 1)
        channels.append((name.decode(), 2 if struct.unpack_from("<i", rest)[0] == 1 else 4))
        rest = rest[16:]
    row = width * sum(size for _, size in channels)
    lines = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    picture = np.empty((height, width, 3), np.float32)
    for place in struct.unpack_from(f"<{-(-height // lines)}Q", data, at + 1):
        first, size = struct.unpack_from("<ii", data, place)
        first -= top
        wanted = row * min(lines, height - first)
        raw = np.frombuffer(data, np.uint8, size, place + 8)
        if size < wanted:  # deflated: differences of bytes, the even ones first
            mixed = np.frombuffer(zlib.decompress(raw), np.uint8).copy()
            mixed[1:] ^= 128
            mixed = np.cumsum(mixed, dtype=np.uint8)
            half = (len(mixed) + 1) // 2
            raw = np.empty_like(mixed)
            raw[0::2], raw[1::2] = mixed[:half], mixed[half:]
        texels, begin = raw.reshape(-1, row), 0
        for name, size in channels:
            if name in "RGB":
                plane = np.ascontiguousarray(texels[:, begin:begin + size * width]).view(np.float16 if size == 2 else np.float32)
                picture[first:first + len(texels), :, "RGB".index(name)] = plane
            begin += size * width
    return picture


def shown(radiance):
    radiance = np.maximum(radiance, 0)
    return 255 * (radiance / (1 + radiance)) ** (1 / 2.2)


def places(points, blades):
    """Even over an aperture whose corners are 1 from its middle, the first along x: a spiral by the golden angle."""
    sector = 2 * math.pi / max(blades, 3)
    tried, found = round(points * (sector / math.sin(sector) if blades > 2 else 1)), []
    for i in range(tried):
        radius, angle = math.sqrt((i + 0.5) / tried), i * math.pi * (3 - math.sqrt(5))
        if blades < 3 or radius * math.cos(angle % sector - sector / 2) <= math.cos(sector / 2):
            found.append((radius * math.cos(angle), radius * math.sin(angle)))
    return found


def wider(mask, by):
    padded = np.pad(mask, by)
    return np.any([padded[y:y + mask.shape[0], x:x + mask.shape[1]] for y in range(2 * by + 1) for x in range(2 * by + 1)], axis=0)


def merged(path, more):
    """The scene's text with other cameras and further models; paths stay relative to the scene."""
    scene = json.loads(re.sub(r"//[^\n]*", "", path.read_text()))
    for model in scene.get("models", {}).values():
        model["file"] = str(path.parent / model["file"])
    for holder in (scene, scene.get("grid", {})):
        for key in ("library", "materials"):
            if isinstance(holder.get(key), str):
                holder[key] = str((path.parent / holder[key]).resolve())
    scene["cameras"] = more["cameras"]
    scene.setdefault("models", {}).update(more.get("models", {}))
    if not scene["models"]:
        del scene["models"]
    return json.dumps(scene)


class Case:
    def __init__(self, name, weft, folder, size, points):
        self.graph, scene, self.camera, lens, self.arguments, more = CASES[name]
        self.weft, self.folder, (self.width, self.height) = weft, folder, size
        position, target = (np.array(self.camera[key]) for key in ("position", "target"))
        ahead = (target - position) / np.linalg.norm(target - position)
        right = np.cross(ahead, (0, 1, 0)) / np.linalg.norm(np.cross(ahead, (0, 1, 0)))
        up = np.cross(right, ahead)
        focal, number, focus, blades = lens
        self.sets = {"focal_length": focal, "aperture": number, "focus_distance": focus, "blades": blades, "sensor_height": 24}
        focus = focus or np.linalg.norm(target - position)
        # The camera's angle of view need not be the lens's: the disc of a point at infinity has the radius f^2 / (2 N (s - f)) on a sensor of 24 mm, and
        # a place that far from the axis sees it moved by as much.
        disc = (focal / 1000) ** 2 / (2 * number * (focus - focal / 1000)) / 0.024 * self.height
        self.pixels_at_focus = self.height / 2 / math.tan(math.radians(self.camera["fov"]) / 2) / focus
        self.places = [(x * disc / self.pixels_at_focus, y * disc / self.pixels_at_focus) for x, y in places(points, blades)]
        self.moved = [(position + right * x + up * y, target + right * x + up * y) for x, y in self.places]
        self.source, self.more = TOP / "scenes" / f"{scene}.json", more(folder) if more else {}
        self.scene = folder / "scene.json"

    def write_scene(self, begin, end):
        """With a camera that is at one place in each frame: frames are drawn from the first on."""
        path = [{"time": i / 60, "position": list(position), "target": list(target), "fov": self.camera["fov"]}
                for i, (position, target) in enumerate(self.moved[begin:end])]
        cameras = {"still": self.camera, "lens": {"path": path, "near": self.camera.get("near", 0.1)}}
        self.scene.write_text(merged(self.source, {"cameras": cameras} | self.more))

    def render(self, camera, size, judged, frames, output):
        chosen = str(judged).lower()
        sets = [f"--set={name}={value}" for name, value in (self.sets | {"dof": chosen, "taa": chosen, "bloom": "false"}).items()]
        done = run(self.weft, "render", f"graphs/{self.graph}.json", "--scene", self.scene, "--camera", camera, "--environment", REAL_HDR, *self.arguments, *sets,
                   "--size", "%dx%d" % size, "--frames", frames, "--quiet", "-o", f"hdr={self.folder / output}")
        assert done.code == 0, done.err

    def truth(self):
        """The means of the places of even and of odd number."""
        sums = np.zeros((2, self.height, self.width, 3))
        for begin in range(0, len(self.places), BATCH):
            end = min(begin + BATCH, len(self.places))
            self.write_scene(begin, end)
            self.render("lens", (self.width * FINER, self.height * FINER), False, f"0-{end - begin - 1}", "sharp_%04d.exr")
            for i in range(begin, end):
                path = self.folder / f"sharp_{i - begin:04d}.exr"
                sharp = read_exr(path)
                path.unlink()
                dx, dy = (round(c * self.pixels_at_focus * FINER) for c in self.places[i])
                rows = np.clip(np.arange(self.height * FINER) + dy, 0, self.height * FINER - 1)  # the top row is first
                columns = np.clip(np.arange(self.width * FINER) - dx, 0, self.width * FINER - 1)
                moved = sharp[rows][:, columns]
                sums[i % 2] += moved.reshape(self.height, FINER, self.width, FINER, 3).mean(axis=(1, 3))
        return sums[0] / ((len(self.places) + 1) // 2), sums[1] / (len(self.places) // 2)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("weft")
    parser.add_argument("--only", choices=CASES, action="append")
    parser.add_argument("--points", type=int, default=256)
    parser.add_argument("--size", default="960x540")
    parser.add_argument("--keep", type=pathlib.Path)
    options = parser.parse_args()
    size = tuple(map(int, options.size.split("x")))
    failed = False
    for name in options.only or CASES:
        with temporary_folder() as folder:
            case = Case(name, options.weft, pathlib.Path(folder), size, options.points)
            even, odd = case.truth()
            case.render("still", size, True, f"0-{SETTLED}", "lens_%02d.exr")
            found = read_exr(case.folder / f"lens_{SETTLED}.exr")
        truth = (even + odd) / 2
        masked = wider(np.abs(shown(even) - shown(odd)).max(axis=2) > 8, 4)
        border = math.ceil(case.pixels_at_focus * max(math.hypot(*place) for place in case.places))
        for edge in (masked[:border], masked[-border:], masked[:, :border], masked[:, -border:]):
            edge[:] = True
        away = np.abs(shown(truth) - shown(found)).max(axis=2)
        judged = away[~masked]
        mean, percentile, over = judged.mean(), np.percentile(judged, 99), (judged > 32).mean()
        good = mean <= MEAN and percentile <= PERCENTILE and over <= OVER
        failed |= not good
        print(f"{name}: mean {mean:.3f}, 99th percentile {percentile:.2f}, over 32 {100 * over:.3f} %, masked {100 * masked.mean():.2f} %" +
              ("" if good else " MISSES"), flush=True)
        if options.keep:
            options.keep.mkdir(parents=True, exist_ok=True)
            strip = np.concatenate([shown(truth), shown(found), np.where(masked[..., None], (0, 0, 255), np.minimum(8 * away, 255)[..., None])], axis=1)
            (options.keep / f"{name}.png").write_bytes(encode(strip.shape[1], 3, strip.astype(np.uint8).tobytes()))
    sys.exit(failed)


main()
