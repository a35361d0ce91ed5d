#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Which folder may use which (docs/architecture.md): #include lines and CMake links are held against
# one table. Usage: arrows.sh ROOT. Prints every violation; exit status 1 if there is one.
set -u
cd "${1:?usage: arrows.sh ROOT}" || exit 1

# folder: what it uses directly; what those use is allowed too.
table='
shaders/lodestar:
shaders/host: shaders/lodestar
shaders/plugin: shaders/lodestar
runtime/core:
runtime/lighting: runtime/core shaders/lodestar
runtime/document: runtime/lighting
runtime/plan: runtime/lighting
runtime/io: runtime/lighting runtime/document
runtime/gl: runtime/plan shaders/host
runtime/platform: runtime/core
runtime/scene: runtime/io runtime/plan runtime/gl
editor/model: runtime/document runtime/io
editor/ui: editor/model runtime/plan runtime/gl
editor/app: runtime/scene editor/ui runtime/platform
plugin: runtime/document runtime/plan runtime/gl shaders/plugin
plugin/hosts: plugin runtime/io
samples: runtime/scene runtime/platform plugin plugin/hosts editor/ui
tests: editor/app runtime/scene runtime/platform plugin samples
'
# Libraries by other people: the first word is a pattern of the angle include, then the folders that
# may use it. Headers that match no pattern are the standard library's or the system's.
third_party='
^glm/ shaders/lodestar shaders/host shaders/plugin runtime/lighting runtime/document runtime/plan runtime/io runtime/gl runtime/scene editor/app editor/ui editor/model plugin plugin/hosts samples
^epoxy/ runtime/gl runtime/platform runtime/scene editor/ui editor/app plugin plugin/hosts samples
^(GL|EGL|GLES[23]|KHR)/ runtime/platform runtime/gl plugin plugin/hosts
^OpenImageIO/ runtime/io
^(png|jpeglib)\.h runtime/io
^tiny_gltf runtime/io tests
^nlohmann/ runtime/io runtime/document editor/app editor/model samples
^CLI/ editor/app samples
^GLFW/ runtime/platform samples
^imgui editor/ui editor/app samples
^(gtest|gmock|rapidcheck|benchmark)
'

sources() {
    local tops=()
    for top in shaders runtime editor plugin samples tests; do
        [ -d "$top" ] && tops+=("$top")
    done
    [ ${#tops[@]} -gt 0 ] || return 0
    find "${tops[@]}" -type f \( -name '*.h' -o -name '*.cpp' -o -name '*.c' -o -name '*.glsl' \
        -o -name '*.vert' -o -name '*.frag' -o -name CMakeLists.txt \) | LC_ALL=C sort
}

list=$(sources)
[ -n "$list" ] || { echo "arrows: no sources found below $PWD"; exit 1; }
# shellcheck disable=SC2086 # the repository's file names hold no spaces
grep -HnE '^[ \t]*#[ \t]*include|Lodestar::[A-Z]' $list | awk -v table="$table" -v third="$third_party" '
function close_over(folder, seen,    n, parts, i) { # marks what folder may use, transitively
    n = split(uses[folder], parts, " ")
    for (i = 1; i <= n; ++i)
        if (!((folder0, parts[i]) in allowed)) {
            allowed[folder0, parts[i]] = 1
            close_over(parts[i])
        }
}
function folder_of(path,    p) { # the row of the table that a file belongs to, "" if none
    split(path, p, "/")
    if (p[1] == "tests" || p[1] == "samples") return p[1]
    if (p[1] == "plugin") return p[2] == "hosts" ? "plugin/hosts" : "plugin"
    return ((p[1] "/" p[2]) in uses) ? p[1] "/" p[2] : ""
}
function target_of(include, from,    p, n) {
    n = split(include, p, "/")
    if (n == 1) return from
    if (p[1] == "..") return ".."
    if (p[1] == "lodestar") return include ~ /^lodestar\/lodestar(_probes)?\.h$/ ? "plugin" : "shaders/lodestar"
    if (p[1] == "host") return "shaders/host"
    if (p[1] == "plugin" && include ~ /\.glsl$/) return "shaders/plugin"
    if (p[1] == "hosts") return "plugin/hosts"
    if (("runtime/" p[1]) in uses) return "runtime/" p[1]
    if (("editor/" p[1]) in uses) return "editor/" p[1]
    if (from == "tests" || from == "samples") return from
    return ""
}
function bad(message) { print "arrows: " place ": " message; failures++ }
BEGIN {
    n = split(table, rows, "\n")
    for (i = 1; i <= n; ++i)
        if (split(rows[i], cells, ":") == 2) uses[cells[1]] = cells[2]
        else if (rows[i] ~ /:$/) uses[cells[1]] = ""
    for (f in uses) { folder0 = f; close_over(f); allowed[f, f] = 1 }
    m = split(third, rows, "\n")
    for (i = 1; i <= m; ++i)
        if (split(rows[i], cells, " ") > 0) { pattern[++patterns] = cells[1]; users[patterns] = rows[i] " " }
}
{
    match($0, /^[^:]*:[0-9]*:/)
    place = substr($0, 1, RLENGTH - 1)
    text = substr($0, RLENGTH + 1)
    split(place, at, ":")
    from = folder_of(at[1])
    is_cmake = at[1] ~ /CMakeLists.txt$/
    checked++
    if (from == "") {
        if (!is_cmake) bad("an unknown folder; add it to the table in tests/house/arrows.sh")
        next
    }
    if (is_cmake) {
        sub(/#.*/, "", text)
        while (match(text, /Lodestar::[A-Za-z]+/)) {
            alias = substr(text, RSTART + 10, RLENGTH - 10)
            text = substr(text, RSTART + RLENGTH)
            to = alias == "Shaders" ? "shaders/lodestar" : alias == "Plugin" ? "plugin" : ""
            if (to == "") {
                to = "runtime/" tolower(alias)
                if (!(to in uses)) to = "editor/" tolower(substr(alias, 7)) # EditorModel, EditorUi
            }
            if (!((from, to) in allowed)) bad(from " links Lodestar::" alias ", which its arrows do not reach")
        }
        next
    }
    if (match(text, /"[^"]+"/)) {
        include = substr(text, RSTART + 1, RLENGTH - 2)
        to = target_of(include, from)
        if (to == "..") bad("includes \"" include "\": write the path from the include root")
        else if (to == "") bad("includes \"" include "\", which is in no known folder")
        else if (!((from, to) in allowed)) bad(from " includes \"" include "\" of " to ", which its arrows do not reach")
    } else if (match(text, /<[^>]+>/) && from != "tests") {
        include = substr(text, RSTART + 1, RLENGTH - 2)
        for (i = 1; i <= patterns; ++i)
            if (include ~ pattern[i] && index(users[i], " " from " ") == 0)
                bad(from " includes <" include ">, a library that is not for this folder")
    }
}
END {
    if (!checked) { print "arrows: nothing was checked"; exit 1 }
    printf "arrows: %d lines checked, %d violations\n", checked, failures
    exit failures > 0
}'
status=$?

# A folder of a house that is in no row of the table.
for folder in runtime/*/ editor/*/ shaders/*/; do
    folder=${folder%/}
    [ -d "$folder" ] || continue
    if ! printf '%s' "$table" | grep -q "^$folder:"; then
        echo "arrows: $folder: an unknown folder; add it to the table in tests/house/arrows.sh"
        status=1
    fi
done
exit $status
