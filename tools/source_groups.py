"""Groups source files that can be read as one: no two of a group name something alike for themselves.

Usage: source_groups.py MOST FILE...   prints "<group>;<file>" lines, groups of at most MOST files, for unity builds
(cmake/FuaiTargets.cmake). tidy_groups.py takes the functions.

SPDX-License-Identifier: Apache-2.0
"""
import pathlib
import re
import sys

OWN = re.compile(r"^namespace \{\n(.*?)^\}  // namespace$", re.M | re.S)
CONSTANTS = re.compile(r"\b(k[A-Z]\w*)\s*[={\[]")
TYPES = re.compile(r"^(?:class|struct|enum class|enum|using|union) (\w+)", re.M)
FUNCTIONS = re.compile(
    r"^(?!class|struct|enum|using|namespace|template|return)[A-Za-z_][\w:<>&*,\[\] ]*[ &*](\w+)\(", re.M)


def own_names(path):
    """What a file declares for itself, at the left margin of its unnamed namespaces."""
    text = "\n".join(OWN.findall(path.read_text(encoding="utf-8")))
    return set(CONSTANTS.findall(text) + TYPES.findall(text) + FUNCTIONS.findall(text))


SHARED_CONSTANTS = re.compile(r"^(?:inline |static |extern )*const(?:expr)? .*?\b(k[A-Z]\w*)\s*[={\[]", re.M)
INCLUDES = re.compile(r'^#include "([^"]+)"', re.M)


class Headers:
    """What the project's headers declare for everybody, at the left margin: types and constants."""

    def __init__(self, *folders):
        self.folders = folders
        self.seen = {}

    def of(self, path):
        """Names that a file gets from the headers that it includes, and they include."""
        names, todo, found = set(), [path], set()
        while todo:
            for header in self.included(todo.pop()) - found:
                found.add(header)
                todo.append(header)
                self.included(header)
                names |= self.seen[header][1]
        return names

    def included(self, path):
        """Headers of the project that a file names, each read once."""
        if path not in self.seen:
            text = path.read_text(encoding="utf-8")
            places = [folder / name for name in INCLUDES.findall(text) for folder in (path.parent, *self.folders)]
            self.seen[path] = ({place for place in places if place.exists()},
                               set(SHARED_CONSTANTS.findall(text) + TYPES.findall(text)))
        return self.seen[path][0]


# The body of a private class, whose members may have types of the unnamed namespace in a file of its own only.
PRIVATE_BODY = re.compile(r"^(?:struct|class) \w+::\w+", re.M)


def stands_alone(path):
    """Kernels include themselves once an instruction set; what hides a name may not meet what shows it."""
    text = path.read_text(encoding="utf-8")
    return ("foreach_target.h" in text or "IMPLEMENT_WITH_MAIN" in text or "\nusing enum" in text
            or bool(PRIVATE_BODY.search(text)))


class Group:
    def __init__(self):
        self.files, self.own, self.seen = [], set(), set()
        self.closed = False

    def takes(self, own, seen, most):
        return (len(self.files) < most and not self.closed and not own & (self.own | self.seen)
                and not self.own & seen)


def grouped(files, most, headers):
    """Each file goes into the first group where no file's own names are anybody else's, or in a header of theirs."""
    groups = []
    for file in files:
        own, seen = own_names(file), headers.of(file)
        alone = stands_alone(file) or bool(own & seen)
        group = None if alone else next((g for g in groups if g.takes(own, seen, most)), None)
        if group is None:
            group = Group()
            groups.append(group)
        group.files.append(file)
        group.own |= own
        group.seen |= seen
        group.closed = alone
    return [group.files for group in groups]


if __name__ == "__main__":
    top = pathlib.Path(__file__).resolve().parent.parent
    files = [pathlib.Path(name) for name in sys.argv[2:]]
    lines = []
    for number, group in enumerate(grouped(files, int(sys.argv[1]), Headers(top / "src", top / "tests"))):
        if len(group) > 1:
            lines += [f"{number};{file}" for file in group]
    print("\n".join(lines))
