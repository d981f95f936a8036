// What F1 shows: every key and what the mouse does, in as many columns as the window needs.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ui/widgets/widgets.h"

namespace strata::ui {

struct KeyRow {
    std::string_view chord;  ///< "ctrl+z", or what the mouse does
    std::string_view help;
};

struct KeySection {
    std::string_view name;
    std::vector<KeyRow> rows;
};

/// Keys of one meaning in one row: "Left  Right  Up  Down". A run of more than four is "1 ... 9".
struct JoinedKeys {
    std::string_view first, help;
    std::string keys;  ///< for people
};
std::vector<JoinedKeys> joined(std::span<const KeyRow>);

/// What the mouse does in a picture.
KeySection mouse_gestures();

/// In the middle of the window; each row is a widget "keys/CHORD".
void draw_keys_list(Widgets&, const std::vector<KeySection>&);

}  // namespace strata::ui
