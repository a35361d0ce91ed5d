// SPDX-License-Identifier: MIT
//
// The table's functions: arguments checked, the context entered, the work handed on.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include <glm/geometric.hpp>

#include "context.h"
#include "core/contract.h"
#include "core/shared_memory.h"
#include "gl/shader_source.h"
#include "lighting/rsrm.h"

namespace lodestar::plugin {
namespace {

thread_local char creationError[256] = "";

/// A broken contract inside the library is a status outside.
[[noreturn]] void throwContract(const char* rule, const char* message, const char*, int) {
    throw std::logic_error(std::string(message) + ": " + rule);
}

/// What bakes maps: half a second of work each, the same for all contexts.
const std::shared_ptr<lighting::RsrmKernels>& sharedKernels() {
    static const std::shared_ptr<lighting::RsrmKernels> kernels = [] {
        const core::SharedMemory shared;
        return std::make_shared<lighting::RsrmKernels>();
    }();
    return kernels;
}

LodestarStatus contextCreate(const LodestarHost* host, LodestarContext** context) noexcept {
    creationError[0] = '\0';
    LodestarHost given{};
    const auto refuse = [](LodestarStatus status, const char* what) {
        std::snprintf(creationError, sizeof creationError, "%s", what);
        return status;
    };
    if (context == nullptr) {
        return refuse(LODESTAR_E_ARG, "no place for the context");
    }
    *context = nullptr;
    if (host != nullptr && !readStruct(host, given)) {
        return refuse(LODESTAR_E_ABI, "the host's struct_size is none, or members are unknown");
    }
    if ((given.allocate == nullptr) != (given.release == nullptr)) {
        return refuse(LODESTAR_E_ARG, "allocate and release come both or none");
    }
    const std::optional<glm::dmat3> frame = frameOf(given);
    if (!frame) {
        return refuse(LODESTAR_E_ARG, "up and north are no two directions");
    }
    const Allocator allocator{given.user, given.allocate, given.release};
    const AllocatorScope scope(allocator);
    try {
        auto made = std::make_unique<LodestarContext>();
        made->allocator = allocator;
        made->host = given;
        made->hostFromDocument = *frame;
        made->kernels = sharedKernels();
        *context = made.release();
        return LODESTAR_OK;
    } catch (const std::bad_alloc&) {
        return refuse(LODESTAR_E_NOMEM, "the host's allocator has no memory");
    } catch (...) {
        return refuse(LODESTAR_E_STATE, "an unknown failure");
    }
}

LodestarStatus contextDestroy(LodestarContext* context) noexcept {
    if (context == nullptr) {
        return LODESTAR_OK;
    }
    return entered(context, [&] {
        context->magic = 0;
        delete context;
        return LODESTAR_OK;
    });
}

const char* lastError(LodestarContext* context) noexcept {
    if (context == nullptr) {
        return creationError;
    }
    if (!lives(context)) {
        return "no such context";
    }
    const std::thread::id here = std::this_thread::get_id();
    return here == context->thread     ? context->error
           : here == context->glThread ? context->glError
                                       : "another thread's";
}

/// What light_create and light_update share.
LodestarStatus makeLight(LodestarContext& context, const LodestarLightDesc* desc,
                         std::optional<PlacedLight>& made) {
    LodestarLightDesc given{};
    if (!readStruct(desc, given)) {
        return context.fail(LODESTAR_E_ABI,
                            "the light's struct_size is none, or members are unknown");
    }
    core::Tally warnings;
    auto light = lightOf(given, context.hostFromDocument, warnings);
    if (!light) {
        return context.fail(LODESTAR_E_ARG, light.error());
    }
    made.emplace(PlacedLight{lighting::LightMap(std::move(*light), context.maps, context.kernels)});
    context.log(warnings);
    return LODESTAR_OK;
}

LodestarStatus lightCreate(LodestarContext* context, const LodestarLightDesc* desc,
                           LodestarLight* handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (handle == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no place for the light");
        }
        std::optional<PlacedLight> made;
        if (const LodestarStatus status = makeLight(*context, desc, made); status != LODESTAR_OK) {
            return status;
        }
        context->order.reserve(context->order.size() + 1);
        *handle = context->lights.add(std::move(*made));
        context->order.push_back(*handle);
        return LODESTAR_OK;
    });
}

LodestarStatus noLight(LodestarContext& context) {
    return context.fail(LODESTAR_E_ARG, "no such light");
}

LodestarStatus lightUpdate(LodestarContext* context, LodestarLight handle,
                           const LodestarLightDesc* desc) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        PlacedLight* light = context->lights.find(handle);
        if (light == nullptr) {
            return noLight(*context);
        }
        std::optional<PlacedLight> made;
        if (const LodestarStatus status = makeLight(*context, desc, made); status != LODESTAR_OK) {
            return status;
        }
        made->version = light->version + 1;
        *light = std::move(*made);
        return LODESTAR_OK;
    });
}

LodestarStatus lightDestroy(LodestarContext* context, LodestarLight handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (!context->lights.remove(handle)) {
            return noLight(*context);
        }
        std::erase(context->order, handle);
        return LODESTAR_OK;
    });
}

LodestarStatus lights(LodestarContext* context, LodestarLight* handles, size_t* count) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (count == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no place for the count");
        }
        return answerQuery(context->order.data(), context->order.size(), sizeof(LodestarLight),
                           handles, count);
    });
}

LodestarStatus documentLoad(LodestarContext* context, const char* utf8, size_t size,
                            LodestarDocument* handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (handle == nullptr || (utf8 == nullptr && size > 0)) {
            return context->fail(LODESTAR_E_ARG, "no text, or no place for the document");
        }
        core::Tally warnings;
        auto document = document::parseDocument({utf8, size}, warnings);
        if (!document) {
            return context->fail(LODESTAR_E_DOCUMENT, document.error());
        }
        if (auto lights = document::dayLights(*document, warnings); !lights) {
            return context->fail(LODESTAR_E_DOCUMENT, lights.error());
        }
        *handle = context->documents.add(std::move(*document));
        context->log(warnings);
        return LODESTAR_OK;
    });
}

LodestarStatus documentApply(LodestarContext* context, LodestarDocument handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        const document::Document* document = context->documents.find(handle);
        if (document == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no such document");
        }
        core::Tally counted; // by the loading already
        auto lights = document::dayLights(*document, counted);
        if (!lights) {
            return context->fail(LODESTAR_E_DOCUMENT, lights.error());
        }
        const lighting::RsrmLayout maps = document::mapLayout(*document);
        // Handles of before stay stale: the new lights are added before the old ones go.
        std::vector<LodestarLight> order;
        order.reserve(lights->size());
        try {
            for (lighting::DayLight& light : *lights) {
                order.push_back(context->lights.add(
                    PlacedLight{lighting::LightMap(std::move(light), maps, context->kernels)}));
            }
        } catch (...) {
            for (const LodestarLight added : order) {
                context->lights.remove(added);
            }
            throw;
        }
        for (const LodestarLight old : context->order) {
            context->lights.remove(old);
        }
        context->order = std::move(order);
        context->maps = maps;
        return LODESTAR_OK;
    });
}

LodestarStatus documentDestroy(LodestarContext* context, LodestarDocument handle) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        return context->documents.remove(handle)
                   ? LODESTAR_OK
                   : context->fail(LODESTAR_E_ARG, "no such document");
    });
}

LodestarStatus documentMaterial(LodestarContext* context, LodestarDocument handle, const char* name,
                                LodestarMaterial* material) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        const document::Document* document = context->documents.find(handle);
        if (document == nullptr || name == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no such document, or no name");
        }
        LodestarMaterial given{};
        if (!readStruct(material, given)) {
            return context->fail(LODESTAR_E_ABI,
                                 "the material's struct_size is none, or members are unknown");
        }
        const auto found = document->materials.find(name);
        if (found == document->materials.end()) {
            return LODESTAR_OK;
        }
        core::Tally warnings;
        standOver(found->second, given, warnings);
        context->log(warnings);
        return writeStruct(given, material) ? LODESTAR_OK : LODESTAR_E_ABI;
    });
}

LodestarStatus materialPack(const LodestarMaterial* material, float packed[8]) noexcept {
    LodestarMaterial given{};
    if (!readStruct(material, given)) {
        return LODESTAR_E_ABI;
    }
    return packed != nullptr && packMaterial(given, packed) ? LODESTAR_OK : LODESTAR_E_ARG;
}

LodestarStatus setHour(LodestarContext* context, double hour) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (!std::isfinite(hour)) {
            return context->fail(LODESTAR_E_ARG, "an hour is a finite number");
        }
        context->hour = lighting::wrappedHour(hour);
        return LODESTAR_OK;
    });
}

LodestarStatus lightState(LodestarContext* context, LodestarLight handle,
                          LodestarLightState* state) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        PlacedLight* light = context->lights.find(handle);
        if (light == nullptr) {
            return noLight(*context);
        }
        const lighting::DayMoment moment = look(*context, *light);
        LodestarLightState answer{};
        answer.kind =
            light->map.day().kind == lighting::LightKind::Sky ? LODESTAR_SKY : LODESTAR_SUN;
        for (int i = 0; i < 3; ++i) {
            answer.axis[i] = moment.axis[i];
        }
        answer.visibility = moment.visibility;
        answer.version = light->version;
        return writeStruct(answer, state)
                   ? LODESTAR_OK
                   : context->fail(LODESTAR_E_ABI, "the state's struct_size is none");
    });
}

LodestarStatus lightTexels(LodestarContext* context, LodestarLight handle, int32_t which,
                           void* buffer, size_t* size) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        PlacedLight* light = context->lights.find(handle);
        if (light == nullptr) {
            return noLight(*context);
        }
        if (size == nullptr || which < LODESTAR_TEXELS_MAP || which > LODESTAR_TEXELS_GRADIENT) {
            return context->fail(LODESTAR_E_ARG, "no place for the size, or no such texels");
        }
        if (!(look(*context, *light).visibility > 0.0)) {
            return context->fail(LODESTAR_E_ARG, "a sun below the horizon has no texels");
        }
        const lighting::LightMap::Blend& blend = *texelsOf(*light);
        const std::vector<std::uint8_t> bytes = which == LODESTAR_TEXELS_MAP ? blend.texels.bytes
                                                : which == LODESTAR_TEXELS_LAMBERT
                                                    ? lighting::LightMap::lambertTexels(blend)
                                                    : lighting::LightMap::gradientTexels(blend);
        return answerQuery(bytes.data(), bytes.size(), 1, buffer, size);
    });
}

LodestarMapLayout described(const lighting::RsrmLayout& own) {
    LodestarMapLayout answer{};
    answer.columns = static_cast<std::uint32_t>(own.columns);
    answer.rows = static_cast<std::uint32_t>(own.rows);
    answer.lambert_columns = static_cast<std::uint32_t>(lighting::kLambertColumns);
    answer.gradient_columns = static_cast<std::uint32_t>(lighting::kGradientColumns);
    answer.least_exponent = static_cast<float>(own.leastExponent);
    answer.greatest_exponent = static_cast<float>(own.greatestExponent);
    answer.first_octave = static_cast<float>(lighting::firstOctave(own));
    answer.rows_per_octave = static_cast<float>(lighting::rowsPerOctave(own));
    answer.own_rows = lighting::hasOwnRows(own) ? 1 : 0;
    const auto octaves = lighting::rowOctaves(own);
    static_assert(sizeof answer.octaves == sizeof octaves);
    std::copy(octaves.begin(), octaves.end(), answer.octaves);
    return answer;
}

LodestarStatus mapLayout(LodestarMapLayout* layout) noexcept {
    return writeStruct(described(lighting::kRsrm), layout) ? LODESTAR_OK : LODESTAR_E_ABI;
}

LodestarStatus contextMapLayout(LodestarContext* context, LodestarMapLayout* layout) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        return writeStruct(described(context->maps), layout)
                   ? LODESTAR_OK
                   : context->fail(LODESTAR_E_ABI, "the layout's struct_size is none");
    });
}

/// The first line of a dialect; empty: there is no such one.
std::string versionLine(const LodestarDialect& dialect) {
    const std::uint32_t v = dialect.version;
    if (dialect.profile == LODESTAR_PROFILE_ES) {
        return v == 300 ? "#version 300 es\nprecision highp float;\nprecision highp int;\n"
                          "precision highp sampler2DArray;\nprecision highp samplerCube;\n"
                        : "";
    }
    if (v != 330 && v != 410 && v != 450) {
        return {};
    }
    const bool core = dialect.profile == LODESTAR_PROFILE_CORE;
    return core || dialect.profile == LODESTAR_PROFILE_COMPATIBILITY
               ? "#version " + std::to_string(v) + (core ? " core\n" : " compatibility\n")
               : "";
}

LodestarStatus glslText(const char* file, const LodestarDialect* dialect, char* buffer,
                        size_t* size) noexcept {
    LodestarDialect given{};
    if (file == nullptr || size == nullptr) {
        return LODESTAR_E_ARG;
    }
    if (!readStruct(dialect, given)) {
        return LODESTAR_E_ABI;
    }
    try {
        const std::string first = versionLine(given);
        const std::string name(file);
        const gl::Defines block{{"LODESTAR_UNIFORM_BLOCK", "1"}};
        auto text = gl::assembleShader(name, 330, given.uniform_block != 0 ? block : gl::Defines{});
        const bool known = name.starts_with("lodestar/") || name.starts_with("plugin/");
        if (first.empty() || !known || !text) {
            return LODESTAR_E_UNSUPPORTED;
        }
        const std::string whole = (given.without_version_line != 0 ? std::string() : first) +
                                  text->substr(text->find('\n') + 1);
        return answerQuery(whole.c_str(), whole.size() + 1, 1, buffer, size);
    } catch (const std::bad_alloc&) {
        return LODESTAR_E_NOMEM;
    } catch (...) {
        return LODESTAR_E_STATE;
    }
}

const void* getExtension(const char* id) noexcept {
    if (id == nullptr) {
        return nullptr;
    }
    return std::strcmp(id, LODESTAR_EXTENSION_GL) == 0       ? glApi()
           : std::strcmp(id, LODESTAR_EXTENSION_PROBES) == 0 ? probesApi()
                                                             : nullptr;
}

LodestarApi table() {
    LodestarApi api{};
    api.struct_size = sizeof api;
    api.abi_version = LODESTAR_ABI_VERSION;
    api.context_create = contextCreate;
    api.context_destroy = contextDestroy;
    api.last_error = lastError;
    api.light_create = lightCreate;
    api.light_update = lightUpdate;
    api.light_destroy = lightDestroy;
    api.lights = lights;
    api.document_load = documentLoad;
    api.document_apply = documentApply;
    api.document_destroy = documentDestroy;
    api.document_material = documentMaterial;
    api.material_pack = materialPack;
    api.set_hour = setHour;
    api.light_state = lightState;
    api.light_texels = lightTexels;
    api.map_layout = mapLayout;
    api.context_map_layout = contextMapLayout;
    api.glsl_text = glslText;
    api.get_extension = getExtension;
    addLookupApi(api);
    addEnvironmentApi(api);
    addPlanApi(api);
    return api;
}

} // namespace
} // namespace lodestar::plugin

LodestarStatus lodestar_get_api(uint32_t host_abi, LodestarApi* api) {
    using namespace lodestar;
    if (api == nullptr) {
        return LODESTAR_E_ARG;
    }
    if (host_abi >> 16 != LODESTAR_ABI_MAJOR || api->struct_size < 2 * sizeof(uint32_t)) {
        return LODESTAR_E_ABI;
    }
    core::setContractHandler(plugin::throwContract);
    plugin::keepSharedMemoryApart();
    const LodestarApi whole = plugin::table();
    const uint32_t size = std::min<uint32_t>(api->struct_size, sizeof whole);
    std::memcpy(api, &whole, size);
    api->struct_size = size;
    return LODESTAR_OK;
}
