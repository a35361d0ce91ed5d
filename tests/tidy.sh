#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# clang-tidy 14 with .clang-tidy over every source of the repository, warnings as errors.
set -u
cd "$(dirname "$0")/.." || exit 1
if ! command -v clang-tidy-14 >/dev/null; then
    echo "tests/tidy.sh: needs clang-tidy 14" >&2
    exit 1
fi
cmake --preset tidy >/dev/null || exit 1
# Files that the build makes must be there before they are read.
cmake --build build-tidy --target lodestar-gl >/dev/null || exit 1
log=$(mktemp)
sed -n 's/^  "file": "\(.*\)",*$/\1/p' build-tidy/compile_commands.json | sort -u | grep -v "/build-tidy/" |
    xargs -P "$(nproc)" -n 1 clang-tidy-14 -p build-tidy --quiet >"$log" 2>/dev/null
status=$?
grep -E '(warning|error):' "$log" | sort -u
echo "clang-tidy: $(grep -E '(warning|error):' "$log" | sort -u | wc -l) findings"
rm -f "$log"
exit $status
