#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the build, moves the tree, and builds a C host from it: by find_package and by pkg-config.
# Usage: package.sh BUILD SOURCE
set -eu
build=$(realpath "${1:?usage: package.sh BUILD SOURCE}")
source=$(realpath "${2:?usage: package.sh BUILD SOURCE}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/first" >"$work/log" || { cat "$work/log"; exit 1; }
mv "$work/first" "$work/tree"
mkdir "$work/consumer"
cat >"$work/consumer/CMakeLists.txt" <<TEXT
cmake_minimum_required(VERSION 3.25)
project(Consumer LANGUAGES C)
find_package(Lodestar 0.1 REQUIRED COMPONENTS Plugin)
add_executable(consumer $source/samples/c_host/main.c)
target_link_libraries(consumer PRIVATE Lodestar::Plugin)
TEXT
cmake -S "$work/consumer" -B "$work/consumer/build" -DCMAKE_PREFIX_PATH="$work/tree" >"$work/log" 2>&1 &&
    cmake --build "$work/consumer/build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/consumer/build/consumer" >"$work/first.txt"
export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$work/tree" -name lodestar.pc)")
# shellcheck disable=SC2046 # words of the compiler's
cc -std=c11 -pedantic -Wall -Wextra -Werror "$source/samples/c_host/main.c" -o "$work/second" \
    $(pkg-config --cflags --libs lodestar)
LD_LIBRARY_PATH=$(pkg-config --variable=libdir lodestar) "$work/second" >"$work/second.txt"
cmp "$work/first.txt" "$work/second.txt"
grep -q '^12:00' "$work/first.txt"
echo "built twice from an installed tree"
