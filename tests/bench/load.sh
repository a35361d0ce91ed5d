#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a glTF file to a scene in memory, whole processes: our loader, which checks the file, beside
# tinygltf's own parse with its own image decoding. Elapsed time, processor time and the largest
# resident memory; each a median, and the median of the rounds' ratios.
# Usage: load.sh BENCH_LOAD FILE [ROUNDS]
set -u
bench=${1:?usage: load.sh BENCH_LOAD FILE [ROUNDS]}
file=${2:?usage: load.sh BENCH_LOAD FILE [ROUNDS]}
rounds=${3:-9}
[ -r "$file" ] || { echo "load.sh: cannot read $file"; exit 3; }
[ -x /usr/bin/time ] || { echo "load.sh: /usr/bin/time is not installed (package time)"; exit 77; }
work=$(mktemp -d) || exit 5
trap 'rm -rf "$work"' EXIT

# "elapsed cpu megabytes" of one load.
measure() {
    /usr/bin/time -o "$work/time" -f '%e %U %S %M' "$bench" "$1" "$file" >"$work/out" 2>"$work/err" ||
        { echo "load.sh: $1 failed: $(head -n 1 "$work/err")" >&2; exit 1; }
    awk '{ print $1, $2 + $3, $4 / 1024 }' "$work/time"
}
median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

for ((i = 0; i < rounds; ++i)); do
    theirs=$(measure tinygltf) || exit 1
    ours=$(measure lodestar) || exit 1
    echo "$theirs $ours"
done >"$work/rounds" || exit 1
report() { # name, unit, column of tinygltf, column of ours
    printf '%-14s tinygltf %s %s, lodestar %s %s, ratio %s\n' "$1" \
        "$(awk -v c="$3" '{ print $c }' "$work/rounds" | median)" "$2" \
        "$(awk -v c="$4" '{ print $c }' "$work/rounds" | median)" "$2" \
        "$(awk -v a="$3" -v b="$4" '{ print $b / ($a > 0 ? $a : 0.01) }' "$work/rounds" | median)"
}
report elapsed s 1 4
report processor s 2 5
report memory MiB 3 6
