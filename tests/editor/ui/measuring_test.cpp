// SPDX-License-Identifier: MIT
//
// What is measured beside the frames: how long they take meanwhile, and of which material it is
// where several are selected.
#include <fstream>

#include "editor/ui/editor_fixture.h"
#include "support/shared.h"

namespace lodestar::testing {
namespace {

using platform::Key;

class MeasuringTest : public EditorTest {
protected:
    void openLit(const std::string& environment) {
        app::EditorOptions options;
        options.lighting = folder_.file("lit.lodestar.json");
        std::ofstream(options.lighting)
            << R"({"lodestar": 1, "environment": {"source": ")" << environment << R"("}})";
        open(options);
    }
    [[nodiscard]] const ui::AccuracyView& view() const { return editor_->surroundings().accuracy; }
};

TEST_F(MeasuringTest, APhotographIsMeasuredInSlices) {
    LODESTAR_NEEDS_SHARED();
    for (const char* name : {"park", "city", "studio"}) {
        const std::string file = std::string(name) + ".hdr";
        std::filesystem::copy_file(sharedPath(("assets/hdr/pmndrs/" + file).c_str()),
                                   folder_.file(file));
        openLit(file);
        click(mark("material 3").center());
        const double longest = measure();
        std::printf("%s: the longest slice %.0f ms\n", name, longest);
        ASSERT_TRUE(measured());
        EXPECT_GT(*view().lines.front().error, 0.0);
    }
}

// Of several materials the one that errs most is told of, by name; each has its own error.
TEST_F(MeasuringTest, OfSeveralMaterialsTheWorstIsShown) {
    for (const bool environment : {true, false}) {
        if (environment) {
            openLit("disc:0.3,0.8,0.5,6,60,0.3");
        } else {
            open({});
        }
        std::vector<double> alone;
        std::vector<std::string> names;
        for (const int i : {1, 3, 5}) {
            const std::string name = "material " + std::to_string(i);
            click(mark(name).center());
            measure();
            ASSERT_TRUE(view().selected.empty());
            for (const ui::EstimateLine& line : view().lines) {
                if (line.used) {
                    alone.push_back(*line.error);
                    names.push_back(view().material);
                }
            }
        }
        ASSERT_EQ(alone.size(), 3u);
        ASSERT_NE(alone[0], alone[1]);
        click(mark("material 1").center());
        send(platform::KeyEvent{Key::Control, true, false, {false, true, false}});
        click(mark("material 3").center());
        click(mark("material 5").center());
        send(platform::KeyEvent{Key::Control, false, false, {}});
        settle();
        measure();
        ASSERT_EQ(view().selected.size(), 3u);
        const auto worst = std::max_element(alone.begin(), alone.end()) - alone.begin();
        EXPECT_EQ(view().material, names[static_cast<std::size_t>(worst)]);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(view().selected[i].material, names[i]);
            // By the same directions, so the same number; maps are read in another order.
            EXPECT_NEAR(*view().selected[i].error, alone[i], 1e-12 + 1e-6 * alone[i]) << i;
        }
        click(mark("tab Accuracy").center());
        moveTo(mark("accuracy of").center());
        keep(environment ? "several-estimators" : "several-maps");
    }
}

} // namespace
} // namespace lodestar::testing
