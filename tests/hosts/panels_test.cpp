// SPDX-License-Identifier: MIT
//
// The editor's panels in the ImGui frame of a host that draws its own picture (samples/panels).
#include <cstdlib>

#include <epoxy/egl.h>
#include <imgui.h>

#include "host_pictures.h"
#include "panels_host.h"
#include "support/gl_fixture.h"

namespace lodestar::testing {
namespace {

void* procedure(const char* name) {
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

class PanelsHostTest : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) {
            return;
        }
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.DisplaySize = {1128.0f, 716.0f};
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        io.Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        call_.scene = spheres(folder_, 2.2);
        call_.lighting = day(folder_);
        call_.hour = 12.0;
        call_.width = 320;
        call_.height = 200;
        host_ = open();
        frame();
        frame(); // the first has only measured the widgets
    }
    void TearDown() override {
        host_.reset();
        if (ImGui::GetCurrentContext() != nullptr) {
            ImGui::DestroyContext();
        }
        GlTest::TearDown();
    }
    std::unique_ptr<samples::PanelsHost> open() {
        auto made = samples::PanelsHost::make(call_, procedure);
        EXPECT_TRUE(made) << made.error().message();
        return made ? std::move(*made) : nullptr;
    }
    void frame() {
        ImGui::NewFrame();
        const auto drawn = host_->frame(0.0);
        ImGui::Render();
        ASSERT_TRUE(drawn) << drawn.error().message();
    }
    [[nodiscard]] ImVec2 at(const std::string& name) const {
        const auto& marks = host_->workspace().marks();
        const auto found = marks.find(name);
        EXPECT_NE(found, marks.end()) << name;
        return found == marks.end() ? ImVec2() : found->second.center();
    }
    void moveTo(const ImVec2& place) {
        ImGui::GetIO().MousePos = place;
        frame();
    }

    TemporaryFolder folder_;
    samples::HostCall call_;
    std::unique_ptr<samples::PanelsHost> host_;
};

TEST_F(PanelsHostTest, ADragLightsTheHostsPictureInItsOwnFrame) {
    const ImVec2 horizon = at("stop 1");
    const std::vector<std::uint8_t> before = host_->engine().read();
    moveTo(horizon);
    ImGui::GetIO().MouseDown[0] = true;
    frame();
    EXPECT_EQ(host_->engine().read(), before) << "nothing is dragged yet";
    const std::uint64_t revision = host_->model().revisions().document;
    moveTo({horizon.x - 60.0f, horizon.y});
    ASSERT_NE(host_->model().revisions().document, revision) << "the stop is not dragged";
    const std::vector<std::uint8_t> dragged = host_->engine().read();
    EXPECT_NE(dragged, before) << "the picture is a frame late";
    ImGui::GetIO().MouseDown[0] = false;
    frame();

    // What is saved shines in another host as it shone here while it was dragged.
    ImGui::GetIO().KeyCtrl = true;
    host_->setPlaceOfKey([](ui::Key key) { return key == ui::Key::S ? 300 : -1; });
    ImGui::GetIO().KeysDown[300] = true;
    frame();
    EXPECT_FALSE(host_->model().dirty()) << "not saved";
    host_ = open();
    ImGui::GetIO().KeysDown[300] = false;
    frame();
    EXPECT_EQ(host_->engine().read(), dragged);
}

TEST_F(PanelsHostTest, KeysAreTheHostsUnlessAPanelHasTheFocus) {
    host_->setPlaceOfKey([](ui::Key key) { return key == ui::Key::B ? 7 : -1; });
    const auto press = [&] {
        ImGui::GetIO().KeysDown[7] = true;
        frame();
        ImGui::GetIO().KeysDown[7] = false;
        frame();
    };
    ImGui::SetWindowFocus("Engine");
    frame();
    press();
    EXPECT_FALSE(host_->workspace().view().brush);
    ImGui::SetWindowFocus("Light");
    frame();
    press();
    EXPECT_TRUE(host_->workspace().view().brush);
}

TEST(PanelsProgram, DrawsWithoutADisplayAndSaysHowItIsCalled) {
    const TemporaryFolder folder;
    const std::string picture = (folder / "panels.png").string();
    const std::string call = program("lodestar-panels") + " " + spheres(folder, 2.2) +
                             " --lighting " + day(folder) + " --frames 3 -o " + picture;
    ASSERT_EQ(std::system(("env -u DISPLAY " + call).c_str()), 0);
    const core::Image drawn = readPicture(picture);
    ASSERT_EQ(drawn.width(), 1128);
    ASSERT_EQ(drawn.height(), 716);
    const std::string quiet = " >/dev/null 2>&1";
    EXPECT_EQ(WEXITSTATUS(std::system((program("lodestar-panels") + quiet).c_str())), 2);
    EXPECT_EQ(WEXITSTATUS(std::system((program("lodestar-panels") + " --help" + quiet).c_str())),
              0);
    EXPECT_EQ(
        WEXITSTATUS(std::system((program("lodestar-panels") +
                                 " none.gltf --lighting none.json --frames 1 -o " + picture + quiet)
                                    .c_str())),
        3);
}

} // namespace
} // namespace lodestar::testing
