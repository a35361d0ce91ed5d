# SPDX-License-Identifier: MIT
# The Debian 12 packages that the repository needs, and a function that installs the missing ones.
# To be sourced: . cmake/packages.sh; install_packages build test

# openimageio-tools is not used, but the CMake package of libopenimageio-dev refuses to load without it.
LODESTAR_PACKAGES_build="cmake ninja-build g++ pkg-config ca-certificates
    libglm-dev libopenimageio-dev openimageio-tools libtinygltf-dev nlohmann-json3-dev libcli11-dev
    zlib1g-dev libpng-dev libjpeg62-turbo-dev libepoxy-dev libegl-dev libgl-dev libopengl-dev libegl1 libegl-mesa0 libgl1-mesa-dri
    libglfw3-dev libimgui-dev fonts-dejavu-core"
# OpenSceneGraph is a host that is tested; blender-data holds the panoramas that accuracy is measured on; the viewer's window is tested on a
# virtual display by synthetic input (xvfb to imagemagick).
LODESTAR_PACKAGES_test="libgtest-dev librapidcheck-dev clang-format-14 blender-data python3-jsonschema libopenscenegraph-dev
    xvfb xauth x11-utils xdotool openbox imagemagick gnuplot-nox"
LODESTAR_PACKAGES_bench="libbenchmark-dev libfilament-tools"
LODESTAR_PACKAGES_long="clang-14 clang-tidy-14"

# install_packages GROUP...: installs what is missing, as root or through sudo. One line of progress;
# the installer's own output is shown only if it fails.
install_packages() {
    local group name missing="" elevate="" log status
    for group in "$@"; do
        eval "group=\$LODESTAR_PACKAGES_$group"
        for name in $group; do
            case $(dpkg-query -W -f='${Status}' "$name" 2>/dev/null) in
            "install ok installed") ;;
            *) missing="$missing $name" ;;
            esac
        done
    done
    [ -n "$missing" ] || return 0
    if ! command -v apt-get >/dev/null; then
        echo "lodestar: missing packages, and this is no Debian system to install them on:$missing" >&2
        return 1
    fi
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "lodestar: missing packages; run as root or install sudo, or install them yourself:$missing" >&2
            return 1
        fi
        elevate="sudo"
    fi
    echo "installing:$missing"
    log=$(mktemp)
    # shellcheck disable=SC2086 # a list of words
    if ! { DEBIAN_FRONTEND=noninteractive $elevate apt-get -q update &&
        $elevate env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends install $missing; } >"$log" 2>&1 </dev/null; then
        tail -n 20 "$log" >&2
        echo "lodestar: the packages could not be installed:$missing" >&2
        status=1
    else
        status=0
    fi
    rm -f "$log"
    return $status
}

# configure_build OPTION...: one optimised build tree for tests and samples, in build/.
configure_build() {
    local log status=0
    log=$(mktemp)
    cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release "$@" >"$log" 2>&1 || status=1
    [ $status -eq 0 ] || tail -n 30 "$log" >&2
    rm -f "$log"
    return $status
}
