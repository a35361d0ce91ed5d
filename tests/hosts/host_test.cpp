// SPDX-License-Identifier: MIT
//
// The same scene under the same document in another engine (LODESTAR_HOST) and in the built-in
// renderer.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "host_pictures.h"
#include "model/document_file.h"
#include "model/stop_commands.h"

namespace lodestar::testing {
namespace {

core::Image byHost(const TemporaryFolder& folder, const std::string& scene,
                   const std::string& lighting, const std::string& hour) {
    return drawn(program(LODESTAR_HOST), folder, scene, lighting, hour);
}

core::Image byUs(const TemporaryFolder& folder, const std::string& scene,
                 const std::string& lighting, const std::string& hour) {
    return drawn(program("lodestar") + " render --samples 1 --no-backdrop", folder, scene, lighting,
                 hour);
}

TEST(Host, ADocumentLightsItAsItLightsUs) {
    const TemporaryFolder folder;
    const std::string lighting = day(folder);
    const std::string scene = spheres(folder, 2.2);
    for (const std::string hour : {"9", "17.5", "22"}) {
        EXPECT_TRUE(passes(byHost(folder, scene, lighting, hour),
                           byUs(folder, scene, lighting, hour), ("hour " + hour).c_str()));
    }
    // What moves is moved in both.
    const TemporaryFolder other;
    const std::string moved = spheres(other, 1.7);
    const core::Image own = byUs(folder, moved, lighting, "9");
    EXPECT_TRUE(passes(byHost(folder, moved, lighting, "9"), own, "moved"));
    // What must fail the gate: another hour, another place.
    EXPECT_FALSE(passes(byHost(folder, moved, lighting, "9.5"), own, "half an hour later"));
    EXPECT_FALSE(passes(byHost(folder, scene, lighting, "9"), own, "not moved"));
}

TEST(Host, ASkyPaintedInTheEditorLightsIt) {
    const TemporaryFolder folder;
    const std::string scene = spheres(folder, 2.2);
    const std::string lighting = day(folder);
    const core::Image before = byUs(folder, scene, lighting, "12");
    model::Model model;
    core::Tally warnings;
    auto file = model::DocumentFile::open(lighting, model, warnings);
    ASSERT_TRUE(file) << file.error().message();
    ASSERT_TRUE(model.execute(
        model::BrushStroke{model.ids().lights.at(0).keys.at(0).id,
                           {.size = 30.0, .strength = 0.8, .color = glm::dvec3(2.0, 0.2, 0.1)},
                           {60.0, 35.0, 20.0}}));
    ASSERT_TRUE(file->save(model));
    const core::Image own = byUs(folder, scene, lighting, "12");
    EXPECT_TRUE(passes(byHost(folder, scene, lighting, "12"), own, "painted"));
    EXPECT_FALSE(passes(before, own, "not painted"));
}

TEST(Host, ADocumentsEnvironmentLightsIt) {
    const TemporaryFolder folder;
    writeRoom(folder / "room.exr");
    const std::string scene = spheres(folder, 2.2);
    const std::string room =
        R"("environment": {"source": "room.exr", "rotation": 35, "ev": 0.5}, )";
    const std::string beside = day(folder, room, R"("add": true, )");
    const core::Image own = byUs(folder, scene, beside, "9");
    EXPECT_TRUE(passes(byHost(folder, scene, beside, "9"), own, "environment, sky and sun"));
    // The other documents must fail the gate: no environment, a sky in its place, another way up.
    EXPECT_FALSE(passes(byHost(folder, scene, day(folder), "9"), own, "without it"));
    EXPECT_FALSE(passes(byHost(folder, scene, day(folder, room), "9"), own, "a sky in its place"));
    const std::string turned = R"("environment": {"source": "room.exr", "ev": 0.5}, )";
    EXPECT_FALSE(passes(byHost(folder, scene, day(folder, turned, R"("add": true, )"), "9"), own,
                        "not turned"));
    // Alone.
    const std::string alone =
        folder
            .write("room.lodestar.json",
                   R"({"lodestar": 1, "environment": {"source": "room.exr"}})")
            .string();
    EXPECT_TRUE(passes(byHost(folder, scene, alone, "9"), byUs(folder, scene, alone, "9"),
                       "environment alone"));
}

TEST(Host, TheHostsAreCalledAlike) {
    const TemporaryFolder folder;
    const std::string lighting = day(folder);
    const std::string scene = spheres(folder, 2.2);
    // Without a view each shows the whole scene, from the same place.
    const core::Image builtin =
        drawn(program("lodestar-host-builtin"), folder, scene, lighting, "9", "");
    EXPECT_TRUE(passes(drawn(program(LODESTAR_HOST), folder, scene, lighting, "9", ""), builtin,
                       "the scene framed"));
    EXPECT_FALSE(passes(byHost(folder, scene, lighting, "9"), builtin, "from elsewhere"));
}

TEST(Host, ADocumentsMaterialsStandOverTheFiles) {
    const TemporaryFolder folder, plain;
    const std::string scene = spheres(folder, 2.2);
    const std::string lighting =
        day(folder, R"("materials": {"#1": {"exponent": 200, "f0": [0.2, 0.5, 0.3]},
                                     "#2": {"diffuse": [0.4, 0.1, 0.1]}}, )");
    const core::Image own = byUs(folder, scene, lighting, "9");
    EXPECT_TRUE(passes(byHost(folder, scene, lighting, "9"), own, "materials"));
    EXPECT_FALSE(passes(byHost(folder, scene, day(plain), "9"), own, "without them"));
}

TEST(Host, ADocumentsRowsAreItsMaps) {
    const TemporaryFolder folder, plain;
    const std::string scene = spheres(folder, 2.2);
    // Few rows, far apart, and the polished sphere beyond the last: a host that read them as others
    // would be seen.
    const std::string lighting = day(folder, R"("rsrm": {"exponents": [2, 9, 150]}, )");
    const core::Image own = byUs(folder, scene, lighting, "9");
    EXPECT_TRUE(passes(byHost(folder, scene, lighting, "9"), own, "own rows"));
    EXPECT_FALSE(passes(byHost(folder, scene, day(plain), "9"), own, "the default rows"));
}

TEST(Host, WhatIsNotShownIsSaid) {
    const TemporaryFolder folder;
    GltfBuilder file;
    const int painted =
        file.add("materials", {{"emissiveFactor", {0.5, 0.5, 0.5}}, {"alphaMode", "BLEND"}});
    file.show({file.primitive(sphere(4, 8), painted)}, {});
    const std::string said = (folder / "said").string();
    const std::string command = program(LODESTAR_HOST) + " " + file.write(folder).string() +
                                " --lighting " + day(folder) + " -o " +
                                (folder / "x.png").string() + " --size 8x8 2>" + said;
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::ifstream answer(said);
    const std::string lines{std::istreambuf_iterator<char>(answer), {}};
    for (const char* what : {"emission, left out (1 times)", "drawn opaque (1 times)"}) {
        EXPECT_NE(lines.find(what), std::string::npos) << lines;
    }
    EXPECT_EQ(lines.find("texture"), std::string::npos) << lines;
}

TEST(Host, ADocumentThatCannotLightIsSaid) {
    const TemporaryFolder folder;
    const std::string scene = spheres(folder, 2.2);
    const std::string said = (folder / "said").string();
    const std::pair<const char*, const char*> cases[] = {
        {R"({"lodestar": 1, "lights": [{"kind": "moon", "keys": []}]})", "(/lights/0/kind)"},
        {R"({"lodestar": 1})", "(/lights)"},
        {R"({"lodestar": 1, "environment": {"source": "../room.exr"}})", "(/environment/source)"}};
    for (const auto& [text, place] : cases) {
        const std::string file = folder.write("broken.lodestar.json", std::string(text)).string();
        for (const char* host : {LODESTAR_HOST, "lodestar-host-builtin"}) {
            const std::string command = program(host) + " " + scene + " --lighting " + file +
                                        " -o " + (folder / "x.png").string() + " --size 8x8 2>" +
                                        said;
            EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 3);
            std::ifstream answer(said);
            std::string line;
            std::getline(answer, line);
            EXPECT_NE(line.find(file), std::string::npos) << line;
            EXPECT_NE(line.find(place), std::string::npos) << line;
        }
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "x.png"));
}

} // namespace
} // namespace lodestar::testing
