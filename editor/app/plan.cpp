// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/commands.h"
#include "app/plan_json.h"
#include "app/scene_options.h"
#include "lighting/mips.h"
#include "scene/draw_list.h"

namespace lodestar::app {
namespace {

int runPlan(const SceneOptions& options) {
    auto loaded = load(options);
    if (!loaded) {
        return fail(loaded.error());
    }
    warn(loaded->light.environment.warnings, loaded->light.name);
    warn(loaded->scene.warnings, options.scene);
    warn(loaded->lightWarnings, loaded->lightsName);
    plan::PlanInput input =
        scene::planInput(loaded->scene, loaded->view, loaded->settings,
                         {loaded->light.name,
                          loaded->light.environment.base.width(),
                          true,
                          !loaded->light.environment.base.empty(),
                          {}},
                         loaded->lights, layoutOf(loaded->lightsEstimator, loaded->ownMaps));
    if (input.environment.present && scene::hasChoices(input)) {
        const lighting::Cubemap& base = loaded->light.environment.base;
        scene::chooseEstimators(lighting::ErrorForecast(base, lighting::tentMips(base)), input);
    }
    std::printf("%s\n", toJson(plan::plan(input)).dump(2).c_str());
    return 0;
}

} // namespace

void addPlan(CLI::App& app, int& status) {
    auto options = std::make_shared<SceneOptions>();
    CLI::App* command = app.add_subcommand(
        "plan", "Say what a frame of a scene would simulate, and why, without rendering");
    addSceneOptions(*command, *options);
    command->footer("Example: what does the glass of a scene cost?\n"
                    "  lodestar plan house.gltf --environment dusk.hdr");
    command->callback([options, &status] { status = runPlan(*options); });
}

} // namespace lodestar::app
