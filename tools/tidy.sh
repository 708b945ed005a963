#!/usr/bin/env bash
# Runs clang-tidy over the library and the program. Usage: tools/tidy.sh BUILD_FOLDER [FILE...]
#
# Nearly all of its time goes into the headers that every file includes, so the files of a folder are read
# together, a few at a time. Where they cannot be (two of them give the same name to something of their own),
# and for files named on the command line, each is read alone.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$1
shift
together=8
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The database names g++; its warning flags that clang does not know are taken out.
clean='s/-Wduplicated-cond//g; s/-Wlogical-op//g; s/-Wno-restrict//g; s/-Werror//g'
sed -e "$clean" "$build/compile_commands.json" > "$work/compile_commands.json"

# Prints the complaints of one file; fails when there are any.
tidy_one() {
  local log
  log=$(mktemp -p "$1")
  local status=0
  clang-tidy -p "$1" --quiet "$2" > "$log" 2>&1 || status=1
  grep -vE '^[0-9]+ warnings? (generated|treated)|^Suppressed|^Use -header-filter' "$log" || true
  return "$status"
}

# The same for a list of files that are read as one.
tidy_group() {
  local work=$1 group=$2 log=$2.log status=0
  mapfile -t files < "$group"
  python3 - "$work" "$group" "${files[@]}" <<'PYTHON'
import json, sys
work, group, files = sys.argv[1], sys.argv[2], sys.argv[3:]
with open(work + "/compile_commands.json") as source:
    entry = next(e for e in json.load(source) if e["file"] == files[0])
entry["command"] = entry["command"].replace(files[0], group + ".cpp")
entry["file"] = group + ".cpp"
with open(group + ".cpp", "w") as unit:
    unit.writelines(f'#include "{name}"  // NOLINT(bugprone-suspicious-include)\n' for name in files)
import os
os.makedirs(group + ".d")
with open(group + ".d/compile_commands.json", "w") as out:
    json.dump([entry], out)
PYTHON
  clang-tidy -p "$group.d" --quiet "$group.cpp" > "$log" 2>&1 || status=1
  if [ "$status" -eq 0 ]; then return 0; fi
  if ! grep -q 'clang-diagnostic-error' "$log"; then
    grep -vE '^[0-9]+ warnings? (generated|treated)|^Suppressed|^Use -header-filter' "$log" || true
    return 1
  fi
  status=0
  for file in "${files[@]}"; do tidy_one "$work" "$file" || status=1; done
  return "$status"
}
export -f tidy_one tidy_group

status=0
if [ $# -gt 0 ]; then
  count=$#
  printf '%s\0' "$@" | xargs -0 -P 2 -I{} bash -c 'tidy_one "$0" "$1"' "$work" {} > "$work/log" 2>&1 || status=1
else
  mapfile -t files < <(find "$top/src" "$top/apps" -name '*.cpp' | sort)
  count=${#files[@]}
  printf '%s\n' "${files[@]}" | awk -v work="$work" -v together="$together" '
    { folder = $0; sub("/[^/]*$", "", folder) }
    folder != last || held == together { ++group; held = 0; last = folder }
    { ++held; printf "%s\n", $0 > sprintf("%s/group%03d", work, group) }'
  printf '%s\0' "$work"/group??? | xargs -0 -P 2 -I{} bash -c 'tidy_group "$0" "$1"' "$work" {} \
    > "$work/log" 2>&1 || status=1
fi
cat "$work/log"
[ "$status" -ne 0 ] || echo "clang-tidy has nothing to say about $count files"
exit "$status"
