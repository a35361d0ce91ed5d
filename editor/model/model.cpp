// SPDX-License-Identifier: MIT
#include "model/model.h"

#include <utility>
#include <variant>

#include "model/rules.h"

namespace lodestar::model {

Model::Model(document::Document document) : state_(named(std::move(document))) {}

void Model::reset(document::Document document) {
    const std::uint64_t now = revisions_.document + 1;
    state_ = named(std::move(document), state_.ids.next);
    steps_.clear();
    done_ = 0;
    openToken_ = 0;
    stamp_ = savedStamp_ = ++lastStamp_;
    revisions_ = {now, now, now, now, now};
    firstRevision_ = now;
    partRevisions_.clear();
    selection_ = {};
}

const document::Light* Model::light(Id id) const {
    const auto place = findLight(state_.ids, id);
    return place ? &state_.document.lights[*place] : nullptr;
}

const document::Key* Model::key(Id id) const {
    const auto place = findKey(state_.ids, id);
    return place ? &state_.document.lights[place->light].keys[place->key] : nullptr;
}

const document::Stop* Model::stop(Id id) const {
    const auto place = findStop(state_.ids, id);
    return place
               ? &state_.document.lights[place->light].keys[place->key].gradient.stops[place->stop]
               : nullptr;
}

const document::Probe* Model::probe(Id id) const {
    const auto place = findProbe(state_.ids, id);
    return place ? &state_.document.probes[*place] : nullptr;
}

Id Model::lightOf(Id key) const {
    const auto place = findKey(state_.ids, key);
    return place ? state_.ids.lights[place->light].id : Id::None;
}

Id Model::keyOf(Id stop) const {
    const auto place = findStop(state_.ids, stop);
    return place ? state_.ids.lights[place->light].keys[place->key].id : Id::None;
}

core::Result<Outcome> Model::execute(const Command& command, MergeToken token) {
    const bool joins = token != 0 && token == openToken_;
    Part* const last = joins ? &steps_[done_ - 1].parts.back() : nullptr;
    const bool replaces = last != nullptr && last->command.index() == command.index();
    State base = state_;
    if (replaces) {
        model::apply(last->change, Direction::Back, base);
    }
    State next = base;
    auto created = perform(command, next);
    if (!created) {
        return created.error();
    }
    // What was too bright when it was read stays as it was written, and may be edited.
    if (!std::holds_alternative<ReplaceDocument>(command) && tooBright(next.document) &&
        !tooBright(base.document)) {
        return core::refused("a radiance times its key's tint lies from 0 to 1e9");
    }
    if (replaces && next.document == state_.document && next.ids == state_.ids) {
        return Outcome{}; // a drag held still
    }
    Change change = difference(base, next);
    if (replaces) {
        apply(last->change, Direction::Back);
    }
    const bool changed = !change.empty();
    if (changed) {
        apply(change, Direction::Forth);
        if (replaces) {
            steps_[done_ - 1].parts.pop_back();
        }
        keep(command, std::move(change), joins);
        openToken_ = token;
    } else if (replaces) {
        dropLastPart();
    }
    selection_ = valid(std::move(selection_), state_.ids);
    if (changed) {
        selectCreated(*created);
    }
    return Outcome{changed, changed ? std::move(*created) : std::vector<Id>()};
}

void Model::keep(const Command& command, Change change, bool joins) {
    steps_.resize(done_); // what was undone is gone
    if (!joins) {
        steps_.push_back({nameOf(command), {}, stamp_, 0});
        ++done_;
        ++strokes_;
    }
    stamp_ = ++lastStamp_;
    steps_[done_ - 1].after = stamp_;
    steps_[done_ - 1].parts.push_back({command, std::move(change)});
}

void Model::dropLastPart() {
    Step& step = steps_[done_ - 1];
    step.parts.pop_back();
    if (step.parts.empty()) {
        // A drag that is back where it began is no step, and the one below is not its own.
        stamp_ = step.before;
        steps_.pop_back();
        --done_;
        openToken_ = 0;
    } else {
        stamp_ = step.after = ++lastStamp_;
    }
}

bool Model::cancel(MergeToken token) {
    if (token == 0 || token != openToken_) {
        return false;
    }
    const bool done = undo();
    steps_.resize(done_);
    return done;
}

bool Model::undo() {
    openToken_ = 0;
    if (done_ == 0) {
        return false;
    }
    const Step& step = steps_[--done_];
    ++strokes_;
    for (auto part = step.parts.rbegin(); part != step.parts.rend(); ++part) {
        apply(part->change, Direction::Back);
    }
    stamp_ = step.before;
    selection_ = valid(std::move(selection_), state_.ids);
    return true;
}

bool Model::redo() {
    openToken_ = 0;
    if (done_ == steps_.size()) {
        return false;
    }
    const Step& step = steps_[done_++];
    ++strokes_;
    for (const Part& part : step.parts) {
        apply(part.change, Direction::Forth);
    }
    stamp_ = step.after;
    selection_ = valid(std::move(selection_), state_.ids);
    return true;
}

std::string_view Model::undoName() const {
    return done_ == 0 ? std::string_view() : steps_[done_ - 1].name;
}

std::string_view Model::redoName() const {
    return done_ == steps_.size() ? std::string_view() : steps_[done_].name;
}

void Model::visitDone(const Visit& visit) const {
    State state = state_;
    for (std::size_t i = done_; i-- > 0;) {
        const std::vector<Part>& parts = steps_[i].parts;
        for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
            model::apply(part->change, Direction::Back, state);
        }
    }
    for (std::size_t i = 0; i < done_; ++i) {
        for (const Part& part : steps_[i].parts) {
            const Identities found = state.ids;
            model::apply(part.change, Direction::Forth, state);
            visit(steps_[i].name, part.command, found, state.document);
        }
    }
}

std::size_t Model::historyBytes() const {
    std::size_t sum = steps_.capacity() * sizeof(Step);
    for (const Step& step : steps_) {
        for (const Part& part : step.parts) {
            // A stroke has its path; another command brings one side of what it changes.
            const auto* const stroke = std::get_if<BrushStroke>(&part.command);
            const std::size_t changed = part.change.bytes();
            sum += sizeof(Part) + changed +
                   (stroke != nullptr ? stroke->path.capacity() * sizeof(double) : changed / 2);
        }
    }
    return sum;
}

void Model::markSaved() {
    savedStamp_ = stamp_;
    openToken_ = 0;
}

std::uint64_t Model::revisionOf(Id id) const {
    const auto found = partRevisions_.find(id);
    return found == partRevisions_.end() ? firstRevision_ : found->second;
}

void Model::select(Selection selection) {
    selection_ = valid(std::move(selection), state_.ids);
}

void Model::apply(const Change& change, Direction direction) {
    model::apply(change, direction, state_);
    note(change);
}

void Model::note(const Change& change) {
    const std::uint64_t now = ++revisions_.document;
    const auto noteKey = [&](const KeyIds& key) { partRevisions_[key.id] = now; };
    const auto noteLight = [&](const LightIds& light) {
        partRevisions_[light.id] = now;
        for (const KeyIds& key : light.keys) {
            noteKey(key);
        }
    };
    const auto both = [](const auto& splice, auto&& visit) {
        for (const auto& names : splice.namesBefore) {
            visit(names);
        }
        for (const auto& names : splice.namesAfter) {
            visit(names);
        }
    };
    both(change.probes, [&](Id id) { partRevisions_[id] = now; });
    both(change.lights, noteLight);
    for (const LightChange& each : change.inLights) {
        partRevisions_[state_.ids.lights[each.light].id] = now;
        both(each.keys, noteKey);
    }
    for (const KeyChange& each : change.inKeys) {
        partRevisions_[state_.ids.lights[each.light].id] = now;
        noteKey(state_.ids.lights[each.light].keys[each.key]);
    }
    const auto noteList = [now](std::uint64_t& revision, bool changed) {
        revision = changed ? now : revision;
    };
    noteList(revisions_.environment, change.environment != nullptr);
    noteList(revisions_.materials, !change.materials.empty());
    noteList(revisions_.probes, !change.probes.empty());
    noteList(revisions_.lights, !change.lights.empty() || !change.inLights.empty() ||
                                    !change.inKeys.empty() || change.rsrm != nullptr);
}

void Model::selectCreated(const std::vector<Id>& created) {
    if (created.empty()) {
        return;
    }
    Selection selection = selection_;
    if (findStop(state_.ids, created.front())) {
        selection.stops = created;
    } else if (findKey(state_.ids, created.front())) {
        selection.stops.clear();
        selection.key = created.front();
    } else if (findLight(state_.ids, created.front())) {
        selection.stops.clear();
        selection.key = Id::None;
        selection.light = created.front();
    } else {
        selection.probes = created;
    }
    selection_ = valid(std::move(selection), state_.ids);
}

} // namespace lodestar::model
