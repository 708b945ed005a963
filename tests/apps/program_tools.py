"""What the tests of the built program share: running it, and files to give it.

SPDX-License-Identifier: Apache-2.0
"""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

PROGRAM = pathlib.Path(os.environ.get("FUAI_PROGRAM", "build/ci/bin/fuai")).resolve()
SOURCE = pathlib.Path(__file__).resolve().parents[2]
NOBODY = 65534

BENDING = """# fuai-curve/1 test=bending direction=warp
curvature_per_cm,moment_gf_cm_per_cm,branch
0,0.01,load
0.75,0.0625,load
1.25,0.0975,load
2,0.15,load
2.5,0.185,load
2.5,0.17,unload
2,0.135,unload
1,0.06,unload
0,-0.01,unload
"""
SHEET = "name,W [mg/cm2],B1,B2,2HB1,2HB2\nA,16,0.06,0.05,0.03,0.02\nB,20,0.09,0.08,0.04,0.03\n"
FABRIC = """format = "fuai-fabric/1"
name = "Cloth"
[weight]
W_mg_per_cm2 = 16
[provenance]
"weight" = { kind = "measured", source = "made up" }
"bending" = { kind = "measured", source = "made up" }
[bending.warp]
B_gf_cm2_per_cm = 0.06
2HB_gf_cm_per_cm = 0.03
"""


class Case(unittest.TestCase):
    """Each test runs in an empty folder of its own."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def files(self):
        """All files below the folder, hidden ones too."""
        return sorted(str(p.relative_to(self.folder)) for p in self.folder.rglob("*") if not p.is_dir())

    def run_program(self, *words, expect=0, environment=None, **options):
        """Runs the program in the folder and checks its exit code and that it speaks UTF-8."""
        surroundings = {k: v for k, v in os.environ.items() if not k.startswith("FUAI_")}
        surroundings.update(environment or {})
        done = subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, env=surroundings, text=True,
                              encoding="utf-8", capture_output=True, stdin=subprocess.DEVNULL, timeout=300,
                              **options)
        self.assertEqual(done.returncode, expect, f"fuai {words}\n{done.stdout}\n{done.stderr}")
        return done

    def refuse(self, *words, expect=3, says="", **options):
        """Runs the program on wrong input: exit code, message on standard error, nothing printed, nothing
        written and nothing changed."""
        before = {name: self.identity(name) for name in self.files()}
        done = self.run_program(*words, expect=expect, **options)
        self.assertIn(says, done.stderr)
        self.assertTrue(done.stderr.startswith(("fuai: ", "warning: ")), done.stderr)
        self.assertNotIn("internal error", done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertEqual({name: self.identity(name) for name in self.files()}, before)
        return done

    def identity(self, name):
        info = (self.folder / name).stat()
        return info.st_ino, info.st_size, info.st_mtime_ns

    def json_of(self, *words, **options):
        """The one JSON object that the command prints; NaN and infinities are no JSON."""
        done = self.run_program("--json", *words, **options)
        self.assertEqual(done.stdout.count("\n"), 1, "one line, nothing else")

        def refuse_constant(name):
            raise AssertionError(f"{name} is no JSON")

        value = json.loads(done.stdout, parse_constant=refuse_constant)
        self.assertIsInstance(value, dict)
        return value


def as_nobody():
    """Options of subprocess.run() that take root's power away; None where that is impossible."""
    if os.geteuid() != 0:
        return {}
    probe = subprocess.run([PROGRAM, "--version"], user=NOBODY, group=NOBODY, extra_groups=[], cwd="/",
                           capture_output=True) if _reachable() else None
    return {"user": NOBODY, "group": NOBODY, "extra_groups": []} if probe and probe.returncode == 0 else None


def _reachable():
    return all(folder.stat().st_mode & 0o001 for folder in PROGRAM.parents)
