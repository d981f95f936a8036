// Pictures and tables of what is inside a technique.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

class Graph;         // passes/graph/graph.h
class Settings;      // passes/settings.h
struct FrameImages;  // passes/frame_images.h
struct Image;        // passes/graph/step.h

/// What a color of a view stands for.
struct ViewColor {
    glm::vec3 color;  ///< as the view writes it, 0 to 1
    std::string meaning;
};

/// A picture of a technique's inside. `declare` makes it as an rgba32f image of the frame's extent with one layer.
struct DebugView {
    std::string_view name, help, unit;
    double low = 0, high = 1;  ///< shown from black to white, in unit
    Image (*declare)(Graph&, FrameImages&, const Settings&) = nullptr;
    std::array<std::string_view, 3> channels = {};  ///< what red, green and blue show; empty: all show one number
    std::vector<ViewColor> colors = {};             ///< of a view without a scale: what its colors stand for
    std::string_view if_zero = {};                  ///< the sentence for people where every pixel is 0: "nothing is culled"
};

struct TableColumn {
    std::string_view name, unit;
};

/// Numbers of a technique's inside, for JSON and curves. `declare` makes them as an rgba32f image one texel wide: a row of the
/// table per texel, a column per channel. A row that begins with NaN is none.
struct DebugTable {
    std::string_view name, help;
    std::vector<TableColumn> columns;  ///< 1 to 4
    std::uint32_t tile = 0;            ///< pixels a side of the tiles, counted row by row, of column "tile"; 0: it has none
    Image (*declare)(Graph&, FrameImages&, const Settings&) = nullptr;
    bool is_curves = false;  ///< the columns are curves over the first one
};

}  // namespace strata
