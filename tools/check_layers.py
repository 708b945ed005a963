#!/usr/bin/env python3
"""Checks that every include in src/fuai obeys src/fuai/LAYERS. Prints each violation; exit code 1 if there is one."""
import pathlib
import re
import sys

top = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".") / "src" / "fuai"
allowed, outside = {}, {}
for line in (top / "LAYERS").read_text().splitlines():
    line = line.split("#")[0].strip()
    if not line:
        continue
    layer, rest = line.split(":", 1)
    inside, _, libraries = rest.partition(";")
    allowed[layer] = set(inside.split()) | {layer}
    outside[layer] = tuple(libraries.split())

problems = []
order = list(allowed)
for layer, may in allowed.items():
    for below in may - {layer}:
        if below not in order:
            problems.append(f"LAYERS: {layer} may include the unknown layer {below}")
        elif order.index(below) > order.index(layer):
            problems.append(f"LAYERS: {layer} stands before {below}, which it may include")

for folder in sorted(p for p in top.iterdir() if p.is_dir()):
    if folder.name not in allowed:
        problems.append(f"{folder.name}: folder is missing from LAYERS")
        continue
    for path in sorted(folder.rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        for number, text in enumerate(path.read_text().splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', text)
            if not match:
                continue
            name = match.group(2)
            where = f"{path.relative_to(top)}:{number}"
            if name.startswith("fuai/"):
                other = name.split("/")[1]
                if other not in allowed[folder.name]:
                    problems.append(f"{where}: {folder.name} must not include {name}")
                if not (top.parent / name).exists():
                    problems.append(f"{where}: {name} does not exist")
            elif match.group(1) == '"':
                problems.append(f'{where}: write "fuai/{folder.name}/{name}"')
            elif ("/" in name or name.endswith(".h")) and not name.startswith(outside[folder.name]):
                problems.append(f"{where}: {folder.name} must not include <{name}>")

print("\n".join(problems) if problems else f"layers are in order: {', '.join(order)}")
sys.exit(1 if problems else 0)
