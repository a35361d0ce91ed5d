// SPDX-License-Identifier: MIT
//
// lodestar-host-osg: a glTF scene drawn by OpenSceneGraph, lit by a lighting document through
// lodestar/lodestar.h. It needs no display: the context is EGL's, without a surface.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <osg/Camera>
#include <osg/Program>
#include <osg/Texture2D>
#include <osgViewer/Viewer>

#include "io/file.h"
#include "io/gltf.h"
#include "io/image_file.h"
#include "lights.h"
#include "scene.h"

namespace lodestar::osghost {
namespace {

constexpr const char* kUsage =
    "usage: lodestar-host-osg SCENE --lighting FILE -o OUT.png --size WxH --hour H\n"
    "                         --eye X,Y,Z --target X,Y,Z [--fov DEGREES]\n"
    "Example: lodestar-host-osg spheres.gltf --lighting dusk.lodestar.json -o dusk.png \\\n"
    "             --size 640x480 --hour 18.5 --eye 0,1,6 --target 0,0,0\n";

struct Call {
    std::string scene, lighting, output;
    int width = 640, height = 480;
    double hour = 15.0, fov = 45.0;
    osg::Vec3d eye{0, 1, 6}, target{0, 0, 0};
};

bool parse(int argc, char** argv, Call& call) {
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word[0] != '-') {
            call.scene = word;
            continue;
        }
        if (i + 1 == argc) {
            return false;
        }
        const char* value = argv[++i];
        const auto vector = [value](osg::Vec3d& v) {
            return std::sscanf(value, "%lf,%lf,%lf", &v.x(), &v.y(), &v.z()) == 3;
        };
        bool good = true;
        if (word == "--lighting") {
            call.lighting = value;
        } else if (word == "-o") {
            call.output = value;
        } else if (word == "--size") {
            good = std::sscanf(value, "%dx%d", &call.width, &call.height) == 2 && call.width > 0 &&
                   call.height > 0 && call.width <= 8192 && call.height <= 8192;
        } else if (word == "--hour") {
            good = std::sscanf(value, "%lf", &call.hour) == 1;
        } else if (word == "--fov") {
            good = std::sscanf(value, "%lf", &call.fov) == 1 && call.fov > 0.0 && call.fov < 180.0;
        } else if (word == "--eye" || word == "--target") {
            good = vector(word == "--eye" ? call.eye : call.target);
        } else {
            good = false;
        }
        if (!good) {
            return false;
        }
    }
    return !call.scene.empty() && !call.lighting.empty() && !call.output.empty();
}

/// A compatibility context without a surface: what Debian's OpenSceneGraph draws with.
bool makeCurrent() {
    const auto platformDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (platformDisplay == nullptr) {
        return false;
    }
    const EGLDisplay display =
        platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) ||
        !eglBindAPI(EGL_OPENGL_API)) {
        return false;
    }
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             3,
                             EGL_CONTEXT_MINOR_VERSION,
                             3,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                             EGL_NONE};
    const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    return context != EGL_NO_CONTEXT &&
           eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE;
}

std::string textOf(const LodestarApi& api, const char* file) {
    LodestarDialect dialect{};
    dialect.struct_size = sizeof dialect;
    dialect.version = 330;
    dialect.profile = LODESTAR_PROFILE_COMPATIBILITY;
    dialect.without_version_line = 1;
    std::size_t size = 0;
    api.glsl_text(file, &dialect, nullptr, &size);
    std::string text(size, '\0');
    api.glsl_text(file, &dialect, text.data(), &size);
    text.resize(size > 0 ? size - 1 : 0);
    return text;
}

osg::ref_ptr<osg::Program> programOf(const LodestarApi& api) {
    const std::string version = "#version 330 compatibility\n";
    const std::string vertex = version + R"(
uniform mat4 osg_ViewMatrixInverse;
out vec3 vPosition;
out vec3 vNormal;
void main() {
    vPosition = vec3(osg_ViewMatrixInverse * (gl_ModelViewMatrix * gl_Vertex));
    vNormal = mat3(osg_ViewMatrixInverse) * (gl_NormalMatrix * gl_Normal);
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
})";
    // The environment's own hooks are not asked for here.
    const std::string fragment = version + textOf(api, "lodestar/environment.glsl") +
                                 textOf(api, "lodestar/rsrm.glsl") +
                                 textOf(api, "lodestar/display.glsl") + R"(
vec4 lodestar_host_cube(int slot, vec3 direction, float level) { return vec4(0.0); }
vec3 lodestar_host_irradiance(int slot, vec3 normal) { return vec3(0.0); }
)" + Lights::shaderText() + R"(
uniform mat4 osg_ViewMatrixInverse;
uniform vec4 material_diffuse;
uniform vec4 material_f0;
in vec3 vPosition;
in vec3 vNormal;
void main() {
    LodestarSurface here;
    here.view = normalize(osg_ViewMatrixInverse[3].xyz - vPosition);
    here.normal = normalize(vNormal) * (gl_FrontFacing ? 1.0 : -1.0);
    here.diffuse = material_diffuse.rgb;
    here.f0 = material_f0.rgb;
    here.exponent = material_f0.w;
    here.occlusion = 1.0;
    vec3 radiance = lodestar_lights(here);
    gl_FragColor = vec4(lodestar_srgbFromLinear(lodestar_filmic(radiance.r)),
                        lodestar_srgbFromLinear(lodestar_filmic(radiance.g)),
                        lodestar_srgbFromLinear(lodestar_filmic(radiance.b)), 1.0);
})";
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
    return program;
}

int fail(const std::string& what, int status) {
    std::fprintf(stderr, "lodestar-host-osg: %s\n", what.c_str());
    return status;
}

/// Draws the scene once into an image.
osg::ref_ptr<osg::Image> draw(const Call& call, osg::Group& root) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(call.width, call.height, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    osgViewer::Viewer viewer;
    osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window =
        viewer.setUpViewerAsEmbeddedInWindow(0, 0, call.width, call.height);
    viewer.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    // Everything is drawn by a camera of its own: there is no framebuffer 0.
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setRenderOrder(osg::Camera::PRE_RENDER);
    camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setViewport(0, 0, call.width, call.height);
    camera->setClearColor(osg::Vec4(0, 0, 0, 0));
    camera->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    camera->setViewMatrixAsLookAt(call.eye, call.target, osg::Vec3d(0, 1, 0));
    const double reach = (call.eye - call.target).length() + 2.0 * root.getBound().radius();
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setProjectionMatrixAsPerspective(
        call.fov, static_cast<double>(call.width) / call.height, reach * 1e-3, reach * 2.0);
    camera->attach(osg::Camera::COLOR_BUFFER, image);
    // Inside nested cameras OpenSceneGraph's own uniform is the main camera's.
    camera->getOrCreateStateSet()->addUniform(
        new osg::Uniform("osg_ViewMatrixInverse",
                         osg::Matrixf(osg::Matrixd::inverse(camera->getViewMatrix()))),
        osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
    camera->addChild(&root);
    osg::ref_ptr<osg::Group> top = new osg::Group;
    top->addChild(camera);
    viewer.setSceneData(top);
    viewer.getCamera()->setClearMask(0);
    viewer.realize();
    viewer.frame();
    return image;
}

bool save(const std::string& path, const osg::Image& image) {
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
    return io::writeImage(path, picture).ok();
}

int run(const Call& call) {
    LodestarApi api{};
    api.struct_size = sizeof api;
    LodestarContext* context = nullptr;
    if (lodestar_get_api(LODESTAR_ABI_VERSION, &api) != LODESTAR_OK ||
        api.context_create(nullptr, &context) != LODESTAR_OK) {
        return fail("the library cannot be used", 1);
    }
    const auto text = io::readFile(call.lighting);
    LodestarDocument document = 0;
    if (!text) {
        return fail(text.error().message(), 3);
    }
    if (api.document_load(context, reinterpret_cast<const char*>(text->data()), text->size(),
                          &document) != LODESTAR_OK ||
        api.document_apply(context, document) != LODESTAR_OK) {
        return fail(call.lighting + ": " + api.last_error(context), 3);
    }
    const auto file = io::loadGltf(call.scene, {});
    if (!file) {
        return fail(file.error().message(), 3);
    }
    if (!makeCurrent()) {
        return fail("no EGL context without a surface", 4);
    }
    osg::ref_ptr<osg::Group> root = sceneOf(*file);
    osg::StateSet& state = *root->getOrCreateStateSet();
    state.setAttributeAndModes(programOf(api));
    Lights lights(api, context, state, 0);
    if (lights.update(call.hour) != LODESTAR_OK) {
        return fail(api.last_error(context), 1);
    }
    const osg::ref_ptr<osg::Image> image = draw(call, *root);
    api.context_destroy(context);
    return save(call.output, *image) ? 0 : fail(call.output + ": cannot be written", 5);
}

} // namespace
} // namespace lodestar::osghost

int main(int argc, char** argv) {
    lodestar::osghost::Call call;
    if (!lodestar::osghost::parse(argc, argv, call)) {
        const bool asked = argc == 2 && std::string(argv[1]) == "--help";
        std::fputs(lodestar::osghost::kUsage, asked ? stdout : stderr);
        return asked ? 0 : 2;
    }
    return lodestar::osghost::run(call);
}
