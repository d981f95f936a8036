// Where two pictures are looked at: with a divider between them, beside each other, in turn, or as a map of what differs. All of
// them move together, by the view that every picture of the inspector has.
#pragma once

#include <optional>
#include <string>

#include "ui/panel.h"
#include "ui/picture/picture_view.h"

namespace strata::ui {

enum class CompareMode { wipe, side_by_side, flip, difference, relative, flip_map };

struct CanvasPicture {
    const PictureInfo* info = nullptr;  ///< null: none yet
    TextureId texture = 0;
    Look look = {};
    std::string label = {};
};

struct ComparedView {
    CompareMode mode = CompareMode::wipe;
    CanvasPicture a, b, map;
    ImVec2 size;
};

class CompareCanvas {
public:
    void draw(const ComparedView&, Model&, Services&);

    /// The texel under the mouse.
    const std::optional<glm::ivec2>& under() const { return under_; }
    /// Brings a texel to the middle, large enough to be seen.
    void go_to(PictureView&, glm::ivec2 texel) const;
    void flip(bool to_b) { shows_b_ = to_b; }
    bool shows_b() const { return shows_b_; }

private:
    struct Cell {
        std::string_view label;
        ImVec2 size;
    };
    void draw_one(const Cell&, const CanvasPicture&, Model&, Services&);
    void draw_wipe(const ComparedView&, Model&, Services&);
    /// Whether the hand is at the divider and not at the pictures.
    bool pull_divider(ImVec2 from, float width);
    void take_mouse(Model&, const PictureInfo&);
    void draw_marks(const Model&, const PictureInfo&) const;

    Placement placement_;
    std::optional<glm::ivec2> under_, was_under_;
    float divider_ = .5f;  ///< share of the width that is A's
    bool shows_b_ = false, is_pulled_ = false;
};

}  // namespace strata::ui
