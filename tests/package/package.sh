#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the build, moves the tree, and builds a C host from it: by find_package and by pkg-config, against the shared
# library and the static one; and a C++ host that has the static one beside a C++ runtime of its own.
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
project(Consumer LANGUAGES C CXX)
find_package(Lodestar 0.1 REQUIRED COMPONENTS Plugin PluginStatic)
add_executable(consumer $source/samples/c_host/main.c)
target_link_libraries(consumer PRIVATE Lodestar::Plugin)
add_executable(consumer_static $source/samples/c_host/main.c)
target_link_libraries(consumer_static PRIVATE Lodestar::PluginStatic)
add_executable(consumer_cxx main.cpp)
target_link_libraries(consumer_cxx PRIVATE Lodestar::PluginStatic)
TEXT
cat >"$work/consumer/main.cpp" <<TEXT
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <lodestar/lodestar_probes.h>

static int blocks = 0; // a host's own operators: the library must not use them, nor the host the library's
void* operator new(std::size_t size) {
    ++blocks;
    return std::malloc(size);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

int main() {
    LodestarApi api{};
    api.struct_size = sizeof api;
    LodestarContext* context = nullptr;
    if (lodestar_get_api(LODESTAR_ABI_VERSION, &api) != LODESTAR_OK ||
        api.context_create(nullptr, &context) != LODESTAR_OK) {
        return 1;
    }
    const int before = blocks;
    LodestarEnvironmentDesc desc{};
    desc.struct_size = sizeof desc;
    desc.layout = LODESTAR_ANALYTIC;
    desc.analytic = "gradient:0,1";
    desc.face_width = 32;
    LodestarEnvironment environment = 0;
    const double up[3] = {0, 1, 0};
    double rgb[3] = {};
    if (api.environment_create(context, &desc, &environment) != LODESTAR_OK ||
        api.set_environment(context, environment) != LODESTAR_OK || api.lambert(context, up, rgb) != LODESTAR_OK ||
        blocks != before) {
        return 2;
    }
    LodestarDocument document = 0;
    if (api.document_load(context, "{", 1, &document) != LODESTAR_E_DOCUMENT) { // thrown and caught within
        return 3;
    }
    auto shared = std::make_shared<std::vector<std::string>>(3, std::string(100, 'x'));
    try {
        throw std::runtime_error(shared->at(0));
    } catch (const std::exception& error) {
        std::printf("%.2f %d\\n", rgb[0], static_cast<int>(std::string(error.what()).size()));
    }
    return api.context_destroy(context) == LODESTAR_OK ? 0 : 4;
}
TEXT
cmake -S "$work/consumer" -B "$work/consumer/build" -DCMAKE_PREFIX_PATH="$work/tree" >"$work/log" 2>&1 &&
    cmake --build "$work/consumer/build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/consumer/build/consumer" >"$work/first.txt"
"$work/consumer/build/consumer_static" >"$work/static.txt"
cmp "$work/first.txt" "$work/static.txt"
[ "$("$work/consumer/build/consumer_cxx")" = "0.83 100" ] # the cosine mean of (1 + y) / 2 about +Y is 5/6
export PKG_CONFIG_PATH
PKG_CONFIG_PATH=$(dirname "$(find "$work/tree" -name lodestar.pc)")
# shellcheck disable=SC2046 # words of the compiler's
cc -std=c11 -pedantic -Wall -Wextra -Werror "$source/samples/c_host/main.c" -o "$work/second" \
    $(pkg-config --cflags --libs lodestar)
LD_LIBRARY_PATH=$(pkg-config --variable=libdir lodestar) "$work/second" >"$work/second.txt"
cmp "$work/first.txt" "$work/second.txt"
# shellcheck disable=SC2046 # words of the compiler's
cc -std=c11 -pedantic -Wall -Wextra -Werror "$source/samples/c_host/main.c" -o "$work/third" \
    $(pkg-config --cflags --libs lodestar-static)
"$work/third" >"$work/third.txt"
cmp "$work/first.txt" "$work/third.txt"
if readelf -d "$work/third" | grep -E 'NEEDED.*(lodestar|stdc)'; then
    echo "the static library needs a shared one"
    exit 1
fi
others=$(nm -g --defined-only "$(pkg-config --variable=libdir lodestar)/liblodestar.a" |
    awk 'NF == 3 && $3 != "lodestar_get_api" && $3 !~ /^lodestar_private_/ { print $3 }')
[ -z "$others" ] || { echo "names of the static library: $others"; exit 1; }
grep -q '^12:00' "$work/first.txt"
echo "built five times from an installed tree"
