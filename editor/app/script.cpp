// SPDX-License-Identifier: MIT
//
// `lodestar script`: the editor's commands from a file, without a window.
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/commands.h"
#include "io/file.h"
#include "model/command_text.h"
#include "model/document_file.h"

namespace lodestar::app {
namespace {

struct ScriptOptions {
    std::string document, commands, output;
    bool begin = false; ///< the document need not be there
};

core::Result<void> runScriptFile(const ScriptOptions& options) {
    if (!options.begin && !std::filesystem::exists(options.document)) {
        return core::inFile(core::refused("is not there (--new begins with an empty document)"),
                            options.document);
    }
    model::Model model;
    core::Tally warnings;
    auto file = model::DocumentFile::open(options.document, model, warnings);
    if (!file) {
        return file.error();
    }
    warn(warnings, options.document);
    const auto text = io::readFile(options.commands);
    if (!text) {
        return core::inFile(text.error(), options.commands);
    }
    const auto run =
        model::runScript({reinterpret_cast<const char*>(text->data()), text->size()}, model);
    if (!run) {
        return core::inFile(run.error(), options.commands);
    }
    const bool changed = model.dirty();
    if (auto saved = file->saveAs(model, options.output); !saved) {
        return saved;
    }
    const nlohmann::ordered_json json = {
        {"commands", *run}, {"steps", model.undoCount()}, {"changed", changed}};
    std::printf("%s\n", json.dump().c_str());
    return {};
}

} // namespace

void addScript(CLI::App& app, int& status) {
    auto options = std::make_shared<ScriptOptions>();
    std::string names;
    for (const std::string_view name : model::commandNames()) {
        names += (names.empty()                           ? ""
                  : names.size() - names.rfind('\n') > 70 ? ",\n  "
                                                          : ", ") +
                 std::string(name);
    }
    CLI::App* command = app.add_subcommand(
        "script", "Edits a lighting document by a file of the editor's commands, without a window");
    command->add_option("DOCUMENT", options->document, "The lighting document")->required();
    command
        ->add_option("COMMANDS", options->commands,
                     "The commands, a JSON object a line; # begins a comment")
        ->required();
    command->add_option("-o,--output", options->output, "Where the result goes; may be DOCUMENT")
        ->required();
    command->add_flag("--new", options->begin, "Begins with an empty document where there is none");
    command->footer("Example: a stop at 30 degrees, and the day begins an hour earlier\n"
                    "  cat > edit.jsonl <<'END'\n"
                    "  {\"do\": \"AddStop\", \"key\": \"/lights/0/keys/0\", \"at\": 30}\n"
                    "  {\"do\": \"MoveKey\", \"key\": \"/lights/0/keys/0\", \"hour\": 5}\n"
                    "  END\n"
                    "  lodestar script sky.lodestar.json edit.jsonl -o sky.lodestar.json\n\n"
                    "Commands: Undo, Redo,\n  " +
                    names + ".\nTheir members: docs/editor.md.");
    command->callback([options, &status] {
        const auto done = runScriptFile(*options);
        status = done ? 0 : fail(done.error());
    });
}

} // namespace lodestar::app
