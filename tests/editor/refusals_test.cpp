// SPDX-License-Identifier: MIT
//
// What is typed wrong: no number, a negative one, one beyond its range, a name of nothing.
#include <cmath>
#include <limits>

#include "model_support.h"

namespace lodestar::model {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
const double kNan = std::nan("");
const Id kNone = static_cast<Id>(12345);

TEST(Refusals, NumbersThatAreNone) {
    for (const double bad : {kNan, kInf, -kInf}) {
        Model model = sampleModel();
        const Id key = keyId(model);
        const Id stop = stopId(model, 1);
        const Id light = model.ids().lights[0].id;
        const Id sun = model.ids().lights[1].id;
        const glm::dvec3 vector(0, bad, 0);
        document::Key documentKey = model.document().lights[0].keys[0];
        documentKey.hour = bad;
        document::Light documentLight = model.document().lights[0];
        documentLight.keys[0].gradient.stops[2].stop.color.g = bad;
        const Command commands[] = {
            AddStop{key, bad},
            InsertStops{key, {{{1.0, vector, 0.0}, {}}}},
            InsertStops{key, {{{bad, glm::dvec3(1), 0.0}, {}}}},
            InsertStops{key, {{{1.0, glm::dvec3(1), bad}, {}}}},
            MoveStops{{{stop, bad}}},
            SetStops{{stop}, bad, {}, {}},
            SetStops{{stop}, {}, vector, {}},
            SetStops{{stop}, {}, {}, bad},
            SetGradient{key, documentLight.keys[0].gradient},
            AddKey{light, bad},
            InsertKey{light, documentKey},
            MoveKey{key, bad},
            CopyKey{key, bad},
            SetKey{key, vector, {}},
            SetKey{key, {}, std::optional(vector)},
            AddLight{documentLight},
            SetLights{{documentLight}},
            SetLight{light, {}, std::optional(vector), {}, {}, {}},
            SetLight{sun, {}, {}, std::optional(lighting::SunPath{bad, 1, {0, 0, -1}}), {}, {}},
            SetLight{sun, {}, {}, std::optional(lighting::SunPath{0, 1, vector}), {}, {}},
            SetEnvironment{{}, bad, {}},
            SetEnvironment{{}, {}, bad},
            SetMaterials{{"gold"}, {}, vector, {}, {}, {}},
            SetMaterials{{"gold"}, {}, {}, vector, {}, {}},
            SetMaterials{{"gold"}, {}, {}, {}, {}, bad},
        };
        for (const Command& command : commands) {
            EXPECT_EQ(refusal(model, command), "a number is needed, not NaN or infinity");
        }
    }
    Model model = sampleModel();
    refusal(model, SetMaterials{{"gold"}, kNan, {}, {}, {}, {}});
    refusal(model, SetMaterials{{"gold"}, -kInf, {}, {}, {}, {}});
}

TEST(Refusals, ValuesOutOfRange) {
    Model model = sampleModel();
    const Id key = keyId(model);
    const Id stop = stopId(model, 1);
    const Id sun = model.ids().lights[1].id;
    const auto path = [&](double latitude, int day, glm::dvec3 north) {
        return SetLight{sun, {}, {}, std::optional(lighting::SunPath{latitude, day, north}),
                        {},  {}};
    };
    const std::pair<Command, const char*> cases[] = {
        {SetStops{{stop}, {}, glm::dvec3(1, -0.1, 1), {}}, "a colour is not negative"},
        {SetStops{{stop}, {}, glm::dvec3(2e9, 0, 0), {}}, "a radiance lies from 0 to 1e9"},
        {SetStops{{stop}, {}, {}, 40.0}, "a radiance lies from 0 to 1e9"},
        {SetStops{{stop}, {}, glm::dvec3(0), 64.5}, "an ev lies from -64 to 64 stops"},
        {SetKey{key, glm::dvec3(-1, 0, 0), {}}, "a tint's factors lie from 0 to 1e9"},
        {SetKey{key, {}, std::optional(glm::dvec3(0))}, "an axis needs a direction"},
        {SetKey{key, {}, std::optional(glm::dvec3(1e-13))}, "an axis needs a direction"},
        {SetKey{key, {}, std::optional(glm::dvec3(1e200))}, "an axis needs a direction"},
        {path(1.6, 1, {0, 0, -1}), "a latitude lies from -90 to 90 degrees"},
        {path(0, 0, {0, 0, -1}), "a day of the year lies from 1 to 366"},
        {path(0, 367, {0, 0, -1}), "a day of the year lies from 1 to 366"},
        {path(0, 1, {0, 1, 0}), "north needs a part across +Y"},
        {SetEnvironment{{}, {}, 65.0}, "an ev lies from -64 to 64 stops"},
        {SetMaterials{{"gold"}, 1e8, {}, {}, {}, {}},
         "an exponent lies from 0 to 1e7, or is \"mirror\""},
        {SetMaterials{{"gold"}, -1.0, {}, {}, {}, {}},
         "an exponent lies from 0 to 1e7, or is \"mirror\""},
        {SetMaterials{{"gold"}, {}, glm::dvec3(1.1), {}, {}, {}}, "a reflectance lies in [0, 1]"},
        {SetMaterials{{"gold"}, {}, {}, {}, {}, 0.0}, "a tolerance is a relative error above 0"},
        {AddLight{document::Light{}}, "a light needs at least one key"},
        {SetGradient{key, document::Gradient{}}, "a gradient needs at least one stop"},
        {InsertStops{key, {}}, "no stop is given"},
        {MoveStops{}, "no stop is named"},
        {SetStops{}, "no stop is named"},
        {SimplifyStops{key, 0}, "a gradient keeps its last two stops"},
    };
    for (const auto& [command, sentence] : cases) {
        EXPECT_EQ(refusal(model, command), sentence) << nameOf(command);
    }
    EXPECT_FALSE(
        refusal(model, SetMaterials{{"gold"}, {}, {}, {}, std::string("magic"), {}}).empty());
}

TEST(Refusals, LightThatItsTintMakesTooBright) {
    const char* const sentence = "a radiance times its key's tint lies from 0 to 1e9";
    Model model = sampleModel();
    document::Key bright = model.document().lights[0].keys[0];
    bright.hour = 3.0;
    bright.tint.b = 1e9;
    bright.gradient.stops[2].stop.color.b = 1.5;
    did(model, SetKey{keyId(model), glm::dvec3(1, 1, 1e9), {}}); // on blue of at most 0.57
    EXPECT_EQ(refusal(model, SetStops{{stopId(model, 1)}, {}, glm::dvec3(0, 0, 2), {}}), sentence);
    EXPECT_EQ(refusal(model, SetKey{keyId(model, 1), glm::dvec3(1e6), {}}), sentence); // of ev 14
    EXPECT_EQ(refusal(model, InsertKey{model.ids().lights[0].id, bright}), sentence);
    // What was read so stays as it was written: lighting lowers it, and it may be edited.
    document::Document read = model.document();
    read.lights[0].keys[0].tint = glm::dvec3(1e9);
    read.lights[0].keys[0].gradient.stops[2].stop.color.b = 1.5;
    did(model, ReplaceDocument{read});
    did(model, MoveKey{keyId(model), 7.0});
    did(model, SetKey{keyId(model), glm::dvec3(1), {}});
    EXPECT_EQ(refusal(model, SetKey{keyId(model), glm::dvec3(1e9), {}}), sentence);
}

TEST(Refusals, NamesOfNothing) {
    Model model = sampleModel();
    const Id light = model.ids().lights[0].id;
    const Id key = keyId(model);
    const Id stop = stopId(model, 0);
    for (const Id bad : {Id::None, kNone}) {
        for (const Command& command :
             {Command(AddStop{bad, 0}),
              Command(InsertStops{bad, {document::Stop{}}}),
              Command(MoveStops{{{stop, 1}, {bad, 1}}}),
              Command(SetStops{{bad}, 1.0, {}, {}}),
              Command(DeleteStops{{bad}}),
              Command(ReverseStops{bad}),
              Command(MirrorStops{bad}),
              Command(DistributeStops{bad}),
              Command(SimplifyStops{bad, 4}),
              Command(SetGradient{bad, model.document().lights[0].keys[0].gradient}),
              Command(SetInterpolation{bad}),
              Command(SetSpace{bad}),
              Command(BrushStroke{bad, Brush{}, {0}}),
              Command(AddKey{bad, 3}),
              Command(InsertKey{bad, model.document().lights[0].keys[0]}),
              Command(MoveKey{bad, 3}),
              Command(CopyKey{bad, 3}),
              Command(DeleteKey{bad}),
              Command(SetKey{bad, {}, {}}),
              Command(RemoveLight{bad}),
              Command(SetLight{bad, {}, {}, {}, true, {}}),
              Command(SetProbe{bad, {}}),
              Command(RemoveProbes{{bad}})}) {
            EXPECT_FALSE(refusal(model, command).empty()) << nameOf(command);
        }
    }
    // A name of another kind of part is none either.
    refusal(model, AddStop{light, 0});
    refusal(model, MoveKey{stop, 3});
    refusal(model, RemoveLight{key});
    refusal(model, RemoveProbes{{light}});
}

TEST(Refusals, SmallAndOddNumbersAreMended) {
    Model model = sampleModel();
    const Id stop = stopId(model, 1);
    did(model, SetStops{{stop}, 5e-324, glm::dvec3(-0.0, 1e-310, 0.5), -0.0});
    const lighting::GradientStop& stops = model.stop(stop)->stop;
    for (const double value : {stops.at, stops.color.r, stops.color.g, stops.ev}) {
        EXPECT_EQ(value, 0.0);
        EXPECT_FALSE(std::signbit(value));
    }
    did(model, MoveStops{{{stop, 1e300}}});
    EXPECT_EQ(model.stop(stop)->stop.at, 90.0);
    did(model, MoveKey{keyId(model), 1e9 + 7.0});
    const double hour = model.document().lights[0].keys[0].hour;
    EXPECT_TRUE(hour >= 0.0 && hour < 24.0) << hour;
}

TEST(Refusals, UnknownMembersThatAreNoText) {
    Model model = sampleModel();
    const Id key = keyId(model);
    const std::string deep = "{\"x\":" + std::string(80, '[') + std::string(80, ']') + "}";
    const document::Stop stop{{10.0, glm::dvec3(1), 0.0}, deep};
    document::Key whole = model.document().lights[0].keys[0];
    whole.hour = 3.0;
    whole.gradient.unknown = deep;
    document::Light light = model.document().lights[0];
    light.unknown = deep;
    for (const Command& command :
         {Command(InsertStops{key, {stop}}), Command(SetGradient{key, whole.gradient}),
          Command(InsertKey{model.ids().lights[0].id, whole}), Command(AddLight{light})}) {
        EXPECT_EQ(refusal(model, command), "the document is nested deeper than 64 levels")
            << nameOf(command);
    }
    const Outcome added = did(model, InsertStops{key, {{{10.0, glm::dvec3(1), 0.0}, "no JSON"}}});
    EXPECT_TRUE(model.stop(added.created.at(0))->unknown.empty());
    EXPECT_EQ(documentOf(textOf(model)), model.document());
}

TEST(Refusals, MoreThanTextHolds) {
    Model model = sampleModel();
    const Id key = keyId(model);
    EXPECT_EQ(refusal(model, InsertStops{key, std::vector<document::Stop>(kMostStops)}),
              "a gradient has at most 65536 stops");
    document::Gradient gradient;
    gradient.stops.resize(kMostStops + 1);
    EXPECT_EQ(refusal(model, SetGradient{key, gradient}), "a gradient has at most 65536 stops");
    // Members that no version knows, of many stops: one key holds them, two are too much.
    gradient.stops.resize(35000);
    for (document::Stop& stop : gradient.stops) {
        stop.unknown = "{\"x\":\"" + std::string(1100, 'y') + "\"}";
    }
    did(model, SetGradient{key, gradient});
    const auto second = model.execute(SetGradient{keyId(model, 0, 1), gradient});
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().what, "a lighting document has at most 64 MiB");
    EXPECT_EQ(model.undoCount(), 1U);
    EXPECT_EQ(documentOf(textOf(model)), model.document());
}

} // namespace
} // namespace lodestar::model
