#include "ui/frame/counter_rows.h"

#include <algorithm>

#include "passes/registry.h"
#include "passes/technique.h"

namespace strata::ui {
namespace {

/// What a technique says about a counter; null for records of a technique that is gone.
const Counter* find_counter(const CounterRecord& record, const Technique*& technique) {
    const auto found = find_technique(record.technique);
    if (!found) return nullptr;
    technique = *found;
    const auto counter = std::ranges::find(technique->counters, record.name, &Counter::name);
    return counter == technique->counters.end() ? nullptr : &*counter;
}

void add_rows(std::vector<CounterRow>& rows, std::span<const CounterRecord> records,
              std::optional<std::uint64_t> CounterRow::*value) {
    for (const CounterRecord& record : records) {
        const Technique* technique = nullptr;
        const Counter* counter = find_counter(record, technique);
        if (!counter) continue;
        const auto same = [&](const CounterRow& row) { return row.technique == record.technique && row.name == record.name; };
        const auto stands_for = [&](const CounterRow& row) {
            return row.stage == technique->stage && row.name == record.name && !(row.*value);
        };
        auto row = std::ranges::find_if(rows, same);
        if (row == rows.end()) row = std::ranges::find_if(rows, stands_for);
        if (row == rows.end()) {
            rows.push_back({technique->stage, record.technique, record.name, std::string(counter->help), {}, {}});
            row = rows.end() - 1;
        }
        (*row).*value = record.value;
    }
}

}  // namespace

CountedRun counted_run(const Request& request, const Run& run) {
    CountedRun counted{request, run.counters, run.choices, std::uint64_t(run.width) * run.height};
    counted.request.outputs.clear();
    return counted;
}

std::vector<CounterRow> counter_rows(std::span<const CounterRecord> now, std::span<const CounterRecord> before) {
    std::vector<CounterRow> rows;
    add_rows(rows, now, &CounterRow::now);
    add_rows(rows, before, &CounterRow::before);
    std::ranges::stable_sort(rows, {}, [](const CounterRow& row) { return std::pair(row.stage, row.technique); });
    return rows;
}

std::string grouped(std::uint64_t number) {
    std::string text = fmt::format("{}", number);
    for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ' ');
    return text;
}

std::string change_text(const CounterRow& row) {
    if (!row.differs()) return {};
    const bool is_more = *row.now > *row.before;
    const std::uint64_t by = is_more ? *row.now - *row.before : *row.before - *row.now;
    const std::string number = fmt::format("{}{}", is_more ? "+" : "\xe2\x88\x92", grouped(by));
    if (*row.before == 0) return number;
    const double percent = 100 * static_cast<double>(by) / static_cast<double>(*row.before);
    return fmt::format("{} ({}{:.3g} %)", number, is_more ? "+" : "\xe2\x88\x92", percent);
}

std::string otherwise(const CountedRun& before, const CountedRun& now) {
    if (before.request.variant.frame != now.request.variant.frame) return fmt::format("frame {}", before.request.variant.frame);
    std::string text;
    const auto add = [&](const std::string& what) { text += fmt::format("{}{}", text.empty() ? "" : ", ", what); };
    for (const auto& [stage, choice] : now.choices) {
        const auto was = before.choices.find(stage);
        if (was == before.choices.end()) add(fmt::format("without {}", stage));
        else if (was->second != choice) add(was->second);
    }
    for (const auto& [stage, choice] : before.choices)
        if (!now.choices.contains(stage)) add(choice);
    if (before.pixels != now.pixels) add(fmt::format("{} pixels", grouped(before.pixels)));
    if (before.request.variant.samples != now.request.variant.samples) add("other samples");
    if (before.request.variant.eye != now.request.variant.eye) add("another eye");
    if (before.request.variant.force != now.request.variant.force) add("other forced features");
    return text;
}

}  // namespace strata::ui
