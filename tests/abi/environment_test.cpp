// SPDX-License-Identifier: MIT
//
// Environments through the library: pixels, analytic texts, and captures whose faces a host draws.
#include <cmath>
#include <cstring>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include "core/half.h"
#include "host.h"
#include "lighting/lookup.h"

namespace lodestar::testing {
namespace {

class AbiEnvironment : public AbiHost {
protected:
    LodestarEnvironment make(const LodestarEnvironmentDesc& desc) {
        LodestarEnvironment environment = 0;
        EXPECT_EQ(api.environment_create(context, &desc, &environment), LODESTAR_OK)
            << api.last_error(context);
        return environment;
    }
    void refused(const LodestarEnvironmentDesc& desc, const char* where) {
        LodestarEnvironment environment = 0;
        EXPECT_EQ(api.environment_create(context, &desc, &environment), LODESTAR_E_ARG) << where;
        EXPECT_NE(std::string(api.last_error(context)).find(where), std::string::npos)
            << api.last_error(context);
    }
    LodestarCube cube(LodestarEnvironment environment, int texels) {
        LodestarCube cube{};
        cube.struct_size = sizeof cube;
        EXPECT_EQ(api.environment_cube(context, environment, texels, &cube), LODESTAR_OK);
        return cube;
    }
    LodestarPlan planned(std::uint32_t faces = 0) {
        LodestarFrame frame{};
        frame.struct_size = sizeof frame;
        frame.hour = 12.0;
        frame.max_faces = faces;
        LodestarPlan plan = 0;
        EXPECT_EQ(api.plan_make(context, &frame, &plan), LODESTAR_OK) << api.last_error(context);
        return plan;
    }
    std::vector<LodestarFaceJob> jobs(LodestarPlan plan) {
        std::size_t count = 0;
        EXPECT_GE(api.plan_jobs(context, plan, nullptr, &count), LODESTAR_OK);
        std::vector<LodestarFaceJob> jobs(count);
        if (count > 0) {
            jobs[0].struct_size = sizeof jobs[0];
            EXPECT_EQ(api.plan_jobs(context, plan, jobs.data(), &count), LODESTAR_OK);
        }
        return jobs;
    }
    std::string text(LodestarPlan plan) {
        std::size_t size = 0;
        EXPECT_EQ(api.plan_text(context, plan, nullptr, &size), LODESTAR_MORE);
        std::string words(size, '\0');
        EXPECT_EQ(api.plan_text(context, plan, words.data(), &size), LODESTAR_OK);
        return words;
    }
};

LodestarEnvironmentDesc analytic(const char* text, std::uint32_t faceWidth) {
    LodestarEnvironmentDesc desc{};
    desc.struct_size = sizeof desc;
    desc.layout = LODESTAR_ANALYTIC;
    desc.analytic = text;
    desc.face_width = faceWidth;
    return desc;
}

LodestarEnvironmentDesc pixels(int layout, std::uint32_t width, std::uint32_t height,
                               const std::vector<float>& values, std::uint32_t channels) {
    LodestarEnvironmentDesc desc{};
    desc.struct_size = sizeof desc;
    desc.layout = layout;
    desc.width = width;
    desc.height = height;
    desc.channels = channels;
    desc.pixels = values.data();
    return desc;
}

TEST_F(AbiEnvironment, LightsAsTheLookupsSay) {
    const LodestarEnvironment environment = make(analytic("disc:1,1,0,20,5,0.25", 32));
    ASSERT_EQ(api.set_environment(context, environment), LODESTAR_OK);
    const auto parsed = lighting::parseAnalytic("disc:1,1,0,20,5,0.25");
    const lighting::PreparedEnvironment own =
        lighting::prepare(lighting::cubeFromAnalytic(*parsed, 32),
                          {.boxMips = false, .tentMips = true, .sh9 = false, .irradiance = true});
    for (const glm::dvec3& direction :
         {glm::dvec3(1, 1, 0), glm::dvec3(0, 1, 0.3), glm::dvec3(-1, 0, 0)}) {
        double rgb[3] = {};
        lighting::LookupRequest request;
        request.direction = glm::normalize(direction);
        request.exponent = 40.0;
        ASSERT_EQ(api.radiance(context, &direction.x, 40.0, rgb), LODESTAR_OK);
        EXPECT_EQ(rgb[0], lighting::lookup(own, request).radiance.r);
        request.lobe = lighting::Lobe::Lambert;
        request.estimator = lighting::kDefaultDiffuse;
        ASSERT_EQ(api.lambert(context, &direction.x, rgb), LODESTAR_OK);
        EXPECT_EQ(rgb[2], lighting::lookup(own, request).radiance.b);
    }
    // A sky takes its place, unless it is added to it.
    Sun sun;
    sun.desc.kind = LODESTAR_SKY;
    sun.stops[0] = {90, {0, 0, 0}, 0};
    sun.stops[1] = {-90, {0, 0, 0}, 0};
    LodestarLight sky = 0;
    ASSERT_EQ(api.light_create(context, &sun.desc, &sky), LODESTAR_OK);
    const double up[3] = {0, 1, 0};
    double rgb[3] = {};
    ASSERT_EQ(api.lambert(context, up, rgb), LODESTAR_OK);
    EXPECT_EQ(rgb[0], 0.0);
    EXPECT_NE(text(planned()).find("stands in its place"), std::string::npos);
    sun.desc.add = 1;
    ASSERT_EQ(api.light_update(context, sky, &sun.desc), LODESTAR_OK);
    ASSERT_EQ(api.lambert(context, up, rgb), LODESTAR_OK);
    EXPECT_GT(rgb[0], 0.25);
    ASSERT_EQ(api.environment_destroy(context, environment), LODESTAR_OK);
    EXPECT_EQ(api.environment_destroy(context, environment), LODESTAR_E_ARG);
    EXPECT_EQ(api.set_environment(context, environment), LODESTAR_E_ARG);
    ASSERT_EQ(api.lambert(context, up, rgb), LODESTAR_OK);
    EXPECT_EQ(rgb[0], 0.0);
}

TEST_F(AbiEnvironment, PixelsBecomeACubeWithItsLevels) {
    std::vector<float> panorama(32 * 16 * 3, 0.5f);
    LodestarEnvironmentDesc desc = pixels(LODESTAR_LATLONG, 32, 16, panorama, 3);
    desc.face_width = 16;
    desc.ev = 1.0;
    const LodestarEnvironment environment = make(desc);
    const LodestarCube glossy = cube(environment, LODESTAR_TEXELS_ENVIRONMENT);
    EXPECT_EQ(glossy.width, 16u);
    EXPECT_EQ(glossy.levels, 5u);
    EXPECT_EQ(glossy.half_floats, 1u);
    EXPECT_EQ(glossy.scale, 1.0);
    std::size_t size = 0;
    ASSERT_EQ(api.environment_texels(context, environment, LODESTAR_TEXELS_ENVIRONMENT, 4, nullptr,
                                     &size),
              LODESTAR_MORE);
    ASSERT_EQ(size, 6u * 4u * 2u);
    std::vector<std::uint16_t> halves(size / 2);
    ASSERT_EQ(api.environment_texels(context, environment, LODESTAR_TEXELS_ENVIRONMENT, 4,
                                     halves.data(), &size),
              LODESTAR_OK);
    EXPECT_EQ(core::floatFromHalf(halves[0]), 1.0f) << "half of 2^1 is 1, at every level";
    EXPECT_EQ(api.environment_texels(context, environment, LODESTAR_TEXELS_ENVIRONMENT, 5, nullptr,
                                     &size),
              LODESTAR_E_ARG);
    EXPECT_EQ(cube(environment, LODESTAR_TEXELS_IRRADIANCE).width, 16u);
    // Beyond halves a scale, beyond scales floats.
    std::vector<float> faces(6 * 4 * 4 * 4, 2e6f);
    const LodestarEnvironment bright = make(pixels(LODESTAR_CUBE, 4, 24, faces, 4));
    EXPECT_EQ(cube(bright, LODESTAR_TEXELS_ENVIRONMENT).scale, 32.0);
    faces.assign(faces.size(), 1e9f);
    EXPECT_EQ(
        cube(make(pixels(LODESTAR_CUBE, 4, 24, faces, 4)), LODESTAR_TEXELS_ENVIRONMENT).half_floats,
        0u);
    faces[5] = std::nanf("");
    counting.logged.clear();
    make(pixels(LODESTAR_CUBE, 4, 24, faces, 4));
    EXPECT_EQ(counting.logged.size(), 1u) << "repaired, and said";
}

TEST_F(AbiEnvironment, BadOnesAreRefused) {
    const std::vector<float> values(64, 1.0f);
    refused(pixels(LODESTAR_LATLONG, 3, 2, values, 3), "/width");
    refused(pixels(LODESTAR_CUBE, 2, 6, values, 3), "/width");
    refused(pixels(LODESTAR_CUBE, 0, 0, values, 3), "/width");
    refused(pixels(LODESTAR_LATLONG, 4, 2, values, 2), "/channels");
    refused(pixels(LODESTAR_LATLONG, 4, 2, {}, 3), "/pixels");
    refused(pixels(9, 4, 2, values, 3), "/layout");
    refused(analytic("disc:1", 8), "/analytic");
    refused(analytic(nullptr, 8), "/analytic");
    refused(analytic("constant:1,1,1", 5000), "/face_width");
    LodestarEnvironmentDesc desc = analytic("constant:1,1,1", 8);
    desc.ev = 65.0;
    refused(desc, "/ev");
    desc.ev = 0.0;
    desc.rotation = HUGE_VAL;
    refused(desc, "/rotation");
    desc = analytic(nullptr, 8);
    desc.layout = LODESTAR_CAPTURED;
    refused(desc, "/near_plane");
    desc.near_plane = 0.1;
    desc.far_plane = 10.0;
    desc.position[1] = std::nan("");
    refused(desc, "/position");
    LodestarEnvironment environment = 0;
    EXPECT_EQ(api.environment_create(context, nullptr, &environment), LODESTAR_E_ABI);
    EXPECT_EQ(api.environment_create(context, &desc, nullptr), LODESTAR_E_ARG);
    const LodestarEnvironment constant = make(analytic("constant:1,1,1", 8));
    EXPECT_EQ(api.environment_face(context, constant, 0, values.data(), 3), LODESTAR_E_ARG);
    EXPECT_EQ(api.environment_request(context, constant), LODESTAR_E_ARG);
    LodestarCube described{};
    EXPECT_EQ(api.environment_cube(context, constant, LODESTAR_TEXELS_ENVIRONMENT, &described),
              LODESTAR_E_ABI);
    EXPECT_EQ(api.environment_cube(context, constant, LODESTAR_TEXELS_MAP, &described),
              LODESTAR_E_ARG);
    EXPECT_EQ(api.environment_cube(context, 0, LODESTAR_TEXELS_ENVIRONMENT, &described),
              LODESTAR_E_ARG);
}

/// What a host would draw for a job: each pixel's direction by the job's own matrices, coloured by
/// the clear analytic map. Row 0 is at the bottom of clip space.
std::vector<float> drawn(const LodestarFaceJob& job, const glm::dvec3& position,
                         const lighting::AnalyticEnvironment& world) {
    const glm::dmat4 view = glm::make_mat4(job.view);
    const glm::dmat4 projection = glm::make_mat4(job.projection);
    const glm::dmat4 worldFromClip = glm::inverse(projection * view);
    std::vector<float> pixels;
    for (std::uint32_t y = 0; y < job.width; ++y) {
        for (std::uint32_t x = 0; x < job.width; ++x) {
            const double size = job.width;
            const glm::dvec4 clip((2.0 * x + 1.0) / size - 1.0, (2.0 * y + 1.0) / size - 1.0, 0.5,
                                  1.0);
            const glm::dvec4 at = worldFromClip * clip;
            const glm::dvec3 direction = glm::normalize(glm::dvec3(at) / at.w - position);
            const glm::dvec3 radiance = lighting::radiance(world, direction);
            for (int c = 0; c < 3; ++c) {
                pixels.push_back(static_cast<float>(radiance[c]));
            }
        }
    }
    return pixels;
}

// A static probe: jobs until all its faces are in, then light at once, and a plan that says so.
TEST_F(AbiEnvironment, ACaptureIsJobsForTheHost) {
    const char* around = "faces:1/0/0;0/1/0;0/0/1;1/1/0;0/1/1;1/0/1";
    const auto world = lighting::parseAnalytic(around);
    LodestarEnvironmentDesc desc = analytic(nullptr, 8);
    desc.layout = LODESTAR_CAPTURED;
    desc.name = "lobby";
    desc.position[0] = 3.0;
    desc.position[1] = -2.0;
    desc.near_plane = 0.1;
    desc.far_plane = 50.0;
    const LodestarEnvironment probe = make(desc);
    ASSERT_EQ(api.set_environment(context, probe), LODESTAR_OK);
    EXPECT_TRUE(jobs(planned(0)).empty()) << "no budget, no job";
    const double up[3] = {0, 1, 0};
    double rgb[3] = {9, 9, 9};
    std::size_t size = 0;
    EXPECT_EQ(
        api.environment_texels(context, probe, LODESTAR_TEXELS_ENVIRONMENT, 0, nullptr, &size),
        LODESTAR_E_ARG)
        << "nothing to show yet";
    std::vector<int> faces;
    for (int frame = 0; frame < 3; ++frame) {
        ASSERT_EQ(api.lambert(context, up, rgb), LODESTAR_OK);
        EXPECT_EQ(rgb[1], 0.0) << "never half updated";
        const LodestarPlan plan = planned(2);
        EXPECT_NE(text(plan).find("Probe 'lobby': 2 of"), std::string::npos) << text(plan);
        LodestarWork work{};
        work.struct_size = sizeof work;
        ASSERT_EQ(api.plan_work(context, plan, &work), LODESTAR_OK);
        EXPECT_EQ(work.face_jobs, 2u);
        for (const LodestarFaceJob& job : jobs(plan)) {
            EXPECT_EQ(job.environment, probe);
            faces.push_back(job.face);
            const std::vector<float> pixels = drawn(job, {3.0, -2.0, 0.0}, *world);
            ASSERT_EQ(api.environment_face(context, probe, job.face, pixels.data(), 3),
                      LODESTAR_OK);
        }
    }
    EXPECT_EQ(faces, (std::vector<int>{0, 1, 2, 3, 4, 5}));
    // It shows what the analytic cube of the same world shows, texel by texel: all faces stand the
    // right way.
    const LodestarEnvironment own = make(analytic(around, 8));
    for (std::uint32_t level = 0; level < 4; ++level) {
        std::vector<std::uint16_t> a(6 * 64 * 4), b(6 * 64 * 4);
        std::size_t sizeA = 2 * a.size(), sizeB = sizeA;
        ASSERT_EQ(api.environment_texels(context, probe, LODESTAR_TEXELS_ENVIRONMENT, level,
                                         a.data(), &sizeA),
                  LODESTAR_OK);
        ASSERT_EQ(api.environment_texels(context, own, LODESTAR_TEXELS_ENVIRONMENT, level, b.data(),
                                         &sizeB),
                  LODESTAR_OK);
        EXPECT_EQ(a, b) << level;
    }
    // Captured; asked for anew it goes on showing what it has.
    LodestarPlan plan = planned(6);
    EXPECT_TRUE(jobs(plan).empty());
    EXPECT_NE(text(plan).find("skipped: it shows what it has captured"), std::string::npos);
    const std::uint64_t version = cube(probe, LODESTAR_TEXELS_ENVIRONMENT).version;
    ASSERT_EQ(api.environment_request(context, probe), LODESTAR_OK);
    EXPECT_EQ(jobs(planned(6)).size(), 6u);
    EXPECT_EQ(cube(probe, LODESTAR_TEXELS_ENVIRONMENT).version, version);
    EXPECT_EQ(cube(probe, LODESTAR_TEXELS_ENVIRONMENT).faces_missing, 6u);
}

/// Radiance in a direction and over Lambert's lobe, of a context whose up is +Z and north +Y.
class AbiFrame : public AbiEnvironment {
protected:
    void SetUp() override {
        LodestarHost host = counting.host();
        host.up[2] = 2.0;
        host.north[1] = 1.0;
        host.north[2] = 0.5; // taken across up
        ASSERT_EQ(api.context_create(&host, &context), LODESTAR_OK) << api.last_error(nullptr);
    }
};

TEST_F(AbiFrame, UpAndNorthAreTheHosts) {
    // East red, north green, up blue, and their opposites dark; GL's order +X -X +Y -Y +Z -Z.
    const char* around = "faces:1/0/0;0/0/0;0/0/1;0/0/0;0/0/0;0/1/0";
    ASSERT_EQ(api.set_environment(context, make(analytic(around, 8))), LODESTAR_OK);
    const double east[3] = {1, 0, 0}, north[3] = {0, 1, 0}, up[3] = {0, 0, 1};
    double rgb[3] = {};
    const auto seen = [&](const double* direction) {
        EXPECT_EQ(api.radiance(context, direction, HUGE_VAL, rgb), LODESTAR_OK);
        return glm::dvec3(rgb[0], rgb[1], rgb[2]);
    };
    EXPECT_EQ(seen(east), glm::dvec3(1, 0, 0));
    EXPECT_EQ(seen(north), glm::dvec3(0, 1, 0));
    EXPECT_EQ(seen(up), glm::dvec3(0, 0, 1));
    // Six faces as a document's files have them, and as the host's own renderer draws them.
    std::vector<float> faces(6 * 4 * 3, 0.0f);
    for (std::size_t i = 0; i < 4; ++i) {
        faces[4 * 4 * 3 + 3 * i] = 7.0f; // +Z
    }
    LodestarEnvironmentDesc cube = pixels(LODESTAR_CUBE, 2, 12, faces, 3);
    ASSERT_EQ(api.set_environment(context, make(cube)), LODESTAR_OK);
    const double south[3] = {0, -1, 0};
    EXPECT_EQ(seen(south).r, 7.0) << "a document's +Z";
    EXPECT_EQ(seen(up).r, 0.0);
    cube.in_host_frame = 1;
    ASSERT_EQ(api.set_environment(context, make(cube)), LODESTAR_OK);
    EXPECT_EQ(seen(up).r, 7.0);
    EXPECT_EQ(seen(south).r, 0.0);
    // A sky's axis is up, a sun given by an axis stands there, one on a path is south at noon.
    ASSERT_EQ(api.set_environment(context, 0), LODESTAR_OK);
    Sun sun;
    const auto axisOf = [&] {
        LodestarLight light = 0;
        EXPECT_EQ(api.light_create(context, &sun.desc, &light), LODESTAR_OK);
        LodestarLightState state{};
        state.struct_size = sizeof state;
        EXPECT_EQ(api.set_hour(context, 12.0), LODESTAR_OK);
        EXPECT_EQ(api.light_state(context, light, &state), LODESTAR_OK);
        return glm::dvec3(state.axis[0], state.axis[1], state.axis[2]);
    };
    EXPECT_LT(glm::length(axisOf() - glm::dvec3(0, 1, 0)), 1e-12) << "as given";
    sun.desc.axis[1] = 0.0;
    EXPECT_LT(glm::length(axisOf() - glm::dvec3(0, 0, 1)), 1e-12) << "up";
    sun.desc.has_path = 1;
    sun.desc.latitude = 45.0;
    sun.desc.day_of_year = 81;
    sun.desc.north[1] = 1.0;
    EXPECT_LT(glm::length(axisOf() - glm::normalize(glm::dvec3(0, -1, 1))), 0.01)
        << "at an equinox 45 degrees high, within half a day's declination";
    LodestarContext* none = nullptr;
    LodestarHost host = counting.host();
    host.up[2] = 1.0;
    EXPECT_EQ(api.context_create(&host, &none), LODESTAR_E_ARG) << "no north";
    host.north[2] = -3.0;
    EXPECT_EQ(api.context_create(&host, &none), LODESTAR_E_ARG) << "along up";
    host.north[0] = std::nan("");
    EXPECT_EQ(api.context_create(&host, &none), LODESTAR_E_ARG);
    EXPECT_EQ(none, nullptr);
}

TEST_F(AbiEnvironment, ADocumentNamesItsOwn) {
    const auto of = [&](const std::string& document, std::string& source, double& rotation,
                        double& ev) {
        LodestarDocument handle = 0;
        EXPECT_EQ(api.document_load(context, document.data(), document.size(), &handle),
                  LODESTAR_OK);
        std::size_t size = 99;
        const LodestarStatus status =
            api.document_environment(context, handle, nullptr, &size, nullptr, nullptr);
        source.assign(size, '\0');
        return status == LODESTAR_MORE
                   ? api.document_environment(context, handle, source.data(), &size, &rotation, &ev)
                   : status;
    };
    std::string source;
    double rotation = 0.0, ev = 0.0;
    ASSERT_EQ(
        of(R"({"lodestar": 1, "environment": {"source": "a b.hdr", "rotation": 90, "ev": -2}})",
           source, rotation, ev),
        LODESTAR_OK);
    EXPECT_STREQ(source.c_str(), "a b.hdr");
    EXPECT_NEAR(rotation, std::acos(0.0), 1e-12);
    EXPECT_EQ(ev, -2.0);
    ASSERT_EQ(of(R"({"lodestar": 1})", source, rotation, ev), LODESTAR_OK);
    EXPECT_TRUE(source.empty());
}

} // namespace
} // namespace lodestar::testing
