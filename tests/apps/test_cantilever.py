"""`fuai cantilever` through the program: what it prints, the exact elastica, and what it refuses.

SPDX-License-Identifier: Apache-2.0
"""
import math
import unittest

from program_tools import FABRIC, Case

KEYS = {"reach_m", "droop_m", "tip_angle_deg", "chord_angle_deg", "bending_length_m", "bending_length_peirce_m",
        "bending_rigidity_gf_cm2_per_cm", "length_m", "width_m", "spacing_m", "direction", "elastic", "residual",
        "converged", "steps", "assumptions", "fabric"}
# Straight bending laws without friction in the elastic form, as measured: B [gf cm2/cm] and W [mg/cm2].
STRAIGHT = FABRIC + """[bending.weft]
B_gf_cm2_per_cm = 0.12
2HB_gf_cm_per_cm = 0.03
"""
# The heavy elastica by Runge-Kutta shooting at w L^3 / B = 8: angles of tip and chord [deg], reach and droop over L.
LOAD, TIP, CHORD, REACH, DROOP = 8, 53.864996, 41.48730, .72442473, .64063072
PEIRCE = 1.0575  # B by Peirce's formula over B, there


def bending_length(rigidity):
    """c = (B / w)^(1/3) [m]; both over the weight of a gram, so that its force drops out."""
    return 1e-2 * (rigidity / 16e-3) ** (1 / 3)


class Unit(Case):
    def hang(self, *words, **options):
        self.write("straight.fabric.toml", STRAIGHT)
        return self.json_of("cantilever", "straight.fabric.toml", *words, **options)

    def test_the_elastica_and_the_keys_of_the_contract(self):
        # Errors fall with the square of the spacing: 0.034 % of the length at the forty segments of the default.
        for direction, rigidity, spacing, exact in [("warp", 0.06, None, 1e-3), ("weft", 0.12, 1 / 20, 2e-3)]:
            length = 2.0 * bending_length(rigidity)  # the cube root of the load
            words = ["--spacing", f"{1e3 * spacing * length:.9f}mm"] if spacing else []
            result = self.hang("--direction", direction, "--length", f"{1e3 * length:.9f}mm", "--elastic", *words)
            self.assertEqual(set(result), KEYS)
            self.assertEqual((result["direction"], result["elastic"], result["converged"]), (direction, True, True))
            self.assertEqual((result["fabric"], result["width_m"]), ("straight", 0.02))
            self.assertAlmostEqual(result["length_m"], length, places=11)
            self.assertAlmostEqual(result["spacing_m"], length * (spacing or 1 / 40), places=11)
            self.assertAlmostEqual(result["reach_m"] / length, REACH, delta=exact)
            self.assertAlmostEqual(result["droop_m"] / length, DROOP, delta=exact)
            self.assertAlmostEqual(result["tip_angle_deg"], TIP, delta=90 * exact)
            self.assertAlmostEqual(result["chord_angle_deg"], CHORD, delta=90 * exact)
            # A degree of the chord is 4 % of the load there, 1.3 % of the bending length.
            self.assertAlmostEqual(result["bending_length_m"] / bending_length(rigidity), 1.0, delta=exact)
            self.assertAlmostEqual(result["bending_rigidity_gf_cm2_per_cm"] / rigidity, 1.0, delta=3 * exact)
            self.assertAlmostEqual((result["bending_length_peirce_m"] / result["bending_length_m"]) ** 3, PEIRCE, delta=1e-3)
            self.assertLessEqual(result["residual"], 1e-5)
            self.assertTrue(all(math.isfinite(value) for value in result.values() if isinstance(value, float)))
            self.assertIn("friction was left out", result["assumptions"])

    def test_friction_holds_the_strip_up_and_the_spacing_does_not_bend_it(self):
        usual = self.hang("--length", "8cm", "--spacing", "5mm")
        elastic = self.hang("--length", "8cm", "--spacing", "5mm", "--elastic")
        coarse = self.hang("--length", "8cm", "--spacing", "8mm", "--elastic")
        self.assertEqual((usual["elastic"], usual["direction"], coarse["spacing_m"]), (False, "warp", 0.008))
        self.assertGreater(usual["reach_m"], 1.01 * elastic["reach_m"])
        self.assertGreater(usual["bending_length_m"], 1.01 * elastic["bending_length_m"])
        # A bending length of 1.5 cm is two spacings here: 3 %.
        self.assertAlmostEqual(coarse["bending_length_m"] / elastic["bending_length_m"], 1.0, delta=4e-2)

    def test_people_read_a_short_summary(self):
        words = ["cantilever", "wool-tropical", "--length", "5cm", "--spacing", "5mm"]
        done = self.run_program(*words)
        for word in ["Wool tropical, warp, 5 cm", "reach", "droop", "deg at the tip", "bending length", "Peirce",
                     "gf cm2/cm"]:
            self.assertIn(word, done.stdout)
        self.assertIn("assumed: ", self.run_program("-v", *words).stderr)
        self.assertEqual(self.files(), [])


class Safety(Case):
    def test_wrong_usage_says_how_to_mend_it(self):
        for words, says in [
            (["--length", "0cm"], "--length"),
            (["--length=-5cm"], "--length"),
            (["--length", "5"], "--length"),
            (["--length", "5g"], "--length"),
            (["--length", "nan"], "--length"),
            (["--length", "5cm", "--width", "0mm"], "--width"),
            (["--length", "5cm", "--spacing", "0mm"], "--spacing"),
            (["--length", "1cm", "--spacing", "5mm"], "shorter than four spacings of 5 mm"),
            (["--length", "10cm", "--spacing", "0.05mm"], "longer than a thousand spacings"),
            (["--length", "10cm", "--width", "1mm", "--spacing", "1mm"], "narrower than two spacings"),
        ]:
            self.refuse("cantilever", "wool-tropical", *words, expect=2, says=says)
        for words, says in [([], "--length"), (["--length", "5cm", "--direction", "bias"], "--direction")]:
            self.assertIn(says, self.run_program("cantilever", "wool-tropical", *words, expect=2).stderr)
        self.run_program("cantilever", expect=2)
        self.assertEqual(self.files(), [])

    def test_bad_input_is_exit_code_3(self):
        self.refuse("cantilever", "none", "--length", "5cm", says="no bundled fabric")
        self.write("bad.fabric.toml", STRAIGHT.replace("0.06", "-0.06"))
        self.refuse("cantilever", "bad.fabric.toml", "--length", "5cm", says="bad.fabric.toml")


if __name__ == "__main__":
    unittest.main(verbosity=1)
