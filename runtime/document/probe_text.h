// SPDX-License-Identifier: MIT
//
// Light probes of a document, text to values and back.
#pragma once

#include "document/document.h"
#include "document/reader.h"

namespace lodestar::document {

[[nodiscard]] Probe readProbe(const Reader& reader);
[[nodiscard]] Json toJson(const Probe& probe);

/// Puts members that no version knows behind the known.
void addUnknown(Json& object, const Unknown& unknown);

} // namespace lodestar::document
