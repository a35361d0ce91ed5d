// SPDX-License-Identifier: MIT
//
// Presets, built in and the user's.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "model/presets.h"
#include "model_support.h"
#include "support/run.h"

namespace lodestar::model {
namespace {

namespace fs = std::filesystem;

TEST(Presets, BuiltInOnesAreDocumentsThatNothingMends) {
    std::set<std::string> names;
    for (const Preset& preset : builtInPresets()) {
        names.insert(preset.name);
        Model model;
        did(model, SetLights{preset.lights});
        core::Tally warnings;
        const auto read = document::parseDocument(textOf(model), warnings);
        ASSERT_TRUE(read) << preset.name;
        EXPECT_EQ(*read, model.document()) << preset.name;
        EXPECT_TRUE(warnings.empty()) << preset.name;
        EXPECT_EQ(model.document().lights.front().kind, lighting::LightKind::Sky) << preset.name;
    }
    EXPECT_EQ(names, (std::set<std::string>{"Clear noon", "Dusk", "Golden hour", "Night",
                                            "Overcast", "Studio"}));
}

TEST(Presets, ANewLightIsWholeAndBright) {
    for (const auto kind : {lighting::LightKind::Sky, lighting::LightKind::Sun}) {
        Model model;
        did(model, AddLight{plainLight(kind, "new")});
        core::Tally warnings;
        const auto read = document::parseDocument(textOf(model), warnings);
        ASSERT_TRUE(read);
        EXPECT_TRUE(warnings.empty());
        EXPECT_EQ(read->lights[0].name, "new");
        EXPECT_EQ(read->lights[0].kind, kind);
        EXPECT_GE(stopsOf(model).size(), 2U);
        EXPECT_GT(redAt(model, stopsOf(model)[0].stop.at), 0.0);
    }
}

TEST(Presets, TheUsersComeBackByName) {
    const testing::TemporaryFolder folder;
    const fs::path place = folder.path() / "deep" / "presets";
    core::Tally warnings;
    EXPECT_TRUE(loadPresets(place, warnings).empty());
    EXPECT_TRUE(warnings.empty()) << "a folder that is not there is no fault";
    const Preset mine{"M\xc3\xa4rz, 7 Uhr", sampleModel().document().lights};
    ASSERT_TRUE(savePreset(place, mine));
    ASSERT_TRUE(savePreset(place, {"a", builtInPresets()[2].lights}));
    auto found = loadPresets(place, warnings);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].name, "M\xc3\xa4rz, 7 Uhr");
    EXPECT_EQ(found[0].lights, mine.lights);
    EXPECT_EQ(found[1].lights, builtInPresets()[2].lights);
    EXPECT_TRUE(warnings.empty());
    std::ofstream(place / "broken.lodestar.json") << "{";
    std::ofstream(place / "empty.lodestar.json") << R"({"lodestar": 1})";
    std::ofstream(place / "other.txt") << "x";
    found = loadPresets(place, warnings);
    EXPECT_EQ(found.size(), 2U);
    EXPECT_EQ(warnings.counts().size(), 2U) << "each with its reason";
    ASSERT_TRUE(removePreset(place, "a"));
    EXPECT_FALSE(removePreset(place, "a"));
    EXPECT_EQ(loadPresets(place, warnings).size(), 1U);
}

TEST(Presets, ANameIsAFilesName) {
    const testing::TemporaryFolder folder;
    const auto lights = builtInPresets()[0].lights;
    for (const std::string& name :
         {std::string(), std::string("a/b"), std::string("../up"), std::string(".hidden"),
          std::string("line\nbreak"), std::string(101, 'x')}) {
        EXPECT_FALSE(savePreset(folder.path(), {name, lights})) << name;
        EXPECT_FALSE(removePreset(folder.path(), name)) << name;
    }
    EXPECT_FALSE(savePreset(folder.path(), {"dark", {}}));
    EXPECT_FALSE(savePreset({}, {"no folder", lights}));
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Presets, TheFolderIsTheDesktopsForData) {
    ::setenv("XDG_DATA_HOME", "/data", 1);
    EXPECT_EQ(userPresetFolder(), "/data/lodestar/presets");
    ::setenv("XDG_DATA_HOME", "relative", 1);
    ::setenv("HOME", "/h", 1);
    EXPECT_EQ(userPresetFolder(), "/h/.local/share/lodestar/presets");
    ::unsetenv("XDG_DATA_HOME");
    ::unsetenv("HOME");
    EXPECT_TRUE(userPresetFolder().empty());
}

} // namespace
} // namespace lodestar::model
