// SPDX-License-Identifier: MIT
//
// Keys of a day, axes, sun paths, lights.
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "model_support.h"

namespace lodestar::model {
namespace {

using lighting::GradientInterpolation;
using lighting::GradientSpace;
using lighting::LightKind;

/// Radiance of a light at an hour, as lighting blends it. @param degrees from the axis
glm::dvec3 radianceOfDay(const document::Document& document, std::size_t light, double hour,
                         double degrees) {
    core::Tally warnings;
    const lighting::DayLight day = document::dayLights(document, warnings).value().at(light);
    const lighting::KeyBlend keys = lighting::momentAt(day, hour).keys;
    const auto of = [&](std::size_t key) {
        return day.keys[key].tint * lighting::RadianceProfile(day.keys[key].gradient, day.kind)
                                        .radiance(glm::radians(degrees));
    };
    return (1 - keys.t) * of(keys.from) + keys.t * of(keys.to);
}

glm::dvec3 axisOfDay(const document::Document& document, std::size_t light, double hour) {
    core::Tally warnings;
    return lighting::momentAt(document::dayLights(document, warnings).value().at(light), hour).axis;
}

double largestDifference(const glm::dvec3& a, const glm::dvec3& b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

document::Document linearDay() {
    document::Document document = documentOf(kDocument);
    document.lights[0].keys[1].gradient.interpolation = GradientInterpolation::Linear;
    document.lights[0].keys[1].gradient.space = GradientSpace::Linear;
    document.lights[1].path.reset();
    document.lights[1].keys[0].axis = glm::dvec3(1, 0.2, 0);
    document.lights[1].keys[1].axis = glm::dvec3(0, 1, 0.1);
    return document;
}

TEST(Day, AnAddedKeyLeavesTheWholeDayAsItIs) {
    const document::Document before = linearDay();
    Model model(before);
    for (const double hour : {9.0, 17.99, 23.0, 3.5}) {
        for (std::size_t light = 0; light < 2; ++light) {
            did(model, AddKey{model.ids().lights[light].id, hour});
        }
    }
    EXPECT_EQ(model.document().lights[0].keys.size(), 6U);
    const document::Document& after = model.document();
    for (double hour = 0; hour < 24; hour += 0.37) {
        for (double degrees = 0.1; degrees < 180; degrees += 0.71) {
            for (std::size_t light = 0; light < 2; ++light) {
                const glm::dvec3 wanted = radianceOfDay(before, light, hour, degrees);
                const glm::dvec3 found = radianceOfDay(after, light, hour, degrees);
                // Sums of products in another order, of values up to the sun's 2^15.
                EXPECT_LE(largestDifference(wanted, found), 1e-12 * (light == 0 ? 4 : 40000))
                    << hour << " " << degrees << " " << light;
            }
        }
        EXPECT_LE(largestDifference(axisOfDay(before, 1, hour), axisOfDay(after, 1, hour)), 1e-7)
            << hour;
    }
}

TEST(Day, AKeyBetweenCurvesIsWithinAStepOfAPicture) {
    const document::Document before = documentOf(kDocument); // linear, and smooth in Oklab
    Model model(before);
    did(model, AddKey{model.ids().lights[0].id, 13.0});
    const document::Document& after = model.document();
    EXPECT_LT(after.lights[0].keys[1].gradient.stops.size(), 64U) << "few enough to go on with";
    for (double degrees = 0.1; degrees < 180; degrees += 0.1) {
        const glm::dvec3 wanted = radianceOfDay(before, 0, 13.0, degrees);
        const glm::dvec3 found = radianceOfDay(after, 0, 13.0, degrees);
        const double size = std::max({wanted.r, wanted.g, wanted.b});
        // 1/256 where it was looked at, and between those places as much again.
        EXPECT_LE(largestDifference(wanted, found), size * 2 / 256) << degrees;
    }
}

TEST(Day, TheOnlyKeyIsCopiedByAdding) {
    Model model = modelOf(LightKind::Sky, {{90, glm::dvec3(1), 0}, {-90, glm::dvec3(0), 0}});
    const Outcome added = did(model, AddKey{model.ids().lights[0].id, 30.0});
    const document::Key* const key = model.key(added.created.at(0));
    ASSERT_NE(key, nullptr);
    EXPECT_DOUBLE_EQ(key->hour, 6.0) << "brought into the day";
    EXPECT_EQ(key->gradient, model.document().lights[0].keys[1].gradient);
    EXPECT_EQ(keyId(model, 0, 0), added.created[0]) << "in the order of hours";
}

TEST(Day, KeysMoveAreCopiedAndDeleted) {
    Model model = sampleModel();
    const Id morning = keyId(model, 0, 0);
    const Id evening = keyId(model, 0, 1);
    did(model, MoveKey{morning, 20.0});
    EXPECT_EQ(keyId(model, 0, 1), morning);
    EXPECT_EQ(refusal(model, MoveKey{morning, 18.0}), "there is a key at that hour already");
    EXPECT_EQ(refusal(model, CopyKey{morning, 20.0 + 24.0}), "there is a key at that hour already");
    const Outcome copy = did(model, CopyKey{morning, -1.0});
    EXPECT_DOUBLE_EQ(model.key(copy.created.at(0))->hour, 23.0);
    EXPECT_EQ(model.key(copy.created[0])->gradient, model.key(morning)->gradient);
    EXPECT_EQ(model.key(copy.created[0])->unknown, "{\"who\":\"a\"}");
    did(model, DeleteKey{morning});
    did(model, DeleteKey{evening});
    EXPECT_EQ(refusal(model, DeleteKey{copy.created[0]}), "a light keeps its last key");
}

TEST(Day, TintAndAxisOfAKey) {
    Model model = sampleModel();
    const Id key = keyId(model);
    did(model, SetKey{key, glm::dvec3(2, 1, 0), std::optional(glm::dvec3(0, 2, 0))});
    EXPECT_EQ(model.key(key)->tint, glm::dvec3(2, 1, 0));
    EXPECT_EQ(model.key(key)->axis, glm::dvec3(0, 2, 0));
    did(model, SetKey{key, {}, std::optional<std::optional<glm::dvec3>>(std::in_place)});
    EXPECT_FALSE(model.key(key)->axis);
    EXPECT_EQ(model.key(key)->tint, glm::dvec3(2, 1, 0)) << "what is not set stays";
}

TEST(Lights, HaveNamesAxesAndPaths) {
    Model model = sampleModel();
    const Id sun = model.ids().lights[1].id;
    did(model, SetLight{sun, std::string("Helios"), {}, {}, true, {}});
    EXPECT_EQ(model.light(sun)->name, "Helios");
    EXPECT_TRUE(model.light(sun)->visibility);
    lighting::SunPath path{glm::radians(-33.9), 355, {0, 0, -1}};
    did(model, SetLight{sun, {}, {}, std::optional(path), {}, {}});
    EXPECT_NEAR(model.light(sun)->path->latitude, glm::radians(-33.9), 1e-15);
    EXPECT_EQ(model.light(sun)->pathUnknown, "{\"city\":\"Greenwich\"}");
    did(model, SetLight{sun,
                        {},
                        std::optional(glm::dvec3(1, 1, 0)),
                        std::optional<std::optional<lighting::SunPath>>(std::in_place),
                        {},
                        {}});
    EXPECT_FALSE(model.light(sun)->path);
    EXPECT_EQ(model.light(sun)->axis, glm::dvec3(1, 1, 0));
    EXPECT_EQ(model.light(sun)->keys.size(), 2U);
    EXPECT_EQ(
        refusal(model, SetLight{model.ids().lights[0].id, {}, {}, std::optional(path), {}, {}}),
        "a sky has no path; a sun has");
}

TEST(Lights, AnAngleIsWrittenAsItIsTyped) {
    Model model = sampleModel();
    const Id sun = model.ids().lights[1].id;
    for (int tenth = -900; tenth <= 900; ++tenth) {
        const double degrees = tenth / 10.0;
        lighting::SunPath path{glm::radians(degrees), 100, {0, 0, -1}};
        ASSERT_TRUE(model.execute(SetLight{sun, {}, {}, std::optional(path), {}, {}}));
        ASSERT_TRUE(model.execute(SetEnvironment{{}, glm::radians(4.0 * degrees), {}}));
        std::ostringstream written;
        written << "\"latitude\": " << degrees;
        ASSERT_NE(textOf(model).find(written.str()), std::string::npos) << written.str();
        // What text says is what is kept: another load finds the very same numbers.
        ASSERT_EQ(documentOf(textOf(model)), model.document()) << degrees;
    }
}

TEST(Lights, AreAddedRemovedAndReplaced) {
    Model model = sampleModel();
    document::Light moon = model.document().lights[1];
    moon.name = "moon";
    const Outcome added = did(model, AddLight{moon});
    EXPECT_EQ(model.light(added.created.at(0))->name, "moon");
    EXPECT_EQ(model.selection().light, added.created[0]);
    did(model, RemoveLight{model.ids().lights[0].id});
    EXPECT_EQ(model.document().lights.size(), 2U);
    did(model, SetLights{{moon}});
    EXPECT_EQ(model.document().lights.size(), 1U);
    const auto again = model.execute(SetLights{{moon}});
    ASSERT_TRUE(again);
    EXPECT_FALSE(again->changed);
}

} // namespace
} // namespace lodestar::model
