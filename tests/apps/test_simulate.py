"""Scenes of the engine through the program: simulate, its record, render, and what they refuse.

SPDX-License-Identifier: Apache-2.0
"""
import csv
import math
import struct
import unittest

from program_tools import Case

ENGINE = ["hanging_sheet", "hanging_strip", "taut_patch", "yank", "shake", "bending", "corner_drape",
          "grasp_and_lift", "table_edge", "drape_tester"]
COLUMNS = ["time_s", "hand_x_m", "hand_y_m", "hand_z_m", "force_x_N", "force_y_N", "force_z_N", "moment_x_Nm",
           "moment_y_Nm", "moment_z_Nm", "status", "residual_N"]
FABRIC = ["--fabric", "wool-tropical"]
SMALL = [*FABRIC, "--size", "9", "--seconds", "0.02"]


class Unit(Case):
    def test_scenes_lists_what_simulate_runs(self):
        scenes = self.json_of("scenes")["scenes"]
        self.assertEqual([s["name"] for s in scenes if s["solver"] == "engine"], ENGINE)
        self.assertEqual([s["name"] for s in scenes if s["solver"] == "paper"], ["paper_drape", "paper_bending"])
        for scene in ENGINE:
            result = self.json_of("simulate", scene, *SMALL)
            self.assertEqual(result["steps"], 20, scene)
            self.assertEqual(result["status_ticks"]["not_finite"], 0, scene)
            self.assertTrue(math.isfinite(result["energy_J"]["total"]), scene)

    def test_the_json_has_the_keys_of_the_contract(self):
        result = self.json_of("simulate", "taut_patch", *SMALL, "--dt", "500us", "--spacing", "2cm", "--iterations", "5")
        self.assertRegex(result["state_hash"], "^[0-9a-f]{16}$")
        energy = result["energy_J"]
        self.assertEqual(list(energy), ["stretch", "shear", "bending", "twist", "weight", "kinetic", "total"])
        # The total is the sum, to rounding of seven doubles.
        self.assertAlmostEqual(sum(list(energy.values())[:-1]), energy["total"], delta=1e-12 * abs(energy["weight"]))
        self.assertEqual(len(result["grasp_force_N"]), 3)
        self.assertEqual(len(result["grasp_moment_Nm"]), 3)
        self.assertAlmostEqual(math.hypot(*result["grasp_force_N"]), result["grasp_force_norm_N"], places=12)
        self.assertGreaterEqual(result["grasp_force_peak_N"], result["grasp_force_norm_N"])
        times = result["step_us"]
        self.assertEqual(list(times), ["p50", "p99", "max"])
        self.assertLessEqual(times["p50"], times["p99"])
        self.assertLessEqual(times["p99"], times["max"])
        self.assertEqual((result["steps"], result["nodes"], result["spacing_m"]), (40, 81, 0.02))
        self.assertAlmostEqual(result["seconds"], 0.02, places=12)
        self.assertEqual((result["scene"], result["fabric"], result["precision"]), ("taut_patch", "wool-tropical", "float"))
        self.assertGreater(len(result["target"]), 0)
        self.assertGreaterEqual(result["residual_N"], 0)
        self.assertEqual(set(result["status_ticks"]), {"not_finite", "started_back", "shortened", "saturated"})
        for word in result["status"].split("+"):
            self.assertIn(word, ["fine", "started back", "shortened"])
        # Nobody holds a sheet that hangs.
        hanging = self.json_of("simulate", "hanging_sheet", *SMALL)
        for key in ["grasp_force_N", "grasp_force_norm_N", "grasp_force_peak_N", "grasp_moment_Nm"]:
            self.assertIsNone(hanging[key])

    def test_the_record_has_a_row_a_tick_and_empty_cells_without_a_hand(self):
        result = self.json_of("simulate", "taut_patch", *SMALL, "--record", "a.csv")
        with open(self.folder / "a.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual(len(rows), 20)
        self.assertEqual([round(1e3 * float(row["time_s"]), 6) for row in rows], list(range(1, 21)))
        last = [float(rows[-1][f"force_{axis}_N"]) for axis in "xyz"]
        for written, said in zip(last, result["grasp_force_N"]):
            self.assertAlmostEqual(written, said, delta=1e-8 * abs(said) + 1e-12)  # nine digits
        self.assertEqual(float(rows[-1]["residual_N"]), float(f"{result['residual_N']:.9g}"))
        self.run_program("-q", "simulate", "hanging_sheet", *SMALL, "--record", "b.csv")
        with open(self.folder / "b.csv", encoding="utf-8", newline="") as file:
            row = next(csv.DictReader(file))
        self.assertEqual([row[name] for name in COLUMNS[1:10]], [""] * 9)
        self.assertEqual(self.files(), ["a.csv", "b.csv"])

    def test_the_same_run_twice_has_the_same_hash_and_any_other_run_another(self):
        def hash_of(*words, seconds="0.02"):
            return self.json_of("simulate", "grasp_and_lift", *FABRIC, "--size", "9", "--seconds", seconds,
                                *words)["state_hash"]

        runs = [hash_of(), hash_of("--precision", "double"), hash_of("--spacing", "5mm"), hash_of("--dt", "2ms"),
                hash_of("--iterations", "2")]
        self.assertEqual(len(set(runs)), len(runs))
        self.assertEqual(hash_of("--precision", "float", "--dt", "1ms", "--iterations", "8", seconds="20ms"), runs[0])

    def test_any_solver_runs_a_scene_and_the_json_says_which_and_what_a_tick_is(self):
        usual = self.json_of("simulate", "bending", *SMALL)
        runs = {name: self.json_of("simulate", "bending", *SMALL, "--solver", name)
                for name in ["implicit", "double", "explicit", "paper"]}
        self.assertEqual(runs["implicit"]["state_hash"], usual["state_hash"])
        self.assertEqual(runs["double"]["state_hash"],
                         self.json_of("simulate", "bending", *SMALL, "--precision", "double")["state_hash"])
        self.assertEqual(len({run["state_hash"] for run in runs.values()}), 4)
        self.assertEqual((usual["solver"], usual["precision"], usual["has_time"], usual["inner_steps"]),
                         ("implicit", "float", True, 1))
        for name, run in runs.items():
            self.assertEqual(run["solver"], name)
            self.assertEqual(run["precision"], "float" if name == "implicit" else "double", name)
            self.assertEqual(run["has_time"], name != "paper", name)
            self.assertEqual(set(run), set(usual), name)
        self.assertEqual(runs["paper"]["inner_steps"], 100)
        self.assertEqual(runs["paper"]["energy_J"]["kinetic"], 0)
        self.assertGreater(runs["explicit"]["inner_steps"], 10)
        self.assertIsNone(runs["explicit"]["residual_N"])
        for name in ["explicit", "paper"]:
            self.assertIsNone(runs[name]["target"])
            self.assertEqual(runs[name]["threads"], 1)
        few = self.json_of("simulate", "bending", *SMALL, "--solver", "paper", "--iterations", "3")
        self.assertEqual(few["inner_steps"], 3)
        self.assertNotEqual(few["state_hash"], runs["paper"]["state_hash"])
        fine = self.json_of("simulate", "bending", *SMALL, "--solver", "explicit", "--iterations", "1000")
        self.assertEqual(fine["inner_steps"], 1000)
        said = self.run_program("simulate", "bending", *SMALL, "--solver", "paper").stdout
        self.assertIn("20 steps of 1 ms, each 100 steps of the paper's descent, which has no time", said)

    def test_people_read_a_short_summary(self):
        done = self.run_program("simulate", "taut_patch", *SMALL)
        for word in ["20 steps of 1 ms", "max strain", "grasp force", "state hash"]:
            self.assertIn(word, done.stdout)
        self.assertEqual(self.run_program("-q", "simulate", "table_edge", *SMALL).stderr, "")


class Safety(Case):
    def test_wrong_usage_says_how_to_mend_it(self):
        for words, says in [
            (["hanging_shet"], "did you mean hanging_sheet? the scenes are hanging_sheet"),
            (["paper_drape"], "`fuai paper`"),
            (["table_edge", "--size", "2"], "--size"),
            (["table_edge", "--size", "513"], "--size"),
            (["table_edge", "--spacing", "1"], "--spacing"),
            (["table_edge", "--spacing", "1kg"], "--spacing"),
            (["table_edge", "--spacing", "11cm"], "take 0.1mm to 10cm"),
            (["table_edge", "--spacing=-1cm"], "take 0.1mm to 10cm"),
            (["table_edge", "--dt", "0.5us"], "take 1us to 1s"),
            (["table_edge", "--dt", "2s"], "take 1us to 1s"),
            (["table_edge", "--dt", "1"], "--dt"),
            (["table_edge", "--dt=-1ms"], "--dt"),
            (["table_edge", "--seconds", "0"], "--seconds"),
            (["table_edge", "--seconds=-1"], "--seconds"),
            (["table_edge", "--seconds", "3601"], "at most 3600s"),
            (["table_edge", "--seconds", "nan"], "--seconds"),
            (["table_edge", "--seconds", "1m"], "--seconds"),
            (["table_edge", "--seconds", "3600", "--dt", "1us"], "more than ten million"),
            (["table_edge", "--seconds", "3600", "--record", "a.csv"], "more than a million rows"),
            (["table_edge", "--record", "a.txt"], "end the name in .csv"),
            (["table_edge", "--solver", "explict"], "did you mean explicit? the solvers are implicit, double, explicit, paper"),
            (["table_edge", "--solver", "explicit", "--precision", "float"], "computes in double only"),
            (["table_edge", "--solver", "double", "--precision", "float"], "computes in double only"),
            (["table_edge", "--solver", "explicit", "--iterations", "1"], "are not stable; take at least"),
            (["yank", "--solver", "paper"], "'yank' is about speed"),
            (["shake", "--solver", "paper"], "'shake' is about speed"),
            (["corner_drape", "--spacing", "7.5mm", "--solver", "paper"], "rectangles of whole cells"),
            (["paper_drape", "--solver", "paper"], "--solver paper"),
        ]:
            done = self.run_program("simulate", *words, expect=2)
            self.assertIn(says, done.stderr, words)
            self.assertEqual(done.stdout, "")
        for words in [["--iterations", "0"], ["--iterations", "1001"], ["--precision", "half"], ["--size", "9.5"]]:
            self.assertIn(words[0], self.run_program("simulate", "table_edge", *words, expect=2).stderr)
        self.run_program("simulate", expect=2)
        self.assertEqual(self.files(), [])

    def test_bad_input_is_exit_code_3(self):
        self.refuse("simulate", "table_edge", "--fabric", "none", says="no bundled fabric")
        self.refuse("simulate", "table_edge", *SMALL, "--record", "none/a.csv", says="none/a.csv")
        (self.folder / "b.csv").mkdir()
        self.refuse("simulate", "table_edge", *SMALL, "--record", "b.csv", says="this is a directory")

    def test_render_refuses_what_the_scene_does_not_take(self):
        for words, says in [
            (["hanging_sheet", "--as-printed"], "--as-printed is for the scenes of the paper"),
            (["paper_drape", "--size", "9"], "leave --size and --spacing out"),
            (["paper_drape", "--spacing", "5mm"], "leave --size and --spacing out"),
            (["hangin_sheet"], "did you mean hanging_sheet?"),
        ]:
            self.refuse("render", *words, "-o", "a.png", expect=2, says=says)


class Pictures(Case):
    def test_render_takes_a_picture_of_every_scene(self):
        for scene in ENGINE:
            result = self.json_of("render", scene, *FABRIC, "--size", "9", "--time", "10ms", "--width", "96", "--height",
                                  "64", "-o", "a.png")
            data = (self.folder / "a.png").read_bytes()
            self.assertEqual(struct.unpack(">II", data[16:24]), (96, 64), scene)
            self.assertEqual(result["steps"], 10, scene)
            simulated = self.json_of("simulate", scene, *FABRIC, "--size", "9", "--seconds", "10ms")
            self.assertEqual(result["state_hash"], simulated["state_hash"], scene)


if __name__ == "__main__":
    unittest.main(verbosity=1)
