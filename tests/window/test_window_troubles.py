"""What is missing or forbidden: one clear line each, and the window goes on.

SPDX-License-Identifier: Apache-2.0
"""
import json
import resource
import signal

from window_driver import WindowTest, main, wait_for

RECORDING_DOT = (242, 77, 64)
BAR = (0, 650, 1280, 720)


class Troubles(WindowTest):
    def records(self, window):
        return window.display.picture().count(*RECORDING_DOT, BAR) > 0

    def limit(self, window, size):
        hard = resource.prlimit(window.program.pid, resource.RLIMIT_FSIZE)[1]
        resource.prlimit(window.program.pid, resource.RLIMIT_FSIZE, (size, hard))

    def test_without_programs_fonts_gamepad_and_folder_and_with_a_full_disk(self):
        # No program on the PATH, so no ffmpeg, and a fontconfig that knows no font.
        (self.folder / "fonts.conf").write_text("<fontconfig/>", encoding="utf-8")
        out = self.folder / "out"
        window = self.open("--rumble", out=out,
                           environment={"FONTCONFIG_FILE": str(self.folder / "fonts.conf"), "PATH": ""})
        # The folder is not there: picture, film and fabric are refused in the window.
        for key in ("F12", "F10", "ctrl+s"):
            window.key(key)
        hashes = len(window.events("hash", 0))
        wait_for("time to go on", lambda: window.events("hash", hashes + 2))
        # The film makes its folder itself, where pictures go without ffmpeg.
        wait_for("pictures of the film", lambda: list(out.glob("fuai-video-001/*.png")))
        window.key("F10")
        window.key("F12")
        wait_for("a picture once the folder is there", lambda: list(out.glob("fuai-*.png")))

        # The disk is full in the middle of the recording.
        self.assertTrue(self.records(window))
        self.limit(window, window.record.stat().st_size)
        wait_for("the end of the recording", lambda: not self.records(window))
        self.limit(window, resource.RLIM_INFINITY)
        pictures = len(list(out.glob("fuai-*.png")))
        window.key("F12")
        wait_for("a picture after that", lambda: len(list(out.glob("fuai-*.png"))) > pictures)
        code, replayed = self.replay(window.record)
        self.assertEqual((code, replayed["matches"]), (0, True))
        code, _, err = window.close()
        self.assertEqual(code, 0, err)
        lines = err.splitlines()
        self.assertEqual(len(lines), 2, err)
        self.assertTrue([line for line in lines if "no font with Japanese" in line], err)
        self.assertTrue([line for line in lines if "no gamepad rumbles" in line], err)

    def test_ctrl_c_takes_the_force_off_and_ends_it_as_closing_does(self):
        window = self.open("--device", "simulated:touch")
        wait_for("the device's hand", lambda: window.events("grab 15"))
        window.program.send_signal(signal.SIGINT)
        window.program.send_signal(signal.SIGINT)  # twice at once, as `timeout -s INT` does
        code, out, err = window.ended()
        self.assertEqual(code, 0, err)
        self.assertEqual(json.loads(out)["device"], "3D Systems Touch")
        self.assertTrue(window.settings.exists())
        code, replayed = self.replay(window.record)
        self.assertEqual((code, replayed["matches"]), (0, True))


if __name__ == "__main__":
    main()
