"""Writes units that read many source files at once, for tidy.sh: no two files of a unit name something alike.

Usage: tidy_groups.py FOLDER FILE...   with FOLDER/compile_commands.json; makes FOLDER/unit*/unit.cpp and a database
beside each, one command with the include paths and definitions of all files. Prints using declarations that nothing
uses and fails when there are any.

SPDX-License-Identifier: Apache-2.0
"""
import json
import pathlib
import re
import shlex
import sys

from source_groups import Headers, grouped

MOST = 24  # files of a unit: more pay little, and a unit is what one core works on


def unused_usings(path):
    """clang-tidy sees them in the main file of a unit only."""
    text = path.read_text(encoding="utf-8")
    for match in re.finditer(r"^ *using (?:[\w:]+::)(\w+);", text, re.M):
        if len(re.findall(rf"\b{match[1]}\b", text)) == 1:
            line = text.count("\n", 0, match.start()) + 1
            print(f"{path}:{line}: error: using declaration '{match[1]}' is unused")
            yield line


def common_command(entries):
    """The words of one command, and of the others what they include and define."""
    words = shlex.split(entries[0]["command"])
    words = words[:words.index("-c")]
    if "-o" in words:
        del words[words.index("-o"):words.index("-o") + 2]
    for entry in entries[1:]:
        other = shlex.split(entry["command"])
        for i, word in enumerate(other):
            if word.startswith(("-I", "-D")) and word not in words:
                words.append(word)
            if word == "-isystem" and other[i + 1] not in words:
                words += [word, other[i + 1]]
    return words


def main():
    folder = pathlib.Path(sys.argv[1])
    files = [pathlib.Path(name) for name in sys.argv[2:]]
    entries = {e["file"]: e for e in json.loads((folder / "compile_commands.json").read_text())}
    built = [f for f in files if str(f) in entries]
    words = common_command([entries[str(f)] for f in built])
    # What this configuration does not build stands in for files that it does.
    alone = [f for f in files if str(f) not in entries]
    headers = Headers(pathlib.Path(__file__).resolve().parents[1] / "src")
    groups = grouped([f for f in files if f not in alone], MOST, headers) + [[f] for f in alone]
    for number, group in enumerate(groups):
        place = folder / f"unit{number:03}"
        place.mkdir()
        unit = place / "unit.cpp"
        unit.write_text("".join(f'#include "{file}"  // NOLINT(bugprone-suspicious-include)\n' for file in group))
        (place / "files").write_text("".join(f"{file}\n" for file in group))
        entry = {"directory": entries[str(built[0])]["directory"], "file": str(unit),
                 "command": shlex.join(words + ["-c", str(unit)])}
        (place / "compile_commands.json").write_text(json.dumps([entry]))
    return 1 if any([list(unused_usings(f)) for f in files]) else 0


if __name__ == "__main__":
    sys.exit(main())
