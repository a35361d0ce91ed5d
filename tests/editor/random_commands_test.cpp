// SPDX-License-Identifier: MIT
//
// Ten thousand commands of every kind, wild values among them: after each the document is read from
// its own text as the same bytes, and undo and redo pass every one of its states again.
#include <functional>
#include <set>

#include "random_commands.h"
#include "support/fuzz.h"

namespace lodestar::model {
namespace {

std::size_t hashOf(const std::string& text) {
    return std::hash<std::string>()(text);
}

/// Lists of names are as long as what they name, and each name is given once.
void expectNamed(const Model& model) {
    std::set<Id> seen;
    std::size_t count = 0;
    const auto take = [&](Id id) {
        seen.insert(id);
        ++count;
    };
    const auto& lights = model.document().lights;
    ASSERT_EQ(model.ids().lights.size(), lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const LightIds& names = model.ids().lights[i];
        take(names.id);
        ASSERT_EQ(names.keys.size(), lights[i].keys.size());
        for (std::size_t k = 0; k < names.keys.size(); ++k) {
            take(names.keys[k].id);
            ASSERT_EQ(names.keys[k].stops.size(), lights[i].keys[k].gradient.stops.size());
            for (const Id stop : names.keys[k].stops) {
                take(stop);
            }
        }
    }
    ASSERT_EQ(model.ids().probes.size(), model.document().probes.size());
    for (const Id probe : model.ids().probes) {
        take(probe);
    }
    EXPECT_EQ(seen.size(), count);
    EXPECT_FALSE(seen.contains(Id::None));
}

/// Commands of a seed, and their way back and forth.
void passEveryState(std::uint64_t seed) {
    constexpr std::size_t kCommands = 10000;
    Model model = sampleModel();
    Generator generator(seed, model);
    const std::string start = textOf(model);
    std::vector<std::size_t> hashes = {hashOf(start)}; // by undoCount
    std::vector<std::size_t> accepted(std::variant_size_v<Command>, 0);
    std::vector<std::size_t> refused(std::variant_size_v<Command>, 0);
    MergeToken token = 0;
    for (std::size_t i = 0; i < kCommands; ++i) {
        token = generator.chance().one(3)   ? token
                : generator.chance().one(3) ? model.newToken()
                                            : 0;
        const Command command = generator.next();
        const auto outcome = model.execute(command, token);
        (outcome ? accepted : refused)[command.index()]++;
        const std::string text = textOf(model);
        core::Tally warnings;
        const auto read = document::parseDocument(text, warnings);
        ASSERT_TRUE(read) << i << " " << nameOf(command) << ": " << read.error().message();
        ASSERT_EQ(document::writeDocument(*read), text) << i << " " << nameOf(command);
        ASSERT_EQ(*read, model.document()) << i << " " << nameOf(command);
        hashes.resize(model.undoCount());
        hashes.push_back(hashOf(text));
        ASSERT_EQ(hashes.size(), model.undoCount() + 1);
        if (i % 50 == 0) {
            expectNamed(model);
        }
        if (!outcome) {
            ASSERT_FALSE(outcome.error().what.empty());
        }
    }
    for (std::size_t type = 0; type < accepted.size(); ++type) {
        EXPECT_GT(accepted[type], 0U) << type;
        EXPECT_TRUE(refused[type] > 0U || type == 24 || type == 26 || type == 32) << type;
    }
    const std::string end = textOf(model);
    const Identities names = model.ids();
    EXPECT_GT(model.undoCount(), kCommands / 4);
    ::testing::Test::RecordProperty("history_bytes", std::to_string(model.historyBytes()));
    // A change keeps what it changed, not the document.
    EXPECT_LT(model.historyBytes(), std::size_t{64} << 20);
    while (model.undo()) {
        ASSERT_EQ(hashOf(textOf(model)), hashes[model.undoCount()]) << model.undoCount();
    }
    EXPECT_EQ(textOf(model), start);
    EXPECT_FALSE(model.dirty());
    expectNamed(model);
    while (model.redo()) {
        ASSERT_EQ(hashOf(textOf(model)), hashes[model.undoCount()]) << model.undoCount();
    }
    EXPECT_EQ(textOf(model), end);
    EXPECT_EQ(model.ids(), names);
}

TEST(RandomCommands, EveryStateIsPassedAgain) {
    for (int round = 0; round < testing::fuzzRounds(1); ++round) {
        SCOPED_TRACE(round);
        passEveryState(20261129U + static_cast<unsigned>(round));
        if (HasFatalFailure()) {
            return;
        }
    }
}

} // namespace
} // namespace lodestar::model
