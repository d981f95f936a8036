// What strata report is asked for on the command line, as a request.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "replay/cli/table_output.h"
#include "replay/cli/verb_options.h"
#include "replay/report/report.h"

namespace strata {

struct ReportArguments {
    std::vector<std::filesystem::path> captures;
    OpenOptions open;
    ChoiceOptions choices;
    std::string stage = "transparency";
    std::vector<std::string> sweeps, techniques;
    std::string error, within, cost = "time", error_at, metric = "display";
    std::optional<std::uint64_t> memory;
    bool defaults = false;
    std::string frames = "0";
    std::optional<std::size_t> repeats;
    std::optional<double> minutes;
    std::optional<std::uint32_t> flicker;
    std::optional<double> dolly, pan;
    bool hard_cases = false, variants = false, needs = false;
    std::string eye;
    TableOutput output;
};

/// Refuses what no row could keep, before a capture is opened.
Result<ReportRequest> request_of(const ReportArguments&);

}  // namespace strata
