"""What the two READMEs quote exists: each command line runs, and the code block is the example's file.

SPDX-License-Identifier: Apache-2.0
"""
import re
import shlex
import unittest

from program_tools import SOURCE, Case

READMES = ["README.md", "README.ja.md"]
# Commands whose literal run takes minutes; their options are checked against --help instead.
SLOW = [["paper"], ["render"], ["drape"], ["report"], ["fabric", "card"], ["batch"]]


def quoted_commands(name):
    """The `fuai ...` code spans of a README's tables, as lists of words."""
    rows = [line for line in (SOURCE / name).read_text(encoding="utf-8").splitlines() if line.startswith("|")]
    return [shlex.split(span) for row in rows for span in re.findall(r"`fuai ([^`]+)`", row)]


class Commands(Case):
    def test_every_quoted_command_line_works(self):
        (self.folder / "data").symlink_to(SOURCE / "data")  # quoted from the top of the tree
        tried = []
        for readme in READMES:
            commands = quoted_commands(readme)
            self.assertGreaterEqual(len(commands), 6, readme)
            for words in commands:
                if words in tried:
                    continue  # the other language quotes it too
                tried.append(words)
                slow = next((s for s in SLOW if words[:len(s)] == s), None)
                if slow:
                    self.check_slow(slow, words)
                else:
                    self.run_program("-q", *words)

    def check_slow(self, command, words):
        """The command knows every option that is quoted; a picture is made of the scene's first moment, a drape of
        a coarse lattice; of a batch the list."""
        known = self.run_program(*command, "--help").stdout
        for word in words:
            if word.startswith("-"):
                self.assertRegex(known, rf"(?m)^ +(-\w,)?{re.escape(word)}[ ,]")
        if command == ["drape"] or command == ["fabric", "card"]:
            self.run_program("-q", *words, "--spacing", "1.5cm", "--runs", "1")
        if command == ["report"]:
            self.run_program("-q", *words, "--spacing", "1.5cm", "--runs", "1", "--no-kes")
        if command == ["batch"]:
            self.run_program("-q", *words, "--list")
        if words[0] == "render":
            self.run_program("-q", *words, "--time", "0s", "--width", "64", "--height", "48")

    def test_both_readmes_quote_the_same_commands(self):
        self.assertEqual(quoted_commands(READMES[0]), quoted_commands(READMES[1]))


class Code(Case):
    def test_the_code_block_is_the_example(self):
        block = (SOURCE / "README.md").read_text(encoding="utf-8").split("```cpp\n")[1].split("```")[0]
        example = (SOURCE / "examples/bend_and_unbend.cpp").read_text(encoding="utf-8")
        head, _, code = example.partition("#include")
        self.assertTrue(all(line.startswith("//") for line in head.splitlines()), "only comments stand above")
        self.assertEqual("#include" + code, block)


if __name__ == "__main__":
    unittest.main(verbosity=1)
