"""The viewer under a virtual display, with real mouse and key events: grab, hold, pin, undo, compare, record, quit.

SPDX-License-Identifier: Apache-2.0
"""
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = os.environ["FUAI_PROGRAM"]
PATIENCE = 60.0  # seconds that anything may take on a busy machine; nothing is measured


def wait_for(what, condition):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError(f"waited in vain for {what}")


class Window:
    """A viewer on a display of its own."""

    def __init__(self, folder, *words):
        self.folder = pathlib.Path(folder)
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x720x24"],
                                       pass_fds=[write], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as pipe:
            display = ":" + pipe.readline().strip()
        self.settings = self.folder / "config" / "fuai" / "viewer.toml"
        self.environment = {**os.environ, "DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1",
                            "XDG_CONFIG_HOME": str(self.folder / "config")}
        self.record = self.folder / "r.fuai-view"
        self.program = subprocess.Popen(
            [PROGRAM, "--json", "view", "wool-tropical", "--scene", "hanging_sheet", "--size", "17", "--spacing",
             "2cm", "--record", str(self.record), "--out", str(self.folder), "--screenshot",
             str(self.folder / "end.png"), *words],
            env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.window = wait_for("the window", lambda: self.do("search", "--name", "^fuai$", check=False).split())[0]
        wait_for("the first pictures", lambda: self.events("hash", 5))
        wait_for("the focus", self.focus)

    def do(self, *words, check=True):
        run = subprocess.run(["xdotool", *words], env=self.environment, capture_output=True, text=True,
                             timeout=PATIENCE)
        if check and run.returncode != 0:
            raise AssertionError(run.stderr)
        return run.stdout

    def focus(self):
        self.do("windowfocus", self.window, check=False)  # refused until the window is there to be seen
        return self.do("getwindowfocus", check=False).strip() == self.window

    def key(self, name):
        self.do("key", name)

    def lines(self):
        return self.record.read_text(encoding="utf-8").splitlines() if self.record.exists() else []

    def events(self, kind, count=1):
        """The recorded events of a kind when there are so many."""
        found = [line for line in self.lines() if f" {kind}" in line and line[:1].isdigit()]
        return found if len(found) >= count else None

    def drag(self, start, end, steps=6):
        self.do("mousemove", *map(str, start))
        time.sleep(0.2)
        self.do("mousedown", "1")
        wait_for("a grab", lambda: self.events("grab"))
        for i in range(1, steps + 1):
            x, y = (round(a + (b - a) * i / steps) for a, b in zip(start, end))
            self.do("mousemove", str(x), str(y))
            time.sleep(0.1)

    def close(self):
        self.key("ctrl+q")
        out, err = self.program.communicate(timeout=PATIENCE)
        return self.program.returncode, out, err

    def kill(self):
        if self.program.poll() is None:
            self.program.kill()
            self.program.communicate()
        self.server.terminate()
        self.server.wait()


def png_size(path):
    data = path.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    return struct.unpack(">II", data[16:24])


class EndToEnd(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def replay(self, path):
        run = subprocess.run([PROGRAM, "--json", "replay", str(path)], capture_output=True, text=True)
        return run.returncode, json.loads(run.stdout)

    def test_grab_compare_undo_and_replay(self):
        window = Window(self.folder)
        self.addCleanup(window.kill)
        window.drag((640, 330), (730, 260))
        wait_for("the hand to move", lambda: window.events("move", 3))
        window.key("F12")
        wait_for("a picture", lambda: (self.folder / "fuai-001.png").exists())
        window.do("mouseup", "1")
        wait_for("the release", lambda: window.events("release"))
        window.do("mousemove", "600", "300")
        window.do("click", "--repeat", "2", "--delay", "60", "1")  # a pin
        wait_for("the pin", lambda: [line for line in window.events("grab") if line.endswith(" 0.004")])
        window.key("h")
        window.key("c")  # a second fabric
        wait_for("two fabrics", lambda: "\n".join(window.lines()).count("\npart ") >= 1 and
                 sum(line.startswith("fabric ") for line in window.lines()) >= 3)
        window.key("ctrl+z")
        wait_for("one fabric again", lambda: sum(line.startswith("part ") for line in window.lines()) >= 3)
        window.key("l")
        window.key("t")
        ticks = len(window.events("hash"))
        wait_for("time to go on", lambda: window.events("hash", ticks + 3))
        code, out, err = window.close()
        self.assertEqual(code, 0, err)
        result = json.loads(out)
        self.assertGreater(result["pictures"], 3)
        self.assertEqual(png_size(self.folder / "end.png"), (1280, 720))
        self.assertGreater((self.folder / "fuai-001.png").stat().st_size, 20000)
        kept = window.settings.read_text(encoding="utf-8").splitlines()
        for line in ('language = "ja"', 'theme = "light"', 'units = "kes"', "plots = true"):
            self.assertIn(line, kept)
        code, replayed = self.replay(window.record)
        self.assertTrue(replayed["matches"], replayed)
        self.assertEqual(code, 0)

    def test_a_killed_window_leaves_its_recording(self):
        window = Window(self.folder)
        self.addCleanup(window.kill)
        window.drag((640, 330), (560, 300), steps=3)
        wait_for("the hand to move", lambda: window.events("move", 2))
        window.program.kill()
        window.program.communicate()
        code, replayed = self.replay(window.record)
        self.assertEqual((code, replayed["matches"]), (0, True))
        self.assertFalse(window.settings.exists())  # only a window that ends well knows what to keep


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
