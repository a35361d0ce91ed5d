// SPDX-License-Identifier: MIT
//
// Environment, materials, probes.
#include <cmath>
#include <limits>

#include <glm/trigonometric.hpp>

#include "model_support.h"

namespace lodestar::model {
namespace {

TEST(EnvironmentCommands, SetWhatIsGiven) {
    Model model = sampleModel();
    did(model, SetEnvironment{{}, glm::radians(90.0), {}});
    EXPECT_DOUBLE_EQ(model.document().environment->rotation, glm::radians(90.0));
    EXPECT_EQ(model.document().environment->source, "constant:0.1,0.2,0.3");
    EXPECT_EQ(model.document().environment->unknown, "{\"note\":\"x\"}");
    did(model, RemoveEnvironment{});
    EXPECT_EQ(refusal(model, SetEnvironment{{}, 1.0, {}}), "a source is a file or an analytic map");
    did(model, SetEnvironment{std::string("maps/park.hdr"), {}, {}});
    EXPECT_EQ(refusal(model, SetEnvironment{std::string("/etc/park.hdr"), {}, {}}),
              "a source lies in the document's folder or below");
    refusal(model, SetEnvironment{std::string("a/../../park.hdr"), {}, {}});
}

TEST(MaterialCommands, EditManyAtOnceAndReset) {
    Model model = sampleModel();
    did(model,
        SetMaterials{{"gold", "#2", "new"}, {}, glm::dvec3(0.5), {}, std::string("ring:3"), 0.1});
    const auto& materials = model.document().materials;
    EXPECT_EQ(materials.size(), 3U);
    EXPECT_EQ(materials.at("gold").exponent, 64.0) << "what is not set stays";
    EXPECT_EQ(materials.at("gold").unknown, "{\"vendor\":3}");
    EXPECT_EQ(materials.at("new").specular, "ring:3");
    EXPECT_FALSE(materials.at("new").exponent);
    did(model, ResetMaterials{{"gold", "#2"}, MaterialField::Diffuse | MaterialField::Exponent});
    EXPECT_FALSE(materials.at("gold").exponent);
    EXPECT_TRUE(materials.at("gold").tolerance);
    did(model, ResetMaterials{{"gold", "#2", "new"}, MaterialField::All});
    EXPECT_EQ(materials.size(), 1U) << "gold has a member that no version knows";
    EXPECT_TRUE(materials.contains("gold"));
    did(model, SetMaterials{{"#0"}, std::numeric_limits<double>::infinity(), {}, {}, {}, {}});
    EXPECT_NE(textOf(model).find("\"mirror\""), std::string::npos);
}

TEST(MaterialCommands, ANameMayHoldAnyText) {
    Model model = sampleModel();
    const std::string name("nul \0 and \"quote\" and /~ \n", 26);
    did(model, SetMaterials{{name}, 8.0, {}, {}, {}, {}});
    EXPECT_EQ(documentOf(textOf(model)), model.document());
    EXPECT_EQ(refusal(model, SetMaterials{{"broken \xff"}, 8.0, {}, {}, {}, {}}),
              "a material has a name in UTF-8, or # and its index");
    refusal(model, SetMaterials{{""}, 8.0, {}, {}, {}, {}});
    refusal(model, SetMaterials{{}, 8.0, {}, {}, {}, {}});
}

TEST(ProbeCommands, KeepWhatNoVersionKnows) {
    Model model = sampleModel();
    const Id id = model.ids().probes[0];
    lighting::Probe probe = model.probe(id)->probe;
    probe.position = {4, 5, 6};
    probe.influence.blend[0] = 0.5;
    probe.update = lighting::ProbeUpdate::Every;
    probe.every = 3;
    probe.proxy = probe.influence;
    did(model, SetProbe{id, probe});
    EXPECT_EQ(model.probe(id)->probe, probe);
    EXPECT_EQ(model.probe(id)->captureUnknown, "{\"lens\":2}");
    EXPECT_EQ(model.probe(id)->influenceUnknown, "{\"kind\":\"soft\"}");
    const Outcome added = did(model, AddProbe{lighting::Probe()});
    did(model, RemoveProbes{{id, added.created.at(0)}});
    EXPECT_TRUE(model.document().probes.empty());
    EXPECT_TRUE(model.undo());
    EXPECT_EQ(model.ids().probes, (std::vector<Id>{id, added.created[0]}));
}

TEST(ProbeCommands, BadOnesAreRefused) {
    Model model = sampleModel();
    const Id id = model.ids().probes[0];
    const auto with = [&](auto&& edit) {
        lighting::Probe probe = model.probe(id)->probe;
        edit(probe);
        return refusal(model, SetProbe{id, probe});
    };
    const double nan = std::nan("");
    EXPECT_EQ(with([](auto& p) { p.capture.farPlane = 0.01; }),
              "the far plane lies beyond the near one");
    EXPECT_FALSE(with([](auto& p) { p.capture.resolution = 0; }).empty());
    EXPECT_FALSE(with([](auto& p) { p.capture.resolution = 100000; }).empty());
    EXPECT_FALSE(with([](auto& p) { p.influence.size = glm::dvec3(-1); }).empty());
    EXPECT_FALSE(with([](auto& p) { p.tint.r = -1; }).empty());
    EXPECT_FALSE(with([](auto& p) { p.priority = 2000000; }).empty());
    EXPECT_FALSE(with([&](auto& p) { p.position.y = nan; }).empty());
    EXPECT_FALSE(with([&](auto& p) { p.influence.blend[3] = nan; }).empty());
    EXPECT_FALSE(with([&](auto& p) { p.intensity = 1 / 0.0; }).empty());
    EXPECT_FALSE(with([&](auto& p) {
                     p.proxy = p.influence;
                     p.proxy->center.x = nan;
                 }).empty());
    lighting::Probe broken;
    broken.capture.nearPlane = nan;
    refusal(model, AddProbe{broken});
    refusal(model, RemoveProbes{{id, static_cast<Id>(777)}});
    EXPECT_EQ(model.document().probes.size(), 1U);
}

} // namespace
} // namespace lodestar::model
