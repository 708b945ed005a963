"""Every sentence of an error that a person can meet in the window stands in the table of src/fuai/window/error_sentences.cpp,
and every sentence of that table is one that the sources say.

    python3 tests/window/test_error_texts.py SOURCES

What is looked for are the texts between quotes within calls of Error(), of the helpers that throw one, within
functions that make a problem or a cure, and constants of cures.

SPDX-License-Identifier: Apache-2.0
"""
import pathlib
import re
import sys
import tempfile
import unittest

SOURCES = pathlib.Path(sys.argv.pop()) if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2] / "src/fuai"
TABLE = "window/error_sentences.cpp"

# What the window calls: whole layers, and what it takes of the others.
LOOKED_AT = ("units", "fabric", "io", "viewer", "window", "device", "scenes/catalogue.cpp", "scenes/engine_scene.cpp",
             "scenes/scene_sheet.cpp", "scenes/drape_specimen.cpp", "picture/image.cpp", "picture/image_png.cpp",
             "runtime/frame_pipe.cpp")
TERMINAL = "told in the terminal, before there is a window"
NOT_SHOWN = {  # files whose errors no window shows
    "io/batch_manifest.cpp": "of `fuai batch`",
    "io/folder_lock.cpp": "of `fuai batch`",
    "io/session_log_read.cpp": "of `fuai haptics`",
    "io/session_log_write.cpp": "of `fuai haptics`",
    "device/device_simulated.cpp": "of numbers that are the program's own",
    "device/device_presets.cpp": TERMINAL,
    "device/hand_model.cpp": TERMINAL,
    "window/kept_settings.cpp": TERMINAL,
    "window/viewer_host.cpp": TERMINAL,
    "window/without_window.cpp": "there is no window",
}
OPTIONS = {  # of parse_value(), which reads options in the terminal
    "no finite number", "write a number with its unit, e.g. 18cm", "the unit is missing",
    "write it behind the number, e.g. 18cm, 20gf, 1ms", "the unit has the wrong dimension",
    "check what the option measures", " in '"}
FOREIGN = {"Error while parsing *"}  # said by toml++; tests/window/test_error_text.cpp has it say so

TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?P<raw>.*?)\)"|"(?P<text>(?:\\.|[^"\\\n])*)"|\'(?:\\.|[^\'\\])+\'', re.S)
ESCAPES = {"n": "\n", "t": "\t", "0": "\0"}
HELPER = re.compile(r"(?:\bauto\s+(?P<lambda>\w+)\s*=\s*\[[^\]]*\]|\b(?P<function>\w+))\s*\((?P<parameters>[^()]*)\)"
                    r"(?:\s*(?:const|noexcept|->\s*\w+))*\s*\{")
WORDS = re.compile(r"[^\W\d_]{2,}")


def unescape(text):
    return re.sub(r"\\(x[0-9a-fA-F]{2}|.)", lambda m: ESCAPES.get(m[1], m[1] if len(m[1]) == 1 else "\ufffd"), text)


class Source:
    """A file without comments; its texts are numbers between quotes, so that brackets in them do not count."""

    def __init__(self, path):
        self.texts = []
        self.code = TOKEN.sub(self.keep, path.read_text(encoding="utf-8"))
        self.code = re.sub(r'"(\d+)"(?:\s*"\d+")+', self.join, self.code)

    def keep(self, match):
        raw, text = match.group("raw"), match.group("text")
        if raw is None and text is None:
            return " " if match[0].startswith("/") else "0"
        self.texts.append(raw if raw is not None else unescape(text))
        return f'"{len(self.texts) - 1}"'

    def join(self, match):
        self.texts.append("".join(self.texts_in(match[0])))
        return f'"{len(self.texts) - 1}"'

    def texts_in(self, code):
        return [self.texts[int(number)] for number in re.findall(r'"(\d+)"', code)]

    def closed(self, start):
        """What stands within the bracket that opens at a place."""
        depth = 0
        for at in range(start, len(self.code)):
            depth += (self.code[at] in "([{") - (self.code[at] in ")]}")
            if depth == 0:
                return self.code[start + 1:at]
        raise AssertionError("a bracket is open")

    def calls(self, name):
        return [(match.start(), self.closed(match.end() - 1))
                for match in re.finditer(rf"\b{name}\s*[({{]", self.code)]

    def helpers(self):
        """Functions and lambdas that throw an Error of what they are told, and of what those are told."""
        names, known = {"Error"}, set()
        while names != known:
            known = set(names)
            for name in known:
                for start, arguments in self.calls(name):
                    around = [m for m in HELPER.finditer(self.code, 0, start)
                              if m.end() + len(self.closed(m.end() - 1)) >= start]
                    for match in around:
                        told = re.findall(r"(?:string|char\s*\*|string_view)\s*&?\s*(\w+)\s*(?:,|=|$)",
                                          match["parameters"])
                        if any(re.search(rf"\b{word}\b", arguments) for word in told):
                            names.add(match["lambda"] or match["function"])
        return names - {"if", "for", "while", "switch", "catch"}

    def arguments(self, code):
        """The arguments of a call."""
        depth, last, found = 0, 0, []
        for at, letter in enumerate(code + ","):
            depth += (letter in "([{") - (letter in ")]}")
            if letter == "," and depth == 0:
                found.append(code[last:at])
                last = at + 1
        return found

    def sentences(self):
        """Texts of problems and cures: of each argument the texts that make it up, in order."""
        found = []
        for name in sorted(self.helpers()):
            for _, code in self.calls(name):
                for argument in self.arguments(code):
                    texts = self.texts_in(argument)
                    found += [[text] for text in texts] if "?" in argument or "{" in argument else [texts]
        for match in HELPER.finditer(self.code):
            if re.search(r"problem|cure|answer|meant_key", match["lambda"] or match["function"], re.I):
                found += [[text] for text in self.texts_in(self.closed(match.end() - 1))]
        for match in re.finditer(r"\bk\w*Cure\w*\s*=[^;]*;", self.code):
            found += [[text] for text in self.texts_in(match[0])]
        # A text without a blank is a key or a name.
        return [texts for texts in found if any(" " in text and WORDS.search(text) for text in texts)]


def table():
    source = Source(SOURCES / TABLE)
    code = source.code[source.code.index("kSentences[] = "):]
    return [(source.texts[int(a)], source.texts[int(b)]) for a, b in re.findall(r'\{"(\d+)",\s*"(\d+)"\}', code)]


def files():
    for where in LOOKED_AT:
        path = SOURCES / where
        yield from sorted(path.glob("*.cpp")) if path.is_dir() else [path]


def lacking(source, patterns):
    """What a file says and no pattern has, in one piece."""
    for texts in source.sentences():
        texts = [text for text in texts if WORDS.search(text) and text not in OPTIONS]
        if not any(" " in text for text in texts):
            continue
        wanted = re.compile(".*".join(map(re.escape, texts)), re.S)
        if not any(wanted.search(pattern) for pattern in patterns):
            yield " * ".join(texts)


class ErrorTexts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.table = table()
        cls.patterns = [english for english, _ in cls.table]

    def test_the_table_has_every_sentence_of_the_sources(self):
        missing = {}
        for file in files():
            name = str(file.relative_to(SOURCES))
            if name != TABLE and name not in NOT_SHOWN:
                missing.update({sentence: name for sentence in lacking(Source(file), self.patterns)})
        self.assertEqual(missing, {}, f"sentences without Japanese; add them to {TABLE}")

    def test_a_new_sentence_would_be_missed(self):
        """The search itself: of a direct throw, of a helper, of a helper's helper, of a function of problems."""
        file = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory())) / "new.cpp"
        file.write_text("""
            [[noreturn]] void fail(const std::string& what) { throw Error(ErrorKind::kUsage, what); }
            void further(const char* what) { fail(what); }
            std::string problem_of(int n) { return n > 0 ? "a new problem" : "the file is empty"; }
            // fail("a new comment");
            void f(const std::string& x) {
              fail("a new " "helper");
              further("a new depth");
              throw Error(ErrorKind::kUsage, "a new '" + x + "' of mine", {x, 0, 0, "key"}, "a new (cure)");
              fail("the file does not exist"); fail("'" + x + "' is not a number");
            }""", encoding="utf-8")
        self.assertEqual(sorted(lacking(Source(file), self.patterns)),
                         ["a new ' * ' of mine", "a new (cure)", "a new depth", "a new helper", "a new problem"])

    def test_every_sentence_of_the_table_is_said(self):
        files = [file for ending in ("*.cpp", "*.h") for file in SOURCES.rglob(ending) if file != SOURCES / TABLE]
        said = "\0" + "\0".join(text for file in files for text in Source(file).texts) + "\0"

        def is_said(part, begins=""):
            """In one text, or by the end of one, whole ones, and the beginning of another."""
            return begins + part in said or any(
                begins + part[:i] + "\0" in said and is_said(part[i:], "\0") for i in range(1, len(part)))

        unsaid = [pattern for pattern in self.patterns if pattern not in FOREIGN
                  for part in pattern.split("*") if part.strip() and not is_said(part)]
        self.assertEqual(unsaid, [])

    def test_the_table_is_whole(self):
        self.assertGreater(len(self.table), 200)
        self.assertEqual(len(set(self.patterns)), len(self.patterns), "a sentence stands twice")
        for english, japanese in self.table:
            marks = [int(number) for number in re.findall(r"[{<](\d)[}>]", japanese)]
            self.assertEqual(len(marks), len(set(marks)), english)
            self.assertLessEqual(max(marks, default=0), english.count("*"), english)
            self.assertRegex(japanese, r"[\u3040-\u30ff\u4e00-\u9fff]", english)

    def test_exceptions_are_needed(self):
        for name in NOT_SHOWN:
            self.assertTrue(list(lacking(Source(SOURCES / name), self.patterns)), f"{name} is no exception")


if __name__ == "__main__":
    unittest.main()
