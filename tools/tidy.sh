#!/usr/bin/env bash
# Runs clang-tidy over the library and the program. Usage: tools/tidy.sh BUILD_FOLDER [FILE...]
#
# Nearly all of its time goes into the headers that every file includes, so the files of a folder are read
# together, many at a time. Where they cannot be (two of them give the same name to something of their own)
# the group is halved until they can. Files named on the command line are read alone.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$1
shift
together=16
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# The database names g++; its warning flags that clang does not know are taken out, and precompiled headers,
# which only g++ can read.
clean='s/-Wduplicated-cond//g; s/-Wlogical-op//g; s/-Wno-restrict//g; s/-Werror//g; s/-Winvalid-pch//g'
clean="$clean; s/-include [^ ]*cmake_pch[^ ]*//g"
sed -e "$clean" "$build/compile_commands.json" > "$work/compile_commands.json"

# Prints the complaints about a file; fails when there are any. Usage: complaints DATABASE_FOLDER FILE
complaints() {
  local status=0 log
  log=$(clang-tidy -p "$1" --quiet "$2" 2>&1) || status=1
  grep -vE '^$|^[0-9]+ warnings? (generated|treated)|^Suppressed|^Use -header-filter' <<< "$log" || true
  return "$status"
}

# The same for several files read as one. Usage: complaints_together WORK_FOLDER FILE...
complaints_together() {
  local work=$1 status=0 folder half
  shift
  if [ $# -eq 1 ]; then
    complaints "$work" "$1"
    return
  fi
  folder=$(mktemp -d -p "$work")
  python3 - "$work" "$folder" "$@" <<'PYTHON'
import json, sys
work, folder, files = sys.argv[1], sys.argv[2], sys.argv[3:]
with open(work + "/compile_commands.json") as source:
    entry = next(e for e in json.load(source) if e["file"] == files[0])
unit = folder + "/unit.cpp"
entry["command"] = entry["command"].replace(files[0], unit)
entry["file"] = unit
with open(unit, "w") as out:
    out.writelines(f'#include "{name}"  // NOLINT(bugprone-suspicious-include)\n' for name in files)
with open(folder + "/compile_commands.json", "w") as out:
    json.dump([entry], out)
PYTHON
  # One light check shows whether they can be read together.
  if clang-tidy -p "$folder" --quiet --checks='-*,modernize-use-nullptr' "$folder/unit.cpp" > /dev/null 2>&1; then
    complaints "$folder" "$folder/unit.cpp"
    return
  fi
  half=$(($# / 2))
  complaints_together "$work" "${@:1:half}" || status=1
  complaints_together "$work" "${@:half+1}" || status=1
  return "$status"
}
export -f complaints complaints_together

status=0
if [ $# -gt 0 ]; then
  count=$#
  printf '%s\0' "$@" | xargs -0 -P 2 -I{} bash -c 'complaints "$0" "$1"' "$work" {} > "$work/log" 2>&1 || status=1
else
  mapfile -t files < <(find "$top/src" "$top/apps" -name '*.cpp' | sort)
  count=${#files[@]}
  printf '%s\n' "${files[@]}" | awk -v work="$work" -v together="$together" '
    { folder = $0; sub("/[^/]*$", "", folder) }
    folder != last || held == together { ++group; held = 0; last = folder }
    { ++held; printf "%s\n", $0 > sprintf("%s/group%03d", work, group) }'
  printf '%s\0' "$work"/group??? |
    xargs -0 -P 2 -I{} bash -c 'mapfile -t files < "$1"; complaints_together "$0" "${files[@]}"' "$work" {} \
    > "$work/log" 2>&1 || status=1
fi
cat "$work/log"
[ "$status" -ne 0 ] || echo "clang-tidy has nothing to say about $count files"
exit "$status"
