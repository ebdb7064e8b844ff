#!/usr/bin/env python3
"""The color tables of the presets, from a few lines of arithmetic each.

    make_luts.py            write the .cube files beside this script
    make_luts.py --check    exit 1 when one of them is not what would be written

Tables work on display-referred, sRGB encoded values, 17 entries along an axis, red fastest. They are looks, made up here;
none imitates a product. Numbers are rounded to four places, so that any machine writes the same bytes.
"""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
SIZE = 17
WEIGHTS = (0.2126, 0.7152, 0.0722)


def clamp(x, low=0.0, high=1.0):
    return min(max(x, low), high)


def mix(a, b, t):
    return a + (b - a) * t


def each(f, color):
    return tuple(f(c) for c in color)


def luma(color, weights=WEIGHTS):
    return sum(w * c for w, c in zip(weights, color))


def saturate(color, amount):
    gray = luma(color)
    return each(lambda c: mix(gray, c, amount), color)


def s_curve(x, strength):
    """Between the identity, 0, and 3 x^2 - 2 x^3, 1: darker shadows, brighter highlights, 0.5 and both ends stay."""
    return mix(x, x * x * (3 - 2 * x), strength)


def split_tone(color, shadows, highlights):
    """Adds one color to the shadows and another to the highlights; black and white keep their place."""
    gray = clamp(luma(color))
    dark, light = gray * (1 - gray) ** 2 * 4, gray * gray * (1 - gray) * 4
    return tuple(c + dark * s + light * h for c, s, h in zip(color, shadows, highlights))


def cinema(color):
    """Soft contrast, teal shadows, warm highlights, greens held back."""
    r, g, b = saturate(each(lambda c: s_curve(c, 0.35), color), 0.92)
    g = mix(g, max(r, b), 0.25 * clamp(g - max(r, b)))
    r, g, b = split_tone((r, g, b), (-0.035, 0.005, 0.03), (0.03, 0.008, -0.03))
    return each(lambda c: 0.015 + 0.97 * c, (r, g, b))


def warm_negative(color):
    """A print from color negative: open shadows that stay neutral, long highlights from orange to a pink white, milder colors."""
    color = each(lambda c: mix(c, c ** 0.9, 0.5), saturate(color, 0.95))
    color = split_tone(color, (0.005, -0.005, 0.005), (0.04, 0.0, -0.03))
    return tuple(low + (high - low) * c for c, low, high in zip(color, (0.03, 0.028, 0.034), (0.99, 0.955, 0.92)))


def slide(color):
    """Reversal film: steep from deep, cool blacks on, strong colors; a short shoulder keeps the highlights apart."""
    color = each(lambda c: s_curve(c, 0.75), saturate(color, 1.15))
    color = each(lambda c: c - 0.12 * clamp(c) ** 6, color)
    return split_tone(color, (-0.02, -0.005, 0.03), (0.012, 0.0, -0.008))


def black_and_white(color):
    """Panchromatic film behind a yellow filter: blue skies darken, skin and sand lighten."""
    gray = s_curve(clamp(luma(color, (0.42, 0.5, 0.08))), 0.5)
    return (gray, gray, gray)


def bleach_bypass(color):
    """Silver left in the print: a gray picture laid over the colored one, hard and pale."""
    gray = luma(color)
    over = each(lambda c: 2 * c * gray if gray < 0.5 else 1 - 2 * (1 - c) * (1 - gray), color)
    return saturate(tuple(mix(c, o, 0.75) for c, o in zip(color, over)), 0.6)


def day_for_night(color):
    """A day scene taken for night: dark, blue, most colors gone, highlights dimmed."""
    r, g, b = saturate(color, 0.45)
    return each(lambda c: 0.62 * c ** 1.35, (0.7 * r, 0.88 * g, 1.15 * b))


TABLES = [cinema, warm_negative, slide, black_and_white, bleach_bypass, day_for_night]


def text_of(table):
    lines = [f'TITLE "{table.__name__}"', f"LUT_3D_SIZE {SIZE}"]
    steps = [i / (SIZE - 1) for i in range(SIZE)]
    for b in steps:
        for g in steps:
            for r in steps:
                lines.append(" ".join(f"{clamp(c):.4f}" for c in table((r, g, b))))
    return "\n".join(lines) + "\n"


def main():
    wrong = 0
    for table in TABLES:
        path, text = HERE / f"{table.__name__}.cube", text_of(table)
        if sys.argv[1:] != ["--check"]:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            print(f"{path} is not what make_luts.py writes")
            wrong = 1
    return wrong


if __name__ == "__main__":
    sys.exit(main())
