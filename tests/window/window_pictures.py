"""Pictures of the window: what is on the virtual screen, small references, and a tolerant comparison.

A picture is compared cell by cell, 64 x 36 cells of a wide screen with the mean colour of each: letters and lines melt into it,
panels, cloths and colours do not. Two figures: how much the cells differ on the mean, and which part of them
differs strongly. docs/viewer.md, "Pictures in the tests", says what they measure between runs and for defects.

SPDX-License-Identifier: Apache-2.0
"""
import array
import pathlib
import struct
import zlib

REFERENCES = pathlib.Path(__file__).parent / "reference"
REFERENCE_WIDTH = 320  # pixels
COLOURS = 64           # of a reference
COLUMNS = 64
STRONG = 20            # of 255: a cell differs strongly
# Between the runs' figures and those of the least defect (test_pictures.py).
MOST_MEAN, MOST_STRONG = 1.5, 0.004
# Of the cloths alone, that were pulled: two solvers folded them 10 and 0.16 apart.
MOST_PULLED_MEAN, MOST_PULLED_STRONG = 20.0, 0.3
VIEW = (316, 24, 932, 648)


class Picture:
    """Rows of bytes, 4 a pixel: blue, green, red, unused."""

    def __init__(self, width, height, rows):
        self.width, self.height, self.rows = width, height, rows

    def count(self, red, green, blue, box=None):
        """Pixels of exactly this colour. @param box left, top, right, bottom"""
        left, top, right, bottom = box or (0, 0, self.width, self.height)
        value = red << 16 | green << 8 | blue
        total = 0
        for row in self.rows[top:bottom]:
            pixels = array.array("I", row[4 * left:4 * right])
            total += pixels.count(value) + pixels.count(value | 0xff000000)
        return total

    def part(self, box):
        left, top, right, bottom = box
        return Picture(right - left, bottom - top, [row[4 * left:4 * right] for row in self.rows[top:bottom]])

    def shrink(self, columns, rows):
        """Mean colours of cells, (red, green, blue) row by row."""
        cells = []
        bounds = [x * self.width // columns for x in range(columns + 1)]
        for y in range(rows):
            sums = [[0, 0, 0] for _ in range(columns)]
            top, bottom = y * self.height // rows, (y + 1) * self.height // rows
            for row in self.rows[top:bottom]:
                for channel in range(3):
                    values = row[2 - channel::4]
                    for x in range(columns):
                        sums[x][channel] += sum(values[bounds[x]:bounds[x + 1]])
            for x in range(columns):
                count = (bounds[x + 1] - bounds[x]) * (bottom - top)
                cells.append(tuple(s / count for s in sums[x]))
        return cells


def read_screen(path):
    """@param path of Xvfb's frame buffer: an XWD file, header, colours, rows"""
    data = pathlib.Path(path).read_bytes()
    header = struct.unpack(">25I", data[:100])
    width, height, stride = header[4], header[5], header[12]
    start = header[0] + 12 * header[19]
    return Picture(width, height, [data[start + y * stride:start + y * stride + 4 * width] for y in range(height)])


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def palette_of(pixels):
    """Median cut: the box with the widest channel is halved until there are COLOURS."""
    def spread(box):
        return max((max(p[c] for p in box) - min(p[c] for p in box), c) for c in range(3))

    boxes = [(spread(pixels), pixels)]
    while len(boxes) < COLOURS:
        boxes.sort(key=lambda b: b[0][0] * len(b[1]) ** 0.5)
        (width, channel), box = boxes.pop()
        if width == 0:
            boxes.append(((width, channel), box))
            break
        box = sorted(box, key=lambda p: p[channel])
        # At a change of colour: equal ones stay together.
        middle = next((i for i in range(len(box) // 2, len(box)) if box[i][channel] != box[i - 1][channel]), 0)
        middle = middle or next(i for i in range(len(box) // 2, 0, -1) if box[i][channel] != box[i - 1][channel])
        boxes += [(spread(half), half) for half in (box[:middle], box[middle:])]
    return [tuple(round(sum(p[c] for p in box) / len(box)) for c in range(3)) for _, box in boxes]


def write_reference(path, picture):
    width = min(REFERENCE_WIDTH, picture.width)
    height = round(width * picture.height / picture.width)
    pixels = [tuple(round(v) for v in cell) for cell in picture.shrink(width, height)]
    palette = palette_of(pixels)
    nearest = {p: min(range(len(palette)), key=lambda i: sum((a - b) ** 2 for a, b in zip(palette[i], p)))
               for p in set(pixels)}
    rows = b"".join(b"\0" + bytes(nearest[p] for p in pixels[y * width:(y + 1) * width]) for y in range(height))
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)) +
                     chunk(b"PLTE", b"".join(map(bytes, palette))) + chunk(b"IDAT", zlib.compress(rows, 9)) +
                     chunk(b"IEND", b""))


def read_reference(path):
    """What write_reference() wrote: a palette, no filters."""
    data, at, chunks = path.read_bytes(), 8, {}
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        chunks[kind] = data[at + 8:at + 8 + length]
        at += 12 + length
    width, height = struct.unpack(">II", chunks[b"IHDR"][:8])
    palette = [bytes((p[2], p[1], p[0], 0)) for p in
               (chunks[b"PLTE"][i:i + 3] for i in range(0, len(chunks[b"PLTE"]), 3))]
    rows = zlib.decompress(chunks[b"IDAT"])
    return Picture(width, height, [b"".join(palette[i] for i in rows[y * (width + 1) + 1:(y + 1) * (width + 1)])
                                   for y in range(height)])


def difference(a, b):
    """@return mean difference of the cells [0 to 255], part of them that differs strongly [0 to 1]"""
    rows = round(COLUMNS * a.height / a.width)
    differences = [[abs(p - q) for p, q in zip(x, y)]
                   for x, y in zip(a.shrink(COLUMNS, rows), b.shrink(COLUMNS, rows))]
    mean = sum(map(sum, differences)) / (3 * len(differences))
    return mean, sum(max(d) > STRONG for d in differences) / len(differences)


def without(picture, box):
    left, top, right, bottom = box
    blank = bytes(4 * (right - left))
    rows = [row[:4 * left] + blank + row[4 * right:] if top <= y < bottom else row
            for y, row in enumerate(picture.rows)]
    return Picture(picture.width, picture.height, rows)


def view_of(picture):
    """Where the cloths are in a window of 1280 x 720 with both side panels."""
    return [v * picture.width // 1280 for v in VIEW]


def alike(a, b, pulled=False):
    """@param pulled: a cloth that was pulled folds by the last bits of its numbers, which differ from processor to
    processor: what is beside the cloths is compared as ever, and the cloths loosely."""
    if not pulled:
        mean, strong = difference(a, b)
        return mean <= MOST_MEAN and strong <= MOST_STRONG
    mean, strong = difference(a.part(view_of(a)), b.part(view_of(b)))
    return mean <= MOST_PULLED_MEAN and strong <= MOST_PULLED_STRONG and alike(
        without(a, view_of(a)), without(b, view_of(b)))
