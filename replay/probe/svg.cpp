#include "replay/probe/svg.h"

#include <cmath>

#include <fmt/format.h>

namespace strata::svg {
namespace {

// Not every viewer knows media queries: what they override stands on the elements.
constexpr std::string_view style = R"(<style>
text { font-family: "DejaVu Sans", Verdana, sans-serif; }
@media (prefers-color-scheme: dark) {
  rect.paper { fill: #16181d; }
  .ink { stroke: #e8e8e8; }
  .faint { stroke: #3b3f48; }
  text { fill: #e0e0e0; }
}
</style>
)";

std::string escaped(std::string_view words) {
    std::string safe;
    for (const char c : words) safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return safe;
}

std::string stroke(const Pen& pen) {
    std::string text = fmt::format(R"(class="{}" stroke="{}" stroke-width="{}" fill="none")", pen.css, pen.color, pen.width);
    if (!pen.dash.empty()) text += fmt::format(R"( stroke-dasharray="{}")", pen.dash);
    return text;
}

}  // namespace

Drawing::Drawing(double width, double height) {
    text_ =
        fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" viewBox="0 0 {0} {1}">)", width, height);
    text_ += '\n';
    text_ += style;
    text_ += fmt::format(R"(<rect class="paper" width="{}" height="{}" fill="#ffffff"/>)", width, height) + '\n';
}

void Drawing::line(glm::dvec2 a, glm::dvec2 b, const Pen& pen) {
    text_ += fmt::format(R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" {}/>)", a.x, a.y, b.x, b.y, stroke(pen)) + '\n';
}

void Drawing::polyline(std::span<const glm::dvec2> points, const Box& within, const Pen& pen) {
    const std::size_t clip = ++clips_;
    text_ += fmt::format(R"(<clipPath id="clip{}"><rect x="{}" y="{}" width="{}" height="{}"/></clipPath>)", clip, within.left,
                         within.top, within.width, within.height);
    text_ += fmt::format(R"svg(<polyline clip-path="url(#clip{})" stroke-linejoin="round" {} points=")svg", clip, stroke(pen));
    for (const glm::dvec2& p : points)
        if (std::isfinite(p.x) && std::isfinite(p.y)) text_ += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
    text_ += "\"/>\n";
}

void Drawing::frame(const Box& box) {
    text_ += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" {}/>)", box.left, box.top, box.width, box.height,
                         stroke({.color = "#333", .css = "ink"})) +
             '\n';
}

void Drawing::dot(glm::dvec2 at, double radius, const std::string& fill) {
    text_ += fmt::format(R"(<circle class="ink" cx="{:.1f}" cy="{:.1f}" r="{}" fill="{}" stroke="#333" stroke-width="0.8"/>)",
                         at.x, at.y, radius, fill) +
             '\n';
}

void Drawing::text(glm::dvec2 at, std::string_view words, Anchor anchor, double size) {
    constexpr std::string_view anchors[] = {"start", "middle", "end"};
    text_ += fmt::format(R"(<text x="{:.1f}" y="{:.1f}" font-size="{}" text-anchor="{}" fill="#222">{}</text>)", at.x, at.y, size,
                         anchors[static_cast<std::size_t>(anchor)], escaped(words)) +
             '\n';
}

void Drawing::upright_text(glm::dvec2 at, std::string_view words) {
    text_ += fmt::format(R"svg(<text transform="translate({:.1f} {:.1f}) rotate(-90)" font-size="12" )svg", at.x, at.y);
    text_ += fmt::format(R"(text-anchor="middle" fill="#222">{}</text>)", escaped(words)) + '\n';
}

std::string Drawing::take() { return text_ + "</svg>\n"; }

std::vector<double> ticks(double low, double high, Spacing spacing) {
    std::vector<double> found;
    if (spacing == Spacing::logarithmic && high / low > 8) {
        for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10)
            for (const double digit : {1., 2., 5.})
                if (digit * decade >= low && digit * decade <= high) found.push_back(digit * decade);
        return found;
    }
    const double rough = (high - low) / 6, decade = std::pow(10, std::floor(std::log10(rough))), share = rough / decade;
    const double step = (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10) * decade;
    // From whole numbers of steps: sums would show their rounding.
    for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) found.push_back(i * step + 0.);  // no -0
    return found;
}

}  // namespace strata::svg
