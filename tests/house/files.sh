#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What every text file must hold: a licence line, at most 500 lines, no path of one machine, no
# package-registry host, no unfinished-work mark. Usage: files.sh ROOT.
set -u
cd "${1:?usage: files.sh ROOT}" || exit 1
limit=500
readme_limit=150

# Written so that this file does not match itself.
machine_paths='(^|[^A-Za-z0-9_.])/(w[o]rk|r[o]ot|h[o]me/[a-z]|farm)/'
registries='deb\.debian\.[o]rg|security\.debian\.[o]rg|registry\.npmjs|pypi\.[o]rg|proxy\.golang|index\.crates'
marks='\b(TO[D]O|FIX[M]E|XX[X])\b'

every=$(find . -name .git -prune -o -path './build*' -prune -o -path ./out -prune -o -type f -print |
    sed 's|^\./||' | LC_ALL=C sort)
sources=$(printf '%s\n' "$every" | grep -E '\.(h|cpp|c|glsl|vert|frag|sh|cmake)$')
sized=$(printf '%s\n' "$every" | grep -E '\.(h|cpp|c|glsl|vert|frag|sh|cmake)$|CMakeLists\.txt$|^README\.md$')
texts=$(printf '%s\n' "$every" | grep -E '\.(h|cpp|c|glsl|vert|frag|inc|sh|cmake|json|md|yml)$|CMakeLists\.txt$|^\.ci/run$')
if [ -z "$texts" ]; then
    echo "files: nothing was checked"
    exit 1
fi

# on LIST COMMAND...: the command over all files of a list; the repository's names hold no spaces.
on() {
    local list=$1
    shift
    [ -z "$list" ] || printf '%s\n' "$list" | xargs "$@"
}
found=$(
    on "$sources" awk 'FNR == 1 { if (file != "" && !seen) print file ": no SPDX line among the first three"
                           file = FILENAME; seen = 0 }
        FNR <= 3 && /SPDX-License-Identifier: MIT/ { seen = 1 }
        END { if (file != "" && !seen) print file ": no SPDX line among the first three" }'
    on "$sized" wc -l | awk -v limit=$limit -v readme=$readme_limit '
        $2 == "total" { next }
        { most = $2 == "README.md" ? readme : limit }
        $1 > most { print $2 ": " $1 " lines, the limit is " most }'
    on "$texts" grep -HnE -- "$machine_paths" | sed 's/^\([^:]*:[0-9]*\):.*/\1: a path of one machine/'
    on "$texts" grep -HnE -- "$registries" | sed 's/^\([^:]*:[0-9]*\):.*/\1: a registry host/'
    on "$texts" grep -HnE -- "$marks" | sed 's/^\([^:]*:[0-9]*\):.*/\1: unfinished work/'
)
failures=$(printf '%s' "$found" | grep -c .)
[ "$failures" -eq 0 ] || printf '%s\n' "$found" | sed 's/^/files: /'
echo "files: $(printf '%s\n' "$texts" | wc -l) files checked, $failures violations"
[ "$failures" -eq 0 ]
