#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What every text file must hold: a licence line, at most 500 lines, no path of one machine, no
# package-registry host, no unfinished-work mark. Usage: files.sh ROOT.
set -u
cd "${1:?usage: files.sh ROOT}" || exit 1
limit=500
readme_limit=150
failures=0
checked=0
bad() {
    echo "files: $1"
    failures=$((failures + 1))
}
has() { grep -qE -- "$2" "$1"; }

# Written so that this file does not match itself.
machine_paths='(^|[^A-Za-z0-9_.])/(w[o]rk|r[o]ot|h[o]me/[a-z]|farm)/'
registries='deb\.debian\.[o]rg|security\.debian\.[o]rg|registry\.npmjs|pypi\.[o]rg|proxy\.golang|index\.crates'
marks='\b(TO[D]O|FIX[M]E|XX[X])\b'

while IFS= read -r file; do
    case $file in
    *.h | *.cpp | *.c | *.glsl | *.vert | *.frag | *.sh | *.cmake)
        head -n 3 "$file" | grep -q 'SPDX-License-Identifier: MIT' || bad "$file: no SPDX line among the first three"
        ;;
    esac
    case $file in
    *.h | *.cpp | *.c | *.glsl | *.vert | *.frag | *.sh | *.cmake | *CMakeLists.txt)
        lines=$(wc -l <"$file")
        [ "$lines" -le $limit ] || bad "$file: $lines lines, the limit is $limit"
        ;;
    README.md)
        lines=$(wc -l <"$file")
        [ "$lines" -le $readme_limit ] || bad "$file: $lines lines, the limit is $readme_limit"
        ;;
    *.json | *.md | *.yml | .ci/run) ;;
    *) continue ;;
    esac
    checked=$((checked + 1))
    has "$file" "$machine_paths" && bad "$file: a path of one machine: $(grep -nE "$machine_paths" "$file" | head -n 1 | cut -c1-100)"
    has "$file" "$registries" && bad "$file: a registry host"
    has "$file" "$marks" && bad "$file: unfinished work: $(grep -nE "$marks" "$file" | head -n 1 | cut -c1-100)"
done < <(find . -name .git -prune -o -path './build*' -prune -o -path ./out -prune -o -type f -print | sed 's|^\./||' | LC_ALL=C sort)

if [ "$checked" -eq 0 ]; then
    echo "files: nothing was checked"
    exit 1
fi
echo "files: $checked files checked, $failures violations"
[ "$failures" -eq 0 ]
