// What panels show and change: how the frame is made, what is selected, how pictures are looked at. Panels change it by the
// functions here alone, so that every change can be undone and becomes a command line.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "passes/tolerance.h"
#include "replay/session/session.h"
#include "ui/replayer/replayer.h"
#include "ui/window/imgui_layer.h"

namespace strata::ui {

struct Outline;

/// How a frame is made, as differences to how it was recorded. What undo brings back.
struct Edits {
    FrameVariant variant = {};
    ChoiceChanges choices = {};
    friend bool operator==(const Edits&, const Edits&) = default;
};

/// A picture that a panel made of what a replay gave.
struct MadePicture {
    MadeOf of;
    std::shared_ptr<const HostImage> image;
    Look look;
    std::string which = {};  ///< of the pictures that the panel makes of it: "32 +- 2 bytes"
};

/// Which image is shown: an output or view by its name, what a step of the plan wrote, or what a panel made.
struct ImageChoice {
    std::string name = "display";
    std::optional<std::size_t> step;
    std::uint32_t layer = 0;
    std::shared_ptr<const MadePicture> made = {};
    std::string which_made = {};  ///< MadePicture::which of the one that is wanted
    friend bool operator==(const ImageChoice&, const ImageChoice&) = default;
};

/// What part of a picture is seen: the same for every picture that is compared.
struct PictureView {
    double zoom = 0;                    ///< pixels of the window per texel; 0: as large as fits
    double center_x = 0, center_y = 0;  ///< texels, in the middle of the view
    friend bool operator==(const PictureView&, const PictureView&) = default;
};

class Model {
public:
    Model(std::filesystem::path capture, DeviceChoice, const Request& first);

    std::filesystem::path capture;
    DeviceChoice device;
    std::filesystem::path shaders = ".";  ///< the folder whose passes/... may hold changed shaders
    bool uses_shaders = false;            ///< whether they were loaded
    std::filesystem::path program;        ///< this one, to compile in a process of its own; empty: nothing is compiled so

    // What is selected and how it is looked at: no part of undo.
    ImageChoice image;
    std::optional<std::size_t> step;         ///< of the plan
    std::optional<std::uint32_t> draw;       ///< of the frame, as in Session::draw_cover()
    std::shared_ptr<const Outline> outline;  ///< of a draw, over every picture of its frame; null: none
    std::optional<glm::ivec2> pin;
    std::optional<glm::ivec2> under;  ///< the texel under the pointer, where there is one
    PictureView view;
    std::map<std::string, Look> looks;  ///< by the image's name, where a person changed it

    /// Learns how a frame was recorded: from then on choices() is known.
    void know(const FrameFacts&);
    bool is_known() const { return facts_.has_value(); }
    const FrameFacts& facts() const { return *facts_; }
    const Choices& choices() const { return choices_; }
    const Choices& recorded() const { return recorded_; }
    /// What a parameter returns to: the recorded value, or its fallback where another technique was recorded.
    double base_value(Stage, std::string_view param) const;
    bool is_changed(Stage, std::string_view param) const;

    const Edits& edits() const { return edits_; }
    void use(const Technique&);
    void set(Stage, std::string_view param, double value);
    void reset(Stage);  ///< technique and settings
    void reset(Stage, std::string_view param);
    void reset_all();
    void force(std::vector<Feature>);
    void select_frame(std::size_t);
    void set_samples(std::uint32_t);
    void look_from(const EyeMove&);
    /// Chooses these techniques with these settings over their defaults.
    void apply(const ChoiceChanges&);

    /// Consecutive changes of one thing are one step of undo until this says that the hand is off it.
    void settle() { editing_.clear(); }
    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }
    void undo();
    void redo();

    /// Asks for an output with every replay of this frame of the window; begin_frame() forgets.
    void want(const std::string& output) { wanted_.insert(output); }
    void begin_frame() {
        wanted_ = {"display"};
        under.reset();
    }
    Request request() const;
    /// The line for a shell that replays exactly this.
    std::string command_line() const;

private:
    void change(Edits, std::string what);
    void apply_edits();
    Edits with(const Choices&) const;

    std::optional<FrameFacts> facts_;
    Choices recorded_, choices_;
    Edits edits_;
    std::vector<Edits> past_, future_;
    std::string editing_;  ///< what is being changed
    std::set<std::string> wanted_ = {"display"};
};

}  // namespace strata::ui
