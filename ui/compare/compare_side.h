// One side of a comparison: what is wished there, and how it comes from the session or from a file without anybody waiting.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "ui/compare/compare_pictures.h"
#include "ui/panel.h"
#include "ui/replayer/keyed.h"

namespace strata::ui {

enum class Source {
    replay,       ///< what the whole inspector shows
    recorded,     ///< with the recorded choices
    kept,         ///< an earlier replay that was kept
    variant,      ///< with another technique or other settings of a stage
    expectation,  ///< what the capture expects of the recorded choices
    truth,        ///< of a stage, on what the stages before it gave to the other side
    file,
};

/// Which image is compared, and when: as a stage left it, or at the end of the frame.
struct Subject {
    std::string image = "display";
    std::optional<Stage> after = std::nullopt;
    friend bool operator==(const Subject&, const Subject&) = default;
};

struct SideWish {
    Source source = Source::replay;
    Subject subject;
    Request request;            ///< the replay; of a truth: the replay that it is the truth of
    std::string file = {};      ///< path
    std::uint64_t shaders = 0;  ///< see Replayer::shaders()
    friend bool operator==(const SideWish&, const SideWish&) = default;
};

/// The request with one stage done by this technique with exactly these settings.
Request variant_of(Request, const Technique&, const Settings&);
/// The last stage of the frame that writes the image and knows its truth.
std::optional<Stage> stage_of_truth(const std::string& image, std::span<const SkippedStage>);

/// What the capture expects of the request, from this device where there is such an expectation.
Result<SidePicture> expected_picture(Session&, Request, const Subject&);

class ComparedSide {
public:
    /// `place` of Replayer::show().
    explicit ComparedSide(std::string place) : place_(std::move(place)) {}

    /// Once per frame. What takes the session seconds begins when no widget is held.
    void show(const SideWish&, Services&);
    /// The last that was ready; `shown` says of what.
    const SidePicture& picture() const { return picture_.value() ? *picture_.value() : none_; }
    const SideWish* shown() const { return picture_.key(); }
    bool is_of(const SideWish& wish) const { return picture_.is_of(wish); }
    /// Why there is no picture.
    const std::string& message() const { return message_; }
    bool is_busy() const { return busy_; }

private:
    void show_replay(const SideWish&, Services&);
    void show_job(const SideWish&, Services&);
    void start(const SideWish&, Services&);

    std::string place_, message_;
    std::optional<SideWish> wish_;  ///< of the job
    JobOf<SidePicture> job_;
    Keyed<SideWish, SidePicture> picture_;
    SidePicture none_;
    bool busy_ = false;
};

}  // namespace strata::ui
