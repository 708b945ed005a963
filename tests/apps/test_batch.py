"""`fuai batch`: cases, tables, failures, resuming after kill -9, refusals.

SPDX-License-Identifier: Apache-2.0
"""
import csv
import json
import os
import shlex
import signal
import subprocess
import time
import unittest

from program_tools import FABRIC, PROGRAM, Case

QUICK = """format = "fuai-batch/1"
fabrics = ["wool-tropical", "./cloth.fabric.toml"]
[[cases]]
command = "kes"
test = "bending"
spacing = "5mm"
csv = "loop.csv"
[[cases]]
command = "cantilever"
direction = ["warp", "weft"]
length = "8cm"
spacing = "2cm"
width = "4cm"
elastic = true
"""
MANY = """format = "fuai-batch/1"
fabrics = ["wool-tropical", "polyester-faille"]
[[cases]]
command = "cantilever"
direction = ["warp", "weft"]
length = ["8cm", "9cm", "10cm", "11cm", "12cm", "13cm"]
spacing = "2cm"
width = "4cm"
"""


class Batch(Case):
    def records(self, folder="out"):
        """Case files by name, each whole."""
        return {p.stem: json.loads(p.read_text()) for p in (self.folder / folder / "cases").glob("*.json")}

    def table(self, folder="out"):
        with open(self.folder / folder / "results.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))


class Unit(Batch):
    def test_cases_tables_and_files(self):
        self.write("m.toml", QUICK)
        self.write("cloth.fabric.toml", FABRIC)
        done = self.json_of("batch", "m.toml", "--jobs", 2, "-o", "out")
        self.assertEqual((done["cases"], done["ran"], done["kept"], done["failed"]), (6, 6, 0, []))
        rows = self.table()
        self.assertEqual([row["setting.fabric"] for row in rows],
                         ["wool-tropical", "./cloth.fabric.toml", *["wool-tropical"] * 2, *["./cloth.fabric.toml"] * 2])
        self.assertEqual({row["exit_code"] for row in rows}, {"0"})
        self.assertAlmostEqual(float(rows[0]["B_gf_cm2_per_cm"]), 0.067, delta=0.0007)  # the round trip's 1 %
        self.assertEqual(rows[2]["B_gf_cm2_per_cm"], "")
        self.assertGreater(float(rows[2]["reach_m"]), 0.0)
        results = json.loads((self.folder / "out/results.json").read_text())
        self.assertEqual([c["case"] for c in results["cases"]], [row["case"] for row in rows])
        self.assertEqual(results["cases"][0]["result"]["fabric"], "wool-tropical")
        for row in rows[:2]:
            self.assertTrue((self.folder / "out/files" / row["case"] / "loop.csv").is_file())
        # A second call keeps everything and writes the same tables; another fabric file is another input.
        before = (self.folder / "out/results.csv").read_bytes()
        again = self.json_of("batch", "m.toml", "-o", "out")
        self.assertEqual((again["ran"], again["kept"]), (0, 6))
        self.assertEqual((self.folder / "out/results.csv").read_bytes(), before)
        self.write("cloth.fabric.toml", FABRIC.replace("B_gf_cm2_per_cm = 0.06", "B_gf_cm2_per_cm = 0.07"))
        again = self.json_of("batch", "m.toml", "-o", "out")
        self.assertEqual((again["ran"], again["kept"]), (3, 3))
        self.assertAlmostEqual(float(self.table()[1]["B_gf_cm2_per_cm"]), 0.07, delta=0.0007)

    def test_a_listed_case_is_a_command_that_gives_the_same_result(self):
        self.write("m.toml", QUICK)
        self.write("cloth.fabric.toml", FABRIC)
        lines = self.run_program("batch", "m.toml", "--list").stdout.splitlines()
        self.assertEqual(len(lines), 6)
        name, line = lines[5].split("\t")
        self.assertEqual(self.files(), ["cloth.fabric.toml", "m.toml"])
        words = shlex.split(line)
        self.assertEqual(words[:2], ["fuai", "--json"])
        alone = json.loads(self.run_program(*words[1:]).stdout)
        self.run_program("batch", "m.toml", "-o", "out", "--case", name)
        self.assertEqual(list(self.records()), [name])
        self.assertEqual(self.records()[name]["result"], alone)
        self.assertFalse((self.folder / "out/results.csv").exists())
        listed = self.json_of("batch", "m.toml", "--list")["cases"]
        self.assertEqual([c["case"] for c in listed], [text.split("\t")[0] for text in lines])
        self.assertEqual(listed[5]["command_line"], words)

    def test_every_command_takes_the_kinds_of_values_that_its_options_have(self):
        self.write("m.toml", 'format = "fuai-batch/1"\nfabrics = "graded-1"\n'
                   '[[cases]]\ncommand = "loop"\nloop = "ring"\nsegments = 16\n'
                   '[[cases]]\ncommand = "drape"\nruns = [1, 2]\nno-bands = true\nout = "."\nseed = 3\n'
                   '[[cases]]\ncommand = "simulate"\nscene = "yank"\nsize = 8\nrecord = "r.csv"\n'
                   '[[cases]]\ncommand = "kes"\ntest = "tensile"\nreverse = [["1", "1.5:0.5"]]\n')
        lines = [line.split("\t") for line in self.run_program("batch", "m.toml", "--list", "-o", "o").stdout.splitlines()]
        self.assertEqual([line for _, line in lines], [
            "fuai --json --seed 0 --threads 1 loop ring graded-1 --segments 16",
            f"fuai --json --seed 3 --threads 1 drape graded-1 --runs 1 --no-bands --out o/files/{lines[1][0]}/.",
            f"fuai --json --seed 3 --threads 1 drape graded-1 --runs 2 --no-bands --out o/files/{lines[2][0]}/.",
            f"fuai --json --seed 0 --threads 1 simulate yank --fabric graded-1 --size 8 --record o/files/{lines[3][0]}/r.csv",
            "fuai --json --seed 0 --threads 1 kes tensile graded-1 --reverse 1 1.5:0.5"])

    def test_failures_are_recorded_and_the_others_go_on(self):
        self.write("bad.fabric.toml", FABRIC.replace("W_mg_per_cm2 = 16", "W_mg_per_cm2 = -16"))
        self.write("m.toml", 'format = "fuai-batch/1"\nfabrics = ["bad.fabric.toml", "wool-tropical"]\n'
                   '[[cases]]\ncommand = "cantilever"\nspacing = "2cm"\nwidth = "4cm"\nlength = ["9cm", "9"]\n')
        done = self.run_program("--json", "batch", "m.toml", "-o", "out", expect=1)
        result = json.loads(done.stdout)
        self.assertEqual([f["exit_code"] for f in result["failed"]], [3, 2, 2])  # options are read before the fabric
        self.assertIn("m.toml:4:", done.stderr)
        rows = self.table()
        self.assertEqual([row["exit_code"] for row in rows], ["3", "2", "0", "2"])
        self.assertIn("is negative", rows[0]["message"])
        self.assertIn("--length", rows[3]["message"])
        self.assertEqual(rows[2]["message"], "")
        # What fails by itself fails again: it is kept, and still counts.
        self.assertEqual(json.loads(self.run_program("--json", "batch", "m.toml", "-o", "out", expect=1).stdout)["ran"], 0)
        retried = self.run_program("--json", "batch", "m.toml", "-o", "out", "--retry", expect=1)
        self.assertEqual(json.loads(retried.stdout)["ran"], 3)


class Safety(Batch):
    def test_a_killed_run_goes_on_without_losing_or_repeating_a_case(self):
        self.write("m.toml", MANY)
        surroundings = {k: v for k, v in os.environ.items() if not k.startswith("FUAI_")}
        finished = {}
        for at_least in (3, 8):  # killed twice, at other moments
            with subprocess.Popen([PROGRAM, "-q", "batch", "m.toml", "--jobs", "2", "-o", "out"], cwd=self.folder,
                                  env=surroundings, start_new_session=True) as running:
                cases = self.folder / "out/cases"
                while len(list(cases.glob("*.json"))) < at_least and running.poll() is None:
                    time.sleep(0.002)
                self.assertIsNone(running.poll(), "it was to be killed at work")
                os.kill(running.pid, signal.SIGKILL)
            kept = {name: self.identity("out/cases/" + name + ".json") for name in self.records()}  # all whole
            self.assertGreaterEqual(len(kept), at_least)
            for name, identity in finished.items():
                self.assertEqual(kept[name], identity, "a finished case was repeated")
            finished = kept
        self.assertFalse((self.folder / "out/results.csv").exists())
        self.write("out/cases/.left.json.1.0.tmp", "half")
        done = self.json_of("batch", "m.toml", "-o", "out")
        self.assertEqual((done["cases"], done["kept"], done["ran"]), (24, len(finished), 24 - len(finished)))
        for name, identity in finished.items():
            self.assertEqual(self.identity("out/cases/" + name + ".json"), identity)
        self.assertEqual(len(self.table()), 24)
        self.assertFalse((self.folder / "out/cases/.left.json.1.0.tmp").exists())
        # The same as in one go, but for the times.
        self.json_of("batch", "m.toml", "--jobs", "1", "-o", "other")

        def without_times(folder):
            return {name: {**record, "wall_seconds": 0} for name, record in self.records(folder).items()}

        self.assertEqual(without_times("out"), without_times("other"))

    def test_a_second_batch_stays_out_of_the_folder(self):
        self.write("m.toml", MANY)
        with subprocess.Popen([PROGRAM, "-q", "batch", "m.toml", "-o", "out"], cwd=self.folder) as first:
            while not (self.folder / "out/cases").exists():
                time.sleep(0.002)
            second = self.run_program("batch", "m.toml", "-o", "out", expect=3)
            self.assertIn("another program is at work", second.stderr)
            first.kill()

    def test_a_wrong_manifest_is_refused_before_anything_runs(self):
        good = QUICK.replace(', "./cloth.fabric.toml"', "")
        for change, says in (
            (("wool-tropical", "wol-tropical"), "m.toml:2:12: fabrics: no bundled fabric is called 'wol-tropical'; "
                                                "did you mean wool-tropical?"),
            (('"kes"', '"kse"'), "m.toml:4:11: cases[0].command: no command 'kse' makes cases; did you mean kes?"),
            (("spacing", "spcing"), "m.toml:6:1: cases[0].spcing: `fuai kes` has no setting 'spcing'; did you mean spacing?"),
            (('"5mm"', "5"), "m.toml:6:11: cases[0].spacing: a number alone is not expected"),
            (("elastic = true", 'elastic = "yes"'), "true or false is expected"),
            (('"warp", "weft"', '"warp", "wept"'), "m.toml:10:22: cases[1].direction: --direction: wept not in"),
            (("length", "angle = '41.5deg'\nlength"), "m.toml:12:10: cases[1].length: Exactly 1 option from [--length,--angle]"),
            (('test = "bending"', 'test = "bend"'), "m.toml:5:8: cases[0].test: TEST: bend not in"),
            (('test = "bending"', ""), "needs 'test'"),
            (('"fuai-batch/1"', '"fuai-batch/9"'), "m.toml:1:10: format"),
            (("[[cases]]", "[[cases]"), "m.toml:3"),
        ):
            self.write("m.toml", good.replace(*change))
            self.refuse("batch", "m.toml", "-o", "out", says=says)
        self.refuse("batch", "none.toml", "-o", "out", says="none.toml")
        self.write("m.toml", good)
        self.refuse("batch", "m.toml", expect=2, says="-o is missing")
        self.refuse("batch", "m.toml", "-o", "out", "--case", "kes-wool", expect=2, says="has no case 'kes-wool'")
        self.refuse("batch", "m.toml", "-o", "m.toml", says="cannot make the folder")
        self.run_program("batch", "m.toml", "-o", "out", "--jobs", "0", expect=2)


if __name__ == "__main__":
    unittest.main()
