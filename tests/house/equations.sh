#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Equation numbers: every number that code cites (MIP-1, written so) stands in docs/derivations, and
# every boxed result there is cited by code or tests. A derivation defines a number by "(MIP-1)" on
# the line of the equation and boxes it by "(MIP-1, boxed)". Usage: equations.sh ROOT.
set -u
cd "${1:?usage: equations.sh ROOT}" || exit 1
failures=0
bad() {
    echo "equations: $1"
    failures=$((failures + 1))
}
number='\b[A-Z][A-Z0-9]{1,7}-[0-9]+[a-z]?\b'
# Words of the same shape that are no equations.
other='^(UTF|ISO|SHA|RFC|IEEE|BT|CC|GL|GLSL|EGL|MD|RGB|RGBA|PNG)-'

defined=$(grep -rhoE "\((${number}(, boxed)?)\)" docs/derivations 2>/dev/null | grep -oE "$number" | sort -u)
boxed=$(grep -rhoE "\(${number}, boxed\)" docs/derivations 2>/dev/null | grep -oE "$number" | sort -u)
folders=()
for folder in shaders runtime editor plugin samples tests; do
    [ -d "$folder" ] && folders+=("$folder")
done
[ ${#folders[@]} -gt 0 ] || { echo "equations: nothing was checked"; exit 1; }
cited=$(grep -rhoE "$number" --include='*.h' --include='*.cpp' --include='*.glsl' --include='*.vert' \
    --include='*.frag' "${folders[@]}" | grep -vE "$other" | sort -u)

for one in $cited; do
    if ! printf '%s\n' "$defined" | grep -qx "$one"; then
        place=$(grep -rlE "\b$one\b" --include='*.h' --include='*.cpp' --include='*.glsl' "${folders[@]}" | head -n 1)
        bad "$one is cited by $place and stands in no derivation"
    fi
done
for one in $boxed; do
    printf '%s\n' "$cited" | grep -qx "$one" || bad "$one is boxed and no code or test cites it"
done
echo "equations: $(printf '%s\n' "$cited" | grep -c .) cited, $(printf '%s\n' "$boxed" | grep -c .) boxed, $failures violations"
[ "$failures" -eq 0 ]
