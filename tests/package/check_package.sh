#!/usr/bin/env bash
# Usage: check_package.sh BUILD_FOLDER CONSUMER_FOLDER SOURCE_FOLDER
set -euo pipefail
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$1" --prefix "$scratch/prefix" > "$scratch/install.log"
cmake -S "$2" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$scratch/prefix" > "$scratch/configure.log"
cmake --build "$scratch/build"
"$scratch/build/consumer"
# The examples build against the installed package and run on its data.
cmake -S "$3/examples" -B "$scratch/examples" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$scratch/prefix" > "$scratch/configure_examples.log"
cmake --build "$scratch/examples"
export FUAI_DATA=$scratch/prefix/share/fuai
"$scratch/examples/bend_and_unbend"
"$scratch/examples/import_and_ask" "$scratch/prefix/share/fuai/u3m/cupro-woven-su1098.physics.json"
# The installed program finds its installed data, not the source tree's.
(cd / && env -u FUAI_DATA "$scratch/prefix/bin/fuai" fabrics > "$scratch/fabrics.txt")
grep -q cupro-woven-su1098 "$scratch/fabrics.txt"
echo "the installed package works"
