#!/usr/bin/env bash
# Formats every C++ file of the tree; with --check only says which would change, and whose head has no line with the
# licence alone, which formatting may join to a sentence that was too long (exit code 1).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mapfile -t files < <(find src apps tests bench fuzz examples \( -name '*.cpp' -o -name '*.h' \) 2>/dev/null | sort)
if [ "${1:-}" = --check ]; then
  if grep -L '^// SPDX-License-Identifier: Apache-2.0$' "${files[@]}" | grep .; then
    echo "write '// SPDX-License-Identifier: Apache-2.0' on a line of its own" >&2
    exit 1
  fi
  exec clang-format --dry-run --Werror "${files[@]}"
fi
exec clang-format -i "${files[@]}"
