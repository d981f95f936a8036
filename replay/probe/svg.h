// Lines, words and scales of a plot as SVG: legible on paper and, where the viewer says it is dark, on black.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace strata::svg {

/// Where a panel is, in pixels.
struct Box {
    double left = 0, top = 0, width = 1, height = 1;
    double right() const { return left + width; }
    double bottom() const { return top + height; }
};

/// How a line looks; the class says what becomes of it in the dark.
struct Pen {
    std::string_view color = "#333", css = "ink";
    double width = 1;
    std::string_view dash = "";
};

enum class Anchor { start, middle, end };

/// The drawing so far. Colors named by `css` class "ink", "faint" and "paper" turn round in the dark.
class Drawing {
public:
    Drawing(double width, double height);
    void line(glm::dvec2 a, glm::dvec2 b, const Pen&);
    /// Cut off outside the box.
    void polyline(std::span<const glm::dvec2>, const Box& within, const Pen&);
    void frame(const Box&);
    void dot(glm::dvec2, double radius, const std::string& fill);
    void text(glm::dvec2, std::string_view words, Anchor = Anchor::start, double size = 12);
    void upright_text(glm::dvec2, std::string_view words);
    std::string take();

private:
    std::string text_;
    std::size_t clips_ = 0;
};

/// 5 to 10 round numbers from low to high: evenly, or 1, 2, 5 of each decade where `logarithmic` and the range is wide.
enum class Spacing { even, logarithmic };
std::vector<double> ticks(double low, double high, Spacing);

}  // namespace strata::svg
