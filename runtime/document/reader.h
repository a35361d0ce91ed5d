// SPDX-License-Identifier: MIT
//
// A cursor in a JSON tree that knows where it stands: every refusal names its pointer. The first
// one stays; what is read after it are defaults.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "core/result.h"
#include "core/shared_memory.h"

namespace lodestar::document {

using Json = nlohmann::ordered_json;

/// A tree of JSON values. Its end takes memory itself, and nobody could be told that there is none:
/// it is made and ended in shared memory.
class Tree {
public:
    explicit Tree(Json json) : json_(std::move(json)) {}
    Tree(Tree&&) noexcept = default;
    Tree& operator=(Tree&&) = delete;
    ~Tree() {
        const core::SharedMemory shared;
        json_ = nullptr;
    }
    [[nodiscard]] const Json& json() const { return json_; }

private:
    Json json_;
};

/// The text as a tree. @errors InputRefused: no JSON (line and column), a member twice in an
/// object, too large, too deep
[[nodiscard]] core::Result<Tree> parseTree(std::string_view text);

/// Where a refusal is kept.
using Refusal = std::optional<core::Error>;

class Reader {
public:
    Reader(const Json& value, std::string pointer, Refusal& refusal)
        : value_(value), pointer_(std::move(pointer)), refusal_(refusal) {}

    [[nodiscard]] const Json& json() const { return value_; }
    [[nodiscard]] const std::string& pointer() const { return pointer_; }
    /// Notes what is wrong here, unless something was before.
    void refuse(const std::string& what) const;

    /// Whether this is an object; refused if not.
    [[nodiscard]] bool isObject() const;
    /// A member, if there is one.
    [[nodiscard]] std::optional<Reader> member(const std::string& name) const;
    /// A member that must be there: refused if it is not.
    [[nodiscard]] std::optional<Reader> needed(const char* name) const;
    /// The elements of an array; refused if this is none.
    template <class Visit>
    void forEach(Visit&& visit) const {
        if (!value_.is_array()) {
            refuse("an array is needed");
            return;
        }
        for (std::size_t i = 0; i < value_.size() && !refusal_; ++i) {
            visit(Reader(value_[i], pointer_ + "/" + std::to_string(i), refusal_));
        }
    }
    /// The members that are not in the list, as the text of an object.
    [[nodiscard]] std::string unknown(std::initializer_list<const char*> known) const;

    [[nodiscard]] double number() const;
    /// @param rule what is said of a number outside
    [[nodiscard]] double numberIn(double least, double greatest, const char* rule) const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] std::string text() const;
    [[nodiscard]] glm::dvec3 vector() const; ///< an array of three numbers
    /// The place of a word in a list; refused, naming them, if it is not there.
    [[nodiscard]] std::size_t word(std::initializer_list<const char*> words) const;

private:
    const Json& value_;
    std::string pointer_;
    Refusal& refusal_;
};

} // namespace lodestar::document
