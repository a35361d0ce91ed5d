// SPDX-License-Identifier: MIT
//
// Rules on the numbers in accessors. Source: glTF 2.0 specification, sections 3.6.2 and 3.7.2.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "io/gltf_rules.h"

namespace lodestar::io::detail {
namespace {

double rawComponent(const unsigned char* from, int type) {
    const auto load = [&](auto value) {
        std::memcpy(&value, from, sizeof value);
        return static_cast<double>(value);
    };
    switch (type) {
    case 5120:
        return load(std::int8_t{});
    case 5121:
        return load(std::uint8_t{});
    case 5122:
        return load(std::int16_t{});
    case 5123:
        return load(std::uint16_t{});
    case 5125:
        return load(std::uint32_t{});
    default:
        return load(float{});
    }
}

/// An accessor's components as stored, row by row.
class AccessorData {
public:
    AccessorData(const Json& document, const std::vector<Bytes>& buffers)
        : document_(document), buffers_(buffers) {}

    /// False where the limit is reached. @pre the accessor's ranges were checked
    bool read(const Json& accessor, const std::string& at, GltfProblems& problems) {
        type_ = accessor["componentType"].get<int>();
        const std::string type = accessor["type"].get<std::string>();
        static_cast<void>(elementLayout(type_, type, layout_));
        const auto count = accessor["count"].get<std::size_t>();
        if (!budget_.spend(count * layout_.components * sizeof(double))) {
            return false;
        }
        values_.assign(count * layout_.components, 0.0);
        if (accessor.contains("bufferView")) {
            const Json& view = document_["bufferViews"][accessor["bufferView"].get<std::size_t>()];
            const std::size_t stride = view.value("byteStride", layout_.bytes);
            const unsigned char* from = start(accessor);
            for (std::size_t i = 0; i < count; ++i) {
                take(i, from + i * stride);
            }
        }
        if (accessor.contains("sparse")) {
            readSparse(accessor["sparse"], count, at, problems);
        }
        return true;
    }

    [[nodiscard]] const std::vector<double>& values() const { return values_; }
    [[nodiscard]] std::size_t components() const { return layout_.components; }
    [[nodiscard]] bool isFloat() const { return type_ == 5126; }

private:
    [[nodiscard]] const unsigned char* start(const Json& part) const {
        const Json& view = document_["bufferViews"][part["bufferView"].get<std::size_t>()];
        const Bytes& buffer = buffers_[view["buffer"].get<std::size_t>()];
        return buffer.data() + view.value("byteOffset", std::size_t{0}) +
               part.value("byteOffset", std::size_t{0});
    }

    /// Columns of small matrices begin at multiples of 4 bytes.
    void take(std::size_t element, const unsigned char* from) {
        const bool padded = layout_.bytes != layout_.components * layout_.componentBytes;
        const std::size_t rows = padded ? (layout_.components == 4 ? 2U : 3U) : layout_.components;
        const std::size_t columnBytes =
            padded ? (rows * layout_.componentBytes + 3) / 4 * 4 : layout_.bytes;
        for (std::size_t c = 0; c < layout_.components; ++c) {
            values_[element * layout_.components + c] = rawComponent(
                from + c / rows * columnBytes + c % rows * layout_.componentBytes, type_);
        }
    }

    void readSparse(const Json& sparse, std::size_t count, const std::string& at,
                    GltfProblems& problems) {
        const int indexType = sparse["indices"]["componentType"].get<int>();
        ElementLayout index;
        static_cast<void>(elementLayout(indexType, "SCALAR", index));
        const unsigned char* indices = start(sparse["indices"]);
        const unsigned char* values = start(sparse["values"]);
        double before = -1.0;
        bool increasing = true;
        for (std::size_t i = 0; i < sparse["count"].get<std::size_t>(); ++i) {
            const double element = rawComponent(indices + i * index.bytes, indexType);
            increasing = increasing && element > before;
            before = element;
            if (element >= static_cast<double>(count)) {
                // Loading refuses it where it is used.
                problems.repaired("sparse index " +
                                      std::to_string(static_cast<std::uint32_t>(element)) +
                                      " is not below the " + std::to_string(count) + " elements",
                                  at + "/sparse/indices");
                return;
            }
            take(static_cast<std::size_t>(element), values + i * layout_.bytes);
        }
        if (!increasing) {
            problems.repaired("sparse indices do not increase", at + "/sparse/indices");
        }
    }

    const Json& document_;
    const std::vector<Bytes>& buffers_;
    Budget budget_{2 * kMaxGeometryBytes};
    ElementLayout layout_;
    int type_ = 0;
    std::vector<double> values_;
};

void checkFinite(const AccessorData& data, const std::string& at, GltfProblems& problems) {
    std::size_t bad = 0;
    for (const double value : data.values()) {
        bad += std::isfinite(value) ? 0U : 1U;
    }
    if (bad > 0) {
        problems.repaired(std::to_string(bad) + " numbers are not finite", at);
    }
}

/// A declared bound must be the very number: the smallest or largest of its component.
void checkBound(const AccessorData& data, const Json& accessor, const char* key,
                const std::string& at, GltfProblems& problems) {
    const Json* bound = member(accessor, key);
    if (bound == nullptr) {
        return;
    }
    const std::string here = at + "/" + key;
    if (!bound->is_array() || bound->size() != data.components()) {
        problems.repaired("must hold " + std::to_string(data.components()) + " numbers", here);
        return;
    }
    const bool least = std::string_view(key) == "min";
    for (std::size_t c = 0; c < data.components(); ++c) {
        if (!(*bound)[c].is_number()) {
            problems.repaired("must be a number", pointer(here, c));
            continue;
        }
        const auto given = (*bound)[c].get<double>();
        const double declared =
            data.isFloat() ? static_cast<double>(static_cast<float>(given)) : given;
        double found = data.values()[c];
        for (std::size_t i = c; i < data.values().size(); i += data.components()) {
            const double value = data.values()[i];
            found = least ? std::min(found, value) : std::max(found, value);
        }
        if (std::isfinite(found) && found != declared) {
            problems.repaired("is " + (*bound)[c].dump() + ", but the data say " +
                                  Json(found).dump(),
                              pointer(here, c));
        }
    }
}

/// What attributes ask of an accessor's numbers.
struct Asked {
    bool unit3 = false;   ///< normals, tangents
    bool sign = false;    ///< tangents
    bool clamped = false; ///< colours
};

void checkAsked(const AccessorData& data, const Asked& asked, const std::string& at,
                GltfProblems& problems) {
    const std::size_t n = data.components();
    std::size_t notUnit = 0;
    std::size_t notSign = 0;
    std::size_t notClamped = 0;
    for (std::size_t i = 0; data.isFloat() && i + n <= data.values().size(); i += n) {
        const double* v = data.values().data() + i;
        if (asked.unit3 && n >= 3) {
            const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
            notUnit += std::abs(length - 1.0) > kUnitTolerance3 ? 1U : 0U;
        }
        if (asked.sign && n == 4) {
            notSign += std::abs(v[3]) == 1.0 ? 0U : 1U;
        }
        for (std::size_t c = 0; asked.clamped && c < n; ++c) {
            notClamped += v[c] >= 0.0 && v[c] <= 1.0 ? 0U : 1U;
        }
    }
    if (notUnit > 0) {
        problems.repaired(std::to_string(notUnit) + " vectors are not of unit length", at);
    }
    if (notSign > 0) {
        problems.repaired(std::to_string(notSign) + " tangents have a w that is not 1 or -1", at);
    }
    if (notClamped > 0) {
        problems.repaired(std::to_string(notClamped) + " colour components lie outside [0, 1]", at);
    }
}

std::vector<Asked> askedOf(const Json& document, const GltfProblems& problems) {
    std::vector<Asked> asked(memberSize(document, "accessors"));
    eachClean(document, "meshes", problems, [&](const Json& mesh, const std::string&) {
        for (const Json& primitive : mesh["primitives"]) {
            for (const auto& [name, index] : primitive["attributes"].items()) {
                Asked& one = asked[index.get<std::size_t>()];
                one.unit3 = one.unit3 || name == "NORMAL" || name == "TANGENT";
                one.sign = one.sign || name == "TANGENT";
                one.clamped = one.clamped || name.starts_with("COLOR_");
            }
        }
    });
    return asked;
}

} // namespace

void checkDataRules(const Json& document, const std::vector<Bytes>& buffers,
                    GltfProblems& problems) {
    const std::vector<Asked> asked = askedOf(document, problems);
    AccessorData data(document, buffers);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        const std::string at = pointer("/accessors", i);
        if (!problems.clean(at)) {
            continue;
        }
        const Json& accessor = document["accessors"][i];
        if (!data.read(accessor, at, problems)) {
            problems.repaired("the data of this accessor and of those behind it are not looked "
                              "at: there are too many",
                              at);
            return;
        }
        checkFinite(data, at, problems);
        // Without data, an extension's stand here, which are not zeros.
        if (accessor.contains("bufferView") || accessor.contains("sparse")) {
            checkBound(data, accessor, "min", at, problems);
            checkBound(data, accessor, "max", at, problems);
            checkAsked(data, asked[i], at, problems);
        }
    }
}

} // namespace lodestar::io::detail
