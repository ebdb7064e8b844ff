#!/usr/bin/env python3
"""What the crop of the defect `sun` should show, from the definition and without Weft: the light that a white metal of roughness 0.2 reflects of the map,
summed over the map for each pixel of the crop's middle. Prints it as defects.py --values prints that of the pictures.

GGX with Smith's height-correlated masking (Heitz, JCGT 2014), one bounce, as at this roughness the others add below 1 %. Texels within 6 degrees of the
brightest one count each by itself, all others in blocks of 4 x 4.
"""
import json
import math
import pathlib

HERE = pathlib.Path(__file__).resolve().parent
MAP = HERE.parents[1] / "scenes/environments/spiaggia_di_mondello_1k.hdr"
SIZE, CROP, PART, EXPOSURE, PLACES = (160, 90), (68, 33), (4, 4, 16, 16), -9, 2


def read_map():
    """Rows of (red, green, blue): Radiance's format, each row packed channel by channel."""
    data = MAP.read_bytes()
    at = data.index(b"\n\n") + 2
    end = data.index(b"\n", at)
    _, high, _, wide = data[at:end].split()
    at, rows = end + 1, []
    for _ in range(int(high)):
        at, row = at + 4, bytearray()
        while len(row) < 4 * int(wide):
            count, at = data[at], at + 1
            if count > 128:
                row += data[at:at + 1] * (count - 128)
                at += 1
            else:
                row += data[at:at + count]
                at += count
        red, green, blue, power = (row[c * int(wide):(c + 1) * int(wide)] for c in range(4))
        rows.append([tuple(math.ldexp(v, e - 136) if e else 0.0 for v in (r, g, b)) for r, g, b, e in zip(red, green, blue, power)])
    return rows


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def scaled(a, s):
    return [a[0] * s, a[1] * s, a[2] * s]


def unit(a):
    return scaled(a, 1 / math.sqrt(dot(a, a)))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def lights_of(rows):
    """(direction, red, green, blue), the colours times the solid angle."""
    high, wide = len(rows), len(rows[0])

    def light(x, y, step):
        polar, azimuth = math.pi * (y + step / 2) / high, 2 * math.pi * ((x + step / 2) / wide - 0.5)
        out = [0.0, 0.0, 0.0]
        for j in range(y, y + step):
            angle = math.sin(math.pi * (j + 0.5) / high) * math.pi / high * 2 * math.pi / wide
            for texel in rows[j][x:x + step]:
                for c in range(3):
                    out[c] += texel[c] * angle
        return (math.sin(polar) * math.cos(azimuth), math.cos(polar), math.sin(polar) * math.sin(azimuth)), *out

    _, x, y = max((sum(texel), x, y) for y, row in enumerate(rows) for x, texel in enumerate(row))
    brightest, near = light(x, y, 1)[0], math.cos(math.radians(6))
    lights = []
    for y in range(0, high, 4):
        for x in range(0, wide, 4):
            block = light(x, y, 4)
            close = dot(block[0], brightest) > near
            lights += [light(i, j, 1) for j in range(y, y + 4) for i in range(x, x + 4)] if close else [block]
    return lights


def reflected(lights, normal, view, alpha):
    a2, facing, out = alpha * alpha, dot(normal, view), [0.0, 0.0, 0.0]
    for towards, *colour in lights:
        cosine = dot(normal, towards)
        if cosine <= 0:
            continue
        half = [a + b for a, b in zip(towards, view)]
        spread = dot(normal, half) ** 2 / dot(half, half) * (a2 - 1) + 1
        masking = cosine * math.sqrt(facing * facing * (1 - a2) + a2) + facing * math.sqrt(cosine * cosine * (1 - a2) + a2)
        share = a2 / (math.pi * spread * spread) * 0.5 / masking * cosine
        for c in range(3):
            out[c] += share * colour[c]
    return out


def main():
    scene = json.loads("\n".join(line for line in (HERE / "defects/sun.json").read_text().splitlines() if not line.startswith("//")))
    camera, ball = scene["cameras"]["metal"], scene["spheres"][0]
    eye, tangent = camera["position"], math.tan(math.radians(camera["fov"] / 2))
    ahead = unit(scaled(eye, -1))  # the sphere and the target are at the origin
    right = unit(cross(ahead, [0, 1, 0]))
    up, (wide, high), lights = cross(right, ahead), SIZE, lights_of(read_map())
    total, count = [0.0, 0.0, 0.0], 0
    for y in range(CROP[1] + PART[1], CROP[1] + PART[1] + PART[3]):
        for x in range(CROP[0] + PART[0], CROP[0] + PART[0] + PART[2]):
            for k in range(PLACES * PLACES):
                across = ((x + (k % PLACES + 0.5) / PLACES) * 2 / wide - 1) * tangent * wide / high
                upward = (1 - (y + (k // PLACES + 0.5) / PLACES) * 2 / high) * tangent
                ray = unit([ahead[c] + across * right[c] + upward * up[c] for c in range(3)])
                middle = dot(eye, ray)
                normal = [eye[c] + (-middle - math.sqrt(middle * middle - dot(eye, eye) + 1)) * ray[c] for c in range(3)]
                colour = reflected(lights, normal, scaled(ray, -1), ball["material"]["roughness"] ** 2)
                total, count = [a + b for a, b in zip(total, colour)], count + 1
    red, green, blue = (math.ldexp(light / count, EXPOSURE) for light in total)
    print(f"sun, by the definition, {list(PART)}: red, green, blue {red:.4f}, {green:.4f}, {blue:.4f}; as shares of red {green / red:.2f}, {blue / red:.2f}")


main()
