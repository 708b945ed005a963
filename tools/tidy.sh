#!/usr/bin/env bash
# Runs clang-tidy over the library and the program. Usage: tools/tidy.sh BUILD_FOLDER [FILE...]
#
# Nearly all of its time goes into the headers that every file includes, so many files are read together
# (tidy_groups.py). Where that does not compile after all, and for files named on the command line, each is
# read alone.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$1
shift
# Units lie in a folder of their own, from which it would not be found.
export config=$top/.clang-tidy
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if grep -q '^FUAI_JOIN:BOOL=ON' "$build/CMakeCache.txt"; then
  # Its database knows joined sources only: one of single files, from a configuration that nobody builds.
  (cd "$top" && cmake --preset ci -B "$work/single" -DFUAI_JOIN=OFF > "$work/configure.log" 2>&1) ||
    { cat "$work/configure.log"; exit 1; }
  build=$work/single
fi
# The database names g++; its warning flags that clang does not know are taken out.
clean='s/-Wduplicated-cond//g; s/-Wlogical-op//g; s/-Wno-restrict//g; s/-Werror//g'
sed -e "$clean" "$build/compile_commands.json" > "$work/compile_commands.json"

# Prints the complaints about a file; fails when there are any. Usage: complaints DATABASE_FOLDER FILE
complaints() {
  local status=0 log
  log=$(clang-tidy -p "$1" --config-file="$config" --quiet "$2" 2>&1) || status=1
  grep -vE '^$|^[0-9]+ warnings? (generated|treated)|^Suppressed|^Use -header-filter' <<< "$log" || true
  return "$status"
}

# The same for a unit. Usage: complaints_of_unit WORK_FOLDER UNIT_FOLDER
complaints_of_unit() {
  local log status=0
  log=$(complaints "$2" "$2/unit.cpp") && return 0
  if ! grep -q clang-diagnostic-error <<< "$log"; then
    echo "$log"
    return 1
  fi
  mapfile -t files < "$2/files"
  for file in "${files[@]}"; do complaints "$1" "$file" || status=1; done
  return "$status"
}
export -f complaints complaints_of_unit

status=0
if [ $# -gt 0 ]; then
  count=$#
  printf '%s\0' "$@" | xargs -0 -P 2 -I{} bash -c 'complaints "$0" "$1"' "$work" {} > "$work/log" 2>&1 || status=1
else
  mapfile -t files < <(find "$top/src" "$top/apps" -name '*.cpp' | sort)
  count=${#files[@]}
  python3 "$top/tools/tidy_groups.py" "$work" "${files[@]}" || status=1
  printf '%s\0' "$work"/unit??? | xargs -0 -P 2 -I{} bash -c 'complaints_of_unit "$0" "$1"' "$work" {} \
    > "$work/log" 2>&1 || status=1
fi
cat "$work/log"
[ "$status" -ne 0 ] || echo "clang-tidy has nothing to say about $count files"
exit "$status"
