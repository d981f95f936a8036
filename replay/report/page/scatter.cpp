#include "replay/report/page/scatter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "replay/markup_text.h"
#include "replay/page_parts.h"
#include "replay/plural.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

// Pixels of the drawing and of its parts.
constexpr double width = 720, height = 560, left = 58, top = 26, right = 12, foot = 44, strip = 36;
constexpr double text_size = 12, mark_radius = 6;

/// At most as wide as this in fonts without serifs: narrow, wide and other letters.
double text_width(std::string_view text) {
    constexpr std::string_view narrow = "fijlrt.,:;'|()[]I ", wide = "mwMW%@";
    double width = 0;
    for (const char letter : text)
        width += narrow.find(letter) != std::string_view::npos ? .42 : wide.find(letter) != std::string_view::npos ? .98 : .65;
    return width * text_size;
}

struct TextBox {
    double x0, y0, x1, y1;
    bool meets(const TextBox& other) const { return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1; }
};

/// A logarithmic axis from one pixel to another; values at or below a floor lie at one of their own.
class Axis {
public:
    Axis(const std::vector<double>& values, double floor, double margin, double begin, double end, double below)
        : begin_(begin), end_(end), below_(below), floor_(floor) {
        for (const double value : values) {
            if (value <= floor) {
                has_below_ = true;
                continue;
            }
            low_ = std::min(low_, value), high_ = std::max(high_, value);
        }
        if (low_ > high_) low_ = high_ = 1;
        low_ /= margin, high_ *= margin;
    }
    /// Extends the axis to the value and, by a factor, beyond it.
    void reach(const std::optional<double>& value, double beyond) {
        if (value && *value > floor_) low_ = std::min(low_, *value / beyond), high_ = std::max(high_, *value * beyond);
    }
    double at(double value) const {
        if (value <= floor_) return below_;
        return begin_ + (end_ - begin_) * std::log(std::max(value, low_) / low_) / std::log(high_ / low_);
    }
    bool has_below() const { return has_below_; }
    /// 1, 2 and 5 of each power of ten; of many powers 1 alone.
    std::vector<double> ticks() const {
        std::vector<double> all;
        const bool is_long = std::log10(high_ / low_) > 3.2;
        for (double power = std::floor(std::log10(low_)); power <= std::log10(high_); ++power)
            for (const double step : {1., 2., 5.}) {
                const double value = step * std::pow(10, power);
                if (value >= low_ && value <= high_ && (step == 1 || !is_long)) all.push_back(value);
            }
        return all;
    }

private:
    double begin_, end_, below_, floor_, low_ = HUGE_VAL, high_ = 0;
    bool has_below_ = false;
};

std::string text_at(double x, double y, std::string_view anchor, std::string_view style, std::string_view text) {
    return fmt::format(R"(<text class="{}" x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", style, x, y, anchor,
                       escaped(text));
}

struct PlacedLabel {
    double x = 0, y = 0;
    const char* anchor = "start";
    TextBox box{};
};

/// Where labels of points go without meeting anything.
class LabelPlaces {
public:
    LabelPlaces(double x0, double y0, double x1, double y1) : frame_{x0, y0, x1, y1} {}
    void keep_clear(const TextBox& box) { taken_.push_back(box); }

    std::optional<PlacedLabel> place(double x, double y, std::string_view text) {
        const double wide = text_width(text);
        for (const double away : {10., 16., 24., 34., 48.})
            for (const auto& [dx, dy] : directions) {
                const double at_x = x + dx * away, at_y = y + dy * away;
                PlacedLabel label{.x = at_x, .y = at_y + text_size / 3, .anchor = dx < 0 ? "end" : dx > 0 ? "start" : "middle"};
                const double begin = dx < 0 ? at_x - wide : dx > 0 ? at_x : at_x - wide / 2;
                label.box = {begin - 2, at_y - text_size / 2 - 1, begin + wide + 2, at_y + text_size / 2 + 1};
                if (!is_free(label.box)) continue;
                taken_.push_back(label.box);
                return label;
            }
        return std::nullopt;
    }

private:
    static constexpr std::array<std::pair<double, double>, 8> directions = {
        {{1, 0}, {-1, 0}, {.8, -.8}, {.8, .8}, {-.8, -.8}, {-.8, .8}, {0, -1.2}, {0, 1.2}}};

    bool is_free(const TextBox& box) const {
        if (box.x0 < frame_.x0 || box.x1 > frame_.x1 || box.y0 < frame_.y0 || box.y1 > frame_.y1) return false;
        return std::ranges::none_of(taken_, [&](const TextBox& other) { return box.meets(other); });
    }

    TextBox frame_;
    std::vector<TextBox> taken_;
};

/// Whether another point is no worse in both figures and better in one.
bool is_beaten(const ScatterPlot& plot, const ScatterPoint& point) {
    const auto y_of = [&](const ScatterPoint& p) { return p.y <= plot.y_floor ? 0 : p.y; };
    return std::ranges::any_of(plot.points, [&](const ScatterPoint& other) {
        return other.x <= point.x && y_of(other) <= y_of(point) && (other.x < point.x || y_of(other) < y_of(point));
    });
}

class Drawing {
public:
    explicit Drawing(const ScatterPlot& plot)
        : plot_(plot),
          x_(values(&ScatterPoint::x), 0, 1.15, left, width - right, left + 14),
          y_(values(&ScatterPoint::y), plot.y_floor, 1.35, bottom(), top, bottom() + strip / 2),
          labels_(left, top - 8, width - 2, bottom() + strip) {
        x_.reach(plot.most_x, 1.2), y_.reach(plot.most_y, 1.2);
        for (const ScatterPoint& point : plot.points) x_.reach(point.low_x, 1), x_.reach(point.high_x, 1);
    }

    /// `style`: CSS; empty where a page around it has it.
    std::string svg(const std::string& style) {
        std::string text = fmt::format(R"(<svg class="plot" viewBox="0 {} {} {}" xmlns="http://www.w3.org/2000/svg" role="img" )"
                                       R"(aria-label="{} against {}">)",
                                       -above(), width, height + above(), escaped(plot_.y_title), escaped(plot_.x_title));
        if (!style.empty())
            text += fmt::format(R"(<style>{}</style><rect class="paper" y="{}" width="{}" height="{}"/>)", style, -above(), width,
                                height + above());
        if (!plot_.title.empty()) text += text_at(8, -10, "start", "title", plot_.title);
        text += ground();
        text += axes();
        text += bars();  // keeps labels clear of what it draws
        text += marks();
        text += labels();
        return text + "</svg>\n";
    }

private:
    double bottom() const { return height - foot - strip; }
    /// Height of the title, pixels.
    double above() const { return plot_.title.empty() ? 0 : 32; }
    std::vector<double> values(double ScatterPoint::*member) const {
        std::vector<double> all;
        all.reserve(plot_.points.size());
        for (const ScatterPoint& point : plot_.points) all.push_back(point.*member);
        return all;
    }

    std::string ground() {
        if (!plot_.most_x && !plot_.most_y) return "";
        const double x = plot_.most_x ? x_.at(*plot_.most_x) : width - right, y = plot_.most_y ? y_.at(*plot_.most_y) : top;
        const std::string_view says = plot_.most_x && plot_.most_y ? "keeps both limits" : "keeps the limit";
        labels_.keep_clear({left, y, left + 6 + text_width(says), y + 20});
        return fmt::format(R"(<rect class="ok" x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}"/>)", left, y, x - left,
                           bottom() + strip - y) +
               text_at(left + 6, y + 16, "start", "band", says);
    }

    std::string axes() const {
        std::string text;
        for (const double value : y_.ticks()) {
            if (y_.has_below() && y_.at(value) > bottom() - text_size) continue;  // the strip's title is there
            text += fmt::format(R"(<line class="g" x1="{0}" x2="{1}" y1="{2:.1f}" y2="{2:.1f}"/>)", left, width - right,
                                y_.at(value)) +
                    text_at(left - 8, y_.at(value) + 4, "end", "t", short_number(value));
        }
        for (const double value : x_.ticks()) {
            if (x_.has_below() && x_.at(value) < left + 40) continue;
            text += fmt::format(R"(<line class="ax" x1="{0:.1f}" x2="{0:.1f}" y1="{1}" y2="{2}"/>)", x_.at(value),
                                bottom() + strip, bottom() + strip + 5) +
                    text_at(x_.at(value), bottom() + strip + 18, "middle", "t", short_number(value));
        }
        if (x_.has_below()) text += text_at(left + 14, bottom() + strip + 18, "middle", "t", "0");
        for (const double y : {bottom(), bottom() + strip})
            text += fmt::format(R"(<line class="ax" x1="{}" x2="{}" y1="{}" y2="{}"/>)", left, width - right, y, y);
        if (y_.has_below()) text += text_at(left - 8, bottom() + strip / 2 + 4, "end", "t", plot_.strip_title);
        return text + text_at(left, 12, "start", "t", "\u2191 " + plot_.y_title) +
               text_at(width - right, height - 4, "end", "t", plot_.x_title + " \u2192");
    }

    std::string bars() {
        std::string text;
        for (const ScatterPoint& point : plot_.points) {
            const double x = x_.at(point.x), y = y_.at(point.y);
            labels_.keep_clear({x - mark_radius, y - mark_radius, x + mark_radius, y + mark_radius});
            if (!point.low_x || !point.high_x) continue;
            const double low = x_.at(*point.low_x), high = x_.at(*point.high_x);
            labels_.keep_clear({low, y - 1, high, y + 1});
            text += fmt::format(R"(<line class="sp {}" x1="{:.1f}" x2="{:.1f}" y1="{:.1f}" y2="{:.1f}"/>)",
                                mark_class(point.kind), low, high, y, y);
        }
        return text;
    }

    std::string marks() const {
        std::string text;
        for (const ScatterPoint& point : plot_.points)
            text += fmt::format(R"svg(<path class="pt {} {}" data-i="{}" d="{}" transform="translate({:.1f} {:.1f})"/>)svg",
                                mark_class(point.kind), is_beaten(plot_, point) ? "open" : "full", point.place,
                                mark_path(point.kind), x_.at(point.x), y_.at(point.y));
        return text;
    }

    std::string labels() {
        std::vector<std::size_t> order(plot_.points.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::ranges::stable_sort(order, {}, [&](std::size_t i) {
            const ScatterPoint& point = plot_.points[i];
            return std::tuple(!point.is_emphasized, is_beaten(plot_, point), point.y);
        });
        std::string text;
        std::size_t left_out = 0;
        for (const std::size_t i : order) {
            const ScatterPoint& point = plot_.points[i];
            const double x = x_.at(point.x), y = y_.at(point.y);
            const auto label = labels_.place(x, y, point.label);
            if (!label) {
                ++left_out;
                continue;
            }
            if (std::hypot(label->x - x, label->y - text_size / 3 - y) > 18)
                text += fmt::format(R"(<line class="lead" x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>)", x, y, label->x,
                                    label->y - text_size / 3);
            text += fmt::format(R"(<text class="lb{}" data-i="{}" x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)",
                                point.is_emphasized ? " b" : "", point.place, label->x, label->y, label->anchor,
                                escaped(point.label));
        }
        if (left_out > 0) text += text_at(left, height - 4, "start", "t", plural(left_out, "point") + " without room for a name");
        return text;
    }

    const ScatterPlot& plot_;
    Axis x_, y_;
    LabelPlaces labels_;
};

}  // namespace

std::string as_svg(const ScatterPlot& plot) { return Drawing(plot).svg(""); }

std::string as_svg_file(const ScatterPlot& plot) { return Drawing(plot).svg(std::string(plot_css)); }

std::string mark_path(std::size_t kind) {
    static constexpr std::array shapes = {"M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0z",
                                          "M-4.5-4.5h9v9h-9z",
                                          "M0-5.5L5.5 4.5h-11z",
                                          "M0-6L6 0L0 6L-6 0z",
                                          "M0 5.5L5.5-4.5h-11z",
                                          "M-2-5.5h4v3.5h3.5v4h-3.5v3.5h-4v-3.5h-3.5v-4h3.5z",
                                          "M-5.5-3.5h11v7h-11z",
                                          "M-3.5-5.5h7v11h-7z"};
    return shapes[(kind + kind / shapes.size()) % shapes.size()];
}

std::string mark_class(std::size_t kind) { return fmt::format("c{}", kind % 8); }

}  // namespace strata
