#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A check that finds nothing proves nothing: for each check, a clean tree passes and a tree with one
# planted fault fails, naming it. Usage: selftest.sh CHECK.
set -u
check=${1:?usage: selftest.sh CHECK}
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

# plant FILE LINE...: writes a file into a tree.
plant() {
    mkdir -p "$tree/$(dirname "$1")"
    printf '%s\n' "${@:2}" >"$tree/$1"
}
clean_tree() {
    tree=$(mktemp -d "$scratch/tree.XXXXXX")
    plant runtime/core/a.h '// SPDX-License-Identifier: MIT' '#include <vector>'
    plant runtime/lighting/b.h '// SPDX-License-Identifier: MIT' '#include "core/a.h"' '#include "lodestar/cube.glsl"' '// eq. MIP-1, MIP-2'
    plant runtime/lighting/CMakeLists.txt 'lodestar_library(lighting Lighting DEPENDS Lodestar::Core Lodestar::Shaders)'
    plant shaders/lodestar/cube.glsl '// SPDX-License-Identifier: MIT' '#include "dual.glsl"'
    plant docs/derivations/mip.md 'm = 1 (MIP-1)' 'm = 2 (MIP-2, boxed)'
    cp "$here/../../.clang-format" "$tree/"
}
# expect pass|fail PATTERN: the check's verdict on the tree and a line that it must print.
expect() {
    local output status verdict
    output=$(bash "$here/$check.sh" "$tree" 2>&1)
    status=$?
    if [ $status -eq 77 ]; then
        echo "$output"
        exit 77
    fi
    verdict=pass
    [ $status -eq 0 ] || verdict=fail
    if [ "$verdict" != "$1" ] || ! printf '%s\n' "$output" | grep -qE "$2"; then
        echo "selftest: $check: expected $1 with '$2', got $verdict:"
        printf '%s\n' "$output" | sed 's/^/    /'
        failures=$((failures + 1))
    else
        echo "selftest: $check: $1 '$2' as expected"
    fi
}

clean_tree
case $check in
arrows)
    expect pass ' 0 violations'
    plant runtime/core/c.h '#include "gl/device.h"' && expect fail 'core/c.h:1: runtime/core includes "gl/device.h"'
    clean_tree && plant runtime/lighting/d.cpp '  #  include "io/file.h"' && expect fail 'lighting includes "io/file.h"'
    clean_tree && plant runtime/lighting/d.cpp '#include "../core/a.h"' && expect fail 'from the include root'
    clean_tree && plant runtime/lighting/d.cpp '#include "mystery/a.h"' && expect fail 'no known folder'
    clean_tree && plant runtime/lighting/d.cpp '#include <epoxy/gl.h>' && expect fail 'not for this folder'
    clean_tree && plant runtime/mystery/a.h '#include <vector>' && expect fail 'runtime/mystery.*unknown folder'
    clean_tree && plant runtime/core/CMakeLists.txt 'target_link_libraries(x Lodestar::Scene)' && expect fail 'core links Lodestar::Scene'
    clean_tree && plant shaders/lodestar/x.glsl '#include "host/blocks.glsl"' && expect fail 'shaders/lodestar includes "host'
    tree=$(mktemp -d "$scratch/tree.XXXXXX") && expect fail 'no sources'
    ;;
files)
    expect pass ' 0 violations'
    plant runtime/core/c.h '#pragma once' && expect fail 'c.h: no SPDX'
    clean_tree && plant runtime/core/c.cpp '// SPDX-License-Identifier: MIT' "$(seq 600)" && expect fail 'c.cpp: 601 lines'
    clean_tree && plant README.md "$(seq 151)" && expect fail 'README.md: 151 lines'
    clean_tree && plant docs/a.md "see /wo""rk/a" && expect fail 'a path of one machine'
    clean_tree && plant docs/a.md "from deb.debian.""org" && expect fail 'registry host'
    clean_tree && plant runtime/core/c.h '// SPDX-License-Identifier: MIT' "// TO""DO later" && expect fail 'unfinished work'
    tree=$(mktemp -d "$scratch/tree.XXXXXX") && expect fail 'nothing was checked'
    ;;
format)
    expect pass '2 files checked'
    plant runtime/core/c.cpp 'int  f( ){return 1 ;}' && expect fail 'c.cpp'
    tree=$(mktemp -d "$scratch/tree.XXXXXX") && expect fail 'nothing was checked'
    ;;
equations)
    expect pass ' 0 violations'
    plant runtime/core/c.h '// by MIP-7 and UTF-8' && expect fail 'MIP-7 is cited by runtime/core/c.h'
    clean_tree && plant docs/derivations/mip.md 'm (MIP-1)' 'n (MIP-2)' 'o (MIP-3, boxed)' && expect fail 'MIP-3 is boxed'
    tree=$(mktemp -d "$scratch/tree.XXXXXX") && expect fail 'nothing was checked'
    ;;
named-tests)
    tree=$(mktemp -d "$scratch/tree.XXXXXX") && expect fail 'nothing was checked'
    plant docs/a.md 'see `Suite.HasName` and `Suite.IsAProperty`'
    plant tests/a.cpp 'TEST_F(Suite,' '       HasName) {}' 'RC_GTEST_PROP(Suite, IsAProperty, ()) {}'
    expect pass '2 tests named, 0 violations'
    plant docs/b.md 'and `Suite.HasNam`' && expect fail 'Suite.HasNam is named'
    ;;
*)
    echo "selftest: no such check: $check"
    exit 1
    ;;
esac
[ "$failures" -eq 0 ]
