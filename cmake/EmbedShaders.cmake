# SPDX-License-Identifier: MIT
# Writes OUTPUT, a header that holds every file of FILES (relative to ROOT) as text.
# cmake -DROOT=... -DFILES=a,b -DOUTPUT=... -P EmbedShaders.cmake
cmake_minimum_required(VERSION 3.25)
set(body "// Made by cmake/EmbedShaders.cmake from shaders/.\n#pragma once\n\n#include <string_view>\n\nnamespace lodestar::gl {\n\nstruct EmbeddedShader {\n    std::string_view name;\n    std::string_view text;\n};\n\ninline constexpr EmbeddedShader kEmbeddedShaders[] = {\n")
string(REPLACE "," ";" files "${FILES}")
foreach(file IN LISTS files)
    file(READ ${ROOT}/${file} text)
    string(APPEND body "    {\"${file}\",\n     R\"LODESTAR_TEXT(${text})LODESTAR_TEXT\"},\n")
endforeach()
string(APPEND body "};\n\n} // namespace lodestar::gl\n")
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "@body@" @ONLY)
