// What stands beside a view that is selected: legend, parameters, a slice of its values, the rows of the technique's tables that
// are a pixel's, what overflowed, waves per SIMD, the tables.
#pragma once

#include <map>
#include <string>

#include "ui/panel.h"
#include "ui/picture/mode_waves.h"
#include "ui/picture/views.h"
#include "ui/replayer/keyed.h"

namespace strata::ui {

struct ViewChoice {
    const Technique* technique = nullptr;
    const DebugView* view = nullptr;                        ///< null: none is selected
    std::shared_ptr<const TechniqueViews> found = nullptr;  ///< null until they are there
    MadeOf made_of = {};                                    ///< what was found
};

/// "black 0, white 64 lights"; of colors that mean something else each what the help says.
std::string legend_text(const DebugView&);

/// How a view is shown at first.
Look look_of(const DebugView&);

class ViewReadouts {
public:
    /// What its jobs gave since the last frame.
    void take_results(Model&);
    void draw(Model&, Services&, const ViewChoice&);
    bool is_busy() const { return slice_job_ != nullptr || waves_job_ != nullptr; }

private:
    void draw_slice(Model&, Services&, const ViewChoice&);
    void make_slice(Model&, Services&);
    void draw_numbers(const Model&, Services&, const ViewChoice&);
    void draw_waves(Model&, Services&, const ViewChoice&);
    void draw_waves_result(Model&, Services&, const Technique&);
    void start_waves(const Model&, Services&, const Technique&);
    void draw_waves_of(Model&, Widgets&, const TileWaves&);
    void draw_tables(Widgets&, const Technique&, const TechniqueViews&);

    /// What a slice was made of.
    struct Slice {
        std::shared_ptr<const HostImage> image;
        double at = 0, half = 0;
        friend bool operator==(const Slice&, const Slice&) = default;
    };
    std::string sliced_;  ///< the output of which a slice is shown, or empty
    double at_ = 0, half_ = 0;
    Slice made_;
    MadeOf sliced_of_;
    JobOf<std::shared_ptr<const HostImage>> slice_job_;

    /// What waves are of.
    struct WavesOf {
        const Technique* technique = nullptr;
        const GpuModel* gpu = nullptr;
        MadeOf made_of;
        friend bool operator==(const WavesOf&, const WavesOf&) = default;
    };
    const GpuModel* gpu_ = nullptr;
    WavesOf waves_asked_;
    JobOf<TileWaves> waves_job_;
    Keyed<WavesOf, std::shared_ptr<const TileWaves>> waves_;
    std::string waves_error_;  ///< of what was asked last

    std::map<std::string, PlotView> plots_;  ///< of the tables that are curves
};

}  // namespace strata::ui
