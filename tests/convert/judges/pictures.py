"""Small PNG files in and out, with Python alone: 8 bits a channel, rows from the top."""
import pathlib
import struct
import zlib


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_png(path, width, height, rgb):
    rows = b"".join(b"\0" + bytes(rgb[3 * width * y:3 * width * (y + 1)]) for y in range(height))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    pathlib.Path(path).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def unfilter(kind, row, above, size):
    for i in range(len(row)):
        left = row[i - size] if i >= size else 0
        up = above[i]
        corner = above[i - size] if i >= size else 0
        if kind == 1:
            row[i] = (row[i] + left) & 255
        elif kind == 2:
            row[i] = (row[i] + up) & 255
        elif kind == 3:
            row[i] = (row[i] + (left + up) // 2) & 255
        elif kind == 4:
            guess = left + up - corner
            nearest = min((left, up, corner), key=lambda each: abs(guess - each))
            row[i] = (row[i] + nearest) & 255


def read_png(path):
    """(width, height, RGB bytes) of an RGB or RGBA file of 8 bits that is not interlaced."""
    data, at, parts = pathlib.Path(path).read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        at += 12 + length
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", body)
            assert depth == 8 and color in (2, 6) and not interlaced, f"{path}: another kind of PNG"
        elif kind == b"IDAT":
            parts += body
    size = 3 if color == 2 else 4
    raw, rgb, above = zlib.decompress(parts), bytearray(), bytearray(width * size)
    for y in range(height):
        begin = y * (width * size + 1)
        row = bytearray(raw[begin + 1:begin + 1 + width * size])
        unfilter(raw[begin], row, above, size)
        above = row
        rgb += row if size == 3 else b"".join(bytes(row[4 * x:4 * x + 3]) for x in range(width))
    return width, height, bytes(rgb)


def difference(a, b):
    """(mean, largest) of 255."""
    each = [abs(x - y) for x, y in zip(a, b)]
    return sum(each) / len(each), max(each)
