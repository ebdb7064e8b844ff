"""Reads the PNGs that Weft writes (8 bits a channel, not interlaced) and writes small ones. For scripts that look at pictures and show them; needs
nothing installed."""
import struct
import zlib

CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}
COLORS = {channels: color for color, channels in CHANNELS.items()}


def chunks(data):
    at = 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        yield kind, data[at + 8:at + 8 + length]
        at += 12 + length


def read_text(path, key):
    """What a picture says about itself under a key, or nothing."""
    begins = key.encode("latin-1") + b"\0"
    return next((body[len(begins):].decode("latin-1") for kind, body in chunks(path.read_bytes()) if kind == b"tEXt" and body.startswith(begins)), None)


def read_size(path):
    return struct.unpack(">II", path.read_bytes()[16:24])


def read_png(path):
    """(channels, bytes of the texels, top row first), filters undone."""
    packed = b""
    for kind, body in chunks(path.read_bytes()):
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
        packed += body if kind == b"IDAT" else b""
    assert depth == 8
    channels = CHANNELS[color]
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


def paeth(a, b, c):
    p = a + b - c
    pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
    return a if pa <= pb and pa <= pc else b if pb <= pc else c


def filtered(row, before, channels):
    """The row by each of the five filters, their numbers before them."""
    left, corner = bytes(channels) + row, bytes(channels) + before
    yield b"\0" + row
    yield b"\1" + bytes((x - a) & 255 for x, a in zip(row, left))
    yield b"\2" + bytes((x - b) & 255 for x, b in zip(row, before))
    yield b"\3" + bytes((x - (a + b) // 2) & 255 for x, a, b in zip(row, left, before))
    yield b"\4" + bytes((x - paeth(a, b, c)) & 255 for x, a, b, c in zip(row, left, before, corner))


def write_png(path, width, channels, texels, text=()):
    """Each row by the filter that leaves the smallest sum, or all rows by one, whichever is smallest under zlib's level 9; without alpha where all of it
    is 255. `text`: pairs of key and words."""
    if channels == 4 and min(texels[3::4]) == 255:
        rgb = bytearray(len(texels) // 4 * 3)
        for c in range(3):
            rgb[c::3] = texels[c::4]
        channels, texels = 3, bytes(rgb)
    stride, before, ways = width * channels, bytes(width * channels), [[], [], []]
    distance = [min(value, 256 - value) for value in range(256)]
    for at in range(0, len(texels), stride):
        row = texels[at:at + stride]
        forms = list(filtered(row, before, channels))
        ways[0].append(min(forms, key=lambda form: sum(map(distance.__getitem__, form[1:]))))
        ways[1].append(forms[0])
        ways[2].append(forms[4])
        before = row
    packed = min((zlib.compress(b"".join(way), 9) for way in ways), key=len)
    header = struct.pack(">IIBBBBB", width, len(texels) // stride, 8, COLORS[channels], 0, 0, 0)
    parts = [(b"IHDR", header), *((b"tEXt", f"{key}\0{words}".encode("latin-1")) for key, words in text), (b"IDAT", packed), (b"IEND", b"")]
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)) for kind, body in parts))
