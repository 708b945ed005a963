"""The messages that docs/fabric-files.md quotes are the program's own words: give it each bad file and compare."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

program, top = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
document = (top / "docs" / "fabric-files.md").read_text()
physics = (top / "data" / "u3m" / "cupro-woven-su1098.physics.json").read_text()

HEAD = 'format = "fuai-fabric/1"\nname = "Wool"\n[weight]\nW_mg_per_cm2 = 16.3\n'
BENDING = "[bending.warp]\nB_gf_cm2_per_cm = 0.067\n2HB_gf_cm_per_cm = 0.033\n"
SOURCE = '{ kind = "measured", source = "me" }\n'
PROVENANCE = f'[provenance]\n"weight" = {SOURCE}"bending" = {SOURCE}'
GOOD = HEAD + BENDING + PROVENANCE
TENSILE = "[tensile.warp]\nLT = 0.62\nWT_gf_cm_per_cm2 = 81\nRT_percent = 68\nEMT_percent = 5.2\n"

fabrics = {
    "range": GOOD.replace("16.3", "163"),
    "wt": HEAD + BENDING + TENSILE + PROVENANCE,
    "drape": HEAD + BENDING + "[drape]\ndisc_cm = 18\nspecimen_cm = 12\n" + PROVENANCE,
    "noprov": HEAD + BENDING + f'[provenance]\n"bending" = {SOURCE}',
    "unused": HEAD + BENDING + PROVENANCE + f'\n"shear" = {SOURCE}',
    "neg": GOOD.replace("0.067", "-0.067"),
    "zero": GOOD.replace("0.067", "0"),
    "nan": GOOD.replace("0.067", "nan"),
    "huge": GOOD.replace("0.067", "1e305"),
    "pct": HEAD + BENDING + "[tensile.warp]\nRT_percent = 140\n" + PROVENANCE,
    "text": GOOD.replace("0.067", '"0.067"'),
    "key": GOOD.replace("B_gf_cm2_per_cm", "B_gf_cm_per_cm2"),
    "unit": GOOD.replace("B_gf_cm2_per_cm = 0.067", "B_mN_cm2_per_cm = 0.657"),
    "section": GOOD.replace("[bending", "[bendign"),
    "mass": 'format = "fuai-fabric/1"\nname = "Wool"\n' + BENDING,
    "nobend": HEAD,
    "tension": HEAD + BENDING + "[shear]\nG_gf_per_cm_deg = 0.15\ntension_gf_per_cm = 10\n" + PROVENANCE,
    "weave": GOOD.replace("[weight]", 'structure = "basket"\n[weight]'),
    "name": GOOD.replace('name = "Wool"\n', ""),
    "format": GOOD.replace("fabric/1", "fabric/2"),
    "toml": HEAD + "[bending.warp\nB = ",
    "ascii": HEAD + "曲げ = 3\n",
    "deep": "x = " + "[" * 4000,
    "curve": HEAD + '[bending.warp]\ncurve = "none.csv"\n',
    "outside": HEAD + '[bending.warp]\ncurve = "../none.csv"\n',
    "kind": HEAD + BENDING + '[provenance]\n"weight" = { kind = "guessed", source = "me" }\n',
    "kind2": HEAD + BENDING + '[provenance]\n"weight" = { kind = "measured" }\n',
    "prov3": HEAD + BENDING + f'[provenance]\n"wieght" = {SOURCE}',
    "comp": HEAD + BENDING + f'[compression]\ncurve = "c.csv"\n{PROVENANCE}"compression" = {SOURCE}',
    "empty": "",
    "utf16": HEAD.encode("utf-16"),
    "latin": HEAD.encode() + b"# \xff\xfe\xa0 \x80\n",
    "binary": b"\x7fELF\0\0",
}

FIRST = "# fuai-curve/1 test=bending direction=warp\n"
COLUMNS = "curvature_per_cm,moment_gf_cm_per_cm,branch\n"
STEPS = [0.1 * i for i in range(26)]


def branch(offset, kind):
    steps = STEPS if kind == "load" else STEPS[::-1]
    return "".join(f"{K:.1f},{offset + 0.07 * K:.4f},{kind}\n" for K in steps)


UP, DOWN = branch(0.02, "load"), branch(-0.02, "unload")
curves = {
    "good": (FIRST + COLUMNS + UP + DOWN, []),
    "nounit": (FIRST + COLUMNS.replace("curvature_per_cm", "curvature") + UP, []),
    "wrongunit": (FIRST + COLUMNS.replace("gf_cm_per_cm", "gf_cm") + UP, []),
    "noheader": (FIRST + UP, []),
    "word": (FIRST + COLUMNS + "0,0,load\n1,abc,load\n", []),
    "nan": (FIRST + COLUMNS + "0,0,load\n1,1,load\n2,2,load\n0.3,nan,load\n", []),
    "trunc": (FIRST + COLUMNS + UP + DOWN.rsplit(",", 1)[0], []),
    "branch": (FIRST + COLUMNS + "0.0,0.02,going\n", []),
    "one": (FIRST + COLUMNS + "0,0.02,load\n1,0.08,load\n1,0.05,unload\n", []),
    "two": (FIRST + COLUMNS + "0,0.02,load\n1,0.08,load\n", []),
    "neg": (FIRST + COLUMNS + UP.replace(",0.", ",-0."), []),
    "flat": (FIRST + COLUMNS + "1,0.02,load\n1,0.08,load\n1,0.09,load\n", []),
    "crossed2": (FIRST + COLUMNS + branch(-0.02, "load") + branch(0.02, "unload"), []),
    "nofirst": ("曲率 (1/cm)\t曲げモーメント (cN·cm/cm)\n" + "".join(f"{K},{K}\n" for K in STEPS).replace(",", "\t"),
                ["--test", "bending", "--direction", "warp"]),
    "fmt": ((FIRST + COLUMNS + UP).replace("curve/1", "curve/2"), []),
    "test": ((FIRST + COLUMNS + UP).replace("=bending", "=bend"), []),
    "nodir": ((FIRST + COLUMNS + UP).replace(" direction=warp", ""), []),
    "clash": (FIRST + COLUMNS + UP + DOWN, ["--direction", "weft"]),
    "quote": (FIRST + COLUMNS + '"0,0.02,load\n' + UP, []),
}

sheets = {
    "s1": "name,W [mg/cm2],B1 [gf·cm²/cm]\nWool,16.3,0.067\n",
    "s2": "sample,W,B,G(warp) [gf/(cm·deg)],G(weft) [gf/(cm·deg)],MMD,colour\nWool,16.3,0.067,0.9,0.8,0.01,red\n",
    "s2 average": "sample,W,B,G(warp),G(weft)\nWool,16.3,0.067,0.9,0.8\n",
    "s3": "name,W,hysteresis\nWool,16,3\n",
    "s4": "name,W [mg/cm2],B [gf/cm]\nWool,16,3\n",
    "s5": "name,W [mg/cm2],B [foo]\nWool,16,3\n",
    "s6": "name,B1,B1\nWool,0.1,0.1\n",
    "s7": "name,B1,B2\nWool,0.1,0.1\n",
    "s8": "a,b\n1,2\n",
    "s9": "name,W,B\nWool,16,0.1\nCotton,12,0.1\n",
    "s10": "name,W,B,RC(warp)\nWool,16,0.1,40\n",
    "s11": "name,W,B_mean,B1,B2\nWool,16,0.1,0.1,0.1\n",
    "s12": "name,W,B\n",
    "s13": "name,W\nWool,16\n",
    "s14": "fibre,W,B\nWool,16,x\n",
    "s15": "fibre,W,B\nWool,16,0.1\n",
    "s16": "name,W [mg/cm2],WT-bias\nWool,16,3\n",
    "s18": "name,B [gf·cm²/cm],W\n,gf·cm²/cm,mg/cm2\nWool,1,16\n",
    "sheet": "W [mg/cm2],B [gf·cm²/cm]\n16,0.1\n",
}

objects = {
    "mat": '{"material": {}}',
    "v2": '{"schema": "1.0"}',
    "null": '{"schema": "1.1", "raw_data": null}',
    "odd": '{"schema": "1.1", "raw_data": {}}',
    "odd2": re.sub(r'"width": [0-9.]+', '"width": -1', physics, count=1),
    "cut": physics[:20000],
    "deep": "[" * 5000,
}


def words_of(folder, *arguments):
    """What the program says, a message a line, without the introduction of each."""
    result = subprocess.run([program, *arguments], cwd=folder, capture_output=True, text=True, timeout=300,
                            env={**os.environ, "FUAI_DATA": str(top / "data")})
    lines = [line for line in result.stderr.splitlines() if not line.startswith("wrote ")]
    return [line.split(": ", 1)[1] for line in lines if line.startswith(("warning: ", "fuai: "))]


said = set()
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)

    def write(file, content):
        (folder / file).write_bytes(content if isinstance(content, bytes) else content.encode())
        return file

    write("c.csv", "# fuai-curve/1 test=compression\nthickness_loss_mm,pressure_gf_per_cm2,branch\n"
          "0,0,load\n0.1,10,load\n0.2,40,load\n0.2,42,unload\n0.1,20,unload\n0,1,unload\n")
    (folder / "dir.fabric.toml").mkdir()
    for what in ("none.fabric.toml", "dir.fabric.toml", "wol-tropical"):
        said.update(words_of(folder, "fabric", "show", what))
    for key, text in fabrics.items():
        said.update(words_of(folder, "fabric", "show", write(key + ".fabric.toml", text)))
    for key, (text, options) in curves.items():
        said.update(words_of(folder, "fabric", "import", write(key + ".csv", text), "--mass", "16.3 mg/cm2", "-o",
                             "o.fabric.toml", *options))
    said.update(words_of(folder, "fabric", "import", "good.csv", "-o", "o.fabric.toml"))
    for key, text in sheets.items():
        said.update(words_of(folder, "fabric", "import", write(key.split()[0] + ".csv", text), "-o", "o.fabric.toml"))
    for key, text in objects.items():
        said.update(words_of(folder, "fabric", "import", write(key + ".json", text), "-o", "o.fabric.toml"))
    with open(folder / "big.csv", "wb") as big:
        big.truncate(2 ** 31)
    said.update(words_of(folder, "fabric", "import", "big.csv", "-o", "o.fabric.toml"))

quoted = set()
for line in document.split("## Messages")[1].splitlines():
    if line.startswith("| ") and "…" not in line:
        cells = [part.strip() for part in line.strip("|").split(" | ")]
        quoted.update(cell.strip().strip("|").strip()[1:-1] for cell in cells if cell.strip().startswith("`"))
# Every imported Fabric Analyzer file says this; reading one takes a fit of seconds.
quoted.discard("compression is left out: the file does not state the area of the thickness head")

wrong = sorted(quoted - said)
assert len(quoted) > 70, f"only {len(quoted)} messages were found in the document"
for message in wrong:
    print("the program does not say:", message)
if wrong:
    print("it says:", *sorted(said - quoted), sep="\n  ")
    sys.exit(1)
print(f"{len(quoted)} documented messages are the program's own words")
