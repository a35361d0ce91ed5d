// SPDX-License-Identifier: MIT
//
// lodestar-host-foreign: an engine that is deferred and knows nothing of Lodestar
// (deferred_engine.h), lit by a lighting document: textures by the extension "lodestar.gl", one
// text for its lighting pass (engine_light.h).
#include <epoxy/egl.h>

#include "call.h"
#include "deferred_engine.h"
#include "engine_light.h"
#include "hosts/material.h"
#include "platform/headless_context.h"

namespace lodestar::samples {
namespace {

void* procedure(const char* name) {
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

core::Result<core::Image> draw(const HostCall& call, const HostScene& loaded) {
    const auto lit = hosts::LitContext::open(call.lighting);
    if (!lit) {
        return lit.error();
    }
    warn("lodestar-host-foreign", call, hosts::leftOut(loaded.file));
    auto context = platform::HeadlessContext::create();
    if (!context) {
        return context.error();
    }
    DeferredEngine engine(call.width, call.height);
    const EngineLight light(*lit, procedure);
    if (auto prepared = light.prepare(loaded.file, engine); !prepared) {
        return core::inFile(prepared.error(), call.scene);
    }
    if (auto set = light.set(call.hour, loaded.view, engine); !set) {
        return set.error();
    }
    engine.draw(loaded.view.clipFromWorld());
    return pictureOf(call, engine.read().data());
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    return lodestar::samples::runHost("lodestar-host-foreign", argc, argv, lodestar::samples::draw);
}
