#include "replay/expectations/expectation_check.h"

#include <algorithm>
#include <cmath>

#include "capture_format/reader.h"
#include "replay/measure/image_error.h"

namespace strata {
namespace {

/// The expected image of the capture, where it is kept.
Result<std::optional<HostImage>> kept_image(const Capture& capture, const ExpectedImage& expected) {
    if (expected.texels.empty()) return std::optional<HostImage>();
    return capture.expected_image(expected.texels, bytes(expected.shape)).and_then([&](auto& texels) {
        return std::optional(HostImage{expected.shape, std::move(texels)});
    });
}

const ExpectedImage* find(const ExpectedPass& pass, std::string_view name) {
    const auto found = std::ranges::find(pass.images, name, &ExpectedImage::name);
    return found == pass.images.end() ? nullptr : &*found;
}

Result<ImageVerdict> judge_image(const Capture& capture, const ExpectedImage& expected, const HostImage& got, double tolerance) {
    ImageVerdict verdict{.image = expected.name, .agreement = Agreement::diverges, .expected_hash = expected.hash};
    if (got.shape.extent != expected.shape.extent || got.shape.format != expected.shape.format ||
        got.shape.layers != expected.shape.layers)
        return verdict;
    const auto kept = kept_image(capture, expected);
    if (!kept) return kept.error();
    if (!*kept) return verdict;
    verdict.deviation = deviation_of(expected.name, got, **kept);
    if (verdict.deviation->rmse <= tolerance && tolerance > 0) verdict.agreement = Agreement::within_tolerance;
    return verdict;
}

/// The passes of both are the same ones: see same_frame_and_choices().
Result<void> judge_pass(const Capture& capture, const ExpectedPass& expected, const ExpectedPass& got, const PassImages& images,
                        double tolerance, std::vector<ImageVerdict>& verdicts) {
    for (const ExpectedImage& image : got.images) {
        const ExpectedImage* wanted = find(expected, image.name);
        ImageVerdict verdict{.image = image.name, .agreement = Agreement::diverges};
        if (wanted && wanted->hash == image.hash) {
            verdict.agreement = Agreement::exact;
            verdict.expected_hash = wanted->hash;
        } else if (wanted) {
            auto judged = judge_image(capture, *wanted, images.images.at(image.name), tolerance);
            if (!judged) return judged.error();
            verdict = *std::move(judged);
        }
        verdict.pass = got.label;
        verdict.hash = image.hash;
        verdicts.push_back(std::move(verdict));
    }
    for (const ExpectedImage& image : expected.images)
        if (!find(got, image.name))
            verdicts.push_back({got.label, image.name, Agreement::diverges, std::nullopt, image.hash, ""});
    return {};
}

}  // namespace

ImageDeviation deviation_of(const std::string& name, const HostImage& got, const HostImage& expected) {
    const ImageError error = image_error(expected, got, {}, name);
    const WorstPixel& at = error.worst_pixel;
    // Numbers that stand for things (lists, ids) are the same or they are not; so is what is no number.
    const bool is_out = error.disagreeing > 0 || (error.kind == ImageError::Kind::integers && error.over_limit > 0);
    // Light where black is expected is far off, however little.
    const bool is_black = error.reference == 0 && error.rmse > 0;
    const double relative = std::isnan(error.relative_rmse) ? 0 : error.relative_rmse;  // NaN throughout, as expected
    return {.rmse = is_out || is_black ? HUGE_VAL : relative,
            .texels = error.pixels,
            .differing = error.over_limit,
            .worst = {name, at.x, at.y, at.layer, texel(got, at.x, at.y, at.layer), texel(expected, at.x, at.y, at.layer)}};
}

const ImageVerdict* ExpectationVerdict::first_divergence() const {
    const auto found = std::ranges::find(images, Agreement::diverges, &ImageVerdict::agreement);
    return found == images.end() ? nullptr : &*found;
}

const Expectation* newest_for(std::span<const Expectation> all, const Expectation& got) {
    const auto fits = [&](const Expectation& e) { return e.on == got.on && same_frame_and_choices(e, got); };
    const auto found = std::find_if(all.rbegin(), all.rend(), fits);
    return found == all.rend() ? nullptr : &*found;
}

Result<ExpectationVerdict> compare_with(const Capture& capture, const Expectation& expected, const Run& run,
                                        const Expectation& got, double tolerance) {
    ExpectationVerdict verdict{.agreement = Agreement::exact};
    if (expected.on != got.on) verdict.elsewhere = expected.on;
    for (std::size_t i = 0; i < got.passes.size(); ++i)
        if (const auto judged = judge_pass(capture, expected.passes[i], got.passes[i], run.passes[i], tolerance, verdict.images);
            !judged)
            return judged.error();
    for (const ImageVerdict& image : verdict.images) verdict.agreement = std::max(verdict.agreement, image.agreement);
    return verdict;
}

Result<ExpectationVerdict> check_expectations(const Capture& capture, std::span<const Expectation> all, const Run& run,
                                              const Expectation& got, double tolerance) {
    if (const Expectation* own = newest_for(all, got)) return compare_with(capture, *own, run, got, tolerance);
    ExpectationVerdict best;
    for (std::size_t i = all.size(); i-- > 0;) {
        if (!same_frame_and_choices(all[i], got)) continue;
        auto other = compare_with(capture, all[i], run, got, tolerance);
        if (!other) return other;
        const bool has_images = std::ranges::any_of(other->images, [](const ImageVerdict& v) { return v.deviation.has_value(); });
        const bool decides = other->agreement != Agreement::diverges || (tolerance > 0 && has_images);
        if (decides && other->agreement < best.agreement) best = *std::move(other);
    }
    return best;
}

std::string sentence(const ImageVerdict& verdict) {
    std::string text = fmt::format("{}: '{}'", verdict.pass, verdict.image);
    if (verdict.expected_hash.empty()) return text + " was not expected at all";
    if (verdict.hash.empty()) return text + " was expected and is not there";
    if (verdict.agreement == Agreement::exact) return text + " is bit for bit as expected";
    if (!verdict.deviation) return text + fmt::format(" has hash {}, expected was {}", verdict.hash, verdict.expected_hash);
    const WorstTexel& w = verdict.deviation->worst;
    return text + fmt::format(
                      " differs in {} of {} texels, relative rmse {:.3g}; the worst is ({}, {}) of layer {}: "
                      "({:.7g}, {:.7g}, {:.7g}, {:.7g}), expected ({:.7g}, {:.7g}, {:.7g}, {:.7g})",
                      verdict.deviation->differing, verdict.deviation->texels, verdict.deviation->rmse, w.x, w.y, w.layer,
                      w.got.x, w.got.y, w.got.z, w.got.w, w.wanted.x, w.wanted.y, w.wanted.z, w.wanted.w);
}

}  // namespace strata
