"""The document check must catch what it is for: run it on small trees that break each rule."""
import pathlib
import subprocess
import sys
import tempfile

CLEAN = {
    "README.md": "# Top\n[map](docs/paper-map.md#the-map) [web](https://example.org/none) `src/fuai/core/a.h` `core/a.*`\n"
                 "`fuai paper --out out/none.html` `/tmp/none.md` `stretch()` `a_b`\n```\n[none](none.md) `no/such.h`\n```\n",
    "docs/paper-map.md": '# The map\n| `stretch` | `core/a.h` | "springs pull back" | `fuai paper --figure 4` |\n',
    "src/fuai/core/a.h": "double stretch(double x);\n",
    "tests/core/test_a.cpp": 'TEST_CASE(\n      "springs pull "\n      "back") {}\n',
    "apps/main.cpp": 'top.command("paper", "x"); paper.option("-f,--figure", x);\n',
}


def run(files):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**CLEAN, **files}.items():
            path = pathlib.Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        result = subprocess.run([sys.executable, sys.argv[1], folder], capture_output=True, text=True)
        return result.returncode, result.stdout


def row(cell):
    return {"docs/paper-map.md": f"# The map\n| {cell} |\n"}


code, text = run({})
assert code == 0, ("a clean tree must pass", text)
for files, expected in [
    ({"docs/a.md": "\n[x](none.md)\n"}, "docs/a.md:2: the link leads nowhere: none.md"),
    ({"docs/a.md": "![x](images/none.png)\n"}, "the link leads nowhere: images/none.png"),
    ({"docs/a.md": "[x](paper-map.md#none)\n"}, "the link's heading does not exist: paper-map.md#none"),
    ({"docs/a.md": "[x](#none)\n"}, "the link's heading does not exist: #none"),
    ({"docs/a.md": "`src/fuai/core/none.h`\n"}, "the file does not exist: src/fuai/core/none.h"),
    ({"docs/a.md": "`fuai show data/none.toml`\n"}, "the file does not exist: data/none.toml"),
    ({"docs/a.md": "`core/none.*`\n"}, "the file does not exist: core/none.*"),
    ({"docs/a.md": "`stretched()`\n"}, "the sources do not know: stretched()"),
    (row("`Solver::stretched`"), "the sources do not know: Solver::stretched"),
    (row('"springs push"'), 'there is no test case "springs push"'),
    (row("`fuai paper --picture 4`"), "the program does not know '--picture'"),
    (row("`fuai papers`"), "the program does not know 'papers'"),
]:
    code, text = run(files)
    assert code == 1 and expected in text and len(text.splitlines()) == 1, (files, code, text)
print("the document check catches every kind of problem")
