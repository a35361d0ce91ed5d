// SPDX-License-Identifier: MIT
//
// What the editor tells of accuracy and its cost, by synthetic events: the preview sphere, measured
// estimators, the error view, and materials that textures make.
#include <fstream>

#include "editor/ui/editor_fixture.h"
#include "support/shared.h"

namespace lodestar::testing {
namespace {

using platform::Key;

class AccuracyEditorTest : public EditorTest {
protected:
    [[nodiscard]] const ui::EstimateLine& line(const std::string& name) const {
        for (const ui::EstimateLine& known : editor_->surroundings().accuracy.lines) {
            if (known.name == name) {
                return known;
            }
        }
        ADD_FAILURE() << name << " is not measured";
        static const ui::EstimateLine kNone;
        return kNone;
    }
    void openLit(const std::string& environment, const std::string& scene = {}) {
        app::EditorOptions options;
        options.scene = scene;
        options.lighting = folder_.file("lit.lodestar.json");
        std::ofstream(options.lighting)
            << R"({"lodestar": 1, "environment": {"source": ")" << environment << R"("}})";
        open(options);
    }
};

TEST_F(AccuracyEditorTest, ASphereOfTheMaterialIsDrawnWhereItOrItsLightChanges) {
    EXPECT_FALSE(has("preview"));
    click(mark("material 3").center());
    ASSERT_TRUE(has("preview"));
    const auto sphere = [&] {
        (void)viewport();
        return part(shown(), mark("preview"));
    };
    const core::Image first = sphere();
    keep("preview");
    const int drawn = editor_->previewsDrawn();
    EXPECT_GE(drawn, 1);
    const ImVec2 center = mark("viewport").center();
    drag(center, {center.x + 60.0f, center.y});
    EXPECT_EQ(editor_->previewsDrawn(), drawn) << "the camera is not what it depends on";
    typeInto("exponent", "3");
    const core::Image broad = sphere();
    EXPECT_GT(editor_->previewsDrawn(), drawn);
    EXPECT_GT(difference(first, broad), 0.004);
    editor_->workspace().view().hour = 12.0;
    frame();
    EXPECT_GT(difference(broad, sphere()), 0.004) << "another light";
    const int last = editor_->previewsDrawn();
    frame();
    frame();
    EXPECT_EQ(editor_->previewsDrawn(), last) << "drawn at rest";
}

// A document's lights alone: a material's estimator is without effect, which is said, and the maps
// themselves are what is measured.
TEST_F(AccuracyEditorTest, WhereSkiesAndSunsShineAloneTheirMapsAreMeasured) {
    click(mark("material 3").center());
    settle();
    measure();
    EXPECT_TRUE(has("no estimator"));
    EXPECT_FALSE(has("estimator"));
    EXPECT_FALSE(editor_->surroundings().accuracy.selectable);
    EXPECT_TRUE(line("rsrm").used);
    EXPECT_TRUE(line("rsrm").front);
    EXPECT_GT(*line("rsrm").error, 0.0);
    EXPECT_LT(*line("rsrm").error, 0.05);
    EXPECT_GT(*line("rsrm-published").error, 2.0 * *line("rsrm").error);
    EXPECT_GT(*line("rsrm").ms, 0.0);
    EXPECT_FALSE(editor_->wantsFrame());
    click(mark("tab Accuracy").center());
    settle();
    EXPECT_TRUE(has("accuracy plot"));
    keep("maps");
    click(mark("tab Map rows").center());
    settle();
    measure();
    const auto& rows = editor_->surroundings().accuracy.rows;
    ASSERT_EQ(rows.size(), 24u);
    EXPECT_DOUBLE_EQ(rows.front().exponent, 1.0);
    EXPECT_NEAR(rows.back().exponent, 2048.0, 1e-6);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_TRUE(rows[i].error.has_value());
        EXPECT_LT(*rows[i].error, 0.05);
        EXPECT_EQ(rows[i].betweenError.has_value(), i + 1 < rows.size());
    }
    keep("rows");
}

TEST_F(AccuracyEditorTest, EachEstimatorHasItsErrorAndItsTime) {
    openLit("disc:0.3,0.8,0.5,6,60,0.3");
    click(mark("material 5").center());
    settle();
    measure();
    ASSERT_TRUE(has("estimator"));
    click(mark("tab Accuracy").center());
    settle();
    measure();
    keep("estimators");
    EXPECT_TRUE(line("tent").used);
    EXPECT_LT(*line("ring:7").error, *line("tent").error);
    EXPECT_LT(*line("taps:64").error, *line("ring:3").error);
    EXPECT_GT(*line("taps:64").ms, 0.0);
    EXPECT_GT(*line("tent").ms, 0.0);
    EXPECT_EQ(line("taps:64").fetches, 64);
    EXPECT_FALSE(line("auto:0.05").chosen.empty());
    const double before = *line("tent").error;

    click(mark("estimator").center());
    settle();
    keep("choices");
    click(mark("estimator/ring:7").center());
    measure();
    EXPECT_TRUE(line("ring:7").used);
    EXPECT_FALSE(line("tent").used);
    EXPECT_DOUBLE_EQ(*line("tent").error, before) << "a choice is no reason to measure again";

    typeInto("exponent", "2");
    measure();
    EXPECT_NE(*line("tent").error, before) << "another exponent has another error";
    model().select({});
    editor_->advance(0.01);
    settle();
    EXPECT_TRUE(editor_->surroundings().accuracy.lines.empty()) << "cancelled";
    EXPECT_GE(editor_->patience(), 1.0); // what others do to the file is looked at then
}

TEST_F(AccuracyEditorTest, TheErrorViewComparesWithTheReferenceAndEndsWithAnyChange) {
    const core::Image picture = viewport();
    press(Key::E);
    ASSERT_TRUE(editor_->workspace().view().errorView)
        << (editor_->workspace().log().empty() ? "" : editor_->workspace().log().back().text);
    for (int i = 0; i < 4 && editor_->errorPasses() < app::Editor::kErrorPasses; ++i) {
        settle();
    }
    EXPECT_EQ(editor_->errorPasses(), app::Editor::kErrorPasses);
    EXPECT_FALSE(editor_->wantsFrame());
    const app::ErrorFigures figures = editor_->errorFigures();
    EXPECT_GT(figures.mean, 0.0);
    EXPECT_LT(figures.mean, 0.2);
    EXPECT_LT(figures.spread, 0.5 * figures.mean) << "the reference is surer than the picture";
    keep("errors");
    EXPECT_GT(difference(picture, part(shown(), mark("viewport"))), 0.05);
    editor_->workspace().view().hour += 1.0;
    frame();
    EXPECT_LE(editor_->errorPasses(), 1) << "begun anew";
    press(Key::E);
    EXPECT_EQ(editor_->errorPasses(), 0);
    editor_->workspace().view().hour -= 1.0;
    frame();
    EXPECT_LT(difference(picture, viewport()), 1e-3);
}

// BoomBox: base colour, roughness and metalness are textures; two materials.
TEST_F(AccuracyEditorTest, AnExponentOfTexturedMaterialsKeepsTheirOtherNumbers) {
    LODESTAR_NEEDS_SHARED()
    const std::filesystem::path scene =
        sharedPath("assets/gltf/khronos/BoomBoxWithAxes/glTF/BoomBoxWithAxes.gltf");
    openLit("faces:1;0.4;2;0.3;0.8;1.5", scene.string());
    const std::vector<ui::MaterialLine> before = editor_->surroundings().materials;
    ASSERT_GE(before.size(), 2u);
    const core::Image picture = viewport();
    keep("boombox");
    click(mark("material 0").center());
    send(platform::KeyEvent{Key::Control, true, false, {false, true, false}});
    click(mark("material 1").center());
    send(platform::KeyEvent{Key::Control, false, false, {}});
    settle();
    ASSERT_EQ(model().selection().materials.size(), 2u);
    typeInto("exponent", "150");
    keep("boombox-150");
    EXPECT_EQ(model().undoCount(), 1u);
    const std::vector<ui::MaterialLine>& after = editor_->surroundings().materials;
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_NEAR(after[i].exponent, 150.0, 1e-4);
        EXPECT_EQ(after[i].diffuse, before[i].diffuse);
        EXPECT_EQ(after[i].f0, before[i].f0);
        const document::Material& written = model().document().materials.at(after[i].key);
        EXPECT_FALSE(written.diffuse || written.f0);
    }
    // What of a picture is colour stays: metal, whose light comes back by F0 alone, would be all
    // but black by one F0 of 0.04. The mean light of the box changes by less than a tenth.
    const auto mean = [](const core::Image& image) {
        double sum = 0.0;
        for (std::size_t i = 0; i < image.pixels().size(); i += 4) {
            sum += static_cast<double>(image.pixels()[i] + image.pixels()[i + 1] +
                                       image.pixels()[i + 2]);
        }
        return sum / static_cast<double>(image.pixels().size());
    };
    const core::Image sharp = viewport();
    EXPECT_GT(difference(picture, sharp), 1e-4);
    EXPECT_NEAR(mean(sharp) / mean(picture), 1.0, 0.1);
    control(Key::Z);
    EXPECT_LT(difference(picture, viewport()), 1e-3);
}

} // namespace
} // namespace lodestar::testing
