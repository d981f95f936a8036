// What a measured ratio says of itself, for every format; below the table of ratios text has what either variant is, took and
// counted.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passes/claims.h"
#include "passes/technique.h"
#include "replay/bench/bench.h"
#include "replay/json_text.h"
#include "replay/plural.h"
#include "replay/report/variants.h"
#include "replay/tables/document.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

using Ratios = std::vector<Column<MeasuredRatio>>;
using OfRatio = Column<MeasuredRatio>::Of;

Column<MeasuredRatio> name_column(std::string key, std::string help, std::string (*text)(const MeasuredRatio&)) {
    return {{.key = key, .title = key, .help = std::move(help), .kind = CellKind::text, .shown = in_files},
            [text](const MeasuredRatio& row) { return cell_if_any(text(row)); },
            OfRatio::every_row};
}

Ratios names_of_ratio() {
    return {name_column("technique", "technique that states the ratio",
                        [](const MeasuredRatio& row) { return std::string(row.claim.technique->name); }),
            name_column("name", "name of the ratio", [](const MeasuredRatio& row) { return std::string(row.claim.ratio->name); }),
            name_column("scene", "scenario or capture", [](const MeasuredRatio& row) { return row.claim.scene; }),
            {{.key = "frame", .title = "frame", .help = "index of the frame", .kind = CellKind::count, .shown = in_files},
             [](const MeasuredRatio& row) { return std::uint64_t{row.claim.base.variant.frame}; },
             OfRatio::every_row}};
}

Ratios ratios() {
    return {{{.key = "ratio",
              .title = "measured",
              .help = "the ratio of times within each repeat: its median and median absolute deviation",
              .kind = CellKind::ratio},
             [](const MeasuredRatio& row) { return row.ratio; }},
            {{.key = "published",
              .title = "published",
              .help = "the ratio that the source states; absent if it states none",
              .digits = ".2f",
              .json = "/published/ratio"},
             [](const MeasuredRatio& row) { return cell_or_nothing(row.claim.ratio->published); },
             OfRatio::every_row},
            {{.key = "published_source",
              .title = "source",
              .help = "where it is published",
              .kind = CellKind::text,
              .shown = in_files,
              .json = "/published/source"},
             [](const MeasuredRatio& row) {
                 return row.claim.ratio->published ? CellValue(std::string(row.claim.ratio->source)) : CellValue();
             },
             OfRatio::every_row},
            {{.key = "witness",
              .title = "witness",
              .help = "counter that one variant must exceed, or both did the same work and the row is not measured",
              .kind = CellKind::text,
              .shown = in_files},
             [](const MeasuredRatio& row) {
                 const RatioWitness& witness = row.claim.ratio->witness;
                 if (witness.counter.empty()) return CellValue();
                 return CellValue(fmt::format("{} > {:g}", witness.counter, witness.more_than));
             },
             OfRatio::every_row},
            {{.key = "samples", .title = "samples", .help = "samples per pixel", .kind = CellKind::count, .shown = in_files},
             [](const MeasuredRatio& row) { return std::uint64_t{row.samples}; }},
            {{.key = "not_measured",
              .title = "not measured",
              .help = "instead of numbers: why the row could not be measured here (nothing transparent, a feature that one "
                      "variant lacks, nothing overflowed)",
              .kind = CellKind::text,
              .shown = in_files},
             [](const MeasuredRatio& row) { return cell_if_any(row.not_measured); },
             OfRatio::every_row}};
}

/// One of the two variants, a part of its own in JSON.
Ratios way_columns(const std::string& which, std::string ms, TimedVariant MeasuredRatio::*variant) {
    const auto described = [&](const std::string& key, std::string title, std::string help, CellKind kind) {
        return Described{.key = fmt::format("{}_{}", which, key),
                         .title = std::move(title),
                         .help = fmt::format("{}: {}", which, help),
                         .kind = kind,
                         .shown = in_files,
                         .json = fmt::format("/{}/{}", which, key)};
    };
    Ratios columns{{described("technique", "technique", "technique of this variant", CellKind::text),
                    [variant](const MeasuredRatio& row) { return (row.*variant).technique; }},
                   {described("settings", "settings", "its settings", CellKind::text),
                    [variant](const MeasuredRatio& row) { return (row.*variant).settings; }},
                   {described("frame", "frame", "what is changed in its frame", CellKind::text),
                    [variant](const MeasuredRatio& row) { return cell_if_any((row.*variant).frame); }},
                   {described("ms", std::move(ms), "milliseconds of the steps that count", CellKind::median),
                    [variant](const MeasuredRatio& row) { return (row.*variant).ms; }},
                   {described("stage_bytes", "bytes", "memory that the technique uses first", CellKind::count),
                    [variant](const MeasuredRatio& row) { return (row.*variant).stage_bytes; }}};
    columns[3].is.shown = in_text | in_files;
    return columns;
}

std::string variant_text(const TimedVariant& variant) {
    std::vector<std::string> parts{fmt::format("{} +-{} ms", short_number(variant.ms.median), short_number(variant.ms.mad)),
                                   fmt::format("{:.2f} MiB", double(variant.stage_bytes) / 0x1p20)};
    for (const CounterRecord& counter : variant.counters) parts.push_back(fmt::format("{} {}", counter.name, counter.value));
    const std::string frame = variant.frame.empty() ? "" : ", " + variant.frame;
    return fmt::format("{}{}: {}", label(variant.technique, variant.settings), frame, fmt::join(parts, ", "));
}

std::string details_of(const MeasuredRatio& row) {
    const TimeRatio& stated = *row.claim.ratio;
    std::string text = wrapped("", fmt::format("{}: {}", row.claim.technique->name, stated.name));
    if (!row.not_measured.empty()) return text + wrapped("    ", "not measured: " + row.not_measured);
    text += wrapped("    ", variant_text(row.of)) + wrapped("    ", "against " + variant_text(row.against));
    const std::vector<std::string> steps = counted_steps(stated);
    text += wrapped("    ", fmt::format("{} of {}, {} x {}, {} per pixel",
                                        steps.empty() ? "the whole stage" : fmt::format("{}", fmt::join(steps, ", ")),
                                        row.claim.scene, row.width, row.height, plural(row.samples, "sample")));
    if (stated.published) text += wrapped("    ", fmt::format("published: {:.2f}, {}", *stated.published, stated.source));
    return text;
}

/// What of a row is no single value.
void add_parts(nlohmann::ordered_json& json, const MeasuredRatio& row) {
    json["steps"] = counted_steps(*row.claim.ratio);
    if (!row.not_measured.empty()) return;
    json["extent"] = {row.width, row.height};
    for (const auto& [key, variant] : {std::pair("of", &row.of), std::pair("against", &row.against)}) {
        json[key]["counters"] = nlohmann::ordered_json::object();
        for (const CounterRecord& counter : variant->counters) json[key]["counters"][counter.name] = counter.value;
    }
}

}  // namespace

Sheet sheet_of(const Bench& bench) {
    Ratios columns = names_of_ratio();
    for (Ratios more :
         {ratios(), way_columns("of", "ms", &MeasuredRatio::of), way_columns("against", "against ms", &MeasuredRatio::against)})
        std::ranges::move(more, std::back_inserter(columns));
    Sheet sheet = sheet_of<MeasuredRatio>(columns, bench.rows, [](const MeasuredRatio& row) {
        return RowName{"", std::string(row.claim.ratio->name),
                       row.not_measured.empty() ? "" : "not measured: " + row.not_measured};
    });
    sheet.heads_labels = "ratio";
    return sheet;
}

Page page_of(const Bench& bench) {
    std::string text = fmt::format("device {} ({}), {} of each variant, in turn within one run\n", bench.device.name,
                                   bench.device.driver, plural(bench.repeats, "timed run"));
    if (bench.device.software) text += "a CPU renders here: times rank variants on this driver only, they model no GPU\n";
    std::string below;
    for (const MeasuredRatio& row : bench.rows) below += fmt::format("\n{}", details_of(row));
    if (!bench.stopped.empty()) below += fmt::format("\n{}\n", bench.stopped);
    return {text + "\n", sheet_of(bench), below};
}

std::string as_text(const Bench& bench) { return as_text(page_of(bench)); }
std::string as_csv(const Bench& bench) { return as_csv(std::vector{sheet_of(bench)}); }

std::string as_json(const Bench& bench) {
    nlohmann::ordered_json json = document({.schema = "strata.bench", .date = bench.date, .device = &bench.device});
    json["repeats"] = bench.repeats;
    json["rows"] = rows_json(sheet_of(bench));
    if (!bench.stopped.empty()) json["stopped"] = bench.stopped;
    for (std::size_t i = 0; i < bench.rows.size(); ++i) add_parts(json["rows"][i], bench.rows[i]);
    return json_text(json);
}

}  // namespace strata
