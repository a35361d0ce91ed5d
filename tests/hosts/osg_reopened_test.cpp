// SPDX-License-Identifier: MIT
//
// Documents opened again and light that changes while OpenSceneGraph draws: the textures of the old
// ones end and are taken for new ones, without an error of OpenGL's, and the pictures are the same.
#include <cstdio>
#include <string>

#include <EGL/egl.h>
#include <gtest/gtest.h>
#include <osg/DisplaySettings>

#include "hosts/osg/headless.h"
#include "hosts/osg/lighting.h"
#include "osg_scene.h"

namespace lodestar::testing {
namespace {

/// Errors that the driver has told of, in the current context and from now on.
int errors = 0;
void countErrors() {
    using Called =
        void(GLenum, GLenum type, GLuint, GLenum, GLsizei, const char* text, const void*);
    const auto callBack = reinterpret_cast<void (*)(Called*, const void*)>(
        eglGetProcAddress("glDebugMessageCallback"));
    constexpr GLenum kOutput = 0x92E0, kAtOnce = 0x8242, kError = 0x824C; // KHR_debug
    ASSERT_NE(callBack, nullptr);
    glEnable(kOutput);
    glEnable(kAtOnce);
    callBack(
        [](GLenum, GLenum type, GLuint, GLenum, GLsizei, const char* text, const void*) {
            if (type == kError) {
                std::printf("%s\n", text);
                ++errors;
            }
        },
        nullptr);
}

/// In each update but the last ones it opens the document anew, or moves a ball.
struct Changes : osg::NodeCallback {
    Changes(osghost::Lighting& changed, osg::MatrixTransform& moved, bool reopens)
        : lighting(changed), ball(moved), document(changed.getDocument()), opens(reopens) {}
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        ++updates;
        if (updates <= kChanges) {
            if (opens && updates % 3 == 0) {
                document += "\n";
                lighting.setDocument(document);
            }
            ball.setMatrix(osg::Matrixd::translate(-1.1, 0.02 * (kChanges - updates), 0.0));
        }
        traverse(node, visitor);
    }
    static constexpr int kChanges = 24;
    osghost::Lighting& lighting;
    osg::MatrixTransform& ball;
    std::string document;
    bool opens;
    int updates = 0;
};

osg::ref_ptr<osg::Image> drawn(bool changes, bool reopens) {
    constexpr const char* kProbe = R"("probes": [{"node": "golden", "capture": {"resolution": 16,
        "near": 0.95, "far": 50}, "influence": {"shape": "box", "size": [2, 2, 2]}}], )";
    osg::ref_ptr<osghost::Lighting> node = new osghost::Lighting;
    std::string document = kDay;
    document.insert(document.find("\"lights\""), kProbe);
    node->setDocument(document);
    const osg::ref_ptr<osg::MatrixTransform> red =
        ball({-1.1f, 0, 0}, 1.0f, {.diffuse = {0.7f, 0.2f, 0.1f}});
    const osg::ref_ptr<osg::MatrixTransform> golden = ball(
        {1.2f, 0, 0}, 0.9f, {.diffuse = {0, 0, 0}, .f0 = {1.0f, 0.77f, 0.34f}, .exponent = 150.0f});
    golden->setName("golden");
    node->addChild(red);
    node->addChild(golden);
    osg::ref_ptr<osg::Group> root = new osg::Group;
    root->addChild(node);
    if (changes) {
        root->setUpdateCallback(new Changes(*node, *red, reopens));
    }
    EXPECT_TRUE(osghost::makeContextCurrent());
    countErrors();
    return osghost::drawOnce(*root, viewOfBalls(), projectionOfBalls(), 96, 64,
                             Changes::kChanges + 24);
}

TEST(OsgReopened, NoTextureIsGivenStorageTwice) {
    osg::DisplaySettings::instance()->setMaxTexturePoolSize(256u << 20); // what ends is kept
    errors = 0;
    const osg::ref_ptr<osg::Image> still = drawn(false, false);
    for (const bool reopens : {false, true}) {
        const osg::ref_ptr<osg::Image> last = drawn(true, reopens);
        int largest = 0;
        for (unsigned i = 0; i < still->getTotalSizeInBytes(); ++i) {
            largest = std::max(largest, std::abs(int{still->data()[i]} - int{last->data()[i]}));
        }
        EXPECT_LE(largest, 1) << reopens;
        EXPECT_EQ(errors, 0) << reopens;
    }
}

} // namespace
} // namespace lodestar::testing
