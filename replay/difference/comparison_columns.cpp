// What a comparison says of each image, for every format; text has the verdict first.
#include <algorithm>
#include <cctype>

#include <nlohmann/json.hpp>

#include "replay/difference/comparison.h"
#include "replay/json_text.h"
#include "replay/plural.h"
#include "replay/tables/document.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

/// An image of a pass.
struct ComparedImage {
    const FrameComparison& frame;
    const PassComparison& pass;
    const ImageComparison& image;
};
using ComparedColumns = std::vector<Column<ComparedImage>>;
using Images = std::vector<ComparedImage>;

std::string shouted(Verdict verdict) {
    std::string text(name(verdict));
    if (verdict == Verdict::over || verdict == Verdict::warning)
        std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

std::string counted(std::string_view what, std::uint64_t a, std::uint64_t b) {
    return a + b > 0 ? fmt::format("  {}: {} | {}", what, a, b) : "";
}

/// "(3, 4) layer 1: 0.25 | 0.5  NaN: 1 | 0".
std::string worst_pixel_text(const ImageError& error) {
    const WorstPixel& worst = error.worst_pixel;
    return fmt::format("({}, {}){}: {:.6g} | {:.6g}{}{}", worst.x, worst.y,
                       worst.layer ? fmt::format(" layer {}", worst.layer) : "", worst.a, worst.b,
                       counted("NaN", error.in_a.nan, error.in_b.nan), counted("Inf", error.in_a.inf, error.in_b.inf));
}

// Columns of names_of_image() by their places: what a line of text has beside its figures.
constexpr std::size_t verdict_in_text = 4, first_metric = 6;

ComparedColumns names_of_image() {
    using Of = Column<ComparedImage>::Of;
    const auto text = [](std::string key, std::string title, std::string help, unsigned shown, auto value) {
        return Column<ComparedImage>{
            {.key = std::move(key), .title = std::move(title), .help = std::move(help), .kind = CellKind::text, .shown = shown},
            value,
            Of::every_row};
    };
    ComparedColumns columns{
        {{.key = "frame", .title = "frame", .help = "index of the frame", .kind = CellKind::count, .shown = in_csv},
         [](const ComparedImage& row) { return std::uint64_t{row.frame.frame}; }},
        text("pass", "pass", "the pass", in_csv, [](const ComparedImage& row) { return row.pass.label; }),
        text("image", "image", "its image", in_files, [](const ComparedImage& row) { return row.image.image; }),
        text("verdict", "verdict", "whether the difference is allowed", in_files,
             [](const ComparedImage& row) { return std::string(name(row.image.verdict)); }),
        text("shouted", "verdict", "the same, in capitals where it is not", in_text,
             [](const ComparedImage& row) { return shouted(row.image.verdict); }),
        text("of", "pass: image", "both", in_text,
             [](const ComparedImage& row) { return row.pass.label + ": " + row.image.image; }),
        {{.key = "identical", .title = "", .help = "bit for bit", .kind = CellKind::flag, .shown = in_files},
         [](const ComparedImage& row) { return row.image.error.identical; }},
        text("reason", "reason", "why they are not the same", in_files,
             [](const ComparedImage& row) { return cell_if_any(row.image.reason); })};
    columns[verdict_in_text].is.width = 12;
    return columns;
}

/// Of the errors, a part of its own in JSON; nothing where no pixel was compared.
template <typename Getter>
Column<ComparedImage> error_column(Described is, Getter value) {
    return {std::move(is), [value](const ComparedImage& row) -> CellValue {
                if (row.image.error.pixels == 0) return {};
                return value(row.image.error);
            }};
}

ComparedColumns errors_of_image() {
    using Error = const ImageError&;
    return {error_column({.key = "rmse",
                          .title = "rmse",
                          .help = "root mean square of the difference",
                          .better = Better::less,
                          .digits = ".3e",
                          .json = "/error/rmse",
                          .width = 10},
                         [](Error error) { return error.rmse; }),
            error_column({.key = "relative_rmse",
                          .title = "relative",
                          .help = "the same, divided by the root mean square of A",
                          .better = Better::less,
                          .digits = ".3e",
                          .json = "/error/relative_rmse",
                          .width = 10},
                         [](Error error) { return error.relative_rmse; }),
            error_column({.key = "worst",
                          .title = "worst",
                          .help = "largest difference of a pixel in any channel; of depth in ULPs",
                          .better = Better::less,
                          .shown = in_files,
                          .json = "/error/worst"},
                         [](Error error) { return error.worst; }),
            error_column({.key = "worst_unit",
                          .title = "unit",
                          .help = "its unit, ulps or value",
                          .kind = CellKind::text,
                          .shown = in_files,
                          .json = "/error/worst_unit"},
                         [](Error error) { return std::string(error.kind == ImageError::Kind::depth ? "ulps" : "value"); }),
            // Words, but aligned as the number that they begin with.
            error_column({.key = "worst_with_unit", .title = "worst", .help = "both", .shown = in_text, .width = 10},
                         [](Error error) {
                             return fmt::format("{:.3g}{}", error.worst, error.kind == ImageError::Kind::depth ? " ULPs" : "");
                         }),
            error_column({.key = "over_share",
                          .title = "over %",
                          .help = "share of the pixels above the limit",
                          .kind = CellKind::share,
                          .better = Better::less,
                          .digits = ".3f",
                          .json = "/error/share_over_limit",
                          .width = 7},
                         [](Error error) { return double(error.over_limit) / double(error.pixels); }),
            {{.key = "flip",
              .title = "FLIP",
              .help = "mean perceived difference, 0 to 1, of images of light",
              .better = Better::less,
              .shown = in_text | in_csv,
              .digits = ".4f",
              .width = 7},
             [](const ComparedImage& row) { return row.image.flip ? CellValue(row.image.flip->mean) : CellValue(Unknown{}); }},
            error_column({.key = "worst_pixel",
                          .title = "worst pixel: A | B",
                          .help = "where the difference is largest, and both values",
                          .kind = CellKind::text,
                          .shown = in_text},
                         worst_pixel_text)};
}

ComparedColumns pixels_of_image() {
    const auto count = [](std::string key, std::string json, std::string help, auto value) {
        return error_column({.key = std::move(key),
                             .title = "",
                             .help = std::move(help),
                             .kind = CellKind::count,
                             .shown = in_files,
                             .json = "/error/" + std::move(json)},
                            [value](const ImageError& error) { return std::uint64_t{value(error)}; });
    };
    const auto number = [](std::string key, std::string json, std::string help, double WorstPixel::*member) {
        return error_column(
            {.key = std::move(key), .title = "", .help = std::move(help), .shown = in_files, .json = "/error/" + std::move(json)},
            [member](const ImageError& error) { return error.worst_pixel.*member; });
    };
    const auto region = [](std::string key, std::string json, std::string help, std::uint32_t PixelBox::*member) {
        return Column<ComparedImage>{{.key = std::move(key),
                                      .title = "",
                                      .help = std::move(help),
                                      .kind = CellKind::count,
                                      .shown = in_files,
                                      .json = "/error/worst_region/" + std::move(json)},
                                     [member](const ComparedImage& row) {
                                         const auto& worst = row.image.error.region;
                                         return worst ? CellValue(std::uint64_t{worst->box.*member}) : CellValue();
                                     }};
    };
    using Error = const ImageError&;
    return {
        count("worst_x", "worst_pixel/x", "column of the worst pixel", [](Error error) { return error.worst_pixel.x; }),
        count("worst_y", "worst_pixel/y", "its row", [](Error error) { return error.worst_pixel.y; }),
        count("worst_layer", "worst_pixel/layer", "its layer", [](Error error) { return error.worst_pixel.layer; }),
        count("worst_channel", "worst_pixel/channel", "its channel", [](Error error) { return error.worst_pixel.channel; }),
        number("worst_a", "worst_pixel/a", "its value in A", &WorstPixel::a),
        number("worst_b", "worst_pixel/b", "its value in B", &WorstPixel::b),
        count("pixels", "pixels", "pixels", [](Error error) { return error.pixels; }),
        count("pixels_ignored", "pixels_ignored", "pixels that --ignore leaves out", [](Error error) { return error.ignored; }),
        region("region_x", "x", "column where the pixels above the limit that stand closest together begin", &PixelBox::x),
        region("region_y", "y", "its row", &PixelBox::y),
        region("region_width", "width", "its width", &PixelBox::width),
        region("region_height", "height", "its height", &PixelBox::height),
        {{.key = "region_density",
          .title = "",
          .help = "share of its pixels above the limit",
          .kind = CellKind::share,
          .shown = in_files,
          .json = "/error/worst_region/density"},
         [](const ComparedImage& row) {
             return row.image.error.region ? CellValue(row.image.error.region->density) : CellValue();
         }},
        count("pixels_over_limit", "pixels_over_limit", "pixels above --limit", [](Error error) { return error.over_limit; }),
        count("pixels_over_warn_limit", "pixels_over_warn_limit", "pixels above --warn-limit",
              [](Error error) { return error.over_warn_limit; }),
        count("nan_a", "nan/a", "NaN in A", [](Error error) { return error.in_a.nan; }),
        count("nan_b", "nan/b", "NaN in B", [](Error error) { return error.in_b.nan; }),
        count("inf_a", "inf/a", "infinities in A", [](Error error) { return error.in_a.inf; }),
        count("inf_b", "inf/b", "infinities in B", [](Error error) { return error.in_b.inf; }),
        count("not_finite_in_one_alone", "not_finite_in_one_alone", "values that are NaN or infinite in one alone",
              [](Error error) { return error.disagreeing; })};
}

Sheet sheet_of_images(std::span<const ComparedImage> images) {
    ComparedColumns columns = names_of_image();
    for (ComparedColumns more : {errors_of_image(), pixels_of_image()}) std::ranges::move(more, std::back_inserter(columns));
    return sheet_of<ComparedImage>(columns, images, [](const ComparedImage&) { return RowName(); });
}

Images images_of(const FrameComparison& frame, const PassComparison& pass) {
    Images images;
    for (const ImageComparison& image : pass.images) images.push_back({frame, pass, image});
    return images;
}

/// Only what differs has figures. A line of its own says where A and B chose differently.
Sheet lines_of(const FrameComparison& frame) {
    Sheet lines;
    for (const PassComparison& pass : frame.passes) {
        Sheet of_pass = sheet_of_images(images_of(frame, pass));
        lines.columns = of_pass.columns;
        if (pass.choice_a != pass.choice_b) {
            Sheet::Row& row = lines.rows.emplace_back(Sheet::Row{RowName(), std::vector<CellValue>(lines.columns.size())});
            row.values[verdict_in_text] = "";
            row.name.instead = fmt::format("{}: A {}, B {}", pass.label, pass.choice_a.empty() ? "leaves it out" : pass.choice_a,
                                           pass.choice_b.empty() ? "leaves it out" : pass.choice_b);
        }
        for (std::size_t i = 0; i < pass.images.size(); ++i) {
            const ImageComparison& image = pass.images[i];
            Sheet::Row& row = lines.rows.emplace_back(std::move(of_pass.rows[i]));
            if (image.error.pixels > 0 && !image.error.identical) continue;
            row.name.instead = image.reason;
            for (std::size_t column = first_metric; column < row.values.size(); ++column) row.values[column] = CellValue();
        }
    }
    return lines;
}

std::string side_text(std::string_view letter, const Side& side) {
    std::string text = fmt::format("{}  {}", letter, side.name);
    if (!side.capture.empty()) text += fmt::format("  capture {}", side.capture);
    if (!side.device.empty()) text += fmt::format("  on {} ({})", side.device, side.driver);
    return text + "\n";
}

ordered_json json_of(const Flip& flip, const FlipOptions& options) {
    ordered_json json{
        {"mean", flip.mean},
        {"weighted", {{"first_quartile", flip.first_quartile}, {"median", flip.median}, {"third_quartile", flip.third_quartile}}},
        {"low", flip.low},
        {"high", flip.high},
        {"pixels_per_degree", options.pixels_per_degree}};
    if (flip.exposures.count > 0)
        json["exposures"] = {{"start", flip.exposures.start},
                             {"stop", flip.exposures.stop},
                             {"count", flip.exposures.count},
                             {"tone_mapper", name(options.tone_mapper)}};
    return json;
}

ordered_json json_of(const FrameComparison& frame, const FlipOptions& flip) {
    ordered_json json{{"frame", frame.frame}, {"verdict", name(frame.verdict)}, {"passes", ordered_json::array()}};
    for (const PassComparison& pass : frame.passes) {
        ordered_json row{{"pass", pass.label}};
        if (!pass.choice_a.empty() || !pass.choice_b.empty()) row["choice"] = {{"a", pass.choice_a}, {"b", pass.choice_b}};
        if (!pass.images.empty()) row["images"] = rows_json(sheet_of_images(images_of(frame, pass)));
        for (std::size_t i = 0; i < pass.images.size(); ++i) {
            const ImageComparison& image = pass.images[i];
            for (const Judged& judged : image.judged)
                row["images"][i]["comparisons"].push_back(
                    {{"metric", judged.metric}, {"value", cell_json(judged.value)}, {"threshold", cell_json(judged.threshold)}});
            if (image.flip) row["images"][i]["flip"] = json_of(*image.flip, flip);
        }
        json["passes"].push_back(row);
    }
    if (!frame.divergence.pass.empty())
        json["first_difference"] = {
            {"pass", frame.divergence.pass}, {"image", frame.divergence.image}, {"step", frame.divergence.step}};
    if (!frame.notes.empty()) json["notes"] = frame.notes;
    return json;
}

ordered_json json_of(const Side& side) {
    ordered_json json{{"name", side.name}};
    if (!side.capture.empty()) json["capture"] = side.capture;
    if (!side.device.empty()) json["device"] = {{"name", side.device}, {"driver", side.driver}, {"cpu", side.cpu}};
    return json;
}

ordered_json json_of(const ErrorLimits& limits) {
    ordered_json json{{"limit", limits.limit.value_or(0)}, {"percent", limits.percent}, {"ulps", limits.ulps}};
    if (limits.hard_limit < ErrorLimits::none) json["hard_limit"] = limits.hard_limit;
    if (limits.warn_limit < ErrorLimits::none) json["warn"] = {{"limit", limits.warn_limit}, {"percent", limits.warn_percent}};
    if (limits.flip_mean) json["flip_mean"] = *limits.flip_mean;
    if (limits.region) json["region_percent"] = *limits.region;
    if (!limits.images.empty()) json["images"] = limits.images;
    for (const PixelBox& box : limits.ignored.boxes) json["ignored"].push_back({box.x, box.y, box.width, box.height});
    if (!limits.ignored.mask.empty()) json["ignored_by_mask"] = std::ranges::count(limits.ignored.mask, true);
    return json;
}

}  // namespace

Page page_of(const Comparison& comparison) {
    Page page{side_text("A", comparison.a) + side_text("B", comparison.b) + "relative errors are relative to A\n"};
    std::size_t over = 0, images = 0;
    for (const FrameComparison& frame : comparison.frames) {
        page.emplace_back(fmt::format("\nframe {}\n", frame.frame));
        page.emplace_back(Lines{lines_of(frame)});
        const Divergence& first = frame.divergence;
        page.emplace_back((first.pass.empty() ? "" : fmt::format("  first difference: {}: {}\n", first.pass, first.image)) +
                          (first.step.empty() ? "" : fmt::format("    {}\n", first.step)));
        for (const std::string& note : frame.notes) page.emplace_back(fmt::format("  {}\n", note));
        for (const PassComparison& pass : frame.passes) {
            images += pass.images.size();
            over += static_cast<std::size_t>(std::ranges::count(pass.images, Verdict::over, &ImageComparison::verdict));
        }
    }
    page.emplace_back(
        fmt::format("\n{}: {} of {} over tolerance\n", shouted(verdict(comparison)), over, plural(images, "image")));
    return page;
}

std::string as_text(const Comparison& comparison) { return as_text(page_of(comparison)); }

Sheet sheet_of(const Comparison& comparison) {
    Images all;
    for (const FrameComparison& frame : comparison.frames)
        for (const PassComparison& pass : frame.passes)
            for (const ComparedImage& image : images_of(frame, pass)) all.push_back(image);
    return sheet_of_images(all);
}

std::string as_csv(const Comparison& comparison) { return as_csv(std::vector{sheet_of(comparison)}); }

std::string as_json(const Comparison& comparison) {
    ordered_json json = document({.schema = "strata.diff", .date = comparison.date});
    json.update({{"tool", comparison.tool},
                 {"a", json_of(comparison.a)},
                 {"b", json_of(comparison.b)},
                 {"reference", "a"},
                 {"limits", json_of(comparison.limits)},
                 {"verdict", name(verdict(comparison))},
                 {"rerun", comparison.rerun},
                 {"frames", ordered_json::array()}});
    for (const FrameComparison& frame : comparison.frames) json["frames"].push_back(json_of(frame, comparison.limits.flip));
    return json_text(json);
}

}  // namespace strata
