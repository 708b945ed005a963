"""Recordings and `fuai replay` through the program: the same bits again, torn and spoilt files.

SPDX-License-Identifier: Apache-2.0
"""
import csv
import unittest

from program_tools import Case

SCENE = ["simulate", "taut_patch", "--fabric", "wool-tropical", "--size", "9", "--seconds", "0.6"]
FELT = ["haptics", "run", "--virtual-time", "--scene", "taut_patch", "--fabric", "wool-tropical", "--size", "9",
        "--seconds", "0.9", "--no-reference"]
KEYS = {"state_hash", "matches", "complete", "ticks", "cloth_steps", "checkpoints", "wrong_ticks",
        "wrong_checkpoints", "first_wrong_tick", "kind", "scene", "fabric", "program"}


class Determinism(Case):
    def test_a_replay_gives_the_same_hash(self):
        runs = [
            (SCENE, 600),
            (["simulate", "bending", "--size", "9", "--seconds", "0.1", "--solver", "explicit"], 100),
            (["simulate", "hanging_sheet", "--size", "9", "--seconds", "0.3", "--dt", "2ms"], 150),
            (FELT, 900),
            ([*FELT, "--cloth-rate", "60", "--device", "simulated:touch", "--force-gain", "2", "--no-controller"], 900),
        ]
        for words, ticks in runs:
            recorded = self.json_of(*words, "--record", "a.fuailog")
            replayed = self.json_of("replay", "a.fuailog")
            self.assertEqual(set(replayed), KEYS)
            self.assertEqual(replayed["state_hash"], recorded["state_hash"], words)
            self.assertTrue(replayed["matches"] and replayed["complete"], words)
            self.assertEqual(replayed["ticks"], ticks)
            self.assertEqual(replayed["wrong_ticks"] + replayed["wrong_checkpoints"], 0)
            self.assertEqual(self.files(), ["a.fuailog"])

    def test_recording_changes_nothing(self):
        self.assertEqual(self.json_of(*FELT), self.json_of(*FELT, "--record", "a.fuailog"))

    def test_the_table_has_every_tick(self):
        self.run_program(*FELT, "--record", "a.fuailog")
        self.run_program(*FELT, "--record", "direct.csv")
        self.run_program("replay", "a.fuailog", "--csv", "a.csv")
        with open(self.folder / "a.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        with open(self.folder / "direct.csv", encoding="utf-8", newline="") as file:
            direct = list(csv.DictReader(file))
        self.assertEqual(len(rows), 900)
        # Both print nine digits of the same doubles.
        for key in ["time_s", "device_x_m", "tool_z_m", "force_x_N", "model_force_y_N", "energy_J", "status"]:
            self.assertEqual([row[key] for row in rows], [row[key] for row in direct], key)

    def test_a_touched_recording_does_not_match(self):
        self.run_program(*SCENE, "--record", "a.fuailog")
        recording = (self.folder / "a.fuailog").read_bytes()
        # Another fabric under the same records: the text's length and checksum made right again.
        size = int.from_bytes(recording[12:16], "little")
        text = recording[24:24 + size].replace(b'"wool-tropical"', b'"graded-3"')
        head = recording[:12] + len(text).to_bytes(4, "little") + fnv(text).to_bytes(8, "little")
        self.write("b.fuailog", head + text + recording[24 + size:])
        done = self.run_program("--json", "replay", "b.fuailog", expect=1)
        self.assertIn('"matches":false', done.stdout)
        self.assertIn("is not as it was", done.stderr)
        self.assertIn("does not match", done.stderr)


class Safety(Case):
    def test_torn_and_spoilt_recordings_give_their_good_part(self):
        self.run_program(*SCENE, "--record", "a.fuailog")
        recording = (self.folder / "a.fuailog").read_bytes()
        head = len(recording) % 16384
        self.write("torn.fuailog", recording[:-20000])
        torn = self.json_of("replay", "torn.fuailog")
        self.assertTrue(torn["matches"])
        self.assertFalse(torn["complete"])
        self.assertGreater(torn["ticks"], 200)
        self.assertLess(torn["ticks"], 600)
        spoilt = bytearray(recording)
        spoilt[head + 5 * 16384 + 77] ^= 1
        self.write("spoilt.fuailog", bytes(spoilt))
        done = self.run_program("--json", "replay", "spoilt.fuailog")
        self.assertIn("torn or damaged", done.stderr)
        for name, content, message in [
            ("empty.fuailog", b"", "the file is empty"),
            ("words.fuailog", b"no recording at all, just words", "this is no recording"),
            ("head.fuailog", recording[:head], "there is no whole tick"),
            ("half.fuailog", recording[:head // 2], "ends within its head"),
        ]:
            self.write(name, content)
            self.refuse("replay", name, says=message)
        self.refuse("replay", "nosuch.fuailog", says="does not exist")
        self.refuse("replay", "torn.fuailog", "--csv", "no/such/folder.csv", says="does not exist")
        # Nor is the recording ever replaced by its own table, by whatever name.
        (self.folder / "link.csv").symlink_to("torn.fuailog")
        for name in ["torn.fuailog", "./torn.fuailog", "link.csv"]:
            self.refuse("replay", "torn.fuailog", "--csv", name, expect=2, says="would replace the input file")
        self.assertEqual((self.folder / "torn.fuailog").read_bytes(), recording[:-20000])

    def test_wrong_words_are_refused_with_a_cure(self):
        self.assertIn("FILE is required", self.run_program("replay", expect=2).stderr)
        self.refuse(*SCENE, "--record", "a.txt", expect=2, says="in .fuailog for what `fuai replay` takes")
        self.refuse(*SCENE, "--record", "no/such/a.fuailog", says="does not exist")


def fnv(data):
    """FNV-1a, 64 bit."""
    value = 0xcbf29ce484222325
    for byte in data:
        value = ((value ^ byte) * 0x100000001b3) & 0xffffffffffffffff
    return value


if __name__ == "__main__":
    unittest.main(verbosity=1)
