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


def public_names(folder):
    """Types and constants of all headers: with its own of that name a file reads only what it includes itself."""
    texts = [path.read_text(encoding="utf-8") for path in sorted(folder.rglob("*.h"))]
    return {name for text in texts for name in CONSTANTS.findall(text) + TYPES.findall(text)}


# The body of a private class, whose members may have types of the unnamed namespace in a file of its own only.
PRIVATE_BODY = re.compile(r"^(?:struct|class) \w+::\w+", re.M)


def stands_alone(path):
    """Kernels include themselves once an instruction set; what hides a name may not meet what shows it."""
    text = path.read_text(encoding="utf-8")
    return "foreach_target.h" in text or "IMPLEMENT_WITH_MAIN" in text or bool(PRIVATE_BODY.search(text))


def grouped(files, most):
    """Each file goes into the first group that knows none of its names."""
    groups = []
    for file in files:
        names = own_names(file)
        group = None
        if not stands_alone(file):
            group = next((g for g in groups if len(g[0]) < most and not g[2] and not g[1] & names), None)
        if group is None:
            group = ([], set(), stands_alone(file))
            groups.append(group)
        group[0].append(file)
        group[1].update(names)
    return [files for files, _, _ in groups]


if __name__ == "__main__":
    # The names of all headers count as everybody's: a file that has one of its own stands alone.
    top = pathlib.Path(__file__).resolve().parent.parent / "src"
    public = public_names(top)
    files = [pathlib.Path(name) for name in sys.argv[2:]]
    together = [f for f in files if not own_names(f) & public and not stands_alone(f)]
    lines = []
    for number, group in enumerate(grouped(together, int(sys.argv[1]))):
        lines += [f"{number};{file}" for file in group]
    print("\n".join(lines))
