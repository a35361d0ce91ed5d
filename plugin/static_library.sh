#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the static library: one object with one global name, its C++ runtime inside, so that it links
# into a program in C as into one of any other C++ runtime.
# Usage: static_library.sh CXX OUTPUT OBJECT-OR-ARCHIVE...
set -eu
cxx=${1:?usage: static_library.sh CXX OUTPUT OBJECT-OR-ARCHIVE...}
output=$2
shift 2
runtime=$("$cxx" -print-file-name=libstdc++.a)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Groups of sections that linkers fold by name are made plain: the host's of the same name are others.
"$cxx" -r -nostdlib -o "$work/whole.o" "$@" "$runtime" -Wl,-u,lodestar_get_api -Wl,--force-group-allocation
objcopy --keep-global-symbol=lodestar_get_api "$work/whole.o" "$work/lodestar.o"
# Unique symbols cannot be made local: they get names that nobody else has.
nm -g --defined-only "$work/lodestar.o" | awk '$NF != "lodestar_get_api" { print $NF, "lodestar_private_" $NF }' >"$work/names"
objcopy --redefine-syms="$work/names" "$work/lodestar.o"
rm -f "$output"
ar rcs "$output" "$work/lodestar.o"
