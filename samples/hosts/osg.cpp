// SPDX-License-Identifier: MIT
//
// lodestar-host-osg: a glTF scene drawn by OpenSceneGraph, lit by a lighting document through
// lodestar/lodestar.h, without a display.
#include <glm/gtc/type_ptr.hpp>

#include <lodestar/lodestar.h>

#include "call.h"
#include "hosts/osg/headless.h"
#include "hosts/osg/lights.h"
#include "hosts/osg/scene.h"
#include "io/file.h"

namespace lodestar::samples {
namespace {

constexpr const char* kName = "lodestar-host-osg";

osg::Matrixd matrixOf(const glm::mat4& m) {
    return osg::Matrixd(glm::value_ptr(glm::dmat4(m)));
}

core::Result<void> save(const std::string& path, const osg::Image& image) {
    core::Image picture(image.s(), image.t(), 4);
    for (int y = 0; y < image.t(); ++y) {
        for (int x = 0; x < image.s(); ++x) {
            const unsigned char* p =
                image.data(static_cast<unsigned>(x), static_cast<unsigned>(image.t() - 1 - y));
            for (int c = 0; c < 4; ++c) {
                picture.at(x, y)[c] = static_cast<float>(p[c]) / 255.0f;
            }
        }
    }
    return io::writeImage(path, picture);
}

/// The document's lights in a context. @return the exit status
int light(const HostCall& call, const LodestarApi& api, LodestarContext* context,
          LodestarDocument& document) {
    const auto text = io::readFile(call.lighting);
    if (!text) {
        return hostFails(kName, text.error().message(), 3);
    }
    if (api.document_load(context, reinterpret_cast<const char*>(text->data()), text->size(),
                          &document) != LODESTAR_OK ||
        api.document_apply(context, document) != LODESTAR_OK) {
        return hostFails(kName, call.lighting + ": " + api.last_error(context), 3);
    }
    return 0;
}

int draw(const HostCall& call, const LodestarApi& api, LodestarContext* context) {
    LodestarDocument document = 0;
    if (const int status = light(call, api, context, document); status != 0) {
        return status;
    }
    const auto loaded = loadHostScene(call);
    if (!loaded) {
        return hostFails(kName, loaded.error().message(), static_cast<int>(loaded.error().code));
    }
    if (!osghost::makeContextCurrent()) {
        return hostFails(kName, "no EGL context without a surface", 4);
    }
    osg::ref_ptr<osg::Group> root = osghost::sceneOf(loaded->file, {api, context, document});
    if (!root) {
        return hostFails(kName,
                         call.scene + ": a material is out of range " + api.last_error(context), 3);
    }
    root->getOrCreateStateSet()->setAttributeAndModes(osghost::programOf(api));
    osghost::Lights lights(api, context, *root->getStateSet(), 0);
    if (lights.update(call.hour) != LODESTAR_OK) {
        return hostFails(kName, api.last_error(context), 1);
    }
    const osg::ref_ptr<osg::Image> image =
        osghost::drawOnce(*root, matrixOf(loaded->view.cameraFromWorld),
                          matrixOf(loaded->view.clipFromCamera), call.width, call.height);
    const auto written = save(call.output, *image);
    return written ? 0 : hostFails(kName, written.error().message(), 5);
}

int run(const HostCall& call) {
    LodestarApi api{};
    api.struct_size = sizeof api;
    LodestarContext* context = nullptr;
    if (lodestar_get_api(LODESTAR_ABI_VERSION, &api) != LODESTAR_OK ||
        api.context_create(nullptr, &context) != LODESTAR_OK) {
        return hostFails(kName, "the library cannot be used", 1);
    }
    const int status = draw(call, api, context);
    api.context_destroy(context);
    return status;
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    const auto call = lodestar::samples::parseHostCall(argc, argv);
    return call ? lodestar::samples::run(*call)
                : lodestar::samples::explainHost(lodestar::samples::kName, argc, argv);
}
