#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# osg-threads under the thread sanitizer, in build-tsan/: no report at all, without light probes and
# with them; and with the planted fault, reports of it. OpenSceneGraph and Mesa are not instrumented: of them the sanitizer sees
# locks, threads and memcpy. Exit status 77 (a skip) where OpenSceneGraph or Xvfb is missing.
set -u
cd "$(dirname "$0")/../.." || exit 1
bash tests/hosts/on_display.sh true
[ $? -eq 77 ] && exit 77
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# Mesa's own drawing threads end each other's waiting by futexes, which the sanitizer does not see:
# without them Mesa draws in OpenSceneGraph's draw thread. No report is suppressed.
export LIBGL_ALWAYS_SOFTWARE=1 LP_NUM_THREADS=0

if ! cmake -S . -B build-tsan -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DLODESTAR_SANITIZE=thread \
    -DLODESTAR_BUILD_SAMPLES=OFF >"$log" 2>&1; then
    tail -n 20 "$log"
    exit 1
fi
grep -q 'No OpenSceneGraph' "$log" &&
    { echo 'thread sanitizer: skipped: needs OpenSceneGraph'; exit 77; }
if ! cmake --build build-tsan --parallel "$(nproc)" --target osg-threads >"$log" 2>&1; then
    grep -E 'error|FAILED' "$log" | head -n 20
    exit 1
fi

# The sanitizer's map of memory does not know all that a kernel's randomised addresses may take.
fixed=()
setarch -R true 2>/dev/null && fixed=(setarch -R)
run() {
    TSAN_OPTIONS=history_size=4 "${fixed[@]}" bash tests/hosts/on_display.sh build-tsan/osg-threads \
        --frames 12 "$@" >"$log" 2>&1
}

clean() { # NAME ARGUMENTS...
    local name=$1
    shift
    run "$@"
    local status=$?
    if [ $status -ne 0 ] || grep -q 'WARNING: ThreadSanitizer' "$log"; then
        echo "thread sanitizer: $name: exit status $status"
        head -n 60 "$log"
        exit 1
    fi
    echo "thread sanitizer: $name: $(grep -c ' 0 saw their light change; ' "$log") threading models without a report"
}
clean 'a day'
clean 'light probes' --probes

run --plant
reports=$(grep -c 'SUMMARY: ThreadSanitizer: data race .*osghost\|SUMMARY: ThreadSanitizer: data race .*lights\.cpp' "$log")
if [ "$reports" -eq 0 ]; then
    echo 'thread sanitizer: the planted race was not found'
    head -n 60 "$log"
    exit 1
fi
echo "thread sanitizer: the planted race was found, $reports reports"
