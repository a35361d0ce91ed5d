#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A program on a virtual display. Usage: on_display.sh PROGRAM ARGUMENTS...
# Exit status 77 (a skip) where there is none to be had.
set -u
for tool in Xvfb xvfb-run xauth; do
    command -v $tool >/dev/null || {
        echo "skipped: needs $tool"
        exit 77
    }
done
# It stays between two viewers, rather than reset after each: a reset refuses who comes meanwhile.
exec xvfb-run -a -s '-screen 0 1024x768x24 -nolisten tcp -noreset' "$@"
