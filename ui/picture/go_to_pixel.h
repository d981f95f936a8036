// The small window in which a pixel is named to go to.
#pragma once

#include "ui/model.h"
#include "ui/widgets/widgets.h"

namespace strata::ui {

/// "12 34", "12,34" or "12 x 34"; nothing else.
std::optional<glm::ivec2> pixel_of(std::string_view text);

class GoToPixel {
public:
    void open();
    /// Enter pins the pixel and brings it to the middle; Escape closes.
    void draw(Model&, Widgets&, glm::uvec2 extent);

private:
    void ask(Model&, Widgets&, glm::uvec2 extent);

    bool is_open_ = false, takes_focus_ = false;
    std::string text_;
};

}  // namespace strata::ui
