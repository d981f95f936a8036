#include "replay/session/describe_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>

#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"

namespace strata {

namespace {

/// 0 where the run did not get as far.
std::uint32_t count_of(const Execution& execution, const CounterSource& source, const Counter& counter) {
    std::uint32_t value = 0;
    if (const auto bytes = execution.buffers.find(source.buffer.id); bytes != execution.buffers.end())
        std::memcpy(&value, bytes->second.data() + counter.offset, sizeof value);
    return value;
}

bool is_of_stage(const Scope& scope, std::string_view stage) {
    return scope.kind == ScopeKind::pass && name(scope.stage) == stage;
}

}  // namespace

std::vector<CounterRecord> read_counters(const Declaration& d, const Execution& execution, std::optional<std::uint32_t> scope) {
    std::vector<CounterRecord> records;
    for (const CounterSource& source : d.counters) {
        if (scope && source.scope != *scope) continue;
        for (const Counter& counter : source.technique->counters)
            records.push_back(
                {std::string(source.technique->name), std::string(counter.name), count_of(execution, source, counter)});
    }
    return records;
}

Result<Execution> without_fatal_counts(const Declaration& d, Execution execution) {
    for (const CounterSource& source : d.counters)
        for (const Counter& counter : source.technique->counters)
            if (const std::uint32_t count = count_of(execution, source, counter); counter.is_fatal && count > 0)
                return fail(Fault::device_lacks, "technique.fatal_counter",
                            "what {technique} shows would be wrong on this device: {count} {counter} ({help})",
                            source.technique->name, count, counter.name, counter.help);
    return execution;
}

std::set<std::string> not_counted(const Declaration& d, std::optional<std::size_t> until) {
    std::set<std::uint32_t> scopes = d.plan.uncounted_scopes;
    for (std::size_t i = until ? *until + 1 : d.plan.steps.size(); i < d.plan.steps.size(); ++i)
        if (writes_counters(d.graph, d.plan.steps[i])) scopes.insert(d.plan.steps[i].step.scope);
    std::set<std::string> techniques;
    for (const CounterSource& source : d.counters)
        if (scopes.contains(source.scope)) techniques.emplace(source.technique->name);
    return techniques;
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

std::vector<CounterRecord> run_counters(const Declaration& d, const Execution& execution, std::optional<std::size_t> until) {
    std::vector<CounterRecord> counters = read_counters(d, execution);
    counters.insert(counters.end(), d.kept_counters.begin(), d.kept_counters.end());
    counters = summed(std::move(counters));
    const std::set<std::string> without = not_counted(d, until);
    std::erase_if(counters, [&](const CounterRecord& counter) { return without.contains(counter.technique); });
    return counters;
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

std::vector<UnsupportedChoice> not_supported(const Declaration& d, const Features& features) {
    std::vector<UnsupportedChoice> choices;
    for (const auto& [stage, choice] : d.choices) {
        const Technique& technique = *choice.technique;
        if (std::string reason = unsupported_because(technique, features);
            !reason.empty() && std::ranges::count(d.frame.passes, &technique, &DeclaredPass::technique))
            choices.push_back({std::string(technique.name), std::move(reason)});
    }
    return choices;
}

std::vector<std::string> notes_of_techniques(const Declaration& d) {
    std::vector<std::string> notes;
    for (const auto& [stage, choice] : d.choices) {
        const Technique& technique = *choice.technique;
        if (!technique.notes || !std::ranges::count(d.frame.passes, &technique, &DeclaredPass::technique)) continue;
        std::ranges::copy(technique.notes(d.images, choice.settings), std::back_inserter(notes));
    }
    return notes;
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
    for (const DeclaredPass& pass : d.frame.passes)
        run.choices[std::string(name(pass.technique->stage))] = choice_line(d.choices.at(pass.technique->stage));
    run.memory.over_time = memory_over_time(d.plan);
    for (const auto& [stage, memory] : run.memory.over_time.stages) run.stage_bytes[stage] = memory.allocated;
    run.passes_from_memo = d.scopes_from_memo.size();
    std::set<std::uint32_t> scopes;
    for (const PlannedStep& step : d.plan.steps) scopes.insert(step.step.scope);
    for (const DeclaredPass& pass : d.frame.passes) run.passes_executed += scopes.contains(pass.scope);
    return run;
}

void add_invocations(Run& run, const std::vector<StepCost>& steps) {
    for (const auto& [stage, choice] : run.choices)
        for (std::size_t i = 0; i < steps.size(); ++i)
            if (is_of_stage(run.steps[i].scope, stage) && steps[i].invocations)
                run.stage_invocations[stage] += *steps[i].invocations;
}

void add_costs(Run& run, const std::vector<std::vector<StepCost>>& repeats, const SortTimes& sorts) {
    const auto sums_of = [&](const std::function<bool(std::size_t)>& counts) {
        std::vector<double> sums;
        for (const std::vector<StepCost>& steps : repeats) {
            sums.push_back(0);
            for (std::size_t i = 0; i < steps.size(); ++i)
                if (counts(i)) sums.back() += steps[i].ms;
        }
        return sums;
    };
    const auto add_sorts = [&](const std::string& stage, std::vector<double>& sums) {
        const auto found = sorts.find(stage);
        for (std::size_t i = 0; found != sorts.end() && i < sums.size(); ++i) sums[i] += found->second[i];
    };
    std::vector<double> frame_sums = sums_of([](std::size_t) { return true; });
    for (const auto& [stage, ms] : sorts) {
        add_sorts(stage, frame_sums);
        run.stage_sort_ms[stage] = spread_of(ms);
    }
    run.stage_sort_ms_by_repeat = sorts;
    run.frame_ms = spread_of(frame_sums);
    run.frame_ms_by_repeat = std::move(frame_sums);
    for (std::size_t i = 0; i < run.steps.size(); ++i) {
        run.steps[i].ms_by_repeat = sums_of([&](std::size_t step) { return step == i; });
        run.steps[i].ms = spread_of(run.steps[i].ms_by_repeat);
    }
    for (const auto& [stage, choice] : run.choices) {
        auto sums = sums_of([&](std::size_t step) { return is_of_stage(run.steps[step].scope, stage); });
        add_sorts(stage, sums);
        run.stage_ms[stage] = spread_of(sums);
        run.stage_ms_by_repeat[stage] = sums;
    }
}

}  // namespace strata
