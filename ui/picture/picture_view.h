// Pictures on the screen: where they lie, how the mouse moves them, their grid, their numbers and the pinned pixel. Every view of
// the inspector is made of these, so all of them look and move alike.
#pragma once

#include <optional>
#include <string_view>

#include "ui/model.h"
#include "ui/picture/picture.h"
#include "ui/widgets/widgets.h"

namespace strata::ui {

/// A picture in a rectangle of the window.
struct Placement {
    ImVec2 from, to;  ///< the rectangle
    ImVec2 corner;    ///< of the picture's first texel: a whole pixel
    double zoom = 1;  ///< pixels per texel
    std::uint32_t width = 0, height = 0;

    ImVec2 on_screen(double x, double y) const;
    /// The texel at a point of the window; it may lie outside of the picture.
    glm::ivec2 texel_at(ImVec2) const;
};

Placement place(const PictureView&, ImVec2 from, ImVec2 size, const Texels&);
/// The middle of the pixel that the mouse is on: Dear ImGui gives its corner, where two texels may meet.
ImVec2 mouse_point();
/// Wheel, drag and double click on the last widget.
void move_by_mouse(PictureView&, const Placement&);
/// Around the middle of the view.
void zoom_by(PictureView&, const Placement&, double factor);

/// Draws the part of the picture between two columns of the window (a wipe), the whole of it by default.
struct Columns {
    float from = -1e9f, to = 1e9f;
};
void draw_picture(ImguiLayer&, const Placement&, TextureId, const Look&, const Columns& = {});
/// Lines between texels from 8 pixels each, their values where these fit.
void draw_details(const Placement&, const PictureInfo&);
/// Whether draw_details() has room for the numbers of a one-channel picture.
bool shows_numbers(const Placement&);
void draw_pin(const Placement&, glm::ivec2);

/// "0.25 0.5 1 1": as many as the image has channels.
std::string values_text(const PictureInfo&, glm::ivec2 texel);
/// A technique's view by "stage/technique:view"; null where there is none.
const DebugView* find_view(const std::string& name);
/// How an image is shown when nobody said otherwise.
Look default_look(const std::string& name, const PictureInfo&);

}  // namespace strata::ui
