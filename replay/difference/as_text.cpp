// A comparison as a table for a terminal: the verdict first.
#include <algorithm>
#include <cctype>

#include "replay/difference/comparison.h"
#include "replay/plural.h"

namespace strata {
namespace {

std::string shouted(Verdict verdict) {
    std::string text(name(verdict));
    if (verdict == Verdict::over || verdict == Verdict::warning)
        std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

std::string place_text(const WorstPixel& worst) {
    return fmt::format("({}, {}){}", worst.x, worst.y, worst.layer ? fmt::format(" layer {}", worst.layer) : "");
}

/// Width of the column that names act and image.
std::size_t name_width(const FrameComparison& frame) {
    std::size_t width = 0;
    for (const ActComparison& act : frame.acts)
        for (const ImageComparison& image : act.images) width = std::max(width, act.label.size() + image.image.size() + 2);
    return width;
}

std::string figures(const ImageComparison& image) {
    const ImageError& error = image.error;
    const std::string unit = error.kind == ImageError::Kind::depth ? " ULPs" : "";
    std::string line = fmt::format("  {:>10.3e}  {:>10.3e}  {:>10}  {:>7.3f}  {:>7}  {}: {:.6g} | {:.6g}", error.rmse,
                                   error.relative_rmse, fmt::format("{:.3g}{}", error.worst, unit),
                                   100 * double(error.over_limit) / double(std::max<std::uint64_t>(1, error.pixels)),
                                   image.flip ? fmt::format("{:.4f}", image.flip->mean) : "-", place_text(error.worst_pixel),
                                   error.worst_pixel.a, error.worst_pixel.b);
    if (const auto bad = error.in_a.nan + error.in_b.nan; bad > 0)
        line += fmt::format("  NaN: {} | {}", error.in_a.nan, error.in_b.nan);
    if (const auto bad = error.in_a.inf + error.in_b.inf; bad > 0)
        line += fmt::format("  Inf: {} | {}", error.in_a.inf, error.in_b.inf);
    return line;
}

std::string row_text(const ActComparison& act, const ImageComparison& image, std::size_t width) {
    std::string line = fmt::format("  {:<12}  {:<{}}", shouted(image.verdict), act.label + ": " + image.image, width);
    const bool measured = image.error.pixels > 0 && !image.error.identical;
    if (measured) line += figures(image);
    else if (!image.reason.empty()) line += "  " + image.reason;
    return line + "\n";
}

std::string side_text(std::string_view letter, const Side& side) {
    std::string text = fmt::format("{}  {}", letter, side.name);
    if (!side.capture.empty()) text += fmt::format("  capture {}", side.capture);
    if (!side.device.empty()) text += fmt::format("  on {} ({})", side.device, side.driver);
    return text + "\n";
}

std::string frame_text(const FrameComparison& frame) {
    const std::size_t width = name_width(frame);
    std::string text =
        fmt::format("\nframe {}\n  {:<12}  {:<{}}  {:>10}  {:>10}  {:>10}  {:>7}  {:>7}  {}\n", frame.frame, "verdict",
                    "pass: image", width, "rmse", "relative", "worst", "over %", "FLIP", "worst pixel: A | B");
    for (const ActComparison& act : frame.acts) {
        if (act.choice_a != act.choice_b)
            text +=
                fmt::format("  {:<12}  {}: A {}, B {}\n", "", act.label, act.choice_a.empty() ? "leaves it out" : act.choice_a,
                            act.choice_b.empty() ? "leaves it out" : act.choice_b);
        for (const ImageComparison& image : act.images) text += row_text(act, image, width);
    }
    const Divergence& first = frame.divergence;
    if (!first.act.empty()) text += fmt::format("  first difference: {}: {}\n", first.act, first.image);
    if (!first.step.empty()) text += fmt::format("    {}\n", first.step);
    return text;
}

}  // namespace

std::string as_text(const Comparison& comparison) {
    std::string text = side_text("A", comparison.a) + side_text("B", comparison.b) + "relative errors are relative to A\n";
    for (const FrameComparison& frame : comparison.frames) text += frame_text(frame);
    std::size_t over = 0, images = 0;
    for (const FrameComparison& frame : comparison.frames)
        for (const ActComparison& act : frame.acts)
            for (const ImageComparison& image : act.images) {
                ++images;
                over += image.verdict == Verdict::over;
            }
    return text + fmt::format("\n{}: {} of {} over tolerance\n", shouted(verdict(comparison)), over, plural(images, "image"));
}

}  // namespace strata
