#include "replay/report/report_columns.h"

#include <algorithm>
#include <array>

#include "passes/stages.h"
#include "replay/report/variants.h"

namespace strata {
namespace {

using Row = Measurement;
using Of = Column<Row>::Of;
using ColumnsOfRows = std::vector<Column<Row>>;

/// What errors mean, whichever stage's judge has them.
struct FigureHelp {
    std::string_view name, help;
    Better better = Better::less;
};
constexpr std::array metric_helps{
    FigureHelp{
        "relative rmse",
        "root mean square of the error over the color channels, divided by that of the truth; in `diff` by that of A, named "
        "first; in expectations by that of the stored image"},
    FigureHelp{display_rmse,
               "root mean square of the error of display values: radiance by the recorded exposure and tone curve, sRGB-encoded"},
    FigureHelp{"over 5/255", "percentage of pixels of which a display value is off by more than 5 of 255 steps"},
    FigureHelp{"rmse", "root mean square of the error"},
    FigureHelp{"worst", "largest error of a sample"},
    FigureHelp{"bias", "mean error, negative: too dark", Better::nearer_zero},
    FigureHelp{"P95", "relative error that 5 % of the samples exceed"},
    FigureHelp{"P99", "relative error that 1 % of the samples exceed"},
    FigureHelp{"over 10 %", "percentage of samples with a relative error above 10 %"},
    FigureHelp{"FLIP", "mean perceived difference, 0 to 1"},
    FigureHelp{"over 2 %", "percentage of samples with a relative error above 2 %"},
    FigureHelp{"off by 1/255",
               "percentage of samples, at the picture of pixels, of which a display value is off by more than 1 of 255 steps"},
    FigureHelp{"display worst", "largest error of a display value"},
    FigureHelp{"radiance relative rmse", "root mean square of the error of radiance, divided by that of the truth"},
    FigureHelp{"relative bias", "mean error divided by the truth's mean, negative: too dark", Better::nearer_zero},
    FigureHelp{"exposure error", "distance of the adapted exposure from the true one"},
    FigureHelp{"brightness error", "mean error of the picture, which grain must not change"},
    FigureHelp{"wrongly hidden", "draws that are seen and not drawn: holes"},
    FigureHelp{"needlessly drawn", "draws that are drawn and not seen"},
    FigureHelp{"drawn", "draws that the technique draws"},
    FigureHelp{"visible", "draws of which a sample is seen, whatever the technique", Better::neither},
    FigureHelp{"wrongly lit",
               "percentage of samples that are in shadow in the truth and lit in the result, by more than half each"},
    FigureHelp{"wrongly shadowed",
               "percentage of samples that are lit in the truth and in shadow in the result, by more than half each"},
    FigureHelp{"normal angle rms", "root mean square of the angle between stored and true normal"},
    FigureHelp{"normal angle worst", "largest angle between stored and true normal"},
    FigureHelp{"normal angle mean", "mean angle between stored and true normal"},
    FigureHelp{"position along", "root mean square of the error of position along the eye's ray"},
    FigureHelp{"position across", "root mean square of the error of position across the eye's ray"},
    FigureHelp{"base color rmse", "root mean square of the error of base color, over its channels of 0 to 1"},
    FigureHelp{"roughness rmse", "root mean square of the error of roughness, 0 to 1"},
    FigureHelp{"metallic rmse", "root mean square of the error of metallic, 0 to 1"},
    FigureHelp{"occlusion rmse", "root mean square of the error of the material's occlusion, 0 to 1"},
    FigureHelp{"other lighting model", "percentage of surfaces that are lit by another model than theirs"},
    FigureHelp{"coverage differs", "samples that show a surface in one of result and truth alone"},
    FigureHelp{
        "masked coverage off",
        "mean difference of the share of a pixel that masked surfaces cover, over pixels of which they cover any; true is the "
        "area where alpha of the finest mip reaches the cutoff"},
    FigureHelp{"masked area off", "difference of the whole area that masked surfaces cover, relative to the true one"},
    FigureHelp{"masked alpha off", "like masked coverage off, where true is mean alpha"},
    FigureHelp{"masked alpha area off", "like masked area off, where true is mean alpha"},
    FigureHelp{"masked coverage truth error", "standard error of the truth of masked coverage off, root mean square over pixels"},
    FigureHelp{"masked area truth error", "standard error of the truth of masked area off"},
    FigureHelp{"missed", "pixels on an edge that are shaded once"},
    FigureHelp{"needless", "pixels off any edge that are shaded once per sample"},
    FigureHelp{"shaded per sample", "pixels that are shaded once per sample"},
    FigureHelp{"wrongly wet or dry", "samples nearer to the opposite of what the truth has, where rain makes a difference"},
    FigureHelp{"ambient relative rmse",
               "root mean square of the error of the hemisphere's light behind occlusion, divided by that of the truth"},
    FigureHelp{"leak", "mean light where the truth is black, relative to the truth's mean elsewhere"},
    FigureHelp{"dark", "percentage of samples where the truth is black, which leak is over", Better::neither}};

/// "rmse radiance", "display rmse, % of white".
std::string with_unit(const Metric& metric) {
    if (is_of_white(metric)) return title_of({metric.name, true});
    return metric.unit.empty() ? metric.name : fmt::format("{} {}", metric.name, metric.unit);
}

std::vector<Metric> stage_errors_of(const Row& row) { return row.accuracy.stage_errors; }

/// `errors` of a row have the value; `of` names the stage where they are its own beside those of the picture.
Column<Row> metric_column(const Metric& metric, std::vector<Metric> (*errors)(const Row&), std::string_view of = {}) {
    const auto named = [&](const std::string& text) { return of.empty() ? text : fmt::format("{} {}", of, text); };
    const auto* known = std::ranges::find(metric_helps, metric.name, &FigureHelp::name);
    const bool is_known = known != metric_helps.end();
    const unsigned in_tables = in_csv | in_window | (metric.is_detail ? 0u : unsigned{in_text});
    return {{.key = named(metric.name),
             .title = named(with_unit(metric)),
             .help = is_known ? std::string(known->help) : "",
             .kind = kind_of({metric.name, is_of_white(metric)}),
             .better = is_known ? known->better : Better::less,
             .shown = in_tables,  // JSON has them in technique_error, with their units
             .unit = metric.unit,
             .short_title = named(is_of_white(metric) ? metric.name + " %" : metric.name),
             .label = named(metric.unit.empty() ? metric.name : fmt::format("{} ({})", metric.name, metric.unit)),
             .role = Role::error,
             .is_detail = metric.is_detail},
            [name = metric.name, errors](const Row& row) -> CellValue {
                for (const Metric& own : errors(row))
                    if (own.name == name) return own.value;
                return {};
            }};
}

ColumnsOfRows names() {
    return {{{.key = "technique", .title = "technique", .help = "stage and technique", .kind = CellKind::text, .shown = in_files},
             [](const Row& row) { return row.technique; },
             Of::every_row},
            {{.key = "settings",
              .title = "settings",
              .help = "what differs from the technique's defaults",
              .kind = CellKind::text,
              .shown = in_files},
             [](const Row& row) { return row.settings; },
             Of::every_row}};
}

ColumnsOfRows errors(const Report& report) {
    ColumnsOfRows columns;
    const Row* first = first_measured(report);
    if (first)
        for (const Metric& metric : errors_of(*first)) columns.push_back(metric_column(metric, errors_of));
    const bool is_shown = leaves_much(report) || (first && ranking_metric(*first).is_detail);
    columns.push_back({{.key = "ranking_error",
                        .title = title_of(ranking_error(report)),
                        .help = "error over the samples that the stage changes, where these are not all; rows are ranked by it",
                        .kind = kind_of(ranking_error(report)),
                        .better = Better::less,
                        .shown = in_files | (is_shown ? in_text | in_window : 0u),
                        .role = Role::error},
                       [](const Row& row) { return ranking_metric(row).value; }});
    if (first)
        for (const Metric& metric : first->accuracy.stage_errors)
            columns.push_back(metric_column(metric, stage_errors_of, name(report.stage)));
    columns.push_back(
        {{.key = "touched_share",
          .title = "touched",
          .help = "share of the samples that the stage changes",
          .kind = CellKind::share,
          .shown = in_files},
         [](const Row& row) { return row.accuracy.touched.empty() ? CellValue() : CellValue(row.accuracy.touched_share); }});
    columns.push_back(
        {{.key = "concentration",
          .title = "concentration",
          .help = "share of the squared display error that lies in the worst thousandth of the pixels that the "
                  "stage changes",
          .kind = CellKind::share,
          .shown = in_files},
         [](const Row& row) { return row.accuracy.footing ? CellValue(row.accuracy.footing->concentration) : CellValue(); }});
    columns.push_back({{.key = "undecided_share",
                        .title = "undecided",
                        .help = "share of samples whose truth depends on rounding; their error is the distance to the nearest "
                                "result that rounding allows",
                        .kind = CellKind::share,
                        .shown = in_files},
                       [](const Row& row) { return row.accuracy.undecided_share; }});
    columns.push_back({{.key = "undecided_bound",
                        .title = "may hide",
                        .help = "largest error that undecided samples can hide, in the unit of the stage's error",
                        .kind = CellKind::number,
                        .shown = in_files},
                       [](const Row& row) {
                           const auto& bound = row.accuracy.undecided_bound;
                           return bound ? CellValue(bound->value) : CellValue();
                       }});
    columns.push_back({{.key = "unjudged_share",
                        .title = "left out",
                        .help = "share of samples left out of the errors, because the results that rounding allows are not known",
                        .kind = CellKind::share,
                        .shown = in_files},
                       [](const Row& row) { return row.accuracy.unjudged_share; }});
    return columns;
}

/// Device against model, a part of its own in JSON. An error where nothing could be compared is not known.
ColumnsOfRows implementation() {
    const auto column = [](std::string key, std::string json, std::string help, CellKind kind, auto value) {
        return Column<Row>{{.key = "implementation_" + std::move(key),
                            .title = "implementation",
                            .help = std::move(help),
                            .kind = kind,
                            .shown = in_files,
                            .json = "/implementation_error/" + std::move(json)},
                           value};
    };
    const auto if_compared = [](const Row& row, double value) {
        return is_nothing_compared(row) ? CellValue(Unknown{}) : CellValue(value);
    };
    return {column("model", "model_is", "whether the model is the paper's or a mirror of the shader", CellKind::text,
                   [](const Row& row) { return std::string(name(row.model_is)); }),
            column("rmse", "rmse", "relative difference between device and model", CellKind::number,
                   [=](const Row& row) { return if_compared(row, row.accuracy.model_rmse); }),
            column("worst", "worst", "largest relative difference between device and model", CellKind::number,
                   [=](const Row& row) { return if_compared(row, row.accuracy.model_worst); }),
            column("compared", "compared", "texels compared with the model", CellKind::count,
                   [](const Row& row) { return std::uint64_t{row.accuracy.compared}; }),
            column("undecided", "undecided", "texels left out because rounding decides them", CellKind::count,
                   [](const Row& row) { return std::uint64_t{row.accuracy.undecided}; }),
            column("tolerance", "tolerance/rmse", "largest rmse that the technique allows", CellKind::number,
                   [](const Row& row) { return row.tolerance; }),
            column("tolerated_worst", "tolerance/worst", "largest difference that the technique allows", CellKind::number,
                   [](const Row& row) { return row.tolerated_worst; }),
            column("doubt", "doubt", "what is wrong with the implementation", CellKind::text,
                   [](const Row& row) { return cell_if_any(implementation_doubt(row)); }),
            {{.key = "incomparable",
              .title = "incomparable",
              .help = "why device and model or truth cannot be compared",
              .kind = CellKind::text,
              .shown = in_files},
             [](const Row& row) { return cell_if_any(row.accuracy.incomparable); }},
            {{.key = "light_faults",
              .title = "light faults",
              .help = "images whose light is not finite, or that half floats cut off",
              .kind = CellKind::text,
              .shown = in_files},
             [](const Row& row) { return cell_if_any(light_faults(row)); }}};
}

ColumnsOfRows times(const Report& report) {
    const std::string unit = below_stage(report.time_unit);
    return {
        {{.key = "time",
          .title = fmt::format("time, x {}", unit),
          .help = "time of the stage as a multiple of its baseline's: the median of ratios within each repeat, with their median "
                  "absolute deviation where there are several",
          .kind = CellKind::ratio,
          .better = Better::less,
          .short_title = fmt::format("\xc3\x97 {}", unit),
          .label = fmt::format("times as long as {}", unit),
          .if_any = true,
          .role = Role::cost},
         [](const Row& row) { return cell_or_nothing(row.time); }},
        {{.key = "stage_ms",
          .title = "ms",
          .help = "median time of the stage in milliseconds; runs at different moments, so their quotients are not the multiples",
          .kind = CellKind::median,
          .better = Better::less,
          .label = "ms of the stage",
          .if_any = true,
          .role = Role::cost},
         [](const Row& row) { return row.stage_ms; }},
        {{.key = "unchanged_ms",
          .title = "unchanged ms",
          .help =
              "median time of the stage in milliseconds where nothing changed since the frame before, of techniques that keep "
              "work; all other times are of a frame that nothing came before",
          .kind = CellKind::median,
          .better = Better::less,
          .label = "ms of the stage in an unchanged frame",
          .if_any = true,
          .role = Role::cost},
         [](const Row& row) { return cell_or_nothing(row.unchanged_ms); }},
        {{.key = "frame_ms",
          .title = "frame ms",
          .help = "median time of the frame in milliseconds",
          .kind = CellKind::median,
          .better = Better::less,
          .shown = in_files | in_window,
          .label = "ms of the frame",
          .role = Role::cost,
          .is_detail = true},
         [](const Row& row) { return row.frame_ms; }},
        {{.key = "ns_per_pixel",
          .title = "ns per pixel",
          .help = "nanoseconds of the stage by pixels of the frame: compares frames of different extents",
          .better = Better::less,
          .shown = in_files | in_window,
          .role = Role::cost,
          .is_detail = true},
         [pixels = double(report.width) * report.height](const Row& row) {
             return pixels > 0 ? CellValue(row.stage_ms.median * 1e6 / pixels) : CellValue();
         }},
        {{.key = "sort_ms",
          .title = "sort ms",
          .help = "milliseconds of the stage's time in which the CPU sorts",
          .kind = CellKind::median,
          .better = Better::less,
          .shown = in_files},
         [](const Row& row) { return cell_or_nothing(row.sort_ms); }}};
}

ColumnsOfRows costs(const Report& report) {
    return {{{.key = "modeled_kilocycles",
              .title = fmt::format("kcycles {}", report.question.gpu),
              .help = "thousands of cycles that shaders take on the GPU that `--cost` names, modeled: invocations times the "
                      "throughput that its compiler states; no memory, no caches, no blending",
              .better = Better::less,
              .shown = in_files | in_text,
              .if_any = true,
              .role = Role::cost},
             [](const Row& row) { return row.modeled ? cell_or_unknown(row.modeled->kilocycles) : CellValue(); }},
            {{.key = "stage_bytes",
              .title = "bytes",
              .help = "memory of the images and buffers that the technique allocates",
              .kind = CellKind::count,
              .better = Better::less,
              .shown = in_files},
             [](const Row& row) { return row.stage_bytes; }},
            {{.key = "bytes_per_pixel",
              .title = "bytes per pixel",
              .help = "memory of the images and buffers that the technique allocates, the frame's own left out",
              .better = Better::less,
              .digits = ".0f",
              .short_title = "bytes/px",
              .if_any = true,
              .role = Role::cost},
             [](const Row& row) { return row.bytes_per_pixel; }},
            {{.key = "invocations",
              .title = "invocations",
              .help = "how often the stage's fragment and compute shaders ran, where the device counts them",
              .kind = CellKind::count,
              .better = Better::less,
              .shown = in_files | in_window,
              .label = "shader invocations",
              .role = Role::cost,
              .is_detail = true},
             [](const Row& row) { return cell_or_nothing(row.invocations); }},
            {{.key = "flicker",
              .title = "flicker",
              .help = "mean change of the error from frame to frame while the camera moves (`--flicker`)",
              .better = Better::less,
              .if_any = true,
              .role = Role::error},
             [](const Row& row) { return cell_or_nothing(row.flicker); }},
            {{.key = "coverage_flicker",
              .title = "coverage flicker",
              .help = "the same of the share that masked surfaces cover of each pixel, over pixels that have any",
              .better = Better::less,
              .if_any = true,
              .role = Role::error},
             [](const Row& row) { return cell_or_nothing(row.coverage_flicker); }}};
}

std::string counters_field(const Row& row) {
    std::string text;
    for (const CounterRecord& counter : row.counters)
        text += fmt::format("{}{}={}", text.empty() ? "" : " ", counter.name, counter.value);
    return text;
}

ColumnsOfRows places() {
    const auto flag = [](std::string key, std::string help, bool Row::*member) {
        return Column<Row>{
            {.key = std::move(key), .title = "", .help = std::move(help), .kind = CellKind::flag, .shown = in_files},
            [member](const Row& row) { return row.*member; }};
    };
    return {flag("on_pareto_front", "no row is both more accurate and faster", &Row::on_front),
            flag("is_tied", "faster than a more accurate row, but by less than the spread of their times", &Row::is_tied),
            flag("on_memory_front", "no row is both more accurate and smaller", &Row::on_memory_front),
            {{.key = "counters",
              .title = "counters",
              .help = "what the technique counted, as name=value; an object in JSON",
              .kind = CellKind::text,
              .shown = in_csv},
             [](const Row& row) { return cell_if_any(counters_field(row)); }}};
}

ColumnsOfRows remarks() {
    return {{{.key = "has_other_truth",
              .title = "",
              .help = "measured against another truth than the first row, so not ranked",
              .kind = CellKind::flag,
              .shown = in_files},
             [](const Row& row) { return row.has_other_truth ? CellValue(true) : CellValue(); },
             Of::every_row},
            {{.key = "not_supported",
              .title = "not supported",
              .help = "why the technique cannot do the frame; then there are no numbers",
              .kind = CellKind::text,
              .shown = in_files},
             [](const Row& row) { return cell_if_any(row.accuracy.not_supported); },
             Of::every_row},
            {{.key = "truth",
              .title = "truth",
              .help = "what the row is measured against; empty: the stage's truth",
              .kind = CellKind::text,
              .shown = in_files},
             [](const Row& row) { return cell_if_any(row.truth); },
             Of::every_row}};
}

void add(ColumnsOfRows& all, ColumnsOfRows more) { std::ranges::move(more, std::back_inserter(all)); }

RowName name_of_row(const Row& row) {
    const char of_time = row.on_front ? '*' : row.has_other_truth ? 't' : row.is_tied ? '=' : ' ';
    return {{of_time, row.on_memory_front ? '+' : ' '},
            short_label(row),
            row.accuracy.not_supported.empty() ? "" : "not supported: " + row.accuracy.not_supported};
}

}  // namespace

const Measurement* first_measured(const Report& report) {
    const auto row = std::ranges::find_if(report.rows, [](const Measurement& each) { return each.is_measured(); });
    return row == report.rows.end() ? nullptr : &*row;
}

CellKind kind_of(const RankingError& error) { return error.is_of_white ? CellKind::share : CellKind::number; }

std::string title_of(const RankingError& error) { return error.name + (error.is_of_white ? ", % of white" : ""); }

RankingError ranking_error(const Report& report) {
    const Measurement* row = first_measured(report);
    return row ? ranking_error(*row) : RankingError{"error"};
}

bool leaves_much(const Report& report) {
    const Measurement* row = first_measured(report);
    return row && !row->accuracy.touched.empty() && row->accuracy.touched_share < 1;
}

Sheet sheet_of(const Report& report) {
    ColumnsOfRows columns = names(), timed = times(report);
    add(columns, errors(report));
    add(columns, implementation());
    add(timed, costs(report));
    add(timed, places());
    if (!report.is_timed)  // their zeros are not measured
        for (Column<Row>& column : timed) column.value = [](const Row&) { return CellValue(); };
    add(columns, std::move(timed));
    add(columns, remarks());
    Sheet sheet = sheet_of<Row>(columns, report.rows, name_of_row);
    sheet.heads_labels = fmt::format("{} and settings", name(report.stage));
    sheet.of_every_row = {{"capture", report.capture_name}};
    return sheet;
}

}  // namespace strata
