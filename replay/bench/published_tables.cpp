#include "replay/bench/published_tables.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "passes/claims.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/bench/timed_variants.h"
#include "replay/isa/occupancy.h"
#include "replay/session/memory_need.h"

namespace strata {
namespace {

/// A row and the requests that measure it, by their places among those of the table.
struct RowRequests {
    const TableRow* row = nullptr;
    std::optional<Variant> variant = {}, against = {};
    std::size_t request = 0, request_against = 0;
    std::string not_measured = {};  ///< why it does not run
};

/// A row with its runs: null where it does not run, and where it is divided by no other.
struct TimedRow {
    const RowRequests* of = nullptr;
    const Run *run = nullptr, *against = nullptr;
};

/// What a cell is; times by repeat, where it is a time.
struct Found {
    CellValue value = {};
    std::vector<double> times = {};
    std::string not_measured = {};
};

std::size_t place_of(const Request& request, std::vector<Request>& requests) {
    const auto found = std::ranges::find(requests, request);
    if (found != requests.end()) return static_cast<std::size_t>(found - requests.begin());
    requests.push_back(request);
    return requests.size() - 1;
}

/// Whether a row goes without a number for this: the frame or the device cannot do it.
bool is_of_the_row(const Error& error) { return error.fault == Fault::usage || error.fault == Fault::device_lacks; }

Result<RowRequests> requests_of(Session& session, const TableClaim& claim, const TableRow& row, std::vector<Request>& requests) {
    RowRequests made{.row = &row};
    if (!row.variant) {
        made.not_measured = row.not_measured;
        return made;
    }
    const auto variant = variant_of(*claim.technique, *row.variant, claim.base);
    if (!variant) return variant.error();
    const auto against = row.against ? variant_of(*claim.technique, *row.against, claim.base) : variant;
    if (!against) return against.error();
    for (const Variant* one : {&*variant, &*against})
        if (const auto can = check_can_run(session, *one); !can) {
            if (!is_of_the_row(can.error())) return can.error();
            made.not_measured = can.error().sentence;
            return made;
        }
    made.variant = *variant;
    made.request = place_of(variant->request, requests);
    if (!row.against) return made;
    made.against = *against;
    made.request_against = place_of(against->request, requests);
    return made;
}

Found found_time(const TimedRow& timed, const TableValueColumn& column) {
    const auto times = times_of_steps(*timed.run, timed.of->variant->technique->name, column.parts);
    if (times.empty()) return {.not_measured = "no such step"};
    if (!timed.against) return {.value = spread_of(times), .times = times};
    const auto units = times_of_steps(*timed.against, timed.of->against->technique->name, column.parts);
    if (units.empty()) return {.not_measured = "no such step"};
    if (std::ranges::min(units) <= 0) return {.not_measured = "the device's clock is too coarse for so small a frame"};
    return {.value = ratio_of(times, units)};
}

Result<Found> found_memory(Session& session, const TimedRow& timed, const TableValueColumn& column) {
    const auto planned = session.plan(timed.of->variant->request);
    if (!planned) return planned.error();
    std::uint64_t bytes = 0;
    for (const Life& life : lives_of(planned->plan)) {
        const std::string_view called =
            life.is_image ? std::string_view(planned->plan.images[life.id].name) : planned->plan.buffers[life.id].name;
        const auto is_part = [&](std::string_view part) { return called.find(part) != std::string_view::npos; };
        if (std::ranges::any_of(column.parts, is_part)) bytes += life.bytes;
    }
    if (bytes == 0) return Found{.not_measured = "no such image or buffer"};
    const double samples = double(timed.run->width) * timed.run->height * timed.run->samples;
    return Found{.value = column.value == TableValue::megabytes ? double(bytes) * 1e-6 : 8 * double(bytes) / samples};
}

Found found_counter(const TimedRow& timed, const TableValueColumn& column) {
    for (const std::string_view part : column.parts)
        for (const CounterRecord& counter : timed.run->counters)
            if (counter.technique == timed.of->variant->technique->name && counter.name == part) return {.value = counter.value};
    return {.not_measured = "no such counter"};
}

Found found_invocations(const Session& session, const TimedRow& timed, const TableValueColumn& column) {
    if (session.device().software) return {.not_measured = "this driver counts fragments wrongly"};
    const auto found = timed.run->stage_invocations.find(std::string(column.parts.front()));
    if (found == timed.run->stage_invocations.end()) return {.not_measured = "the device does not count invocations"};
    return {.value = found->second};
}

Result<Found> found_waves(const TableRow& row, const TableValueColumn& column) {
    const auto gpu = find_gpu_model(column.parts.front());
    if (!gpu) return gpu.error();
    const ShaderResources group{
        .lds_bytes = row.group.lds_bytes, .group_threads = row.group.threads, .wave_lanes = (*gpu)->unit->lanes};
    return Found{.value = occupancy(**gpu, group).waves_per_simd};
}

Result<Found> found(Session& session, const TimedRow& timed, const TableValueColumn& column, const TableCell& stated) {
    if (column.value == TableValue::waves) return found_waves(*timed.of->row, column);
    if (column.value == TableValue::given && stated.ours) return Found{.value = *stated.ours};
    if (!timed.run) return Found{.not_measured = timed.of->not_measured};
    switch (column.value) {
        case TableValue::milliseconds:
            return found_time(timed, column);
        case TableValue::megabytes:
        case TableValue::bits_per_sample:
            return found_memory(session, timed, column);
        case TableValue::counter:
            return found_counter(timed, column);
        case TableValue::invocations:
            return found_invocations(session, timed, column);
        case TableValue::waves:
        case TableValue::given:
        case TableValue::nothing:
            break;
    }
    return Found{.not_measured = "nothing counts it"};
}

/// Times within each repeat, as the load of the machine then cancels; anything else by its numbers.
CellValue multiple_of(const Found& cell, const Found& unit) {
    if (!cell.times.empty() && !unit.times.empty() && std::ranges::min(unit.times) > 0) return ratio_of(cell.times, unit.times);
    const auto number = cell_number(cell.value), by = cell_number(unit.value);
    return number && by && *by > 0 ? CellValue(*number / *by) : CellValue();
}

Result<void> add_column(Session& session, std::span<const TimedRow> timed, std::size_t column, MeasuredTable& made) {
    const TableValueColumn& is = made.claim.table->columns[column];
    std::optional<Found> first;
    std::optional<double> first_published;
    for (const TimedRow& row : timed) {
        const TableCell& stated = row.of->row->cells[column];
        auto cell = found(session, row, is, stated);
        if (!cell) return cell.error();
        if (!first) {
            first = *cell;
            first_published = stated.published;
        }
        const bool has_multiple = stated.published && first_published && *first_published > 0;
        made.cells.push_back(
            {.row = std::string(row.of->row->label),
             .column = std::string(is.title),
             .unit = std::string(is.unit),
             .stated = &stated,
             .measured = cell->value,
             .multiple = multiple_of(*cell, *first),
             .published_multiple = has_multiple ? std::optional(*stated.published / *first_published) : std::nullopt,
             .not_measured = cell->not_measured});
    }
    return {};
}

void add_row(const TimedRow& timed, MeasuredTable& made) {
    const Variant& variant = *timed.of->variant;
    const Run& run = *timed.run;
    MeasuredTableRow row{.row = std::string(timed.of->row->label), .variant = label(variant.technique->name, variant.settings)};
    if (timed.of->against) row.against = label(timed.of->against->technique->name, timed.of->against->settings);
    const auto bytes = run.stage_bytes.find(std::string(name(variant.technique->stage)));
    if (bytes != run.stage_bytes.end()) row.stage_bytes = bytes->second;
    const RatioWitness& witness = made.claim.table->witness;
    for (const CounterRecord& counter : run.counters) {
        if (counter.technique != variant.technique->name) continue;
        if (std::ranges::count(made.claim.table->counters, counter.name) > 0) row.counters.push_back(counter);
        if (counter.name == witness.counter && double(counter.value) > witness.more_than) made.is_witnessed = true;
    }
    made.rows.push_back(std::move(row));
}

Result<MeasuredTable> measure(Session& session, const TableClaim& claim, std::size_t repeats) {
    std::vector<Request> requests;
    std::vector<RowRequests> rows;
    for (const TableRow& row : claim.table->rows) {
        auto made = requests_of(session, claim, row, requests);
        if (!made) return made.error();
        rows.push_back(*std::move(made));
    }
    const auto counts = [](const TableValueColumn& column) { return column.value == TableValue::invocations; };
    for (Request& request : requests) request.counted = std::ranges::any_of(claim.table->columns, counts);
    const auto runs = requests.empty() ? Result(std::vector<Run>()) : session.time(requests, repeats);
    if (!runs) return runs.error();
    if (!runs->empty() && runs->front().frame_ms_by_repeat.size() < repeats)
        return fail(Fault::stopped, "session.stopped", "stopped after some of the timed runs");
    MeasuredTable made{.claim = claim, .is_witnessed = claim.table->witness.counter.empty()};
    std::vector<TimedRow> timed;
    for (const RowRequests& row : rows) {
        timed.push_back({.of = &row});
        if (!row.variant) continue;
        timed.back().run = &(*runs)[row.request];
        if (row.against) timed.back().against = &(*runs)[row.request_against];
        add_row(timed.back(), made);
    }
    if (!runs->empty()) {
        const Run& run = runs->front();
        std::tie(made.width, made.height, made.samples) = std::tuple(run.width, run.height, run.samples);
    }
    for (std::size_t i = 0; i < claim.table->columns.size(); ++i)
        if (const auto done = add_column(session, timed, i, made); !done) return done.error();
    return made;
}

}  // namespace

Result<PublishedTables> measure_tables(Session& session, std::span<const TableClaim> claims, std::size_t repeats,
                                       const Progress& progress) {
    PublishedTables made{.device = session.device(), .repeats = repeats};
    for (const TableClaim& claim : claims) {
        if (progress) progress(claim.table->title, double(made.tables.size()) / double(claims.size()));
        auto table = measure(session, claim, repeats);
        if (table) {
            made.tables.push_back(*std::move(table));
            continue;
        }
        if (table.error().fault != Fault::stopped || made.tables.empty()) return table.error();
        made.stopped = fmt::format("stopped after {} of {} tables", made.tables.size(), claims.size());
        break;
    }
    if (progress) progress("done", 1);
    return made;
}

}  // namespace strata
