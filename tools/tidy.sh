#!/usr/bin/env bash
# Runs clang-tidy over the library and the program. Usage: tools/tidy.sh BUILD_FOLDER [FILE...]
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$1
shift
files=("$@")
[ ${#files[@]} -gt 0 ] || mapfile -t files < <(find "$top/src" "$top/apps" -name '*.cpp' | sort)
# The database names g++; its warning flags that clang does not know are taken out.
database=$(mktemp -d)
trap 'rm -rf "$database"' EXIT
sed -e 's/-Wduplicated-cond//g; s/-Wlogical-op//g; s/-Wno-restrict//g; s/-Werror//g' "$build/compile_commands.json" \
  > "$database/compile_commands.json"
status=0
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P 2 clang-tidy -p "$database" --quiet > "$database/log" 2>&1 || status=1
grep -vE '^[0-9]+ warnings? (generated|treated)|^Suppressed|^Use -header-filter' "$database/log" || true
[ "$status" -ne 0 ] || echo "clang-tidy has nothing to say about ${#files[@]} files"
exit "$status"
