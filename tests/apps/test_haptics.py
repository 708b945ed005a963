"""`fuai haptics` through the program: drivers, a felt scene, its record, and what it refuses.

SPDX-License-Identifier: Apache-2.0
"""
import csv
import unittest

from program_tools import Case

RUN = ["haptics", "run", "--virtual-time"]
SMALL = [*RUN, "--scene", "taut_patch", "--fabric", "wool-tropical", "--size", "9", "--seconds", "0.9"]
KEYS = {"ticks", "overruns", "force_rms_N", "force_peak_N", "force_error_percent", "energy_min_J", "model_age_ms",
        "force_step_N", "changed_percent", "scale", "force_gain", "braked_ticks", "untrusted_ticks", "cloth_steps",
        "failed_steps", "state_hash", "device", "hand", "scene", "fabric", "virtual_time"}


class Unit(Case):
    def test_devices_say_whether_they_are_available(self):
        drivers = self.json_of("haptics", "devices", "--diagnose")["drivers"]
        self.assertEqual(drivers[0]["name"], "simulated")
        for driver in drivers:
            self.assertEqual(driver["available"], driver["why_not"] == "")
            self.assertGreater(len(driver["findings"]), 0)
        self.assertIn("touch", drivers[0]["models"])
        self.assertNotIn("findings", self.json_of("haptics", "devices")["drivers"][0])
        self.assertIn("omega.3", self.run_program("haptics", "devices", "--diagnose").stdout)

    def test_every_driver_is_listed_with_what_it_looked_at(self):
        # Nobody listens at port 1, and there is no such file.
        nowhere = {"FUAI_DHD_LIBRARY": "/nowhere/libdrd.so", "FUAI_HD_LIBRARY": "/nowhere/libHD.so",
                   "FUAI_INVERSE3_ADDRESS": "127.0.0.1:1", "FUAI_VRPN_ADDRESS": "127.0.0.1:1",
                   "FUAI_SPNAV_SOCKET": str(self.folder / "spnav.sock")}
        drivers = self.json_of("haptics", "devices", "--diagnose", environment=nowhere)["drivers"]
        found = {driver["name"]: driver for driver in drivers}
        self.assertEqual(list(found), ["simulated", "forcedimension", "openhaptics", "inverse3", "vrpn", "spacenav",
                                       "gamepad", "mouse"])
        self.assertEqual([name for name, driver in found.items() if driver["force"]],
                         ["simulated", "forcedimension", "openhaptics", "inverse3", "vrpn"])
        for name, why in [("forcedimension", "/nowhere/libdrd.so: cannot open shared object file"),
                          ("openhaptics", "/nowhere/libHD.so: cannot open shared object file"),
                          ("inverse3", "127.0.0.1:1: Connection refused"), ("vrpn", "127.0.0.1:1: Connection refused"),
                          ("spacenav", "spnav.sock: No such file or directory")]:
            self.assertFalse(found[name]["available"])
            self.assertIn(why, found[name]["why_not"])
            self.assertNotEqual(found[name]["cure"], "")
        self.assertTrue(found["mouse"]["available"])

    def test_a_felt_scene_has_the_keys_and_the_figures_of_the_contract(self):
        result = self.json_of(*SMALL)
        self.assertEqual(set(result), KEYS)
        self.assertEqual((result["ticks"], result["overruns"], result["failed_steps"]), (900, 0, 0))
        # The figures that the project asks of a felt force.
        self.assertLess(result["force_error_percent"]["rms"], 2)
        self.assertLess(result["force_error_percent"]["peak"], 5)
        self.assertLessEqual(result["force_step_N"], 0.1 * (1 + 1e-12))
        self.assertGreater(result["changed_percent"], 99)
        self.assertGreater(result["energy_min_J"], -1e-3)
        self.assertEqual(list(result["model_age_ms"]), ["p50", "p99", "max"])
        self.assertEqual(result["model_age_ms"]["max"], 0)
        self.assertGreater(result["force_peak_N"], 0.02)

    def test_the_same_words_give_the_same_bits_and_a_slow_cloth_an_older_model(self):
        words = [*SMALL, "--no-reference", "--device", "simulated:touch-x", "--hand", "stylus", "--force-gain", "2"]
        first, second = self.json_of(*words), self.json_of(*words)
        self.assertEqual(first, second)
        self.assertIsNone(first["force_error_percent"])
        self.assertEqual((first["device"], first["hand"], first["force_gain"]), ("3D Systems Touch X", "stylus", 2))
        slow = self.json_of(*words, "--cloth-rate", "60")
        # A step late, and a step more until the next one comes; ticks and steps do not fit by one tick.
        self.assertAlmostEqual(slow["model_age_ms"]["max"], 2e3 / 60, delta=1.001)
        self.assertLess(slow["cloth_steps"], first["cloth_steps"] / 15)

    def test_the_record_has_a_row_a_tick(self):
        result = self.json_of(*SMALL, "--no-reference", "--record", "felt.csv")
        with open(self.folder / "felt.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 900)
        peak = max(sum(float(row[f"force_{axis}_N"]) ** 2 for axis in "xyz") ** 0.5 for row in rows)
        self.assertAlmostEqual(peak, result["force_peak_N"], delta=1e-8 * peak)  # nine digits
        self.assertEqual(self.files(), ["felt.csv"])


class Safety(Case):
    def test_wrong_words_are_refused_with_a_cure(self):
        for words, message in [
            (["haptics", "run"], "add --virtual-time"),
            ([*RUN, "--device", "phantom"], "take one of simulated"),
            ([*RUN, "--device", "simulated:glove"], "take one of premium, touch"),
            ([*RUN, "--device", "vrpn"], "virtual time is for the simulated device"),
            ([*RUN, "--hand", "foot"], "take one of none, finger"),
            ([*RUN, "--scene", "hanging_sheet"], "nobody holds the cloth"),
            ([*RUN, "--scene", "paper_drape"], "no time to be felt in"),
            ([*RUN, "--force-gain", "0"], "take 0.01 to 100"),
            ([*RUN, "--force-gain", "2x"], "take 0.01 to 100"),
            ([*RUN, "--cloth-rate", "5"], "--cloth-rate"),
            ([*RUN, "--record", "a.txt"], "end the name in .csv"),
            ([*RUN, "--seconds", "0"], "--seconds must be more than 0"),
        ]:
            done = self.run_program(*words, expect=2)
            self.assertIn(message, done.stderr)
            self.assertEqual(done.stdout, "")
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    unittest.main(verbosity=1)
