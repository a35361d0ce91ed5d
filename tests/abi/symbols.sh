#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The library exports one symbol, keeps none that would pin it in memory, and needs the C library alone.
# Usage: symbols.sh LIBRARY
set -u
library=${1:?usage: symbols.sh LIBRARY}
exported=$(nm -D --defined-only "$library" | awk '{ print $NF }')
if [ "$exported" != lodestar_get_api ]; then
    echo "exported: $exported"
    exit 1
fi
if nm -D "$library" | grep ' u '; then
    echo "a unique symbol keeps the library from being unloaded"
    exit 1
fi
needed=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
[ -n "$needed" ] || { echo "nothing is needed: was readelf understood?"; exit 1; }
for name in $needed; do
    case $name in
    libc.so.* | libm.so.* | ld-linux*) ;;
    *)
        echo "needs $name"
        exit 1
        ;;
    esac
done
echo "one symbol; needs: $(echo "$needed" | tr '\n' ' ')"
