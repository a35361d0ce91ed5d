#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Processor time (user + system) from a panorama on disk to usable lighting: Filament's cmgen, which
# prefilters, beside a whole run of `lodestar sample` (load, cube, tent mips, one lookup). Prints both
# medians and the median of the rounds' ratios. Usage: preparation.sh LODESTAR PANORAMA [ROUNDS]
set -u
lodestar=${1:?usage: preparation.sh LODESTAR PANORAMA [ROUNDS]}
panorama=${2:?usage: preparation.sh LODESTAR PANORAMA [ROUNDS]}
rounds=${3:-5}
command -v cmgen >/dev/null || { echo "preparation.sh: cmgen is not installed"; exit 77; }
[ -r "$panorama" ] || { echo "preparation.sh: cannot read $panorama"; exit 3; }
work=$(mktemp -d) || exit 5
trap 'rm -rf "$work"' EXIT

# Seconds of processor time of a command; its output is dropped, its failure ends the run.
seconds() {
    local TIMEFORMAT='%U %S' line
    line=$({ time "$@" >"$work/out" 2>"$work/err" || echo failed >"$work/failed"; } 2>&1)
    [ ! -e "$work/failed" ] || { echo "preparation.sh: $1 failed: $(head -n 1 "$work/err")" >&2; exit 1; }
    echo "$line" | awk '{ print $1 + $2 }'
}
median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

for ((i = 0; i < rounds; ++i)); do
    theirs=$(seconds cmgen -q -x "$work/cmgen" -f ktx -s 256 "$panorama") || exit 1
    ours=$(seconds "$lodestar" sample --environment "$panorama" --width 256 --lobe phong \
        --exponent 64 --direction 0,0,1 --estimator tent) || exit 1
    echo "$theirs $ours"
done >"$work/rounds" || exit 1
awk '{ print $1 }' "$work/rounds" | median | sed 's/^/cmgen     s /'
awk '{ print $2 }' "$work/rounds" | median | sed 's/^/lodestar  s /'
awk '{ print $1 / $2 }' "$work/rounds" | median | sed 's/^/ratio       /'
