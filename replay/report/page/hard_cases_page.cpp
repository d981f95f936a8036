// The matrix of hard cases as a page.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "replay/page_parts.h"
#include "replay/plural.h"
#include "replay/report/page/page.h"
#include "replay/report/page/page_items.h"
#include "replay/report/page/scale.h"
#include "replay/report/variants.h"

namespace strata {
namespace {

using Verdict = HardOutcome::Verdict;

/// Errors of the cases are shares of the truth, which is near white.
const RankingError of_white{.name = "error", .is_of_white = true};

std::string cell(const HardOutcome& outcome) {
    const bool is_error =
        outcome.verdict == Verdict::documented || outcome.verdict == Verdict::undocumented || outcome.verdict == Verdict::fails;
    return fmt::format("<td title=\"{}\">{}{}</td>", escaped(outcome.reason),
                       is_error ? class_square(of_white, outcome.error) : "", matrix_cell(outcome));
}

std::string matrix(const HardCaseReport& report, std::span<const HardCase> cases) {
    std::string text = "<table class=\"rows tight\"><thead><tr><th>transparency and settings</th>";
    for (const HardCase& one : cases) text += fmt::format("<th title=\"{}\">{}</th>", escaped(one.name), escaped(id(one)));
    text += "</tr></thead>\n<tbody>\n";
    for (const HardCaseRow& row : report.rows) {
        text += fmt::format("<tr><td>{}</td>", escaped(short_label(row)));
        for (const HardOutcome& outcome : row.outcomes) text += cell(outcome);
        text += "</tr>\n";
    }
    return text + "</tbody></table>\n";
}

std::string verdict(const HardCaseReport& report, std::size_t cases) {
    const auto has = [&](const HardCaseRow& row, auto... verdicts) {
        return std::ranges::any_of(row.outcomes, [&](const HardOutcome& own) { return ((own.verdict == verdicts) || ...); });
    };
    std::size_t holding = 0, surprising = 0;
    for (const HardCaseRow& row : report.rows) {
        holding += !has(row, Verdict::documented, Verdict::undocumented, Verdict::fails);
        surprising += has(row, Verdict::undocumented, Verdict::undeserved);
    }
    return fmt::format("{} of {} hold every one of {} that applies to them; {}", holding, plural(report.rows.size(), "row"),
                       plural(cases, "case"),
                       surprising == 0 ? std::string("every failure is as documented")
                                       : fmt::format("in {} a failure is not as documented", plural(surprising, "row")));
}

}  // namespace

std::string as_html(const HardCaseReport& report) {
    const auto cases = hard_cases().first(report.rows.empty() ? 0 : report.rows.front().outcomes.size());
    std::string questions;
    for (const HardCase& one : cases)
        questions +=
            fmt::format("<dt>{}</dt><dd>{} (holds up to {:.2g})</dd>\n", escaped(one.name), escaped(one.question), one.tolerance);
    const std::map<std::string_view, std::string> parts = {
        {"css", std::string(plot_css) + std::string(page_css)},
        {"provenance", provenance_html({report.device.name, plural(cases.size(), "case"), report.date})},
        {"verdict", escaped(verdict(report, cases.size()))},
        {"notes", note_html(report.stopped)},
        {"scale", scale_html(of_white)},
        {"matrix", matrix(report, cases)},
        {"cases", questions},
        {"text", fmt::format("<pre>{}</pre>\n", escaped(as_text(report)))},
        {"pages_js", std::string(pages_js)},
        {"js", std::string(hard_cases_js)}};
    return filled(hard_cases_html, parts);
}

}  // namespace strata
