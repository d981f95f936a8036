// What techniques counted, beside what they counted before: the rows of a table.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "replay/session/session.h"

namespace strata::ui {

/// What is kept of a replay to compare counters with.
struct CountedRun {
    Request request;  ///< without outputs, which change nothing
    std::vector<CounterRecord> counters;
    std::map<std::string, std::string> choices;  ///< as in Run
    std::uint64_t pixels = 0;
};
CountedRun counted_run(const Request&, const Run&);

struct CounterRow {
    Stage stage;
    std::string technique, name, help;
    std::optional<std::uint64_t> now, before;  ///< none: it did not run
    bool differs() const { return now && before && *now != *before; }
};

/// In the order of stages. A counter of a technique that took another's place stands beside the other's of the same name; what
/// was counted before alone has no value now.
std::vector<CounterRow> counter_rows(std::span<const CounterRecord> now, std::span<const CounterRecord> before);

/// "1 234 567".
std::string grouped(std::uint64_t);
/// "+12 (+3.4 %)"; empty where nothing differs.
std::string change_text(const CounterRow&);
/// What was otherwise in a replay: "frame 2", "stage/technique key=value"; empty for nothing.
std::string otherwise(const CountedRun& before, const CountedRun& now);

}  // namespace strata::ui
