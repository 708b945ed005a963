"""`fuai haptics` through the program: drivers, a felt scene, its record, and what it refuses.

SPDX-License-Identifier: Apache-2.0
"""
import csv
import json
import platform
import signal
import subprocess
import time
import unittest

from program_tools import PROGRAM, Case

RUN = ["haptics", "run", "--virtual-time"]
SMALL = [*RUN, "--scene", "taut_patch", "--fabric", "wool-tropical", "--size", "9", "--seconds", "0.9"]
KEYS = {"ticks", "overruns", "force_rms_N", "force_peak_N", "force_error_percent", "energy_min_J", "model_age_ms",
        "force_step_N", "changed_percent", "scale", "force_gain", "braked_ticks", "untrusted_ticks", "cloth_steps",
        "failed_steps", "device_ticks", "faulted_ticks", "state_hash", "device", "hand", "scene", "fabric", "virtual_time", "clock", "stopped"}
REAL = ["haptics", "run", "--no-reference", "--scene", "taut_patch", "--fabric", "wool-tropical", "--size", "9"]


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


    def test_in_real_time_every_tick_is_recorded_and_the_replay_has_the_same_bits(self):
        # What the clock did is the machine's affair; what was done with it is exact.
        result = self.json_of(*REAL, "--seconds", "0.4", "--record", "real.fuailog")
        self.assertEqual(set(result), KEYS)
        self.assertEqual((result["ticks"], result["virtual_time"], result["stopped"]), (400, False, False))
        clock = result["clock"]
        self.assertEqual(sum(b["ticks"] for b in clock["lateness"]), 400)
        self.assertEqual([b["below_us"] for b in clock["lateness"][:3]], [1, 2, 4])
        self.assertIsNone(clock["lateness"][-1]["below_us"])
        for line in clock["refused"]:
            self.assertIn("limits.d", line)
        replayed = self.json_of("replay", "real.fuailog")
        self.assertTrue(replayed["matches"] and replayed["complete"])
        self.assertEqual(replayed["state_hash"], result["state_hash"])
        self.assertEqual((replayed["ticks"], replayed["cloth_steps"]), (400, result["cloth_steps"]))


class Pictures(Case):
    def test_the_cloth_of_the_paper_bent_in_the_hand(self):
        result = self.json_of("haptics", "paper", "graded-10", "graded-1", "-o", "felt")
        self.assertEqual(self.files(), [f"felt/{name}" for name in [
            "directions.png", "directions.svg", "force.png", "force.svg", "graded-1.csv", "graded-10.csv",
            "index.html", "summary.csv"]])
        stiff, soft = result["runs"]
        self.assertEqual((stiff["fabric"], soft["fabric"]), ("graded-10", "graded-1"))
        for run in (stiff, soft):
            # As far as the arc goes, less what the hand gives way; friction: back lies below out.
            self.assertAlmostEqual(run["top_curvature_per_m"], 18, delta=0.2)
            self.assertLess(run["reaction_at_half_N"]["back"], 0.5 * run["reaction_at_half_N"]["out"])
        # The rigidities differ by 9.4; what shakes by the device is some 0.05 mN.
        self.assertGreater(stiff["reaction_at_half_N"]["out"], 3 * soft["reaction_at_half_N"]["out"])
        self.assertGreater(stiff["reaction_at_half_N"]["out"], 4e-4)
        with open(self.folder / "felt/graded-10.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 70)
        for row in rows[10:]:  # what the device gave is what the cloth did, in the means of a tenth of a second
            for axis in "xyz":
                self.assertAlmostEqual(float(row[f"felt_{axis}_N"]), float(row[f"reaction_{axis}_N"]), delta=2e-5)


class Safety(Case):
    @unittest.skipUnless(platform.machine() == "x86_64", "OpenHaptics is for x86-64 only")
    def test_a_device_that_gave_no_force_is_told(self):
        # The vendor's scheduler of this fake stands still unless a test moves it.
        fake = PROGRAM.parent.parent / "fakes" / "libfake_hd.so"
        words = ["haptics", "run", "--no-reference", "--device", "openhaptics", "--fabric", "wool-tropical", "--size",
                 "9", "--seconds", "0.5"]
        environment = {"FUAI_HD_LIBRARY": str(fake)}
        result = self.json_of(*words, environment=environment)
        self.assertGreater(result["device_ticks"]["disconnected"], 0)
        self.assertEqual((result["force_peak_N"], result["faulted_ticks"]), (0, 0))
        printed = self.run_program(*words, environment=environment).stdout
        self.assertRegex(printed, r"(?m)^device        unplugged or silent in \d+ ticks")
        # Nothing is said where there is nothing to say.
        result = self.json_of(*SMALL)
        self.assertEqual(set(result["device_ticks"].values()), {0})
        self.assertNotIn("device ", self.run_program(*SMALL, "--no-reference").stdout)

    def start(self, *words):
        process = subprocess.Popen([PROGRAM, "--json", *words], cwd=self.folder, text=True, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, process, size):
        """Until the recording has that size."""
        path, end = self.folder / "a.fuailog", time.monotonic() + 120
        while process.poll() is None and not (path.exists() and path.stat().st_size >= size):
            self.assertLess(time.monotonic(), end, "the recording does not grow")
            time.sleep(0.01)
        return path

    def test_ctrl_c_ends_a_session_with_its_figures_and_a_whole_recording(self):
        process = self.start(*REAL, "--seconds", "600", "--record", "a.fuailog")
        self.wait_for(process, 50_000)
        process.send_signal(signal.SIGINT)
        result = json.loads(process.communicate(timeout=120)[0])
        self.assertEqual(process.returncode, 0)
        self.assertTrue(result["stopped"])
        self.assertLess(result["ticks"], 600_000)
        replayed = self.json_of("replay", "a.fuailog")
        self.assertTrue(replayed["matches"] and replayed["complete"])
        self.assertEqual(replayed["ticks"], result["ticks"])

    def test_a_killed_process_loses_at_most_the_last_second(self):
        # The second run takes seconds for as many steps as fill a block: there the clock has to write. How long
        # the system lets a process starve is not ours to promise: one undisturbed try of three is enough.
        slow = ["simulate", "taut_patch", "--fabric", "wool-tropical", "--size", "192", "--seconds", "600"]
        for words, size, pause in [(REAL + ["--seconds", "600"], 400_000, 0.0), (slow, 17_000, 1.3)]:
            lost = []
            for _ in range(3):
                process = self.start(*words, "--record", "a.fuailog")
                path = self.wait_for(process, size)
                time.sleep(pause)
                process.kill()
                killed = time.time()
                process.wait()
                lost.append(killed - path.stat().st_mtime)
                if lost[-1] <= 1.0:
                    break
            self.assertLessEqual(lost[-1], 1.0, f"nothing was written for {lost} s before the kill")
            replayed = self.json_of("replay", "a.fuailog")
            self.assertTrue(replayed["matches"])
            self.assertFalse(replayed["complete"])
            self.assertGreater(replayed["ticks"], 0)
            self.assertEqual(replayed["checkpoints"], replayed["cloth_steps"] // 250)

    def test_wrong_words_are_refused_with_a_cure(self):
        for words, message in [
            ([*RUN, "--hold", "button"], "take --hold scene"),
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
