// A picture to draw on: rectangles, other pictures, and text in stb_easy_font's letters. Bytes are sRGB.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

using Rgb = glm::u8vec3;

struct Box {
    int x = 0, y = 0, width = 0, height = 0;
};

class Canvas {
public:
    Canvas(int width, int height, Rgb paper);

    int width() const { return width_; }
    int height() const { return height_; }
    const std::vector<Rgb>& pixels() const { return pixels_; }

    /// What lies outside is cut off.
    void fill(Box, Rgb);
    /// One pixel wide, inside the box.
    void outline(Box, Rgb);
    /// Letters 7 `scale` high whose upper left corner is x, y; cut off at `width`. Returns the width of what was drawn.
    int text(std::string_view, Box at, Rgb ink);

    /// Lines below each other, from at.y on. Returns where the next one would stand.
    int text(const std::vector<std::string>& lines, Box at, Rgb ink);

    static constexpr int scale = 2;          ///< of letters
    static constexpr int line = 13 * scale;  ///< from line to line

private:
    int width_, height_;
    std::vector<Rgb> pixels_;
};

/// How often an image is enlarged to be at least so wide, yet no higher than 1080 pixels: one of 17 x 241 would be 7000 high.
int enlargement(int width, int height, int least_width);
/// Pixels that `text` takes.
int text_width(std::string_view);
/// The text in lines that fit into a width, broken at spaces; a longer word is broken where it must.
std::vector<std::string> wrapped(std::string_view, int width);
/// The text, or as much of it as fits with "..." at its end.
std::string shortened(std::string_view, int width);

/// matplotlib's magma (CC0): from black at 0 over violet and orange to a pale yellow at 1.
Rgb magma(double share);

}  // namespace strata
