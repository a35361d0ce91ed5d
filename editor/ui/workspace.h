// SPDX-License-Identifier: MIT
//
// All of the editor's panels, in a layout that fills the display or one by one in a host's own
// windows: draws into the current ImGui frame, edits the model, and says what else it wants as
// values.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>

#include "ui/panels.h"
#include "ui/photograph_panel.h"
#include "ui/studio.h"

namespace lodestar::ui {

struct Binding;
class Workspace;

/// The panels of one frame, for whoever puts each into a window of its own: each draws into the
/// ImGui window that is begun, once a frame at most.
class Panels {
public:
    void scene() const;       ///< nodes, materials, lights
    void light() const;       ///< the chosen light: its axis or path, and its key's gradient
    void probes() const;      ///< the chosen light probe
    void materials() const;   ///< the chosen materials
    void environment() const; ///< the environment behind the scene
    void day() const;         ///< 24 hours of the chosen light
    void report() const;      ///< the plan, the times, the log
    void viewport() const;    ///< the picture, all of the room that is left
    /// Answers the keys of `bindings()`: where the host's own do not hold.
    void answerKeys() const;

private:
    friend class Workspace;
    Panels(Workspace& workspace, Studio& studio) : workspace_(workspace), studio_(studio) {}
    Workspace& workspace_;
    Studio& studio_;
};

class Workspace {
public:
    /// One frame of all panels over the whole display, with its menus. @pre an ImGui frame has
    /// begun; the model's selection may change too
    /// @return what the frame asks for
    Wishes draw(model::Model& model, const Surroundings& surroundings);
    /// One frame of what `contents` draws of the panels, in the host's windows. What the panels ask
    /// for a path or an answer is asked over all of them.
    Wishes draw(model::Model& model, const Surroundings& surroundings,
                const std::function<void(const Panels&)>& contents);

    [[nodiscard]] ViewState& view() { return view_; }
    [[nodiscard]] const ViewState& view() const { return view_; }
    void say(std::string text, bool isError = false);
    /// A radiance that was picked in the viewport: selected stops get it, or the brush.
    void givePicked(model::Model& model, const glm::dvec3& radiance);
    /// Asks whether unsaved changes are to be saved before the end.
    void askBeforeQuit() { asksQuit_ = true; }
    /// Asks what is to become of what others wrote to the document's file.
    void askAboutOutside() { asksOutside_ = true; }

    /// Where things were drawn in the last frame, by name.
    [[nodiscard]] const std::map<std::string, Mark>& marks() const { return marks_; }
    [[nodiscard]] const std::deque<LogLine>& log() const { return log_; }

private:
    friend class Panels;
    void drawMenus(Studio& studio);
    void drawPanels(Studio& studio, float top);
    void drawPrompts(Studio& studio);
    void drawQuestion(Studio& studio);
    void drawHelp(const Studio& studio);
    void answerKeys(Studio& studio);
    void answerCancel(Studio& studio) const;
    void perform(Studio& studio, const Binding& binding);
    bool performOnGradient(Studio& studio, const Binding& binding);

    /// A path that is asked for.
    enum class Prompt { None, OpenScene, OpenLighting, OpenPhotograph, SaveAs, SaveCommands };

    ViewState view_;
    GradientPanel gradient_;
    DayPanel day_;
    ProbeGizmo gizmo_;
    PhotographPanel photograph_;
    std::map<std::string, Mark> marks_;
    std::deque<LogLine> log_;
    model::MergeToken token_ = 0;
    ImGuiID holder_ = 0;
    Prompt prompt_ = Prompt::None;
    bool promptOpens_ = false;
    bool asksQuit_ = false, asksOutside_ = false;
    std::string path_;
};

} // namespace lodestar::ui
