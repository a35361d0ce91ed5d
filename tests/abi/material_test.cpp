// SPDX-License-Identifier: MIT
//
// Materials' uniform data, and what a document says of materials.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lodestar/lodestar.h"

namespace lodestar::testing {
namespace {

LodestarMaterial gold() {
    LodestarMaterial material{};
    material.struct_size = sizeof material;
    material.base_color[0] = 1.0;
    material.base_color[1] = 0.75;
    material.base_color[2] = 0.25;
    material.metallic = 0.5;
    material.roughness = 0.5;
    return material;
}

std::vector<float> packed(const LodestarApi& api, const LodestarMaterial& material) {
    std::vector<float> values(8, -7.0f);
    EXPECT_EQ(api.material_pack(&material, values.data()), LODESTAR_OK);
    return values;
}

class AbiMaterial : public ::testing::Test {
protected:
    void SetUp() override {
        api.struct_size = sizeof api;
        ASSERT_EQ(lodestar_get_api(LODESTAR_ABI_VERSION, &api), LODESTAR_OK);
        LodestarHost host{};
        host.struct_size = sizeof host;
        host.user = this;
        host.log = [](void* user, std::int32_t number, const char*) {
            static_cast<AbiMaterial*>(user)->logged.push_back(number);
        };
        ASSERT_EQ(api.context_create(&host, &context), LODESTAR_OK);
    }
    void TearDown() override { EXPECT_EQ(api.context_destroy(context), LODESTAR_OK); }
    LodestarApi api{};
    LodestarContext* context = nullptr;
    std::vector<std::int32_t> logged;
};

// By hand: k_L = 0.5 base, F0 half way from 0.04 to base, s = 2 / 0.5^4 - 2; products of a few
// roundings of 2^-24.
TEST_F(AbiMaterial, MaterialsArePackedAsTheShadingReadsThem) {
    const float expected[8] = {0.5f, 0.375f, 0.125f, 30.0f, 0.52f, 0.395f, 0.145f, 1.0f};
    LodestarMaterial material = gold();
    const std::vector<float> got = packed(api, material);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_NEAR(got[i], expected[i], 4e-7f * expected[i]) << i;
    }
    const std::string text = R"({"lodestar": 1, "materials": {
        "gold": {"exponent": "mirror", "diffuse": [0.125, 0.25, 0.5]}, "#2": {"exponent": 64},
        "odd": {"tolerance": 0.1}}})";
    LodestarDocument document = 0;
    ASSERT_EQ(api.document_load(context, text.data(), text.size(), &document), LODESTAR_OK)
        << api.last_error(context);
    const auto ask = [&](const char* name) {
        return api.document_material(context, document, name, &material);
    };
    ASSERT_EQ(ask("silver"), LODESTAR_OK);
    EXPECT_EQ(material.given, 0u) << "a material that the document does not name stays";
    ASSERT_EQ(ask("#2"), LODESTAR_OK);
    // An exponent is in place of the roughness's alone.
    EXPECT_EQ(packed(api, material),
              (std::vector<float>{got[0], got[1], got[2], 64.0f, got[4], got[5], got[6], 1.0f}));
    ASSERT_EQ(ask("gold"), LODESTAR_OK);
    EXPECT_EQ(packed(api, material),
              (std::vector<float>{0.125f, 0.25f, 0.5f, 1e7f, got[4], got[5], got[6], 1.0f}));
    LodestarMaterial named = gold();
    named.given = LODESTAR_MATERIAL_EXPONENT; // Blinn-Phong's: what it lacks has its own defaults
    ASSERT_EQ(api.document_material(context, document, "#2", &named), LODESTAR_OK);
    EXPECT_EQ(named.given, std::uint32_t{LODESTAR_MATERIAL_EXPONENT});
    logged.clear();
    ASSERT_EQ(ask("odd"), LODESTAR_OK);
    EXPECT_EQ(logged, std::vector<std::int32_t>{LODESTAR_LOG_REPAIRED})
        << "what is left out is said";
    EXPECT_EQ(ask(nullptr), LODESTAR_E_ARG);
    EXPECT_EQ(api.document_material(context, document, "gold", nullptr), LODESTAR_E_ABI);
    ASSERT_EQ(api.document_destroy(context, document), LODESTAR_OK);
    EXPECT_EQ(ask("gold"), LODESTAR_E_ARG) << "stale";
}

// An index of 2 reflects (1/3)^2 head on, tinted and halved; the metal's half is as it was.
TEST_F(AbiMaterial, DielectricsHaveAnIndexAndASpecularColour) {
    LodestarMaterial material = gold();
    const std::vector<float> before = packed(api, material);
    material.has_dielectric = 1;
    material.ior = 2.0;
    material.specular = 0.5;
    material.specular_color[0] = 1.0;
    material.specular_color[1] = 0.5;
    material.specular_color[2] = 100.0; // at most 1 before it is halved
    const std::vector<float> got = packed(api, material);
    const float dielectric[3] = {1.0f / 18.0f, 1.0f / 36.0f, 0.5f};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(got[4 + i], before[4 + i] + 0.5f * (dielectric[i] - 0.04f), 4e-7f) << i;
        EXPECT_EQ(got[i], before[i]);
    }
    material.ior = 0.0;
    material.metallic = 0.0;
    EXPECT_EQ(packed(api, material)[4], 0.5f) << "an index of 0 reflects all";
}

TEST_F(AbiMaterial, MaterialsOutOfRangeAreRefused) {
    float values[8] = {-7.0f};
    const auto refused = [&](const auto& change, LodestarStatus status) {
        LodestarMaterial material = gold();
        change(material);
        EXPECT_EQ(api.material_pack(&material, values), status);
        EXPECT_EQ(values[0], -7.0f) << "nothing is written";
    };
    refused([](LodestarMaterial& m) { m.base_color[1] = 1.5; }, LODESTAR_E_ARG);
    refused([](LodestarMaterial& m) { m.metallic = std::nan(""); }, LODESTAR_E_ARG);
    refused([](LodestarMaterial& m) { m.roughness = -0.1; }, LODESTAR_E_ARG);
    refused([](LodestarMaterial& m) { m.diffuse[2] = HUGE_VAL; }, LODESTAR_E_ARG);
    refused([](LodestarMaterial& m) { m.f0[0] = -1.0; }, LODESTAR_E_ARG);
    refused([](LodestarMaterial& m) { m.exponent = -1.0; }, LODESTAR_E_ARG);
    refused([](LodestarMaterial& m) { m.given = 8; }, LODESTAR_E_ARG);
    refused([](LodestarMaterial& m) { m.has_dielectric = 1, m.ior = 0.5; }, LODESTAR_E_ARG);
    refused([](LodestarMaterial& m) { m.has_dielectric = 1, m.specular = 2.0; }, LODESTAR_E_ARG);
    refused([](LodestarMaterial& m) { m.has_dielectric = 1, m.specular_color[0] = -1.0; },
            LODESTAR_E_ARG);
    refused([](LodestarMaterial& m) { m.struct_size = 0; }, LODESTAR_E_ABI);
    EXPECT_EQ(api.material_pack(nullptr, values), LODESTAR_E_ABI);
    const LodestarMaterial material = gold();
    EXPECT_EQ(api.material_pack(&material, nullptr), LODESTAR_E_ARG);
}

} // namespace
} // namespace lodestar::testing
