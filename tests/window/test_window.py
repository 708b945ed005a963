"""Hands in the window: grab, drag, read the force, keep, pin, record, replay, quit, and a window that is killed.

SPDX-License-Identifier: Apache-2.0
"""
import json
import math

from window_driver import Window, WindowTest, main, wait_for

GRAM_FORCE = 9.80665e-3  # N


def shown_text(newtons):
    """As docs/viewer.md says: millinewtons below one newton, and gram-force."""
    if newtons < 1.0:
        return f"{1e3 * newtons:.1f} mN   {newtons / GRAM_FORCE:.2f} gf"
    return f"{newtons:.3f} N   {newtons / GRAM_FORCE:.1f} gf"


def force_colour(newtons):
    """Of the arrow on dark ground: with the logarithm of the force, from 0.1 mN to 10 N."""
    share = min(max(math.log10(newtons / 1e-4) / 5.0, 0.0), 1.0)
    return [round(255 * v) for v in (0.35 + 0.65 * share, 0.80 - 0.45 * share, 1.0 - 0.75 * share)]


class Hands(WindowTest):
    def test_grab_read_the_force_pin_and_replay(self):
        window = self.open("--screenshot", str(self.folder / "end.png"))
        window.pause_at_the_start()
        window.steps(1500)
        self.looks_like(window, "start")

        # Kept by Shift, on its way towards the eye.
        window.do("keydown", "shift")
        window.pull((640, 400), 6)
        window.release()
        window.do("keyup", "shift")
        window.steps(200)
        self.looks_like(window, "grab", pulled=True)
        self.assertIsNone(window.events("release"))

        window.move((540, 250))
        window.do("click", "--repeat", "2", "--delay", "60", "1")
        wait_for("the pin", lambda: [line for line in window.events("grab") if line.endswith(" 0.004")])
        window.steps(100)
        self.looks_like(window, "pin", pulled=True)

        # Its dot is taken up again, and moved without a step: the recording knows this tick.
        moves = len(window.events("move"))
        window.press((640, 400))
        window.move((642, 400))
        wait_for("the hand to move again", lambda: window.events("move", moves + 1))
        screen = window.display.picture()
        code, out, err = window.close()
        self.assertEqual(code, 0, err)
        result = json.loads(out)
        code, replayed = self.replay(window.record)
        self.assertEqual((code, replayed["matches"]), (0, True), replayed)
        self.assertEqual(replayed["ticks"], round(1e3 * result["seconds"]))

        # What the window shows is what the cloth of the recording does to the hands.
        forces = {force["hand"]: force["force_N"] for force in replayed["forces"]}
        self.assertEqual(sorted(forces), [0, 1])
        self.assertGreater(forces[0], 0.01)
        self.assertEqual({int(force["hand"]): force["shown"] for force in result["forces"]},
                         {hand: shown_text(force) for hand, force in forces.items()})
        # The arrow has the colour of its force, and not that of half or double the force.
        view = (320, 30, 930, 600)
        self.assertGreater(screen.count(*force_colour(forces[0]), view), 50)
        for wrong in (0.5, 2.0):
            self.assertLess(screen.count(*force_colour(wrong * forces[0]), view), 10)
        kept = window.settings.read_text(encoding="utf-8").splitlines()
        for line in ('language = "en"', 'theme = "dark"', 'units = "kes"', "plots = true"):
            self.assertIn(line, kept)

    def test_a_killed_window_leaves_its_recording(self):
        window = self.open()
        wait_for("time to go", lambda: window.events("hash", 2))
        window.grab(Window.MIDDLE)
        for i in range(1, 4):
            window.move((640 - 30 * i, 320))
            wait_for("the hand to move", lambda: window.events("move", i))
        hashes = len(window.events("hash"))
        wait_for("time to go on", lambda: window.events("hash", hashes + 2))
        window.kill()
        code, replayed = self.replay(window.record)
        self.assertEqual((code, replayed["matches"]), (0, True))
        self.assertGreaterEqual(replayed["checkpoints"], hashes + 2)
        self.assertFalse(window.settings.exists())  # only a window that ends well knows what to keep


if __name__ == "__main__":
    main()
