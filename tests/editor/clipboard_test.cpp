// SPDX-License-Identifier: MIT
//
// Copy and paste as text.
#include "model/clipboard.h"
#include "model_support.h"

namespace lodestar::model {
namespace {

std::string copied(const core::Result<std::string>& text) {
    EXPECT_TRUE(text) << (text ? "" : text.error().message());
    return text ? *text : std::string();
}

Outcome paste(Model& model, const std::string& text, const PasteTarget& target) {
    const auto command = pasteCommand(model, text, target);
    EXPECT_TRUE(command) << (command ? "" : command.error().message());
    return command ? did(model, *command) : Outcome{};
}

std::string refusedPaste(const Model& model, const std::string& text, const PasteTarget& target) {
    const auto command = pasteCommand(model, text, target);
    EXPECT_FALSE(command) << text;
    return command ? std::string() : command.error().what;
}

TEST(Clipboard, StopsGoToAnotherGradient) {
    Model model = sampleModel();
    // In any order of selecting.
    const std::string text = copied(copyStops(model, {stopId(model, 2), stopId(model, 0)}));
    const Outcome pasted = paste(model, text, {keyId(model, 0, 1), {}, {}, {}});
    EXPECT_EQ(placesOf(model, 0, 1), (std::vector<double>{90, 90, 10, 0, -90}));
    ASSERT_EQ(pasted.created.size(), 2U);
    EXPECT_EQ(*model.stop(pasted.created[0]), stopsOf(model)[0]) << "unknown members too";
    EXPECT_EQ(*model.stop(pasted.created[1]), stopsOf(model)[2]);
    EXPECT_EQ(model.selection().stops, pasted.created);
}

TEST(Clipboard, AGradientAKeyAndAMaterialComeBackEqual) {
    Model model = sampleModel();
    const std::string gradient = copied(copyGradient(model, keyId(model, 0, 0)));
    paste(model, gradient, {keyId(model, 0, 1), {}, {}, {}});
    EXPECT_EQ(model.document().lights[0].keys[1].gradient,
              model.document().lights[0].keys[0].gradient);
    const std::string key = copied(copyKey(model, keyId(model, 0, 0)));
    Model other = sampleModel();
    const Outcome pasted = paste(other, key, {{}, other.ids().lights[0].id, 9.5, {}});
    document::Key wanted = model.document().lights[0].keys[0];
    wanted.hour = 9.5;
    EXPECT_EQ(*other.key(pasted.created.at(0)), wanted);
    const std::string material = copied(copyMaterial(model, "gold"));
    paste(other, material, {{}, {}, {}, {"#2", "lead"}});
    EXPECT_EQ(other.document().materials.at("lead").f0, glm::dvec3(1, 0.8, 0.3));
    EXPECT_EQ(other.document().materials.at("#2").exponent, 64.0);
}

TEST(Clipboard, BetweenASkyAndASunAnglesAreFromTheAxis) {
    Model model = sampleModel();
    const std::string sky = copied(copyGradient(model, keyId(model, 0, 0)));
    paste(model, sky, {keyId(model, 1, 1), {}, {}, {}});
    EXPECT_EQ(placesOf(model, 1, 1), (std::vector<double>{0, 70, 90, 90, 180}));
    const std::string sun = copied(copyKey(model, keyId(model, 1, 0)));
    const Outcome pasted = paste(model, sun, {{}, model.ids().lights[0].id, 3.0, {}});
    EXPECT_EQ(model.key(pasted.created.at(0))->gradient.stops.back().stop.at, 70.0);
}

TEST(Clipboard, ForeignTextIsRefusedInASentence) {
    const Model model = sampleModel();
    const PasteTarget target{keyId(model), model.ids().lights[0].id, 3.0, {"gold"}};
    const std::string whole = textOf(model);
    std::string other = copied(copyGradient(model, keyId(model)));
    other.replace(other.find("gradient\"", other.find("clipboard")), 9, "teapot\"");
    std::string more = copied(copyGradient(model, keyId(model)));
    more.insert(more.find("\"clipboard"), "\"another\": 1, ");
    for (const std::string& text :
         {std::string(), more, std::string("hello"), std::string("{}"), std::string("[1,2,3]"),
          whole, other, std::string("#ff8800"), std::string(100000, '['),
          std::string("\xff\xfe\0x", 4), std::string(R"({"lodestar":1,"clipboard":"stops"})"),
          std::string(R"({"lodestar":1,"clipboard":"material","materials":{}})"),
          std::string(R"({"lodestar":2,"clipboard":"stops","lights":[]})")}) {
        EXPECT_EQ(refusedPaste(model, text, target),
                  "the text is no stops, gradient, key or material of Lodestar's");
    }
}

TEST(Clipboard, APasteNeedsAPlace) {
    Model model = sampleModel();
    const std::string stops = copied(copyStops(model, {stopId(model, 0)}));
    const std::string key = copied(copyKey(model, keyId(model)));
    const std::string material = copied(copyMaterial(model, "gold"));
    for (const std::string& text : {stops, key, material}) {
        EXPECT_NE(refusedPaste(model, text, {}).find("selected"), std::string::npos);
    }
    // At an hour that is taken the command refuses.
    const auto command = pasteCommand(model, key, {{}, model.ids().lights[0].id, 18.0, {}});
    ASSERT_TRUE(command);
    EXPECT_EQ(refusal(model, *command), "there is a key at that hour already");
}

TEST(Clipboard, OnlyWhatIsThereIsCopied) {
    const Model model = sampleModel();
    EXPECT_FALSE(copyStops(model, {}));
    EXPECT_FALSE(copyStops(model, {static_cast<Id>(999)}));
    EXPECT_FALSE(copyStops(model, {stopId(model, 0), stopId(model, 0, 1, 0)}));
    EXPECT_FALSE(copyGradient(model, Id::None));
    EXPECT_FALSE(copyKey(model, stopId(model, 0)));
    EXPECT_FALSE(copyMaterial(model, "lead"));
}

} // namespace
} // namespace lodestar::model
