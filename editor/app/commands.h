// SPDX-License-Identifier: MIT
//
// The subcommands of `lodestar`, one file each. Each adds itself to the command line and sets the
// exit status when it has run.
#pragma once

namespace CLI {
class App;
}

namespace lodestar::app {

void addRender(CLI::App& app, int& status);
void addView(CLI::App& app, int& status);
void addEdit(CLI::App& app, int& status);
void addScript(CLI::App& app, int& status);
void addPlan(CLI::App& app, int& status);
void addSample(CLI::App& app, int& status);
void addBake(CLI::App& app, int& status);
void addCompare(CLI::App& app, int& status);
void addCost(CLI::App& app, int& status);
void addCheck(CLI::App& app, int& status);

/// All of the executable: reads the command line, runs what it asks for. @return the exit status
[[nodiscard]] int runProgram(int argc, char** argv);

} // namespace lodestar::app
