# SPDX-License-Identifier: MIT
# One library per runtime folder: target lodestar-<name>, alias Lodestar::<Name>.
add_library(lodestar-options INTERFACE)
target_compile_features(lodestar-options INTERFACE cxx_std_20)
target_compile_options(lodestar-options INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
    # gcc 12 reports overlaps of 2^63 bytes in its own string concatenation (GCC bug 105651).
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(LODESTAR_WARNINGS_AS_ERRORS)
    target_compile_options(lodestar-options INTERFACE -Werror)
endif()
if(LODESTAR_SANITIZE)
    set(sanitizers address,undefined)
    if(LODESTAR_SANITIZE STREQUAL "thread")
        set(sanitizers thread)
    endif()
    target_compile_options(lodestar-options INTERFACE -fsanitize=${sanitizers} -fno-omit-frame-pointer)
    target_link_options(lodestar-options INTERFACE -fsanitize=${sanitizers})
endif()

# lodestar_library(name Alias SOURCES ... DEPENDS ... PRIVATE ...)
function(lodestar_library name alias)
    cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE" ${ARGN})
    add_library(lodestar-${name} STATIC ${ARG_SOURCES})
    add_library(Lodestar::${alias} ALIAS lodestar-${name})
    target_include_directories(lodestar-${name} PUBLIC ${PROJECT_SOURCE_DIR}/runtime)
    target_link_libraries(lodestar-${name} PUBLIC ${ARG_DEPENDS}
        PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:lodestar-options>)
endfunction()
