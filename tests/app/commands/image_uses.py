#!/usr/bin/env python3
"""docs/tutorials/pictures.json reads an image as background, lookup table, mask and noise. Its picture is held against what this file computes from
the definition of each: texels as the files have them, bilinear filtering, repetition, the sRGB curve. The three small images are those that are
made here.

    image_uses.py WEFT [--write]      --write makes the images anew
"""
import pathlib
import sys

from pictures import png, read_png
from program import TOP, Report, run, temporary_folder

FOLDER = TOP / "docs/tutorials"
SIZE = (320, 180)  # of the background, so that its texels are the pixels


def ramp_row():
    """16 colors of an old print: brown black, warm gray, cream."""
    stops = ((28, 16, 12), (128, 98, 70), (250, 240, 218))
    row = []
    for i in range(16):
        at = i / 15 * 2
        low, high = stops[min(int(at), 1)], stops[min(int(at), 1) + 1]
        row.append(tuple(round(a + (b - a) * (at - min(int(at), 1))) for a, b in zip(low, high)))
    return [row]


def mask_rows(width=32, height=18):
    """White in the left, black in the right, with a slanted edge."""
    return [[(min(255, max(0, round(127.5 + 24 * (width / 2 - x + (y - height / 2) / 2)))),) for x in range(width)] for y in range(height)]


def noise_rows(size=16):
    """Interleaved gradient noise (Jimenez, "Next generation post processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014 courses)."""
    return [[(int(52.9829189 * ((0.06711056 * x + 0.00583715 * y) % 1) % 1 * 256),) for x in range(size)] for y in range(size)]


IMAGES = {"ramp": ramp_row, "mask": mask_rows, "noise": noise_rows}


def decode(value):
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def encode(value):
    value = min(max(value, 0), 1)
    return 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055


def bilinear(rows, u, v):
    """Channels from 0 to 1 at a place from the lower left; beyond the last texel's middle it goes on."""
    height, width = len(rows), len(rows[0])
    x, y = u * width - 0.5, v * height - 0.5
    left, low = int(x // 1), int(y // 1)

    def texel(i, j):
        return rows[height - 1 - min(max(j, 0), height - 1)][min(max(i, 0), width - 1)]

    return [sum(weight * texel(left + i, low + j)[c] for i, j, weight in ((0, 0, (1 - x + left) * (1 - y + low)), (1, 0, (x - left) * (1 - y + low)),
                                                                          (0, 1, (1 - x + left) * (y - low)), (1, 1, (x - left) * (y - low)))) / 255
            for c in range(len(texel(0, 0)))]


def pixel(images, background, x, y, grain):
    """What the tutorial says, at a pixel counted from the upper left."""
    (width, height), up = SIZE, SIZE[1] - 1 - y
    u, v = (x + 0.5) / width, (up + 0.5) / height
    shown = [c / 255 for c in background[y][x][:3]]
    light = sum(weight * decode(c) for weight, c in zip((0.2126, 0.7152, 0.0722), shown))
    toned = bilinear(images["ramp"], (encode(light) * 15 + 0.5) / 16, 0.5)
    share = bilinear(images["mask"], u, v)[0]
    rows = images["noise"]
    speck = rows[len(rows) - 1 - up % len(rows)][x % len(rows[0])][0] / 255 - 0.5
    return [min(max(a + (b - a) * share + grain * speck, 0), 1) * 255 for a, b in zip(shown, toned)]


def main():
    weft, report = pathlib.Path(sys.argv[1]).resolve(), Report()
    images = {name: make() for name, make in IMAGES.items()}
    for name, rows in images.items():
        path = FOLDER / f"images/{name}.png"
        if "--write" in sys.argv:
            path.write_bytes(png(rows))
        report.check(read_png(path.read_bytes()) == rows, f"{path} is not what this file makes")
    background = read_png((TOP / "docs/tutorials/images/background.png").read_bytes())
    report.check((len(background[0]), len(background)) == SIZE, f"the background is {len(background[0])}x{len(background)}")
    with temporary_folder() as folder:
        for grain in (0.04, 0.2):
            out = pathlib.Path(folder, "out.png")
            done = run(weft, "render", FOLDER / "pictures.json", "--size", f"{SIZE[0]}x{SIZE[1]}", "--set", f"grain={grain}", "--quiet", "-o", out)
            if not report.check(done.code == 0 and not done.err, f"{done.code}\n{done.err}"):
                break
            shown = read_png(out.read_bytes())
            # A prime step: places in every column of the noise and on both sides of the mask.
            places = [(at % SIZE[0], at // SIZE[0]) for at in range(0, SIZE[0] * SIZE[1], 89)]
            errors = [max(abs(a - b) for a, b in zip(shown[y][x], pixel(images, background, x, y, grain))) for x, y in places]
            worst = max(range(len(errors)), key=errors.__getitem__)
            report.check(errors[worst] < 1.5 and sum(errors) / len(errors) < 0.5, f"grain {grain}: {errors[worst]:.2f} of 255 at {places[worst]}, {sum(errors) / len(errors):.2f} on average")
            print(f"grain {grain}: {len(places)} pixels differ by {errors[worst]:.2f} of 255 at most, by {sum(errors) / len(errors):.2f} on average")
    report.end()


main()
