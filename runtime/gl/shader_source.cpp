// SPDX-License-Identifier: MIT
#include "gl/shader_source.h"

#include <algorithm>

#include "gl/embedded_shaders.h"

namespace lodestar::gl {
namespace {

constexpr std::string_view kInclude = "#include \"";

std::string_view folderOf(std::string_view name) {
    const std::size_t slash = name.rfind('/');
    return slash == std::string_view::npos ? std::string_view{} : name.substr(0, slash + 1);
}

/// Appends a file's lines, replacing includes; `done` holds the files in the order of their
/// numbers.
core::Result<void> append(std::string_view name, std::vector<std::string>& done, std::string& out) {
    if (std::find(done.begin(), done.end(), name) != done.end()) {
        return {};
    }
    std::string_view text = shaderFile(name);
    if (text.empty()) {
        return core::Error{
            core::ErrorCode::Internal, "no such shader file is built in", std::string(name), {}};
    }
    const std::size_t number = done.size();
    done.emplace_back(name);
    out += "#line 1 " + std::to_string(number) + "\n";
    int line = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view current = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++line;
        if (current.substr(0, kInclude.size()) != kInclude) {
            out.append(current).append("\n");
            continue;
        }
        const std::string_view target =
            current.substr(kInclude.size(), current.rfind('"') - kInclude.size());
        std::string resolved = std::string(folderOf(name)) + std::string(target);
        if (shaderFile(resolved).empty()) {
            resolved = target;
        }
        if (auto included = append(resolved, done, out); !included) {
            return included;
        }
        out += "#line " + std::to_string(line + 1) + " " + std::to_string(number) + "\n";
    }
    return {};
}

} // namespace

std::string_view shaderFile(std::string_view name) {
    for (const EmbeddedShader& shader : kEmbeddedShaders) {
        if (shader.name == name) {
            return shader.text;
        }
    }
    return {};
}

std::vector<std::string_view> shaderFileNames() {
    std::vector<std::string_view> names;
    for (const EmbeddedShader& shader : kEmbeddedShaders) {
        names.push_back(shader.name);
    }
    return names;
}

core::Result<std::string> assembleShader(std::string_view name, int version,
                                         const Defines& defines) {
    std::string text = "#version " + std::to_string(version) + " core\n";
    for (const auto& [macro, value] : defines) {
        text += "#define " + macro + " " + value + "\n";
    }
    std::vector<std::string> done;
    if (auto appended = append(name, done, text); !appended) {
        return appended.error();
    }
    return text;
}

} // namespace lodestar::gl
