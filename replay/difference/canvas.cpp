#include "replay/difference/canvas.h"

#include <algorithm>
#include <array>
#include <string>

#include <stb/stb_easy_font.h>

namespace strata {

Canvas::Canvas(int width, int height, Rgb paper)
    : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), paper) {}

void Canvas::fill(Box box, Rgb color) {
    const int right = std::min(box.x + box.width, width_), bottom = std::min(box.y + box.height, height_);
    for (int y = std::max(0, box.y); y < bottom; ++y)
        for (int x = std::max(0, box.x); x < right; ++x)
            pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)] = color;
}

void Canvas::outline(Box box, Rgb color) {
    fill({box.x, box.y, box.width, 1}, color);
    fill({box.x, box.y + box.height - 1, box.width, 1}, color);
    fill({box.x, box.y, 1, box.height}, color);
    fill({box.x + box.width - 1, box.y, 1, box.height}, color);
}

int enlargement(int width, int height, int least_width) {
    constexpr int most_enlarged_height = 1080;
    return std::max(1, std::min((least_width + width - 1) / width, most_enlarged_height / height));
}

int text_width(std::string_view text) {
    std::string copy(text);
    return stb_easy_font_width(copy.data()) * Canvas::scale;
}

std::vector<std::string> wrapped(std::string_view text, int width) {
    std::vector<std::string> lines(1);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' ', 1), text.size());  // of a word with the space before it
        const std::string word(text.substr(0, end));
        text.remove_prefix(end);
        if (text_width(lines.back() + word) <= width) {
            lines.back() += word;
            continue;
        }
        lines.emplace_back();
        for (const char letter : word.substr(word.find_first_not_of(' ') == 1 ? 1 : 0)) {
            if (text_width(lines.back() + letter) > width) lines.emplace_back();
            lines.back() += letter;
        }
    }
    if (lines.size() > 1 && lines.front().empty()) lines.erase(lines.begin());
    return lines;
}

std::string shortened(std::string_view text, int width) {
    std::string kept(text);
    if (text_width(kept) <= width) return kept;
    while (!kept.empty() && text_width(kept + "...") > width) kept.pop_back();
    return kept + "...";
}

int Canvas::text(std::string_view text, Box at, Rgb ink) {
    std::string copy(text);
    while (!copy.empty() && text_width(copy) > at.width) copy.pop_back();
    // Every letter is a few rectangles of four corners each; the longest text of a picture has some 3000.
    struct Corner {
        float x, y, z;
        std::array<unsigned char, 4> color;
    };
    std::vector<Corner> corners(4 * 40 * (copy.size() + 1));
    const int boxes =
        stb_easy_font_print(0, 0, copy.data(), nullptr, corners.data(), static_cast<int>(corners.size() * sizeof(Corner)));
    for (int i = 0; i < boxes; ++i) {
        const Corner &from = corners[static_cast<std::size_t>(4 * i)], &to = corners[static_cast<std::size_t>(4 * i + 2)];
        const int x = static_cast<int>(from.x), y = static_cast<int>(from.y);
        fill({at.x + x * scale, at.y + y * scale, (static_cast<int>(to.x) - x) * scale, (static_cast<int>(to.y) - y) * scale},
             ink);
    }
    return text_width(copy);
}

int Canvas::text(const std::vector<std::string>& lines, Box at, Rgb ink) {
    for (const std::string& each : lines) {
        text(each, at, ink);
        at.y += line;
    }
    return at.y;
}

Rgb magma(double share) {
    static constexpr Rgb stops[] = {{0, 0, 4},      {28, 16, 68},   {79, 18, 123},   {129, 37, 129}, {181, 54, 122},
                                    {229, 80, 100}, {251, 135, 97}, {254, 194, 135}, {252, 253, 191}};
    const double at = std::clamp(share, 0., 1.) * 8;
    const auto below = std::min<std::size_t>(7, static_cast<std::size_t>(at));
    return Rgb(glm::mix(glm::dvec3(stops[below]), glm::dvec3(stops[below + 1]), at - double(below)) + .5);
}

}  // namespace strata
