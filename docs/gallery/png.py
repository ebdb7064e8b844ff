"""Reads the PNGs that Weft writes: 8 bits a channel, not interlaced. For scripts that look at pictures; needs nothing installed."""
import struct
import zlib


def read_png(path):
    """(channels, bytes of the texels, top row first), filters undone."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
        packed += body if kind == b"IDAT" else b""
        at += 12 + length
    assert depth == 8
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    raw, stride, before, out = zlib.decompress(packed), width * channels, bytearray(width * channels), bytearray()
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for x in range(stride):
            a = row[x - channels] if x >= channels else 0
            b, c = before[x], before[x - channels] if x >= channels else 0
            if kind == 4:
                p = a + b - c
                near = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
            else:
                near = (0, a, b, (a + b) // 2)[kind]
            row[x] = (row[x] + near) & 255
        out, before = out + row, row
    return channels, bytes(out)
