"""The command line's contract: help, version, JSON, streams, exit codes, options, values with units.

SPDX-License-Identifier: Apache-2.0
"""
import os
import signal
import struct
import subprocess
import time
import unittest
from html.parser import HTMLParser

from program_tools import FABRIC, PROGRAM, SOURCE, Case

COMMANDS = ["fabrics", "fabric", "fabric import", "fabric fit", "fabric bands", "fabric show", "fabric compare", "fabric card", "paper", "scenes", "render", "simulate", "replay", "report", "batch"]
# Any file that is no driver description hides all drivers, as tests/picture does.
NO_DRIVER = {"__EGL_VENDOR_LIBRARY_FILENAMES": "/dev/null"}


class Unit(Case):
    def test_every_command_has_help_with_an_example(self):
        for command in ["", *COMMANDS]:
            done = self.run_program(*command.split(), "--help")
            self.assertIn("Examples:\n  fuai " + command.split(" ")[0], done.stdout)
            self.assertEqual(done.stderr, "")

    def test_version_is_that_of_the_project(self):
        text = (SOURCE / "CMakeLists.txt").read_text()
        version = text.split("project(fuai VERSION ")[1].split()[0]
        self.assertEqual(self.run_program("--version").stdout, f"fuai {version}\n")

    def test_wrong_usage_names_the_word_and_exits_with_2(self):
        for words, message in [
            (["nosuch"], "has no command 'nosuch'; did you mean 'batch'?\nThe commands are fabrics, fabric, paper, scenes, render, simulate, cantilever, drape, loop, kes, haptics, replay, view, report or batch."),
            (["fabrcs"], "did you mean 'fabrics'?"),
            (["fabric", "shw"], "did you mean 'show'?"),
            (["render", "paper_drape", "--tme", "2s", "-o", "a.png"], "did you mean '--time'?"),
            (["scenes", "extra"], "does not take 'extra'"),
            (["paper", "--figure", "2"], "--figure"),
            (["render", "paper_drape"], "--output is required"),
            (["render", "paper_drape", "-o", "a.png", "--width", "8"], "--width"),
            (["--threads", "1000", "scenes"], "--threads"),
            (["--seed", "-1", "scenes"], "--seed"),
            (["render", "paper_drap", "--time", "0s", "-o", "a.png"], "did you mean paper_drape? the scenes are "),
            (["render", "paper_drape", "-o", "a.jpg"], "end the name in .png"),
            (["fabric", "show", "wool-tropical", "--plot", "a.gif"], "end the name in .png or .svg"),
        ]:
            done = self.run_program(*words, expect=2)
            self.assertIn(message, done.stderr)
            self.assertEqual(done.stdout, "")
        self.assertIn("Usage: fuai", self.run_program(expect=2).stderr)
        self.assertIn("Usage: fuai fabric", self.run_program("fabric", expect=2).stderr)
        self.assertEqual(self.files(), [])

    def test_fabrics_are_one_line_each_in_natural_order(self):
        ids = [line.split()[0] for line in self.run_program("fabrics").stdout.splitlines()]
        bundled = {p.name.removesuffix(".fabric.toml") for p in (SOURCE / "data/fabrics").glob("*.toml")}
        self.assertEqual(set(ids), bundled)
        self.assertEqual([i for i in ids if i.startswith("graded")],
                         ["graded-1", "graded-3", "graded-6", "graded-10"])
        listed = self.json_of("fabrics")["fabrics"]
        self.assertEqual([f["id"] for f in listed], ids)
        by_id = {f["id"]: f for f in listed}
        self.assertEqual(by_id["graded-1"]["measured"], [])
        self.assertIn("bending", by_id["wool-tropical"]["measured"])
        # 16.29 mg/cm2, exact but for the rounding of the conversion
        self.assertAlmostEqual(by_id["wool-tropical"]["areal_mass_kg_per_m2"], 0.1629, places=12)

    def test_show_fits_a_terminal_and_its_json_has_units(self):
        for fabric in ["cupro-woven-su1098", "cotton-knit-shirley", "graded-3", "wool-tropical"]:
            done = self.run_program("fabric", "show", fabric)
            for line in done.stdout.splitlines():
                self.assertLessEqual(len(line), 100, line)
            self.assertEqual(done.stdout.count("Matsudaira"), int(fabric == "wool-tropical"))
        shown = self.json_of("fabric", "show", "cupro-woven-su1098")
        for path, entry in shown["numbers"].items():
            key = path.rpartition(".")[2]
            self.assertIn(key, entry)
            self.assertTrue(entry["si_unit"], path)
            self.assertIn("source", entry["provenance"])
        self.assertEqual(shown["numbers"]["tensile.warp.peak_load_gf_per_cm"]["si_unit"], "N/m")
        self.assertGreater(shown["laws"]["tensile.warp"]["rms_residual_percent"], 0)
        self.assertIsNone(shown["laws"]["bending.warp"]["rms_residual_percent"])
        self.assertEqual(len(shown["warnings"]), 1)

    def test_streams_quiet_and_verbose(self):
        path = self.write("a.fabric.toml", FABRIC)
        words = ["fabric", "import", path]
        self.assertIn("wrote b.toml", self.run_program(*words, "-o", "b.toml").stderr)
        self.assertEqual(self.run_program("-q", *words, "-o", "c.toml").stderr, "")
        verbose = self.run_program("-v", *words, "-o", "d.toml")
        self.assertIn("seed 0, threads all", verbose.stderr)
        self.assertIn("as a fabric file", verbose.stderr)
        imported = self.json_of(*words, "-o", "e.toml")
        self.assertEqual(imported["fabrics"][0]["numbers"]["bending.warp.B_gf_cm2_per_cm"], 0.06)
        self.assertEqual(imported["fabrics"][0]["file"], "e.toml")
        self.assertIn("paper_drape", [s["name"] for s in self.json_of("scenes")["scenes"]])
        # A warning is said also with -q.
        self.assertIn("warning: ", self.run_program("-q", "fabric", "show", "cupro-woven-su1098").stderr)

    def test_flags_over_environment_over_file_over_default(self):
        config = self.write("c.toml", "seed = 5\nthreads = 3\n")

        def stated(*words, **environment):
            return self.run_program("-v", *words, "scenes", environment=environment).stderr.strip()

        self.assertEqual(stated(), "seed 0, threads all")
        self.assertEqual(stated("--config", config), "seed 5, threads 3")
        self.assertEqual(stated("--config", config, FUAI_SEED="7"), "seed 7, threads 3")
        self.assertEqual(stated("--config", config, "--seed", "9", FUAI_SEED="7"), "seed 9, threads 3")
        self.assertEqual(stated("--config", config, FUAI_SEED=""), "seed 5, threads 3")
        self.assertEqual(stated(FUAI_THREADS="2"), "seed 0, threads 2")
        self.run_program("scenes", environment={"FUAI_SEED": "abc"}, expect=2)
        self.assertTrue(self.run_program("scenes", environment={"FUAI_JSON": "1"}).stdout.startswith("{"))

    def test_a_config_file_that_is_wrong_is_bad_input(self):
        self.refuse("--config", "none.toml", "scenes", says="none.toml")
        self.write("typo.toml", "sed = 5\n")
        self.refuse("--config", "typo.toml", "scenes", says="sed")


class Safety(Case):
    def test_values_need_a_unit_of_their_kind(self):
        for value in ["2", "2kg", "nan s", "inf s", "-1s", "s", "", "1e999s"]:
            words = ["render", "paper_drape", "-o", "a.png", "--time=" + value]
            if value:
                self.refuse(*words, expect=2, says="--time")
        path = self.write("a.fabric.toml", FABRIC)
        for value in ["16", "16 mg", "-16 mg/cm2", "nan mg/cm2", "0 mg/cm2"]:
            self.refuse("fabric", "import", path, "-o", "b.toml", "--mass=" + value, expect=2, says="--mass")
        for value in ["0.4", "0.4 kg", "-1mm"]:
            self.refuse("fabric", "import", path, "-o", "b.toml", "--thickness=" + value, expect=2,
                        says="--thickness")

    def test_names_that_do_not_exist(self):
        self.refuse("fabric", "show", "wool-tropica", says="did you mean wool-tropical?")
        self.refuse("fabric", "show", "./none.toml", says="./none.toml: the file does not exist")
        self.refuse("fabric", "show", "", says="fabric")
        self.refuse("render", "paper_drape", "--fabric", "none", "-o", "a.png", says="no bundled fabric")

    def test_a_crash_says_where_it_was(self):
        record = self.folder / "run.fuailog"
        words = [PROGRAM, "simulate", "hanging_sheet", "--fabric", "wool-tropical", "--seconds", "3600", "--record", record]
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as program:
            while not record.exists() and program.poll() is None:  # then it is in the middle of its hour
                time.sleep(0.01)
            program.send_signal(signal.SIGSEGV)
            said = program.communicate(timeout=60)[1]
        if "AddressSanitizer" in said:  # which tells it in its own way
            return
        self.assertEqual(program.returncode, -signal.SIGSEGV)
        self.assertTrue(said.startswith("fuai: the program broke down (SIGSEGV). "), said)
        self.assertIn(self.run_program("--version").stdout, said)
        # No further: the signal comes from outside, at times within a system call, past which nobody finds the caller.
        self.assertIn(f"{PROGRAM}(", said)

    def test_no_driver_is_exit_code_4(self):
        self.refuse("render", "paper_drape", "--time", "0s", "-o", "a.png", expect=4, environment=NO_DRIVER,
                    says="graphics driver")
        self.assertEqual(self.files(), [])

    def test_places_that_cannot_be_written_show_before_the_long_run(self):
        self.refuse("render", "paper_drape", "-o", "none/a.png", says="none/a.png")
        (self.folder / "b.png").mkdir()
        self.refuse("render", "paper_drape", "-o", "b.png", says="this is a directory")
        self.write("file", "x")
        self.run_program("paper", "--figure", "4", "--out", "file", expect=3)
        self.run_program("paper", "--figure", "4", "--out", "file/below", expect=3)
        self.run_program("paper", "--figure", "4", "--out", "/proc/fuai", expect=3)
        self.assertEqual(self.files(), ["file"])


class References(HTMLParser):
    """Collects what a page refers to."""

    def __init__(self):
        super().__init__()
        self.names = set()

    def handle_starttag(self, tag, attributes):
        for key, value in attributes:
            if key in ("src", "href") and value and not value.startswith(("#", "http", "data:")):
                self.names.add(value)


class Pictures(Case):
    PNG = b"\x89PNG\r\n\x1a\n"

    def test_render_makes_a_png_of_the_asked_size(self):
        words = ["render", "paper_drape", "--fabric", "wool-tropical", "--time", "0s", "--width", "96", "--height", "64"]
        result = self.json_of("--seed", "3", "--threads", "2", *words, "-o", "a.png")
        data = (self.folder / "a.png").read_bytes()
        self.assertEqual(data[:8], self.PNG)
        self.assertEqual(data[12:16], b"IHDR")
        self.assertEqual(struct.unpack(">II", data[16:24]), (96, 64))
        self.assertEqual(result["steps"], 0)
        self.assertEqual(result["fabric"], "wool-tropical")
        self.assertEqual(len(result["state_hash"]), 16)
        moved = self.json_of("render", "paper_drape", "--time", "1s", "--width", "96", "--height", "64", "-o", "b.png")
        self.assertEqual(moved["steps"], 10)  # ten updates a second, as the paper did
        self.assertNotEqual(moved["state_hash"], result["state_hash"])
        self.assertEqual(self.files(), ["a.png", "b.png"])

    def test_plot_of_measured_points_and_loops(self):
        self.run_program("fabric", "show", "wool-tropical", "--plot", "a.png")
        self.assertEqual((self.folder / "a.png").read_bytes()[:8], self.PNG)
        self.assertEqual(self.json_of("fabric", "show", "wool-tropical", "--plot", "a.svg")["plot"], "a.svg")
        self.assertIn("<svg", (self.folder / "a.svg").read_text())

    def test_paper_figure_1_is_a_complete_page(self):
        result = self.json_of("paper", "--figure", "1", "--out", "page/one")
        page = self.folder / "page/one"
        self.assertEqual(result["index"], "page/one/index.html")
        self.assertEqual(result["files"], len(self.files()))
        parser = References()
        parser.feed((page / "index.html").read_text(encoding="utf-8"))
        self.assertTrue(any(name.endswith(".png") for name in parser.names))
        for name in parser.names:
            self.assertTrue((page / name.split("#")[0]).is_file(), name)
        for picture in page.glob("*.png"):
            self.assertEqual(picture.read_bytes()[:8], self.PNG, picture.name)


if __name__ == "__main__":
    unittest.main(verbosity=1)
