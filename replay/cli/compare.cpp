// strata compare: two reports beside each other, and whether the second costs too much more.
#include <memory>

#include <CLI/CLI.hpp>

#include "replay/cli/given_options.h"
#include "replay/cli/limits.h"
#include "replay/cli/table_output.h"
#include "replay/cli/verb_options.h"
#include "replay/compare/report_comparison.h"
#include "replay/plural.h"

namespace strata {
namespace {

struct CompareArguments {
    std::filesystem::path a, b;
    std::string cost{name(CostKind::ms)}, fail_above;
    std::uint64_t memory_budget = 0;
    TableOutput output;
};

CostKind cost_called(std::string_view text) {
    for (const CostKind cost : {CostKind::ms, CostKind::time})
        if (name(cost) == text) return cost;
    return CostKind::bytes_per_pixel;
}

Result<ReportComparison> read_and_compare(const CompareArguments& options) {
    MemoryBudget budget(options.memory_budget);
    auto a = read_report(options.a, budget);
    if (!a) return a.error();
    auto b = read_report(options.b, budget);
    if (!b) return b.error();
    return compare_reports(*std::move(a), *std::move(b), cost_called(options.cost));
}

Result<void> compare(const CompareArguments& options) {
    if (const auto fits = check_ending(options.output); !fits) return fits;
    const auto limit = parse_limit("--fail-above", options.fail_above, "%", .01);
    if (!limit) return limit.error();
    auto made = read_and_compare(options);
    if (!made) return made.error();
    made->date = date_of_output();
    if (const auto done = write_text(options.output, in_format(file_format(options.output, OutputFormat::text), *made)); !done)
        return done;
    if (*limit) {
        if (const auto holds = check_growth(*made, **limit); !holds) return holds;
        if (const std::size_t rows = rows_not_judged(*made); rows > 0)
            to_stderr("strata: --fail-above did not judge {} one by one: without a time, or timed fewer than {} times\n",
                      plural(rows, "row"), fewest_repeats_of_row);
    }
    return check_overlap(*made);
}

}  // namespace

std::function<Result<void>()> declare_compare(CLI::App& app) {
    const auto options = std::make_shared<CompareArguments>();
    app.add_option("a", options->a, "report A, the reference (.json, of strata report -o)")->required()->type_name(input_file);
    app.add_option("b", options->b, "report B")->required()->type_name(input_file);
    app.add_option(
           "--cost", options->cost,
           "cost to compare: ms (default), time (multiples of the baseline's, so that a slower machine cancels) or memory")
        ->check(one_of(
            {std::string(name(CostKind::ms)), std::string(name(CostKind::time)), std::string(name(CostKind::bytes_per_pixel))}));
    app.add_option(
        "--fail-above", options->fail_above,
        "exit code 1 if B costs over this much more than A, like 5%, beyond the spread, or lacks a row of A; single rows need 7 "
        "repeats. Errors are not judged");
    add_memory_budget(app, options->memory_budget);
    add_formats(app, options->output);
    add_output_file(app, options->output,
                    "write the comparison to this file instead of stdout, in the format of its ending: .json, .csv, .md or .txt");
    return [options] { return compare(*options); };
}

}  // namespace strata
