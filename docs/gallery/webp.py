"""WebP pictures of the docs: written by cwebp and read by dwebp (Debian's package `webp`). What a picture says about itself, such as the command that
made it, is JSON in a chunk WEFT behind the picture, which readers of WebP skip."""
import json
import pathlib
import struct
import subprocess
import tempfile

from png import read_png

QUALITY = ["-q", "88", "-m", "6", "-sharp_yuv"]


def chunks(data):
    assert data[:4] == b"RIFF" and data[8:12] == b"WEBP", "no WebP"
    at = 12
    while at < len(data):
        kind, length = struct.unpack("<4sI", data[at:at + 8])
        yield kind, data[at + 8:at + 8 + length]
        at += 8 + length + length % 2


def chunk(kind, body):
    return kind + struct.pack("<I", len(body)) + body + b"\0" * (len(body) % 2)


def size_in(data):
    """(width, height): of a lossy picture without further features, and of one written here."""
    for kind, body in chunks(data):
        if kind == b"VP8X":
            return int.from_bytes(body[4:7], "little") + 1, int.from_bytes(body[7:10], "little") + 1
        if kind == b"VP8 ":
            return tuple(value & 0x3FFF for value in struct.unpack("<HH", body[6:10]))
    raise ValueError("no picture in it")


def read_size(path):
    return size_in(path.read_bytes())


def read_words(path):
    """What write_webp() was given as `words`, or nothing."""
    return next((json.loads(body) for kind, body in chunks(path.read_bytes()) if kind == b"WEFT"), {})


def write_webp(path, png, words):
    with tempfile.TemporaryDirectory() as folder:
        bare = pathlib.Path(folder) / "bare.webp"
        subprocess.run(["cwebp", "-quiet", *QUALITY, png, "-o", bare], check=True)
        data = bare.read_bytes()
    width, height = size_in(data)
    extended = bytes(4) + (width - 1).to_bytes(3, "little") + (height - 1).to_bytes(3, "little")
    picture = next(body for kind, body in chunks(data) if kind == b"VP8 ")
    body = b"WEBP" + chunk(b"VP8X", extended) + chunk(b"VP8 ", picture) + chunk(b"WEFT", json.dumps(words).encode())
    path.write_bytes(b"RIFF" + struct.pack("<I", len(body)) + body)


def read_webp(path):
    """(channels, bytes of the texels, top row first)."""
    with tempfile.TemporaryDirectory() as folder:
        png = pathlib.Path(folder) / "decoded.png"
        subprocess.run(["dwebp", "-quiet", path, "-o", png], check=True)
        return read_png(png)
