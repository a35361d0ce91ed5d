// SPDX-License-Identifier: MIT
#include "model/document_file.h"

#include <cerrno>
#include <charconv>
#include <string_view>
#include <system_error>
#include <utility>

#include <csignal>

#include "io/document_file.h"
#include "io/file.h"

namespace lodestar::model {
namespace {

namespace fs = std::filesystem;

core::Result<std::string> textAt(const fs::path& path) {
    const auto bytes = io::readFile(path, document::kMaxTextBytes);
    if (!bytes) {
        return core::inFile(bytes.error(), path.string());
    }
    return std::string(bytes->begin(), bytes->end());
}

core::Result<document::Document> parsed(const std::string& text, const fs::path& path,
                                        core::Tally& warnings) {
    auto document = document::parseDocument(text, warnings);
    if (!document) {
        return core::inFile(document.error(), path.string());
    }
    return document;
}

core::Result<void> write(const fs::path& path, const std::string& text) {
    return io::writeFile(path, text.data(), text.size());
}

/// Takes away the temporaries (io::writeFile: NAME.tmp-PROCESS-SERIAL) of processes that are no
/// more.
void removeLeftovers(const fs::path& path) {
    const std::string start = path.filename().string() + ".tmp-";
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::error_code code;
    fs::directory_iterator entry(folder, code);
    for (; !code && entry != fs::directory_iterator(); entry.increment(code)) {
        const std::string name = entry->path().filename().string();
        int process = 0;
        if (!name.starts_with(start) ||
            std::from_chars(name.data() + start.size(), name.data() + name.size(), process).ec !=
                std::errc()) {
            continue;
        }
        if (process > 0 && ::kill(process, 0) != 0 && errno == ESRCH) {
            std::error_code ignored; // it is litter, not work
            fs::remove(entry->path(), ignored);
        }
    }
}

} // namespace

fs::path autosavePath(const fs::path& document) {
    fs::path path = document;
    path += ".autosave";
    return path;
}

DocumentFile::Stamp DocumentFile::stampOf(const fs::path& path) {
    std::error_code code;
    Stamp stamp;
    stamp.exists = fs::exists(path, code);
    if (stamp.exists) {
        const auto time = fs::last_write_time(path, code);
        stamp.time = code ? 0 : static_cast<std::int64_t>(time.time_since_epoch().count());
        const auto size = fs::file_size(path, code);
        stamp.size = code ? 0 : static_cast<std::uint64_t>(size);
    }
    return stamp;
}

core::Result<DocumentFile> DocumentFile::open(const fs::path& path, Model& model,
                                              core::Tally& warnings, document::Document first) {
    DocumentFile file;
    file.path_ = path;
    removeLeftovers(path);
    removeLeftovers(autosavePath(path));
    file.stamp_ = stampOf(path); // before the reading, so that what is written between is noticed
    if (!file.stamp_.exists) {
        model.reset(std::move(first));
        file.noteKept(model);
        return file;
    }
    auto text = textAt(path);
    if (!text) {
        return text.error();
    }
    auto document = parsed(*text, path, warnings);
    if (!document) {
        return document.error();
    }
    file.text_ = std::move(*text);
    model.reset(std::move(*document));
    file.noteKept(model);
    return file;
}

core::Result<void> DocumentFile::save(Model& model) {
    if (path_.empty()) {
        return core::Error{core::ErrorCode::Usage, "the document has no file yet", {}, {}};
    }
    return saveAs(model, path_);
}

core::Result<void> DocumentFile::saveAs(Model& model, const fs::path& path) {
    std::string text = document::writeDocument(model.document());
    if (auto written = write(path, text); !written) {
        return written;
    }
    discardAutosave(); // the old path's
    path_ = path;
    discardAutosave();
    stamp_ = stampOf(path);
    text_ = std::move(text);
    model.markSaved();
    noteKept(model);
    return {};
}

core::Result<bool> DocumentFile::autosave(const Model& model, double now) {
    if (path_.empty() || model.revisions().document == revision_) {
        since_.reset();
        return false;
    }
    if (!since_) {
        since_ = now;
    }
    const bool due =
        now - *since_ >= kAutosaveSeconds || model.strokes() - strokes_ >= kAutosaveStrokes;
    if (!due || (retry_ && now < *retry_)) {
        return false;
    }
    if (!model.dirty()) { // undone to what the file has
        discardAutosave();
    } else if (auto written = write(autosavePath(path_), document::writeDocument(model.document()));
               !written) {
        retry_ = now + kAutosaveRetrySeconds;
        return written.error();
    }
    noteKept(model);
    return true;
}

void DocumentFile::noteKept(const Model& model) {
    revision_ = model.revisions().document;
    strokes_ = model.strokes();
    since_.reset();
    retry_.reset();
}

void DocumentFile::discardAutosave() {
    if (!path_.empty()) {
        std::error_code code; // where it cannot go it is offered again, which harms nothing
        fs::remove(autosavePath(path_), code);
    }
}

std::optional<document::Document> DocumentFile::recovery() const {
    const fs::path side = autosavePath(path_);
    const Stamp found = stampOf(side);
    // A side file that is older was left behind by a save that could not take it away.
    if (path_.empty() || !found.exists || (stamp_.exists && found.time < stamp_.time)) {
        return std::nullopt;
    }
    core::Tally warnings; // told again where it is brought in
    const auto text = textAt(side);
    if (!text || *text == text_) {
        return std::nullopt;
    }
    auto document = parsed(*text, side, warnings);
    if (!document) {
        return std::nullopt;
    }
    const auto saved = parsed(text_, path_, warnings);
    if (saved && *saved == *document) {
        return std::nullopt; // the same, written another way
    }
    return std::move(*document);
}

core::Result<void> DocumentFile::recover(Model& model, const document::Document& document) {
    const auto outcome = model.execute(ReplaceDocument{document});
    if (!outcome) {
        return outcome.error();
    }
    noteKept(model); // in the side file
    return {};
}

Outside DocumentFile::poll() {
    const Stamp now = path_.empty() ? stamp_ : stampOf(path_);
    if (now == stamp_) {
        return Outside::Nothing;
    }
    const bool existed = stamp_.exists;
    stamp_ = now;
    if (!now.exists) {
        return existed ? Outside::Removed : Outside::Nothing;
    }
    const auto text = textAt(path_);
    return text && *text == text_ ? Outside::Nothing : Outside::Changed;
}

core::Result<void> DocumentFile::reload(Model& model, core::Tally& warnings) {
    const Stamp stamp = stampOf(path_);
    auto text = textAt(path_);
    if (!text) {
        return text.error();
    }
    const auto document = parsed(*text, path_, warnings);
    if (!document) {
        return document.error();
    }
    const auto outcome = model.execute(ReplaceDocument{*document});
    if (!outcome) {
        return outcome.error();
    }
    stamp_ = stamp;
    text_ = std::move(*text);
    discardAutosave();
    model.markSaved();
    noteKept(model);
    return {};
}

} // namespace lodestar::model
