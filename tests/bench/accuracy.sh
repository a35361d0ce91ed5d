#!/bin/sh
# SPDX-License-Identifier: MIT
# What accuracy costs on this machine, for docs/accuracy: two panoramas that took no part in choosing any constant.
# Usage: tests/bench/accuracy.sh NAME   writes docs/accuracy/NAME.html and NAME.csv; build/lodestar and gnuplot are needed.
set -eu
name=${1:?usage: tests/bench/accuracy.sh NAME}
cd "$(dirname "$0")/../.."
panoramas=${LODESTAR_PANORAMAS:-/usr/share/blender/datafiles/studiolights/world} # of Debian's blender-data
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
build/lodestar cost "$panoramas/city.exr" "$panoramas/studio.exr" -o "$out"
cp "$out/index.html" "docs/accuracy/$name.html"
cp "$out/cost.csv" "docs/accuracy/$name.csv"
