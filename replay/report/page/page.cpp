#include "replay/report/page/page.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passes/stages.h"
#include "replay/markup_text.h"
#include "replay/page_parts.h"
#include "replay/plural.h"
#include "replay/report/page/page_items.h"
#include "replay/report/page/scale.h"
#include "replay/report/page/scatter.h"
#include "replay/report/report_columns.h"
#include "replay/report/seen.h"
#include "replay/report/variants.h"
#include "replay/report/warnings.h"
#include "replay/session/choice_text.h"
#include "replay/tables/document.h"
#include "replay/tables/shown_columns.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

constexpr std::string_view ranking_key = "ranking_error";

std::string error_words(const Measurement& row) {
    const Metric& metric = ranking_metric(row);
    return strata::error_words({metric.name, is_of_white(metric)}, metric.value);
}

/// The parts of a page; each fills a place of page.html.
class HtmlPage {
public:
    HtmlPage(const Report& report, const PageRoom& room)
        : report_(report),
          room_(room),
          asked_(asked_standings(report)),
          answer_(answer_of(report)),
          sheet_(sheet_of(report)),
          marks_(report.rows) {
        choose_pictures();
    }

    std::string text() const {
        const std::map<std::string_view, std::string> parts = {
            {"title", escaped(fmt::format("{}: {}", report_.capture_name, name(report_.stage)))},
            {"css", std::string(plot_css) + std::string(page_css)},
            {"truth", report_.truth_picture.empty() ? "none" : fmt::format("url({})", png_uri(report_.truth_picture))},
            {"aspect", fmt::format("{} / {}", report_.width, report_.height)},
            {"provenance", provenance()},
            {"verdict", escaped(verdict())},
            {"notes", notes()},
            {"answer", answer_html(answer_lines(report_), times_text(report_))},
            {"command", shown_ ? command_html(command_of(report_, report_.rows[*shown_])) : ""},
            {"three", three()},
            {"scale", scale_html(ranking_error(report_))},
            {"axes", axis_choices()},
            {"plots", plots()},
            {"techniques", techniques()},
            {"table", table()},
            {"sheet", small_pictures()},
            {"left_out", left_out()},
            {"measured", measured()},
            {"data", data()},
            {"pages_js", std::string(pages_js)},
            {"js", std::string(page_js)}};
        return filled(page_html, parts);
    }

    std::string verdict() const {
        if (!report_.skipped.empty()) return fmt::format("The frame does not need this stage: {}", report_.skipped);
        if (changes_too_little(report_))
            return fmt::format("No answer: {} changes fewer than {} pixels of this view", name(report_.stage), fewest_pixels);
        if (!shown_) return "No technique can do this frame";
        const Measurement& row = report_.rows[*shown_];
        const std::string facts = fmt::format("{}{}{}", error_words(row), report_.is_timed ? ", at " : "", time_words(row));
        if (!report_.question.is_asked())
            return fmt::format("{}: {}", most_accurate_text(answer_, short_label(row), report_.rows.size(), "", report_.is_timed),
                               facts);
        if (!answer_.recommended)
            return fmt::format("No technique keeps the limits; {} is the nearest: {}", short_label(row), facts);
        return fmt::format("{} {}: {}", shown_ == baseline_of(report_) ? "Keep" : "Use", short_label(row), facts);
    }

    /// The plot of the ranking error against what the answer rests on.
    std::string plot_file() const {
        const auto up = axes(Role::error), across = axes(Role::cost);
        ScatterPlot made{.y_title = "nothing was measured"};
        if (!up.empty() && !across.empty()) made = plot(up.front(), across.front());
        made.title = fmt::format("{} of {} frame {}, {} \u00d7 {}, {}", name(report_.stage), report_.capture_name, report_.frame,
                                 report_.width, report_.height, report_.device.name);
        return as_svg_file(made);
    }

private:
    /// Rows of the answer and of the front first, then by error, until the bytes are spent.
    void choose_pictures() {
        shown_ = answer_.recommended ? answer_.recommended : answer_.nearest;
        if (!shown_ && first_measured(report_)) shown_ = std::size_t(first_measured(report_) - report_.rows.data());
        const auto baseline = baseline_of(report_);
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < report_.rows.size(); ++i)
            if (report_.rows[i].picture) order.push_back(i);
        std::ranges::stable_sort(order, {}, [&](std::size_t i) {
            const bool is_named = shown_ == i || baseline == i || answer_.cheaper == i || answer_.most_accurate == i;
            return is_named ? 0 : report_.rows[i].on_front ? 1 : 2;
        });
        has_picture_.resize(report_.rows.size());
        std::size_t bytes = report_.truth_picture.size();
        const auto fits = [&](std::size_t more) {
            const bool has_room = (bytes + more) * 4 / 3 <= room_.picture_bytes;
            if (has_room) bytes += more;
            return has_room;
        };
        for (const std::size_t i : order) has_picture_[i] = fits(report_.rows[i].picture->png.size());
        // Maps of the rows that one looks at, as far as there is room.
        has_flip_.resize(report_.rows.size());
        for (const std::size_t i : order) {
            const std::size_t map = report_.rows[i].picture->flip_png.size();
            has_flip_[i] = has_picture_[i] && map > 0 && fits(map);
        }
        has_probe_.resize(report_.rows.size());
        for (const std::size_t i : order) {
            const std::size_t plot = report_.rows[i].picture->probe_svg.size();
            has_probe_[i] = has_picture_[i] && plot > 0 && fits(plot);
        }
    }

    std::string time_words(const Measurement& row) const {
        if (!report_.is_timed) return "";
        const std::string unit = below_stage(report_.time_unit);
        if (!report_.question.gpu.empty()) {
            const Standing& own = asked_[std::size_t(&row - report_.rows.data())];
            if (own.error && !has_time_unit(report_.question, asked_, baseline_of(report_)))
                return fmt::format("{} ms modeled for {}", short_number(own.ms), report_.question.gpu);
            return own.error ? fmt::format("{:.2f} \u00d7 the modeled time of {} on {}", own.time, unit, report_.question.gpu)
                             : "a time that no model knows";
        }
        const bool is_unit = row.technique == report_.time_unit && row.settings.empty();
        if (row.time && !is_unit) return fmt::format("{:.2f} \u00d7 the time of {}", row.time->median, unit);
        return short_number(row.stage_ms.median) + " ms";
    }

    std::string provenance() const {
        return provenance_html(
            {fmt::format("{}, frame {}", report_.capture_name, report_.frame),
             fmt::format("{} \u00d7 {}, {} per pixel", report_.width, report_.height, plural(report_.samples, "sample")),
             fmt::format("stage {}", name(report_.stage)), plural(report_.rows.size(), "row"), report_.date});
    }

    std::string notes() const {
        std::string text = (report_.is_timed ? note_html(times_text(report_)) : "") + note_html(no_picture_text(report_));
        for (const Warning& warning : warnings_of(report_)) text += note_html(warning.text, warning.id);
        return text + note_html(report_.stopped);
    }

    std::string picture(std::size_t row) const {
        const bool is_there = has_picture_[row];
        return fmt::format("<div class=\"pic\" data-i=\"{}\">{}</div>", row,
                           is_there ? fmt::format("<img alt=\"{}\" src=\"{}\">", escaped(short_label(report_.rows[row])),
                                                  png_uri(report_.rows[row].picture->png))
                                    : "<p>no picture: the page would be too large</p>");
    }

    std::string flip(std::size_t row) const {
        return has_flip_[row]
                   ? fmt::format("<img class=\"flip\" hidden alt=\"\" src=\"{}\">", png_uri(report_.rows[row].picture->flip_png))
                   : "";
    }

    std::string worst_pixel(std::size_t row) const {
        return has_probe_[row] ? fmt::format("<img class=\"probe\" hidden alt=\"\" src=\"{}\">",
                                             svg_uri(report_.rows[row].picture->probe_svg))
                               : "";
    }

    /// Truth, the row of the answer and the baseline. Their pictures are those of the sheet, which the script puts here, so that
    /// no picture is in the page twice.
    std::string three() const {
        if (report_.truth_picture.empty() || !shown_) return "";
        std::string text = fmt::format("<figure><div class=\"pic\"></div><figcaption><b>truth</b><br>{}</figcaption></figure>\n",
                                       escaped(report_.truths.front().is));
        const auto add = [&](std::size_t row, std::string_view head) {
            text += fmt::format(
                "<figure class=\"js\"><div class=\"pic\" data-copy=\"{}\"></div><figcaption><b>{}</b><br>{}: {}"
                "</figcaption></figure>\n",
                row, head, escaped(short_label(report_.rows[row])), escaped(error_words(report_.rows[row])));
        };
        const bool is_asked = report_.question.is_asked();
        add(*shown_, is_asked && answer_.recommended ? "recommended" : is_asked && answer_.nearest ? "nearest" : "most accurate");
        const auto baseline = baseline_of(report_);
        if (baseline && baseline != shown_ && report_.rows[*baseline].is_measured()) add(*baseline, "baseline");
        return text;
    }

    std::vector<std::size_t> axes(Role role) const {
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < sheet_.columns.size(); ++i) {
            const Described& is = sheet_.columns[i];
            if ((is.key == ranking_key ? Role::error : is.role) != role) continue;
            const bool has_numbers = std::ranges::any_of(sheet_.rows, [&](const Sheet::Row& row) {
                const auto number = cell_number(row.values[i]);
                return number && std::isfinite(*number) && *number > 0;
            });
            if (!has_numbers) continue;
            // A plot begins with what the answer rests on.
            const bool is_first = is.key == ranking_key || is.key == "modeled_kilocycles" ||
                                  (is.key == "bytes_per_pixel" && report_.question.cost == &Standing::bytes_per_pixel);
            found.insert(is_first ? found.begin() : found.end(), i);
        }
        return found;
    }

    std::string axis_title(std::size_t column) const {
        const Described& is = sheet_.columns[column];
        const std::string title = is.title.empty() ? is.key : is.title;
        const bool is_percent = is.kind == CellKind::share && title.find('%') == std::string::npos;
        const bool has_unit = is.unit.empty() || title.ends_with(is.unit);
        return title + (is_percent ? ", %" : has_unit ? "" : ", " + is.unit);
    }

    std::string axis_choices() const {
        const auto choice = [&](const char* id, const char* word, Role role) {
            std::string text = fmt::format("<label>{} <select id=\"{}\">", word, id);
            for (const std::size_t column : axes(role))
                text += fmt::format("<option value=\"{}\">{}</option>", column, escaped(axis_title(column)));
            return text + "</select></label>\n";
        };
        return choice("up", "up", Role::error) + choice("across", "across", Role::cost);
    }

    double scaled(std::size_t column, double value) const {
        return sheet_.columns[column].kind == CellKind::share ? 100 * value : value;
    }

    std::string plots() const {
        std::string text;
        const auto all_up = axes(Role::error), all_across = axes(Role::cost);
        for (const std::size_t up : all_up)
            for (const std::size_t across : all_across)
                if (room_.has_every_plot || up == all_up.front() || across == all_across.front())
                    text += fmt::format("<div class=\"one\" data-up=\"{}\" data-across=\"{}\"{}>{}</div>\n", up, across,
                                        text.empty() ? "" : " hidden", as_svg(plot(up, across)));
        return text.empty() ? "<p>nothing was measured</p>" : text;
    }

    ScatterPlot plot(std::size_t up, std::size_t across) const {
        ScatterPlot made{.x_title = axis_title(across), .y_title = axis_title(up)};
        const bool is_ranking = sheet_.columns[up].key == ranking_key, is_time = sheet_.columns[across].key == "time";
        if (is_ranking && ranking_error(report_).is_of_white)
            made.y_floor = 100 * exact_below, made.strip_title = fmt::format("< {:g}", made.y_floor);
        if (is_ranking && report_.question.error) made.most_y = scaled(up, *report_.question.error);
        if (is_time && report_.question.within && report_.question.gpu.empty()) made.most_x = report_.question.within;
        for (std::size_t i = 0; i < sheet_.rows.size(); ++i) {
            const auto x = cell_number(sheet_.rows[i].values[across]), y = cell_number(sheet_.rows[i].values[up]);
            if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) continue;
            ScatterPoint point{.label = short_label(report_.rows[i]),
                               .place = i,
                               .kind = marks_.kind(report_.rows[i].technique),
                               .x = scaled(across, *x),
                               .y = scaled(up, *y),
                               .is_emphasized = i == shown_};
            if (const auto* spread = std::get_if<Spread>(&sheet_.rows[i].values[across])) {
                if (spread->repeats > 1) point.low_x = spread->low, point.high_x = spread->high;
            }
            made.points.push_back(std::move(point));
        }
        return made;
    }

    std::string techniques() const {
        std::string text;
        for (const auto& [technique, kind] : marks_.kinds())
            text += fmt::format("<button class=\"technique\" aria-pressed=\"true\" data-t=\"{}\">{}{}</button>\n",
                                escaped(technique), marks_.html(technique), escaped(below_stage(technique)));
        return text;
    }

    std::string table() const {
        const std::vector<std::size_t> shown = shown_columns(sheet_, in_text);
        std::string text = fmt::format("<table class=\"rows\"><thead><tr><th><button data-k=\"-1\">{}</button></th>",
                                       escaped(sheet_.heads_labels));
        for (const std::size_t column : shown)
            text += fmt::format("<th title=\"{}\"><button data-k=\"{}\">{}</button></th>", escaped(sheet_.columns[column].help),
                                column, escaped(axis_title(column)));
        text += "</tr></thead>\n<tbody>\n";
        for (std::size_t i = 0; i < sheet_.rows.size(); ++i) {
            const Sheet::Row& row = sheet_.rows[i];
            text += fmt::format("<tr data-i=\"{}\" tabindex=\"0\"><td>{}{}{}</td>", i, marks_.html(report_.rows[i].technique),
                                escaped(row.name.label),
                                report_.rows[i].on_front ? " <b title=\"nothing is both more accurate and faster\">*</b>" : "");
            if (!row.name.instead.empty()) {
                text +=
                    fmt::format("<td class=\"instead\" colspan=\"{}\">{}</td></tr>\n", shown.size(), escaped(row.name.instead));
                continue;
            }
            for (const std::size_t column : shown) {
                const auto number = cell_number(row.values[column]);
                text += fmt::format("<td{}>{}{}</td>", number ? fmt::format(" data-v=\"{:.9g}\"", *number) : "",
                                    sheet_.columns[column].key == ranking_key ? square(report_.rows[i]) : "",
                                    escaped(cell_text(sheet_.columns[column], row.values[column])));
            }
            text += "</tr>\n";
        }
        return text + "</tbody></table>\n";
    }

    static std::string square(const Measurement& row) { return class_square(ranking_error(row), ranking_metric(row).value); }

    std::string small_pictures() const {
        if (report_.truth_picture.empty())
            return "<p>no pictures: later stages read more of this stage than images that could show the truth</p>\n";
        std::string text;
        for (std::size_t i = 0; i < report_.rows.size(); ++i)
            if (report_.rows[i].picture)
                text += fmt::format("<figure data-i=\"{}\">{}{}{}<figcaption>{}<b>{}</b><br>{}</figcaption></figure>\n", i,
                                    picture(i), flip(i), worst_pixel(i), marks_.html(report_.rows[i].technique),
                                    escaped(short_label(report_.rows[i])), escaped(error_words(report_.rows[i])));
        return text;
    }

    std::string left_out() const {
        std::vector<std::pair<std::string, std::string>> reasons;
        for (const Measurement& row : report_.rows)
            if (!row.is_measured() && !row.accuracy.not_supported.empty())
                reasons.emplace_back(short_label(row), row.accuracy.not_supported);
        return left_out_html(reasons);
    }

    /// The heading of the text, line by line, and what each row counted.
    std::string measured() const { return fmt::format("<pre>{}</pre>\n", escaped(as_text(page_of(report_)))); }

    std::string data() const {
        ordered_json json{
            {"width", report_.width}, {"height", report_.height}, {"selected", nullptr}, {"rows", ordered_json::array()}};
        if (shown_) json["selected"] = *shown_;
        for (const SeenClass& one : seen_classes()) json["classes"].push_back({{"from", one.from}, {"words", one.words}});
        for (std::size_t i = 0; i < report_.rows.size(); ++i) {
            const Measurement& row = report_.rows[i];
            ordered_json made{{"name", short_label(row)}, {"technique", row.technique}, {"front", row.on_front}};
            if (row.is_measured()) {
                made["says"] = fmt::format("{}{}{}", error_words(row), report_.is_timed ? " \u00b7 " : "", time_words(row));
                made["command"] = command_of(report_, row);
            } else made["says"] = row.accuracy.not_supported;
            for (const StepTime& step : row.steps) made["steps"].push_back({step.name, step.ms.median});
            if (has_picture_[i]) made["worst"] = {row.picture->worst_x, row.picture->worst_y};
            json["rows"].push_back(std::move(made));
        }
        // Inside of a script "</" would end it.
        std::string text = json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
        for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at)) text.replace(at, 2, "<\\/");
        return text;
    }

    const Report& report_;
    PageRoom room_;
    std::vector<Standing> asked_;
    Answer answer_;
    Sheet sheet_;
    Marks marks_;
    std::optional<std::size_t> shown_;                      ///< the row that the page opens on
    std::vector<bool> has_picture_, has_flip_, has_probe_;  ///< by row
};

}  // namespace

std::string as_html(const Report& report, const PageRoom& room) { return HtmlPage(report, room).text(); }

std::string as_svg(const Report& report) { return HtmlPage(report, {.picture_bytes = 0}).plot_file(); }

std::string verdict_of(const Report& report) { return HtmlPage(report, {.picture_bytes = 0}).verdict(); }

}  // namespace strata
