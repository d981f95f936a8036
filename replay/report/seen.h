// How people see an error of display light, by its size.
#pragma once

#include <span>

namespace strata {

/// Errors from `from` on (of white, root mean square over a picture) up to the next class's, in words: "not seen".
struct SeenClass {
    double from = 0;
    const char* words = "";
};
/// Six, from small to large; medians over 143 pairs of pictures, judged by one person.
std::span<const SeenClass> seen_classes();
const SeenClass& seen_as(double error);

}  // namespace strata
