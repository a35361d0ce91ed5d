#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A suite that no fault fails proves nothing: the shading text as it is passes the small C++ tests of
# this folder, and each copy with one planted fault fails one of them.
# Usage: planted_faults.sh ROOT COMPILER FLAG... (include paths and libraries of the test frameworks)
set -u
root=${1:?usage: planted_faults.sh ROOT COMPILER FLAG...}
compiler=${2:?usage: planted_faults.sh ROOT COMPILER FLAG...}
frameworks=("${@:3}")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export RC_PARAMS="seed=1 max_success=300" # found or not found, not now and then

flags=(-std=c++20 -O0 -w -I"$root/tests" -I"$root/runtime" -DLODESTAR_TEST_DATA="\"$root/tests\"")
printf '#include <%s>\n' array cmath gtest/gtest.h rapidcheck/gtest.h glm/glm.hpp >"$scratch/all.h"
"$compiler" "${flags[@]}" "${frameworks[@]}" -x c++-header "$scratch/all.h" -o "$scratch/all.h.gch" || exit 1
# What includes no shading text is compiled once.
"$compiler" "${flags[@]}" "${frameworks[@]}" -include "$scratch/all.h" -c "$root/tests/numerics/hazards_test.cpp" \
    -o "$scratch/hazards_test.o" || exit 1

# passes TREE NAME FILE...: builds the tests against a tree of shaders and runs them.
passes() {
    local tree=$1 name=$2
    "$compiler" "${flags[@]}" -I"$tree" -include "$scratch/all.h" "${@:3}" "${frameworks[@]}" -o "$tree/$name" \
        >"$tree/$name.log" 2>&1 || { sed 's/^/    /' "$tree/$name.log" | head -n 20; return 2; }
    "$tree/$name" >"$tree/$name.log" 2>&1
}
# examine TREE NAME WANTED: the cheap tests first; what they find needs no others.
examine() {
    local status=0 here=$root/tests/numerics
    passes "$1" rows "$here/hazard_rows.cpp" "$scratch/hazards_test.o" &&
        passes "$1" functions "$here/shader_properties_test.cpp" &&
        passes "$1" surfaces "$here/surface_properties_test.cpp" &&
        passes "$1" conversion "$here/conversion_test.cpp" || status=$?
    local verdict=passes
    [ $status -eq 0 ] || verdict=fails
    [ $status -ne 2 ] || verdict="does not build"
    local by
    by=$(grep -hoE '^\[  FAILED  \] [A-Za-z0-9]+\.[A-Za-z0-9]+' "$1"/*.log | sort -u | sed 's/.*\] //' | paste -sd' ')
    echo "planted: $2: $verdict ${by:+($by)}"
    [ "$verdict" = "$3" ] || echo "$2" >>"$scratch/wrong"
}
count=0
# plant NAME FILE OLD NEW: a tree in which a text stands once for another.
plant() {
    local tree=$scratch/$((++count)) text
    cp -r "$root/shaders" "$tree"
    text=$(cat "$tree/lodestar/$2")
    printf '%s\n' "${text/"$3"/"$4"}" >"$tree/lodestar/$2"
    if cmp -s "$root/shaders/lodestar/$2" "$tree/lodestar/$2"; then
        echo "planted: $1: '$3' is not in $2"
        echo "$1" >>"$scratch/wrong"
        return
    fi
    # Two at a time.
    [ $((count % 2)) -eq 1 ] || wait
    examine "$tree" "$1" fails &
}

cp -r "$root/shaders" "$scratch/clean"
examine "$scratch/clean" "nothing" passes
plant "level + 1" cube.glsl '- 0.5f * log2(exponent + 1.0f);' '- 0.5f * log2(exponent + 1.0f) + 1.0f;'
plant "exponent doubled" power.glsl 'exp2(s * log2(x))' 'exp2(2.0f * s * log2(x))'
plant "exponent of the lookup doubled" lobes.glsl '0.25f * s + 0.375f' '0.5f * s + 0.375f'
plant "pi missing" lobes.glsl '(8.0f * LODESTAR_PI *' '(8.0f *'
plant "pi missing from Lambert" lobes.glsl '* (1.0f / LODESTAR_PI)' ''
plant "a face flipped" cube.glsl 'vec3(1.0f, -v, -u)' 'vec3(1.0f, -v, u)'
plant "two faces exchanged" cube.glsl 'd.y >= 0.0f ? 2 : 3' 'd.y >= 0.0f ? 3 : 2'
plant "NaN let through" power.glsl 'exponent >= 0.0f ? min(exponent, LODESTAR_MAX_EXPONENT) : 0.0f' \
    'exponent < 0.0f ? 0.0f : min(exponent, LODESTAR_MAX_EXPONENT)'
plant "a footprint of NaN let through" cube.glsl 'floorLevel > level ? min(floorLevel, maxLevel) : level' \
    'floorLevel <= level ? level : min(floorLevel, maxLevel)'
plant "a power of the cosine" power.glsl 'lodestar_cosinePowerFromChord(0.5f * dot(chord, chord), s)' \
    'lodestar_cosinePower(dot(a, b), s)'
plant "a mix from one end" power.glsl 't < 0.5f ? a + t * (b - a) : b + (1.0f - t) * (a - b)' 'a + t * (b - a)'
plant "Schlick not clamped" lobes.glsl 'clamp(1.0f - cosine, Real(0.0f), Real(1.0f))' '1.0f - cosine'
plant "a texel's size the wrong way" cube.glsl '0.75f * log2(dot(p, p))' '-0.75f * log2(dot(p, p))'
plant "ringing not clamped" sh9.glsl 'max(linear + quadratic, vec3(0.0f))' 'linear + quadratic'
plant "a chord not halved" rsrm.glsl '0.5f * sqrt(dot(chord, chord))' 'sqrt(dot(chord, chord))'
plant "occlusion twice" environment.glsl 'fresnel * glossy *' 'fresnel * glossy + lambert *'
plant "a Gaussian of the exponent doubled" sg.glsl 'lodestar_repairExponent(exponent) + rise' '2.0f * lodestar_repairExponent(exponent) + rise'
plant "a Gaussian's integral with its cancellation" sg.glsl 'lodestar_oneMinusExp(2.0f * l)' '(1.0f - exp(-2.0f * l))'
plant "a Gaussian's series left out" sg.glsl 'l < least ?' 'l < 0.0f ?'
plant "a product by its lengths" sg.glsl 'exp(-la * lb * min(dot(chord, chord), Real(4.0f)) /' 'exp(product.sharpness - la - lb + 0.0f * min(dot(chord, chord), Real(4.0f)) /'
plant "parallax from the wrong end" probes.glsl '+ t * direction - captured' '- t * direction - captured'
wait
wrong=0
[ ! -f "$scratch/wrong" ] || wrong=$(wc -l <"$scratch/wrong")
echo "planted: $count faults, $wrong of them or of the clean text judged wrongly"
[ "$count" -gt 0 ] && [ "$wrong" -eq 0 ]
