// SPDX-License-Identifier: MIT
//
// Commands on the rows of the maps of skies and suns.
#include <utility>

#include "model/perform.h"

namespace lodestar::model {
namespace {

Performed giveRows(State& state, std::vector<double> exponents) {
    std::optional<document::Rsrm>& rsrm = state.document.rsrm;
    if (!exponents.empty()) {
        const lighting::RowsFault fault = lighting::faultOfRows(exponents);
        if (!fault.words.empty()) {
            return core::refused("exponents of rows: " + fault.words);
        }
        rsrm = rsrm.value_or(document::Rsrm());
    }
    if (rsrm) {
        rsrm->exponents = std::move(exponents);
        rsrm = *rsrm == document::Rsrm() ? std::nullopt : std::move(rsrm);
    }
    return std::vector<Id>();
}

} // namespace

Performed performOn(State& state, const SetMapRow& command) {
    std::vector<double> exponents = lighting::rowExponents(document::mapLayout(state.document));
    if (command.row >= exponents.size()) {
        return core::refused("there is no such row");
    }
    exponents[command.row] = command.exponent;
    return giveRows(state, std::move(exponents));
}

Performed performOn(State& state, const SetMapRows& command) {
    return giveRows(state, command.exponents);
}

} // namespace lodestar::model
