// The page of several frames: their pool on top, the page of each frame inside.
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "passes/stages.h"
#include "replay/page_parts.h"
#include "replay/plural.h"
#include "replay/report/page/page.h"
#include "replay/report/page/page_items.h"
#include "replay/report/page/scale.h"
#include "replay/report/page/scatter.h"
#include "replay/report/report_columns.h"
#include "replay/report/variants.h"
#include "replay/report/warnings.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

constexpr std::size_t most_page_bytes = 4'800'000;

/// In single quotes: pages have few of these.
std::string in_srcdoc(std::string_view page) {
    std::string text;
    for (const char letter : page) {
        if (letter == '&') text += "&amp;";
        else if (letter == '\'') text += "&#39;";
        else text += letter;
    }
    return text;
}

class FramesPage {
public:
    FramesPage(std::span<const Report> reports, const Pool& pool)
        : reports_(reports), pool_(pool), answer_(answer_of(pool)), names_(frame_names(reports)), marks_(pool.rows) {
        shown_ = answer_.recommended ? answer_.recommended : answer_.nearest;
        if (!shown_ && !pool.rows.empty() && is_ranked(pool, pool.rows.front())) shown_ = 0;
    }

    std::string plot_file() const {
        ScatterPlot made = plot();
        made.title = fmt::format("{} of {}, {}", name(pool_.stage), frames_text(pool_), reports_.front().device.name);
        return as_svg_file(made);
    }

    std::string text() const {
        const std::map<std::string_view, std::string> parts = {
            {"title", escaped(fmt::format("{}: {}", frames_text(pool_), name(pool_.stage)))},
            {"css", std::string(plot_css) + std::string(page_css)},
            {"own_css", std::string(frames_css)},
            {"provenance", provenance()},
            {"verdict", escaped(verdict())},
            {"notes", notes()},
            {"answer", answer_html(answer_lines(pool_), pool_.times_are)},
            {"command", command()},
            {"plot", as_svg(plot())},
            {"pooled_as", pooled_as()},
            {"scale", scale_html(pool_.error)},
            {"matrix", matrix()},
            {"left_out", left_out()},
            {"frames", frames()},
            {"text", fmt::format("<pre>{}</pre>\n", escaped(as_text(pool_)))},
            {"pages_js", std::string(pages_js)},
            {"js", std::string(frames_js)}};
        return filled(frames_html, parts);
    }

private:
    std::string provenance() const {
        return provenance_html({plural(reports_.size(), "frame"), fmt::format("stage {}", name(pool_.stage)),
                                plural(pool_.rows.size(), "row"), reports_.front().device.name, reports_.front().date});
    }

    std::string facts(const PooledRow& row) const {
        std::string text = error_words(pool_.error, row.error) + (pool_.captures > 1 ? ", the mean of captures" : "");
        if (pool_.captures == 1 && pool_.frames > 1) text += fmt::format(", on {}", row.worst_frame);
        const std::string unit = below_stage(pool_.time_unit);
        if (!pool_.question.gpu.empty() && std::isfinite(row.asked.ms))
            text += fmt::format(", at most {} ms modeled for {}", short_number(row.asked.ms), pool_.question.gpu);
        else if (row.time && !unit.empty()) text += fmt::format(", at {:.2f} \u00d7 the time of {}", *row.time, unit);
        return text;
    }

    std::string verdict() const {
        if (pool_.frames == 0 && pool_.left_out.empty())
            return std::ranges::all_of(reports_, [](const Report& report) { return !report.skipped.empty(); })
                       ? "No frame needs this stage"
                       : "No frame was measured completely";
        if (pool_.frames == 0)
            return fmt::format("No answer: {} changes fewer than {} pixels of each frame", name(pool_.stage), fewest_pixels);
        if (!shown_) return "No technique can do all of these frames";
        const PooledRow& row = pool_.rows[*shown_];
        if (!pool_.question.is_asked())
            return fmt::format("{}: {}",
                               most_accurate_text(answer_, short_label(row), pool_.rows.size(), " over " + frames_text(pool_),
                                                  row.time.has_value()),
                               facts(row));
        if (!answer_.recommended)
            return fmt::format("No technique keeps the limits over {}; {} is the nearest: {}", frames_text(pool_),
                               short_label(row), facts(row));
        return fmt::format("{} {} over {}: {}", shown_ == baseline_of(pool_) ? "Keep" : "Use", short_label(row),
                           frames_text(pool_), facts(row));
    }

    std::string notes() const {
        std::string text = note_html(pool_.times_are);
        for (std::size_t i = 0; i < reports_.size(); ++i) {
            if (const std::string note = no_picture_text(reports_[i]); !note.empty()) text += note_html(names_[i] + ": " + note);
            for (const Warning& warning : warnings_of(reports_[i])) text += note_html(names_[i] + ": " + warning.text);
        }
        return text + note_html(reports_.back().stopped);
    }

    std::string command() const {
        const bool has_command = shown_ && !pool_.rows[*shown_].command.empty();
        return has_command ? command_html(pool_.rows[*shown_].command) : "";
    }

    double scaled(double error) const { return pool_.error.is_of_white ? 100 * error : error; }

    /// The figure across: what the answer rests on.
    struct Across {
        std::string title;
        double (*of)(const PooledRow&);
    };
    Across across() const {
        if (pool_.question.cost == &Standing::bytes_per_pixel)
            return {"bytes per pixel", [](const PooledRow& row) { return row.bytes_per_pixel; }};
        if (pool_.time_unit.empty() || !pool_.question.gpu.empty())
            return {"ms of the slowest frame" + (pool_.question.gpu.empty() ? "" : ", modeled for " + pool_.question.gpu),
                    [](const PooledRow& row) { return row.asked.ms; }};
        return {fmt::format("time, x {}", below_stage(pool_.time_unit)),
                [](const PooledRow& row) { return row.time.value_or(HUGE_VAL); }};
    }

    ScatterPlot plot() const {
        const Across cost = across();
        ScatterPlot made{.x_title = cost.title, .y_title = title_of(pool_.error)};
        if (pool_.error.is_of_white) made.y_floor = 100 * exact_below, made.strip_title = fmt::format("< {:g}", made.y_floor);
        if (pool_.question.error) made.most_y = scaled(*pool_.question.error);
        const bool is_of_time = pool_.question.cost == &Standing::time && pool_.question.gpu.empty() && !pool_.time_unit.empty();
        if (is_of_time) made.most_x = pool_.question.within;
        for (std::size_t i = 0; i < pool_.rows.size(); ++i) {
            const PooledRow& row = pool_.rows[i];
            if (!std::isfinite(cost.of(row)) || !is_ranked(pool_, row)) continue;
            made.points.push_back({.label = short_label(row),
                                   .place = i,
                                   .kind = marks_.kind(row.technique),
                                   .x = cost.of(row),
                                   .y = scaled(row.error),
                                   .is_emphasized = i == shown_});
        }
        if (made.points.empty()) made.y_title = "no row can do all frames";
        return made;
    }

    std::string pooled_as() const {
        const bool has_several = pool_.frames > pool_.captures;
        std::string text = has_several ? "Of a capture the worst frame decides." : "";
        if (pool_.captures > 1) text += fmt::format("{}Over captures it is the mean.", has_several ? " " : "");
        return text + " Times are geometric means.";
    }

    /// The error of a pooled row on a frame, or why there is none.
    std::string cell(const PooledRow& row, std::size_t frame) const {
        const Report& report = reports_[frame];
        const auto found = std::ranges::find_if(
            report.rows, [&](const Measurement& own) { return own.technique == row.technique && own.settings == row.settings; });
        const auto without = [](std::string_view word, const std::string& why) {
            return fmt::format("<td title=\"{}\">{}</td>", escaped(why), word);
        };
        if (!report.skipped.empty()) return without("not needed", report.skipped);
        if (!report.is_timed) return without("not timed", report.stopped);
        if (found == report.rows.end()) return without("not measured", "stopped before");
        if (!found->is_measured()) return without("cannot", found->accuracy.not_supported);
        if (changes_too_little(report)) return without("too few pixels", "left out of the pool");
        const double value = ranking_metric(*found).value;
        return fmt::format("<td{}><a href=\"#frame-{}\" data-frame=\"{}\" data-row=\"{}\">{}{}</a></td>",
                           frame == row.worst_report ? " class=\"worst\"" : "", frame, frame, found - report.rows.begin(),
                           class_square(pool_.error, value), pool_.error.text(value));
    }

    std::string matrix() const {
        const bool has_unit = !pool_.time_unit.empty();
        std::string text =
            fmt::format("<table class=\"rows matrix\"><thead><tr><th>{} and settings</th><th>pooled</th>", name(pool_.stage));
        if (has_unit) text += fmt::format("<th>time, x {}</th>", escaped(below_stage(pool_.time_unit)));
        for (const std::string& frame : names_) text += fmt::format("<th>{}</th>", escaped(frame));
        text += "</tr></thead>\n<tbody>\n";
        for (const PooledRow& row : pool_.rows) {
            text += fmt::format("<tr><td>{}{}{}</td>", marks_.html(row.technique), escaped(short_label(row)),
                                row.on_front ? " <b title=\"nothing is both more accurate and faster\">*</b>" : "");
            text += is_ranked(pool_, row)
                        ? fmt::format("<td>{}{}</td>", class_square(pool_.error, row.error), pool_.error.text(row.error))
                        : std::string("<td>not ranked</td>");
            if (has_unit) text += fmt::format("<td>{}</td>", row.time ? fmt::format("{:.2f}", *row.time) : "");
            for (std::size_t frame = 0; frame < reports_.size(); ++frame) text += cell(row, frame);
            text += "</tr>\n";
        }
        return text + "</tbody></table>\n";
    }

    /// Rows that no frame can measure, each with its first reason.
    std::string left_out() const {
        std::map<std::string, std::string> reasons;
        for (const Report& report : reports_)
            for (const Measurement& row : report.rows)
                if (!row.accuracy.not_supported.empty()) reasons.emplace(short_label(row), row.accuracy.not_supported);
        for (const PooledRow& row : pool_.rows) reasons.erase(short_label(row));
        return left_out_html(std::vector<std::pair<std::string, std::string>>(reasons.begin(), reasons.end()));
    }

    /// As large as all may be together; what the rest of it leaves is for pictures.
    std::string frame_page(const Report& report) const {
        const std::size_t most = most_page_bytes / reports_.size();
        const std::size_t rest = in_srcdoc(as_html(report, {.picture_bytes = 0, .has_every_plot = false})).size();
        return as_html(report, {.picture_bytes = most > rest ? most - rest : 0, .has_every_plot = false});
    }

    /// The frame on which the row of the answer is worst starts open.
    std::string frames() const {
        const std::size_t worst = shown_ ? pool_.rows[*shown_].worst_report : 0;
        std::string text;
        for (std::size_t i = 0; i < reports_.size(); ++i) {
            text += fmt::format(
                "<details class=\"frame\" id=\"frame-{}\"{}><summary><b>{}</b> {}</summary>\n"
                "<iframe title=\"{}\" srcdoc='{}'></iframe></details>\n",
                i, i == worst ? " open" : "", escaped(names_[i]), escaped(verdict_of(reports_[i])), escaped(names_[i]),
                in_srcdoc(frame_page(reports_[i])));
        }
        return text;
    }

    std::span<const Report> reports_;
    const Pool& pool_;
    Answer answer_;
    std::vector<std::string> names_;
    Marks marks_;
    std::optional<std::size_t> shown_;  ///< the row of the heading
};

}  // namespace

std::string as_html(std::span<const Report> reports, const Pool& pool) { return FramesPage(reports, pool).text(); }

std::string as_svg(std::span<const Report> reports, const Pool& pool) { return FramesPage(reports, pool).plot_file(); }

}  // namespace strata
