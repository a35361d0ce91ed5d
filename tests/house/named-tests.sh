#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Tests that documents name, `Suite.Name`, exist. Usage: named-tests.sh ROOT.
set -u
cd "${1:?usage: named-tests.sh ROOT}" || exit 1
names=$(grep -rhoE '`[A-Z][A-Za-z0-9]*\.[A-Z][A-Za-z0-9]*`' docs 2>/dev/null | tr -d '`' | LC_ALL=C sort -u)
[ -n "$names" ] || { echo "named-tests: nothing was checked"; exit 1; }
# A macro's arguments may go on in the next line.
sources=$(find tests -name '*.cpp' -exec cat {} + | tr -s ' \n' ' ')
failures=0
for name in $names; do
    if ! printf '%s\n' "$sources" | grep -qE "(TEST|TEST_F|TEST_P|RC_GTEST_PROP)\(${name%.*}, ?${name#*.}[,)]"; then
        echo "named-tests: $name is named in docs and is no test"
        failures=$((failures + 1))
    fi
done
echo "named-tests: $(printf '%s\n' "$names" | wc -l) tests named, $failures violations"
[ "$failures" -eq 0 ]
