// SPDX-License-Identifier: MIT
//
// The editor's files beside the scene: what others do to the document's, the user's presets, what
// is dropped.
#include <algorithm>
#include <cctype>
#include <utility>

#include "app/editor.h"
#include "io/file.h"
#include "model/clipboard.h"
#include "model/command_text.h"
#include "model/presets.h"

namespace lodestar::app {
namespace {

std::string extensionOf(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

bool isPicture(const std::string& extension) {
    constexpr std::array kPictures = {".hdr", ".pic", ".exr", ".png", ".jpg", ".jpeg"};
    return std::find(kPictures.begin(), kPictures.end(), extension) != kPictures.end();
}

/// The text of a file that the clipboard could have held, where it is one.
std::optional<std::string> clipboardText(const std::string& path) {
    const auto bytes = io::readFile(path, document::kMaxTextBytes);
    if (!bytes) {
        return std::nullopt; // said by who opens it as a document
    }
    std::string text(bytes->begin(), bytes->end());
    // What copying writes has it at its root; a lighting document has no such member.
    return text.find("\"clipboard\"") != std::string::npos ? std::optional(std::move(text))
                                                           : std::nullopt;
}

} // namespace

void Editor::watchFile(double seconds) {
    sinceWatched_ += seconds;
    if (sinceWatched_ < kWatchSeconds || file_.path().empty()) {
        return;
    }
    sinceWatched_ = 0.0;
    const std::string name = file_.path().filename().string();
    switch (file_.poll()) {
    case model::Outside::Nothing:
        return;
    case model::Outside::Removed:
        model_.markUnsaved();
        workspace_.say(name + " was removed by another program; it stays here, unsaved", true);
        break;
    case model::Outside::Changed:
        model_.dirty() ? workspace_.askAboutOutside() : reload();
        break;
    }
    session_.wake(kWindowFrames);
}

void Editor::reload() {
    core::Tally warnings;
    if (auto read = file_.reload(model_, warnings); !read) {
        model_.markUnsaved(); // the disk has something else
        workspace_.say(read.error().message(), true);
    } else {
        workspace_.say(file_.path().filename().string() +
                       " was changed by another program and read again; undo goes back");
    }
    session_.wake();
}

void Editor::listPresets() {
    core::Tally warnings;
    around_.presets = model::loadPresets(model::userPresetFolder(), warnings);
    for (const auto& [what, count] : warnings.counts()) {
        (void)count;
        if (std::find(presetWarnings_.begin(), presetWarnings_.end(), what) ==
            presetWarnings_.end()) { // told once
            presetWarnings_.push_back(what);
            workspace_.say(what, true);
        }
    }
    session_.wake();
}

void Editor::answerFiles(const ui::Wishes& wishes) {
    if (wishes.reload) {
        reload();
    }
    if (wishes.keepMine) {
        model_.markUnsaved();
        session_.wake();
    }
    core::Result<void> done;
    if (wishes.savePreset) {
        done = model::savePreset(model::userPresetFolder(),
                                 {*wishes.savePreset, model_.document().lights});
        if (done) {
            workspace_.say("preset saved: " + *wishes.savePreset);
            workspace_.view().presetName.clear();
        }
    } else if (wishes.removePreset) {
        done = model::removePreset(model::userPresetFolder(), *wishes.removePreset);
        if (done) {
            workspace_.say("preset deleted: " + *wishes.removePreset);
        }
    }
    if (wishes.saveCommands) {
        const std::string text = model::writeHistory(model_);
        done = io::writeFile(*wishes.saveCommands, text.data(), text.size());
        if (done) {
            workspace_.say(std::to_string(model_.undoCount()) +
                           " steps saved as commands: " + *wishes.saveCommands);
        }
    }
    if (!done) {
        workspace_.say(done.error().message(), true);
    }
    if (wishes.listPresets || wishes.savePreset || wishes.removePreset) {
        listPresets();
    }
}

void Editor::paste(const std::string& text) {
    const std::vector<model::LightIds>& lights = model_.ids().lights;
    const model::Selection& selection = model_.selection();
    model::PasteTarget target{selection.key, selection.light, workspace_.view().hour,
                              selection.materials};
    if (target.light == model::Id::None && !lights.empty()) {
        target.light = lights.front().id;
    }
    if (const auto light = model::findLight(model_.ids(), target.light);
        target.key == model::Id::None && light && !lights[*light].keys.empty()) {
        target.key = lights[*light].keys.front().id;
    }
    auto command = model::pasteCommand(model_, text, target);
    core::Result<model::Outcome> done =
        command ? model_.execute(*command) : core::Result<model::Outcome>(command.error());
    if (!done) {
        workspace_.say(done.error().message(), true);
    }
}

void Editor::drop(const std::string& path) {
    const std::string extension = extensionOf(path);
    core::Result<void> done;
    if (extension == ".gltf" || extension == ".glb") {
        askForScene(path);
    } else if (isPicture(extension)) {
        openPhotograph(path);
    } else if (extension == ".json") {
        if (const auto text = clipboardText(path)) {
            paste(*text);
        } else {
            done = openLightingFile(path);
        }
    } else {
        workspace_.say("neither a scene, a lighting document nor a picture: " + path, true);
    }
    if (!done) {
        workspace_.say(done.error().message(), true);
    }
    session_.wake();
}

} // namespace lodestar::app
