// Plays an inspector by synthetic input, a command per line, without a window: the same file makes the same pictures. README.md
// has the commands.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ui/inspector.h"

namespace strata::ui {

/// A line of a script: words, of which some may be in quotes. Comments begin with '#'.
struct ScriptLine {
    std::size_t number = 0;
    std::vector<std::string> words;
};
Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& file);

/// The hands of whoever has no window: moves the mouse, presses keys, waits. Every frame is a sixtieth of a second, whatever the
/// clock says.
class Player {
public:
    Player(Inspector&, ImguiLayer&, ImVec2 size);

    Result<void> frames(int count);
    /// Until nothing is being computed any more.
    Result<void> wait();
    Result<void> click(const std::string& path);
    Result<void> choose(const std::string& path, const std::string& item);
    /// Pulls a slider to a value: as near as the mouse comes to it.
    Result<void> drag(const std::string& path, double value);
    /// Pulls from where the mouse is.
    Result<void> pull(float x, float y);
    /// Into an input or, by Ctrl and click, a slider.
    Result<void> type(const std::string& path, const std::string& text);
    Result<void> key(const std::string& chord);
    /// To a place in a widget: 0 0 its upper left, 1 1 its lower right corner.
    Result<void> move(const std::string& path, float x, float y);
    Result<void> wheel(float steps);
    Result<void> expect(const std::string& path, const std::string& text) const;
    /// The last frame.
    Result<Picture> picture();
    Result<void> shot(const std::filesystem::path&);
    Result<void> tree(const std::filesystem::path&) const;
    Inspector& inspector() { return *inspector_; }

private:
    Result<WidgetRecord> reach(const std::string& path);
    Result<void> press_at(ImVec2);

    Inspector* inspector_;
    ImguiLayer* layer_;
};

/// Files are written into the folder. Told of each line before it is played.
Result<void> play(Player&, const std::vector<ScriptLine>&, const std::string& file, const std::filesystem::path& folder,
                  const strata::Progress& = {});

}  // namespace strata::ui
