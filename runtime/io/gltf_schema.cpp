// SPDX-License-Identifier: MIT
//
// The shape of the JSON, as tables: what each key must be. Source: glTF 2.0 specification, section
// 5, and KHR_lights_punctual.
#include <cmath>
#include <limits>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

enum class Kind {
    Text,
    Boolean,
    Number,         ///< finite as float, in [low, high]
    Integer,        ///< in [low, high]
    Reference,      ///< an index into the array `refers`
    LooseReference, ///< an int; repaired later where it points nowhere
    Numbers,        ///< an array of `count` numbers, any count where 0
    References,     ///< an array of indices
    Texts,          ///< an array of texts
    Object,         ///< by `fields`
    Objects,        ///< an array of such
    ReferenceMap,   ///< an object of indices
};

constexpr double kFloatMax = std::numeric_limits<float>::max();
constexpr double kIntMax = std::numeric_limits<int>::max();
/// Sizes and offsets; doubles are exact to here, and no file is larger.
constexpr double kSizeMax = 9007199254740992.0;

struct Field {
    const char* key;
    Kind kind;
    bool required = false;
    double low = -kFloatMax;
    double high = kFloatMax;
    std::size_t count = 0;
    const char* refers = nullptr;
    std::span<const Field> fields = {};
};

constexpr Field text(const char* key, bool required = false) {
    return {key, Kind::Text, required};
}
constexpr Field number(const char* key, bool required = false) {
    return {key, Kind::Number, required};
}
constexpr Field integer(const char* key, bool required, double low, double high) {
    return {key, Kind::Integer, required, low, high};
}
constexpr Field numbers(const char* key, std::size_t count) {
    return {key, Kind::Numbers, false, -kFloatMax, kFloatMax, count};
}
constexpr Field reference(const char* key, const char* refers, bool required = false) {
    return {key, Kind::Reference, required, 0, 0, 0, refers};
}
constexpr Field references(const char* key, const char* refers, bool required = false) {
    return {key, Kind::References, required, 0, 0, 0, refers};
}
constexpr Field loose(const char* key, bool required = false) {
    return {key, Kind::LooseReference, required};
}
constexpr Field object(const char* key, std::span<const Field> fields, bool required = false) {
    return {key, Kind::Object, required, 0, 0, 0, nullptr, fields};
}
constexpr Field objects(const char* key, std::span<const Field> fields, bool required = false) {
    return {key, Kind::Objects, required, 0, 0, 0, nullptr, fields};
}

constexpr Field kAsset[] = {text("version", true), text("minVersion"), text("generator"),
                            text("copyright")};
constexpr Field kScene[] = {text("name"), references("nodes", "nodes")};
constexpr Field kNode[] = {text("name"),
                           references("children", "nodes"),
                           reference("mesh", "meshes"),
                           reference("camera", "cameras"),
                           reference("skin", "skins"),
                           numbers("matrix", 16),
                           numbers("translation", 3),
                           numbers("rotation", 4),
                           numbers("scale", 3),
                           numbers("weights", 0)};
constexpr Field kPrimitive[] = {{"attributes", Kind::ReferenceMap, true, 0, 0, 0, "accessors"},
                                reference("indices", "accessors"),
                                reference("material", "materials"),
                                integer("mode", false, 0, 6)};
constexpr Field kMesh[] = {text("name"), objects("primitives", kPrimitive, true),
                           numbers("weights", 0)};
constexpr Field kTextureInfo[] = {loose("index", true), integer("texCoord", false, 0, kIntMax)};
constexpr Field kNormalInfo[] = {loose("index", true), integer("texCoord", false, 0, kIntMax),
                                 number("scale")};
constexpr Field kOcclusionInfo[] = {loose("index", true), integer("texCoord", false, 0, kIntMax),
                                    number("strength")};
constexpr Field kMetallicRoughness[] = {
    numbers("baseColorFactor", 4), number("metallicFactor"), number("roughnessFactor"),
    object("baseColorTexture", kTextureInfo), object("metallicRoughnessTexture", kTextureInfo)};
constexpr Field kMaterial[] = {text("name"),
                               object("pbrMetallicRoughness", kMetallicRoughness),
                               object("normalTexture", kNormalInfo),
                               object("occlusionTexture", kOcclusionInfo),
                               object("emissiveTexture", kTextureInfo),
                               numbers("emissiveFactor", 3),
                               text("alphaMode"),
                               number("alphaCutoff"),
                               {"doubleSided", Kind::Boolean}};
constexpr Field kTexture[] = {text("name"), reference("sampler", "samplers"), loose("source")};
constexpr Field kSampler[] = {
    text("name"), integer("magFilter", false, 0, kIntMax), integer("minFilter", false, 0, kIntMax),
    integer("wrapS", false, 0, kIntMax), integer("wrapT", false, 0, kIntMax)};
constexpr Field kImage[] = {text("name"), text("uri"), text("mimeType"),
                            reference("bufferView", "bufferViews")};
constexpr Field kBuffer[] = {text("name"), text("uri"), integer("byteLength", true, 1, kSizeMax)};
constexpr Field kBufferView[] = {text("name"),
                                 reference("buffer", "buffers", true),
                                 integer("byteOffset", false, 0, kSizeMax),
                                 integer("byteLength", true, 1, kSizeMax),
                                 integer("byteStride", false, 4, 252),
                                 integer("target", false, 0, kIntMax)};
constexpr Field kSparseIndices[] = {reference("bufferView", "bufferViews", true),
                                    integer("byteOffset", false, 0, kIntMax),
                                    integer("componentType", true, 0, kIntMax)};
constexpr Field kSparseValues[] = {reference("bufferView", "bufferViews", true),
                                   integer("byteOffset", false, 0, kIntMax)};
constexpr Field kSparse[] = {integer("count", true, 1, kIntMax),
                             object("indices", kSparseIndices, true),
                             object("values", kSparseValues, true)};
constexpr Field kAccessor[] = {text("name"),
                               reference("bufferView", "bufferViews"),
                               integer("byteOffset", false, 0, kSizeMax),
                               integer("componentType", true, 0, kIntMax),
                               {"normalized", Kind::Boolean},
                               integer("count", true, 1, kIntMax),
                               text("type", true),
                               object("sparse", kSparse)};
constexpr Field kPerspective[] = {number("yfov", true), number("znear", true), number("zfar"),
                                  number("aspectRatio")};
constexpr Field kOrthographic[] = {number("xmag", true), number("ymag", true),
                                   number("znear", true), number("zfar", true)};
constexpr Field kCamera[] = {text("name"), text("type", true), object("perspective", kPerspective),
                             object("orthographic", kOrthographic)};
constexpr Field kSkin[] = {text("name"), references("joints", "nodes", true),
                           reference("inverseBindMatrices", "accessors"),
                           reference("skeleton", "nodes")};
constexpr Field kTarget[] = {reference("node", "nodes"), text("path", true)};
constexpr Field kChannel[] = {integer("sampler", true, 0, kIntMax),
                              object("target", kTarget, true)};
constexpr Field kAnimationSampler[] = {reference("input", "accessors", true),
                                       reference("output", "accessors", true),
                                       text("interpolation")};
constexpr Field kAnimation[] = {text("name"), objects("channels", kChannel, true),
                                objects("samplers", kAnimationSampler, true)};
constexpr Field kDocument[] = {object("asset", kAsset, true),
                               {"extensionsUsed", Kind::Texts},
                               {"extensionsRequired", Kind::Texts},
                               reference("scene", "scenes"),
                               objects("scenes", kScene),
                               objects("nodes", kNode),
                               objects("meshes", kMesh),
                               objects("materials", kMaterial),
                               objects("textures", kTexture),
                               objects("samplers", kSampler),
                               objects("images", kImage),
                               objects("buffers", kBuffer),
                               objects("bufferViews", kBufferView),
                               objects("accessors", kAccessor),
                               objects("cameras", kCamera),
                               objects("skins", kSkin),
                               objects("animations", kAnimation)};

constexpr Field kSpot[] = {number("innerConeAngle"), number("outerConeAngle")};
constexpr Field kLight[] = {text("name"),        text("type", true), numbers("color", 3),
                            number("intensity"), number("range"),    object("spot", kSpot)};
constexpr Field kLights[] = {objects("lights", kLight, true)};
constexpr Field kLightsExtension[] = {object("KHR_lights_punctual", kLights)};
constexpr Field kStrength[] = {number("emissiveStrength")};
constexpr Field kMaterialExtension[] = {object("KHR_materials_emissive_strength", kStrength)};

/// Walks a document beside its tables and goes on behind what is wrong. Recursion is as deep as the
/// tables are: 6.
class Checker {
public:
    Checker(const Json& document, GltfProblems& problems)
        : document_(document), problems_(problems) {}

    void fields(const Json& value, std::span<const Field> table, const std::string& at) {
        if (!value.is_object()) {
            problems_.refuse("must be an object", at);
            return;
        }
        for (const Field& field : table) {
            const Json* found = member(value, field.key);
            if (found != nullptr) {
                one(*found, field, at + "/" + field.key);
            } else if (field.required) {
                problems_.refuse(std::string("'") + field.key + "' is missing",
                                 at.empty() ? "/" : at);
            }
        }
    }

    void reference(const Json& value, const std::string& at, std::size_t size,
                   const std::string& array) {
        if (!value.is_number_integer()) {
            problems_.refuse("must be an index (an integer)", at);
        } else if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= size) {
            // -0 is lexed as a signed number and printed without its sign.
            const bool signedZero = !value.is_number_unsigned() && value.get<double>() == 0.0;
            problems_.refuse("index " + (signedZero ? "-0" : value.dump()) +
                                 " points at nothing: there are " + std::to_string(size) + " " +
                                 array,
                             at);
        }
    }

    /// An object of indices.
    void map(const Json& value, const std::string& array, const std::string& at) {
        if (!value.is_object()) {
            problems_.refuse("must be an object", at);
            return;
        }
        const std::size_t size = memberSize(document_, array.c_str());
        for (const auto& [key, entry] : value.items()) {
            reference(entry, at + "/" + key, size, array);
        }
    }

private:
    void one(const Json& value, const Field& field, const std::string& at) {
        switch (field.kind) {
        case Kind::Text:
            require(value.is_string(), "must be a text", at);
            break;
        case Kind::Boolean:
            require(value.is_boolean(), "must be true or false", at);
            break;
        case Kind::Number:
            number(value, at);
            break;
        case Kind::Integer:
            integer(value, field, at);
            break;
        case Kind::LooseReference:
            integer(value, {"", Kind::Integer, false, -kIntMax, kIntMax}, at);
            break;
        case Kind::Reference:
            reference(value, at, memberSize(document_, field.refers), field.refers);
            break;
        case Kind::Object:
            fields(value, field.fields, at);
            break;
        case Kind::ReferenceMap:
            map(value, field.refers, at);
            break;
        case Kind::Numbers:
        case Kind::References:
        case Kind::Texts:
        case Kind::Objects:
            array(value, field, at);
            break;
        }
    }

    void require(bool good, const char* rule, const std::string& at) {
        if (!good) {
            problems_.refuse(rule, at);
        }
    }

    void number(const Json& value, const std::string& at) {
        if (!value.is_number()) {
            problems_.refuse("must be a number", at);
        } else if (!(std::abs(value.get<double>()) <= kFloatMax)) {
            problems_.refuse("number is too large for single precision", at);
        }
    }

    void integer(const Json& value, const Field& field, const std::string& at) {
        if (!value.is_number_integer()) {
            const bool large = value.is_number() && std::abs(value.get<double>()) > kSizeMax;
            problems_.refuse(
                large ? "is out of range: no integer is that large" : "must be an integer", at);
            return;
        }
        const double v = value.get<double>();
        if (!(v >= field.low && v <= field.high)) {
            problems_.refuse(value.dump() + " is out of range [" +
                                 std::to_string(static_cast<std::int64_t>(field.low)) + ", " +
                                 std::to_string(static_cast<std::int64_t>(field.high)) + "]",
                             at);
        }
    }

    void array(const Json& value, const Field& field, const std::string& at) {
        if (!value.is_array()) {
            problems_.refuse("must be an array", at);
            return;
        }
        if (field.count != 0 && value.size() != field.count) {
            problems_.refuse("must hold " + std::to_string(field.count) + " numbers, not " +
                                 std::to_string(value.size()),
                             at);
        }
        Field element = field;
        element.kind = field.kind == Kind::Numbers      ? Kind::Number
                       : field.kind == Kind::References ? Kind::Reference
                       : field.kind == Kind::Texts      ? Kind::Text
                                                        : Kind::Object;
        for (std::size_t i = 0; i < value.size(); ++i) {
            one(value[i], element, pointer(at, i));
        }
    }

    const Json& document_;
    GltfProblems& problems_;
};

void checkExtensions(const Json& document, Checker& checker) {
    const Json* extensions = member(document, "extensions");
    if (extensions != nullptr) {
        checker.fields(*extensions, kLightsExtension, "/extensions");
    }
    const Json* lights = extensionOf(document, "KHR_lights_punctual");
    const Json* list = lights == nullptr ? nullptr : member(*lights, "lights");
    // Where the list itself was refused, nobody knows what an index points at.
    const std::size_t lightCount = lights == nullptr ? 0
                                   : list == nullptr || !list->is_array()
                                       ? std::numeric_limits<std::size_t>::max()
                                       : list->size();
    for (std::size_t i = 0; i < memberSize(document, "nodes"); ++i) {
        const Json* punctual = extensionOf(document["nodes"][i], "KHR_lights_punctual");
        const Json* light = punctual == nullptr ? nullptr : member(*punctual, "light");
        if (light != nullptr) {
            checker.reference(*light,
                              pointer("/nodes", i) + "/extensions/KHR_lights_punctual/light",
                              lightCount, "lights");
        }
    }
    for (std::size_t i = 0; i < memberSize(document, "materials"); ++i) {
        if (const Json* own = member(document["materials"][i], "extensions")) {
            checker.fields(*own, kMaterialExtension, pointer("/materials", i) + "/extensions");
        }
    }
}

/// Channels name a sampler of their own animation.
void checkChannels(const Json& document, Checker& checker) {
    for (std::size_t i = 0; i < memberSize(document, "animations"); ++i) {
        const Json& animation = document["animations"][i];
        const std::size_t samplers = memberSize(animation, "samplers");
        const std::string at = pointer("/animations", i) + "/channels";
        for (std::size_t c = 0; c < memberSize(animation, "channels"); ++c) {
            const Json* sampler = member(animation["channels"][c], "sampler");
            // Anything else was refused with the table.
            if (sampler != nullptr && sampler->is_number_integer() &&
                sampler->get<double>() >= 0.0 && sampler->get<double>() <= kIntMax) {
                checker.reference(*sampler, pointer(at, c) + "/sampler", samplers, "samplers");
            }
        }
    }
}

/// What morph targets name must exist.
void checkTargets(const Json& document, Checker& checker) {
    for (std::size_t m = 0; m < memberSize(document, "meshes"); ++m) {
        const Json& mesh = document["meshes"][m];
        for (std::size_t p = 0; p < memberSize(mesh, "primitives"); ++p) {
            const Json& primitive = mesh["primitives"][p];
            const std::string at = pointer(pointer("/meshes", m) + "/primitives", p) + "/targets";
            for (std::size_t t = 0; t < memberSize(primitive, "targets"); ++t) {
                checker.map(primitive["targets"][t], "accessors", pointer(at, t));
            }
        }
    }
}

Json known(const Json& value, std::span<const Field> table) {
    Json copy = Json::object();
    for (const Field& field : table) {
        const Json* found = member(value, field.key);
        if (found == nullptr) {
            continue;
        }
        if (field.kind == Kind::Object) {
            copy[field.key] = known(*found, field.fields);
        } else if (field.kind == Kind::Objects) {
            Json array = Json::array();
            for (const Json& element : *found) {
                array.push_back(known(element, field.fields));
            }
            copy[field.key] = std::move(array);
        } else {
            copy[field.key] = *found;
        }
    }
    return copy;
}

} // namespace

bool checkSchema(const Json& document, GltfProblems& problems) {
    if (memberSize(document, "nodes") > kMaxNodes) {
        problems.refuse("there are " + std::to_string(document["nodes"].size()) +
                            " nodes; the limit is " + std::to_string(kMaxNodes),
                        "/nodes");
    }
    // Before anything that points into them: else the pointer's end would be blamed.
    bool arrays = problems.clean("/nodes");
    for (const Field& field : kDocument) {
        const Json* found = member(document, field.key);
        if (field.kind == Kind::Objects && found != nullptr && !found->is_array()) {
            problems.refuse("must be an array", std::string("/") + field.key);
            arrays = false;
        }
    }
    if (!arrays) {
        return false;
    }
    Checker checker(document, problems);
    checker.fields(document, kDocument, "");
    checkExtensions(document, checker);
    checkChannels(document, checker);
    checkTargets(document, checker);
    return true;
}

Json knownKeys(const Json& document) {
    return known(document, kDocument);
}

} // namespace lodestar::io::detail
