// SPDX-License-Identifier: MIT
//
// Commands as text: what is written is read as the same command, and what is no command is refused
// in a sentence.
#include <set>

#include "model/command_text.h"
#include "random_commands.h"

namespace lodestar::model {
namespace {

TEST(CommandText, WhatAModelAcceptsIsReadAsTheSame) {
    Model model = sampleModel();
    Model twin = sampleModel();
    Generator generator(41, model);
    std::vector<std::size_t> read(std::variant_size_v<Command>, 0);
    std::size_t textless = 0;
    for (int i = 0; i < 4000; ++i) {
        const Command command = generator.next();
        const auto line = writeCommand(command, model);
        if (!model.execute(command)) {
            continue;
        }
        if (!line) { // wild values that the command brings into their range
            EXPECT_TRUE(twin.execute(command));
            ++textless;
            continue;
        }
        EXPECT_EQ(line->find('\n'), std::string::npos) << *line;
        const auto again = readCommand(*line, twin);
        ASSERT_TRUE(again) << i << " " << *line << ": " << again.error().message();
        ASSERT_EQ(again->index(), command.index()) << *line;
        const auto done = twin.execute(*again);
        ASSERT_TRUE(done) << i << " " << *line << ": " << done.error().message();
        ASSERT_EQ(textOf(twin), textOf(model)) << i << " " << *line;
        ASSERT_EQ(twin.ids(), model.ids()) << i << " " << *line;
        ++read[command.index()];
    }
    std::printf("%zu accepted commands have no text\n", textless);
    const std::vector<std::string_view> names = commandNames();
    for (std::size_t type = 0; type < read.size(); ++type) {
        EXPECT_GT(read[type], 0U) << names[type];
    }
    EXPECT_EQ(std::set(names.begin(), names.end()).size(), read.size()) << "two of one name";
}

TEST(CommandText, IsWhatTheDocumentationShows) {
    Model model = sampleModel();
    const auto line = writeCommand(MoveStops{{{stopId(model, 1), 12.5}}}, model);
    ASSERT_TRUE(line);
    EXPECT_EQ(*line, R"({"do":"MoveStops","moves":[{"stop":"/lights/0/keys/0/gradient/stops/1",)"
                     R"("at":12.5}]})");
    SetKey set{keyId(model, 1, 1), std::nullopt, std::nullopt};
    set.axis.emplace(); // takes the key's own axis away
    EXPECT_EQ(*writeCommand(set, model), R"({"do":"SetKey","key":"/lights/1/keys/1","axis":null})");
    EXPECT_EQ(*writeCommand(SetMaterials{{"gold"}, HUGE_VAL, {}, {}, {}, {}}, model),
              R"({"do":"SetMaterials","names":["gold"],"exponent":"mirror"})");
    EXPECT_EQ(
        *writeCommand(ResetMaterials{{"#2"}, MaterialField::F0 | MaterialField::Exponent}, model),
        R"({"do":"ResetMaterials","names":["#2"],"fields":["exponent","f0"]})");
    EXPECT_FALSE(writeCommand(ReverseStops{static_cast<Id>(999)}, model));
}

TEST(CommandText, AScriptIsStepsAndStopsAtWhatIsWrong) {
    Model model = sampleModel();
    const std::string start = textOf(model);
    const auto run = runScript(
        "# a comment, and a blank line\n\n"
        R"({"do": "AddStop", "key": "/lights/0/keys/0", "at": 50})"
        "\r\n"
        R"({"do": "MoveStops", "moves": [{"stop": "/lights/0/keys/0/gradient/stops/1", "at": 40}]})"
        "\n"
        R"({"do": "BrushStroke", "key": "/lights/0/keys/1", "path": [10, 30], "brush": {"size": 5}})"
        "\n"
        R"({"do": "Undo"})"
        "\n"
        R"({"do": "Redo"})"
        "\n"
        R"({"do": "Undo"})",
        model);
    ASSERT_TRUE(run) << run.error().message();
    EXPECT_EQ(*run, 6U);
    EXPECT_EQ(model.undoCount(), 2U);
    EXPECT_EQ(placesOf(model), (std::vector<double>{90, 40, 20, 0, 0, -90}));
    const auto stopped = runScript(R"({"do": "Undo"})"
                                   "\n"
                                   R"({"do": "DeleteKey", "key": "/lights/0"})",
                                   model);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().where.substr(0, 6), "line 2");
    EXPECT_EQ(model.undoCount(), 1U) << "the lines before it hold";
    EXPECT_TRUE(model.undo());
    EXPECT_EQ(textOf(model), start);
}

TEST(CommandText, WhatIsNoCommandIsRefusedInASentence) {
    struct Case {
        const char* line;
        const char* what;
        const char* where;
    };
    const std::string deep = R"({"do": "AddStop", "at": )" + std::string(100000, '[');
    const Case cases[] = {
        {"nonsense", "is no JSON object", "line 1"},
        {"[1]", "is no JSON object", "line 1"},
        {deep.c_str(), "is nested too deep", "line 1"},
        {R"({"key": 3})", "\"do\" must name a command", "line 1, /do"},
        {R"({"do": "Explode"})", "there is no command \"Explode\"", "line 1, /do"},
        {R"({"do": "AddStop", "key": "/lights/0/keys/0"})", "\"at\" is needed", "line 1"},
        {R"({"do": "AddStop", "key": "/lights/7", "at": 1})",
         "no light, key, stop or probe is there", "line 1, /key"},
        {R"({"do": "AddStop", "key": "/lights/00", "at": 1})",
         "no light, key, stop or probe is there", "line 1, /key"},
        {R"({"do": "AddStop", "key": "/lights/0/keys/0", "at": "high"})", "must be a number",
         "line 1, /at"},
        {R"({"do": "AddStop", "key": "/lights/0/keys/0", "at": 1, "hour": 2})",
         "there is no such member", "line 1, /hour"},
        {R"({"do": "SetSpace", "key": "/lights/0/keys/0", "space": "cmyk"})",
         "must be one of linear, oklab, srgb", "line 1, /space"},
        {R"({"do": "MoveStops", "moves": [{"stop": "/lights/0/keys/0/gradient/stops/0"}]})",
         "\"at\" is needed", "line 1, /moves/0"},
        {R"({"do": "Undo"})", "there is no step for Undo", "line 1"},
        {R"({"do": "Undo", "times": 2})", "Undo has no members", "line 1"},
    };
    for (const Case& each : cases) {
        Model model = sampleModel();
        const auto run = runScript(each.line, model);
        ASSERT_FALSE(run) << each.line;
        EXPECT_EQ(run.error().what, each.what) << std::string(each.line).substr(0, 80);
        EXPECT_EQ(run.error().where, each.where) << std::string(each.line).substr(0, 80);
    }
    // A part of a document is told of by the document's rules, its place below the member.
    Model model = sampleModel();
    const auto run = runScript(
        R"({"do": "InsertStops", "key": "/lights/0/keys/0", "stops": [{"at": 3, "color": "red"}]})",
        model);
    ASSERT_FALSE(run);
    EXPECT_EQ(run.error().where, "line 1, /stops/0/color") << run.error().message();
}

} // namespace
} // namespace lodestar::model
