// SPDX-License-Identifier: MIT
//
// The lighting document: what is read, refused and mended, and that nothing is lost by a save.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <random>
#include <string>

#include <unistd.h>

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "document/document.h"
#include "io/document_file.h"

namespace lodestar::document {
namespace {

using nlohmann::json;

/// A document with everything in it, and a member of its own in every object.
const std::string kFull = R"({
  "lodestar": 1, "author": {"name": "someone"},
  "environment": {"source": "park.hdr", "rotation": 30, "ev": -1.5, "credit": "x"},
  "lights": [
    {"name": "sky", "kind": "sky", "axis": [0, 2, 0], "add": true, "mood": "calm", "keys": [
      {"hour": 6, "note": 1, "tint": [1, 0.5, 0.25], "gradient": {"interpolation": "smooth",
        "space": "oklab", "hue": 3, "stops": [
          {"at": 90, "color": [0.1, 0.2, 0.5], "ev": 1, "locked": true},
          {"at": 0, "color": [1, 0.9, 0.8]}, {"at": 0, "color": [0.1, 0.1, 0.1]}]}},
      {"hour": 18, "axis": [0, 1, 0.1], "gradient": {"stops": [{"at": 90, "color": [1, 1, 1]}]}}]},
    {"kind": "sun", "path": {"latitude": 47.5, "dayOfYear": 172, "north": [0, 0, -1], "city": "?"},
     "visibility": false, "keys": [{"hour": 12, "gradient": {"interpolation": "constant",
       "stops": [{"at": 0, "color": [1, 1, 1], "ev": 15.5}, {"at": 0.27, "color": [0, 0, 0]}]}}]}],
  "rsrm": {"exponents": [1, 8.5, 64, 16384], "why": "satin"},
  "probes": [{"name": "hall", "position": [1, 2, 3], "mood": "warm", "source": "hall.exr",
     "capture": {"resolution": 64, "near": 0.25, "far": 50, "layers": 5, "by": "me"},
     "update": {"every": 4, "why": "slow"}, "relight": "ratio", "priority": 2, "exterior": false, "tint": [1, 0.5, 0.25],
     "intensity": 2, "influence": {"shape": "box", "center": [0, 1, 0], "size": [4, 3, 6],
     "blend": [1, 1, 0, 0, 0.5, 0.5], "color": "red"},
     "proxy": {"shape": "sphere", "center": [0, 0, 0], "radius": 4, "blend": 0, "soft": 1}},
    {"name": "lift", "node": "Lift", "update": "always"}],
  "materials": {"gold": {"exponent": 64, "f0": [1, 0.8, 0.3], "tag": 7},
                "#2": {"exponent": "mirror", "diffuse": [0, 0, 0], "specular": "mip", "tolerance": 0.1}}
})";

core::Result<Document> parse(const std::string& text) {
    core::Tally warnings;
    return parseDocument(text, warnings);
}

/// The full document with a patch (RFC 7386: null removes) merged in.
std::string patched(const std::string& pointer, const json& value) {
    json tree = json::parse(kFull);
    tree[json::json_pointer(pointer)] = value;
    return tree.dump();
}

TEST(Document, ReadsWhatItSays) {
    core::Tally warnings;
    const auto document = parseDocument(kFull, warnings);
    ASSERT_TRUE(document.ok()) << document.error().message();
    EXPECT_EQ(document->environment->source, "park.hdr");
    EXPECT_DOUBLE_EQ(document->environment->rotation, glm::radians(30.0));
    EXPECT_EQ(document->environment->ev, -1.5);
    ASSERT_EQ(document->lights.size(), 2u);
    const Light& sky = document->lights[0];
    EXPECT_TRUE(sky.add);
    EXPECT_TRUE(sky.visibility);
    EXPECT_EQ(sky.keys[0].gradient.interpolation, lighting::GradientInterpolation::Smooth);
    EXPECT_EQ(sky.keys[0].gradient.space, lighting::GradientSpace::Oklab);
    EXPECT_EQ(sky.keys[0].gradient.stops[0].stop.ev, 1.0);
    EXPECT_EQ(sky.keys[0].tint, glm::dvec3(1.0, 0.5, 0.25));
    EXPECT_EQ(sky.keys[1].gradient.interpolation, lighting::GradientInterpolation::Linear);
    const Light& sun = document->lights[1];
    EXPECT_EQ(sun.kind, lighting::LightKind::Sun);
    EXPECT_FALSE(sun.visibility);
    EXPECT_DOUBLE_EQ(sun.path->latitude, glm::radians(47.5));
    EXPECT_EQ(sun.path->dayOfYear, 172);
    EXPECT_TRUE(std::isinf(*document->materials.at("#2").exponent));
    EXPECT_EQ(*document->materials.at("#2").specular, "mip");
    EXPECT_EQ(document->rsrm->exponents, (std::vector<double>{1.0, 8.5, 64.0, 16384.0}));
    const lighting::RsrmLayout maps = mapLayout(*document);
    EXPECT_EQ(lighting::rowExponents(maps), document->rsrm->exponents);
    EXPECT_EQ(lighting::texelBytes(maps), 4u * 170u * 4u) << "fewer rows are a smaller map";
    EXPECT_EQ(mapLayout(Document()), lighting::kRsrm);
    EXPECT_TRUE(warnings.counts().empty());
    const auto lights = dayLights(*document, warnings);
    ASSERT_TRUE(lights.ok());
    EXPECT_EQ((*lights)[0].axis, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ((*lights)[0].name, "sky");
}

// Every member comes back, those that no version knows too.
TEST(Document, SurvivesASaveWhole) {
    const auto first = parse(kFull);
    ASSERT_TRUE(first.ok());
    const std::string text = writeDocument(*first);
    const auto again = parse(text);
    ASSERT_TRUE(again.ok()) << again.error().message();
    EXPECT_EQ(writeDocument(*again), text);
    json expected = json::parse(kFull);
    // What was left to its default is written out.
    expected["lights"][0]["keys"][0]["gradient"]["stops"][1]["ev"] = 0.0;
    expected["lights"][0]["keys"][0]["gradient"]["stops"][2]["ev"] = 0.0;
    json& second = expected["lights"][0]["keys"][1];
    second["tint"] = {1.0, 1.0, 1.0};
    second["gradient"]["interpolation"] = "linear";
    second["gradient"]["space"] = "linear";
    second["gradient"]["stops"][0]["ev"] = 0.0;
    json& noon = expected["lights"][1]["keys"][0];
    noon["tint"] = {1.0, 1.0, 1.0};
    noon["gradient"]["space"] = "linear";
    noon["gradient"]["stops"][1]["ev"] = 0.0;
    expected["probes"][1] = json::parse(R"({"name": "lift", "node": "Lift", "position": [0, 0, 0],
        "capture": {"resolution": 128, "near": 0.05, "far": 1000}, "update": "always",
        "influence": {"shape": "box", "center": [0, 0, 0], "size": [10, 10, 10], "blend": 0},
        "priority": 0, "exterior": true, "tint": [1, 1, 1], "intensity": 1})");
    EXPECT_EQ(json::parse(text), expected);
}

struct Refused {
    const char* pointer;
    json value;
    const char* where; ///< null: the pointer itself
};

TEST(Document, RefusesWithThePointer) {
    const Refused cases[] = {
        {"/lodestar", 2, nullptr},
        {"/lodestar", "1", nullptr},
        {"/environment/source", "", nullptr},
        {"/environment/source", 3, nullptr},
        {"/environment/ev", 65, nullptr},
        {"/lights", json::object(), nullptr},
        {"/lights/0", 3, nullptr},
        {"/lights/0/kind", "moon", nullptr},
        {"/lights/0/axis", {0, 1}, nullptr},
        {"/lights/0/axis/1", "up", nullptr},
        {"/lights/0/path", {{"latitude", 1}}, nullptr},
        {"/lights/0/keys", json::array(), nullptr},
        {"/lights/0/keys/0/hour", "noon", nullptr},
        {"/lights/0/keys/0/gradient/stops", json::array(), nullptr},
        {"/lights/0/keys/0/gradient/stops/0/at", 91, nullptr},
        {"/lights/1/keys/0/gradient/stops/0/at", -1, nullptr},
        {"/lights/0/keys/0/gradient/stops/0/color", "red", nullptr},
        {"/lights/0/keys/0/gradient/interpolation", "bezier", nullptr},
        {"/lights/0/keys/0/gradient/space", "hsv", nullptr},
        {"/lights/1/path/latitude", 91, nullptr},
        {"/lights/1/path/dayOfYear", 367, nullptr},
        {"/lights/1/path/dayOfYear", 1.5, nullptr},
        {"/lights/1/path/north", {0, 1, 0}, nullptr},
        {"/lights/1/visibility", "yes", nullptr},
        {"/rsrm", 1, nullptr},
        {"/rsrm/exponents", 8, nullptr},
        {"/rsrm/exponents", json::array(), nullptr},
        {"/rsrm/exponents", {8}, nullptr},
        {"/rsrm/exponents", std::vector<double>(25, 8.0), nullptr},
        {"/rsrm/exponents", {0.5, 8}, "/rsrm/exponents/0"},
        {"/rsrm/exponents", {1, 16385}, "/rsrm/exponents/1"},
        {"/rsrm/exponents", {1, 8, 8}, "/rsrm/exponents/2"},
        {"/rsrm/exponents", {1, 8, 8.07}, "/rsrm/exponents/2"},
        {"/rsrm/exponents", {64, 8}, "/rsrm/exponents/1"},
        {"/rsrm/exponents/1", "sharp", nullptr},
        {"/rsrm/exponents/1", nullptr, nullptr},
        {"/probes", 1, nullptr},
        {"/probes/0", 1, nullptr},
        {"/probes/0/name", 1, nullptr},
        {"/probes/0/node", "", nullptr},
        {"/probes/0/position", {0, 1}, nullptr},
        {"/probes/0/source", "", nullptr},
        {"/probes/0/capture/resolution", 0, nullptr},
        {"/probes/0/capture/resolution", 16385, nullptr},
        {"/probes/0/capture/resolution", 1.5, nullptr},
        {"/probes/0/capture/near", 0, nullptr},
        {"/probes/0/capture/near", 60, "/probes/0/capture"},
        {"/probes/0/capture/layers", -1, nullptr},
        {"/probes/0/update", "sometimes", nullptr},
        {"/probes/0/update/every", 0, nullptr},
        {"/probes/0/update", json::object(), "/probes/0/update"},
        {"/probes/0/influence/shape", "cone", nullptr},
        {"/probes/0/influence/size", {1, -1, 1}, nullptr},
        {"/probes/0/influence/radius", 1, nullptr},
        {"/probes/0/influence/blend", -1, nullptr},
        {"/probes/0/influence/blend", {1, 2}, nullptr},
        {"/probes/0/proxy/radius", -1, nullptr},
        {"/probes/0/proxy/size", {1, 1, 1}, nullptr},
        {"/probes/0/priority", 0.5, nullptr},
        {"/probes/0/exterior", 1, nullptr},
        {"/probes/0/relight", "sum", nullptr},
        {"/probes/0/tint", {1, 1, -1}, nullptr},
        {"/probes/0/intensity", -1, nullptr},
        {"/materials", json::array(), nullptr},
        {"/materials/gold/exponent", -1, nullptr},
        {"/materials/gold/exponent", 2e7, nullptr},
        {"/materials/gold/exponent", "shiny", nullptr},
        {"/materials/gold/f0", {1, 2, 3}, nullptr},
        {"/materials/#2/specular", "magic", nullptr},
        {"/materials/#2/tolerance", 0, nullptr},
    };
    for (const Refused& each : cases) {
        const auto document = parse(patched(each.pointer, each.value));
        ASSERT_FALSE(document.ok()) << each.pointer << " = " << each.value;
        EXPECT_EQ(document.error().where, each.where != nullptr ? each.where : each.pointer)
            << document.error().message();
        EXPECT_EQ(document.error().code, core::ErrorCode::InputRefused);
        EXPECT_EQ(document.error().message().find('\n'), std::string::npos);
    }
}

TEST(Document, NamesWhatIsMissing) {
    for (const char* pointer :
         {"/lodestar", "/lights/0/kind", "/lights/0/keys", "/lights/0/keys/0/hour",
          "/lights/0/keys/0/gradient", "/lights/0/keys/0/gradient/stops",
          "/lights/0/keys/0/gradient/stops/0/at", "/lights/0/keys/0/gradient/stops/0/color",
          "/lights/1/path/latitude", "/environment/source"}) {
        const json::json_pointer place(pointer);
        json tree = json::parse(kFull);
        tree[place.parent_pointer()].erase(place.back());
        const auto document = parse(tree.dump());
        ASSERT_FALSE(document.ok()) << pointer;
        EXPECT_NE(document.error().what.find('"' + place.back() + "\" is missing"),
                  std::string::npos)
            << document.error().message();
    }
}

struct Mended {
    const char* pointer;
    json value;
    const char* warning; ///< a part of it
};

TEST(Document, MendsAndCounts) {
    const Mended cases[] = {
        {"/lights/0/keys/0/hour", 30, "hour"},
        {"/lights/0/keys/0/hour", 18, "two keys at one hour"},
        {"/lights/0/axis", {0, 0, 0}, "axis"},
        {"/lights/0/keys/0/tint", {-1, 1, 1}, "tint"},
        {"/lights/0/keys/0/gradient/stops/0/color", {-1, 0, 0}, "radiance"},
        {"/lights/0/keys/0/gradient/stops/0/ev", 2000, "radiance"},
        {"/lights/0/keys/0/gradient/stops/1/at", -90, "stops"},
    };
    for (const Mended& each : cases) {
        core::Tally warnings;
        const auto document = parseDocument(patched(each.pointer, each.value), warnings);
        ASSERT_TRUE(document.ok()) << each.pointer << ": " << document.error().message();
        bool found = false;
        for (const auto& [rule, count] : warnings.counts()) {
            found = found || rule.find(each.warning) != std::string::npos;
        }
        EXPECT_TRUE(found) << each.pointer << " = " << each.value;
    }
}

TEST(Document, TextsThatAreNone) {
    const std::pair<std::string, std::string> cases[] = {
        {"", "line 1"},
        {"[]", "/"},
        {"{\"lodestar\": 1,\n \"lights\": [}", "line 2"},
        {R"({"lodestar": 1, "lights": [], "lights": []})", "twice"},
        {R"({"lodestar": 1, "environment": {"source": "a", "ev": 1e999}})", "beyond"},
        {R"({"lodestar": 1, "environment": {"source": "a", "ev": NaN}})", "line 1"},
        {std::string(R"({"lodestar": 1, "x": )").append(100000, '[').append(100000, ']') + "}",
         "nested"},
    };
    for (const auto& [text, part] : cases) {
        const auto document = parse(text);
        ASSERT_FALSE(document.ok()) << text.substr(0, 60);
        EXPECT_NE(document.error().message().find(part), std::string::npos)
            << document.error().message();
    }
}

TEST(Document, CutOffAnywhereIsRefused) {
    for (std::size_t length = 0; length < kFull.size(); ++length) {
        EXPECT_FALSE(parse(kFull.substr(0, length)).ok()) << length;
    }
}

// Whatever a byte is changed to, a document that is still read can be written and read again.
TEST(Document, ChangedBytesNeverCrash) {
    std::mt19937 random(5);
    std::size_t read = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string text = kFull;
        for (int k = 0; k < 1 + i % 3; ++k) {
            text[random() % text.size()] =
                static_cast<char>(i % 2 == 0 ? 32 + random() % 95 : random() % 256);
        }
        core::Tally warnings;
        const auto document = parseDocument(text, warnings);
        if (document) {
            ++read;
            const auto again = parse(writeDocument(*document));
            EXPECT_TRUE(again.ok()) << again.error().message();
        }
    }
    EXPECT_GT(read, 100u) << "texts that still parse are the ones that try the writer";
}

TEST(Document, IsSavedWholeOrNotAtAll) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                         ("lodestar-document-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    const std::filesystem::path path = io::sidecarPath(folder / "room.gltf");
    EXPECT_EQ(path.filename(), "room.lodestar.json");
    const auto document = parse(kFull);
    ASSERT_TRUE(document.ok());
    ASSERT_TRUE(io::saveDocument(path, *document).ok());
    core::Tally warnings;
    const auto loaded = io::loadDocument(path, warnings);
    ASSERT_TRUE(loaded.ok()) << loaded.error().message();
    EXPECT_EQ(writeDocument(*loaded), writeDocument(*document));
    const auto failed = io::saveDocument(folder / "none" / "x.lodestar.json", *document);
    ASSERT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().code, core::ErrorCode::OutputFailed);
    std::ofstream(path) << "{";
    const auto broken = io::loadDocument(path, warnings);
    ASSERT_FALSE(broken.ok());
    EXPECT_EQ(broken.error().file, path.string());
    std::filesystem::remove_all(folder);
}

// Kept as radians, written as the shortest decimal that is the same angle again.
TEST(Document, AnglesAreWrittenAsTheyWereRead) {
    for (int hundredth = -9000; hundredth <= 9000; ++hundredth) {
        std::ostringstream number;
        number << std::setprecision(10) << hundredth / 100.0;
        const auto document =
            parse(R"({"lodestar": 1, "environment": {"source": "x.hdr", "rotation": )" +
                  number.str() + "}}");
        ASSERT_TRUE(document.ok());
        const std::string text = writeDocument(*document);
        const double again = nlohmann::json::parse(text)["environment"]["rotation"].get<double>();
        ASSERT_EQ(again, hundredth / 100.0);
        ASSERT_EQ(parse(text)->environment->rotation, document->environment->rotation);
    }
}

TEST(Document, AMaterialsNameMayHoldANul) {
    const auto document = parse(R"({"lodestar": 1, "materials": {"a\u0000b": {"exponent": 3}}})");
    ASSERT_TRUE(document.ok());
    EXPECT_EQ(document->materials.at(std::string("a\0b", 3)).exponent, 3.0);
    EXPECT_EQ(*parse(writeDocument(*document)), *document);
}

// The skies that come with the samples need no repair, and are the same after a save.
TEST(Document, SampleSkiesAreInOrder) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(LODESTAR_SAMPLES "/skies")) {
        core::Tally warnings;
        const auto document = io::loadDocument(entry.path(), warnings);
        ASSERT_TRUE(document.ok()) << document.error().message();
        EXPECT_TRUE(warnings.empty()) << entry.path() << warnings.counts().begin()->first;
        ++count;
    }
    EXPECT_EQ(count, 5u);
}

} // namespace
} // namespace lodestar::document
