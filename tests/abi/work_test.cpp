// SPDX-License-Identifier: MIT
//
// A plan that is made and executed through the library does the work that the built-in renderer
// does for the same lighting, upload by upload.
#include <epoxy/egl.h>

#include "golden/gltf_builder.h"
#include "host/blocks.glsl"
#include "io/document_file.h"
#include "lodestar/lodestar.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

namespace lodestar::testing {
namespace {

constexpr const char* kDay =
    R"({"lodestar": 1, "environment": {"source": "gradient:0.1,0.6"}, "lights": [
    {"name": "sky", "kind": "sky", "add": true, "keys": [
        {"hour": 6, "gradient": {"stops": [{"at": 90, "color": [0.1, 0.2, 0.5]}, {"at": -90, "color": [0.2, 0.2, 0.2]}]}},
        {"hour": 18, "gradient": {"stops": [{"at": 90, "color": [0.4, 0.2, 0.2]}, {"at": -90, "color": [0.1, 0.1, 0.1]}]}}]},
    {"name": "sun", "kind": "sun", "visibility": false, "path": {"latitude": 45, "dayOfYear": 170}, "keys": [
        {"hour": 12, "gradient": {"stops": [{"at": 0, "color": [1, 1, 1], "ev": 10}, {"at": 3, "color": [0, 0, 0]}]}}]}]})";

struct Uploads {
    std::uint64_t count = 0, bytes = 0, texels = 0;
    bool operator==(const Uploads&) const = default;
    friend void PrintTo(const Uploads& u, std::ostream* out) {
        *out << u.count << " uploads, " << u.bytes << " bytes, " << u.texels << " texels";
    }
};

class Work : public GlTest {
protected:
    /// Of a frame beyond what one draws in which nothing has changed.
    Uploads byUs(scene::Renderer& renderer, const scene::View& view, double hour) {
        scene::RenderSettings settings;
        settings.width = settings.height = 32;
        settings.backdrop = false;
        settings.hour = hour;
        const auto frame = renderer.render(view, settings);
        const auto idle = renderer.render(view, settings);
        EXPECT_TRUE(frame.ok() && idle.ok());
        const gl::WorkCounters& a = frame->counters;
        const gl::WorkCounters& b = idle->counters;
        return {a.uploads - b.uploads, a.uploadBytes - b.uploadBytes,
                a.texelsWritten - b.texelsWritten};
    }
};

/// A context under the same document.
class Host {
public:
    explicit Host(const LodestarMaterial& material) : material_(material) {
        api_.struct_size = sizeof api_;
        EXPECT_EQ(lodestar_get_api(LODESTAR_ABI_VERSION, &api_), LODESTAR_OK);
        EXPECT_EQ(api_.context_create(nullptr, &context_), LODESTAR_OK);
        LodestarDocument document = 0;
        EXPECT_EQ(api_.document_load(context_, kDay, std::strlen(kDay), &document), LODESTAR_OK);
        EXPECT_EQ(api_.document_apply(context_, document), LODESTAR_OK);
        LodestarEnvironmentDesc desc{};
        desc.struct_size = sizeof desc;
        desc.layout = LODESTAR_ANALYTIC;
        desc.analytic = "gradient:0.1,0.6";
        LodestarEnvironment environment = 0;
        EXPECT_EQ(api_.environment_create(context_, &desc, &environment), LODESTAR_OK);
        EXPECT_EQ(api_.set_environment(context_, environment), LODESTAR_OK);
        gl_ = static_cast<const LodestarGlApi*>(api_.get_extension(LODESTAR_EXTENSION_GL));
        EXPECT_EQ(gl_->attach(context_,
                              [](const char* name) {
                                  return reinterpret_cast<void*>(eglGetProcAddress(name));
                              }),
                  LODESTAR_OK);
    }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;
    ~Host() {
        EXPECT_EQ(gl_->detach(context_, 1), LODESTAR_OK);
        api_.context_destroy(context_);
    }
    /// What a frame was planned to upload, and what it did.
    std::pair<Uploads, Uploads> frame(double hour) {
        LodestarDraw draw{};
        draw.struct_size = sizeof draw;
        draw.visible = 1;
        draw.material = &material_;
        LodestarFrame frame{};
        frame.struct_size = sizeof frame;
        frame.hour = hour;
        frame.draws = &draw;
        frame.draw_count = 1;
        frame.draw_stride = sizeof draw;
        LodestarPlan plan = 0;
        EXPECT_EQ(api_.plan_make(context_, &frame, &plan), LODESTAR_OK);
        LodestarWork planned{}, before{}, after{};
        planned.struct_size = before.struct_size = after.struct_size = sizeof planned;
        EXPECT_EQ(api_.plan_work(context_, plan, &planned), LODESTAR_OK);
        EXPECT_EQ(gl_->work(context_, &before), LODESTAR_OK);
        EXPECT_EQ(gl_->execute(context_, plan), LODESTAR_OK);
        EXPECT_EQ(gl_->work(context_, &after), LODESTAR_OK);
        return {{planned.uploads, planned.upload_bytes, planned.texels_written},
                {after.uploads - before.uploads, after.upload_bytes - before.upload_bytes,
                 after.texels_written - before.texels_written}};
    }

private:
    LodestarApi api_{};
    LodestarContext* context_ = nullptr;
    const LodestarGlApi* gl_ = nullptr;
    LodestarMaterial material_;
};

TEST_F(Work, IsWhatTheBuiltInRendererDoes) {
    const TemporaryFolder folder;
    GltfBuilder builder;
    builder.show({builder.primitive(sphere(12, 24),
                                    builder.add("materials", {{"pbrMetallicRoughness",
                                                               {{"metallicFactor", 0.0},
                                                                {"roughnessFactor", 0.4}}}}))},
                 {});
    const auto file = io::loadGltf(builder.write(folder).string(), {});
    ASSERT_TRUE(file.ok());
    const scene::Scene scene = scene::buildScene(*file, file->defaultScene);
    const auto view = scene::chooseView(scene, {}, 1.0f);
    ASSERT_TRUE(view.ok());
    auto renderer = scene::Renderer::make(device(), scene);
    ASSERT_TRUE(renderer.ok());
    // Instances are uploaded once, whatever lights them.
    (*renderer)->setEnvironment(
        "black", lighting::cubeFromAnalytic(*lighting::parseAnalytic("constant:0,0,0"), 4));
    byUs(**renderer, *view, 9.0);
    core::Tally warnings;
    const auto document = document::parseDocument(kDay, warnings);
    ASSERT_TRUE(document.ok());
    (*renderer)->setLights(*document::dayLights(*document, warnings));
    (*renderer)->setEnvironment(
        "gradient", lighting::cubeFromAnalytic(*lighting::parseAnalytic("gradient:0.1,0.6"), 256));
    LodestarMaterial material{};
    material.struct_size = sizeof material;
    material.base_color[0] = material.base_color[1] = material.base_color[2] = 1.0;
    material.roughness = 0.4;
    Host host(material);
    std::uint64_t most = 0;
    for (const double hour : {9.0, 9.0, 12.0, 12.5, 23.0, 6.0, 18.0}) {
        const Uploads own = byUs(**renderer, *view, hour);
        const auto [planned, done] = host.frame(hour);
        EXPECT_EQ(planned, done) << hour;
        EXPECT_EQ(done.texels, own.texels) << hour;
        // Beside texels the renderer uploads its uniform blocks where they change; a host its own.
        const std::uint64_t blocks = own.count - done.count;
        const std::uint64_t bytes = own.bytes - done.bytes;
        constexpr std::uint64_t kFrame = sizeof(scene::blocks::LodestarFrame);
        constexpr std::uint64_t kLights = sizeof(scene::blocks::LodestarRsrmLights);
        EXPECT_TRUE((blocks == 0 && bytes == 0) || (blocks == 1 && bytes == kLights) ||
                    (blocks == 2 && bytes == kLights + kFrame))
            << blocks << " blocks, " << bytes << " bytes at " << hour;
        most = std::max(most, done.count);
    }
    EXPECT_EQ(most, 2u * 3u + 6u * 9u + 6u) << "two lights, nine levels, irradiance: once";
}

} // namespace
} // namespace lodestar::testing
