// SPDX-License-Identifier: MIT
//
// The steps of a model as a script: on the document that they began with it gives the same bytes.
#include "model/command_text.h"
#include "random_commands.h"

namespace lodestar::model {
namespace {

/// Replays a model's history on another, and compares what comes of it.
void expectReplayed(const Model& model, Model begin) {
    const std::string script = writeHistory(model);
    const auto run = runScript(script, begin);
    ASSERT_TRUE(run) << run.error().message() << "\n" << script;
    EXPECT_EQ(textOf(begin), textOf(model));
}

TEST(HistoryText, AReplayGivesTheSameBytes) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        Model model = sampleModel();
        Generator generator(seed, model);
        Chance chance(seed);
        MergeToken token = model.newToken();
        for (int i = 0; i < 400; ++i) {
            if (chance.one(8)) {
                token = model.newToken();
            }
            if (chance.one(12)) {
                (void)model.undo();
            } else if (chance.one(12)) {
                (void)model.redo();
            } else {
                (void)model.execute(generator.next(), chance.one(2) ? token : 0);
            }
            if (i % 100 == 99) {
                ASSERT_GT(model.undoCount(), 0U);
                expectReplayed(model, sampleModel());
            }
        }
    }
}

TEST(HistoryText, ADragIsItsLastCommandAndWhatIsUndoneIsLeftOut) {
    Model model = sampleModel();
    const MergeToken drag = model.newToken();
    for (const double at : {10.0, 11.0, 12.5}) {
        did(model, MoveStops{{{stopId(model, 1), at}}}, drag);
    }
    did(model, AddStop{keyId(model), 70.0});
    ASSERT_TRUE(model.undo());
    EXPECT_EQ(
        writeHistory(model),
        "# Move stop\n"
        R"({"do":"MoveStops","moves":[{"stop":"/lights/0/keys/0/gradient/stops/1","at":12.5}]})"
        "\n");
    ASSERT_TRUE(model.undo());
    EXPECT_EQ(writeHistory(model), "");
}

TEST(HistoryText, ACommandWithoutTextIsTheDocumentThatItLeft) {
    Model model = sampleModel();
    // A stop out of its range, which the command brings into it and a text may not hold.
    did(model, InsertStops{keyId(model), {{{300.0, glm::dvec3(1.0), 0.0}, {}}}});
    const std::string script = writeHistory(model);
    EXPECT_NE(script.find("ReplaceDocument"), std::string::npos) << script;
    expectReplayed(model, sampleModel());
}

} // namespace
} // namespace lodestar::model
