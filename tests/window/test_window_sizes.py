"""The window made small and large, out of focus, out of sight, closed in the middle of a drag.

SPDX-License-Identifier: Apache-2.0
"""

from window_driver import Window, WindowTest, main, wait_for

STEP_TIME = (130, 113, 200, 150)  # at 200 x 150, in the line at the bottom


class Sizes(WindowTest):
    def resize(self, window, width, height):
        window.do("windowsize", "--sync", window.window, width, height)

    def test_small_large_and_back(self):
        window = self.open("--width", "640", "--height", "400", width=3840, height=2160)
        window.do("windowmove", window.window, 0, 0)
        window.pause_at_the_start()
        window.steps(1500)
        self.looks_like(window, "size-640x400", (0, 0, 640, 400))
        # No place for panels, but it goes on.
        self.resize(window, 200, 150)
        self.looks_like(window, "size-200x150", (0, 0, 200, 150), times=STEP_TIME)
        self.resize(window, 3840, 2160)
        self.looks_like(window, "size-3840x2160")
        self.resize(window, 1280, 720)
        self.looks_like(window, "start", (0, 0, 1280, 720))
        code, _, err = window.close()
        self.assertEqual((code, err), (0, ""))

    def test_a_drag_that_is_torn_away(self):
        window = self.open("--screenshot", str(self.folder / "end.png"), width=1600, height=900)
        window.do("windowmove", window.window, 0, 0)
        window.pause_at_the_start()
        window.steps(1500)
        # Beyond the edge, where it is let go.
        window.grab(Window.MIDDLE)
        window.move((1500, 850))
        wait_for("the hand to move", lambda: window.events("move"))
        window.release()
        wait_for("the release", lambda: window.events("release"))
        # The focus goes to nothing, and the button is let go meanwhile.
        window.grab(Window.MIDDLE)
        window.do("windowfocus", self.root(window))
        window.move((700, 300))
        window.release()
        wait_for("the release without focus", lambda: window.events("release", 2))
        # Out of sight time goes on.
        wait_for("the focus", window.focus)
        window.key("space")
        window.do("windowunmap", "--sync", window.window)
        hashes = len(window.events("hash"))
        wait_for("time to go on out of sight", lambda: window.events("hash", hashes + 2))
        window.do("windowmap", "--sync", window.window)
        wait_for("the focus", window.focus)
        # Closed while it is dragged.
        window.pause_at_the_start()
        window.steps(1500)
        window.grab(Window.MIDDLE)
        window.display.client.ask_to_close(int(window.window))
        code, _, err = window.ended()
        self.assertEqual(code, 0, err)
        code, replayed = self.replay(window.record)
        self.assertEqual((code, replayed["matches"]), (0, True))
        self.assertEqual([force["hand"] for force in replayed["forces"]], [0])  # it still held

    @staticmethod
    def root(window):
        return window.do("search", "--maxdepth", "0", "--name", ".*").split()[0]


if __name__ == "__main__":
    main()
