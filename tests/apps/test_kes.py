"""`fuai kes`, `fuai loop` and the overhang of `fuai cantilever`: keys, files, refusals.

SPDX-License-Identifier: Apache-2.0
"""
import unittest

from program_tools import Case

KEYS = {
    "bending": ["B_gf_cm2_per_cm", "2HB_gf_cm_per_cm"],
    "tensile": ["LT", "WT_gf_cm_per_cm2", "RT_percent", "EMT_percent"],
    "shear": ["G_gf_per_cm_deg", "2HG_gf_per_cm", "2HG5_gf_per_cm"],
}
COARSE = {"bending": ["--spacing", "2.5mm"], "tensile": [], "shear": ["--spacing", "12.5mm"]}


class Unit(Case):
    def test_keys_and_input(self):
        for test, keys in KEYS.items():
            result = self.json_of("kes", test, "wool-tropical", *COARSE[test])
            self.assertEqual(result["test"], test)
            self.assertEqual(result["fabric"], "wool-tropical")
            self.assertEqual(result["direction"], "mean" if test == "shear" else "warp")
            self.assertLess(result["loop_rms_percent"], 1.0)
            self.assertEqual(list(result["input"]), keys)
            for key in keys:
                self.assertLess(abs(result[key] / result["input"][key] - 1.0), 0.01, f"{test} {key}")
        self.assertGreater(result["edge_share_percent"], 0.0)

    def test_direction(self):
        for direction in ("warp", "weft"):
            result = self.json_of("kes", "tensile", "cupro-woven-su1098", "--direction", direction)
            self.assertEqual((result["direction"], result["loop"]), (direction, "measured"))
            self.assertEqual(list(result["stated"]), KEYS["tensile"])

    def test_curve_file_is_a_measurement(self):
        self.run_program("kes", "bending", "polyester-faille", "--spacing", "2.5mm", "--csv", "bend.csv")
        self.assertTrue((self.folder / "bend.csv").read_text().startswith("# fuai-curve/1 test=bending direction=warp\n"))
        self.run_program("fabric", "import", "bend.csv", "--mass", "11 mg/cm2", "-o", "again.toml")
        again = self.json_of("fabric", "show", "again.toml")["numbers"]
        self.assertAlmostEqual(again["bending.warp.B_gf_cm2_per_cm"]["B_gf_cm2_per_cm"], 0.019, delta=0.0002)

    def test_reversals(self):
        self.run_program("kes", "bending", "wool-tropical", "--spacing", "2.5mm", "--reverse", "1", "1.5:0.5",
                         "--csv", "minor.csv")
        branches = [line.rsplit(",", 1)[1] for line in (self.folder / "minor.csv").read_text().splitlines()[2:]]
        turns = sum(a != b for a, b in zip(branches, branches[1:]))
        self.assertEqual(turns, 7)  # out, back, out, back, stop, zero, stop, zero

    def test_fabric_analyzer(self):
        stretch = self.json_of("kes", "stretch", "cupro-woven-su1098")
        self.assertLess(stretch["loop_rms_percent"], 1.0)
        self.assertEqual(list(stretch["input"]), KEYS["tensile"])
        buckling = self.json_of("kes", "buckling", "cupro-woven-su1098", "--csv", "buckling.csv")
        self.assertLess(abs(buckling["B_gf_cm2_per_cm"] / buckling["input"]["B_gf_cm2_per_cm"] - 1.0), 0.05)
        self.assertEqual((self.folder / "buckling.csv").read_text().splitlines()[0],
                         "test,clamp_distance_cm,force_gf,branch")

    def test_loop_and_overhang(self):
        heart = self.json_of("loop", "heart", "wool-tropical", "--elastic", "--segments", 40)
        self.assertLess(abs(heart["bending_length_m"] / 0.01602 - 1.0), 0.02)
        self.assertEqual(heart["elastic"], True)
        overhang = self.json_of("cantilever", "wool-tropical", "--angle", "41.5deg", "--elastic")
        self.assertLess(abs(overhang["chord_angle_deg"] - 41.5), 0.01)
        self.assertLess(abs(overhang["half_overhang_m"] / overhang["bending_length_m"] - 1.0), 1e-3)
        self.assertEqual(overhang["overhang_m"], overhang["length_m"])


class Safety(Case):
    def test_wrong_words(self):
        for words in (["bend", "wool-tropical"], ["bending"], ["bending", "wool-tropical", "--direction", "bias"]):
            self.run_program("kes", *words, expect=2)
        self.run_program("cantilever", "wool-tropical", expect=2)
        self.run_program("cantilever", "wool-tropical", "--length", "10cm", "--angle", "43deg", expect=2)

    def test_wrong_values(self):
        for words, says in ((["--reverse", "x"], "is no reversal"), (["--reverse", "0.5:1"], "does not turn back"),
                            (["--spacing", "3mm"], "must divide"), (["--plot", "loop.pdf"], ".png or .svg")):
            self.refuse("kes", "bending", "wool-tropical", *words, expect=2, says=says)
        self.refuse("kes", "stretch", "wool-tropical", "--reverse", "1", expect=2, says="path and a lattice of their own")
        self.refuse("kes", "bending", "no-such-fabric", expect=3)
        self.refuse("loop", "heart", "wool-tropical", "--length", "0cm", expect=2)


class Pictures(Case):
    def test_plots(self):
        self.run_program("kes", "tensile", "cupro-woven-su1098", "--plot", "t.png")
        self.assertEqual((self.folder / "t.png").read_bytes()[:4], b"\x89PNG")
        self.run_program("kes", "stretch", "cupro-woven-su1098", "--plot", "s.svg")
        self.assertIn(b"<svg", (self.folder / "s.svg").read_bytes()[:500])


if __name__ == "__main__":
    unittest.main()
