"""Panels of the window: another fabric, heat maps, comparing, undo, files that are dropped, languages, every key.

SPDX-License-Identifier: Apache-2.0
"""
import pathlib

from window_driver import PATIENCE, Window, WindowTest, main, wait_for

FABRIC_CHOICE = (157, 65)  # the combo box at the upper left
FABRIC_ENTRY = (80, 140)   # in its list
FABRIC_LIST = (10, 140, 300, 230)


class Panels(WindowTest):
    def drop(self, window, *paths):
        window.display.client.drop(int(window.window), paths, Window.MIDDLE, PATIENCE)

    def names(self, window):
        """Of the fabrics that are seen."""
        return [words[-1] for words in window.parts()[-1]]

    def wait_for_names(self, window, *names):
        wait_for(f"the fabrics {names}", lambda: self.names(window) == list(names))

    def table(self, window):
        return window.display.picture().part(FABRIC_LIST).rows

    def test_fabrics_are_switched_compared_taken_back_and_dropped(self):
        window = self.open()
        window.pause_at_the_start()
        window.steps(1500)
        self.looks_like(window, "start")
        window.pull((640, 400), 6)
        window.steps(200)

        for _ in range(3):  # warp strain, weft strain, shear angle
            window.key("h")
        self.looks_like(window, "heat-map", pulled=True)
        table = self.table(window)
        window.release()
        wait_for("the release", lambda: window.events("release"))

        window.key("c")
        wait_for("two fabrics", lambda: len(self.names(window)) == 2)
        second = self.names(window)[1]
        window.steps(100)
        self.looks_like(window, "compare", pulled=True)
        window.key("ctrl+z")
        self.wait_for_names(window, "wool-tropical")
        window.key("ctrl+shift+z")
        self.wait_for_names(window, "wool-tropical", second)
        window.key("ctrl+z")
        self.wait_for_names(window, "wool-tropical")

        wait_for("the table of the first fabric", lambda: self.table(window) == table)
        window.click(FABRIC_CHOICE)
        wait_for("the list", lambda: self.table(window) != table)
        window.click(FABRIC_ENTRY)
        wait_for("another fabric", lambda: self.names(window) != ["wool-tropical"])
        window.move(Window.MIDDLE)
        self.looks_like(window, "fabric", pulled=True)

        parts = len(window.parts())
        broken = self.folder / "broken.fabric.toml"
        broken.write_text('format = "fuai-fabric/1"\nname = ', encoding="utf-8")
        self.drop(window, broken)
        self.looks_like(window, "broken-file", pulled=True)
        self.assertEqual(len(window.parts()), parts)
        bundled = pathlib.Path(__file__).parents[2] / "data" / "fabrics"
        good = sorted(bundled.rglob("graded-10*.toml"))[0]
        self.drop(window, good)
        wait_for("the dropped fabric", lambda: self.names(window) == [str(good)])
        curve = bundled / "cupro-woven-su1098.shear.csv"
        self.drop(window, curve)
        wait_for("the curve on it", lambda: self.names(window) == [str(curve)])  # the last word of "good + curve"
        code, _, err = window.close()
        self.assertEqual(code, 0, err)
        code, replayed = self.replay(window.record)
        self.assertEqual((code, replayed["matches"]), (0, True), replayed)

    def test_every_key_in_both_languages_and_themes(self):
        window = self.open("--width", "1280", "--height", "720")
        window.pause_at_the_start()
        window.steps(1500)
        window.key("l", "t")
        window.key("F1")
        self.looks_like(window, "help-japanese-light")
        window.key("F1")
        # All of them one after another, those last that would end it or need the cloth's thread to go on.
        for key in ("space", "Right", "Left", "r", "BackSpace", "plus", "minus", "Escape", "h", "f", "w", "y", "g", "u",
                    "Home", "F2", "F3", "F2", "F3", "F11", "F11", "F12", "F10", "F10", "F9", "F9", "c", "ctrl+z",
                    "ctrl+shift+z", "ctrl+s", "ctrl+o", "l", "t", "l", "t", "F1", "ctrl+o", "F1"):
            window.key(key)
            self.assertIsNone(window.program.poll(), f"it ended at {key}")
        wait_for("the fabric", lambda: list(self.folder.glob("*.fabric.toml")))
        wait_for("a recording", lambda: (self.folder / "fuai-001.fuai-view").exists())
        code, _, err = window.close()
        self.assertEqual((code, err), (0, ""))
        kept = window.settings.read_text(encoding="utf-8").splitlines()
        for line in ('language = "ja"', 'theme = "light"', 'units = "si"', "weave = false"):
            self.assertIn(line, kept)


if __name__ == "__main__":
    main()
