"""`fuai fabric fit` and `fuai fabric bands`: files, keys, round trip, refusals.

SPDX-License-Identifier: Apache-2.0
"""
import unittest

from program_tools import Case

MASS = ["--mass", "16.29 mg/cm2"]
COARSE = ["--disc", "12.7cm", "--specimen", "25.4cm", "--spacing", "2cm", "--samples", "2"]


class Unit(Case):
    def test_cantilever(self):
        result = self.json_of("fabric", "fit", *MASS, "--thickness", "0.407mm", "--composition", "100 % wool",
                              "--overhang-warp", "3.6cm", "3.7cm", "3.7cm", "--bending-length-weft", "1.8cm", *COARSE,
                              "-o", "w.fabric.toml")
        warp, weft = result["fitted"]["warp"], result["fitted"]["weft"]
        # Wool tropical has B = 0.067 and the engine finds its overhang at 3.668 cm; the fit is told wool.
        self.assertLess(warp["low"], 0.067)
        self.assertGreater(warp["high"], 0.067)
        self.assertGreater(warp["without_friction_B_gf_cm2_per_cm"], 1.3 * warp["B_gf_cm2_per_cm"])
        self.assertEqual([round(end["2HB_over_B_per_cm"], 3) for end in warp["by_friction"]], [0.3, 0.45, 0.675])
        self.assertEqual(weft["noise_percent"], 0.0)
        self.assertGreater(warp["noise_percent"], 1.0)
        bands = result["bands"]
        self.assertLess(bands["moment_gf_cm_per_cm"]["warp"]["p5"], bands["moment_gf_cm_per_cm"]["warp"]["p95"])
        self.assertIn("as_it_is", bands["drape_coefficient_percent"])
        self.assertTrue(any("EMT was not measured" in sentence for sentence in result["assumed"]))
        shown = self.json_of("fabric", "show", "w.fabric.toml")["numbers"]
        B = shown["bending.warp.B_gf_cm2_per_cm"]
        self.assertAlmostEqual(B["B_gf_cm2_per_cm"], warp["B_gf_cm2_per_cm"], delta=1e-5)  # four digits
        self.assertEqual(B["provenance"]["kind"], "fitted")
        self.assertIn("3 readings", B["provenance"]["source"])
        self.assertEqual(shown["bending.warp.2HB_gf_cm_per_cm"]["provenance"]["kind"], "assumed")
        # What was written is what hangs: the engine gives the overhang's angle back (0.4 %, as the strip does).
        hung = self.json_of("cantilever", "w.fabric.toml", "--direction", "weft", "--length", "3.6cm", "--spacing",
                            "1.8mm", "--width", "4mm")
        self.assertLess(abs(hung["chord_angle_deg"] / 41.5 - 1.0), 0.006)

    def test_bands(self):
        result = self.json_of("fabric", "bands", "wool-tropical", *COARSE, "--scatter", "20%")
        self.assertEqual(result["bands"]["scatter_percent"], 20.0)
        self.assertAlmostEqual(result["bands"]["moment_gf_cm_per_cm"]["weft"]["as_it_is"], 0.0835, delta=1e-6)
        self.assertIn("measured bending scatters by 20 %", result["bands"]["drawn"])
        self.assertEqual(result, self.json_of("--threads", 2, "fabric", "bands", "wool-tropical", *COARSE,
                                              "--scatter", "20%"))


class Safety(Case):
    def test_refusals(self):
        good = ["fabric", "fit", *MASS, "-o", "w.fabric.toml"]
        for words, expect, says in (
            ([], 2, "there is nothing to fit to"),
            (["--overhang-warp", "3.6cm", "--drape", "50%"], 2, "are two fits"),
            (["--overhang-warp", "3.6cm", "--bending-length-warp", "1.8cm"], 2, "are one measurement"),
            (["--bending-length-warp", "1.8cm", "--angle", "43deg"], 2, "half the overhang at 41.5 degrees"),
            (["--overhang-warp", "3.6"], 2, "--overhang-warp"),
            (["--overhang-warp", "-3.6cm"], 2, "not above zero"),
            (["--overhang-warp", "3m"], 3, "1 mm to 1 m"),
            (["--overhang-warp", "3cm", "--angle", "1deg"], 2, "5 to 80 degrees"),
            (["--drape", "49.8"], 2, "below 100 %"),
            (["--drape", "99.9%", *COARSE], 1, "outside what this tester tells apart"),
        ):
            self.refuse(*good, *words, expect=expect, says=says)
        self.refuse(*good[:-1], "none/w.fabric.toml", "--overhang-warp", "3.6cm", says="does not exist")
        self.run_program("fabric", "fit", "-o", "w.fabric.toml", "--overhang-warp", "3.6cm", expect=2)
        self.refuse("fabric", "bands", "wool-tropical", "--scatter", "10", expect=2, says="--scatter")
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    unittest.main()
