"""The viewer without a display: pictures, devices, and what is wrong in one line.

SPDX-License-Identifier: Apache-2.0
"""
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["FUAI_PROGRAM"]


def png_size(path):
    data = path.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    return struct.unpack(">II", data[16:24])


class WithoutDisplay(unittest.TestCase):
    def run_program(self, *words):
        environment = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY")}
        with tempfile.TemporaryDirectory() as config:
            # Broken settings: whoever read them would say so.
            path = pathlib.Path(config) / "fuai" / "viewer.toml"
            path.parent.mkdir()
            path.write_text("broken", encoding="utf-8")
            run = subprocess.run([PROGRAM, "--json", "view", *words], env={**environment, "XDG_CONFIG_HOME": config},
                                 capture_output=True, text=True)
            if "--headless" in words:
                self.assertNotIn("viewer.toml", run.stderr)
            else:
                self.assertIn("viewer.toml:1:7: ", run.stderr)
            self.assertEqual(path.read_text(encoding="utf-8"), "broken")
        return run

    def test_a_picture_depends_on_the_options_only(self):
        with tempfile.TemporaryDirectory() as folder:
            words = ["wool-tropical", "--size", "9", "--headless", "--seconds", "0.1s", "--width", "480", "--height",
                     "320", "--bare", "--screenshot"]
            runs = [self.run_program(*words, f"{folder}/{name}.png") for name in "ab"]
            self.assertEqual([r.returncode for r in runs], [0, 0], runs[0].stderr)
            hashes = {json.loads(r.stdout)["state_hash"] for r in runs}
            self.assertEqual(len(hashes), 1)
            a, b = (pathlib.Path(folder) / f"{name}.png" for name in "ab")
            self.assertEqual(png_size(a), (480, 320))
            self.assertEqual(a.read_bytes(), b.read_bytes())
            self.assertGreater(a.stat().st_size, 5000)
            self.assertEqual(json.loads(runs[0].stdout)["seconds"], 0.1)

    def test_a_simulated_device_holds_the_cloth_and_its_recording_replays(self):
        with tempfile.TemporaryDirectory() as folder:
            words = ["wool-tropical", "--size", "9", "--spacing", "2cm", "--headless", "--seconds", "2s", "--device",
                     "simulated:touch", "--record"]
            runs = [self.run_program(*words, f"{folder}/{name}.fuai-view") for name in "ab"]
            self.assertEqual([r.returncode for r in runs], [0, 0], runs[0].stderr)
            results = [json.loads(r.stdout) for r in runs]
            self.assertEqual(results[0]["state_hash"], results[1]["state_hash"])
            self.assertEqual((results[0]["device"], results[0]["overruns"]), ("3D Systems Touch", 0))
            self.assertGreater(results[0]["device_force_peak_N"], 0.0)
            self.assertLessEqual(results[0]["device_force_peak_N"], 3.3)  # what a Touch gives
            text = pathlib.Path(f"{folder}/a.fuai-view").read_text(encoding="utf-8")
            self.assertIn(" grab 15 ", text)
            self.assertEqual(text.count("\nfelt 1\n"), 1)
            replay = subprocess.run([PROGRAM, "--json", "replay", f"{folder}/a.fuai-view"], capture_output=True,
                                    text=True)
            self.assertTrue(json.loads(replay.stdout)["matches"])

    def test_a_device_that_is_not_there_is_told_and_the_mouse_goes_on(self):
        run = self.run_program("wool-tropical", "--size", "9", "--headless", "--seconds", "0.1s", "--device",
                               "gamepad:/nosuch/js0")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(len(run.stderr.splitlines()), 1, run.stderr)
        self.assertIn("/nosuch/js0", run.stderr)
        self.assertIn("the mouse goes on", run.stderr)
        self.assertNotIn("device", json.loads(run.stdout))

    def test_a_real_device_is_refused_in_computed_time(self):
        with tempfile.TemporaryDirectory() as folder:
            node = f"{folder}/js0"
            os.mkfifo(node)  # opens as a gamepad's node does
            run = self.run_program("--headless", "--seconds", "0.1s", "--device", "gamepad:" + node)
        self.assertEqual(run.returncode, 2, run.stderr)
        self.assertIn("real time", run.stderr)

    def test_a_picture_on_the_cloth_that_is_none_is_one_line_and_the_program_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            small = ["wool-tropical", "--size", "9", "--headless", "--seconds", "0.02s", "--width", "480", "--height",
                     "320", "--bare", "--zoom", "4", "--screenshot", f"{folder}/end.png"]
            self.assertEqual(self.run_program(*small).returncode, 0)
            plain = pathlib.Path(folder, "end.png").read_bytes()
            pathlib.Path(folder, "text.png").write_text("no picture")
            for name, message in [("none.png", "does not exist"), ("text.png", "no PNG picture")]:
                run = self.run_program(*small, "--texture", f"{folder}/{name}")
                self.assertEqual(run.returncode, 0, run.stderr)
                told = [line for line in run.stderr.splitlines() if not line.startswith("wrote ")]
                self.assertEqual(len(told), 1, run.stderr)
                self.assertIn(f"{folder}/{name}: ", told[0])
                self.assertIn(message, told[0])
                self.assertEqual(png_size(pathlib.Path(folder, "end.png")), (480, 320))
            pathlib.Path(folder, "own.png").write_bytes(plain)
            run = self.run_program(*small, "--texture", f"{folder}/own.png", "--texture-width", "3cm")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertNotIn("warning", run.stderr)
            self.assertNotEqual(pathlib.Path(folder, "end.png").read_bytes(), plain)

    def test_what_is_wrong_is_one_clear_line(self):
        for words, code, message in [
                ([], 4, "there is no display"),
                (["--headless"], 2, "add --seconds"),
                (["nosuch", "--headless", "--seconds", "0.1s"], 3, "nosuch"),
                (["--scene", "hanging_shet", "--headless", "--seconds", "0.1s"], 2, "hanging_sheet"),
                (["--scene", "paper_drape", "--headless", "--seconds", "0.1s"], 2, "corner_drape"),
                (["--headless", "--seconds", "0s"], 2, "not above zero"),
                (["--heat-map", "colour", "--headless", "--seconds", "0.1s"], 2, "warp-curvature"),
                (["--weave", "--no-weave", "--headless", "--seconds", "0.1s"], 2, "exclude each other"),
                (["--texture-width", "0mm", "--headless", "--seconds", "0.1s"], 2, "take 1mm to 10m"),
                (["a", "b", "c", "d", "e", "--headless", "--seconds", "0.1s"], 2, "one to 4"),
                (["--device", "nosuch", "--headless", "--seconds", "0.1s"], 2, "forcedimension"),
                (["--headless", "--seconds", "0.1s", "--screenshot", "/nosuch/a.png"], 3, "/nosuch"),
        ]:
            run = self.run_program(*words)
            self.assertEqual(run.returncode, code, run.stderr)
            self.assertIn(message, run.stderr)
            self.assertNotIn("terminate", run.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[1:]])
