#include "replay/difference/compare_images.h"

#include <algorithm>

#include "passes/debug_views.h"
#include "replay/plural.h"

namespace strata {
namespace {

constexpr std::string_view verdict_names[] = {"same", "not compared", "within", "warning", "over"};

/// What people call the channel of the worst pixel.
std::string_view channel_name(const ImageError& error) {
    constexpr std::string_view names[] = {"red", "green", "blue", "alpha"};
    if (error.channels == 1) return error.kind == ImageError::Kind::depth ? "z" : "value";
    return names[error.worst_pixel.channel];
}

std::string at_text(const ImageError& error) {
    const WorstPixel& worst = error.worst_pixel;
    std::string place = fmt::format("({}, {})", worst.x, worst.y);
    if (worst.layer > 0) place += fmt::format(" layer {}", worst.layer);
    return fmt::format("{} at {}: A {:.9g}, B {:.9g}", channel_name(error), place, worst.a, worst.b);
}

/// "32 x 32 pixels at (100, 40), 98 % of them over; ", where what is over stands in a part of the image.
std::string region_text(const ImageError& error) {
    if (!error.region || error.region->pixels < 2) return "";
    const PixelBox& box = error.region->box;
    return fmt::format("densest in {} x {} pixels at ({}, {}), {:.3g} % of them over; ", box.width, box.height, box.x, box.y,
                       100 * error.region->density);
}

double percent(std::uint64_t part, std::uint64_t whole) { return 100 * double(part) / double(std::max<std::uint64_t>(1, whole)); }

/// The limits in force with their values.
std::vector<Judged> judged(const ImageComparison& made, const ErrorLimits& limits) {
    const ImageError& error = made.error;
    std::vector<Judged> all;
    const bool flip_alone = made.flip && limits.flip_mean && !limits.limit;
    if (error.kind == ImageError::Kind::values) {
        if (!flip_alone)
            all.push_back({fmt::format("percent of pixels over {:g}", limits.limit.value_or(0)),
                           percent(error.over_limit, error.pixels), limits.percent});
        if (limits.hard_limit < ErrorLimits::none) all.push_back({"worst", error.worst, limits.hard_limit});
    } else {
        const bool depth = error.kind == ImageError::Kind::depth;
        all.push_back({depth ? "worst in ULPs" : "worst", error.worst, depth ? double(limits.ulps) : 0});
    }
    all.push_back({"NaN or Inf in only one", double(error.disagreeing), 0});
    if (limits.region && error.kind == ImageError::Kind::values)
        all.push_back({fmt::format("percent of a {0} x {0} block over {1:g}", region_block, limits.limit.value_or(0)),
                       error.region ? 100 * error.region->block_density : 0, *limits.region});
    if (made.flip && limits.flip_mean) all.push_back({"flip mean", made.flip->mean, *limits.flip_mean});
    // FLIP sees no alpha.
    if (flip_alone && error.alpha_mean) all.push_back({"alpha mean", *error.alpha_mean, *limits.flip_mean});
    return all;
}

void decide(ImageComparison& made, const ErrorLimits& limits) {
    made.judged = judged(made, limits);
    if (made.error.worst == 0 && made.error.disagreeing == 0 && made.error.ignored > 0) {
        made.verdict = Verdict::within;
        made.reason = fmt::format("no pixel differs but some of the {} that are ignored", made.error.ignored);
        return;
    }
    const auto broken = std::ranges::find_if(made.judged, [](const Judged& j) { return j.value > j.threshold; });
    if (broken != made.judged.end()) {
        std::rotate(made.judged.begin(), broken, broken + 1);
        const Judged& first = made.judged.front();
        made.verdict = Verdict::over;
        made.reason = fmt::format("{}: {:.6g}, allowed {:.6g}; {}{}", first.metric, first.value, first.threshold,
                                  region_text(made.error), at_text(made.error));
        return;
    }
    const double warned = percent(made.error.over_warn_limit, made.error.pixels);
    made.verdict = warned > limits.warn_percent ? Verdict::warning : Verdict::within;
    made.reason = made.verdict == Verdict::warning
                      ? fmt::format("{:.3g} % of pixels are over {:g}, a warning above {:g} %; {}", warned, limits.warn_limit,
                                    limits.warn_percent, at_text(made.error))
                      : at_text(made.error);
}

/// Ignored pixels are those of A in both.
void hide(const IgnoredPixels& ignored, const ColorPlanes& a, ColorPlanes& b) {
    if (ignored.is_empty()) return;
    for (std::uint32_t y = 0; y < b.height; ++y)
        for (std::uint32_t x = 0; x < b.width; ++x) {
            if (!ignored.has(x, y)) continue;
            const std::size_t i = std::size_t(y) * b.width + x;
            for (std::size_t c = 0; c < b.rgb.size(); ++c) b.rgb[c][i] = a.rgb[c][i];
            if (!b.broken.empty()) b.broken[i] = !a.broken.empty() && a.broken[i];
        }
}

}  // namespace

std::string_view name(Verdict verdict) { return verdict_names[static_cast<std::size_t>(verdict)]; }

Content content_of(const DebugView& view) {
    return view.unit == "W/(m^2 sr)" || view.unit == "W/sr" ? Content::radiance : Content::numbers;
}

Result<ImageComparison> compare_images(const std::string& name, const HostImage& a, const HostImage& b,
                                       const ErrorLimits& limits) {
    if (const auto comparable = check_comparable(name, a, b); !comparable) return comparable.error();
    const Extent& extent = a.shape.extent;
    const IgnoredPixels& ignored = limits.ignored;
    if (!ignored.mask.empty() && (ignored.mask_width != extent.width || ignored.mask_height != extent.height))
        return fail(
            Fault::usage, "diff.mask_size",
            "the mask of --ignore has {mask_width} x {mask_height} pixels and '{image}' {width} x {height}; choose images "
            "of its size with --images",
            ignored.mask_width, ignored.mask_height, name, extent.width, extent.height);
    const Content content = content_of(name, a.shape.format);
    ImageComparison made{.image = name, .error = image_error(a, b, limits, name)};
    if (made.error.pixels > 0 && made.error.ignored == made.error.pixels)
        return fail(Fault::usage, "diff.all_ignored", "--ignore leaves no pixel of '{image}' to compare", name);
    const bool is_light = content == Content::radiance || content == Content::display;
    if (is_light && made.error.identical) {
        made.flip = Flip{};
    } else if (is_light) {
        const ColorPlanes of_a = color_planes(a);
        ColorPlanes of_b = color_planes(b);
        hide(ignored, of_a, of_b);
        made.flip = content == Content::radiance ? radiance_flip(of_a, of_b, limits.flip)
                                                 : display_flip(of_a, of_b, limits.flip.pixels_per_degree);
    }
    if (!made.error.identical) decide(made, limits);
    return made;
}

}  // namespace strata
