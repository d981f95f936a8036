// Columns of what a frame makes and reads, for every format.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "replay/json_text.h"
#include "replay/report/needs.h"
#include "replay/tables/document.h"

namespace strata {
namespace {

double mib(std::uint64_t bytes) { return double(bytes) / (1 << 20); }

template <typename Row>
Column<Row> bytes_column(const char* key, const char* title, const char* help, std::uint64_t Row::*bytes) {
    return {{.key = fmt::format("{}_bytes", key),
             .title = fmt::format("{} MiB", title),
             .help = help,
             .kind = CellKind::count,
             .shown = in_files},
            [bytes](const Row& row) { return row.*bytes; }};
}

template <typename Row>
Column<Row> mib_column(const char* title, const char* help, std::uint64_t Row::*bytes) {
    return {{.key = fmt::format("{}_mib", title),
             .title = fmt::format("{} MiB", title),
             .help = help,

             .shown = in_text,
             .digits = ".3f"},
            [bytes](const Row& row) { return mib(row.*bytes); }};
}

/// What products and stages have in common.
template <typename Row>
std::vector<Column<Row>> shared_columns(const char* of_ms) {
    std::vector<Column<Row>> columns;
    columns.push_back(mib_column<Row>("made", "written by a step, clears aside", &Row::made));
    columns.push_back(mib_column<Row>("read", "of what is made, read by another step or as the picture", &Row::read));
    columns.push_back(bytes_column<Row>("made", "made", "bytes written by a step, clears aside", &Row::made));
    columns.push_back(
        bytes_column<Row>("read", "read", "of the bytes made, those read by another step or as the picture", &Row::read));
    columns.push_back({{.key = "unread_share",
                        .title = "unread",
                        .help = "share of what is made that nobody reads",
                        .kind = CellKind::share,
                        .better = Better::less},
                       [](const Row& row) { return cell_or_nothing(unread_share(row.made, row.read)); }});
    columns.push_back({{.key = "ms", .title = "ms", .help = of_ms, .kind = CellKind::spread, .better = Better::less},
                       [](const Row& row) { return cell_or_nothing(row.ms); }});
    return columns;
}

std::vector<Column<NeedsRow>> product_columns() {
    using Of = Column<NeedsRow>::Of;
    std::vector<Column<NeedsRow>> columns{
        {{.key = "product", .title = "product", .help = "image or buffer", .kind = CellKind::text, .shown = in_files},
         [](const NeedsRow& row) { return row.product; },
         Of::every_row},
        {{.key = "stage", .title = "stage", .help = "stage that makes it first", .kind = CellKind::text},
         [](const NeedsRow& row) { return row.stage; },
         Of::every_row},
        {{.key = "technique", .title = "technique", .help = "technique that makes it", .kind = CellKind::text, .shown = in_files},
         [](const NeedsRow& row) { return cell_if_any(row.technique); },
         Of::every_row}};
    std::ranges::move(shared_columns<NeedsRow>("of all steps that write it, which may write others, too"),
                      std::back_inserter(columns));
    columns.push_back(bytes_column<NeedsRow>("room", "room", "bytes of the whole image or buffer", &NeedsRow::room));
    columns.push_back({{.key = "readers", .title = "read by", .help = "stages that read of it", .kind = CellKind::text},
                       [](const NeedsRow& row) { return cell_if_any(row.readers); }});
    columns.push_back({{.key = "left_out",
                        .title = "left out",
                        .help = "instead of numbers: why the frame does without this step or product",
                        .kind = CellKind::text,
                        .shown = in_files},
                       [](const NeedsRow& row) { return cell_if_any(row.left_out); },
                       Of::every_row});
    return columns;
}

std::vector<Column<StageNeeds>> stage_columns() {
    std::vector<Column<StageNeeds>> columns{
        {{.key = "stage", .title = "stage", .help = "stage of the frame", .kind = CellKind::text, .shown = in_files},
         [](const StageNeeds& row) { return row.stage; }}};
    std::ranges::move(shared_columns<StageNeeds>("of all steps of its technique"), std::back_inserter(columns));
    columns.push_back(
        {{.key = "products", .title = "products", .help = "images and buffers that it makes", .kind = CellKind::count},
         [](const StageNeeds& row) { return std::uint64_t{row.products}; }});
    columns.push_back({{.key = "steps_left_out",
                        .title = "left out",
                        .help = "steps and products that the frame does without",
                        .kind = CellKind::count},
                       [](const StageNeeds& row) { return std::uint64_t{row.left_out}; }});
    return columns;
}

std::string head_of(const Needs& needs) {
    return fmt::format("frame {} of {} at {} x {}, {} per pixel{}, on {} ({})\n\n", needs.frame, needs.capture_name, needs.width,
                       needs.height, needs.samples == 1 ? "1 sample" : fmt::format("{} samples", needs.samples),
                       needs.view.empty() ? "" : ", camera moved by " + needs.view, needs.device.name, needs.device.driver);
}

}  // namespace

Sheet sheet_of(const Needs& needs) {
    return sheet_of<NeedsRow>(product_columns(), needs.rows, [](const NeedsRow& row) {
        return RowName{"", row.product, row.left_out.empty() ? "" : fmt::format("left out: {}", row.left_out)};
    });
}

Sheet sheet_of_stages(const Needs& needs) {
    return sheet_of<StageNeeds>(stage_columns(), needs.stages, [](const StageNeeds& row) { return RowName{"", row.stage}; });
}

Page page_of(std::span<const Needs> all) {
    Page page;
    for (const Needs& needs : all) {
        page.insert(page.end(), {(page.empty() ? "" : "\n") + head_of(needs), sheet_of_stages(needs), "\n", sheet_of(needs)});
    }
    page.emplace_back(
        "\nmade: written by a step, clears aside. unread: share of it that no later step reads, nor the picture. ms: of all "
        "steps "
        "that\nwrite it. Sums, where a step reads what it writes, are no reading.\n");
    return page;
}

std::string as_text(std::span<const Needs> all) { return as_text(page_of(all)); }

std::string as_csv(std::span<const Needs> all) {
    std::vector<Sheet> sheets;
    for (const Needs& needs : all) {
        sheets.push_back(sheet_of(needs));
        sheets.back().of_every_row = {{"capture", needs.capture_name}, {"frame", std::to_string(needs.frame)}};
    }
    return as_csv(sheets);
}

std::string as_json(std::span<const Needs> all) {
    using nlohmann::ordered_json;
    ordered_json json = document({.schema = "strata.needs",
                                  .date = all.empty() ? "" : all.front().date,
                                  .device = all.empty() ? nullptr : &all.front().device});
    json["frames"] = ordered_json::array();
    for (const Needs& needs : all) {
        ordered_json frame{{"capture_name", needs.capture_name},
                           {"capture_id", needs.capture_id},
                           {"frame", needs.frame},
                           {"extent", {needs.width, needs.height}},
                           {"samples", needs.samples}};
        if (!needs.view.empty()) frame["eye"] = needs.view;
        frame["stages"] = rows_json(sheet_of_stages(needs));
        frame["products"] = rows_json(sheet_of(needs));
        json["frames"].push_back(std::move(frame));
    }
    return json_text(json);
}

}  // namespace strata
