// The matrix of hard cases for a terminal, and as JSON.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "replay/json_text.h"
#include "replay/report/hard_cases.h"
#include "replay/report/table.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

// Of a table of 120 columns, beside labels of 29.
constexpr std::size_t cases_side_by_side = 11;

/// "ok", or the error with what it means: "!" a bug, "?" better than its record.
std::string cell(const HardOutcome& outcome) {
    using Verdict = HardOutcome::Verdict;
    switch (outcome.verdict) {
        case Verdict::holds:
            return "ok";
        case Verdict::not_applicable:
            return "-";
        case Verdict::documented:
        case Verdict::fails:
            return fmt::format("{:.2g}", outcome.error);
        case Verdict::undocumented:
            return fmt::format("{:.2g}!", outcome.error);
        case Verdict::undeserved:
            return "ok?";
    }
    return "";
}

Table table_of(const HardCaseReport& report, std::size_t first_case, std::size_t count) {
    Table table;
    for (const HardCase& hard_case : hard_cases().subspan(first_case, count)) table.heads.emplace_back(id(hard_case));
    for (const HardCaseRow& row : report.rows) {
        table.rows.push_back({.label = below_stage(label(row.technique, row.settings))});
        for (std::size_t c = first_case; c < first_case + count; ++c) table.rows.back().cells.push_back(cell(row.outcomes[c]));
    }
    return table;
}

ordered_json json_of(const HardCase& hard_case, const HardOutcome& outcome) {
    ordered_json json{{"case", id(hard_case)},
                      {"question", hard_case.question},
                      {"accept", hard_case.accept},
                      {"verdict", name(outcome.verdict)}};
    if (outcome.verdict != HardOutcome::Verdict::not_applicable) {
        json["error"] = std::isfinite(outcome.error) ? ordered_json(outcome.error) : ordered_json("infinite");
        json["model_worst"] = outcome.model_worst;
    }
    if (outcome.documented > 0) json["documented"] = outcome.documented;
    if (!outcome.reason.empty()) json["because"] = outcome.reason;
    return json;
}

}  // namespace

std::string as_text(const HardCaseReport& report) {
    std::string text = fmt::format("hard cases of transparency on {} ({})\n\n", report.device.name, report.device.driver);
    const std::size_t cases = report.rows.empty() ? 0 : report.rows.front().outcomes.size();
    for (const HardCase& hard_case : hard_cases().first(cases))
        text += fmt::format("   {:<28} holds at {:.2g}\n", hard_case.name, hard_case.accept);
    for (std::size_t first = 0; first < cases; first += cases_side_by_side)
        text += '\n' + as_text(table_of(report, first, std::min(cases_side_by_side, cases - first)));
    text +=
        "\nok: holds. A number: fails by so much, at its defaults as the technique documents. -: not applicable.\n"
        "!: a failure that is not documented, or of another size. ok?: holds what is documented as a failure.\n";
    if (!report.stopped.empty()) text += '\n' + report.stopped + '\n';
    return text;
}

std::string as_json(const HardCaseReport& report) {
    ordered_json json{{"schema", "strata.hard_cases"},
                      {"schema_version", 1},
                      {"device", report.device.name},
                      {"driver", report.device.driver},
                      {"rows", ordered_json::array()}};
    if (!report.stopped.empty()) json["stopped"] = report.stopped;
    for (const HardCaseRow& row : report.rows) {
        json["rows"].push_back({{"technique", row.technique}, {"settings", row.settings}});
        for (std::size_t c = 0; c < row.outcomes.size(); ++c)
            json["rows"].back()["cases"].push_back(json_of(hard_cases()[c], row.outcomes[c]));
    }
    return json_text(json);
}

}  // namespace strata
