// SPDX-License-Identifier: MIT
//
// Steps of undo: names, merging, what is unsaved, revisions, selection.
#include <algorithm>

#include "model_support.h"

namespace lodestar::model {
namespace {

TEST(Undo, HasNamesBothWays) {
    Model model = sampleModel();
    const std::string start = textOf(model);
    EXPECT_TRUE(model.undoName().empty());
    EXPECT_FALSE(model.undo());
    did(model, MoveStops{{{stopId(model, 1), 30.0}}});
    did(model, SetEnvironment{{}, {}, 2.0});
    EXPECT_EQ(model.undoName(), "Set environment EV");
    EXPECT_TRUE(model.undo());
    EXPECT_EQ(model.undoName(), "Move stop");
    EXPECT_EQ(model.redoName(), "Set environment EV");
    EXPECT_TRUE(model.undo());
    EXPECT_EQ(textOf(model), start);
    EXPECT_EQ(model.redoCount(), 2U);
    EXPECT_TRUE(model.redo());
    EXPECT_DOUBLE_EQ(stopsOf(model)[1].stop.at, 30.0);
    // A new command takes the place of what was undone.
    did(model, RemoveEnvironment{});
    EXPECT_FALSE(model.redo());
    EXPECT_EQ(model.undoCount(), 2U);
}

TEST(Undo, ACommandThatChangesNothingIsNoStep) {
    Model model = sampleModel();
    for (const Command& command :
         {Command(MoveStops{{{stopId(model, 1), 20.0}}}), Command(SetEnvironment{{}, {}, 0.25}),
          Command(ResetMaterials{{"unheard of"}}), Command(SetKey{keyId(model), {}, {}}),
          Command(SimplifyStops{keyId(model), 100})}) {
        const auto outcome = model.execute(command);
        ASSERT_TRUE(outcome) << nameOf(command);
        EXPECT_FALSE(outcome->changed) << nameOf(command);
    }
    EXPECT_EQ(model.undoCount(), 0U);
    EXPECT_EQ(model.revisions().document, 0U);
    EXPECT_FALSE(model.dirty());
}

TEST(Undo, ADragIsOneStepThatStartsWhereItBegan) {
    Model model = sampleModel();
    const std::string start = textOf(model);
    const MergeToken drag = model.newToken();
    const Id stop = stopId(model, 1);
    for (double at = 20.0; at >= -45.0; at -= 0.5) { // over the step at the horizon
        ASSERT_TRUE(model.execute(MoveStops{{{stop, at}}}, drag));
    }
    EXPECT_EQ(model.undoCount(), 1U);
    EXPECT_EQ(stopId(model, 3), stop) << "it has come behind the horizon's two, with its name";
    EXPECT_EQ(placesOf(model), (std::vector<double>{90, 0, 0, -45, -90}));
    // Back where it began it is no step, and no other order of stops either.
    ASSERT_TRUE(model.execute(MoveStops{{{stop, 20.0}}}, drag));
    EXPECT_EQ(model.undoCount(), 0U);
    EXPECT_EQ(textOf(model), start);
    EXPECT_FALSE(model.dirty());
    // And the drag goes on.
    did(model, MoveStops{{{stop, 10.0}}}, drag);
    did(model, MoveStops{{{stop, 11.0}}}, drag);
    EXPECT_EQ(model.undoCount(), 1U);
    EXPECT_TRUE(model.undo());
    EXPECT_EQ(textOf(model), start);
}

TEST(Undo, ADragHeldStillRaisesNoRevision) {
    Model model = sampleModel();
    const std::string start = textOf(model);
    const MergeToken drag = model.newToken();
    const Id light = model.ids().lights[0].id;
    const auto held = [&](const Command& command) {
        did(model, command, drag);
        const Revisions before = model.revisions();
        const Identities names = model.ids();
        const std::uint64_t of = model.revisionOf(light);
        const std::string text = textOf(model);
        const auto again = model.execute(command, drag);
        ASSERT_TRUE(again);
        EXPECT_FALSE(again->changed);
        EXPECT_TRUE(again->created.empty());
        EXPECT_EQ(model.revisions().document, before.document);
        EXPECT_EQ(model.revisions().lights, before.lights);
        EXPECT_EQ(model.revisionOf(light), of);
        EXPECT_EQ(model.ids(), names);
        EXPECT_EQ(textOf(model), text);
        EXPECT_EQ(model.undoCount(), 1U);
    };
    held(MoveStops{{{stopId(model, 1), 30.0}}});
    held(MoveStops{{{stopId(model, 1), 31.0}}}); // the drag goes on
    held(CopyKey{keyId(model), 9.0});            // a part that is added again is the same one
    held(BrushStroke{keyId(model), {}, {10.0, 40.0}});
    EXPECT_TRUE(model.undo());
    EXPECT_EQ(textOf(model), start);
}

TEST(Undo, DifferentCommandsOfOneGestureAreOneStepInTheirOrder) {
    Model model = sampleModel();
    const std::string start = textOf(model);
    const MergeToken drag = model.newToken();
    const Outcome added = did(model, AddStop{keyId(model), 50.0}, drag);
    ASSERT_EQ(added.created.size(), 1U);
    did(model, MoveStops{{{added.created[0], 40.0}}}, drag);
    did(model, MoveStops{{{added.created[0], 30.0}}}, drag);
    EXPECT_EQ(placesOf(model), (std::vector<double>{90, 30, 20, 0, 0, -90}));
    EXPECT_EQ(model.undoCount(), 1U);
    EXPECT_EQ(model.undoName(), "Add stop");
    const std::string end = textOf(model);
    EXPECT_TRUE(model.undo());
    EXPECT_EQ(textOf(model), start);
    EXPECT_TRUE(model.redo());
    EXPECT_EQ(textOf(model), end);
    EXPECT_NE(model.stop(added.created[0]), nullptr);
}

TEST(Undo, MergingEndsWithTheTokenAStepBackAndASave) {
    Model model = sampleModel();
    const MergeToken field = model.newToken();
    const auto type = [&](double ev, MergeToken token) {
        did(model, SetEnvironment{{}, {}, ev}, token);
    };
    type(1.0, field);
    type(1.2, field);
    EXPECT_EQ(model.undoCount(), 1U);
    type(1.3, model.newToken());
    EXPECT_EQ(model.undoCount(), 2U);
    type(1.4, field); // its step is not the last any more
    EXPECT_EQ(model.undoCount(), 3U);
    EXPECT_TRUE(model.undo());
    EXPECT_TRUE(model.redo());
    type(1.5, field);
    EXPECT_EQ(model.undoCount(), 4U);
    model.markSaved();
    type(1.6, field);
    EXPECT_EQ(model.undoCount(), 5U);
    type(1.7, 0);
    type(1.8, 0);
    EXPECT_EQ(model.undoCount(), 7U);
    const MergeToken held = model.newToken();
    type(1.9, held);
    EXPECT_TRUE(model.undo());
    type(2.0, held); // the step below is another one's
    EXPECT_EQ(model.undoCount(), 8U);
    EXPECT_TRUE(model.undo());
    EXPECT_EQ(model.document().environment->ev, 1.8);
}

TEST(Undo, ADragThatIsCancelledIsNoStepAndCannotBeRedone) {
    Model model = sampleModel();
    did(model, AddStop{keyId(model), 50.0});
    const std::string before = textOf(model);
    const MergeToken drag = model.newToken();
    EXPECT_FALSE(model.cancel(drag)) << "it has done nothing yet";
    did(model, MoveStops{{{stopId(model, 1), 40.0}}}, drag);
    EXPECT_TRUE(model.cancel(drag));
    EXPECT_EQ(textOf(model), before);
    EXPECT_EQ(model.undoCount(), 1U);
    EXPECT_EQ(model.redoCount(), 0U);
    EXPECT_FALSE(model.cancel(drag)) << "once";
    EXPECT_FALSE(model.cancel(0)) << "a step of its own is no drag";
    EXPECT_EQ(textOf(model), before);
}

TEST(Undo, ARefusedCommandOfADragLeavesTheLastOne) {
    Model model = sampleModel();
    const MergeToken drag = model.newToken();
    const Id key = keyId(model, 0, 0);
    did(model, MoveKey{key, 17.0}, drag);
    EXPECT_FALSE(model.execute(MoveKey{key, 18.0}, drag)) << "there is a key";
    EXPECT_DOUBLE_EQ(model.key(key)->hour, 17.0);
    did(model, MoveKey{key, 19.0}, drag);
    EXPECT_EQ(keyId(model, 0, 1), key) << "keys are in the order of their hours";
    EXPECT_EQ(model.undoCount(), 1U);
}

TEST(Undo, WhatIsUnsavedFollowsTheSteps) {
    Model model = sampleModel();
    EXPECT_FALSE(model.dirty());
    did(model, RemoveEnvironment{});
    EXPECT_TRUE(model.dirty());
    model.markSaved();
    EXPECT_FALSE(model.dirty());
    EXPECT_TRUE(model.undo());
    EXPECT_TRUE(model.dirty());
    EXPECT_TRUE(model.redo());
    EXPECT_FALSE(model.dirty());
    EXPECT_TRUE(model.undo());
    did(model, SetEnvironment{{}, {}, 3.0}); // the saved state can no more be reached
    EXPECT_TRUE(model.undo());
    EXPECT_TRUE(model.dirty());
    model.markSaved();
    model.markUnsaved();
    EXPECT_TRUE(model.dirty());
}

TEST(Undo, RevisionsTellWhatChanged) {
    Model model = sampleModel();
    const Id painted = keyId(model, 0, 1);
    did(model, SetStops{{stopId(model, 0, 0, 1)}, {}, glm::dvec3(0.5), {}});
    const Revisions first = model.revisions();
    EXPECT_EQ(first.lights, first.document);
    EXPECT_EQ(first.environment + first.probes + first.materials, 0U);
    EXPECT_EQ(model.revisionOf(painted), first.document);
    EXPECT_EQ(model.revisionOf(model.lightOf(painted)), first.document);
    EXPECT_EQ(model.revisionOf(keyId(model, 0, 0)), 0U) << "its maps stay";
    EXPECT_EQ(model.revisionOf(model.ids().lights[1].id), 0U);
    did(model, SetMaterials{{"gold"}, 32.0, {}, {}, {}, {}});
    EXPECT_EQ(model.revisions().materials, model.revisions().document);
    EXPECT_EQ(model.revisions().lights, first.lights);
    did(model, SetEnvironment{{}, {}, 1.0});
    EXPECT_EQ(model.revisions().environment, model.revisions().document);
    lighting::Probe probe = model.document().probes[0].probe;
    probe.priority = 4;
    did(model, SetProbe{model.ids().probes[0], probe});
    EXPECT_EQ(model.revisions().probes, model.revisions().document);
    EXPECT_EQ(model.revisionOf(model.ids().probes[0]), model.revisions().document);
    const std::uint64_t last = model.revisions().document;
    EXPECT_TRUE(model.undo());
    EXPECT_GT(model.revisions().probes, last) << "a step back is a change too";
}

TEST(Undo, AnotherDocumentSharesNoNameAndNoRevision) {
    Model model = sampleModel();
    did(model, SetEnvironment{{}, {}, 1.0});
    const Id old = keyId(model);
    const Revisions before = model.revisions();
    model.select({Id::None, old, {}, {}, {}});
    model.reset(documentOf(kDocument));
    EXPECT_EQ(textOf(model), textOf(sampleModel()));
    EXPECT_EQ(model.undoCount() + model.redoCount(), 0U);
    EXPECT_FALSE(model.dirty());
    EXPECT_EQ(model.key(old), nullptr);
    EXPECT_EQ(model.selection(), Selection{});
    const Revisions after = model.revisions();
    for (const auto part : {&Revisions::document, &Revisions::environment, &Revisions::lights,
                            &Revisions::probes, &Revisions::materials}) {
        EXPECT_GT(after.*part, before.document);
    }
    EXPECT_EQ(model.revisionOf(keyId(model)), after.document);
    did(model, SetEnvironment{{}, {}, 1.0});
    EXPECT_TRUE(model.dirty());
}

TEST(Undo, AStepKeepsWhatItChangedAndNotTheDocument) {
    std::vector<lighting::GradientStop> stops;
    stops.reserve(10000);
    for (int i = 0; i < 10000; ++i) {
        stops.push_back({90.0 - 0.018 * i, glm::dvec3(0.5), 0.0});
    }
    Model model = modelOf(lighting::LightKind::Sky, stops);
    for (int i = 0; i < 1000; ++i) {
        did(model, SetStops{{stopId(model, static_cast<std::size_t>(i))}, {}, {}, 1.0});
    }
    // Two stops of some 100 bytes and the frame about them, not 10,000 stops.
    EXPECT_LT(model.historyBytes() / model.undoCount(), 2048U);
}

TEST(Selection, KeepsItsPartsWhileTheyChangePlaces) {
    Model model = sampleModel();
    const std::vector<Id> chosen = {stopId(model, 4), stopId(model, 1)};
    model.select({Id::None, Id::None, chosen, {}, {"gold"}});
    EXPECT_EQ(model.selection().key, keyId(model));
    EXPECT_EQ(model.selection().light, model.ids().lights[0].id);
    did(model, ReverseStops{keyId(model)});
    EXPECT_EQ(model.selection().stops, chosen);
    EXPECT_DOUBLE_EQ(model.stop(chosen[0])->stop.at, 90.0);
    did(model, DeleteStops{{chosen[0]}});
    EXPECT_EQ(model.selection().stops, (std::vector<Id>{chosen[1]}));
    EXPECT_TRUE(model.undo());
    EXPECT_NE(model.stop(chosen[0]), nullptr) << "it is back under its name";
    did(model, RemoveLight{model.ids().lights[0].id});
    EXPECT_EQ(model.selection(), (Selection{Id::None, Id::None, {}, {}, {"gold"}}));
}

TEST(Selection, IsWhatTheDocumentHasOnce) {
    Model model = sampleModel();
    const Id one = stopId(model, 0);
    const Id other = stopId(model, 0, 1, 0);
    const Id probe = model.ids().probes[0];
    model.select(
        {static_cast<Id>(999), Id::None, {one, one, other}, {probe, one, probe}, {"a", "", "a"}});
    EXPECT_EQ(model.selection(),
              (Selection{model.ids().lights[0].id, keyId(model), {one}, {probe}, {"a"}}));
    const Outcome added = did(model, AddKey{model.ids().lights[1].id, 8.0});
    EXPECT_EQ(model.selection().key, added.created.at(0)) << "what is added is selected";
    EXPECT_TRUE(model.selection().stops.empty());
    did(model, AddProbe{lighting::Probe()});
    EXPECT_EQ(model.selection().probes, (std::vector<Id>{model.ids().probes[1]}));
}

TEST(ReplaceDocumentCommand, KeepsNamesByPlace) {
    Model model = sampleModel();
    const Id stop = stopId(model, 1);
    document::Document other = model.document();
    other.lights[0].keys[0].gradient.stops[1].stop.ev = 3.0;
    other.lights[0].keys[0].gradient.stops.emplace_back();
    other.lights.pop_back();
    did(model, ReplaceDocument{other});
    EXPECT_EQ(stopId(model, 1), stop);
    EXPECT_EQ(model.document(), other);
    EXPECT_TRUE(model.undo());
    EXPECT_EQ(textOf(model), textOf(sampleModel()));
}

TEST(Undo, SelectsNothingThatIsGone) {
    Model model = sampleModel();
    const Id added = did(model, AddStop{keyId(model), 45.0}).created.at(0);
    ASSERT_EQ(model.selection().stops, std::vector<Id>{added});
    ASSERT_TRUE(model.undo());
    EXPECT_TRUE(model.selection().stops.empty());
    EXPECT_EQ(model.selection().key, keyId(model)) << "what is still there stays selected";
    const Id last = stopId(model, 4);
    did(model, DeleteStops{{last}});
    ASSERT_TRUE(model.undo());
    Selection selection;
    selection.stops = {last};
    model.select(selection);
    ASSERT_TRUE(model.redo());
    EXPECT_TRUE(model.selection().stops.empty());
}

} // namespace
} // namespace lodestar::model
