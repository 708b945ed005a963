"""The layer check must catch what it is for: run it on small trees that break each rule."""
import pathlib
import subprocess
import sys
import tempfile

LAYERS = "core: ; Eigen/\nunits: core ;\nfabric: core units ;\n"


def run(files):
    with tempfile.TemporaryDirectory() as folder:
        top = pathlib.Path(folder) / "src" / "fuai"
        for name, text in {"LAYERS": LAYERS, "core/a.h": "", "units/b.h": '#include "fuai/core/a.h"\n', **files}.items():
            path = top / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        result = subprocess.run([sys.executable, sys.argv[1], folder], capture_output=True, text=True)
        return result.returncode, result.stdout


assert run({})[0] == 0, "a clean tree must pass"
for files, expected in [
    ({"core/c.h": '#include "fuai/units/b.h"\n'}, "core must not include fuai/units/b.h"),
    ({"units/c.cpp": "#include <nlohmann/json.hpp>\n"}, "units must not include <nlohmann/json.hpp>"),
    ({"units/c.cpp": '#include "b.h"\n'}, 'write "fuai/units/b.h"'),
    ({"units/c.cpp": '#include "fuai/core/none.h"\n'}, "does not exist"),
    ({"utils/c.h": ""}, "folder is missing from LAYERS"),
    ({"LAYERS": LAYERS + "extra: nowhere ;\n"}, "unknown layer nowhere"),
    ({"LAYERS": "core: units ;\nunits: ;\nfabric: core units ;\n"}, "core stands before units"),
]:
    code, text = run(files)
    assert code == 1 and expected in text, (files, code, text)
print("the layer check catches every kind of violation")
