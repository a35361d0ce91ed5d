// SPDX-License-Identifier: MIT
//
// What stands around the panels where there is no scene, no file and no picture: it is told in all
// the ways in which an editor tells it, and does what the panels ask for.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "document/document.h"
#include "model/presets.h"
#include "monkey.h"
#include "ui/session.h"

namespace lodestar::ui {

class MonkeyWorld {
public:
    MonkeyWorld()
        : session_(Session::Drawing::None,
                   {[this] { return clipboard_; },
                    [this](const std::string& text) { clipboard_ = text; }}) {
        around_.sceneName = "spheres";
        around_.materials = {{"floor", 24.0, glm::dvec3(0.5), glm::dvec3(0.04), ""},
                             {"#1", 900.0, glm::dvec3(0.0), glm::dvec3(0.9), "ring:3"}};
        around_.nodes = {{"root", 0, ""}, {"ball", 1, "mesh"}, {"ball", 2, "probe"}};
        around_.estimators = {"tent", "ring:3", "auto:0.05"};
        around_.clipFromWorld = glm::mat4(0.4f);
        around_.clipFromWorld[2] = {0.15f, -0.2f, 0.4f, 0.0f}; // no axis towards the eye
        around_.clipFromWorld[3] = {-0.2f, -0.2f, 0.0f, 1.0f};
        around_.presets = {{"mine", model::builtInPresets().back().lights}};
        around_.timesMs = {{"draws", 1.25}};
        auto plan = std::make_shared<plan::EffectPlan>();
        for (int i = 0; i < 40; ++i) {
            plan->effects.push_back({"draw",
                                     "node/" + std::to_string(i),
                                     i % 3 != 0 ? plan::Decision::Run : plan::Decision::Skip,
                                     "as 100 % of it is seen",
                                     {}});
        }
        around_.plan = std::move(plan);
        begin();
    }

    /// A frame with one more input, and what follows from it.
    void frame(Monkey& monkey) {
        if (monkey.one(400)) {
            resize(monkey);
        }
        if (monkey.one(150)) {
            happen(monkey);
        }
        describe();
        const auto width = static_cast<float>(width_);
        const auto height = static_cast<float>(height_);
        session_.push(monkey.next(workspace_.marks(), touched_, width, height));
        if (monkey.one(6)) { // two in one frame
            session_.push(monkey.next(workspace_.marks(), touched_, width, height));
        }
        Wishes wishes;
        session_.frame(width_, height_, scale_, monkey.one(50) ? 0.7 : 1.0 / 60.0,
                       [&] { wishes = workspace_.draw(model_, around_); });
        touched_.note(workspace_.marks());
        answer(wishes);
    }

    /// From the first document again, without steps.
    void begin() {
        document::Document document;
        document.lights = model::builtInPresets().front().lights;
        model_.reset(document);
        start_ = document::writeDocument(model_.document());
    }
    [[nodiscard]] model::Model& model() { return model_; }
    [[nodiscard]] const Workspace& workspace() const { return workspace_; }
    /// What was asserted in vain in the last frame.
    [[nodiscard]] const std::string& failure() const { return session_.failure(); }
    /// The document that all steps lead back to.
    [[nodiscard]] const std::string& start() const { return start_; }
    [[nodiscard]] const Touched& touched() const { return touched_; }

private:
    void resize(Monkey& monkey) {
        constexpr std::array<std::pair<int, int>, 8> kSizes = {{{1, 1},
                                                                {1, 800},
                                                                {1280, 1},
                                                                {40, 30},
                                                                {320, 240},
                                                                {640, 400},
                                                                {2560, 1440},
                                                                {7, 2000}}};
        // A window without room has little to be found in it: most of the time it has some.
        const auto [width, height] =
            !small_ && monkey.one(3) ? kSizes[static_cast<std::size_t>(monkey.below(kSizes.size()))]
                                     : std::pair(1280, 800);
        width_ = width;
        height_ = height;
        small_ = width != 1280;
        scale_ = monkey.one(10) ? 2.0f : 1.0f;
    }

    static Photograph photograph(bool panorama, bool sun) {
        const int width = panorama ? 32 : 7;
        auto image = std::make_shared<core::Image>(width, 16, 3);
        for (std::size_t i = 0; i < image->pixels().size(); ++i) {
            image->pixels()[i] = static_cast<float>((i * 37) % 101) * (i % 50 == 0 ? 1e7f : 0.1f);
        }
        Photograph made{"sky.hdr", std::move(image), 1, {}};
        if (panorama) {
            made.fit.emplace();
            made.fit->advice = "A sky symmetric about its axis is near to it";
            made.fit->sun = sun ? std::optional(glm::dvec3(0.6, 0.8, 0.0)) : std::nullopt;
        }
        return made;
    }

    static AccuracyView accuracy(Monkey& monkey) {
        AccuracyView view;
        view.material = monkey.one(6) ? "" : "floor";
        view.exponent = 24.0;
        view.selectable = !monkey.one(4);
        view.progress = monkey.one(2) ? 1.0 : 0.3;
        view.lines = {{"tent", "", 0.02, 0.1, 3.0, 4, true, true},
                      {"ring:3", "", 1e-5, 0.5, 1e4, 12, false, true},
                      {"auto:0.05", "tent", {}, {}, {}, 0, false, false},
                      {"rsrm", "", 0.0, 0.0, 0.0, 1, false, false}};
        for (int row = monkey.below(9); row > 0; --row) {
            view.rows.push_back({std::exp2(row),
                                 monkey.one(3) ? std::nullopt : std::optional(0.01 * row),
                                 std::exp2(row + 0.5), std::nullopt});
        }
        return view;
    }

    /// What comes from elsewhere than the user's hand.
    void happen(Monkey& monkey) {
        constexpr std::array kClipboards = {"#ff8800",        "",
                                            "{\"lodestar\":", "not a document",
                                            "#12345g",        "{\"stops\":[{\"at\":1e999}]}"};
        switch (monkey.below(12)) {
        case 0:
        case 1:
            if (!around_.photograph.radiance || monkey.one(6)) {
                around_.photograph = photograph(!monkey.one(3), monkey.one(2));
            }
            break;
        case 2:
            around_.work = WorkLine{"Reading sky.hdr", 0.5};
            break;
        case 3:
            around_.work.reset();
            break;
        case 4:
            workspace_.askBeforeQuit();
            break;
        case 5:
            workspace_.askAboutOutside();
            break;
        case 6:
            clipboard_ = kClipboards[static_cast<std::size_t>(monkey.below(kClipboards.size()))];
            break;
        case 7:
            around_.accuracy = accuracy(monkey);
            break;
        case 8:
            around_.picture = around_.preview = static_cast<unsigned>(monkey.below(2));
            around_.errorPicture = static_cast<unsigned>(monkey.below(2));
            around_.errorText = monkey.one(2) ? "" : "4.1 % of the picture's light";
            break;
        case 9:
            workspace_.givePicked(model_, glm::dvec3(monkey.below(3)));
            break;
        case 10:
            around_.drawsProbes = !around_.drawsProbes;
            break;
        default:
            workspace_.say("a file was read", monkey.one(2));
        }
    }

    void describe() {
        around_.documentName = "sky.lodestar.json";
        around_.probes.clear();
        for (const document::Probe& each : model_.document().probes) {
            ProbeLine line;
            line.shown = each.probe.node.empty();
            line.ready = line.shown;
            line.progress = each.probe.source.empty() ? 1.0 : 0.5;
            line.worldFromProbe[3] = glm::vec4(glm::vec3(each.probe.position), 1.0f);
            around_.probes.push_back(line);
        }
    }

    void open() {
        document::Document document;
        document.lights = model::builtInPresets().back().lights;
        document.probes.emplace_back();
        model_.reset(document);
        start_ = document::writeDocument(model_.document());
    }

    void answer(const Wishes& wishes) {
        if (wishes.save || wishes.saveAs) {
            model_.markSaved();
        }
        if (wishes.openLighting || wishes.reload) {
            open();
        }
        if (wishes.openScene || wishes.cancelWork) {
            around_.work.reset();
        }
        if (wishes.openPhotograph) {
            around_.photograph = photograph(true, true);
        }
        if (wishes.closePhotograph) {
            around_.photograph = {};
        }
        if (wishes.mean && around_.photograph.radiance) {
            auto gradient =
                model::gradientOfPanorama(*around_.photograph.radiance, wishes.mean->axis,
                                          lighting::LightKind::Sky, kPhotographStops);
            if (gradient) {
                (void)model_.execute(model::SetGradient{wishes.mean->key, std::move(*gradient)});
            }
        }
        if (wishes.lights) {
            (void)model_.execute(model::SetLights{model::builtInPresets()[1].lights});
        }
        if (wishes.savePreset && around_.presets.size() < 4) {
            around_.presets.push_back({*wishes.savePreset, model_.document().lights});
        }
        if (wishes.removePreset && around_.presets.size() > 1) {
            std::erase_if(around_.presets, [&](const model::Preset& preset) {
                return preset.name == *wishes.removePreset;
            });
        }
        if (wishes.select) {
            model::Selection selection = model_.selection();
            selection.materials = {wishes.select->x % 2 == 0 ? "floor" : "#1"};
            model_.select(selection);
        }
    }

    Session session_;
    Workspace workspace_;
    Surroundings around_;
    model::Model model_;
    Touched touched_;
    std::string clipboard_, start_;
    int width_ = 1280, height_ = 800;
    bool small_ = false;
    float scale_ = 1.0f;
};

} // namespace lodestar::ui
