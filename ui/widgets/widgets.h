// The widgets panels are made of. Each draws by Dear ImGui and writes itself down: the frame's list of widgets is what scripts
// click by path, what tests compare text with, and where two widgets of one name are found out (Dear ImGui would mix them up
// silently).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <imgui.h>

namespace strata::ui {

enum class WidgetKind { button, checkbox, combo, choice, slider, input, selectable, tree, tab, text, canvas, point };
std::string_view name(WidgetKind);

struct WidgetRecord {
    std::string path;  ///< "Techniques/transparency/technique"
    WidgetKind kind;
    std::string value;  ///< as text: what it says or is set to
    ImVec2 from, to;    ///< pixels
    bool enabled = true;
    bool visible = true;                   ///< its middle, where a click goes
    double low = 0, high = 0, number = 0;  ///< of a slider
    bool open = false;                     ///< a tree's node, a combo's list
    std::string updating = {};             ///< the word over it, where it is not of what its label says
};

struct SliderRange {
    double low = 0, high = 1;
    bool logarithmic = false, whole = false;
    const char* format = "%.3g";
};

class Widgets {
public:
    /// Forgets the frame before the last.
    void begin_frame();
    /// Of the last whole frame; of the present one so far.
    const std::vector<WidgetRecord>& last() const { return last_; }
    const std::vector<WidgetRecord>& records() const { return records_; }
    /// The words that veils of the present frame have on the screen so far.
    const std::vector<std::string>& words_on_veils() const { return words_on_veils_; }
    const WidgetRecord* find(std::string_view path) const;
    /// Paths that name two widgets of the last frame.
    std::vector<std::string> conflicts() const;
    /// The next frame scrolls to the widget.
    void reveal(std::string path) { revealed_ = std::move(path); }

    /// A part of the path, and of Dear ImGui's, until it goes.
    class [[nodiscard]] Scope {
    public:
        Scope(Widgets& widgets, std::string_view name);
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;
        ~Scope();

    private:
        Widgets* widgets_;
        std::size_t length_;
    };
    Scope in(std::string_view name) { return {*this, name}; }

    enum class Veil {
        drawn,
        held_back,  ///< the records have the word, the screen does not: see ui/README.md
    };
    /// What is drawn while it lives lies under a veil with this word over it: it was made of something else than its label says.
    /// An empty word changes nothing. Of veils within each other the outermost alone is drawn. Not inside of a table.
    class [[nodiscard]] Updating {
    public:
        Updating(Widgets&, std::string word, Veil);
        Updating(const Updating&) = delete;
        Updating& operator=(const Updating&) = delete;
        ~Updating();

    private:
        std::string first_label(std::size_t first) const;

        Widgets* widgets_;
        std::string word_;
        bool is_drawn_;
        std::size_t first_;
        ImVec2 from_;
    };
    Updating updating(std::string word, Veil veil = Veil::drawn) { return {*this, std::move(word), veil}; }

    // Each is named by its label; `face` is what is shown instead. What is not shown ends at "##".
    bool button(std::string_view label, std::string_view face = {});
    std::optional<bool> checkbox(std::string_view label, bool value);
    std::optional<std::size_t> combo(std::string_view label, std::span<const std::string_view> items, std::size_t current);
    std::optional<double> slider(std::string_view label, double value, const SliderRange&);
    std::optional<std::string> input(std::string_view label, const std::string& value, const char* hint = "");
    bool selectable(std::string_view label, bool selected, std::string_view face = {});
    /// A row that opens; where it returns true, tree_end() follows its children.
    struct TreeRow {
        bool open = false, clicked = false;
    };
    TreeRow tree(std::string_view label, bool selected, ImGuiTreeNodeFlags flags = 0, std::string_view face = {});
    void tree_end();
    /// A name and what it is: "name" in gray, the value beside it.
    void value(std::string_view label, std::string_view text);
    /// Text that a test can find by its label.
    void text(std::string_view label, std::string_view text, const ImVec4* color = nullptr);
    /// An area that the panel draws itself and takes the mouse in.
    void canvas(std::string_view label, ImVec2 size, std::string_view text = {});
    /// A place of the canvas just made that means something under the mouse.
    void point(std::string_view label, ImVec2 at, std::string_view text = {});
    void tab(std::string_view label, bool selected);

    /// Shown over the last widget once the mouse has rested there, and no more once it was pressed, until it left. Who shows it
    /// is the widget "help".
    void help(std::string_view text);

private:
    /// What has help and lies under the mouse.
    struct Rest {
        ImVec2 from;
        std::string help;
        float seconds = 0;  ///< that the mouse rested; what is shown stays
        bool pressed = false, seen = false;
    };

    void record(std::string_view label, WidgetKind, std::string value);
    bool is_rested_on(std::string_view help);

    std::string path_, revealed_;
    std::vector<std::size_t> tree_lengths_;  ///< of path_ before each open row
    std::vector<WidgetRecord> records_, last_;
    std::vector<std::string> words_on_veils_;
    bool is_veiled_ = false;  ///< what is drawn now lies under a veil
    Rest rest_;
    std::optional<ImVec2> pressed_at_;  ///< while the mouse is still there
};

}  // namespace strata::ui
