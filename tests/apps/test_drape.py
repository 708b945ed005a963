"""The drape tester through the program: its keys, files and refusals.

SPDX-License-Identifier: Apache-2.0
"""
import csv
import math
import struct
import unittest
import xml.etree.ElementTree as ElementTree

from program_tools import SOURCE, Case

JIS = ["--disc", "12.7cm", "--specimen", "25.4cm"]
# A lattice of 2 cm: a tenth of a second a specimen.
COARSE = ["wool-tropical", *JIS, "--spacing", "2cm"]


class Unit(Case):
    def test_the_json_has_the_keys_of_the_contract(self):
        result = self.json_of("--seed", "3", "drape", *COARSE, "--runs", "3")
        drape = result["drape_coefficient_percent"]
        self.assertEqual(list(drape), ["mean", "std", "min", "max", "each"])
        self.assertEqual(len(drape["each"]), 3)
        self.assertAlmostEqual(drape["mean"], sum(drape["each"]) / 3, places=9)
        self.assertAlmostEqual(drape["std"], math.sqrt(sum((x - drape["mean"]) ** 2 for x in drape["each"]) / 2), places=9)
        self.assertEqual([drape["min"], drape["max"]], [min(drape["each"]), max(drape["each"])])
        self.assertEqual(result["node_count"], sum(result["node_counts"]) / 3)
        self.assertEqual(sum(result["node_histogram"].values()), 3)
        self.assertLess(result["residual"], 1e-3)
        self.assertTrue(result["at_rest"])
        self.assertGreater(result["seconds"], 0)
        self.assertEqual((result["disc_m"], result["specimen_m"], result["spacing_m"]), (0.127, 0.254, 0.02))
        self.assertEqual((result["path"], result["solver"], result["elastic"], result["fabric"]),
                         ("ramp", "implicit", False, "wool-tropical"))
        self.assertEqual([s["seed"] for s in result["specimens"]], [3, 4, 5])
        # What was assumed is tried at its ends, and the band holds the mean.
        self.assertEqual(list(result["bands"]), ["twist", "shear"])
        for band in result["bands"].values():
            self.assertLess(band["at_least_points"], band["at_most_points"])
        low, high = result["band_percent"]
        self.assertLess(low, drape["mean"] - drape["std"])
        self.assertGreater(high, drape["mean"] + drape["std"])
        self.assertEqual(result["measured"]["drape_coefficient_percent"], 49.8)
        self.assertIn("bending.bias: no bias test: twist stiffness 0.25 sqrt(B warp B weft), no coupling B12",
                      result["assumptions"])
        self.assertLess(result["locking"]["warp"]["factor"], 1)
        self.assertTrue(any("capped" in sentence for sentence in result["assumptions"]))

    def test_one_specimen_has_no_spread_and_no_bands(self):
        result = self.json_of("drape", *COARSE, "--runs", "1")
        self.assertIsNone(result["drape_coefficient_percent"]["std"])
        self.assertEqual(result["bands"], {})
        again = self.json_of("drape", *COARSE, "--runs", "1", "--threads", "1")
        self.assertEqual(result["drape_coefficient_percent"], again["drape_coefficient_percent"])
        # The contract's sizes are the defaults.
        usual = self.json_of("drape", "wool-tropical", "--runs", "1", "--spacing", "2cm", "--elastic")
        self.assertEqual((usual["disc_m"], usual["specimen_m"], usual["elastic"]), (0.18, 0.30, True))
        self.assertIn("friction was left out", usual["assumptions"])

    def test_convergence_runs_the_spacings_that_fit(self):
        result = self.json_of("drape", *COARSE, "--runs", "1", "--convergence", "--out", "d")
        # Twice and one and a half times the spacing are more than a third of the overhang.
        self.assertEqual([round(1e3 * c["spacing_m"], 6) for c in result["convergence"]], [20, 15])
        same = result["convergence"][0]["drape_coefficient_percent"]["each"]
        self.assertEqual(same, result["drape_coefficient_percent"]["each"])
        with open(self.folder / "d" / "convergence.csv", encoding="utf-8", newline="") as file:
            self.assertEqual([row["spacing_mm"] for row in csv.DictReader(file)], ["20", "15"])

    def test_a_fabric_from_raw_measurements_drapes(self):
        self.run_program("-q", "fabric", "import", SOURCE / "data/u3m/cupro-woven-su1098.physics.json", "-o",
                         "c.fabric.toml")
        result = self.json_of("drape", "c.fabric.toml", *COARSE[1:], "--runs", "2")
        self.assertTrue(result["at_rest"])
        self.assertEqual(result["bands"], {})  # bias and shear were measured
        self.assertTrue(0 < result["drape_coefficient_percent"]["mean"] < 100)

    def test_people_read_a_short_summary(self):
        done = self.run_program("drape", *COARSE, "--runs", "2")
        for word in ["drape coefficient", "over 2 specimens", "twist stiffness", "together", "nodes", "measured 49.8 %"]:
            self.assertIn(word, done.stdout)


class Pictures(Case):
    def test_out_holds_shadow_pictures_mesh_and_tables(self):
        result = self.json_of("drape", *COARSE, "--runs", "2", "--no-bands", "--out", "new/folder")
        folder = self.folder / "new/folder"
        self.assertEqual(self.files(), sorted(result["files"]))
        self.assertEqual({p.name for p in folder.iterdir()},
                         {"shadow.svg", "shadow.png", "top.png", "side.png", "mesh.obj", "specimens.csv", "outline.csv"})
        for name in ["shadow.png", "top.png", "side.png"]:
            self.assertEqual((folder / name).read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", (folder / "top.png").read_bytes()[16:24]), (1000, 750))
        self.assertTrue(ElementTree.parse(folder / "shadow.svg").getroot().tag.endswith("svg"))
        with open(folder / "specimens.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([float(row["drape_coefficient_percent"]) for row in rows],
                         [round(x, 3) for x in result["drape_coefficient_percent"]["each"]])
        self.check_mesh((folder / "mesh.obj").read_text(encoding="utf-8"), folder / "outline.csv")

    def check_mesh(self, text, outline):
        lines = [line.split() for line in text.splitlines()]
        places = [tuple(map(float, words[1:])) for words in lines if words[0] == "v"]
        faces = [[int(word.split("/")[0]) for word in words[1:]] for words in lines if words[0] == "f"]
        self.assertEqual(len(places), sum(words[0] == "vt" for words in lines))
        self.assertEqual({i for face in faces for i in face}, set(range(1, len(places) + 1)))
        # The disc's cloth is level, no cloth is above it or below its overhang, and the farthest is the outline's.
        self.assertLess(max(z for _, _, z in places), 1e-3)
        self.assertGreater(min(z for _, _, z in places), -1.01 * 0.0635)  # yarns stretch by less than 1 %
        with open(outline, encoding="utf-8", newline="") as file:
            radii = [float(row["radius_mm"]) for row in csv.DictReader(file)]
        self.assertEqual(len(radii), 720)
        # The mesh is straight between slots 2 cm apart, the outline is not.
        self.assertAlmostEqual(max(math.hypot(x, y) for x, y, _ in places), 1e-3 * max(radii), delta=4e-3)


class Safety(Case):
    def test_wrong_usage_says_how_to_mend_it(self):
        for words, says in [
            (["--disc", "30cm", "--specimen", "18cm"], "smaller than the specimen"),
            (["--disc", "0cm"], "smaller than the specimen"),
            (["--spacing", "3cm"], "the spacing does not suit"),
            (["--spacing=-1mm"], "the spacing does not suit"),
            (["--spacing", "5"], "--spacing"),
            (["--disc", "5kg"], "--disc"),
            (["--runs", "0"], "--runs"),
            (["--path", "wind"], "--path"),
            (["--solver", "none"], "--solver"),
            (["--linger", "2"], "--linger"),
            (["--path", "support", "--solver", "explicit"], "does not know a plate"),
        ]:
            done = self.run_program("drape", "wool-tropical", *words, expect=2)
            self.assertIn(says, done.stderr, words)
            self.assertEqual(done.stdout, "")
        self.assertEqual(self.files(), [])

    def test_bad_input_is_exit_code_3(self):
        self.refuse("drape", "none", says="no bundled fabric")
        self.write("a", "a file")
        self.refuse("drape", *COARSE, "--out", "a/b", says="cannot make the folder")


if __name__ == "__main__":
    unittest.main(verbosity=1)
