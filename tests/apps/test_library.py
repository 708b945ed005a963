"""The fabric library through the program: search, comparison, card and report, and wrong input to each.

SPDX-License-Identifier: Apache-2.0
"""
import base64
import math
import shlex
import struct
import unittest
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser

from program_tools import FABRIC, SOURCE, Case, as_nobody

# A lattice of 2 cm: a tenth of a second a specimen.
COARSE = ["--spacing", "2cm", "--runs", "2", "--no-bands"]
PNG = b"\x89PNG\r\n\x1a\n"
NO_DRIVER = {"__EGL_VENDOR_LIBRARY_FILENAMES": "/dev/null"}  # any file that is no driver description


def ids(result):
    return [fabric["id"] for fabric in result["fabrics"]]


class Unit(Case):
    def test_search(self):
        everything = ids(self.json_of("fabrics"))
        self.assertEqual(ids(self.json_of("fabrics", "Wool", "plain")), ["wool-tropical"])
        self.assertEqual(ids(self.json_of("fabrics", "--measured", "bending", "--measured", "shear")),
                         ["cotton-knit-shirley", "cupro-woven-su1098"])
        light = ids(self.json_of("fabrics", "--max-mass", "110g/m2"))
        self.assertEqual(light, ["cupro-woven-su1098", "polyester-faille"])
        heavy = ids(self.json_of("fabrics", "--min-mass", "11mg/cm2"))
        self.assertEqual(sorted(light + heavy), sorted(everything))
        # Nothing found is an answer.
        done = self.run_program("fabrics", "no-such-word")
        self.assertEqual(done.stdout, "")
        self.assertIn("no bundled fabric is like that", done.stderr)
        self.assertEqual(self.json_of("fabrics", "no-such-word"), {"fabrics": []})

    def test_comparison(self):
        names = ["wool-tropical", "polyester-faille", "graded-10", "cupro-woven-su1098", "cotton-knit-shirley", "graded-1"]
        result = self.json_of("fabric", "compare", *names)
        self.assertEqual(ids(result), names)
        self.assertEqual(result["reference"], "wool-tropical")
        bending = result["numbers"]["bending.warp.B_gf_cm2_per_cm"]
        self.assertEqual(bending["values"][:2], [0.067, 0.019])
        self.assertEqual(bending["kinds"][:3], ["measured", "measured", "statistic"])
        self.assertEqual(bending["threshold"], "22 %")
        self.assertEqual((bending["difference_percent"][0], bending["difference_jnd"][0]), (0, 0))
        self.assertAlmostEqual(bending["difference_percent"][1], 100 * (0.019 / 0.067 - 1), places=9)
        self.assertAlmostEqual(bending["difference_jnd"][1], math.log(0.019 / 0.067) / math.log(1.22), places=9)
        shear = result["numbers"]["shear.G_gf_per_cm_deg"]
        self.assertEqual(shear["kinds"][0], "assumed")
        self.assertIn("G was not measured", shear["sources"][0])
        self.assertEqual(shear["difference_percent"], [None] * 6)
        self.assertEqual(result["numbers"]["tensile.warp.EMT_percent"]["conditions"][3], "to 108 gf/cm")
        for entry in result["numbers"].values():
            for key in ["values", "kinds", "sources", "conditions", "difference_percent", "difference_jnd"]:
                self.assertEqual(len(entry[key]), 6)
        self.assertTrue(all(t["source"] for t in result["thresholds"]))

    def test_comparison_fits_a_terminal(self):
        names = ["wool-tropical", "polyester-faille", "graded-10", "cupro-woven-su1098", "cotton-knit-shirley", "graded-1"]
        done = self.run_program("fabric", "compare", *names)
        for line in done.stdout.splitlines():
            self.assertLessEqual(len(line), 100, line)
        self.assertIn("0.067 m", done.stdout)
        self.assertIn("0.8 a", done.stdout)
        self.assertIn("(-6.3)", done.stdout)

    def test_a_file_of_ones_own_is_compared_too(self):
        self.write("mine.fabric.toml", FABRIC)
        result = self.json_of("fabric", "compare", "mine.fabric.toml", "wool-tropical")
        self.assertEqual(ids(result), ["mine", "wool-tropical"])
        self.assertEqual(result["numbers"]["thickness.T_mm"]["kinds"], ["assumed", "measured"])


class Safety(Case):
    def test_wrong_fabrics(self):
        self.refuse("fabric", "compare", "wool-tropical", "wool-tropicl", says="did you mean wool-tropical?")
        self.refuse("fabric", "compare", "wool-tropical", expect=2, says="needs two to six fabrics, not 1")
        seven = ["graded-1"] * 7
        self.refuse("fabric", "compare", *seven, expect=2, says="not 7")
        self.refuse("report", *seven, "-o", "r.html", expect=2, says="not 7")
        self.refuse("report", "none.toml", "-o", "r.html", says="none.toml")
        self.refuse("fabric", "card", "none", "-o", "c.png", says="no bundled fabric")
        self.write("broken.fabric.toml", "format = \n")
        self.refuse("fabric", "card", "broken.fabric.toml", "-o", "c.png", says="broken.fabric.toml:1")
        self.refuse("report", "wool-tropical", "broken.fabric.toml", "-o", "r.html", says="broken.fabric.toml:1")
        self.run_program("fabric", "compare", expect=2)
        self.run_program("report", "-o", "r.html", expect=2)
        self.run_program("fabric", "card", "wool-tropical", expect=2)

    def test_wrong_values(self):
        for words, says in [(["fabrics", "--min-mass", "100"], "--min-mass"), (["fabrics", "--max-mass", "1kg"], "--max-mass"),
                            (["fabrics", "--min-mass", "2kg/m2", "--max-mass", "1kg/m2"], "exchange the two"),
                            (["fabric", "card", "wool-tropical", "-o", "c.pdf"], ".png, .svg or .html"),
                            (["fabric", "card", "wool-tropical", "-o", "c.png", "--disc", "18"], "--disc"),
                            (["report", "wool-tropical", "-o", "r.pdf"], "end the name in .html"),
                            (["report", "wool-tropical", "-o", "r.html", "--spacing", "5"], "--spacing")]:
            self.refuse(*words, expect=2, says=says)
        self.run_program("fabrics", "--measured", "colour", expect=2)

    def test_places_that_cannot_be_written_show_before_the_long_run(self):
        for words, name in [(["fabric", "card", "wool-tropical"], "c.png"), (["report", "wool-tropical"], "r.html")]:
            self.refuse(*words, "-o", "none/" + name, says="none/" + name)
            (self.folder / name).mkdir()
            self.refuse(*words, "-o", name, says="this is a directory")

    def test_a_folder_that_is_closed(self):
        nobody = as_nobody()
        if nobody is None:
            self.skipTest("the program cannot be run without root's power here")
        self.folder.chmod(0o555)
        self.addCleanup(self.folder.chmod, 0o755)
        self.refuse("report", "wool-tropical", "-o", "r.html", says="r.html", **nobody)

    def test_no_driver_is_exit_code_4_at_once(self):
        self.refuse("fabric", "card", "wool-tropical", "-o", "c.png", expect=4, environment=NO_DRIVER, says="graphics driver")
        self.refuse("report", "wool-tropical", "-o", "r.html", expect=4, environment=NO_DRIVER, says="graphics driver")

    def test_thresholds_that_are_broken_name_their_place(self):
        data = self.folder / "data"
        (data / "perception").mkdir(parents=True)
        (data / "fabrics").symlink_to(SOURCE / "data/fabrics")
        self.write("data/perception/thresholds.csv", "quantities,kind\nB,fraction\n")
        self.refuse("fabric", "compare", "graded-1", "graded-3", environment={"FUAI_DATA": str(data)},
                    says="thresholds.csv:1:1")


class Page(HTMLParser):
    """What a page refers to, its pictures, the text of its cells and listings."""

    def __init__(self, text):
        super().__init__()
        self.references, self.pictures, self.cells, self.listings, self.open = [], [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.open.append(tag)
        for key, value in attributes:
            if key in ("src", "href", "srcset", "data"):
                (self.pictures if value.startswith("data:") else self.references).append(value)

    def handle_endtag(self, tag):
        while self.open and self.open.pop() != tag:
            pass

    def handle_data(self, data):
        if self.open and self.open[-1] in ("td", "pre"):
            (self.cells if self.open[-1] == "td" else self.listings).append(data)


class Pictures(Case):
    def check_page(self, name):
        """Well-formed, self-contained, every picture whole."""
        text = (self.folder / name).read_text(encoding="utf-8")
        page = Page(text)
        self.assertEqual(page.references, [])
        for word in ["@import", "url(", "<script", "<link"]:
            self.assertNotIn(word, text)
        self.assertIn("@media print", text)
        for picture in page.pictures:
            kind, _, code = picture.partition(";base64,")
            content = base64.b64decode(code, validate=True)
            if kind == "data:image/png":
                self.assertEqual(content[:8], PNG)
                self.assertEqual(content[-8:-4], b"IEND")
            else:
                self.assertEqual(kind, "data:image/svg+xml")
                ElementTree.fromstring(content)
        return page

    def test_card(self):
        result = self.json_of("fabric", "card", "wool-tropical", *COARSE, "-o", "c.png")
        self.assertEqual((result["file"], result["fabric"], result["at_rest"]), ("c.png", "wool-tropical", True))
        data = (self.folder / "c.png").read_bytes()
        self.assertEqual(data[:8], PNG)
        self.assertEqual(struct.unpack(">II", data[16:24]), (1520, 2150))
        self.assertEqual(self.files(), ["c.png"])

    def test_report_of_a_comparison(self):
        words = ["--seed", "3", "report", "wool-tropical", "graded-10", *COARSE, "--no-kes", "-o", "r.html"]
        result = self.json_of(*words)
        page = self.check_page("r.html")
        self.assertEqual(len(page.pictures), 1 + 2 * 4)
        self.assertEqual(result["file"], "r.html")
        self.assertEqual(result["bytes"], (self.folder / "r.html").stat().st_size)
        self.assertEqual(result["seed"], 3)
        self.assertEqual(ids(result), ["wool-tropical", "graded-10"])
        self.assertEqual([len(f["hash"]) for f in result["fabrics"]], [16, 16])
        self.assertTrue(all(f["at_rest"] and f["kes"] == [] for f in result["fabrics"]))
        listing = "\n".join(page.listings)
        self.assertIn(result["commands"], listing)
        self.assertIn('name = "Wool tropical"', listing)
        self.assertIn(result["fabrics"][0]["hash"], (self.folder / "r.html").read_text(encoding="utf-8"))
        # The commands of the page give its coefficients.
        drape = next(line for line in result["commands"].splitlines() if " drape graded-10 " in line)
        again = self.json_of(*drape.split()[1:])["drape_coefficient_percent"]["mean"]
        self.assertEqual(again, result["fabrics"][1]["drape_coefficient_percent"]["mean"])

    def test_the_commands_of_a_page_repeat_it_to_the_byte(self):
        """Also for a file with an awkward name and a fabric with an awkward one."""
        self.write("it's <mine> & yours.fabric.toml", FABRIC.replace('"Cloth"', '"<b>Cloth</b> & \\"more\\""'))
        words = ["--seed", "7", "report", "./it's <mine> & yours.fabric.toml", *COARSE, "--no-kes", "-o", "r.html"]
        commands = self.json_of(*words)["commands"].splitlines()
        page = self.check_page("r.html")
        text = (self.folder / "r.html").read_text(encoding="utf-8")
        self.assertNotIn("<b>", text)
        self.assertIn(commands[0], "\n".join(page.listings))
        (self.folder / "r.html").unlink()
        self.run_program("-q", *shlex.split(commands[0])[1:])
        self.assertEqual((self.folder / "r.html").read_text(encoding="utf-8"), text)

    def test_an_old_page_stays_when_the_new_one_cannot_be_made(self):
        self.write("r.html", "old")
        self.refuse("report", "wool-tropical", "-o", "r.html", "--spacing", "9cm", expect=2, says="spacing")
        self.assertEqual((self.folder / "r.html").read_text(), "old")


if __name__ == "__main__":
    unittest.main(verbosity=1)
