#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# C++ sources are as clang-format 14 writes them (.clang-format). Usage: format.sh ROOT.
# Exit status 77 (a skip) where clang-format 14 is not installed.
set -u
cd "${1:?usage: format.sh ROOT}" || exit 1
tool=$(command -v clang-format-14 || command -v clang-format || true)
if [ -z "$tool" ] || ! "$tool" --version | grep -q 'version 14\.'; then
    echo "format: skipped: needs clang-format 14"
    exit 77
fi
mapfile -t files < <(find . -name .git -prune -o -path './build*' -prune -o -path ./out -prune -o \
    -type f \( -name '*.h' -o -name '*.cpp' \) -print | LC_ALL=C sort)
if [ ${#files[@]} -eq 0 ]; then
    echo "format: nothing was checked"
    exit 1
fi
output=$("$tool" --style=file --dry-run --Werror "${files[@]}" 2>&1)
status=$?
printf '%s\n' "$output" | grep -oE '^[^:]+:[0-9]+' | sort -t: -k1,1 -u | sed 's/^/format: run clang-format -i on /'
echo "format: ${#files[@]} files checked"
exit $status
