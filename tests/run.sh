#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds Lodestar and runs its tests, from a bare Debian 12 on. See --help.
set -u
cd "$(dirname "$0")/.." || exit 1
. cmake/packages.sh

usage() {
    cat <<'TEXT'
tests/run.sh [--quick | --long] [--help]

Installs the Debian packages that are missing, builds everything in build/ (the tree that
samples/demo.sh uses), and runs every kind of test but the benchmarks; then the tests of untrusted
input again under the address and undefined-behaviour sanitizers, in build-asan/.

  --quick   label unit only, no sanitizers: the inner loop
  --long    sanitizers over unit, numerics, parity and gl as well, ten times the fuzzing, 400 kills, clang-tidy;
            the thread sanitizer over OpenSceneGraph's threading models, in build-tsan/; Khronos' glTF validator, where npm can install it
  --help    this text

One label alone: ctest --test-dir build -L parity
Environment: LODESTAR_REQUIRE_GL=0 lets tests skip where there is no OpenGL (default 1: they fail);
LIBGL_ALWAYS_SOFTWARE=0 uses the machine's own driver (default 1: llvmpipe, the reference);
LODESTAR_TEST_JOBS tests at a time (default: the number of cores).

The last line is "N passed, N failed, N skipped"; the exit status is 0 if nothing failed.
TEXT
}

mode=normal
for argument in "$@"; do
    case $argument in
    --quick) mode=quick ;;
    --long) mode=long ;;
    --help | -h)
        usage
        exit 0
        ;;
    *)
        echo "tests/run.sh: no such option: $argument (see --help)" >&2
        exit 2
        ;;
    esac
done

export LODESTAR_REQUIRE_GL=${LODESTAR_REQUIRE_GL:-1}
export LIBGL_ALWAYS_SOFTWARE=${LIBGL_ALWAYS_SOFTWARE:-1}
jobs=${LODESTAR_TEST_JOBS:-$(nproc)}
passed=0
failed=0
skipped=0
started=$SECONDS
say() { printf '%s  [%d s]\n' "$*" $((SECONDS - started)); }

finish() {
    echo
    echo "$passed passed, $failed failed, $skipped skipped"
    [ "$failed" -eq 0 ] && exit 0
    exit 1
}
# stop MESSAGE: what makes all further tests pointless.
stop() {
    say "tests/run.sh: $1"
    failed=$((failed + 1))
    finish
}

# count TITLE TREE CTEST-ARGUMENTS...: runs ctest and adds up the single tests inside each program.
count() {
    local title=$1 tree=$2 report reasons
    shift 2
    report=$(mktemp)
    ctest --test-dir "$tree" -j "$jobs" --output-junit "$report" --output-on-failure \
        --test-output-size-passed 1000000 --test-output-size-failed 1000000 "$@" >"$report.log" 2>&1
    local status=$?
    # GoogleTest says "[  PASSED  ] 12 tests."; a test that is no GoogleTest counts as one.
    local counts
    counts=$(awk '
        function flush() {
            if (name == "") return
            if (sp + fp + kp == 0) { # not a GoogleTest, or one that died before its summary
                if (state == "run") sp = 1; else if (state == "fail") fp = 1; else kp = 1
            } else if (state == "fail" && fp == 0) fp = 1
            p += sp; f += fp; k += kp
            name = ""
        }
        /<testcase / {
            flush()
            name = $0; sub(/.*<testcase name="/, "", name); sub(/".*/, "", name)
            state = $0; sub(/.*status="/, "", state); sub(/".*/, "", state)
            sp = fp = kp = 0; total++
        }
        match($0, /\[  PASSED  \] [0-9]+ test/) { sp = number($0) }
        match($0, /\[  SKIPPED \] [0-9]+ test/) { kp = number($0) }
        match($0, /\[  FAILED  \] [0-9]+ test/) { fp = number($0) }
        function number(line,    t) { t = substr(line, RSTART + 13); return t + 0 }
        END { flush(); print p + 0, f + 0, k + 0, total + 0 }' "$report")
    local p f k total
    read -r p f k total <<<"$counts"
    if [ "$total" -eq 0 ]; then
        echo "    $title: no tests were found"
        tail -n 5 "$report.log"
        f=1
    fi
    if [ "$status" -ne 0 ] && [ "$f" -eq 0 ]; then
        f=1 # ctest's own word stands
    fi
    passed=$((passed + p))
    failed=$((failed + f))
    skipped=$((skipped + k))
    if [ "$f" -gt 0 ]; then
        # What failed, without the tests that passed.
        awk '/^ *[0-9]+\/[0-9]+ Test.*(\*\*\*|Failed)/ || /Failure$/ { show = 12 } show-- > 0 { print "    " $0 }' "$report.log" | head -n 200
    fi
    say "$(printf '%-28s %4d passed %3d failed %3d skipped' "$title" "$p" "$f" "$k")"
    if [ "$k" -gt 0 ]; then
        reasons=$(awk '/: Skipped$/ { getline; print } /skipped: / { sub(/.*skipped: /, ""); print }' "$report" |
            sed 's/&lt;/</g; s/&gt;/>/g; s/&quot;/"/g; s/&apos;/'"'"'/g; s/&amp;/\&/g' | sort | uniq -c)
        printf '%s\n' "$reasons" | sed 's/^ *\([0-9]*\) /      skipped \1: /'
    fi
    rm -f "$report" "$report.log"
}

# build TREE TARGETS...
build() {
    local tree=$1 log
    shift
    log=$(mktemp)
    if ! cmake --build "$tree" --parallel "$(nproc)" --target "$@" >"$log" 2>&1; then
        grep -E 'error|Error|FAILED' "$log" | head -n 40
        rm -f "$log"
        return 1
    fi
    grep -E 'warning:' "$log" | sort -u | head -n 20
    rm -f "$log"
}

groups="build test"
[ $mode = long ] && groups="$groups long"
# shellcheck disable=SC2086
install_packages $groups || stop "packages are missing"
configure_build -DLODESTAR_BUILD_TESTS=ON || stop "the build cannot be configured"
say "building"
if [ $mode = quick ]; then
    build build all || stop "the build failed"
    count unit build -L '^unit$'
    finish
fi
build build all || stop "the build failed"
say "built"

if [ $mode = long ] && command -v npm >/dev/null; then
    npm install --silent --no-audit --no-fund --prefix build/validator gltf-validator@2.0.0-dev.3.10 ||
        say "gltf-validator was not installed; its test is a skip"
fi
count house build -L '^house$'
# All labels at once, so that no core waits for the last test of each.
count "all others" build -LE '^(house|bench)$'
[ -z "$(ctest --test-dir build -N -LE '.' | sed -n 's/^Total Tests: //p' | grep -vx 0)" ] || stop "a test has no label"

say "building with sanitizers"
cmake -S . -B build-asan -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DLODESTAR_SANITIZE=ON \
    -DLODESTAR_BUILD_SAMPLES=OFF >/dev/null 2>&1 || stop "the sanitizer build cannot be configured"
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=0:allocator_may_return_null=1}
export UBSAN_OPTIONS=${UBSAN_OPTIONS:-halt_on_error=1:print_stacktrace=1}
if [ $mode = long ]; then
    export LODESTAR_FUZZ_FACTOR=10 RC_PARAMS="max_success=1000"
    build build-asan all || stop "the sanitizer build failed"
    LODESTAR_MONKEY_FRAMES=10000000 count "editor, 10 million frames" build -R '^editor_monkey_test$'
    count "editor, killed 400 times" build -R '^editor_kill_test$' --timeout 1800
    LODESTAR_FUZZ_FACTOR=1 count "sanitized editor" build-asan -L '^editor$' --timeout 1800
    count "sanitized unit" build-asan -L '^unit$' --timeout 1800
    count "sanitized numerics" build-asan -L '^numerics$' --timeout 3600
    count "sanitized parity" build-asan -L '^parity$' --timeout 1800
    count "sanitized gl" build-asan -L '^gl$' --timeout 1800
    say "thread sanitizer"
    bash tests/hosts/thread_sanitizer.sh
    case $? in
    0) passed=$((passed + 1)) ;;
    77) skipped=$((skipped + 1)) ;;
    *) failed=$((failed + 1)) ;;
    esac
    say "clang-tidy"
    if bash tests/tidy.sh; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
    fi
else
    build build-asan tests/unit/io/all || stop "the sanitizer build failed"
    count "sanitized io" build-asan/tests/unit/io
fi
finish
