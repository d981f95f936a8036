// The matrix of hard cases for a terminal, and as JSON.
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "replay/report/hard_cases.h"

namespace strata {
namespace {

std::string_view id(const HardCase& hard_case) { return hard_case.name.substr(0, hard_case.name.find(' ')); }

/// "ok", or the error with what it means: "!" a bug, "?" better than its record.
std::string cell(const HardOutcome& outcome) {
    using Verdict = HardOutcome::Verdict;
    switch (outcome.verdict) {
        case Verdict::holds:
            return "ok";
        case Verdict::not_applicable:
            return "-";
        case Verdict::documented:
            return fmt::format("{:.2g}", outcome.error);
        case Verdict::undocumented:
            return fmt::format("{:.2g}!", outcome.error);
        case Verdict::undeserved:
            return "ok?";
    }
    return "";
}

}  // namespace

std::string as_text(const HardCaseReport& report) {
    std::string text = fmt::format("hard cases of transparency on {} ({})\n\n", report.device.name, report.device.driver);
    std::size_t width = 4;
    for (const HardCase& hard_case : hard_cases()) width = std::max(width, hard_case.name.size());
    for (std::size_t i = 0; i < report.rows.size(); ++i) text += fmt::format("  {:>2}  {}\n", i + 1, report.rows[i].technique);
    text += fmt::format("\n  {:<{}}  {:>8}", "case", width, "holds at");
    for (std::size_t i = 0; i < report.rows.size(); ++i) text += fmt::format("  {:>7}", i + 1);
    text += '\n';
    for (std::size_t c = 0; c < hard_cases().size(); ++c) {
        text += fmt::format("  {:<{}}  {:>8.2g}", hard_cases()[c].name, width, hard_cases()[c].accept);
        for (const HardCaseRow& row : report.rows) text += fmt::format("  {:>7}", cell(row.outcomes[c]));
        text += '\n';
    }
    text +=
        "\nok: holds. A number: fails by so much, as the technique documents. -: not applicable. !: a failure that is not\n"
        "documented, or of another size. ok?: holds what is documented as a failure.\n";
    return text;
}

std::string as_json(const HardCaseReport& report) {
    nlohmann::ordered_json json{{"device", report.device.name}, {"driver", report.device.driver}};
    for (const HardCaseRow& row : report.rows) {
        nlohmann::ordered_json cases;
        for (std::size_t c = 0; c < row.outcomes.size(); ++c) {
            const HardOutcome& outcome = row.outcomes[c];
            nlohmann::ordered_json entry{{"case", id(hard_cases()[c])},
                                         {"question", hard_cases()[c].question},
                                         {"accept", hard_cases()[c].accept},
                                         {"verdict", name(outcome.verdict)}};
            if (outcome.verdict != HardOutcome::Verdict::not_applicable) {
                entry["error"] =
                    std::isfinite(outcome.error) ? nlohmann::ordered_json(outcome.error) : nlohmann::ordered_json("infinite");
                entry["model_worst"] = outcome.model_worst;
            }
            if (outcome.documented > 0) entry["documented"] = outcome.documented;
            if (!outcome.reason.empty()) entry["because"] = outcome.reason;
            cases.push_back(std::move(entry));
        }
        json["techniques"].push_back({{"technique", row.technique}, {"cases", std::move(cases)}});
    }
    return json.dump(2) + '\n';
}

}  // namespace strata
