// SPDX-License-Identifier: MIT
//
// The text of shaders/lodestar: every function has a parity row, no file declares what belongs to a
// host, and each compiles alone as GLSL. (Alone as C++: the object library parity-alone.)
#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "gl/program.h"
#include "parity/rows.h"
#include "support/gl_fixture.h"

namespace lodestar::testing {
namespace {

const std::vector<std::string> kFiles = {LODESTAR_DUAL_FILES};

std::string withoutComments(std::string text) {
    text = std::regex_replace(text, std::regex("//[^\n]*"), "");
    return std::regex_replace(text, std::regex("/\\*[^*]*\\*/"), "");
}

std::string readDual(const std::string& name) {
    std::ifstream file(std::string(LODESTAR_SHADERS) + "/lodestar/" + name);
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_FALSE(text.str().empty()) << name;
    return withoutComments(text.str());
}

/// Functions that a text defines.
std::set<std::string> functionsOf(const std::string& text) {
    const std::regex definition("LODESTAR_FN\\s+\\w+\\s+(\\w+)\\s*\\(");
    std::set<std::string> names;
    for (std::sregex_iterator i(text.begin(), text.end(), definition), end; i != end; ++i) {
        names.insert((*i)[1]);
    }
    return names;
}

TEST(DualText, EveryFunctionHasAParityRow) {
    std::set<std::string> inRows;
    for (const ParityRow& row : parityRows()) {
        inRows.insert(row.function);
    }
    std::size_t found = 0;
    for (const std::string& file : kFiles) {
        const std::set<std::string> names = functionsOf(readDual(file));
        found += names.size();
        for (const std::string& name : names) {
            EXPECT_TRUE(inRows.contains(name)) << file << ": " << name << " has no parity row";
            inRows.erase(name);
        }
    }
    EXPECT_GT(found, 0u);
    for (const std::string& name : inRows) {
        ADD_FAILURE() << "a parity row names " << name << ", which no file defines";
    }
}

TEST(DualText, FindsAPlantedFunction) {
    EXPECT_EQ(
        functionsOf("LODESTAR_FN vec3 lodestar_new(vec3 a) {\nLODESTAR_FN  Real\nother (Real b)"),
        (std::set<std::string>{"lodestar_new", "other"}));
}

// Every function definition starts with LODESTAR_FN, or the completeness test would not see it.
TEST(DualText, NoFunctionHidesFromTheList) {
    const std::regex definition(
        "(^|\n)[ \t]*(\\w+[ \t]+)?(Real|float|int|bool|void|vec[234]|mat3|Lodestar\\w+)"
        "[ \t]+(lodestar_\\w+)[ \t]*\\([^;{]*\\)\\s*\\{");
    for (const std::string& file : kFiles) {
        const std::string text = readDual(file);
        for (std::sregex_iterator i(text.begin(), text.end(), definition), end; i != end; ++i) {
            EXPECT_EQ((*i)[2].str().substr(0, 11), "LODESTAR_FN") << file << ": " << (*i)[4];
        }
    }
}

TEST(DualText, DeclaresNothingOfTheHosts) {
    const std::regex forbidden(
        "#\\s*version|\\bmain\\s*\\(|\\buniform\\b|\\bsampler\\w*\\b|\\blayout\\s*\\(|"
        "\\bgl_\\w+|\\btexture\\w*\\s*\\(|\\bdFd[xy]\\s*\\(");
    for (const std::string& file : kFiles) {
        std::smatch found;
        const std::string text = readDual(file);
        EXPECT_FALSE(std::regex_search(text, found, forbidden)) << file << ": " << found.str();
    }
    const std::string planted = "uniform samplerCube map;";
    EXPECT_TRUE(std::regex_search(planted, forbidden));
}

TEST(DualText, EveryFileOnDiskIsListedHereAndEmbedded) {
    const std::vector<std::string_view> embedded = gl::shaderFileNames();
    for (const std::string& file : kFiles) {
        EXPECT_EQ(std::count(embedded.begin(), embedded.end(), "lodestar/" + file), 1) << file;
    }
    for (const std::string_view name : embedded) {
        if (name.substr(0, 9) == "lodestar/") {
            EXPECT_EQ(std::count(kFiles.begin(), kFiles.end(), name.substr(9)), 1) << name;
        }
    }
}

class DualTextGl : public GlTest {};

TEST_F(DualTextGl, EachFileCompilesAlone) {
    const std::vector<std::pair<int, int>> versions = {{330, 33}, {410, 41}, {450, 45}};
    int compiled = 0;
    for (const std::string& file : kFiles) {
        for (const auto& [version, needed] : versions) {
            if (device().capabilities().version < needed) {
                continue;
            }
            for (int specular = 0; specular < kSpecularVariants; ++specular) {
                auto text =
                    gl::assembleShader("lodestar/" + file, version,
                                       {{"LODESTAR_SPECULAR", std::to_string(specular)},
                                        {"LODESTAR_RSRM_ROWS", std::to_string(specular % 2)}});
                ASSERT_TRUE(text.ok()) << text.error().message();
                if (text->find("lodestar_host_cube(int") != std::string::npos) {
                    *text +=
                        "vec4 lodestar_host_cube(int s, vec3 d, float l) { return vec4(d, l); }\n"
                        "vec3 lodestar_host_irradiance(int s, vec3 n) { return n; }\n";
                }
                if (text->find("lodestar_host_rsrm(Real") != std::string::npos) {
                    *text += "vec4 lodestar_host_rsrm(float c, float r, int l) {"
                             " return vec4(c, r, l, 1.0); }\n"
                             "vec3 lodestar_host_rsrmLambert(float u, int l) { return vec3(u); }\n"
                             "vec3 lodestar_host_rsrmGradient(float u, int l) { return vec3(u); }\n"
                             "vec4 lodestar_host_rsrmOctaves(int i) { return vec4(i); }\n";
                }
                const auto function =
                    GlslFunction::make(device(), version, *text, "vec4(LODESTAR_PI) + p0");
                EXPECT_TRUE(function.ok())
                    << file << " under " << version << ": " << function.error().message();
                ++compiled;
            }
        }
    }
    EXPECT_GE(compiled, static_cast<int>(kFiles.size()) * kSpecularVariants);
}

} // namespace
} // namespace lodestar::testing
