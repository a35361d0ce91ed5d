// SPDX-License-Identifier: MIT
//
// A document under edit: commands, undo, selection, what is unsaved, what changed. No clock, no
// files (document_file.h), no picture.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "model/change.h"
#include "model/command.h"
#include "model/selection.h"
#include "model/state.h"

namespace lodestar::model {

/// Names a gesture: a drag, or the typing in one field. 0 names none.
using MergeToken = std::uint64_t;

/// What a command did.
struct Outcome {
    bool changed = false;    ///< false: the document was so already, and no step was made
    std::vector<Id> created; ///< lights, keys, stops or probes that it added
};

/// Numbers that grow with each change, undo and redo too; equal numbers, equal content.
struct Revisions {
    std::uint64_t document = 0; ///< any change
    /// The lights' own maps with them.
    std::uint64_t environment = 0, lights = 0, probes = 0, materials = 0;
};

class Model {
public:
    Model() : Model(document::Document{}) {}
    explicit Model(document::Document document);

    /// Another document as the starting point, whether or not it is saved anywhere: without steps
    /// and not dirty. Names, tokens and revisions go on, so that none means what it did before.
    void reset(document::Document document);

    [[nodiscard]] const document::Document& document() const { return state_.document; }
    [[nodiscard]] const Identities& ids() const { return state_.ids; }

    /// The part of a name; null for a name of no such part. Valid until the next change.
    [[nodiscard]] const document::Light* light(Id id) const;
    [[nodiscard]] const document::Key* key(Id id) const;
    [[nodiscard]] const document::Stop* stop(Id id) const;
    [[nodiscard]] const document::Probe* probe(Id id) const;
    /// The light that a key belongs to; None for a name of no key.
    [[nodiscard]] Id lightOf(Id key) const;
    /// The key that a stop belongs to; None for a name of no stop.
    [[nodiscard]] Id keyOf(Id stop) const;

    /// Carries a command out as one step of undo; what it added is selected. With the token of the
    /// step before, it joins that step, and where the step's last command was of the same type it
    /// takes that one's place: it starts from the document as that one found it. So a drag gives
    /// each command from the drag's start, and a field of text its whole value; a token belongs to
    /// one gesture or field. A drag held still changes nothing, and no revision grows.
    /// @errors InputRefused with one sentence; the document is as it was
    [[nodiscard]] core::Result<Outcome> execute(const Command& command, MergeToken token = 0);
    /// A token that none had.
    [[nodiscard]] MergeToken newToken() { return ++lastToken_; }

    /// Takes back the step of a drag that goes on; it cannot be redone.
    /// @return false where the last step is not of this token
    bool cancel(MergeToken token);

    /// One step back or forth. @return false where there is none
    bool undo();
    bool redo();
    /// The name of the step that undo or redo would take; empty where there is none.
    [[nodiscard]] std::string_view undoName() const;
    [[nodiscard]] std::string_view redoName() const;
    /// Steps that undo can take.
    [[nodiscard]] std::size_t undoCount() const { return done_; }
    /// Steps that redo can take.
    [[nodiscard]] std::size_t redoCount() const { return steps_.size() - done_; }
    /// Steps made, undone and redone since the start: grows with what a user would call a stroke.
    [[nodiscard]] std::uint64_t strokes() const { return strokes_; }
    /// A command of a step: the names that it found, the document that it left.
    using Visit = std::function<void(std::string_view step, const Command& command,
                                     const Identities& found, const document::Document& left)>;
    /// Goes through the commands of the steps that undo can take, from the first on; of those that
    /// joined, those that count.
    void visitDone(const Visit& visit) const;
    /// Bytes that the steps keep, about.
    [[nodiscard]] std::size_t historyBytes() const;

    /// Whether the document differs from the saved one by a step.
    [[nodiscard]] bool dirty() const { return stamp_ != savedStamp_; }
    /// The document is saved as it is. Ends merging.
    void markSaved();
    /// Nothing that is saved is the document: it was recovered, or its file is gone.
    void markUnsaved() { savedStamp_ = kNever; }

    [[nodiscard]] const Revisions& revisions() const { return revisions_; }
    /// The revision of the last change to a light, key or probe and what is below it.
    [[nodiscard]] std::uint64_t revisionOf(Id id) const;

    [[nodiscard]] const Selection& selection() const { return selection_; }
    /// Selects what the document has of a selection; a key brings its light, stops their key.
    void select(Selection selection);

private:
    static constexpr std::uint64_t kNever = ~std::uint64_t{0};

    struct Part {
        Command command;
        Change change;
    };
    struct Step {
        std::string_view name;
        std::vector<Part> parts;
        std::uint64_t before = 0, after = 0; ///< stamps
    };

    void apply(const Change& change, Direction direction);
    /// Notes the revision of what a change touches.
    void note(const Change& change);
    void selectCreated(const std::vector<Id>& created);
    /// Takes the last command, whose change is undone already, out of the last step.
    void dropLastPart();
    void keep(const Command& command, Change change, bool joins);

    State state_;
    std::vector<Step> steps_;
    std::size_t done_ = 0; ///< steps that are in the document
    std::uint64_t strokes_ = 0;
    MergeToken openToken_ = 0, lastToken_ = 0;
    std::uint64_t stamp_ = 0, lastStamp_ = 0, savedStamp_ = 0;
    Revisions revisions_;
    std::uint64_t firstRevision_ = 0; ///< of parts that nothing has touched
    std::map<Id, std::uint64_t> partRevisions_;
    Selection selection_;
};

} // namespace lodestar::model
