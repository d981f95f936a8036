// What stands beside the rows of the panel Frame, in one or two columns: times over bars of their share, memory, or work.
#pragma once

#include "ui/frame/frame_rows.h"
#include "ui/widgets/widgets.h"

namespace strata::ui {

/// A frame as it is drawn now.
struct ShownFrame {
    const Replay& replay;
    const FrameTimes* times;  ///< null: nothing was measured
    bool is_stale;            ///< they are of the frame before the last change
    FrameRows rows;
};

class FrameColumns {
public:
    static constexpr int count = 2;

    /// At the right end of the line.
    void draw_choice(Widgets&);
    /// As the next columns of the table; times that were not measured leave their room to the names.
    void set_up(const ShownFrame&) const;
    void draw_pass(Widgets&, const ShownFrame&, const FramePass&, int column) const;
    void draw_step(Widgets&, const ShownFrame&, std::string_view label, std::size_t step, int column) const;

private:
    enum class Beside : std::size_t { time, memory, work };
    Beside beside_ = Beside::time;
};

}  // namespace strata::ui
