// SPDX-License-Identifier: MIT
//
// The extension "lodestar.probes": arguments checked, the work handed on.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include <glm/gtc/type_ptr.hpp>

#include "answers.h"

namespace lodestar::plugin {
namespace {

LodestarStatus noProbe(LodestarContext& context) {
    return context.fail(LODESTAR_E_ARG, "no such probe");
}

/// Runs a [main] function's body with its probe.
template <class Body>
LodestarStatus withProbe(LodestarContext* context, LodestarProbe handle,
                         const Body& body) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        PlacedProbe* probe = context->probes.find(handle);
        return probe != nullptr ? body(*probe) : noProbe(*context);
    });
}

LodestarStatus create(LodestarContext* context, const LodestarProbeDesc* desc,
                      LodestarProbe* handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        LodestarProbeDesc given{};
        if (handle == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no place for the probe");
        }
        if (!readStruct(desc, given)) {
            return context->fail(LODESTAR_E_ABI,
                                 "the probe's struct_size is none, or members are unknown");
        }
        auto made = PlacedProbe::make(given);
        if (!made) {
            return context->fail(LODESTAR_E_ARG, made.error());
        }
        context->probeOrder.reserve(context->probeOrder.size() + 1);
        *handle = context->probes.add(std::move(*made));
        context->probeOrder.push_back(*handle);
        return LODESTAR_OK;
    });
}

LodestarStatus destroy(LodestarContext* context, LodestarProbe handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (!context->probes.remove(handle)) {
            return noProbe(*context);
        }
        std::erase(context->probeOrder, handle);
        return LODESTAR_OK;
    });
}

LodestarStatus ofDocument(LodestarContext* context, LodestarDocument handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        const document::Document* document = context->documents.find(handle);
        if (document == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no such document");
        }
        core::Tally warnings;
        std::vector<LodestarProbe> order;
        order.reserve(document->probes.size());
        try { // handles of before stay stale: the new are added before the old go
            for (const document::Probe& probe : document->probes) {
                order.push_back(context->probes.add(
                    PlacedProbe(probe.probe, context->hostFromDocument, warnings)));
            }
        } catch (...) {
            for (const LodestarProbe added : order) {
                context->probes.remove(added);
            }
            throw;
        }
        for (const LodestarProbe old : context->probeOrder) {
            context->probes.remove(old);
        }
        context->probeOrder = std::move(order);
        context->log(warnings);
        return LODESTAR_OK;
    });
}

LodestarStatus all(LodestarContext* context, LodestarProbe* handles, size_t* count) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (count == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no place for the count");
        }
        return answerQuery(context->probeOrder.data(), context->probeOrder.size(),
                           sizeof(LodestarProbe), handles, count);
    });
}

/// A two-call query of a name; nothing where there is none.
LodestarStatus answerName(LodestarContext& context, const std::string& name, char* buffer,
                          size_t* size) {
    if (size == nullptr) {
        return context.fail(LODESTAR_E_ARG, "no place for the size");
    }
    if (name.empty()) {
        *size = 0;
        return LODESTAR_OK;
    }
    return answerQuery(name.c_str(), name.size() + 1, 1, buffer, size);
}

LodestarStatus node(LodestarContext* context, LodestarProbe handle, char* buffer,
                    size_t* size) noexcept {
    return withProbe(context, handle, [&](const PlacedProbe& probe) {
        return answerName(*context, probe.probe().node, buffer, size);
    });
}

LodestarStatus source(LodestarContext* context, LodestarProbe handle, char* buffer,
                      size_t* size) noexcept {
    return withProbe(context, handle, [&](const PlacedProbe& probe) {
        return answerName(*context, probe.probe().source, buffer, size);
    });
}

LodestarStatus move(LodestarContext* context, LodestarProbe handle, const double* frame) noexcept {
    return withProbe(context, handle, [&](PlacedProbe& probe) -> LodestarStatus {
        if (frame == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no frame");
        }
        probe.move(glm::make_mat4(frame));
        return LODESTAR_OK;
    });
}

LodestarStatus hold(LodestarContext* context, LodestarProbe handle,
                    LodestarEnvironment environment) noexcept {
    return withProbe(context, handle, [&](PlacedProbe& probe) -> LodestarStatus {
        const PlacedEnvironment* held = context->environments.find(environment);
        if (held == nullptr || held->version() == 0) {
            return context->fail(LODESTAR_E_ARG, "no such environment, or it shows nothing yet");
        }
        probe.hold(held->base());
        return LODESTAR_OK;
    });
}

LodestarStatus request(LodestarContext* context, LodestarProbe handle) noexcept {
    return withProbe(context, handle, [&](PlacedProbe& probe) -> LodestarStatus {
        probe.request();
        return LODESTAR_OK;
    });
}

core::Result<DrawBox> boxOf(const LodestarProbeFrame& frame, std::uint32_t i) {
    const std::string at = "/draws/" + std::to_string(i);
    const auto* bytes = reinterpret_cast<const unsigned char*>(frame.draws);
    const auto* given =
        reinterpret_cast<const LodestarProbeDraw*>(bytes + std::size_t{i} * frame.draw_stride);
    LodestarProbeDraw draw{};
    if (frame.draw_stride < 2 * sizeof(std::uint32_t) || given->struct_size > frame.draw_stride ||
        !readStruct(given, draw)) {
        return core::refused("the draw's struct_size or the stride is none", at);
    }
    DrawBox box;
    box.id = draw.id;
    box.layers = draw.hidden != 0 ? 0 : draw.layers != 0 ? draw.layers : 0xffffffffu;
    box.share = static_cast<float>(std::clamp(draw.share, 0.0, 1.0));
    box.changed = draw.changed != 0;
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = static_cast<float>(draw.low[axis]);
        box.high[axis] = static_cast<float>(draw.high[axis]);
        if (!(box.low[axis] <= box.high[axis]) || !std::isfinite(box.low[axis]) ||
            !std::isfinite(box.high[axis]) || !std::isfinite(draw.share)) {
            return core::refused("a box is finite, low <= high", at);
        }
    }
    return box;
}

LodestarStatus boxes(LodestarContext* context, const LodestarProbeFrame* frame) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        LodestarProbeFrame given{};
        if (!readStruct(frame, given)) {
            return context->fail(LODESTAR_E_ABI,
                                 "the frame's struct_size is none, or members are unknown");
        }
        if ((given.draws == nullptr && given.draw_count > 0) || !(given.light_threshold >= 0.0)) {
            return context->fail(LODESTAR_E_ARG, "no boxes, or a threshold below 0");
        }
        BoxedFrame made;
        made.lightThreshold = given.light_threshold > 0.0 ? given.light_threshold : 0.1;
        std::vector<std::uint64_t> ids;
        for (std::uint32_t i = 0; i < given.draw_count; ++i) {
            auto box = boxOf(given, i);
            if (!box) {
                return context->fail(LODESTAR_E_ARG, box.error());
            }
            ids.push_back(box->id);
            made.draws.push_back(*box);
        }
        std::sort(ids.begin(), ids.end());
        if (std::adjacent_find(ids.begin(), ids.end()) != ids.end()) {
            return context->fail(LODESTAR_E_ARG, "two draws have one id");
        }
        context->boxes = std::move(made);
        return LODESTAR_OK;
    });
}

LodestarStatus face(LodestarContext* context, LodestarPlan plan, LodestarProbe handle,
                    int32_t index, const float* pixels) noexcept {
    return withProbe(context, handle, [&](PlacedProbe& probe) -> LodestarStatus {
        if (plan == 0 || index < 0 || index >= 6 || pixels == nullptr) {
            return context->fail(LODESTAR_E_ARG,
                                 "a face is 0 to 5 of a plan's, its pixels are there");
        }
        core::Tally warnings;
        const bool awaited = probe.setFace(plan, index, pixels, warnings);
        context->log(warnings);
        return awaited ? LODESTAR_OK : LODESTAR_MORE;
    });
}

LodestarStatus jobs(LodestarContext* context, LodestarPlan plan, LodestarProbeJob* into,
                    size_t* count) noexcept {
    return answered(context, plan, count, [&](const Packet& packet) {
        return answerStructs(packet.probes.jobs, into, count);
    });
}

LodestarStatus jobDraws(LodestarContext* context, LodestarPlan plan, uint32_t job,
                        LodestarDrawProbes* into, size_t* count) noexcept {
    return answered(context, plan, count, [&](const Packet& packet) -> LodestarStatus {
        return job < packet.probes.jobDraws.size()
                   ? answerStructs(packet.probes.jobDraws[job], into, count)
                   : LODESTAR_E_ARG;
    });
}

LodestarStatus drawProbes(LodestarContext* context, LodestarPlan plan, LodestarDrawProbes* into,
                          size_t* count) noexcept {
    return answered(context, plan, count, [&](const Packet& packet) {
        return answerStructs(packet.probes.drawProbes, into, count);
    });
}

LodestarStatus uniforms(LodestarContext* context, LodestarPlan plan, const LodestarDrawProbes* pair,
                        float* into) noexcept {
    return answered(context, plan, into, [&](const Packet& packet) -> LodestarStatus {
        LodestarDrawProbes given{};
        if (!readStruct(pair, given)) {
            return LODESTAR_E_ABI;
        }
        glm::vec4 vectors[LODESTAR_PROBE_UNIFORMS] = {};
        for (std::size_t k = 0; k < 2; ++k) {
            const ProbePacket::Light* light = packet.probes.find(given.probe[k]);
            if (given.probe[k] != 0 && light == nullptr) {
                return LODESTAR_E_ARG;
            }
            glm::vec4* of = vectors + k * LODESTAR_PROBE_VECTORS;
            if (light != nullptr) {
                std::copy(light->vectors.begin(), light->vectors.end(), of);
            }
            if (given.dark[k] != 0) {
                of[11] = glm::vec4(0.0f);
            }
        }
        vectors[LODESTAR_PROBE_UNIFORMS - 1] = {given.factor[0], given.factor[1], given.open, 0.0f};
        std::memcpy(into, vectors, sizeof vectors);
        return LODESTAR_OK;
    });
}

bool isCube(int32_t texels) {
    return texels == LODESTAR_TEXELS_ENVIRONMENT || texels == LODESTAR_TEXELS_IRRADIANCE;
}

LodestarStatus cube(LodestarContext* context, LodestarPlan plan, LodestarProbe handle,
                    int32_t texels, LodestarCube* into) noexcept {
    return answered(context, plan, into, [&](const Packet& packet) -> LodestarStatus {
        const ProbePacket::Light* light = packet.probes.find(handle);
        if (light == nullptr || !isCube(texels)) {
            return LODESTAR_E_ARG;
        }
        LodestarCube answer{};
        if (const auto& made = light->texels[texels == LODESTAR_TEXELS_IRRADIANCE ? 1 : 0]) {
            answer.version = light->version;
            answer.width = static_cast<std::uint32_t>(made->width);
            answer.levels = static_cast<std::uint32_t>(made->levels.size());
            answer.half_floats = made->half ? 1 : 0;
            answer.scale = double{made->scale};
        }
        return writeStruct(answer, into) ? LODESTAR_OK : LODESTAR_E_ABI;
    });
}

LodestarStatus cubeTexels(LodestarContext* context, LodestarPlan plan, LodestarProbe handle,
                          int32_t texels, uint32_t level, void* buffer, size_t* size) noexcept {
    return answered(context, plan, size, [&](const Packet& packet) -> LodestarStatus {
        const ProbePacket::Light* light = packet.probes.find(handle);
        if (light == nullptr || !isCube(texels)) {
            return LODESTAR_E_ARG;
        }
        const auto& made = light->texels[texels == LODESTAR_TEXELS_IRRADIANCE ? 1 : 0];
        if (!made || level >= made->levels.size()) {
            return LODESTAR_E_ARG;
        }
        return answerQuery(made->levels[level].data(), made->levels[level].size(), 1, buffer, size);
    });
}

LodestarStatus probeTexture(LodestarContext* context, LodestarProbe handle, int32_t texels,
                            LodestarGlTexture* into) noexcept {
    return attached(context, [&]() -> LodestarStatus {
        if (handle == 0 || !isCube(texels)) {
            return context->fail(LODESTAR_E_ARG, "no probe, or no such texels");
        }
        return writeStruct(context->gl->probeTexture(handle, texels), into)
                   ? LODESTAR_OK
                   : context->fail(LODESTAR_E_ABI, "the texture's struct_size is none");
    });
}

constexpr LodestarProbesApi kApi = {sizeof(LodestarProbesApi),
                                    0,
                                    create,
                                    destroy,
                                    ofDocument,
                                    all,
                                    node,
                                    source,
                                    move,
                                    hold,
                                    request,
                                    boxes,
                                    face,
                                    jobs,
                                    jobDraws,
                                    drawProbes,
                                    uniforms,
                                    cube,
                                    cubeTexels,
                                    probeTexture};

} // namespace

const void* probesApi() {
    return &kApi;
}

} // namespace lodestar::plugin
