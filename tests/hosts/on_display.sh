#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A program on a virtual display. Usage: on_display.sh PROGRAM ARGUMENTS...
# Exit status 77 (a skip) where there is none to be had.
set -u
if ! command -v Xvfb >/dev/null || ! command -v xvfb-run >/dev/null; then
    echo 'skipped: needs Xvfb'
    exit 77
fi
# It stays between two viewers, rather than reset after each: a reset refuses who comes meanwhile.
exec xvfb-run -a -s '-screen 0 1024x768x24 -nolisten tcp -noreset' "$@"
