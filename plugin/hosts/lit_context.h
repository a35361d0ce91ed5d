// SPDX-License-Identifier: MIT
//
// A context of the library that a lighting document lights.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <lodestar/lodestar.h>

#include "core/result.h"

namespace lodestar::hosts {

/// Which way is up and which north in a host's scene; a document's own at first.
struct Frame {
    double up[3] = {0.0, 1.0, 0.0};
    double north[3] = {0.0, 0.0, -1.0};
};

/// Move-only; used on the thread that opened it. Ends its context with itself.
class LitContext {
public:
    /// With the document's light probes. Files of its environment and probes are read from the
    /// document's folder or below.
    /// @errors InputRefused naming the file and the JSON pointer, also where it has no light;
    /// Internal if the library and its header do not fit
    [[nodiscard]] static core::Result<LitContext> open(const std::string& file,
                                                       const Frame& frame = {});
    /// The same by a document's text. @param beside a file's path, in whose folder or below its
    /// environment's file is looked for; errors of the text itself name no file
    [[nodiscard]] static core::Result<LitContext>
    read(std::string_view text, const std::string& beside, const Frame& frame = {});

    /// Lights of another text in place of the former ones: what an editor has just changed. The
    /// environment and the probes stay.
    /// @errors InputRefused naming the JSON pointer; all is as it was
    [[nodiscard]] core::Result<void> relight(std::string_view text);

    [[nodiscard]] const LodestarApi& api() const { return api_; }
    [[nodiscard]] LodestarContext* get() const { return context_.get(); }
    [[nodiscard]] LodestarDocument document() const { return document_; }
    /// What the library refused last.
    [[nodiscard]] core::Error refusal() const;

private:
    using Owned = std::unique_ptr<LodestarContext, LodestarStatus (*)(LodestarContext*)>;
    LitContext(const LodestarApi& api, Owned context) : api_(api), context_(std::move(context)) {}
    [[nodiscard]] core::Result<void> takeEnvironment(const std::string& beside);
    [[nodiscard]] core::Result<void> takeProbes(const std::string& beside);
    /// An environment of level 0 of a file's, or of an analytic text's.
    [[nodiscard]] core::Result<LodestarEnvironment>
    loaded(const std::string& text, const std::string& beside, double rotation, double ev);

    LodestarApi api_;
    Owned context_;
    LodestarDocument document_ = 0;
    LodestarEnvironment environment_ = 0;
};

} // namespace lodestar::hosts
