"""How often the window paints, and what is pressed between two of its pictures.

The program is stopped while it is given input, so that all of it falls between two pictures.

SPDX-License-Identifier: Apache-2.0
"""
import contextlib
import json
import signal
import time

import window_pictures
from window_driver import WindowTest, main, wait_for

SMALL = ("--width", "320", "--height", "320", "--bare")  # painted in a few milliseconds
REST = 6.0            # seconds: without rest these would be hundreds of such pictures
HIDDEN = 80           # hashes out of sight: 8 simulated seconds
FEW = 40              # pictures for pausing, resting, two keys
MOST_A_SECOND = 62.0  # Xvfb says nothing about its rate: 60, and 1 % for rounding
VIEW = (330, 60, 930, 560)
LIGHT = 0.8 * 255


class Input(WindowTest):
    @contextlib.contextmanager
    def between_pictures(self, window):
        window.program.send_signal(signal.SIGSTOP)
        try:
            yield
        finally:
            window.program.send_signal(signal.SIGCONT)

    @staticmethod
    def view(window):
        return window.display.picture().part(VIEW)

    def wait_until(self, window, reference, same, what):
        """Until the view is, or is no more, as in a picture."""
        wait_for(what, lambda: window_pictures.alike(self.view(window), reference) == same)

    def drag(self, window, button, way):
        """From beside the cloth to the right and back to where the cursor was."""
        with self.between_pictures(window):
            window.do("mousemove", 400, 520, "mousedown", button, "mousemove", 400 + way, 520, "mouseup", button,
                      "mousemove", 640, 540)

    def test_quick_drags_turn_and_move_the_view_all_the_way(self):
        window = self.open()
        window.pause_at_the_start()
        window.steps(1500)
        window.move((640, 540))
        self.looks_like(window, "start")
        start = self.view(window)
        for button in (3, 2, 1):  # turns, moves, turns
            self.drag(window, button, 120)
            self.wait_until(window, start, False, f"a view that button {button} has changed")
            there = self.settled(lambda: self.view(window))
            self.drag(window, button, -120)
            self.wait_until(window, start, True, f"the view that button {button} has brought back")
            self.settled(lambda: self.view(window))  # else it were a double click
            self.drag(window, button, 60)
            self.wait_until(window, start, False, f"half of the way of button {button}")
            half = self.settled(lambda: self.view(window))
            self.assertFalse(window_pictures.alike(half, there))
            self.drag(window, button, 60)
            self.wait_until(window, there, True, f"twice half of the way of button {button}")
            window.key("Home")
            self.wait_until(window, start, True, "all of the scene")
        code, _, err = window.close()
        self.assertEqual((code, err), (0, ""))

    def test_each_press_of_a_key_counts(self):
        window = self.open(environment={"PATH": ""})  # films are numbered pictures
        window.pause_at_the_start()
        with self.between_pictures(window):
            window.key("F12", "F12", "F12")
        wait_for("three pictures", lambda: len(list(self.folder.glob("fuai-0*.png"))) == 3)
        with self.between_pictures(window):
            window.key("F10", "F10")
        wait_for("the picture of a video that is over", lambda: list(self.folder.glob("fuai-video-001/*.png")))
        with self.between_pictures(window):
            window.key("F10", "F10", "F10")
        wait_for("two more videos", lambda: list(self.folder.glob("fuai-video-003/*.png")))
        first, second = (self.folder / f"fuai-00{i}.fuai-view" for i in (1, 2))

        def begun(path):
            return path.exists() and "\nbegin\n" in path.read_text(encoding="utf-8")

        with self.between_pictures(window):  # the recording of --record ends, another begins and ends
            window.key("F9", "F9", "F9", "ctrl+s", "ctrl+s")
        wait_for("two fabrics", lambda: len(list(self.folder.glob("*.fabric.toml"))) == 2)
        wait_for("a recording that has begun", lambda: begun(first))
        window.key("F9")
        wait_for("another recording", lambda: begun(second))
        with self.between_pictures(window):
            window.key("space", "space", "space")
        wait_for("time to go on", lambda: second.read_text(encoding="utf-8").count(" hash") > 2)
        with self.between_pictures(window):
            window.key("F12", "F12", "ctrl+q")
        code, out, err = window.ended()
        self.assertEqual((code, err), (0, ""))
        self.assertEqual(len(list(self.folder.glob("fuai-0*.png"))), 5)
        bad = [message["text"] for message in json.loads(out)["messages"] if message["bad"]]
        self.assertEqual(bad, [])
        self.assertEqual(first.read_text(encoding="utf-8").count("part "), 1)
        code, replayed = self.replay(second)
        self.assertEqual((code, replayed["matches"]), (0, True))

    def test_each_step_back_counts(self):
        window = self.open()
        window.pause_at_the_start()
        window.steps(300)
        resets = len(window.events("reset"))
        with self.between_pictures(window):
            window.key("Left", "Left", "Left", "Right", "shift+Left", "shift+Left", "r")
        tick = int(wait_for("the start", lambda: window.events("reset", resets + 1))[-1].split()[0])
        self.assertEqual(tick, window.tick - 202)
        code, _, err = window.close()
        self.assertEqual((code, err), (0, ""))


class Idle(WindowTest):
    def theme_is_light(self, window):
        rows = window.display.picture().part((5, 200, 15, 210)).rows
        return min(rows[0][:3]) > LIGHT

    def test_a_paused_window_rests_and_shows_a_key_all_the_same(self):
        window = self.open(*SMALL)
        wait_for("time to go", lambda: window.events("hash", 2))
        window.key("space")
        time.sleep(REST)  # a slow machine paints less: nothing is asked of it
        self.assertFalse(self.theme_is_light(window))
        window.key("t")
        wait_for("another theme", lambda: self.theme_is_light(window))
        code, out, err = window.close()
        self.assertEqual((code, err), (0, ""))
        result = json.loads(out)
        self.assertLess(result["paused_pictures"], FEW)
        self.assertGreater(result["paused_pictures"], 0)

    def test_a_running_window_is_not_quicker_than_its_screen(self):
        started = time.monotonic()
        window = self.open(*SMALL)
        wait_for("time to go", lambda: window.events("hash", 30))
        code, out, err = window.close()
        self.assertEqual((code, err), (0, ""))
        self.assertLess(json.loads(out)["pictures"], MOST_A_SECOND * (time.monotonic() - started) + FEW)

    def test_a_hidden_window_goes_on_without_painting(self):
        started = time.monotonic()
        window = self.open(*SMALL)
        window.do("windowunmap", "--sync", window.window)
        seen = time.monotonic() - started
        wait_for("time to go on out of sight", lambda: window.events("hash", HIDDEN))
        window.program.send_signal(signal.SIGINT)
        code, out, err = window.ended()
        self.assertEqual(code, 0, err)
        result = json.loads(out)
        # Twice as many as there was time for, where those that were painted took as long as they say.
        self.assertLess(result["pictures"], 2e3 * seen / max(result["picture_ms"], 1e3 / MOST_A_SECOND) + FEW)
        code, replayed = self.replay(window.record)
        self.assertEqual((code, replayed["matches"]), (0, True))


if __name__ == "__main__":
    main()
