// SPDX-License-Identifier: MIT
//
// What a context holds, and how each function of the table is entered and left.
#pragma once

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>

#include "core/result.h"
#include "core/tally.h"
#include "document/document.h"
#include "environments.h"
#include "gl_textures.h"
#include "lighting/light_map.h"
#include "lodestar/lodestar.h"
#include "memory.h"
#include "plans.h"

namespace lodestar::plugin {

/// Things behind handles (generation << 32 | index + 1): a handle of one that is gone finds
/// nothing.
template <class T>
class Slots {
public:
    [[nodiscard]] T* find(std::uint64_t handle) {
        const std::uint64_t index = (handle & 0xffffffffu) - 1;
        if (index >= slots_.size() || slots_[index].generation != handle >> 32) {
            return nullptr;
        }
        return slots_[index].value ? &*slots_[index].value : nullptr;
    }
    std::uint64_t add(T value) {
        std::size_t index = 0;
        while (index < slots_.size() && slots_[index].value) {
            ++index;
        }
        if (index == slots_.size()) {
            slots_.emplace_back();
        }
        slots_[index].value.emplace(std::move(value));
        return std::uint64_t{slots_[index].generation} << 32 | (index + 1);
    }
    bool remove(std::uint64_t handle) {
        if (find(handle) == nullptr) {
            return false;
        }
        Slot& slot = slots_[(handle & 0xffffffffu) - 1];
        slot.value.reset();
        ++slot.generation;
        return true;
    }

    /// Calls `with` a handle and its thing, for each.
    template <class With>
    void each(With&& with) const {
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            if (slots_[i].value) {
                with(std::uint64_t{slots_[i].generation} << 32 | (i + 1), *slots_[i].value);
            }
        }
    }

private:
    struct Slot {
        std::uint32_t generation = 1;
        std::optional<T> value;
    };
    std::vector<Slot> slots_;
};

/// A light and what of it was last asked for.
struct PlacedLight {
    lighting::LightMap map;
    lighting::LightMap::Content content{};  ///< at the hour last looked at
    std::uint64_t version = 1;              ///< of that content
    std::uint64_t planned = 0;              ///< the version that a plan last asked for
    std::optional<std::uint64_t> blended{}; ///< the version that the blend is of
    std::shared_ptr<const lighting::LightMap::Blend> blend{};
    std::vector<glm::dvec3>
        facing{}; ///< by key, irradiance over pi of what faces it; when asked for
};

/// A failed call: what is returned, and why in words.
struct Failure {
    LodestarStatus status;
    const char* what;
};

} // namespace lodestar::plugin

struct LodestarContext {
    static constexpr std::uint32_t kMagic = 0x10de57a2;

    std::uint32_t magic = kMagic;
    lodestar::plugin::Allocator allocator;
    LodestarHost host{};
    glm::dmat3 hostFromDocument{1.0}; ///< a rotation
    std::thread::id thread = std::this_thread::get_id();
    char error[512] = "";

    std::shared_ptr<lodestar::lighting::RsrmKernels> kernels;
    lodestar::plugin::Slots<lodestar::plugin::PlacedLight> lights;
    std::vector<LodestarLight> order;                                ///< as made
    lodestar::lighting::RsrmLayout maps = lodestar::lighting::kRsrm; ///< of all lights
    lodestar::plugin::Slots<lodestar::document::Document> documents;
    lodestar::plugin::Slots<lodestar::plugin::PlacedEnvironment> environments;
    LodestarEnvironment environment = 0; ///< the distant one
    lodestar::plugin::Slots<lodestar::plugin::PlacedProbe> probes;
    std::vector<LodestarProbe> probeOrder;             ///< as made
    std::optional<lodestar::plugin::BoxedFrame> boxes; ///< of the next plan
    /// Of the last plan with probes, by id.
    std::optional<std::vector<lodestar::plugin::SeenBox>> seen;
    double hour = 15.0;
    lodestar::plugin::PlannedEnvironment planned;
    lodestar::plugin::PlanRing plans;

    /// The [gl] thread's: textures while attached, and what it was told last.
    std::atomic<std::thread::id> glThread{};
    std::unique_ptr<lodestar::plugin::GlTextures> gl;
    char glError[512] = "";

    void log(std::int32_t number, const char* text) const {
        if (host.log != nullptr) {
            host.log(host.user, number, text);
        }
    }
    void log(const lodestar::core::Tally& warnings) const;
    /// Notes what is wrong, for the thread that it is said to, and returns the status.
    LodestarStatus fail(LodestarStatus status, const char* what);
    LodestarStatus fail(LodestarStatus status, const lodestar::core::Error& error);
};

namespace lodestar::plugin {

/// Runs a function's body with the host's memory; no exception leaves.
template <class Body>
LodestarStatus guarded(LodestarContext& context, Body&& body) noexcept {
    const AllocatorScope scope(context.allocator);
    try {
        return body();
    } catch (const std::bad_alloc&) {
        return context.fail(LODESTAR_E_NOMEM, "the host's allocator has no memory");
    } catch (const std::exception& error) {
        return context.fail(LODESTAR_E_STATE, error.what());
    } catch (...) {
        return context.fail(LODESTAR_E_STATE, "an unknown failure");
    }
}

/// Whether it is a context that lives.
[[nodiscard]] inline bool lives(const LodestarContext* context) {
    return context != nullptr && context->magic == LodestarContext::kMagic;
}

/// Runs a [main] function's body, on the right thread. The text of another thread's last error is
/// left alone.
template <class Body>
LodestarStatus entered(LodestarContext* context, Body&& body) noexcept {
    if (!lives(context)) {
        return LODESTAR_E_ARG;
    }
    return context->thread == std::this_thread::get_id()
               ? guarded(*context, std::forward<Body>(body))
               : LODESTAR_E_THREAD;
}

/// Reads a host's struct, whose size may be another version's. @return false if it is null, too
/// small to say its size, or has members set that this version does not know
template <class T>
[[nodiscard]] bool readStruct(const T* from, T& into) {
    into = T{};
    if (from == nullptr || from->struct_size < 2 * sizeof(std::uint32_t)) {
        return false;
    }
    const auto* bytes = reinterpret_cast<const unsigned char*>(from);
    for (std::size_t i = sizeof(T); i < from->struct_size; ++i) {
        if (bytes[i] != 0) {
            return false;
        }
    }
    std::memcpy(&into, from, std::min<std::size_t>(from->struct_size, sizeof(T)));
    return true;
}

/// Writes as much of a struct as the host's holds.
template <class T>
[[nodiscard]] bool writeStruct(T from, T* into) {
    if (into == nullptr || into->struct_size < 2 * sizeof(std::uint32_t)) {
        return false;
    }
    const std::uint32_t size = std::min<std::uint32_t>(into->struct_size, sizeof(T));
    from.struct_size = size;
    std::memcpy(into, &from, size);
    return true;
}

/// Answers a two-call query. @param count of what is there, in the query's unit of `each` bytes
[[nodiscard]] inline LodestarStatus answerQuery(const void* from, std::size_t count,
                                                std::size_t each, void* buffer, std::size_t* size) {
    const std::size_t room = *size;
    *size = count;
    if (buffer == nullptr || room < count) {
        return LODESTAR_MORE;
    }
    if (count > 0) {
        std::memcpy(buffer, from, count * each);
    }
    return LODESTAR_OK;
}

/// The rotation that brings a document's up and north to a host's. @return nothing where those are
/// none
[[nodiscard]] std::optional<glm::dmat3> frameOf(const LodestarHost& host);

/// A light from a host's description, in a document's frame.
/// @errors InputRefused as lighting::repaired
[[nodiscard]] core::Result<lighting::DayLight>
lightOf(const LodestarLightDesc& desc, const glm::dmat3& hostFromDocument, core::Tally& warnings);

/// Two vec4: diffuse, exponent; f0, 1. @return false if a value is out of range
[[nodiscard]] bool packMaterial(const LodestarMaterial& material, float packed[8]);
/// What a document says of a material replaces what the host's says.
void standOver(const document::Material& from, LodestarMaterial& material, core::Tally& warnings);

/// A light at the context's hour, its axis in the host's frame; its version follows its content.
[[nodiscard]] lighting::DayMoment look(const LodestarContext& context, PlacedLight& light);
/// Its texels, made when they are first asked for. @pre looked at
[[nodiscard]] const std::shared_ptr<const lighting::LightMap::Blend>& texelsOf(PlacedLight& light);

/// Members of the table that have files of their own.
void addEnvironmentApi(LodestarApi& api);
void addLookupApi(LodestarApi& api);
void addPlanApi(LodestarApi& api);
/// LodestarProbesApi.
[[nodiscard]] const void* probesApi();

} // namespace lodestar::plugin
