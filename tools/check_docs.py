#!/usr/bin/env python3
"""Checks that the documents point at things that exist. Prints each problem; exit code 1 if there is one.

  links        [text](target): a relative target is a file or folder, its #anchor a heading there
  paths        `src/fuai/LAYERS.md`: a code span with a slash and a known suffix names a file (* may stand in it)
  functions    `name()` in any document, and every bare `name` in a table of docs/paper-map.md, is in the sources
  test cases   "name" in a table of docs/paper-map.md is the name of a TEST_CASE
  commands     `fuai word --option` in a table of docs/paper-map.md: the program knows each word
"""
import functools
import pathlib
import re
import sys

SUFFIXES = (".h", ".cpp", ".py", ".sh", ".md", ".txt", ".toml", ".csv", ".json", ".cmake", ".in", ".png", ".svg", ".html")
MADE_BY_RUNNING = ("build/", "out/")  # folders that the repository does not hold
SKIPPED_FOLDERS = {"build", "out", ".git", "node_modules"}
MAP = pathlib.PurePath("docs/paper-map.md")

top = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
problems = []


def files_below(folder, *suffixes):
    for path in sorted((top / folder).rglob("*")):
        inside = path.relative_to(top).parts
        if path.is_file() and path.suffix in suffixes and not SKIPPED_FOLDERS.intersection(inside):
            yield path


@functools.cache
def source_words():
    """Every identifier of the sources."""
    words = set()
    for folder in ("src", "apps", "tests", "bench", "fuzz"):
        for path in files_below(folder, ".h", ".cpp"):
            words.update(re.findall(r"\w+", path.read_text()))
    return words


@functools.cache
def test_cases():
    names = set()
    for path in files_below("tests", ".cpp"):
        for literals in re.findall(r'TEST_CASE\(\s*((?:"(?:[^"\\]|\\.)*"\s*)+)', path.read_text()):
            names.add("".join(re.findall(r'"((?:[^"\\]|\\.)*)"', literals)))  # C++ joins neighbours
    return names


@functools.cache
def command_words():
    """Commands and options that the program's parser is told."""
    words = set()
    for path in files_below("apps", ".cpp"):
        for text in re.findall(r'\.(?:command|group|option|flag)\(\s*"([^"]+)"', path.read_text()):
            words.update(text.split(","))
    return words


@functools.cache
def anchors(path):
    """The anchors of a document's headings, as GitHub makes them."""
    headings = re.findall(r"^#+ +(.*)$", without_fences(path.read_text()), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", h.strip().lower()).replace(" ", "-") for h in headings}


def without_fences(text):
    """The text with the lines of fenced blocks emptied, so that line numbers stay."""
    lines, fenced = [], False
    for line in text.split("\n"):
        fence = line.lstrip().startswith("```")
        lines.append("" if fence or fenced else line)
        fenced ^= fence
    return "\n".join(lines)


def check_link(document, target):
    if re.match(r"[a-z]+:", target):
        return None
    name, _, anchor = target.partition("#")
    path = (document.parent / name).resolve() if name else document
    if not path.exists():
        return f"the link leads nowhere: {target}"
    if anchor and path.suffix == ".md" and anchor not in anchors(path):
        return f"the link's heading does not exist: {target}"
    return None


def check_path(document, word):
    """A path counts from the top, from src/fuai (as includes do), or from beside the document."""
    if "/" not in word or not word.endswith(SUFFIXES + (".*",)) or word.startswith(("/", "~") + MADE_BY_RUNNING):
        return None
    if not re.fullmatch(r"[\w./*-]+", word):
        return None
    for base in (top, top / "src", top / "src" / "fuai", document.parent):
        if any(base.glob(word)) if "*" in word else (base / word).exists():
            return None
    return f"the file does not exist: {word}"


def check_function(span):
    if re.fullmatch(r"[\w:]+(\(\))?", span) and span.removesuffix("()").split("::")[-1] not in source_words():
        return f"the sources do not know: {span}"
    return None


def check_command(span):
    for word in span.split()[1:]:
        if (word.startswith("-") or word.islower()) and word not in command_words() and "/" not in word:
            return f"the program does not know '{word}': {span}"
    return None


def check_span(document, span, in_map_table):
    for word in span.split():
        if problem := check_path(document, word):
            return problem
    if in_map_table and span.startswith("fuai "):
        return check_command(span)
    if span.endswith("()") or in_map_table:
        return check_function(span)
    return None


def check_line(document, line):
    in_map_table = document.relative_to(top) == MAP and line.startswith("|")
    yield from (check_link(document, target) for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line)))
    yield from (check_span(document, span, in_map_table) for span in re.findall(r"`([^`]+)`", line))
    if in_map_table:
        for name in re.findall(r'"([^"]+)"', re.sub(r"`[^`]*`", "", line)):
            yield None if name in test_cases() else f'there is no test case "{name}"'


count = 0
for document in files_below(".", ".md"):
    count += 1
    for number, line in enumerate(without_fences(document.read_text()).split("\n"), 1):
        where = f"{document.relative_to(top)}:{number}"
        problems += [f"{where}: {problem}" for problem in check_line(document, line) if problem]

print("\n".join(problems) if problems else f"{count} documents point at things that exist")
sys.exit(1 if problems else 0)
