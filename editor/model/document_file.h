// SPDX-License-Identifier: MIT
//
// The file of a document under edit: saving, the side file that is written meanwhile, recovery from
// it, and what others do to the file. Time is passed in; nothing here waits or runs by itself.
//
// A file is always written whole, to a temporary, and renamed (io/file.h): whenever the program
// dies, what is on the disk is readable, and at most kAutosaveSeconds or kAutosaveStrokes are lost.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/result.h"
#include "core/tally.h"
#include "model/model.h"

namespace lodestar::model {

/// The side file is written when the last one is this old, or behind by so many strokes.
inline constexpr double kAutosaveSeconds = 5.0;
inline constexpr std::uint64_t kAutosaveStrokes = 20;
/// After a failure it is tried again this much later.
inline constexpr double kAutosaveRetrySeconds = 30.0;

/// The side file of a document: its path and ".autosave".
[[nodiscard]] std::filesystem::path autosavePath(const std::filesystem::path& document);

/// What others did to the file since it was read or written here. After the last two the document
/// is nowhere else: Model::markUnsaved.
enum class Outside { Nothing, Changed, Removed };

class DocumentFile {
public:
    /// A document without a file yet.
    DocumentFile() = default;

    /// Reads a document. Temporaries of programs that died while they wrote it are taken away.
    /// @param model is reset to the document
    /// @param first what stands for a file that is not there, to be saved there: where editing
    /// starts, neither a step nor unsaved
    /// @errors InputRefused as io::loadDocument; the model stays
    [[nodiscard]] static core::Result<DocumentFile> open(const std::filesystem::path& path,
                                                         Model& model, core::Tally& warnings,
                                                         document::Document first = {});

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Writes the document and takes the side file away.
    /// @errors Usage: no path yet; OutputFailed: the document stays dirty, the old file whole
    [[nodiscard]] core::Result<void> save(Model& model);
    /// The same at another path, which is the file's from then on; unchanged on failure.
    [[nodiscard]] core::Result<void> saveAs(Model& model, const std::filesystem::path& path);

    /// Writes the side file where it is due; call it every frame. @param now seconds of any clock
    /// that does not run backwards
    /// @return whether it wrote  @errors OutputFailed: told once, then tried again later
    [[nodiscard]] core::Result<bool> autosave(const Model& model, double now);
    /// Takes the side file away: unsaved changes are given up.
    void discardAutosave();

    /// A side file that is newer than the document and says something else.
    [[nodiscard]] std::optional<document::Document> recovery() const;
    /// Brings a recovered document in as a step that can be undone; it is dirty. @errors as execute
    [[nodiscard]] core::Result<void> recover(Model& model, const document::Document& document);

    /// Looks at the file's time and size, and at its bytes where those differ. Told once per
    /// change.
    [[nodiscard]] Outside poll();
    /// Reads the file again as a step that can be undone; then it is not dirty.
    /// @errors InputRefused: the file is refused; the document stays
    [[nodiscard]] core::Result<void> reload(Model& model, core::Tally& warnings);

private:
    /// The disk has the model as it is.
    void noteKept(const Model& model);

    /// What tells that a file was touched.
    struct Stamp {
        bool exists = false;
        std::int64_t time = 0;
        std::uint64_t size = 0;
        bool operator==(const Stamp&) const = default;
    };
    [[nodiscard]] static Stamp stampOf(const std::filesystem::path& path);

    std::filesystem::path path_;
    Stamp stamp_;                 ///< of the file as it was last looked at
    std::string text_;            ///< of the file as it was last read or written here
    std::uint64_t revision_ = 0;  ///< that the side file or the file has
    std::uint64_t strokes_ = 0;   ///< at that revision
    std::optional<double> since_; ///< when the model was first seen ahead of it
    std::optional<double> retry_; ///< no earlier than this
};

} // namespace lodestar::model
