// SPDX-License-Identifier: MIT
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/commands.h"

namespace lodestar::app {

int runProgram(int argc, char** argv) {
    int status = 0;
    CLI::App app(
        "Image-based lighting that needs no preprocessing: loads a glTF scene, lights it from a\n"
        "panorama or cube map, and says what the light costs.",
        "lodestar");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("lodestar " LODESTAR_VERSION));
    app.footer("Exit status: 0 done, 1 internal error, 2 wrong usage, 3 an input was refused,\n"
               "4 no usable OpenGL, 5 an output could not be written.");
    addRender(app, status);
    addView(app, status);
    addEdit(app, status);
    addScript(app, status);
    addPlan(app, status);
    addSample(app, status);
    addBake(app, status);
    addCompare(app, status);
    addCost(app, status);
    addCheck(app, status);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            return app.exit(error);
        }
        return fail(usage(error.what(), "try --help"));
    } catch (const std::exception& error) {
        return fail({core::ErrorCode::Internal, error.what(), {}, {}});
    }
    return status;
}

} // namespace lodestar::app
