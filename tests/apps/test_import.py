"""Measurements in: what `fuai fabric import` and `fuai fabric show` make of good and of bad files.

SPDX-License-Identifier: Apache-2.0
"""
import os
import resource
import unittest

from program_tools import BENDING, FABRIC, SHEET, SOURCE, Case, as_nobody

MASS = ["--mass", "16 mg/cm2"]
DISAGREES = "disagrees with LT·Fm·EMT/2"
IDS = ["cotton-knit-shirley", "cupro-woven-su1098"]


class Golden(Case):
    def test_u3m_gives_the_bundled_fabric_byte_for_byte(self):
        for fabric in IDS:
            self.run_program("-q", "fabric", "import", SOURCE / f"data/u3m/{fabric}.physics.json", "-o",
                             fabric + ".fabric.toml")
        bundled = {p.name: p for p in (SOURCE / "data/fabrics").iterdir() if p.name.startswith(tuple(IDS))}
        self.assertEqual(self.files(), sorted(bundled))
        for name, path in bundled.items():
            self.assertEqual((self.folder / name).read_bytes(), path.read_bytes(), name)


class Unit(Case):
    def test_curve_file_round_trip(self):
        self.write("in.csv", BENDING)
        imported = self.json_of("fabric", "import", "in.csv", *MASS, "--name", "毛", "-o", "wool.fabric.toml")
        self.assertEqual(self.files(), ["in.csv", "wool.bending.warp.csv", "wool.fabric.toml"])
        self.assertEqual((self.folder / "wool.bending.warp.csv").read_text(), BENDING)
        self.assertEqual(imported["fabrics"][0]["laws"]["bending.warp"]["origin"], "measured loop")
        shown = self.json_of("fabric", "show", "./wool.fabric.toml")
        self.assertEqual((shown["id"], shown["name"]), ("wool", "毛"))
        # B is the slope between 0.5 and 1.5 1/cm: the loading samples lie on a line of slope 0.07.
        self.assertAlmostEqual(shown["numbers"]["bending.warp.B_gf_cm2_per_cm"]["B_gf_cm2_per_cm"], 0.07, places=9)
        self.assertAlmostEqual(shown["numbers"]["weight.W_mg_per_cm2"]["W_mg_per_cm2"], 16, places=12)
        self.assertEqual(shown["laws"]["bending.warp"], imported["fabrics"][0]["laws"]["bending.warp"])

    def test_other_spellings_of_the_same_curve(self):
        body = BENDING.splitlines()[2:]
        decimal_commas = "\n".join(";".join(cell.replace(".", ",") for cell in row.split(",")) for row in body)
        text = "\ufeff曲率 (1/cm);曲げモーメント [gf·cm/cm];branch\r\n" + decimal_commas.replace("\n", "\r\n") + "\r\n"
        self.write("in.csv", text)
        self.run_program("fabric", "import", "in.csv", *MASS, "--test", "bending", "--direction", "warp", "-o",
                         "a.fabric.toml")
        self.assertEqual((self.folder / "a.bending.warp.csv").read_text(), BENDING)

    def test_a_sheet_fills_a_folder(self):
        self.write("sheet.csv", SHEET + "A,18,0.07,0.06,0.03,0.02\n")
        listed = self.json_of("fabric", "import", "sheet.csv", "-o", "out/")["fabrics"]
        self.assertEqual([f["file"] for f in listed],
                         ["out/a.fabric.toml", "out/b.fabric.toml", "out/a-2.fabric.toml"])
        masses = [self.json_of("fabric", "show", f["file"])["numbers"]["weight.W_mg_per_cm2"]["W_mg_per_cm2"]
                  for f in listed]
        for mass, expected in zip(masses, [16, 20, 18]):
            self.assertAlmostEqual(mass, expected, places=12)

    def test_a_japanese_sheet_in_cp932(self):
        text = "試料名\t曲げ剛性（たて）\t曲げ剛性（よこ）\t２ＨＢ（たて）\t重さ(g/m2)\r\n毛\t0.06\t0.05\t0.03\t160\r\n"
        self.write("sheet.txt", text.encode("cp932"))
        numbers = self.json_of("fabric", "import", "sheet.txt", "-o", "wool.fabric.toml")["fabrics"][0]["numbers"]
        self.assertEqual(numbers["bending.warp.B_gf_cm2_per_cm"], 0.06)
        self.assertEqual(numbers["bending.weft.B_gf_cm2_per_cm"], 0.05)
        self.assertAlmostEqual(numbers["weight.W_mg_per_cm2"], 16, places=12)
        self.assertEqual(self.json_of("fabric", "show", "wool.fabric.toml")["name"], "毛")

    def test_odd_numbers_warn_and_go_on(self):
        swapped = BENDING.replace("unload", "x").replace(",load", ",unload").replace("x", "load")
        self.write("swapped.csv", swapped)
        done = self.run_program("fabric", "import", "swapped.csv", *MASS, "-o", "s.fabric.toml")
        self.assertIn("check whether load and unload are swapped", done.stderr)
        self.write("b.fabric.toml", FABRIC.replace("0.06", "1000"))
        shown = self.json_of("fabric", "show", "b.fabric.toml")
        self.assertIn("b.fabric.toml:9:19: bending.warp.B_gf_cm2_per_cm: 1000 gf·cm²/cm is outside the range",
                      "\n".join(shown["warnings"]))
        tension = "[tensile.warp]\nLT = 0.6\nWT_gf_cm_per_cm2 = 30\nEMT_percent = 5\n"
        self.write("w.fabric.toml", FABRIC + tension)
        warnings = "\n".join(self.json_of("fabric", "show", "w.fabric.toml")["warnings"])
        self.assertIn(DISAGREES, warnings)
        self.write("ok.fabric.toml", FABRIC + tension.replace("30", "7.5"))  # 0.6 x 500 gf/cm x 5 % / 2
        self.assertNotIn(DISAGREES, "\n".join(self.json_of("fabric", "show", "ok.fabric.toml")["warnings"]))


class Safety(Case):
    def refuse_file(self, name, content, says, *words):
        path = self.write(name, content)
        done = self.refuse("fabric", "import", path, *words, "-o", "out.fabric.toml", says=says)
        self.assertIn(name, done.stderr, "the message names the file")

    def test_curves_that_cannot_be(self):
        for text, says in [
            (BENDING.replace("0.75,0.0625", "0.75,nan"), "c.csv:4:6: moment_gf_cm_per_cm: 'nan' is not a finite number"),
            (BENDING.replace("0.75,", "inf,"), "c.csv:4:1: curvature_per_cm"),
            (BENDING.replace("0.75,", "1e308,"), "c.csv:4:1: curvature_per_cm: the value is too large"),
            (BENDING.replace(",0.", ",-0."), "negative stiffness"),
            (BENDING.replace("2.5,0.17,", "2.5,0.30,").replace("2,0.135", "2,0.28").replace("1,0.06", "1,0.2"),
             "cross"),
            (BENDING[:-3], "c.csv:11:9: branch: 'unlo' is no branch"),
            (BENDING.replace("curvature_per_cm", "curvature"), "states no unit"),
            ("", "the file is empty"),
            ("# fuai-curve/1 test=bending direction=warp\n", "c.csv"),
        ]:
            self.refuse_file("c.csv", text, says, *MASS)
        self.write("c.csv", BENDING)
        self.refuse("fabric", "import", "c.csv", "-o", "out.toml", expect=2, says="add --mass")
        self.refuse("fabric", "import", "c.csv", *MASS, "--direction", "weft", "-o", "out.toml", says="weft")
        self.refuse("fabric", "import", "c.csv", *MASS, "--test", "bendin", "-o", "out.toml", expect=2,
                    says="use bending")

    def test_sheets_that_cannot_be(self):
        for text, says in [
            (SHEET.replace("0.09", "nan"), "s.csv:3:6: B1: 'nan' is not a finite number"),
            (SHEET.replace("0.09", "-0.09"), "is negative"),
            (SHEET.replace("0.09", "1e999"), "s.csv:3"),
            (SHEET.replace("20", ""), "'B' has no areal mass"),
            (SHEET.replace("B1", "B1 [g/m2]"), "does not measure B"),
            ("a,b\n1,2\n", "no header names a KES quantity"),
            ("name,W [mg/cm2],T [mm]\nA,16,0.4\n", "has no bending measurement"),
        ]:
            path = self.write("s.csv", text)
            self.assertIn("s.csv", self.refuse("fabric", "import", path, "-o", "out/", says=says).stderr)
        self.write("s.csv", SHEET)
        self.refuse("fabric", "import", "s.csv", "-o", "out.toml", expect=2, says="the sheet holds 2 fabrics")
        self.assertFalse((self.folder / "out").exists(), "a folder is made only when there is something to put in")

    def test_fabric_files_that_cannot_be(self):
        for text, says in [
            (FABRIC.replace("0.06", "nan"), "f.toml:9:19: bending.warp.B_gf_cm2_per_cm: the value is not finite"),
            (FABRIC.replace("0.06", "inf"), "the value is not finite"),
            (FABRIC.replace("0.06", "-0.06"), "is negative"),
            (FABRIC.replace("B_gf_cm2_per_cm", "B_gf_cm_per_cm"), "unknown key"),
            (FABRIC[:-8], "f.toml:10"),
            (FABRIC.replace("fuai-fabric/1", "fuai-fabric/9"), "fuai-fabric/1"),
            (FABRIC.split("[bending")[0], "has no bending measurement"),
            (FABRIC + 'curve = "none.csv"\n', "does not exist"),
            (FABRIC + 'curve = "../../etc/passwd"\n', "no file beside or below"),
            ("", "the file is empty"),
            (b"\x00\x01\x02", "binary file"),
            ("format".encode("utf-16"), "UTF-16"),
            (b"\x7fELF\x02\x01\x01" + bytes(64), "binary file"),
        ]:
            path = self.write("f.toml", text)
            self.refuse("fabric", "show", path, says=says)
            self.refuse("fabric", "import", path, "-o", "out.fabric.toml", says=says)

    def test_physics_files_that_cannot_be(self):
        good = (SOURCE / "data/u3m/cupro-woven-su1098.physics.json").read_text()
        self.refuse_file("p.json", good[:5000], "broken or cut off here")
        self.refuse_file("p.json", "{}", "")
        self.refuse_file("p.json", "[" * 100000, "nested deeper")
        self.refuse_file("p.json", '{"raw_data": {"M": NaN}}', "broken")

    def test_things_that_are_no_measurement_file(self):
        (self.folder / "folder.toml").mkdir()
        huge = self.folder / "huge.csv"
        with open(huge, "wb") as file:
            file.truncate(2 * 1024**3)  # sparse: takes no disk
        os.mkfifo(self.folder / "pipe.toml")
        for name, says in [
            ("folder.toml", "this is a directory"),
            ("huge.csv", "the file has 2147483648 bytes, more than the limit"),
            ("none.csv", "the file does not exist"),
            ("pipe.toml", "not a regular file"),
            ("/dev/zero", "not a regular file"),
        ]:
            done = self.refuse("fabric", "import", name, "-o", "out.fabric.toml", says=says)
            self.assertIn(name, done.stderr)
            if name.endswith(".toml"):
                self.refuse("fabric", "show", "./" + name, says=says)
        os.rename(huge, self.folder / "huge.toml")
        self.refuse("fabric", "show", "huge.toml", says="more than the limit")

    def test_a_file_without_permission(self):
        options = as_nobody()
        if options is None:
            self.skipTest("the program cannot be run without root's power here")
        os.chmod(self.folder, 0o755)
        path = self.write("f.toml", FABRIC)
        path.chmod(0)
        self.refuse("fabric", "show", path, says="cannot be opened", **options)
        path.chmod(0o644)
        os.chmod(self.folder, 0o555)
        self.refuse("fabric", "import", path, "-o", "out.toml", says="cannot write into the folder", **options)
        self.refuse("fabric", "import", path, "-o", "new/", says="cannot make the folder", **options)
        self.refuse("render", "paper_drape", "-o", "a.png", says="cannot write into the folder", **options)
        os.chmod(self.folder, 0o755)

    def test_outputs_that_cannot_be(self):
        path = self.write("f.fabric.toml", FABRIC)
        for output, says in [("none/out.toml", "does not exist"), ("/proc/out.toml", "cannot write into the folder"),
                             ("/dev/null", "not a regular file"), ("x" * 300 + ".toml", "cannot write"),
                             ("/proc/fuai/", "cannot make the folder"), ("f.fabric.toml/", "folder")]:
            done = self.run_program("-q", "--json", "fabric", "import", path, "-o", output, expect=3)
            self.assertIn(says, done.stderr)
            self.assertEqual(done.stdout, "")
            self.assertEqual(self.files(), ["f.fabric.toml"])

    def test_measurements_are_never_replaced(self):
        self.write("wool.bending.warp.csv", BENDING)
        self.refuse("fabric", "import", "wool.bending.warp.csv", *MASS, "-o", "wool.fabric.toml", expect=2,
                    says="would replace the input file 'wool.bending.warp.csv'")
        self.refuse("fabric", "import", "wool.bending.warp.csv", *MASS, "-o", "./wool.bending.warp.csv", expect=2,
                    says="would replace the input file")

    def test_a_full_disk_leaves_everything_as_it_was(self):
        # The limit stands between the sizes of the curve files: some can be written, one cannot.
        source = SOURCE / "data/u3m/cupro-woven-su1098.physics.json"
        sizes = sorted(p.stat().st_size for p in (SOURCE / "data/fabrics").glob("cupro*.csv"))
        self.assertLess(sizes[0], sizes[-1])
        self.write("out.fabric.toml", "old")

        def small_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (sizes[0], sizes[0]))

        # Python ignores the signal of the limit and, so told, leaves it so for the program.
        done = self.run_program("-q", "--json", "fabric", "import", source, "-o", "out.fabric.toml", expect=3,
                                preexec_fn=small_files, restore_signals=False)
        self.assertIn("cannot write", done.stderr)
        self.assertEqual(self.files(), ["out.fabric.toml"])
        self.assertEqual((self.folder / "out.fabric.toml").read_text(), "old")


if __name__ == "__main__":
    unittest.main(verbosity=1)
