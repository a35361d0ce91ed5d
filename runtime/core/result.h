// SPDX-License-Identifier: MIT
//
// Errors of the world outside (files, drivers, disk) as values. A caller's own mistake is a
// contract (core/contract.h), never a Result.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/contract.h"

namespace lodestar::core {

/// What kind of failure it was; the command line's exit statuses are these numbers.
enum class ErrorCode {
    Internal = 1,     ///< a bug of ours
    Usage = 2,        ///< the call's words are wrong
    InputRefused = 3, ///< a file or value that is not to be had or not valid
    NoOpenGl = 4,     ///< no usable OpenGL
    OutputFailed = 5, ///< an output could not be written
};

/// One failure, in a sentence that can be printed as it is.
struct Error {
    ErrorCode code = ErrorCode::Internal;
    std::string what;  ///< what is wrong and which rule it breaks, no file name, no full stop
    std::string file;  ///< the file as the user named it; empty if there is none
    std::string where; ///< the place in it: a JSON pointer, a byte, a scan line; empty if none

    /// "FILE: what is wrong (where)", without a line break.
    [[nodiscard]] std::string message() const;
};

[[nodiscard]] inline Error refused(std::string what, std::string where = {}) {
    return {ErrorCode::InputRefused, std::move(what), {}, std::move(where)};
}

/// A value or an Error. Reading the value of a failure is a contract violation.
template <class T>
class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::move(value)) {}
    Result(Error error) : state_(std::move(error)) {}

    [[nodiscard]] bool ok() const { return std::holds_alternative<T>(state_); }
    explicit operator bool() const { return ok(); }

    [[nodiscard]] T& value() & {
        LODESTAR_EXPECT(ok(), "the Result holds an error");
        return std::get<T>(state_);
    }
    [[nodiscard]] const T& value() const& {
        LODESTAR_EXPECT(ok(), "the Result holds an error");
        return std::get<T>(state_);
    }
    [[nodiscard]] T&& value() && {
        LODESTAR_EXPECT(ok(), "the Result holds an error");
        return std::get<T>(std::move(state_));
    }
    [[nodiscard]] const Error& error() const {
        LODESTAR_EXPECT(!ok(), "the Result holds a value");
        return std::get<Error>(state_);
    }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }

private:
    std::variant<T, Error> state_;
};

/// Success or an Error.
template <>
class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Error error) : error_(std::move(error)) {}

    [[nodiscard]] bool ok() const { return !error_.has_value(); }
    explicit operator bool() const { return ok(); }
    [[nodiscard]] const Error& error() const {
        LODESTAR_EXPECT(!ok(), "the Result holds no error");
        return *error_;
    }

private:
    std::optional<Error> error_;
};

/// The same error, with the file filled in where it named none.
[[nodiscard]] inline Error inFile(Error error, const std::string& file) {
    if (error.file.empty()) {
        error.file = file;
    }
    return error;
}

} // namespace lodestar::core
