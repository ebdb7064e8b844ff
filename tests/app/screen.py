"""What a virtual display shows, panels and all, read from the file in which Xvfb keeps its frame buffer (-fbdir).
As a program: screen.py FOLDER OUT.png, to look at it."""
import pathlib
import struct
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "docs/gallery"))
from png import encode  # noqa: E402


class Screen:
    def __init__(self, folder):
        self.path = pathlib.Path(folder) / "Xvfb_screen0"

    def read(self):
        """Width, height, and rows of RGB bytes."""
        data = self.path.read_bytes()
        header = struct.unpack(">25I", data[:100])
        size, width, height, bits, line, colors = header[0], header[4], header[5], header[11], header[12], header[19]
        assert header[1] == 7 and bits == 32, "no XWD file of 32 bits"
        start = size + colors * 12
        rows = []
        for y in range(height):
            row = data[start + y * line:start + y * line + width * 4]
            rgb = bytearray(width * 3)
            rgb[0::3], rgb[1::3], rgb[2::3] = row[2::4], row[1::4], row[0::4]
            rows.append(bytes(rgb))
        return width, height, rows

    def pixel(self, x, y):
        data = self.path.read_bytes()
        header = struct.unpack(">25I", data[:100])
        at = header[0] + header[19] * 12 + y * header[12] + x * 4
        return tuple(data[at:at + 3])

    def pixels(self):
        """For comparing: everything, as bytes."""
        return self.path.read_bytes()

    def save(self, path):
        width, _, rows = self.read()
        pathlib.Path(path).write_bytes(encode(width, 3, b"".join(rows)))


if __name__ == "__main__":
    Screen(sys.argv[1]).save(sys.argv[2])
