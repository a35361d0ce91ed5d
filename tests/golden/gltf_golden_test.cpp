// SPDX-License-Identifier: MIT
//
// One small picture for each feature of glTF, rendered from a file that is written here. Each must
// stay what it is, must fail against every other picture and against what a reader that passes over
// the feature would show, and has a property that does not depend on the picture kept.
// `golden-gltf --update NAME` writes one anew: look at it before you commit it.
#include <cstdio>
#include <cstring>

#include "golden/gltf_golden.h"
#include "io/environment_file.h"
#include "lighting/environment.h"
#include "lodestar/display.glsl"
#include "scene/animation.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/picture.h"

namespace lodestar::testing {
namespace {

/// The mean difference that is allowed: half a step of 8 bits, as if half of all values were
/// rounded the other way.
constexpr double kMean = 0.5 / 255.0;

std::vector<GltfGolden> allGoldens() {
    std::vector<GltfGolden> all;
    for (const auto& list :
         {geometryGoldens(), materialGoldens(), textureGoldens(), motionGoldens()}) {
        all.insert(all.end(), list.begin(), list.end());
    }
    return all;
}

bool passes(const GltfGolden& golden, const core::Image& kept, const core::Image& actual) {
    const Difference d = compare(kept, actual, 1.5 / 255.0); // more than one step of 8 bits
    return d.mean <= kMean && d.failingFraction <= golden.failing;
}

/// A picture as the PNG holds it.
core::Image display(core::Image radiance) {
    for (std::size_t i = 0; i < radiance.pixels().size(); ++i) {
        float& value = radiance.pixels()[i];
        if (i % 4 != 3) {
            value = shader::lodestar_srgbFromLinear(shader::lodestar_filmic(value));
        }
        value = std::round(value * 255.0f) / 255.0f;
    }
    return radiance;
}

lighting::Cubemap lightOf(Light light) {
    const glm::dvec3 right(1.5, 0.2, 0.1);
    const glm::dvec3 left = light == Light::Even ? right : glm::dvec3(0.1, 0.6, 0.2);
    switch (light) {
    case Light::White:
        return lighting::cubeFromAnalytic(lighting::ConstantEnvironment{glm::dvec3(1.0)}, 32);
    case Light::Dark:
        return lighting::cubeFromAnalytic(lighting::ConstantEnvironment{glm::dvec3(0.0)}, 32);
    default:
        return lighting::cubeFromAnalytic(
            lighting::FacesEnvironment{{right, left, glm::dvec3(0.2, 0.4, 1.6),
                                        glm::dvec3(0.3, 0.25, 0.2), glm::dvec3(0.9, 0.9, 0.8),
                                        glm::dvec3(0.02)}},
            32);
    }
}

class GltfGoldens : public GlTest {
public:
    static std::string path(const GltfGolden& golden) {
        return std::string(LODESTAR_TEST_DATA) + "/golden/gltf/" + golden.name + ".png";
    }

    core::Image renderScene(const GltfGolden& golden, const scene::Scene& scene,
                            lighting::Cubemap environment) {
        auto renderer = scene::Renderer::make(device(), scene);
        EXPECT_TRUE(renderer.ok());
        (*renderer)->setEnvironment(golden.name, std::move(environment));
        scene::RenderSettings settings;
        settings.width = settings.height = kGltfSide;
        settings.backdrop = golden.light == Light::Own;
        auto frame = (*renderer)->render(*scene::chooseView(scene, {}, 1.0f), settings);
        EXPECT_TRUE(frame.ok());
        return std::move(frame->radiance);
    }

    struct Loaded {
        scene::Scene scene;
        lighting::Cubemap environment;
        std::uint64_t warnings = 0;
    };

    /// Writes a file, reads it and poses it.
    static Loaded load(const GltfGolden& golden, const GltfBuilder& file) {
        const TemporaryFolder folder;
        auto read = io::loadGltf(file.write(folder));
        if (!read) {
            ADD_FAILURE() << golden.name << ": " << read.error().message();
            return {};
        }
        Loaded loaded;
        for (const auto& [rule, count] : read->warnings.counts()) {
            loaded.warnings += count;
        }
        if (golden.light == Light::Own) {
            auto own = io::environmentOf(*read, 0, 32);
            EXPECT_TRUE(own.ok());
            loaded.environment = std::move(own->base);
        } else {
            loaded.environment = lightOf(golden.light);
        }
        loaded.scene = scene::buildScene(std::move(*read), golden.scene);
        if (golden.seconds >= 0.0 && !loaded.scene.animations.empty()) {
            scene::pose(loaded.scene, 0, golden.seconds);
        }
        return loaded;
    }

    static GltfBuilder built(const GltfGolden& golden) {
        GltfBuilder file;
        golden.build(file);
        if (!file.document.contains("cameras")) {
            file.orthographicCamera();
        }
        return file;
    }

    core::Image render(const GltfGolden& golden, const GltfBuilder& file) {
        const Loaded loaded = load(golden, file);
        return renderScene(golden, loaded.scene, loaded.environment);
    }
    void TestBody() override {}
    void start() { SetUp(); }
    void stop() { TearDown(); }
};

TEST_F(GltfGoldens, PicturesAreAsKeptAndHaveTheirProperties) {
    for (const GltfGolden& golden : allGoldens()) {
        SCOPED_TRACE(golden.name);
        const GltfBuilder file = built(golden);
        const Loaded loaded = load(golden, file);
        EXPECT_EQ(loaded.warnings, 0U) << "the file is not what it should be";
        const core::Image radiance = renderScene(golden, loaded.scene, loaded.environment);
        const core::Image kept = readPicture(path(golden));
        const core::Image actual = display(radiance);
        if (!passes(golden, kept, actual)) {
            const Difference d = compare(kept, actual, 1.5 / 255.0);
            ADD_FAILURE() << "mean " << d.mean << ", beyond 1/255 " << d.failingFraction;
            EXPECT_TRUE(io::writeImage(std::string(golden.name) + "-actual.png", actual).ok());
        }
        golden.property({file, loaded.scene, radiance,
                         [&](const GltfBuilder& other) { return render(golden, other); },
                         [&](const scene::Scene& other) {
                             return renderScene(golden, other, loaded.environment);
                         }});
    }
}

TEST_F(GltfGoldens, EachFailsWhereItsFeatureIsPassedOver) {
    for (const GltfGolden& golden : allGoldens()) {
        GltfBuilder file = built(golden);
        golden.ignore(file.document);
        const core::Image kept = readPicture(path(golden));
        const core::Image faulty = display(render(golden, file));
        const Difference d = compare(kept, faulty, 1.5 / 255.0);
        std::printf("%-28s passed over: mean %.4f, beyond 1/255 %.4f\n", golden.name, d.mean,
                    d.failingFraction);
        EXPECT_FALSE(passes(golden, kept, faulty)) << golden.name;
    }
}

TEST_F(GltfGoldens, EachFailsAgainstEveryOther) {
    const std::vector<GltfGolden> goldens = allGoldens();
    std::vector<core::Image> kept;
    for (const GltfGolden& golden : goldens) {
        kept.push_back(readPicture(path(golden)));
    }
    for (std::size_t i = 0; i < goldens.size(); ++i) {
        EXPECT_TRUE(passes(goldens[i], kept[i], kept[i])) << goldens[i].name;
        for (std::size_t j = 0; j < goldens.size(); ++j) {
            if (j != i) {
                EXPECT_FALSE(passes(goldens[i], kept[i], kept[j]))
                    << goldens[i].name << " " << goldens[j].name;
            }
        }
    }
}

int update(const char* name) {
    for (const GltfGolden& golden : allGoldens()) {
        if (std::strcmp(golden.name, name) == 0) {
            GltfGoldens fixture;
            fixture.start();
            const auto written =
                io::writeImage(GltfGoldens::path(golden),
                               display(fixture.render(golden, GltfGoldens::built(golden))));
            fixture.stop();
            std::printf("%s: %s\n", name, written ? "written" : written.error().message().c_str());
            return written ? 0 : 1;
        }
    }
    std::printf("no golden '%s'\n", name);
    return 2;
}

} // namespace
} // namespace lodestar::testing

int main(int argc, char** argv) {
    if (argc == 3 && std::strcmp(argv[1], "--update") == 0) {
        return lodestar::testing::update(argv[2]);
    }
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
