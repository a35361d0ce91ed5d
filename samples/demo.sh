#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# From a bare Debian 12 to the pictures: installs what is missing, builds, renders. See --help.
set -u
cd "$(dirname "$0")/.." || exit 1
. cmake/packages.sh

usage() {
    cat <<'TEXT'
samples/demo.sh [--help]

Installs the Debian packages that are missing (as root or through sudo), builds Lodestar in build/
(the tree that tests/run.sh uses), computes the demo's panoramas and scenes and renders them into
out/demo/, without a display. Then, from a terminal on a desktop, it shows the last scene in a window; elsewhere
it ends. Some minutes the first time, half a minute after.

Environment: LIBGL_ALWAYS_SOFTWARE=0 renders with the machine's own driver (default 1: llvmpipe).
TEXT
}

case ${1:-} in
"") ;;
--help | -h)
    usage
    exit 0
    ;;
*)
    echo "samples/demo.sh: no such option: $1 (see --help)" >&2
    exit 2
    ;;
esac

view_in_software=${LIBGL_ALWAYS_SOFTWARE:-0} # the window is the machine's own driver's
export LIBGL_ALWAYS_SOFTWARE=${LIBGL_ALWAYS_SOFTWARE:-1}
out=out/demo
assets=$out/assets
parts=$out/parts
total=19
step=0
started=$SECONDS

# next TEXT: says which step begins.
next() {
    step=$((step + 1))
    printf '[%d/%d] %s  (%d s)\n' "$step" "$total" "$*" $((SECONDS - started))
}

stop() {
    echo "samples/demo.sh: $*" >&2
    exit 1
}

# render NAME SCENE OPTIONS...: one picture, parts/NAME.png unless NAME holds a slash.
render() {
    local name=$1 scene=$2 file
    shift 2
    case $name in
    */*) file=$name ;;
    *) file=$parts/$name.png ;;
    esac
    build/lodestar render "$assets/$scene.gltf" -o "$file" "$@" || stop "$file could not be rendered"
}

# sheet NAME OPTIONS...: joins pictures into out/demo/NAME.png.
sheet() {
    local name=$1
    shift
    build/lodestar-compose -o "$out/$name.png" "$@" || stop "$out/$name.png could not be composed"
}

build() {
    local log
    log=$(mktemp)
    # A tree that is there keeps its configuration; the tests need packages that the demo does not.
    if [ ! -f build/CMakeCache.txt ]; then
        configure_build -DLODESTAR_BUILD_TESTS=OFF || stop "the build cannot be configured"
    fi
    if ! cmake --build build --target lodestar lodestar-make-assets lodestar-compose lodestar-day lodestar-panels >"$log" 2>&1; then
        grep -E 'error|FAILED' "$log" | head -n 20 >&2
        rm -f "$log"
        stop "the build failed"
    fi
    rm -f "$log"
}

next "packages"
install_packages build || stop "packages are missing"
next "building lodestar and the demo's programs"
build

next "panoramas and scenes"
mkdir -p "$assets" "$parts" || stop "$out cannot be made"
if [ ! -f "$assets/.made" ] || [ build/lodestar-make-assets -nt "$assets/.made" ]; then
    build/lodestar-make-assets "$assets" || stop "the assets could not be made"
    touch "$assets/.made"
fi

courtyard="--environment $assets/courtyard.exr --exposure -1.3"
studio="--environment $assets/studio.exr"
# shellcheck disable=SC2086 # lists of options
{
    next "figure 1: one shape, seven exponents"
    row="--no-backdrop --size 1232x176 $courtyard"
    render figure1_before figure1 $row --specular bias:0 --diffuse lowest-mip
    render figure1_published figure1 $row --specular mip --diffuse lowest-mip
    render figure1_default figure1 $row
    sheet figure1 --title "One environment map, seven materials" \
        --note "Blinn-Phong exponents of a glossy glaze, no preprocessing of the map" \
        --columns "1|4|16|64|256|1024|mirror" \
        --row "Before: a mirror lookup, whatever the exponent" "$parts/figure1_before.png" \
        --row "As published: one fetch from standard mips, diffuse from the coarsest" "$parts/figure1_published.png" \
        --row "Lodestar's default: one fetch from tent mips, diffuse from an irradiance cube" "$parts/figure1_default.png"

    next "figure 2: exponents by reflectances"
    render figure2_grid figure2 --no-backdrop --size 1232x770 $courtyard
    sheet figure2 --title "Exponents by reflectances" \
        --note "Rows: glaze of F0 0.04, F0 0.2, F0 0.5, gold, silver" \
        --columns "0|1|4|16|64|256|1024|mirror" --row "" "$parts/figure2_grid.png"

    next "figure 3: normal and exponent maps"
    render figure3_flat figure3_flat --size 560x560 $courtyard
    render figure3_normal figure3 --size 560x560 $courtyard
    sheet figure3 --title "A crate: texture decides the gloss" \
        --note "The exponent map is 8 bits of log2(s + 1): worn wood, varnish and iron in one draw" \
        --row "" "$parts/figure3_flat.png::exponent map alone" "$parts/figure3_normal.png::with its normal map" \
        "$assets/crate_exponent.png::the exponent map"

    next "Ashikhmin and Ghosh's figure 1: a least level per object"
    cell="--no-backdrop --size 400x400 $courtyard"
    white="diffuse=0.75,0.72,0.66,f0=0,0,0,exponent=1"
    for level in 0 3.5 5; do
        render "ashikhmin_$level" ashikhmin $cell --specular "bias:$level"
    done
    render ashikhmin_diffuse ashikhmin $cell --diffuse bias:7 --override-material "$white"
    sheet ashikhmin --title "Simple blurry reflections" \
        --note "A least mip level for the whole object, 256 texels a face" --row "" \
        "$parts/ashikhmin_0.png::0" "$parts/ashikhmin_3.5.png::3.5" "$parts/ashikhmin_5.png::5" \
        "$parts/ashikhmin_diffuse.png::7, about the normal"

    next "seams between cube faces, before and after"
    render seams_glossy ashikhmin $cell --specular bias:5 --face-seams
    render seams_diffuse ashikhmin $cell --diffuse bias:7 --override-material "$white" --face-seams
    sheet seams --title "Seams" --note "Each face filtered on its own, and across its edges" --row "" \
        "$parts/seams_glossy.png::level 5, per face" "$parts/ashikhmin_5.png::level 5, seamless" \
        "$parts/seams_diffuse.png::level 7, per face" "$parts/ashikhmin_diffuse.png::level 7, seamless"

    next "estimators side by side"
    row="--no-backdrop --size 1232x246 $studio"
    for estimator in mip mip-floor tent; do
        render "estimators_$estimator" estimators $row --specular $estimator
    done
    sheet estimators --title "One fetch, three ways" --note "White spheres under five soft boxes, by exponent" \
        --columns "2|8|32|128|2048" \
        --row "mip: standard mips, the exponent as given" "$parts/estimators_mip.png" \
        --row "mip-floor: the same, no finer than the pixel" "$parts/estimators_mip-floor.png" \
        --row "tent: mips filtered across faces, fitted direction and level" "$parts/estimators_tent.png"

    next "lobes and Fresnel's reflectance as spherical Gaussians"
    row="--no-backdrop --size 880x176 --environment constant:0,0,0"
    forms="--lobes power --fresnel schlick|--lobes sg|--fresnel sg"
    for form in power lobes fresnel; do
        render "$parts/gaussians-$form.exr" lamps $row ${forms%%|*}
        forms=${forms#*|}
    done
    for form in lobes fresnel; do
        build/lodestar compare "$parts/gaussians-$form.exr" "$parts/gaussians-power.exr" --error-scale 10 \
            -o "$parts/gaussians-$form.png" >"$parts/gaussians-$form.json" || stop "pictures could not be compared"
    done
    sheet gaussians --title "Spherical Gaussians" \
        --note "Exponents 1, 4, 16, 64, 256, F0 0.04, a lamp before them and one past their rims; errors against powers" \
        --row "(n.h)^s and (1 - x)^5" "$parts/gaussians-power.exr" \
        --row "the highlight as a spherical Gaussian, exp(-(s + 3/4) (1 - n.h))" "$parts/gaussians-lobes.exr" \
        --row "and how far it is off" "$parts/gaussians-lobes.png" \
        --row "Fresnel as one, and how far it is off" "$parts/gaussians-fresnel.png"

    next "the terrace"
    render $out/terrace.png terrace --size 1280x720 --camera terrace --environment-width 512 $courtyard
    next "the terrace's table"
    render $out/table.png terrace --size 1280x720 --camera table --environment-width 512 $courtyard
}

next "four skies through the day"
skies="clear overcast golden_hour two_moons"
documents=""
for sky in $skies; do documents="$documents samples/skies/$sky.lodestar.json"; done
# shellcheck disable=SC2086 # a list of documents
build/lodestar-day "$assets/terrace.gltf" "$parts" 200x113 terrace 1,5.5,8,12,17.5,18.8 $documents ||
    stop "the day could not be rendered"
rows=""
for sky in $skies; do
    rows="$rows --row $sky"
    for hour in 1 5.5 8 12 17.5 18.8; do rows="$rows $parts/$sky-$hour.png"; done
done
# shellcheck disable=SC2086
sheet day --title "Four painted skies" --note "Sky and sun are maps of 16 KB; no map is captured or filtered again" \
    --columns "1:00|5:30|8:00|12:00|17:30|18:48" $rows

next "one scene at two hours, its maps inset"
build/lodestar-day "$assets/terrace.gltf" "$parts" 616x462 terrace 10,18.6 samples/skies/clear.lodestar.json ||
    stop "the hours could not be rendered"
for hour in 10 18.6; do
    for light in sky sun; do
        build/lodestar bake samples/skies/clear.lodestar.json --light $light --hour $hour --columns 128 \
            -o "$parts/$light-$hour.exr" >/dev/null || stop "a map could not be baked"
    done
done
sheet hours --title "One scene, two hours" \
    --note "Insets: the filtered maps of the sun and the sky, angle from the axis across, exponents 1 to 2048 down" \
    --row "" "$parts/clear-10.png::10:00" --inset "$parts/sky-10.exr" --inset "$parts/sun-10.exr" \
    "$parts/clear-18.6.png::18:36" --inset "$parts/sky-18.6.exr" --inset "$parts/sun-18.6.exr"

next "the golden hour"
render $out/golden_hour.png terrace --size 1280x720 --camera terrace --hour 18 \
    --lighting samples/skies/golden_hour.lodestar.json

next "light probes through an evening"
probes="--lighting samples/skies/lift.lodestar.json"
rows=""
for camera in courtyard hall lift; do
    rows="$rows --row $camera"
    for hour in 9 17.5 19 21; do
        render "$camera-$hour" lift --size 308x193 --camera $camera --hour $hour $probes
        rows="$rows $parts/$camera-$hour.png"
    done
done
# shellcheck disable=SC2086
sheet lift --title "Light probes" \
    --note "Five probes; the sky is composed behind what they captured, the hall keeps it out" \
    --columns "9:00|17:30|19:00|21:00" $rows

next "dusk in the courtyard, captured long ago and again"
dusk() {
    build/lodestar render "$assets/lift.gltf" --size 308x193 --camera courtyard --frames 30 --fps 10 --hour 15.5 --hours-per-second 1 $probes \
        -o "$parts/$1.exr" --stats "$parts/$1.json" --light-threshold "$2" || stop "dusk could not be rendered"
}
dusk dusk-truth 0
rows=""
for threshold in 0.1 1000; do # the default, and never
    dusk "dusk-$threshold" "$threshold"
    build/lodestar compare "$parts/dusk-$threshold.exr" "$parts/dusk-truth.exr" --error-scale 100 -o "$parts/dusk-$threshold-error.png" >/dev/null ||
        stop "pictures could not be compared"
    rows="$rows --row threshold_$threshold $parts/dusk-$threshold.exr $parts/dusk-$threshold-error.png"
done
# shellcheck disable=SC2086
sheet dusk --title "Bounced light stays as captured until it has changed by more than a threshold" \
    --note "From 15:30 to 18:24; errors against probes captured at every step" --columns "18:24|error" $rows

next "a walk into the hall, two faces of probes a frame"
# shellcheck disable=SC2086
build/lodestar render "$assets/lift.gltf" --size 246x154 --camera Walker --animation walk --frames 100 --fps 5 --hour 17.5 --hours-per-second 0.1 \
    --budget-faces 2 $probes -o "$parts/walk-%04d.png" --stats "$parts/walk.json" || stop "the walk could not be rendered"
sheet walk --title "A walk" --note "From 17:30 to 19:30; the lift moves, and never more than two faces are drawn in a frame" \
    --columns "0 s|6 s|10 s|16 s|20 s" --row "" "$parts/walk-0000.png" "$parts/walk-0030.png" "$parts/walk-0050.png" \
    "$parts/walk-0080.png" "$parts/walk-0099.png"

next "the editor's panels in an engine's own frame"
build/lodestar-panels "$assets/figure2.gltf" --lighting samples/skies/golden_hour.lodestar.json --hour 18 --frames 4 -o "$out/panels.png" ||
    stop "the panels could not be drawn"

echo "done in $((SECONDS - started)) s; look at:"
for picture in figure1 figure2 figure3 ashikhmin seams estimators gaussians terrace table day hours golden_hour lift dusk walk panels; do
    echo "    $out/$picture.png"
done

# On a desktop, and only when someone sits there, the terrace can be walked through.
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && [ -t 0 ]; then
    echo "the terrace in a window (F1 shows the keys, Escape closes):"
    # shellcheck disable=SC2086 # a list of options
    LIBGL_ALWAYS_SOFTWARE=$view_in_software build/lodestar view "$assets/terrace.gltf" --size 1280x720 --camera terrace \
        --environment-width 512 $courtyard || echo "samples/demo.sh: the window could not be shown; the pictures are there" >&2
fi
