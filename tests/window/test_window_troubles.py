"""What is missing or forbidden: one clear line each, and the window goes on.

SPDX-License-Identifier: Apache-2.0
"""
import json
import resource
import signal

from window_driver import PATIENCE, WindowTest, main, wait_for

RECORDING_DOT = (242, 77, 64)
BAR = (0, 650, 1280, 720)
VIEW = (320, 30, 930, 640)
RED_LEAST, OTHERS_MOST = 180, 90  # of 255: letters of a bad message, thin as they are


class Troubles(WindowTest):
    def records(self, window):
        return window.display.picture().count(*RECORDING_DOT, BAR) > 0

    def red_letters(self, window):
        """Pixels of what is told in red over the cloth."""
        rows = window.display.picture().part(VIEW).rows
        return sum(red >= RED_LEAST and green <= OTHERS_MOST and blue <= OTHERS_MOST
                   for row in rows for blue, green, red in zip(row[0::4], row[1::4], row[2::4]))

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

    def test_what_is_wrong_is_told_in_japanese(self):
        window = self.open("--language", "ja", "--rumble", out=self.folder / "out")
        head = 'format = "fuai-fabric/1"\nname = "Wool"\n[weight]\nW_mg_per_cm2 = '
        for name, text in {
                "a.fabric.toml": head + "\n",
                "b.fabric.toml": head + "-16.3\n",
                "c.csv": "name,B1,B2\nWool,0.1,x\n",
                "d.csv": "# fuai-curve/1 test=bending\ncurvature_per_cm,moment_gf_cm_per_cm\n1,2\n",
                "e.json": '{"schema": "1.1", ',
                "f.fuai-view": "fuai-view/1\npart 0 anew\nscene hanging_sheet\nmoved 3\n"}.items():
            (self.folder / name).write_text(text, encoding="utf-8")
            window.display.client.drop(int(window.window), [self.folder / name], window.MIDDLE, PATIENCE)
        window.key("F12")  # its folder is not there
        wait_for("what is said", lambda: self.red_letters(window) > 100)
        code, out, err = window.close()
        self.assertEqual(code, 0, err)
        said = [message["text"] for message in json.loads(out)["messages"] if message["bad"]]
        folder, refused = self.folder, " (変更はありません)"
        # The words of the TOML library are its own.
        self.assertRegex(said.pop(1), rf"^開けません: {folder}/a.fabric.toml:4:.*: TOML の書き方に誤りがあります \(.*\)。"
                                      r"TOML を直してください。ここでファイルが切れているかもしれません \(変更はありません\)$")
        self.assertEqual(said, [
            "振動するゲームパッドがありません (振動するゲームパッドをつないでください。/dev/input/event* があるなら、"
            "自分を input グループに加えてください); マウスで続けます",
            f"開けません: {folder}/b.fabric.toml:4:16: weight.W_mg_per_cm2: -16.3 mg/cm² は負です。"
            f"負にならない量です。符号を確認してください{refused}",
            f"開けません: {folder}/c.csv:2:10: B2: 'x' は数値ではありません。"
            f"0.067 のように数値を書いてください{refused}",
            f"開けません: {folder}/d.csv:1:1: どの方向に測ったか書かれていません。"
            f"先頭の行に direction=warp (たて) か direction=weft (よこ) と書いてください{refused}",
            f"開けません: {folder}/e.json:1:19: JSON がここで壊れているか、切れています。書き出し直してください{refused}",
            f"開けません: {folder}/f.fuai-view:4: 設定に「moved」はありません{refused}",
            f"{folder}/out/fuai-001.png: フォルダ「{folder}/out」がありません。先にフォルダを作ってください"])

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
