"""Recordings that the viewer does again, and which cloth a device feels, without a display.

SPDX-License-Identifier: Apache-2.0
"""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["FUAI_PROGRAM"]
TWO = ["wool-tropical", "graded-1", "--size", "9", "--spacing", "2cm", "--headless", "--seconds", "1.2s", "--device",
       "simulated:touch"]


class Replays(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return pathlib.Path(self.folder.name, name)

    def view(self, *words):
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        return subprocess.run([PROGRAM, "--json", "view", *map(str, words)], env=environment, capture_output=True,
                              text=True)

    def record(self, name, *words):
        run = self.view(*TWO, "--record", self.path(name), *words)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(run.stdout)

    def test_a_device_feels_the_chosen_cloth_and_the_recording_comes_back(self):
        first, second = self.record("a.fuai-view"), self.record("b.fuai-view", "--feel", "2")
        # The two cloths differ by four times in bending: the same hand is given another force.
        self.assertGreater(first["device_force_peak_N"], 0.0)
        self.assertNotEqual(first["device_force_peak_N"], second["device_force_peak_N"])
        run = self.view("--replay", self.path("b.fuai-view"), "--headless")
        self.assertEqual(run.returncode, 0, run.stderr)
        result = json.loads(run.stdout)
        self.assertTrue(result["replay_matches"], result)
        self.assertEqual(result["replay_hashes"], 12)  # every 100 of 1200 ticks
        self.assertNotIn("replay_matches", second)

    def test_a_hash_that_does_not_match_is_told(self):
        self.record("a.fuai-view")
        lines = self.path("a.fuai-view").read_text(encoding="utf-8").splitlines(keepends=True)
        at = [i for i, line in enumerate(lines) if " hash " in line][5]
        digit = lines[at][-2]
        lines[at] = lines[at][:-2] + ("0" if digit != "0" else "1") + "\n"
        self.path("b.fuai-view").write_text("".join(lines), encoding="utf-8")
        run = self.view("--replay", self.path("b.fuai-view"), "--headless")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertFalse(json.loads(run.stdout)["replay_matches"])

    def test_a_recording_is_never_replaced_by_what_is_made_of_it(self):
        self.record("a.fuai-view")
        before = self.path("a.fuai-view").read_bytes()
        for option in ("--record", "--screenshot"):
            run = self.view("--replay", self.path("a.fuai-view"), "--headless", option, self.path("a.fuai-view"))
            self.assertEqual(run.returncode, 2, run.stderr)
            self.assertIn(f"give {option} another name", run.stderr)
        self.assertEqual(self.path("a.fuai-view").read_bytes(), before)

    def test_a_file_that_is_no_recording_is_one_line(self):
        self.path("a.fuai-view").write_text("nothing\n", encoding="utf-8")
        for path, message in [(self.path("a.fuai-view"), "not a recording"), (self.path("none"), "does not exist")]:
            run = self.view("--replay", path, "--headless")
            self.assertEqual(run.returncode, 3, run.stderr)
            self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
            self.assertIn(str(path), run.stderr)
            self.assertIn(message, run.stderr)


if __name__ == "__main__":
    unittest.main()
