// SPDX-License-Identifier: MIT
#include "hosts/lit_context.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include <lodestar/lodestar_probes.h>

#include "io/document_file.h"
#include "io/environment_file.h"
#include "io/file.h"

namespace lodestar::hosts {

core::Result<LitContext> LitContext::open(const std::string& file, const Frame& frame) {
    const auto bytes = io::readFile(file);
    if (!bytes) {
        return bytes.error();
    }
    auto result = read({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file, frame);
    if (!result) {
        return core::inFile(result.error(), file);
    }
    return result;
}

core::Result<LitContext> LitContext::read(std::string_view text, const std::string& beside,
                                          const Frame& frame) {
    LodestarApi api{};
    api.struct_size = sizeof api;
    LodestarHost host{};
    host.struct_size = sizeof host;
    std::copy(std::begin(frame.up), std::end(frame.up), host.up);
    std::copy(std::begin(frame.north), std::end(frame.north), host.north);
    LodestarContext* context = nullptr;
    if (lodestar_get_api(LODESTAR_ABI_VERSION, &api) != LODESTAR_OK) {
        return core::Error{core::ErrorCode::Internal, "the library cannot be used", {}, {}};
    }
    if (api.context_create(&host, &context) != LODESTAR_OK) {
        return core::Error{core::ErrorCode::Internal, api.last_error(nullptr), {}, {}};
    }
    LitContext result(api, Owned(context, api.context_destroy));
    if (api.document_load(context, text.data(), text.size(), &result.document_) != LODESTAR_OK ||
        api.document_apply(context, result.document_) != LODESTAR_OK) {
        return result.refusal();
    }
    if (auto taken = result.takeEnvironment(beside); !taken) {
        return taken.error();
    }
    if (auto taken = result.takeProbes(beside); !taken) {
        return taken.error();
    }
    std::size_t lights = 0;
    api.lights(context, nullptr, &lights);
    if (lights == 0 && result.environment_ == 0) {
        return core::refused("has neither a light nor an environment", "/lights");
    }
    return result;
}

core::Result<void> LitContext::relight(std::string_view text) {
    LodestarDocument read = 0;
    if (api_.document_load(get(), text.data(), text.size(), &read) != LODESTAR_OK) {
        return refusal();
    }
    if (api_.document_apply(get(), read) != LODESTAR_OK) {
        core::Error why = refusal();
        api_.document_destroy(get(), read);
        return why;
    }
    api_.document_destroy(get(), document_);
    document_ = read;
    return {};
}

core::Result<LodestarEnvironment>
LitContext::loaded(const std::string& text, const std::string& beside, double rotation, double ev) {
    const auto source = io::environmentSource(text, beside);
    if (!source) {
        return source.error();
    }
    const auto loaded = io::loadEnvironment(*source);
    if (!loaded) {
        return core::inFile(loaded.error(), *source);
    }
    const std::vector<glm::vec4>& texels = loaded->base.level(0);
    const auto width = static_cast<std::uint32_t>(loaded->base.width());
    LodestarEnvironmentDesc desc{};
    desc.struct_size = sizeof desc;
    desc.layout = LODESTAR_CUBE;
    desc.name = source->c_str();
    desc.pixels = &texels.front().x;
    desc.width = desc.face_width = width;
    desc.height = 6 * width;
    desc.channels = 4;
    desc.rotation = rotation;
    desc.ev = ev;
    LodestarEnvironment made = 0;
    if (api_.environment_create(get(), &desc, &made) != LODESTAR_OK) {
        return refusal();
    }
    return made;
}

core::Result<void> LitContext::takeEnvironment(const std::string& beside) {
    std::size_t size = 0;
    if (api_.document_environment(get(), document_, nullptr, &size, nullptr, nullptr) !=
        LODESTAR_MORE) {
        return {};
    }
    std::string text(size, '\0');
    double rotation = 0.0, ev = 0.0;
    if (api_.document_environment(get(), document_, text.data(), &size, &rotation, &ev) !=
        LODESTAR_OK) {
        return refusal();
    }
    text.resize(size - 1);
    const auto made = loaded(text, beside, rotation, ev);
    if (!made) {
        return made.error();
    }
    environment_ = *made;
    if (api_.set_environment(get(), environment_) != LODESTAR_OK) {
        return refusal();
    }
    return {};
}

core::Result<void> LitContext::takeProbes(const std::string& beside) {
    const auto& probes =
        *static_cast<const LodestarProbesApi*>(api_.get_extension(LODESTAR_EXTENSION_PROBES));
    std::size_t count = 0;
    if (probes.document_probes(get(), document_) != LODESTAR_OK) {
        return refusal();
    }
    probes.probes(get(), nullptr, &count);
    std::vector<LodestarProbe> all(count);
    probes.probes(get(), all.data(), &count);
    for (const LodestarProbe probe : all) {
        std::size_t size = 0;
        if (probes.probe_source(get(), probe, nullptr, &size) != LODESTAR_MORE) {
            continue;
        }
        std::string text(size, '\0');
        probes.probe_source(get(), probe, text.data(), &size);
        text.resize(size - 1);
        const auto made = loaded(text, beside, 0.0, 0.0);
        if (!made) {
            return made.error();
        }
        if (probes.probe_hold(get(), probe, *made) != LODESTAR_OK ||
            api_.environment_destroy(get(), *made) != LODESTAR_OK) {
            return refusal();
        }
    }
    return {};
}

core::Error LitContext::refusal() const {
    return core::refused(api_.last_error(get()));
}

} // namespace lodestar::hosts
