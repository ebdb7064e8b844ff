"""PNG by its definition, with nothing but the standard library: reads files of 8 bits a channel that are not interlaced, and writes quickly or small.
For every script of docs/ and tests/ that looks at pictures, shows them, or judges the files that Weft reads and writes."""
import struct
import zlib
from itertools import accumulate, repeat
from operator import add, and_

SIGNATURE = b"\x89PNG\r\n\x1a\n"
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


def decode(data):
    """(width, channels, bytes of the texels, top row first), filters undone."""
    assert data[:8] == SIGNATURE, "no PNG"
    packed = b""
    for kind, body in chunks(data):
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlaced = struct.unpack(">IIBBBBB", body)
        packed += body if kind == b"IDAT" else b""
    assert depth == 8 and not interlaced, f"{depth} bits a channel, interlaced: {interlaced}"
    channels = CHANNELS[color]
    raw, stride, before, out = zlib.decompress(packed), width * channels, bytearray(width * channels), bytearray()
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        if kind == 1:
            for c in range(channels):
                row[c::channels] = bytes(map(and_, accumulate(row[c::channels]), repeat(255)))
        elif kind == 2:
            row = bytearray(map(and_, map(add, row, before), repeat(255)))
        elif kind:
            left, corner = [0] * channels, [0] * channels  # of the next texel
            for x, (value, b) in enumerate(zip(row, before)):
                a, c = left[x % channels], corner[x % channels]
                row[x] = left[x % channels] = (value + ((a + b) // 2 if kind == 3 else paeth(a, b, c))) & 255
                corner[x % channels] = b
        out += row
        before = row
    return width, channels, bytes(out)


def read_png(path):
    """(channels, bytes of the texels, top row first)."""
    return decode(path.read_bytes())[1:]


def assemble(width, height, bits, channels, packed, text=()):
    header = struct.pack(">IIBBBBB", width, height, bits, COLORS[channels], 0, 0, 0)
    parts = [(b"IHDR", header), *((b"tEXt", f"{key}\0{words}".encode("latin-1")) for key, words in text), (b"IDAT", packed), (b"IEND", b"")]
    return SIGNATURE + b"".join(struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)) for kind, body in parts)


def encode(width, channels, texels, bits=8):
    """The file, quickly: no filters. `texels`: bytes, top row first, high bytes first where `bits` is 16."""
    stride = width * channels * bits // 8
    rows = [texels[at:at + stride] for at in range(0, len(texels), stride)]
    return assemble(width, len(rows), bits, channels, zlib.compress(b"".join(b"\0" + row for row in rows)))


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
    path.write_bytes(assemble(width, len(texels) // stride, 8, channels, packed, text))
