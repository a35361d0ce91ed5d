// SPDX-License-Identifier: MIT
#include "parity/cases.h"
#include "parity/draw.h"

#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lodestar::testing {
namespace {

constexpr int kDrawn = 300;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
const float kNan = std::numeric_limits<float>::quiet_NaN();

const std::vector<float> kValidExponents = {0.0f,  1e-3f, 0.5f,    1.0f, 2.0f,       7.3f,  64.0f,
                                            96.0f, 1e3f,  16384.f, 1e5f, 9999999.0f, 1.0e7f};
const std::vector<float> kInvalidExponents = {-0.0f,     -3.0f,      1.5e7f, 1e30f,
                                              kInfinity, -kInfinity, kNan};

class Draw : public DrawnNumbers {
public:
    using DrawnNumbers::DrawnNumbers;
    glm::vec3 unit() {
        while (true) {
            const glm::vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            const float squared = glm::dot(v, v);
            if (squared > 0.01f && squared <= 1.0f) {
                return v / std::sqrt(squared);
            }
        }
    }
    /// A unit vector at least `least` above the plane of n.
    glm::vec3 above(const glm::vec3& n, float least) {
        while (true) {
            const glm::vec3 v = unit();
            if (glm::dot(n, v) > least) {
                return v;
            }
        }
    }
    float exponent() {
        const std::size_t i = random_() % (3 * kValidExponents.size());
        return i < kValidExponents.size() ? kValidExponents[i] : logarithmic(1e-2f, 1e7f);
    }
};

GlslCase firstOf(float x, float y = 0.0f, float z = 0.0f, float w = 0.0f) {
    GlslCase inputs{};
    inputs[0] = glm::vec4(x, y, z, w);
    return inputs;
}

/// Every exponent of the list with widths and chains, then drawn ones.
std::vector<GlslCase> exponentsWithWidths(const std::vector<float>& exponents, unsigned seed) {
    std::vector<GlslCase> cases;
    for (const float exponent : exponents) {
        for (const int maxLevel : {0, 6, 8, 12}) {
            cases.push_back(
                firstOf(exponent, static_cast<float>(1 << maxLevel), static_cast<float>(maxLevel)));
        }
    }
    Draw draw(seed);
    for (int i = 0; i < kDrawn; ++i) {
        cases.push_back(firstOf(draw.logarithmic(1e-3f, 1e7f), std::floor(draw.uniform(1, 2048)),
                                std::floor(draw.uniform(0, 12))));
    }
    return cases;
}

std::vector<float> allExponents() {
    std::vector<float> all = kValidExponents;
    all.insert(all.end(), kInvalidExponents.begin(), kInvalidExponents.end());
    return all;
}

std::vector<GlslCase> vectors(const std::vector<glm::vec3>& first) {
    std::vector<GlslCase> cases;
    const auto add = [&](const glm::vec3& v) {
        GlslCase inputs{};
        inputs[0] = glm::vec4(v, 0.0f);
        inputs[1] = glm::vec4(0.0f, 1.0f, 0.0f, 0.0f);
        cases.push_back(inputs);
    };
    for (const glm::vec3& v : first) {
        add(v);
    }
    for (const float x : {-1.0f, 0.0f, 1.0f}) { // axes, edges, corners: ties of the faces
        for (const float y : {-1.0f, 0.0f, 1.0f}) {
            for (const float z : {-1.0f, 0.0f, 1.0f}) {
                add({x, y, z});
            }
        }
    }
    Draw draw(3u);
    for (int i = 0; i < kDrawn; ++i) {
        add(draw.unit() * draw.logarithmic(1e-3f, 1e3f));
    }
    return cases;
}

} // namespace

std::vector<GlslCase> exponentCases() {
    return exponentsWithWidths(allExponents(), 1u);
}
std::vector<GlslCase> validExponentCases() {
    return exponentsWithWidths(kValidExponents, 2u);
}

std::vector<GlslCase> unitIntervalCases() {
    std::vector<GlslCase> cases;
    for (const float x : {0.0f, 1.0f, -0.5f, 1.5f, 1e-30f, 1e-6f, 0.003f, 0.0032f, 0.04f, 0.041f,
                          0.5f, 0.99999f, kInfinity, -kInfinity}) {
        cases.push_back(firstOf(x));
    }
    for (int i = 1; i < 400; ++i) {
        cases.push_back(firstOf(static_cast<float>(i) / 400.0f));
    }
    return cases;
}

std::vector<GlslCase> radianceCases() {
    std::vector<GlslCase> cases;
    for (const float x : {0.0f, -1.0f, 1.0f, 65504.0f, 1e9f, kInfinity, 1e-30f}) {
        cases.push_back(firstOf(x));
    }
    Draw draw(4u);
    for (int i = 0; i < kDrawn; ++i) {
        cases.push_back(firstOf(draw.logarithmic(1e-6f, 1e6f)));
    }
    return cases;
}

std::vector<GlslCase> cosineAndExponentCases() {
    std::vector<GlslCase> cases;
    for (const float x :
         {-1.0f, -0.5f, 0.0f, 1e-6f, 0.3f, 0.5f, 0.99f, 0.9999999f, 1.0f, 1.00000012f}) {
        for (const float s : {0.0f, 0.5f, 2.0f, 64.0f, 1e3f}) {
            cases.push_back(firstOf(x, s));
        }
    }
    Draw draw(5u);
    for (int i = 0; i < kDrawn; ++i) {
        cases.push_back(firstOf(draw.uniform(0, 1), draw.exponent()));
    }
    return cases;
}

std::vector<GlslCase> exponentAndUnitCases() {
    std::vector<GlslCase> cases;
    for (const float s : allExponents()) {
        for (const float x : {0.0f, 1e-4f, 0.25f, 0.5f, 1.0f}) {
            cases.push_back(firstOf(s, x));
        }
    }
    Draw draw(6u);
    for (int i = 0; i < kDrawn; ++i) {
        cases.push_back(firstOf(draw.logarithmic(1e-3f, 1e7f), draw.uniform(0, 1)));
    }
    return cases;
}

std::vector<GlslCase> chordCases() {
    std::vector<GlslCase> cases;
    // (1e-4 rad, 1e7) and (1e-6, 1e5): where a power of the cosine fails.
    for (const auto& [d, s] : {std::pair{5e-9f, 1e7f},
                               {1e-6f, 1e5f},
                               {0.0f, 0.0f},
                               {0.0f, 1e7f},
                               {1.0f, 0.0f},
                               {1.0f, 3.0f},
                               {2.0f, 0.0f},
                               {2.0f, 1e7f},
                               {0.5f, 0.0f},
                               {0.0099f, 64.0f},
                               {0.0101f, 64.0f},
                               {0.99f, 1.0f}}) {
        cases.push_back(firstOf(d, s));
    }
    Draw draw(7u);
    for (int i = 0; i < kDrawn; ++i) {
        cases.push_back(firstOf(draw.logarithmic(1e-9f, 1.0f), draw.exponent()));
    }
    return cases;
}

std::vector<GlslCase> vectorPairCases() {
    std::vector<GlslCase> cases;
    Draw draw(8u);
    for (int i = 0; i < kDrawn; ++i) {
        const glm::vec3 a = draw.unit();
        const float apart = draw.logarithmic(1e-5f, 1.0f);
        GlslCase inputs{};
        inputs[0] = glm::vec4(a, draw.exponent());
        inputs[1] = glm::vec4(glm::normalize(a + apart * draw.unit()), 0.0f);
        cases.push_back(inputs);
    }
    cases[0][1] = glm::vec4(glm::vec3(cases[0][0]), 0.0f);  // equal
    cases[1][1] = glm::vec4(-glm::vec3(cases[1][0]), 0.0f); // opposite
    return cases;
}

std::vector<GlslCase> mixCases() {
    std::vector<GlslCase> cases;
    Draw draw(18u);
    const auto radiance = [&] {
        return glm::vec3(draw.logarithmic(1e-6f, 1e9f), draw.logarithmic(1e-6f, 1e9f), 0.0f);
    };
    for (int i = 0; i < kDrawn; ++i) {
        GlslCase inputs{};
        inputs[0] = glm::vec4(radiance(), static_cast<float>(i % 3) * 0.5f);
        inputs[1] = glm::vec4(radiance(), 0.0f);
        if (i % 2 == 0) {
            inputs[0].w = draw.uniform(0, 1);
        }
        cases.push_back(inputs);
    }
    return cases;
}

std::vector<GlslCase> anyVectorCases() {
    return vectors({{0, 0, 0},
                    {-0.0f, 0, 0},
                    {1e-20f, 0, 0},
                    {0, -1e-18f, 1e-19f},
                    {1e-14f, 0, 0},
                    {1e18f, 1, 0},
                    {3e14f, 0, -1e14f},
                    {1, 0.9999999f, -1},
                    {0, 3, -3}});
}

std::vector<GlslCase> moderateVectorCases() {
    return vectors(
        {{0, 0, 0}, {-0.0f, 0, 0}, {1e-20f, 0, 0}, {0, -1e-18f, 1e-19f}, {3e9f, 0, -1e9f}});
}

std::vector<GlslCase> faceCases() {
    std::vector<GlslCase> cases;
    for (int face = 0; face < 6; ++face) {
        for (const float u : {-1.0f, -0.3f, 0.0f, 1.0f}) {
            for (const float v : {-1.0f, 0.0f, 0.7f, 1.0f}) {
                cases.push_back(firstOf(static_cast<float>(face), u, v));
            }
        }
    }
    return cases;
}

std::vector<GlslCase> footprintCases() {
    std::vector<GlslCase> cases;
    Draw draw(9u);
    for (int i = 0; i < kDrawn; ++i) {
        GlslCase inputs{};
        const glm::vec3 d = draw.unit();
        // Across d, as a reflection vector changes; along it nothing would be left but rounding.
        const glm::vec3 dx = glm::cross(d, draw.unit()) * draw.logarithmic(1e-4f, 0.3f);
        const glm::vec3 dy = glm::cross(d, draw.unit()) * draw.logarithmic(1e-4f, 0.3f);
        inputs[0] = glm::vec4(d * draw.logarithmic(0.1f, 10.0f), std::floor(draw.uniform(1, 2048)));
        inputs[1] = glm::vec4(dx, 0.0f);
        inputs[2] = glm::vec4(dy, 0.0f);
        cases.push_back(inputs);
    }
    cases[0][1] = cases[0][2] = glm::vec4(0.0f); // nothing changes: the least span
    cases[1][2] = glm::vec4(0.0f);
    return cases;
}

std::vector<GlslCase> raiseCases() {
    std::vector<GlslCase> cases;
    for (const float level : {0.0f, 2.5f, 8.0f}) {
        for (const float floorLevel :
             {-kInfinity, -3.0f, 0.0f, 2.5f, 4.0f, 20.0f, kInfinity, kNan}) {
            cases.push_back(firstOf(level, floorLevel, 8.0f));
        }
    }
    return cases;
}

std::vector<GlslCase> tentCases() {
    std::vector<GlslCase> cases = exponentCases();
    Draw draw(10u);
    for (GlslCase& inputs : cases) {
        inputs[1] = glm::vec4(draw.unit(), 0.0f);
    }
    cases[0][1] = glm::vec4(0.0f);
    return cases;
}

std::vector<GlslCase> biasCases() {
    std::vector<GlslCase> cases;
    for (const float level : {0.0f, 0.5f, 3.0f, 9.0f}) {
        for (const float cosine : {-0.1f, 0.0f, 1e-7f, 1e-3f, 0.3f, 0.75f, 1.0f, 1.00000012f}) {
            cases.push_back(firstOf(level, cosine));
        }
    }
    Draw draw(11u);
    for (int i = 0; i < kDrawn; ++i) {
        cases.push_back(firstOf(draw.uniform(0, 10), draw.uniform(0, 1)));
    }
    return cases;
}

std::vector<GlslCase> texelCases() {
    std::vector<GlslCase> cases = {firstOf(1, 0, 0), firstOf(2, 0, 0), firstOf(256, 0, 0),
                                   firstOf(256, 128, 128), firstOf(4096, 0, 0)};
    Draw draw(12u);
    for (int i = 0; i < kDrawn; ++i) {
        const float width = std::floor(draw.logarithmic(1, 4096));
        cases.push_back(
            firstOf(width, std::floor(draw.uniform(0, width)), std::floor(draw.uniform(0, width))));
    }
    return cases;
}

std::vector<GlslCase> reflectanceCases() {
    std::vector<GlslCase> cases = exponentAndUnitCases();
    Draw draw(13u);
    for (GlslCase& inputs : cases) {
        std::swap(inputs[0].x, inputs[0].y);
        inputs[1] = glm::vec4(draw.uniform(0, 1), draw.uniform(0, 1), 0.04f, draw.uniform(0, 1));
    }
    cases[0][1] = glm::vec4(0.0f);
    cases[1][1] = glm::vec4(1.0f);
    return cases;
}

std::vector<GlslCase> directCases() {
    std::vector<GlslCase> cases;
    Draw draw(14u);
    for (int i = 0; i < kDrawn; ++i) {
        GlslCase inputs{};
        const glm::vec3 n = draw.unit();
        const glm::vec3 v = draw.above(n, 0.02f);
        // Half of the lights near the mirror direction, where sharp lobes answer at all.
        const glm::vec3 mirror = 2.0f * glm::dot(n, v) * n - v;
        const glm::vec3 l =
            i % 2 == 0 ? draw.above(n, 0.0f)
                       : glm::normalize(mirror + draw.logarithmic(1e-4f, 0.3f) * draw.unit());
        inputs[0] = glm::vec4(n, draw.exponent());
        inputs[1] = glm::vec4(v, 0.0f);
        inputs[2] = glm::vec4(l, 0.0f);
        inputs[3] = glm::vec4(draw.uniform(0, 1), 0.0f, 1.0f, 0.0f);
        inputs[4] = glm::vec4(0.04f, draw.uniform(0, 1), 1.0f, 0.0f);
        cases.push_back(inputs);
    }
    cases[0][2] = -cases[0][1];                             // no half vector
    cases[2][2] = glm::vec4(-glm::vec3(cases[2][0]), 0.0f); // a light behind the surface
    cases[4][0].w = kInfinity;
    cases[6][0].w = kNan;
    return cases;
}

std::vector<GlslCase> sh9Cases() {
    std::vector<GlslCase> cases;
    Draw draw(15u);
    for (int i = 0; i < kDrawn; ++i) {
        GlslCase inputs{};
        for (std::size_t k = 0; k < 9; ++k) {
            inputs[k] =
                glm::vec4(draw.uniform(-1, 1), draw.uniform(0, 100), draw.uniform(-1, 1), 0.0f);
        }
        inputs[0] = glm::abs(inputs[0]) * 2.0f;
        inputs[9] = glm::vec4(draw.unit(), 0.0f);
        cases.push_back(inputs);
    }
    return cases;
}

std::vector<GlslCase> surfaceCases() {
    std::vector<GlslCase> cases;
    const std::vector<float> exponents = allExponents();
    Draw draw(16u);
    for (std::size_t i = 0; i < kDrawn; ++i) {
        GlslCase inputs{};
        const glm::vec3 n = draw.unit();
        const glm::vec3 v = i < 20 ? n : draw.above(n, 0.02f);
        const int maxLevel = 4 + static_cast<int>(i % 5);
        inputs[0] = glm::vec4(static_cast<float>(1 << maxLevel), static_cast<float>(maxLevel),
                              draw.uniform(0, 6), draw.uniform(-4, 6));
        inputs[1] = glm::vec4(n, i < exponents.size() ? exponents[i] : draw.exponent());
        inputs[2] = glm::vec4(v, draw.uniform(0, 1));
        inputs[3] = glm::vec4(draw.uniform(0, 1), 0.0f, 1.0f, 0.0f);
        inputs[4] = glm::vec4(0.04f, draw.uniform(0, 1), 1.0f, 0.0f);
        const glm::vec3 r = 2.0f * glm::dot(n, v) * n - v;
        inputs[5] = glm::vec4(glm::cross(r, draw.unit()) * draw.logarithmic(1e-4f, 0.3f), 0.0f);
        inputs[6] = glm::vec4(glm::cross(r, draw.unit()) * draw.logarithmic(1e-4f, 0.3f), 0.0f);
        cases.push_back(inputs);
    }
    cases[0][0].w = kNan; // a floor that a driver could not tell
    cases[1][0].w = -kInfinity;
    cases[2][5] = cases[2][6] = glm::vec4(0.0f);
    return cases;
}

std::vector<GlslCase> tapCases() {
    std::vector<GlslCase> cases;
    Draw draw(18u);
    for (std::size_t i = 0; i < kDrawn; ++i) {
        GlslCase inputs{};
        const glm::vec3 d = draw.unit();
        const float turn = draw.uniform(0.0f, 6.2831853f);
        const float other = draw.uniform(0.0f, 6.2831853f);
        inputs[0] = glm::vec4(draw.logarithmic(1e-8f, 60.0f), i % 2 == 0 ? 3.0f : 7.0f,
                              std::floor(draw.logarithmic(4.0f, 1024.0f)), 0.0f);
        inputs[1] = glm::vec4(d, i < kValidExponents.size() ? kValidExponents[i] : draw.exponent());
        inputs[2] = glm::vec4(std::cos(turn), std::sin(turn),
                              i % 8 == 0 ? 0.0f : -draw.logarithmic(1e-3f, 11.0f), 0.0f);
        inputs[3] = glm::vec4(draw.uniform(1.0f, 3.0f), draw.logarithmic(1.0f, 400.0f),
                              draw.uniform(0.0f, 1.0f), 0.0f);
        inputs[4] = glm::vec4(glm::normalize(glm::cross(d, draw.unit())), 0.0f);
        inputs[5] = glm::vec4(std::cos(other), std::sin(other), 0.0f, 0.0f);
        cases.push_back(inputs);
    }
    cases[0][0].x = 0.0f;
    cases[1][0].x = 0.1f;                                      // where the series ends
    cases[2][1] = glm::vec4(0.0f, -1.0f, 0.0f, cases[2][1].w); // the pole of the frames
    cases[3][1] = glm::vec4(1e-4f, -1.0f, -2e-4f, cases[3][1].w);
    cases[4][1] = glm::vec4(0.0f, 1.0f, 0.0f, cases[4][1].w);
    return cases;
}

std::vector<GlslCase> rsrmCases() {
    std::vector<GlslCase> cases;
    const std::vector<float> exponents = allExponents();
    Draw draw(17u);
    for (std::size_t i = 0; i < kDrawn; ++i) {
        GlslCase inputs{};
        const glm::vec3 axis = draw.unit();
        const glm::vec3 r =
            i % 2 == 0 ? draw.unit()
                       : glm::normalize(axis + draw.logarithmic(1e-4f, 1.0f) * draw.unit());
        inputs[0] = glm::vec4(r, i < exponents.size() ? exponents[i] : draw.exponent());
        inputs[1] = glm::vec4(axis, i % 3 == 2 ? 1.0f : 0.0f);
        inputs[2] = i % 3 == 2 ? glm::vec4(256, 8, 1, 2048) : glm::vec4(170, 24, 1, 2048);
        inputs[3].w = draw.uniform(0, 1);
        inputs[4] =
            glm::vec4(draw.uniform(0, 1), draw.uniform(0, 1), 0.0f, draw.logarithmic(1e-3f, 1e6f));
        const bool published = i % 3 == 2;
        const float octaves = published ? 11.0f : 10.0007043f; // log2 of 2048, of 2049 / 2
        inputs[5] = glm::vec4(i < kValidExponents.size() ? kValidExponents[i] : draw.exponent(),
                              published ? 0.0f : 1.0f, (inputs[2].y - 1.0f) / octaves, 0.0f);
        cases.push_back(inputs);
    }
    const std::vector<float> chords = {0.0f, 1.0f, 0.70710678f, 0.70710683f, 1e-7f, 0.002f};
    for (std::size_t i = 0; i < chords.size(); ++i) {
        cases[i][3].w = chords[i];
    }
    cases[0][0] = glm::vec4(glm::vec3(cases[0][1]), cases[0][0].w);  // along the axis
    cases[1][0] = glm::vec4(-glm::vec3(cases[1][1]), cases[1][0].w); // against it
    return cases;
}

} // namespace lodestar::testing
