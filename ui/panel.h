// What a panel of the inspector is: one file in ui/panels and one row in panels.cpp.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ui/model.h"
#include "ui/replayer/replayer.h"
#include "ui/widgets/widgets.h"
#include "ui/window/imgui_layer.h"
#include "ui/window/keys.h"

namespace strata::ui {

/// Where a panel stands: a tab of one of four regions.
enum class Area { left, center, right, bottom };

struct LogLine {
    enum class Kind { said, warned, failed } kind = Kind::said;
    double seconds = 0;  ///< since the inspector began
    std::string text;
};

/// What a panel works with beside the model.
struct Services {
    Widgets& widgets;
    Replayer& replayer;
    WorkQueue& host;  ///< for work without the device: statistics of pictures, differences
    ImguiLayer& layer;
    std::vector<LogLine>& log;
    std::map<std::string, bool>& settings;  ///< what people switched on, kept from session to session
    double seconds = 0;
};

/// The word over what was made of something else than its label says; empty where it is of that.
inline std::string updating_word(bool is_of_its_label, const Replayer& replayer, std::string_view what) {
    if (is_of_its_label) return {};
    if (replayer.awaits_shaders()) return fmt::format("updating {}: compiling shaders", what);
    return fmt::format("{} {}", replayer.error("A") ? "not replayed:" : "updating", what);
}

class Panel;

/// A key while no text is being typed.
struct PanelKey {
    std::string_view chord;  ///< "ctrl+z", "f1", "left"
    std::string_view help;
    void (*pressed)(Panel&, Model&, Services&);
    WhileHeld held = WhileHeld::once;
};

class Panel {
public:
    virtual ~Panel() = default;
    /// Draws into its region. Everything that can be clicked or read is a widget of `services.widgets`.
    virtual void draw(Model&, Services&) = 0;
    virtual std::span<const PanelKey> keys() const { return {}; }
    /// Whether something of its own is under way: scripts wait for it.
    virtual bool is_busy() const { return false; }
};

struct PanelRow {
    std::string_view name;
    Area area;
    std::string_view help;
    std::unique_ptr<Panel> (*make)();
};

/// Every panel, in the order of the tabs.
std::span<const PanelRow> panels();

}  // namespace strata::ui
