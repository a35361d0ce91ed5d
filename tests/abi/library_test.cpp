// SPDX-License-Identifier: MIT
//
// What a host can do to the library, right and wrong: everything is answered by a status and a
// message.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "host.h"
#include "io/document_file.h"
#include "lighting/day_lookup.h"
#include "lodestar/lodestar.h"

namespace lodestar::testing {
namespace {

using Abi = AbiHost;

std::string clearSky() {
    std::ifstream file(std::string(LODESTAR_SAMPLES) + "/skies/clear.lodestar.json");
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(AbiEntry, TablesOfOtherVersions) {
    const Library library;
    LodestarApi api{};
    EXPECT_EQ(library.get(LODESTAR_ABI_VERSION, api), LODESTAR_E_ABI) << "no size";
    api.struct_size = sizeof api;
    EXPECT_EQ(library.get((LODESTAR_ABI_MAJOR + 1) << 16, api), LODESTAR_E_ABI);
    EXPECT_EQ(library.get(LODESTAR_ABI_MAJOR << 16 | 77, api), LODESTAR_OK) << "a later minor";
    // A host of before: the functions that it does not know are not written.
    struct {
        LodestarApi api;
        unsigned char behind[64];
    } small{};
    std::memset(&small, 0x5a, sizeof small);
    small.api.struct_size = offsetof(LodestarApi, last_error);
    ASSERT_EQ(library.get(LODESTAR_ABI_VERSION, small.api), LODESTAR_OK);
    EXPECT_EQ(small.api.struct_size, offsetof(LodestarApi, last_error));
    EXPECT_NE(small.api.context_create, nullptr);
    const auto* after = reinterpret_cast<const unsigned char*>(&small.api.last_error);
    EXPECT_EQ(after[0], 0x5a);
    // A host of later.
    struct {
        LodestarApi api;
        void* more[8];
    } large{};
    large.api.struct_size = sizeof large;
    ASSERT_EQ(library.get(LODESTAR_ABI_VERSION, large.api), LODESTAR_OK);
    EXPECT_EQ(large.api.struct_size, sizeof(LodestarApi));
}

TEST_F(Abi, ADocumentLightsAsItsReaderSays) {
    const std::string text = clearSky();
    LodestarDocument document = 0;
    ASSERT_EQ(api.document_load(context, text.data(), text.size(), &document), LODESTAR_OK)
        << api.last_error(context);
    ASSERT_EQ(api.document_apply(context, document), LODESTAR_OK);
    std::size_t count = 0;
    EXPECT_EQ(api.lights(context, nullptr, &count), LODESTAR_MORE);
    ASSERT_EQ(count, 2u);
    std::vector<LodestarLight> lights(count);
    ASSERT_EQ(api.lights(context, lights.data(), &count), LODESTAR_OK);
    core::Tally warnings;
    const auto opened =
        io::loadDocument(std::string(LODESTAR_SAMPLES) + "/skies/clear.lodestar.json", warnings);
    ASSERT_TRUE(opened.ok());
    lighting::DayLookup own(*document::dayLights(*opened, warnings), lighting::kRsrm);
    const double directions[][3] = {{0, 1, 0}, {1, 0.2, 0}, {-0.3, 0.5, 0.8}, {0, -1, 0.1}};
    for (const double hour : {0.0, 5.5, 12.0, 18.6}) {
        ASSERT_EQ(api.set_hour(context, hour), LODESTAR_OK);
        for (const auto& d : directions) {
            const glm::dvec3 unit = glm::normalize(glm::dvec3(d[0], d[1], d[2]));
            double got[3] = {};
            for (const double exponent : {1.0, 64.0, HUGE_VAL}) {
                ASSERT_EQ(api.radiance(context, d, exponent, got), LODESTAR_OK);
                const glm::dvec3 expected = own.lookup(hour, unit, exponent).radiance;
                // The same text on the same texels, at a direction rounded elsewhere.
                EXPECT_NEAR(got[1], expected.g, 1e-5 * expected.g) << hour << " s " << exponent;
            }
            ASSERT_EQ(api.lambert(context, d, got), LODESTAR_OK);
            EXPECT_NEAR(got[2], own.lambert(hour, unit).radiance.b, 1e-5);
        }
    }
    // Applied again the handles of before are stale.
    ASSERT_EQ(api.document_apply(context, document), LODESTAR_OK);
    LodestarLightState state{};
    state.struct_size = sizeof state;
    EXPECT_EQ(api.light_state(context, lights[0], &state), LODESTAR_E_ARG);
    EXPECT_EQ(api.document_destroy(context, document), LODESTAR_OK);
    EXPECT_EQ(api.document_apply(context, document), LODESTAR_E_ARG);
}

TEST_F(Abi, ADocumentsRowsAreItsMaps) {
    const std::string rows = R"({"lodestar": 1, "rsrm": {"exponents": [1, 6, 40, 900]}, )";
    const std::string text = rows + clearSky().substr(clearSky().find("\"lights\""));
    LodestarDocument document = 0, usual = 0;
    ASSERT_EQ(api.document_load(context, text.data(), text.size(), &document), LODESTAR_OK)
        << api.last_error(context);
    LodestarMapLayout layout{};
    layout.struct_size = sizeof layout;
    ASSERT_EQ(api.context_map_layout(context, &layout), LODESTAR_OK);
    EXPECT_EQ(layout.rows, 24u) << "nothing is applied yet";
    EXPECT_EQ(layout.own_rows, 0u);
    ASSERT_EQ(api.document_apply(context, document), LODESTAR_OK);
    ASSERT_EQ(api.context_map_layout(context, &layout), LODESTAR_OK);
    EXPECT_EQ(layout.rows, 4u);
    EXPECT_EQ(layout.own_rows, 1u);
    EXPECT_EQ(layout.least_exponent, 1.0f);
    EXPECT_EQ(layout.greatest_exponent, 900.0f);
    EXPECT_FLOAT_EQ(layout.octaves[1], std::log2(7.0f));
    EXPECT_FLOAT_EQ(layout.octaves[23], std::log2(901.0f)) << "the last row's on to the end";
    core::Tally warnings;
    const auto opened = document::parseDocument(text, warnings);
    lighting::DayLookup own(*document::dayLights(*opened, warnings), document::mapLayout(*opened));
    lighting::DayLookup byOthers(*document::dayLights(*opened, warnings), lighting::kRsrm);
    ASSERT_EQ(api.set_hour(context, 12.0), LODESTAR_OK);
    const double d[] = {0.3, 0.8, 0.2};
    const glm::dvec3 unit = glm::normalize(glm::dvec3(d[0], d[1], d[2]));
    double apart = 0.0;
    for (const double exponent : {3.0, 15.0, 200.0, 2000.0}) {
        double got[3] = {};
        ASSERT_EQ(api.radiance(context, d, exponent, got), LODESTAR_OK);
        const double expected = own.lookup(12.0, unit, exponent).radiance.g;
        EXPECT_NEAR(got[1], expected, 1e-5 * expected) << exponent;
        apart =
            std::max(apart, std::abs(byOthers.lookup(12.0, unit, exponent).radiance.g - expected) /
                                expected);
    }
    EXPECT_GT(apart, 1e-3) << "other rows would be seen";
    // Lights that are made behind it have its rows; another document has its own.
    Sun sun;
    LodestarLight light = 0;
    ASSERT_EQ(api.light_create(context, &sun.desc, &light), LODESTAR_OK);
    std::size_t size = 0;
    EXPECT_EQ(api.light_texels(context, light, LODESTAR_TEXELS_MAP, nullptr, &size), LODESTAR_MORE);
    EXPECT_EQ(size, 4u * 170u * 4u);
    const std::string clear = clearSky();
    ASSERT_EQ(api.document_load(context, clear.data(), clear.size(), &usual), LODESTAR_OK);
    ASSERT_EQ(api.document_apply(context, usual), LODESTAR_OK);
    ASSERT_EQ(api.context_map_layout(context, &layout), LODESTAR_OK);
    EXPECT_EQ(layout.own_rows, 0u);
    layout.struct_size = 0;
    EXPECT_EQ(api.context_map_layout(context, &layout), LODESTAR_E_ABI);
    const std::string bad = R"({"lodestar": 1, "rsrm": {"exponents": [1]}, "lights": []})";
    EXPECT_EQ(api.document_load(context, bad.data(), bad.size(), &usual), LODESTAR_E_DOCUMENT);
    EXPECT_NE(std::string(api.last_error(context)).find("/rsrm/exponents"), std::string::npos);
}

TEST_F(Abi, ALightsTexelsAndState) {
    Sun sun;
    LodestarLight light = 0;
    ASSERT_EQ(api.light_create(context, &sun.desc, &light), LODESTAR_OK) << api.last_error(context);
    LodestarLightState state{};
    state.struct_size = sizeof state;
    ASSERT_EQ(api.light_state(context, light, &state), LODESTAR_OK);
    EXPECT_EQ(state.kind, LODESTAR_SUN);
    EXPECT_EQ(state.axis[1], 1.0) << "made unit";
    EXPECT_EQ(state.visibility, 1.0);
    const std::uint64_t version = state.version;
    LodestarMapLayout layout{};
    layout.struct_size = sizeof layout;
    ASSERT_EQ(api.map_layout(&layout), LODESTAR_OK);
    const std::pair<int, std::size_t> sizes[] = {
        {LODESTAR_TEXELS_MAP, 4 * layout.columns * layout.rows},
        {LODESTAR_TEXELS_LAMBERT, 16 * layout.lambert_columns},
        {LODESTAR_TEXELS_GRADIENT, 8 * layout.gradient_columns}};
    for (const auto& [which, expected] : sizes) {
        std::size_t size = 0;
        EXPECT_EQ(api.light_texels(context, light, which, nullptr, &size), LODESTAR_MORE);
        EXPECT_EQ(size, expected);
        std::vector<unsigned char> texels(size - 1, 0x5a);
        size = texels.size();
        EXPECT_EQ(api.light_texels(context, light, which, texels.data(), &size), LODESTAR_MORE);
        EXPECT_EQ(texels[0], 0x5a) << "nothing is written";
        texels.resize(expected);
        size = texels.size();
        EXPECT_EQ(api.light_texels(context, light, which, texels.data(), &size), LODESTAR_OK);
        EXPECT_TRUE(
            std::any_of(texels.begin(), texels.end(), [](unsigned char b) { return b > 0; }));
    }
    // Another hour of a sun that does not change: the same texels. A tint changes them.
    ASSERT_EQ(api.set_hour(context, 3.0), LODESTAR_OK);
    ASSERT_EQ(api.light_state(context, light, &state), LODESTAR_OK);
    EXPECT_EQ(state.version, version);
    double before[3], after[3];
    const double up[3] = {0, 1, 0};
    ASSERT_EQ(api.radiance(context, up, 1.0, before), LODESTAR_OK);
    sun.key.tint[0] = 0.5;
    ASSERT_EQ(api.light_update(context, light, &sun.desc), LODESTAR_OK);
    ASSERT_EQ(api.light_state(context, light, &state), LODESTAR_OK);
    EXPECT_NE(state.version, version);
    ASSERT_EQ(api.radiance(context, up, 1.0, after), LODESTAR_OK);
    EXPECT_NEAR(after[0], 0.5 * before[0], 1e-2 * before[0]); // nine bits of a root
    EXPECT_NEAR(after[1], before[1], 1e-2 * before[1]);
    ASSERT_EQ(api.light_destroy(context, light), LODESTAR_OK);
    EXPECT_EQ(api.light_destroy(context, light), LODESTAR_E_ARG);
    LodestarLight next = 0;
    ASSERT_EQ(api.light_create(context, &sun.desc, &next), LODESTAR_OK);
    EXPECT_NE(next, light) << "a stale handle never comes back";
}

TEST_F(Abi, BadArgumentsAreStatusesAndWords) {
    Sun sun;
    LodestarLight light = 0;
    double rgb[3];
    const double up[3] = {0, 1, 0}, none[3] = {0, 0, 0}, odd[3] = {0, std::nan(""), 0};
    EXPECT_EQ(api.light_create(nullptr, &sun.desc, &light), LODESTAR_E_ARG);
    EXPECT_EQ(api.light_create(context, nullptr, &light), LODESTAR_E_ABI);
    EXPECT_EQ(api.light_create(context, &sun.desc, nullptr), LODESTAR_E_ARG);
    EXPECT_EQ(api.radiance(context, none, 1.0, rgb), LODESTAR_E_ARG);
    EXPECT_EQ(api.radiance(context, odd, 1.0, rgb), LODESTAR_E_ARG);
    EXPECT_EQ(api.radiance(context, nullptr, 1.0, rgb), LODESTAR_E_ARG);
    EXPECT_EQ(api.radiance(context, up, std::nan(""), rgb), LODESTAR_OK) << "as 0";
    EXPECT_EQ(api.set_hour(context, HUGE_VAL), LODESTAR_E_ARG);
    EXPECT_EQ(api.lights(context, nullptr, nullptr), LODESTAR_E_ARG);
    EXPECT_EQ(api.light_texels(context, 77, 0, nullptr, nullptr), LODESTAR_E_ARG);
    const auto refusedWith = [&](const char* words) {
        EXPECT_NE(api.light_create(context, &sun.desc, &light), LODESTAR_OK) << words;
        EXPECT_NE(std::string(api.last_error(context)).find(words), std::string::npos)
            << api.last_error(context);
        sun.reset();
    };
    sun.desc.kind = 7;
    refusedWith("sky or a sun");
    sun.desc.key_count = 0;
    refusedWith("/keys");
    sun.key.stop_count = 0;
    refusedWith("stops");
    sun.stops[1].at = 200.0;
    refusedWith("/stops/1/at");
    sun.key.hour = std::nan("");
    refusedWith("hour");
    sun.key.interpolation = 9;
    refusedWith("interpolation");
    sun.desc.key_stride = 3;
    refusedWith("stride");
    sun.desc.has_path = 1;
    sun.desc.day_of_year = 400;
    refusedWith("day");
    // Repaired, and said.
    counting.logged.clear();
    sun.stops[0].color[0] = -1.0;
    sun.desc.axis[1] = 0.0;
    EXPECT_EQ(api.light_create(context, &sun.desc, &light), LODESTAR_OK);
    EXPECT_EQ(counting.logged.size(), 2u);
    EXPECT_EQ(counting.logged.at(0).substr(0, 4), "100 ");
}

TEST_F(Abi, StructsOfOtherVersions) {
    Sun sun;
    LodestarLight light = 0;
    // Of before: without keys there is no light; a key without its axis members is one.
    sun.desc.struct_size = offsetof(LodestarLightDesc, key_count);
    EXPECT_EQ(api.light_create(context, &sun.desc, &light), LODESTAR_E_ARG);
    sun.reset();
    sun.key.struct_size = offsetof(LodestarKey, has_axis);
    EXPECT_EQ(api.light_create(context, &sun.desc, &light), LODESTAR_OK) << api.last_error(context);
    // Of later: members that this library lacks must be 0.
    struct {
        LodestarLightDesc desc;
        double more;
    } later{sun.desc, 0.0};
    later.desc.struct_size = sizeof later;
    EXPECT_EQ(api.light_create(context, &later.desc, &light), LODESTAR_OK);
    later.more = 1.0;
    EXPECT_EQ(api.light_create(context, &later.desc, &light), LODESTAR_E_ABI);
    LodestarLightState state{};
    EXPECT_EQ(api.light_state(context, light, &state), LODESTAR_E_ABI);
    state.struct_size = offsetof(LodestarLightState, visibility);
    state.visibility = -5.0;
    EXPECT_EQ(api.light_state(context, light, &state), LODESTAR_OK);
    EXPECT_EQ(state.visibility, -5.0) << "behind the host's struct nothing is written";
}

TEST_F(Abi, BrokenDocumentsNameTheirPointer) {
    LodestarDocument document = 0;
    const auto load = [&](const std::string& text) {
        return api.document_load(context, text.data(), text.size(), &document);
    };
    EXPECT_EQ(load(""), LODESTAR_E_DOCUMENT);
    EXPECT_EQ(load(R"({"lodestar": 2})"), LODESTAR_E_DOCUMENT);
    EXPECT_NE(std::string(api.last_error(context)).find("/lodestar"), std::string::npos);
    std::string text = clearSky();
    EXPECT_EQ(load(text.substr(0, text.size() / 2)), LODESTAR_E_DOCUMENT);
    text.replace(text.find("\"sun\", \"kind\": \"sun\"") == std::string::npos
                     ? text.rfind("\"sun\"")
                     : text.rfind("\"sun\""),
                 5, "\"son\"");
    EXPECT_EQ(load(text), LODESTAR_E_DOCUMENT);
    EXPECT_NE(std::string(api.last_error(context)).find("/lights/1/kind"), std::string::npos)
        << api.last_error(context);
    EXPECT_EQ(api.document_load(context, nullptr, 3, &document), LODESTAR_E_ARG);
}

TEST_F(Abi, AnotherThreadIsRefused) {
    LodestarStatus status = LODESTAR_OK;
    std::thread([&] { status = api.set_hour(context, 3.0); }).join();
    EXPECT_EQ(status, LODESTAR_E_THREAD);
    std::thread([&] { status = api.context_destroy(context); }).join();
    EXPECT_EQ(status, LODESTAR_E_THREAD);
    // [any] functions need no context.
    std::thread([&] {
        LodestarMapLayout layout{};
        layout.struct_size = sizeof layout;
        status = api.map_layout(&layout);
    }).join();
    EXPECT_EQ(status, LODESTAR_OK);
}

/// What a host does in an afternoon; the first status that is not LODESTAR_OK, else that.
LodestarStatus afternoon(const LodestarApi& api, LodestarContext* context,
                         const std::string& text) {
    LodestarDocument document = 0;
    LodestarLight light = 0;
    double rgb[3];
    const double up[3] = {0, 1, 0};
    Sun sun;
    LodestarStatus status = api.document_load(context, text.data(), text.size(), &document);
    status = status != LODESTAR_OK ? status : api.document_apply(context, document);
    status = status != LODESTAR_OK ? status : api.light_create(context, &sun.desc, &light);
    LodestarEnvironmentDesc desc{};
    desc.struct_size = sizeof desc;
    desc.layout = LODESTAR_ANALYTIC;
    desc.analytic = "gradient:0,1";
    desc.face_width = 4;
    LodestarEnvironment environment = 0;
    status = status != LODESTAR_OK ? status : api.environment_create(context, &desc, &environment);
    status = status != LODESTAR_OK ? status : api.set_environment(context, environment);
    LodestarFrame frame{};
    frame.struct_size = sizeof frame;
    frame.hour = 16.0;
    LodestarPlan plan = 0;
    status = status != LODESTAR_OK ? status : api.plan_make(context, &frame, &plan);
    return status != LODESTAR_OK ? status : api.radiance(context, up, 32.0, rgb);
}

// Whichever allocation fails, the call says so, nothing is lost, and the same call then works.
TEST_F(Abi, MemoryThatRunsOutIsAStatus) {
    // One key and one light, in tables that are there already: every allocation has its turn.
    const std::string text =
        R"({"lodestar": 1, "lights": [{"kind": "sky", "add": true, "keys": [{"hour": 12, "gradient": {"stops": [
            {"at": 90, "color": [0.1, 0.2, 0.4]}, {"at": -90, "color": [1, 1, 1]}]}}]}]})";
    counting.calls = 0;
    ASSERT_EQ(afternoon(api, context, text), LODESTAR_OK);
    const std::size_t calls = counting.calls;
    ASSERT_GT(calls, 40u);
    std::size_t failed = 0, absorbed = 0;
    for (std::size_t at = 0; at < calls; ++at) {
        LodestarContext* other = nullptr;
        const LodestarHost host = counting.host();
        counting.failAt = std::numeric_limits<std::size_t>::max();
        ASSERT_EQ(api.context_create(&host, &other), LODESTAR_OK);
        counting.calls = 0;
        counting.failAt = at;
        const LodestarStatus status = afternoon(api, other, text);
        // A sort that is denied its buffer sorts in place.
        EXPECT_TRUE(status == LODESTAR_E_NOMEM || status == LODESTAR_OK) << "allocation " << at;
        (status == LODESTAR_OK ? absorbed : failed) += 1;
        counting.failAt = std::numeric_limits<std::size_t>::max();
        EXPECT_EQ(afternoon(api, other, text), LODESTAR_OK) << "the same call works then";
        EXPECT_EQ(api.context_destroy(other), LODESTAR_OK);
    }
    EXPECT_GT(failed, 9 * absorbed);
    counting.calls = 0;
    counting.failAt = 0;
    LodestarContext* none = nullptr;
    const LodestarHost host = counting.host();
    EXPECT_EQ(api.context_create(&host, &none), LODESTAR_E_NOMEM);
    EXPECT_EQ(none, nullptr);
    EXPECT_NE(std::string(api.last_error(nullptr)).find("memory"), std::string::npos);
    counting.failAt = std::numeric_limits<std::size_t>::max();
}

long residentPages() {
    long size = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> size >> resident;
    return resident;
}

bool isMapped() {
    std::ifstream maps("/proc/self/maps");
    const std::string text{std::istreambuf_iterator<char>(maps), {}};
    return text.find("liblodestar.so") != std::string::npos;
}

TEST(AbiEntry, ItUnloadsAndMemoryStaysFlat) {
    const std::string text = clearSky();
    long before = 0;
    for (int round = 0; round < 1000; ++round) {
        {
            const Library library;
            const LodestarApi api = library.api();
            LodestarContext* context = nullptr;
            ASSERT_EQ(api.context_create(nullptr, &context), LODESTAR_OK);
            LodestarDocument document = 0;
            ASSERT_EQ(api.document_load(context, text.data(), text.size(), &document), LODESTAR_OK);
            ASSERT_EQ(api.document_apply(context, document), LODESTAR_OK);
            EXPECT_TRUE(isMapped());
            ASSERT_EQ(api.context_destroy(context), LODESTAR_OK);
        }
        ASSERT_FALSE(isMapped()) << "round " << round;
        if (round == 9) {
            before = residentPages();
        }
    }
    // What the C library keeps for itself settles in the first rounds; after that not a page in 24.
    EXPECT_LT(residentPages() - before, 40);
}

} // namespace
} // namespace lodestar::testing
