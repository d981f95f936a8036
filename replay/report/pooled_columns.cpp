// What a pool says of each of its rows. Keys are those of report_columns.cpp where the values are means of these.
#include <algorithm>
#include <cmath>

#include "passes/stages.h"
#include "replay/report/report_columns.h"
#include "replay/report/variants.h"

namespace strata {
namespace {

using ColumnsOfPool = std::vector<Column<PooledRow>>;

ColumnsOfPool names_of_pool() {
    const auto text = [](std::string key, std::string help, std::string PooledRow::*member) {
        return Column<PooledRow>{{.key = key, .title = key, .help = std::move(help), .kind = CellKind::text, .shown = in_files},
                                 [member](const PooledRow& row) { return row.*member; }};
    };
    return {text("technique", "stage and technique", &PooledRow::technique),
            text("settings", "what differs from the technique's defaults", &PooledRow::settings)};
}

ColumnsOfPool means(const Pool& pool) {
    const bool flickers =
        !pool.rows.empty() && std::ranges::all_of(pool.rows, [](const PooledRow& row) { return row.flicker.has_value(); });
    return {
        {{.key = "ranking_error",
          .title = title_of(pool.error),
          .help = "error that ranks rows: of each capture that of its worst frame; over captures the mean, which is geometric "
                  "but of display rmse",
          .kind = kind_of(pool.error),
          .better = Better::less,
          .json = "/error"},
         [](const PooledRow& row) { return row.error; }},
        {{.key = "worst_error",
          .title = "worst",
          .help = "largest error of a frame",
          .kind = kind_of(pool.error),
          .better = Better::less},
         [](const PooledRow& row) { return row.worst_error; }},
        {{.key = "worst_frame", .title = "on", .help = "capture and frame with the largest error", .kind = CellKind::text},
         [](const PooledRow& row) { return row.worst_frame; }},
        {{.key = "rms_error",
          .title = "rms",
          .help = "root mean square of display rmse over all pixels of the frames that the stage changes",
          .kind = kind_of(pool.error),
          .better = Better::less,
          .if_any = true},
         [](const PooledRow& row) { return cell_or_nothing(row.rms_error); }},
        {{.key = "time",
          .title = fmt::format("time, x {}", below_stage(pool.time_unit)),
          .help = "geometric mean of the multiples of the baseline's time",
          .kind = CellKind::ratio,
          .better = Better::less,
          .shown = in_files | (pool.time_unit.empty() ? 0u : unsigned{in_text})},
         [](const PooledRow& row) { return cell_or_nothing(row.time); }},
        {{.key = "worst_ms",
          .title = "worst ms",
          .help = "milliseconds of the slowest frame, which `--within 2ms` limits",
          .better = Better::less,
          .shown = in_files | (pool.question.within_ms ? unsigned{in_text} : 0u)},
         [](const PooledRow& row) { return std::isfinite(row.asked.ms) ? CellValue(row.asked.ms) : CellValue(); }},
        {{.key = "worst_bytes",
          .title = "most bytes",
          .help = "memory of the frame that takes most, which `--memory` limits",
          .better = Better::less,
          .shown = in_files | (pool.question.memory ? unsigned{in_text} : 0u),
          .digits = ".0f"},
         [](const PooledRow& row) { return row.asked.bytes; }},
        {{.key = "bytes_per_pixel", .title = "bytes per pixel", .help = "mean", .better = Better::less, .digits = ".0f"},
         [](const PooledRow& row) { return row.bytes_per_pixel; }},
        {{.key = "flicker",
          .title = "flicker",
          .help = "geometric mean",
          .better = Better::less,
          .shown = in_files | (flickers ? unsigned{in_text} : 0u)},
         [](const PooledRow& row) { return cell_or_nothing(row.flicker); }}};
}

ColumnsOfPool counts_of_pool(const Pool& pool) {
    const auto flag = [](std::string key, std::string help, bool PooledRow::*member) {
        return Column<PooledRow>{
            {.key = std::move(key), .title = "", .help = std::move(help), .kind = CellKind::flag, .shown = in_files},
            [member](const PooledRow& row) { return row.*member; }};
    };
    const std::size_t frames = pool.frames;
    const char* counted = pool.frames > pool.captures ? "frames" : "captures";
    const auto how_many = [frames](const PooledRow& row) { return fmt::format("{} of {}", row.frames, frames); };
    return {{{.key = "frames",
              .title = counted,
              .help = "frames that the technique can do",
              .kind = CellKind::count,
              .shown = in_json},
             [](const PooledRow& row) { return std::uint64_t{row.frames}; }},
            {{.key = "frames_of_all",
              .title = counted,
              .help = "frames that the technique can do",
              .kind = CellKind::text,
              .shown = in_text},
             [=](const PooledRow& row) { return row.frames == frames ? std::string("all") : how_many(row); }},
            flag("on_pareto_front", "no row is both more accurate and faster", &PooledRow::on_front),
            flag("on_memory_front", "no row is both more accurate and smaller", &PooledRow::on_memory_front),
            {{.key = "has_other_truth", .title = "", .help = "not ranked", .kind = CellKind::flag, .shown = in_json},
             [](const PooledRow& row) { return row.has_other_truth ? CellValue(true) : CellValue(); }},
            {{.key = "not_supported",
              .title = "",
              .help = "frames that it can do, where these are not all",
              .kind = CellKind::text,
              .shown = in_csv},
             [=](const PooledRow& row) { return row.frames == frames ? CellValue() : CellValue(how_many(row)); }}};
}

}  // namespace

Sheet sheet_of(const Pool& pool) {
    ColumnsOfPool columns = names_of_pool();
    std::ranges::move(means(pool), std::back_inserter(columns));
    std::ranges::move(counts_of_pool(pool), std::back_inserter(columns));
    Sheet sheet = sheet_of<PooledRow>(columns, pool.rows, [](const PooledRow& row) {
        const char of_time = row.on_front ? '*' : row.has_other_truth ? 't' : ' ';
        return RowName{{of_time, row.on_memory_front ? '+' : ' '}, short_label(row)};
    });
    sheet.heads_labels = fmt::format("{} and settings", name(pool.stage));
    sheet.of_every_row = {{"capture", "pooled"}};
    return sheet;
}

}  // namespace strata
