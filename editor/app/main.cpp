// SPDX-License-Identifier: MIT
#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/commands.h"

int main(int argc, char** argv) {
    using namespace lodestar;
    int status = 0;
    CLI::App app(
        "Image-based lighting that needs no preprocessing: loads a glTF scene, lights it from a\n"
        "panorama or cube map, and says what the light costs.",
        "lodestar");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("lodestar " LODESTAR_VERSION));
    app.footer("Exit status: 0 done, 1 internal error, 2 wrong usage, 3 an input was refused,\n"
               "4 no usable OpenGL, 5 an output could not be written.");
    app::addRender(app, status);
    app::addView(app, status);
    app::addPlan(app, status);
    app::addSample(app, status);
    app::addCheck(app, status);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            return app.exit(error);
        }
        return app::fail(app::usage(error.what(), "try --help"));
    } catch (const std::exception& error) {
        return app::fail({core::ErrorCode::Internal, error.what(), {}, {}});
    }
    return status;
}
