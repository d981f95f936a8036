#include "replay/session/describe_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>

namespace strata {

std::vector<CounterRecord> read_counters(const Declaration& d, const Execution& execution, std::optional<std::uint32_t> scope) {
    std::vector<CounterRecord> records;
    for (const CounterSource& source : d.counters) {
        if (scope && source.scope != *scope) continue;
        const auto bytes = execution.buffers.find(source.buffer.id);
        for (const Counter& counter : source.technique->counters) {
            std::uint32_t value = 0;
            if (bytes != execution.buffers.end()) std::memcpy(&value, bytes->second.data() + counter.offset, sizeof value);
            records.push_back({std::string(source.technique->name), std::string(counter.name), value});
        }
    }
    return records;
}

std::vector<CounterRecord> summed(std::vector<CounterRecord> records) {
    std::vector<CounterRecord> sums;
    for (CounterRecord& record : records) {
        const auto same = [&](const CounterRecord& r) { return r.technique == record.technique && r.name == record.name; };
        const auto known = std::ranges::find_if(sums, same);
        if (known == sums.end()) sums.push_back(std::move(record));
        else known->value += record.value;
    }
    return sums;
}

std::map<std::string, HostImage> images_of(const Declaration& d, const Execution& execution) {
    std::map<std::string, HostImage> images;
    for (const auto& [name, image] : d.outputs)
        if (const auto found = execution.images.find(image.id); found != execution.images.end())
            images.emplace(name, found->second);
    return images;
}

NumberTable table_of(const DebugTable& description, const HostImage& image) {
    NumberTable table{.columns = description.columns};
    for (const glm::dvec4& texel : in_double(image).texels) {
        if (std::isnan(texel.x)) continue;
        const std::array numbers{texel.x, texel.y, texel.z, texel.w};
        table.rows.emplace_back(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(table.columns.size()));
    }
    return table;
}

std::map<std::string, NumberTable> tables_of(const Declaration& d, const Execution& execution) {
    std::map<std::string, NumberTable> tables;
    for (const auto& [name, source] : d.tables)
        if (const auto found = execution.images.find(source.second.id); found != execution.images.end())
            tables.emplace(name, table_of(*source.first, found->second));
    return tables;
}

std::string choice_line(const Choice& choice) {
    std::string line(choice.technique->name);
    for (const std::string& setting : choice.settings.lines()) line += " " + setting;
    return line;
}

Run describe_run(const Declaration& d) {
    Run run{.skipped = d.frame.skipped,
            .culled = d.plan.culled,
            .width = d.images.extent.width,
            .height = d.images.extent.height,
            .samples = d.images.samples,
            .image_bytes = d.plan.image_bytes,
            .buffer_bytes = d.plan.buffer_bytes};
    for (const PlannedStep& step : d.plan.steps) run.steps.push_back({d.plan.scopes[step.step.scope], step.step.name, {}});
    for (const DeclaredAct& act : d.frame.acts)
        run.choices[std::string(name(act.technique->stage))] = choice_line(d.choices.at(act.technique->stage));
    run.memory.over_time = memory_over_time(d.plan);
    for (const auto& [stage, memory] : run.memory.over_time.stages) run.stage_bytes[stage] = memory.allocated;
    run.acts_from_memo = d.scopes_from_memo.size();
    std::set<std::uint32_t> scopes;
    for (const PlannedStep& step : d.plan.steps) scopes.insert(step.step.scope);
    for (const DeclaredAct& act : d.frame.acts) run.acts_executed += scopes.contains(act.scope);
    return run;
}

void add_costs(Run& run, const std::vector<std::vector<StepCost>>& repeats) {
    const auto sums_of = [&](const std::function<bool(std::size_t)>& counts) {
        std::vector<double> sums;
        for (const std::vector<StepCost>& steps : repeats) {
            sums.push_back(0);
            for (std::size_t i = 0; i < steps.size(); ++i)
                if (counts(i)) sums.back() += steps[i].ms;
        }
        return sums;
    };
    run.frame_ms = spread_of(sums_of([](std::size_t) { return true; }));
    for (std::size_t i = 0; i < run.steps.size(); ++i) {
        run.steps[i].ms_by_repeat = sums_of([&](std::size_t step) { return step == i; });
        run.steps[i].ms = spread_of(run.steps[i].ms_by_repeat);
    }
    for (const auto& [stage, choice] : run.choices) {
        const auto is_its = [&](std::size_t step) {
            const Scope& scope = run.steps[step].scope;
            return scope.kind == ScopeKind::act && name(scope.stage) == stage;
        };
        const auto sums = sums_of(is_its);
        run.stage_ms[stage] = spread_of(sums);
        run.stage_ms_by_repeat[stage] = sums;
        for (std::size_t i = 0; !repeats.empty() && i < repeats.back().size(); ++i)
            if (is_its(i) && repeats.back()[i].invocations) run.stage_invocations[stage] += *repeats.back()[i].invocations;
    }
}

}  // namespace strata
