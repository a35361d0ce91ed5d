// SPDX-License-Identifier: MIT
#include "core/result.h"

namespace lodestar::core {

std::string Error::message() const {
    std::string text = file.empty() ? what : file + ": " + what;
    if (!where.empty()) {
        text += " (" + where + ")";
    }
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20) {
            c = ' ';
        }
    }
    return text;
}

} // namespace lodestar::core
