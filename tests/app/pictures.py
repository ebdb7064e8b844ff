"""Picture files made and read from the definitions of their formats, with nothing but the standard library: what judges Weft's own
readers and writers. Pictures are lists of rows, top row first; a texel is a tuple of channels."""
import pathlib
import struct
import sys
import zlib
from itertools import accumulate, repeat
from operator import and_

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "docs/gallery"))
from png import decode, encode  # noqa: E402


def png(rows, bits=8):
    """Tuples of 1 to 4 whole numbers."""
    form = ">B" if bits == 8 else ">H"
    return encode(len(rows[0]), len(rows[0][0]), b"".join(struct.pack(form, c) for row in rows for texel in row for c in texel), bits)


def hdr(rows):
    """Radiance without run lengths, of texels (r, g, b, e) as they are stored: r * 2^(e - 136)."""
    return (b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (len(rows), len(rows[0])) +
            b"".join(bytes(texel) for row in rows for texel in row))


def exr(rows, half=False):
    """OpenEXR in scan lines, not compressed, with channels R, G, B, A."""
    height, width = len(rows), len(rows[0])
    names, form, kind = "ABGR", "<e" if half else "<f", 1 if half else 2

    def attribute(name, kind, data):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(data)) + data

    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(c.encode() + b"\0" + struct.pack("<iB3xii", kind, 0, 1, 1) for c in names) + b"\0"
    header = (struct.pack("<II", 20000630, 2) + attribute("channels", "chlist", channels) + attribute("compression", "compression", b"\0") +
              attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box) + attribute("lineOrder", "lineOrder", b"\0") +
              attribute("pixelAspectRatio", "float", struct.pack("<f", 1)) +
              attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)) +
              attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0")
    lines = [b"".join(struct.pack(form, texel["RGBA".index(c)]) for c in names for texel in row) for row in rows]
    place = len(header) + 8 * height
    table, data = b"", b""
    for y, line in enumerate(lines):
        table += struct.pack("<Q", place + len(data))
        data += struct.pack("<ii", y, len(line)) + line
    return header + table + data


def jpeg(levels):
    """A gray baseline JPEG of one row of 8x8 blocks, each of one level: only the first coefficient of a block is not 0. `levels` are
    the differences from 128; the quantizer is 8, so that the coefficient is the level itself."""
    def segment(marker, data):
        return bytes([0xFF, marker]) + struct.pack(">H", len(data) + 2) + data

    # Lengths of differences, 0 to 6, as codes of three bits (111 must stay free); the end of a block as the one code 0.
    dc = segment(0xC4, b"\x00" + bytes([0, 0, 7] + [0] * 13) + bytes(range(7)))
    ac = segment(0xC4, b"\x10" + bytes([1] + [0] * 15) + b"\x00")
    bits, before = "", 0
    for level in levels:
        difference, before = level - before, level
        length = abs(difference).bit_length()
        bits += format(length, "03b")
        if length:
            bits += format(difference if difference > 0 else difference + (1 << length) - 1, f"0{length}b")
        bits += "0"
    bits += "1" * (-len(bits) % 8)
    data = bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8)).replace(b"\xff", b"\xff\0")
    return (b"\xff\xd8" + segment(0xDB, b"\0" + bytes([8] * 64)) + segment(0xC0, struct.pack(">BHHBBBB", 8, 8, 8 * len(levels), 1, 1, 0x11, 0)) +
            dc + ac + segment(0xDA, bytes([1, 1, 0, 0, 63, 0])) + data + b"\xff\xd9")


def read_exr(data, most=None):
    """The first rows, `most` at least, or all, of tuples (R, G, B, A) or (Y,): scan lines of floats or halves, not compressed or ZIP."""
    assert data[:4] == struct.pack("<I", 20000630)
    at, attributes = 8, {}
    while data[at]:
        name, kind = (data[at:].split(b"\0", 2)[i].decode() for i in (0, 1))
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<I", data, at)[0]
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    at += 1
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    channels, rest = [], attributes["channels"]
    while rest[0]:
        name, rest = rest.split(b"\0", 1)
        channels.append((name.decode(), struct.unpack_from("<i", rest)[0]))
        rest = rest[16:]
    compression = attributes["compression"][0]
    lines = {0: 1, 2: 1, 3: 16}[compression]
    row_bytes = sum(width * (2 if kind == 1 else 4) for _, kind in channels)
    chunks = -(-min(height, most or height) // lines)
    rows = []
    for place in struct.unpack_from(f"<{chunks}Q", data, at):
        first, size = struct.unpack_from("<ii", data, place)
        raw, wanted = data[place + 8:place + 8 + size], row_bytes * min(lines, top + height - first)
        if size < wanted:  # deflated: differences of bytes, the even ones first
            mixed = bytearray(map(and_, accumulate(zlib.decompress(raw)), repeat(255)))
            mixed[1::2] = mixed[1::2].translate(bytes(value ^ 128 for value in range(256)))
            half = (len(mixed) + 1) // 2
            raw = bytearray(len(mixed))
            raw[0::2], raw[1::2] = mixed[:half], mixed[half:]
        for y in range(wanted // row_bytes):
            planes, place_in = {}, y * row_bytes
            for name, kind in channels:
                planes[name] = struct.unpack_from(f"<{width}{'e' if kind == 1 else 'f'}", raw, place_in)
                place_in += width * (2 if kind == 1 else 4)
            rows.append(list(zip(*(planes[c] for c in ("RGBA" if "R" in planes else "Y") if c in planes))))
    return rows


def read_png(data):
    """Rows of tuples of bytes, of a PNG of 8 bits a channel that is not interlaced."""
    width, channels, texels = decode(data)
    row = width * channels
    return [[tuple(texels[x:x + channels]) for x in range(at, at + row, channels)] for at in range(0, len(texels), row)]
