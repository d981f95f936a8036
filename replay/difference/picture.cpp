#include "replay/difference/picture.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "capture_format/srgb.h"
#include "replay/images/image_io.h"

namespace strata {
namespace {

constexpr Rgb paper(24, 24, 28), ink(235, 235, 235), faint(150, 150, 155), not_a_number(255, 0, 255), mark(255, 210, 0);
constexpr int gap = 12, bar_height = 12;
// Panels are at least this wide: letters and a pixel's frame can then be seen.
constexpr int least_width = 480;

struct Texels {
    int width = 0, height = 0;
    Content content = Content::numbers;
    std::uint32_t channels = 4;
    std::vector<glm::dvec3> values;
    std::vector<double> alpha = {};
    double least = 0, most = 0;  ///< of all channels of the texels that are finite; 0 where none is
    std::size_t finite_texels = 0;
};

bool finite(const glm::dvec3& v) { return std::isfinite(v.x + v.y + v.z); }

void find_ends(Texels& texels) {
    for (const glm::dvec3& v : texels.values) {
        if (!finite(v)) continue;
        const double least = std::min({v.x, v.y, v.z}), most = std::max({v.x, v.y, v.z});
        texels.least = texels.finite_texels == 0 ? least : std::min(texels.least, least);
        texels.most = texels.finite_texels == 0 ? most : std::max(texels.most, most);
        ++texels.finite_texels;
    }
}

/// The part of an image that is shown: samples of light averaged, of anything else one layer.
Texels texels_of(std::string_view name, const HostImage& image, std::uint32_t layer_shown) {
    const Extent& extent = image.shape.extent;
    Texels shown{static_cast<int>(extent.width),
                 static_cast<int>(extent.height),
                 content_of(name, image.shape.format),
                 row(image.shape.format).channels,
                 {}};
    const bool light = shown.content == Content::radiance || shown.content == Content::display;
    const std::uint32_t first = light ? 0 : layer_shown, count = light ? image.shape.layers : 1;
    for (std::uint32_t y = 0; y < extent.height; ++y)
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            glm::dvec4 sum(0);
            for (std::uint32_t layer = first; layer < first + count; ++layer) sum += glm::dvec4(texel(image, x, y, layer));
            shown.values.push_back(glm::dvec3(sum) / double(count));
            shown.alpha.push_back(sum.w / double(count));
            if (shown.channels == 1) shown.values.back() = glm::dvec3(shown.values.back().x);
        }
    find_ends(shown);
    return shown;
}

/// The alpha of an image as an image of one channel.
Texels alpha_of(const Texels& all) {
    Texels shown{all.width, all.height, Content::numbers, 1, {}};
    for (double alpha : all.alpha) shown.values.push_back(glm::dvec3(alpha));
    find_ends(shown);
    return shown;
}

/// The value up to which a share of all finite channels lies: of few values the larger neighbor. 0 where none is finite.
double quantile(const std::vector<glm::dvec3>& values, double share) {
    std::vector<double> all;
    all.reserve(3 * values.size());
    for (const glm::dvec3& v : values)
        if (finite(v)) all.insert(all.end(), {v.x, v.y, v.z});
    if (all.empty()) return 0;
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(std::ceil(share * double(all.size() - 1)));
    std::ranges::nth_element(all, at);
    return *at;
}

Rgb byte_rgb(const glm::dvec3& v) {
    return {std::to_integer<std::uint8_t>(unorm8(v.x)), std::to_integer<std::uint8_t>(unorm8(v.y)),
            std::to_integer<std::uint8_t>(unorm8(v.z))};
}

Rgb light_rgb(const glm::dvec3& v) {
    return {std::to_integer<std::uint8_t>(display_byte(v.x)), std::to_integer<std::uint8_t>(display_byte(v.y)),
            std::to_integer<std::uint8_t>(display_byte(v.z))};
}

using ColorOf = std::function<Rgb(std::size_t texel)>;

/// One channel: red where B is more, blue where it is less. Several: how far apart each is.
Rgb difference_color(const glm::dvec3& a, const glm::dvec3& b, double gain, std::uint32_t channels) {
    const glm::dvec3 apart = (b - a) * gain;
    if (!finite(a) || !finite(b)) return not_a_number;
    if (channels > 1) return byte_rgb(glm::abs(apart));
    return byte_rgb(apart.x > 0 ? glm::dvec3(apart.x, apart.x * .35, 0) : glm::dvec3(0, -apart.x * .45, -apart.x));
}

/// How the values of both images become colors: from `low` to `high` of A.
struct Range {
    double low = 0, high = 1;
    Content content = Content::numbers;
    std::optional<double> middle = {};  ///< of one number: red above, blue below

    Rgb color(const glm::dvec3& v) const {
        if (!finite(v)) return not_a_number;
        if (middle) return difference_color(glm::dvec3(*middle), v, 1 / std::max(high - *middle, *middle - low), 1);
        const glm::dvec3 share = (v - low) / (high - low);
        return content == Content::radiance ? light_rgb(share) : byte_rgb(share);
    }
};

/// Display light is shown as it is; radiance up to what 99 % of it are below; the rest between its least and largest value.
Range range_of(const Texels& a, Format format) {
    if (a.content == Content::display)
        return {0, 1, row(format).bytes == row(format).channels ? Content::numbers : Content::radiance};
    const double high = a.content == Content::radiance ? quantile(a.values, .99) : a.most,
                 low = a.content == Content::radiance ? 0 : a.least;
    const Content shown = a.content == Content::radiance ? Content::radiance : Content::numbers;
    const auto [begin, end] = scale_ends(low, high);
    return {begin, end, shown};
}

/// A power of two that brings the difference that 99.5 % of the pixels that differ are below to about white.
double gain_of(const Texels& a, const Texels& b) {
    std::vector<glm::dvec3> apart;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        if (a.values[i] != b.values[i]) apart.push_back(glm::abs(b.values[i] - a.values[i]));
    const double most = quantile(apart, .995);
    return most > 0 ? std::exp2(std::floor(std::log2(1 / most))) : 1;
}

/// That many digits, and all those of a whole number that has more: 1388, not 1.39e+03.
std::string text_of(double value, int digits) {
    const bool is_long = std::abs(value) >= std::pow(10, digits) && std::abs(value) < 1e7;
    return is_long ? fmt::format("{:.0f}", value) : fmt::format("{:.{}g}", value, digits);
}

struct Panel {
    std::string key, label;
    ColorOf color;
    std::function<Rgb(double share)> legend = {};  ///< null: none
    std::string low = {}, high = {}, note = {};    ///< numbers at the ends of the legend, and what stands between them
    double note_at = .5;                           ///< share of the legend at which the note is centered
    bool has_tick = false;                         ///< at note_at
};

/// One pixel a texel.
Canvas canvas_of(const Texels& size, const ColorOf& color) {
    Canvas canvas(size.width, size.height, paper);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            canvas.fill({x, y, 1, 1},
                        color(static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x)));
    return canvas;
}

/// How often an image is enlarged, and how wide its panel is.
int zoom_of(const Texels& image) { return enlargement(image.width, image.height, least_width); }
int panel_width(const Texels& image) { return std::max(least_width, image.width * zoom_of(image)); }

/// A frame around a pixel of the panel's image, whose upper left corner and enlargement are given.
void draw_mark(Canvas& canvas, int left, int top, int zoom, const WorstPixel& worst) {
    const int around = 3 * std::max(zoom, 3);
    const Box frame{left + static_cast<int>(worst.x) * zoom + zoom / 2 - around,
                    top + static_cast<int>(worst.y) * zoom + zoom / 2 - around, 2 * around + 1, 2 * around + 1};
    canvas.outline(frame, mark);
    canvas.outline({frame.x - 1, frame.y - 1, frame.width + 2, frame.height + 2}, {0, 0, 0});
}

/// The panel's image with a pixel framed where one is the worst, its label above and its legend below.
void draw(Canvas& canvas, const Panel& panel, Box box, const Texels& size, const WorstPixel* worst) {
    const int zoom = zoom_of(size);
    canvas.text(shortened(panel.label, box.width), {box.x, box.y, box.width, 0}, ink);
    const int top = box.y + Canvas::line;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            canvas.fill(
                {box.x + x * zoom, top + y * zoom, zoom, zoom},
                panel.color(static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x)));
    if (worst) draw_mark(canvas, box.x, top, zoom, *worst);
    if (!panel.legend) return;
    const int bar = top + size.height * zoom + 6;
    for (int x = 0; x < box.width; ++x) canvas.fill({box.x + x, bar, 1, bar_height}, panel.legend(double(x) / (box.width - 1)));
    canvas.outline({box.x, bar, box.width, bar_height}, faint);
    const int text = bar + bar_height + 4;
    canvas.text(panel.low, {box.x, text, box.width, 0}, faint);
    canvas.text(panel.high, {box.x + box.width - text_width(panel.high), text, box.width, 0}, faint);
    const int center = box.x + static_cast<int>(panel.note_at * (box.width - 1)), begin = center - text_width(panel.note) / 2;
    if (panel.has_tick) canvas.fill({center, bar, 1, bar_height + 4}, ink);
    const int first = box.x + text_width(panel.low) + gap, last = box.x + box.width - text_width(panel.high) - gap;
    if (begin >= first && begin + text_width(panel.note) <= last) canvas.text(panel.note, {begin, text, box.width, 0}, ink);
}

/// Beyond an end of the legend values have the end's color, and the end says so.
Panel image_panel(const std::string& key, const std::string& label, const Texels& texels, const Range& range,
                  const std::string& unit = "") {
    const double step = (range.high - range.low) / 255;  // less is no other color
    const bool below = range.low - texels.least > step;
    const bool above = texels.most - range.high > step;
    Panel panel{key,
                label,
                [&texels, range](std::size_t i) { return range.color(texels.values[i]); },
                [range](double share) { return range.color(glm::dvec3(range.low + share * (range.high - range.low))); },
                (below ? "<= " : "") + text_of(range.low, 3) + unit,
                (above ? ">= " : "") + text_of(range.high, 3) + unit};
    if (!range.middle) return panel;
    panel.note = text_of(*range.middle, 3);
    panel.note_at = (*range.middle - range.low) / (range.high - range.low);
    panel.has_tick = true;
    return panel;
}

Panel difference_panel(const std::string& key, const Texels& a, const Texels& b) {
    const double gain = gain_of(a, b);
    const std::uint32_t channels = a.channels;
    bool less = false, more = false;  // than the legend's ends, by what is another color
    for (std::size_t i = 0; i < a.values.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double apart = (b.values[i][c] - a.values[i][c]) * gain;
            more |= (channels > 1 ? std::abs(apart) : apart) > 1 + 1 / 255.;
            less |= apart < -1 - 1 / 255.;
        }
    const std::string scaled = gain < 1 ? fmt::format("/ {:g}", 1 / gain) : fmt::format("x {:g}", gain);
    return {key,
            fmt::format("{}{} {}", key == "alpha" ? "alpha: " : "", channels > 1 ? "abs(B - A)" : "B - A", scaled),
            [&a, &b, gain, channels](std::size_t i) { return difference_color(a.values[i], b.values[i], gain, channels); },
            [gain, channels](double share) {
                const double v = channels > 1 ? share : 2 * share - 1;
                return difference_color(glm::dvec3(0), glm::dvec3(v / gain), gain, channels);
            },
            channels > 1 ? "0" : (less ? "<= " : "") + text_of(-1 / gain, 3),
            (more ? ">= " : "") + text_of(1 / gain, 3)};
}

/// Of a debug view from its lowest value on, of anything else as in a difference.
Range range_of(const Texels& shown, Format format, const ImageLegend& legend) {
    if (!legend.colors.empty()) return {0, 1};
    if (!legend.low) return range_of(shown, format);
    const double high = shown.most;
    if (legend.middle) {
        const double reach = std::max({high - *legend.middle, *legend.middle - shown.least, 1e-6});
        // What no value of the view can be is no part of the scale: a factor is not below 0.
        const double low = std::max(*legend.middle - reach, std::min(*legend.low, shown.least));
        return {low, *legend.middle + reach, Content::numbers, legend.middle};
    }
    const double low = std::min(*legend.low, shown.least);
    return {low, high > low ? high : low + 1};
}

/// What the values of an image say of themselves, in a sentence.
std::string values_note(const Texels& shown, const ImageLegend& legend) {
    const std::string unit = legend.unit.empty() ? "" : " " + legend.unit;
    const double least = shown.least, most = shown.most;
    if (shown.finite_texels == 0) return "every pixel is NaN or infinite";
    std::string note = fmt::format("values {} to {}{}", text_of(least, 4), text_of(most, 4), unit);
    if (least == most) note = fmt::format("every pixel is {}{}", text_of(least, 4), unit);
    if (least == most && least == 0 && !legend.if_zero.empty()) note = legend.if_zero;
    if (shown.finite_texels < shown.values.size()) note += ", magenta: NaN or infinite";
    return note;
}

/// Those of the colors that the image shows.
std::vector<Swatch> seen_in(const Texels& shown, const Range& range, const std::vector<Swatch>& colors) {
    std::vector<Swatch> seen;
    for (const Swatch& swatch : colors)
        if (std::ranges::any_of(shown.values, [&](const glm::dvec3& v) {
                return glm::all(
                    glm::lessThanEqual(glm::abs(glm::ivec3(range.color(v)) - glm::ivec3(swatch.color)), glm::ivec3(1)));
            }))
            seen.push_back(swatch);
    return seen;
}

/// Whether a pixel shows two of the channels that have a meaning at once: its color is no swatch's.
bool mixes_channels(const Texels& shown, const Range& range, const std::vector<Swatch>& channels) {
    return std::ranges::any_of(shown.values, [&](const glm::dvec3& v) {
        const auto seen = std::ranges::count_if(channels, [&](const Swatch& swatch) {
            const glm::ivec3 both = glm::min(glm::ivec3(range.color(v)), glm::ivec3(swatch.color));
            return std::max({both.x, both.y, both.z}) > 25;
        });
        return finite(v) && seen > 1;
    });
}

/// What a channel's color stands for, and what the channel's values lie between: one that is small beside another is not seen.
std::string channel_text(const Texels& shown, const Swatch& channel) {
    const glm::length_t c = channel.color.x > 0 ? 0 : channel.color.y > 0 ? 1 : 2;
    Texels one;
    for (const glm::dvec3& v : shown.values) one.values.emplace_back(v[c]);
    find_ends(one);
    return fmt::format("{} ({} to {})", channel.meaning, text_of(one.least, 3), text_of(one.most, 3));
}

constexpr int swatch_width = 2 * Canvas::line;

/// A line of text below an image, beside a swatch or not.
struct Line {
    std::string text;
    Rgb color;
    int indent = 0;
    std::optional<Rgb> swatch = {};
};

/// What stands below an image: its values, the colors that have a meaning, the sentence about it.
std::vector<Line> lines_below(const Texels& shown, const ImageLegend& legend, const Range& range, int width) {
    std::vector<Line> lines;
    if (legend.colors.empty())
        for (const std::string& text : wrapped(values_note(shown, legend), width)) lines.push_back({text, ink});
    constexpr int indent = swatch_width + gap;
    std::vector<Swatch> swatches = seen_in(shown, range, legend.colors);
    if (legend.colors.empty())
        for (const Swatch& channel : legend.channels) swatches.push_back({channel.color, channel_text(shown, channel)});
    for (const Swatch& swatch : swatches) {
        std::optional<Rgb> color = swatch.color;
        for (const std::string& text : wrapped(swatch.meaning, width - indent))
            lines.push_back({text, ink, indent, std::exchange(color, std::nullopt)});
    }
    if (legend.colors.empty() && mixes_channels(shown, range, legend.channels))
        for (const std::string& text : wrapped("mixed colors: several at one pixel", width)) lines.push_back({text, ink});
    if (!legend.help.empty())
        for (const std::string& text : wrapped(legend.help, width)) lines.push_back({text, faint});
    return lines;
}

}  // namespace

std::pair<double, double> scale_ends(double low, double high) {
    if (high > low) return {low, high};
    return {std::min(low, 0.), low > 0 ? low : low + 1};
}

Result<void> write_png(const std::filesystem::path& path, const Canvas& canvas) {
    const Extent extent{static_cast<std::uint32_t>(canvas.width()), static_cast<std::uint32_t>(canvas.height()), 1};
    return write_png(path, extent, std::as_bytes(std::span(canvas.pixels())));
}

Canvas image_picture(std::string_view name, const HostImage& image, const std::string& title, const ImageLegend& legend) {
    const Texels shown = texels_of(name, image, 0);
    const Range range = range_of(shown, image.shape.format, legend);
    const std::string unit = legend.unit.empty() ? "" : " " + legend.unit;
    const bool is_averaged = shown.content == Content::radiance || shown.content == Content::display;
    std::string label(name);
    if (image.shape.layers > 1 && !is_averaged) label += fmt::format(", layer 0 of {}", image.shape.layers);
    const int width = panel_width(shown);
    Panel panel = image_panel("", label, shown, range, unit);
    if (!legend.colors.empty()) panel.legend = nullptr;

    const std::vector<std::string> titles = wrapped(title, width);
    const std::vector<Line> lines = lines_below(shown, legend, range, width);
    const int top = 2 * gap + static_cast<int>(titles.size()) * Canvas::line;
    int below = top + Canvas::line + shown.height * zoom_of(shown) + (panel.legend ? bar_height + 10 + Canvas::line : gap);
    Canvas canvas(width + 2 * gap, below + static_cast<int>(lines.size()) * Canvas::line + gap, paper);
    canvas.text(titles, {gap, gap, width, 0}, mark);
    draw(canvas, panel, {gap, top, width, 0}, shown, nullptr);
    for (const Line& line : lines) {
        if (line.swatch) {
            canvas.fill({gap, below, swatch_width, Canvas::line - 6}, *line.swatch);
            canvas.outline({gap, below, swatch_width, Canvas::line - 6}, faint);
        }
        canvas.text(line.text, {gap + line.indent, below, width - line.indent, 0}, line.color);
        below += Canvas::line;
    }
    return canvas;
}

PlainPicture plain_picture(std::string_view name, const HostImage& image, const ImageLegend& legend) {
    const Texels shown = texels_of(name, image, 0);
    const Range range = range_of(shown, image.shape.format, legend);
    Canvas canvas = canvas_of(shown, [&](std::size_t i) { return range.color(shown.values[i]); });
    if (!legend.colors.empty()) return {std::move(canvas), ""};
    const std::string unit = legend.unit.empty() ? "" : " " + legend.unit, low = text_of(range.low, 4) + unit,
                      high = text_of(range.high, 4) + unit;
    return {std::move(canvas),
            range.middle ? fmt::format("{} is blue, {} red", low, high) : fmt::format("{} is black, {} white", low, high)};
}

namespace {

/// Panels of a difference with the texels that they refer to.
struct Difference {
    Texels a, b, alpha_a, alpha_b;
    std::vector<Panel> panels;

    Difference(const ImageComparison& made, const HostImage& image_a, const HostImage& image_b, const PictureTitles& titles)
        : a(texels_of(made.image, image_a, made.error.worst_pixel.layer)),
          b(texels_of(made.image, image_b, made.error.worst_pixel.layer)),
          alpha_a(alpha_of(a)),
          alpha_b(alpha_of(b)) {
        const Range range = range_of(a, image_a.shape.format);
        panels.push_back(image_panel("a", "A  " + titles.a, a, range));
        panels.push_back(image_panel("b", "B  " + titles.b, b, range));
        panels.push_back(difference_panel("difference", a, b));
        panels.back().note =
            fmt::format("rmse {:.3g}{}", made.error.rmse, made.error.disagreeing > 0 ? ", magenta: NaN or infinite" : "");
        if (a.channels == 4 && alpha_a.values != alpha_b.values) panels.push_back(difference_panel("alpha", alpha_a, alpha_b));
        if (!made.flip || made.flip->map.empty()) return;
        panels.push_back({"flip", "FLIP", [&made](std::size_t i) { return magma(double(made.flip->map[i])); }, magma, "0", "1"});
        panels.back().note = fmt::format("mean {:.4f}", made.flip->mean);
    }
    Difference(const Difference&) = delete;
    Difference& operator=(const Difference&) = delete;
};

/// Values at the ends of a panel's legend, and their colors.
std::string scale_words(const Panel& panel) {
    if (panel.key == "flip") return "0 is black, 1 pale yellow";
    const bool has_signs = !panel.legend(0).x && panel.legend(0).z > 0 && panel.legend(1).x > 0 && !panel.legend(1).z;
    return has_signs ? fmt::format("{} is blue, {} red", panel.low, panel.high)
                     : fmt::format("{} is black, {} white", panel.low, panel.high);
}

}  // namespace

std::vector<PlainPanel> plain_panels(const ImageComparison& made, const HostImage& a, const HostImage& b) {
    const Difference difference(made, a, b, {});
    std::vector<PlainPanel> plain;
    plain.reserve(difference.panels.size());
    for (const Panel& panel : difference.panels)
        plain.push_back({panel.key, panel.label.substr(0, panel.label.find_last_not_of(' ') + 1), scale_words(panel),
                         canvas_of(difference.a, panel.color)});
    return plain;
}

Canvas difference_picture(const ImageComparison& made, const HostImage& a, const HostImage& b, const PictureTitles& titles) {
    const Difference difference(made, a, b, titles);
    const Texels& of_a = difference.a;
    const std::vector<Panel>& panels = difference.panels;
    // Four panels make two rows of two, three a row, and those of a narrow image a row however many they are.
    const bool is_narrow = of_a.height * zoom_of(of_a) > panel_width(of_a) * 3 / 2;
    const int columns = is_narrow ? static_cast<int>(panels.size()) : panels.size() == 4 ? 2 : 3;
    const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
    const Box cell{0, 0, panel_width(of_a), of_a.height * zoom_of(of_a) + 2 * Canvas::line + bar_height + 10};
    const int across = columns * (cell.width + gap) + gap;
    const std::vector<std::string> title = wrapped(titles.title, across - 2 * gap),
                                   reason = wrapped(made.reason, across - 2 * gap);
    const int reason_at = gap + static_cast<int>(title.size()) * Canvas::line,
              top = reason_at + gap + static_cast<int>(std::max<std::size_t>(reason.size(), 1)) * Canvas::line;
    Canvas canvas(across, top + rows * (cell.height + gap), paper);
    canvas.text(title, {gap, gap, across - 2 * gap, 0}, mark);
    canvas.text(reason, {gap, reason_at, across - 2 * gap, 0}, ink);
    for (int i = 0; i < static_cast<int>(panels.size()); ++i)
        draw(canvas, panels[static_cast<std::size_t>(i)],
             {gap + i % columns * (cell.width + gap), top + i / columns * (cell.height + gap), cell.width, cell.height}, of_a,
             &made.error.worst_pixel);
    return canvas;
}

}  // namespace strata
