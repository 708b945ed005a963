"""The comparison of pictures itself: it passes what is the same, and fails for a panel, a cloth or colours that are wrong.

SPDX-License-Identifier: Apache-2.0
"""
import itertools
import pathlib
import tempfile
import unittest

from window_pictures import (MOST_MEAN, MOST_STRONG, REFERENCES, Picture, alike, difference, read_reference,
                             write_reference)

SIZE = (320, 180)


def wide_references():
    return {path.stem: read_reference(path) for path in sorted(REFERENCES.glob("*.png"))}


def changed(picture, box, recolour):
    """With other pixels in a box. @param recolour of (blue, green, red, unused)"""
    left, top, right, bottom = box
    rows = list(picture.rows)
    for y in range(top, bottom):
        row = rows[y]
        part = b"".join(bytes(recolour(row[4 * x:4 * x + 4])) for x in range(left, right))
        rows[y] = row[:4 * left] + part + row[4 * right:]
    return Picture(picture.width, picture.height, rows)


class Comparison(unittest.TestCase):
    def setUp(self):
        self.references = wide_references()

    def test_each_reference_is_itself_and_no_other(self):
        self.assertGreater(len(self.references), 8)
        for name, picture in self.references.items():
            self.assertEqual(difference(picture, picture), (0.0, 0.0), name)
        for (a, first), (b, second) in itertools.combinations(self.references.items(), 2):
            if first.height * second.width == second.height * first.width:
                self.assertFalse(alike(first, second), f"{a} passes for {b}: {difference(first, second)}")

    def test_together_they_are_small(self):
        self.assertLess(sum(path.stat().st_size for path in REFERENCES.glob("*.png")), 300_000)

    def test_what_is_missing_or_wrong_is_found(self):
        start, heat = self.references["start"], self.references["heat-map"]
        ground = start.rows[35][4 * 90:4 * 90 + 4]  # beside the cloth
        dark = start.rows[170][4 * 300:4 * 300 + 4]
        for what, picture, wrong in [
                ("no fabric panel", start, changed(start, (0, 6, 78, 162), lambda p: ground)),
                ("no plots", start, changed(start, (235, 6, 320, 162), lambda p: dark)),
                ("no bar below", start, changed(start, (0, 163, 320, 180), lambda p: ground)),
                ("no cloth", start, changed(start, (100, 20, 230, 150), lambda p: ground)),
                ("no colour bar", heat, changed(heat, (205, 5, 234, 50), lambda p: ground)),
                ("red and blue changed", heat, changed(heat, (0, 0, *SIZE), lambda p: (p[2], p[1], p[0], 0))),
                ("colours of the map turned round", heat,
                 changed(heat, (100, 20, 234, 150), lambda p: (p[2], p[1], p[0], 0))),
                ("too dark", start, changed(start, (0, 0, *SIZE), lambda p: (int(0.9 * v) for v in p)))]:
            with self.subTest(what):
                found = difference(picture, wrong)
                self.assertFalse(alike(picture, wrong), f"{what} passes: {found}")
                print(f"{what}: mean {found[0]:.2f}, strong {found[1]:.4f} (most {MOST_MEAN}, {MOST_STRONG})")

    def test_a_pulled_cloth_may_fold_otherwise_but_is_there(self):
        grab = self.references["grab"]
        ground = grab.rows[35][4 * 90:4 * 90 + 4]
        self.assertTrue(alike(grab, grab, pulled=True))
        for what, wrong in [("no cloth", changed(grab, (100, 20, 230, 150), lambda p: ground)),
                            ("no plots", changed(grab, (235, 6, 320, 162), lambda p: ground)),
                            ("no bar below", changed(grab, (0, 163, 320, 180), lambda p: ground))]:
            self.assertFalse(alike(grab, wrong, pulled=True), what)

    def test_a_reference_comes_back_as_it_was_written(self):
        start = self.references["start"]
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "again.png"
            write_reference(path, start)
            self.assertEqual(read_reference(path).rows, start.rows)


if __name__ == "__main__":
    unittest.main()
