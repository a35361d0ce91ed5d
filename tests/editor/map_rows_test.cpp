// SPDX-License-Identifier: MIT
//
// The rows of the maps of skies and suns.
#include <limits>

#include "model_support.h"

namespace lodestar::model {
namespace {

std::vector<double> rowsOf(const Model& model) {
    return lighting::rowExponents(document::mapLayout(model.document()));
}

TEST(MapRowCommands, TheDefaultRowsBecomeTheDocuments) {
    Model model = sampleModel();
    const std::vector<double> usual = rowsOf(model);
    ASSERT_EQ(usual.size(), 24U);
    ASSERT_FALSE(model.document().rsrm);
    const std::uint64_t before = model.revisions().lights;
    did(model, SetMapRow{3, 0.5 * (usual[3] + usual[4])});
    EXPECT_GT(model.revisions().lights, before) << "the maps are made anew";
    std::vector<double> moved = usual;
    moved[3] = 0.5 * (usual[3] + usual[4]);
    EXPECT_EQ(rowsOf(model), moved);
    EXPECT_EQ(documentOf(textOf(model)), model.document());
    EXPECT_TRUE(model.undo());
    EXPECT_FALSE(model.document().rsrm);
    EXPECT_TRUE(model.redo());
    EXPECT_EQ(rowsOf(model), moved);
    did(model, SetMapRows{{1.0, 8.0, 64.0}});
    EXPECT_EQ(rowsOf(model), (std::vector<double>{1.0, 8.0, 64.0}));
    did(model, SetMapRows{});
    EXPECT_FALSE(model.document().rsrm) << "nothing of it is left";
    EXPECT_EQ(rowsOf(model), usual);
}

TEST(MapRowCommands, WhatIsNotOfRowsStays) {
    document::Document document = documentOf(
        R"({"lodestar": 1, "rsrm": {"exponents": [1, 2], "why": "satin"}, "lights": []})");
    Model model(document);
    did(model, SetMapRows{});
    ASSERT_TRUE(model.document().rsrm);
    EXPECT_EQ(model.document().rsrm->unknown, R"({"why":"satin"})");
    EXPECT_TRUE(model.undo());
    EXPECT_EQ(model.document(), document);
}

TEST(MapRowCommands, BadOnesAreRefused) {
    Model model = sampleModel();
    const std::vector<double> usual = rowsOf(model);
    EXPECT_EQ(refusal(model, SetMapRow{24, 5.0}), "there is no such row");
    for (const double exponent :
         {usual[1], 1.0, usual[3] * 1.001, 0.0, -1.0, std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_EQ(refusal(model, SetMapRow{2, exponent}).find("exponents of rows: "), 0U)
            << exponent;
    }
    refusal(model, SetMapRows{{8.0}});
    refusal(model, SetMapRows{{8.0, 4.0}});
    refusal(model, SetMapRows{std::vector<double>(25, 8.0)});
    EXPECT_FALSE(model.document().rsrm);
}

TEST(MapRowCommands, ADragIsOneStep) {
    Model model = sampleModel();
    const std::size_t steps = model.undoCount();
    const MergeToken token = model.newToken();
    for (const double exponent : {900.0, 1000.0, 1200.0}) {
        ASSERT_TRUE(model.execute(SetMapRow{21, exponent}, token).ok());
    }
    EXPECT_EQ(model.undoCount(), steps + 1);
    EXPECT_TRUE(model.undo());
    EXPECT_FALSE(model.document().rsrm);
}

} // namespace
} // namespace lodestar::model
