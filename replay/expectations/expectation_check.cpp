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

/// Nothing where the expected image has another shape or is not kept.
Result<std::optional<ImageDeviation>> deviation_from(const Capture& capture, const ExpectedImage& expected,
                                                     const HostImage& got) {
    if (got.shape.extent != expected.shape.extent || got.shape.format != expected.shape.format ||
        got.shape.layers != expected.shape.layers)
        return std::optional<ImageDeviation>();
    const auto kept = kept_image(capture, expected);
    if (!kept) return kept.error();
    return *kept ? std::optional(deviation_of(expected.name, got, **kept)) : std::nullopt;
}

/// An image that a run gave, by hash and by texels.
struct GivenImage {
    const ExpectedImage& image;
    const HostImage& texels;
};

/// `accepted` are the images of that name of the accepted results, newest first.
Result<ImageVerdict> judge_image(const Capture& capture, std::span<const ExpectedImage* const> accepted, const GivenImage& got,
                                 double tolerance) {
    ImageVerdict verdict{.image = got.image.name, .agreement = Agreement::diverges, .hash = got.image.hash};
    if (std::ranges::count(accepted, got.image.hash, &ExpectedImage::hash) > 0) {
        verdict.agreement = Agreement::exact;
        verdict.expected_hash = got.image.hash;
        return verdict;
    }
    for (const ExpectedImage* expected : accepted) {
        const auto deviation = deviation_from(capture, *expected, got.texels);
        if (!deviation) return deviation.error();
        const bool is_nearer = *deviation && (!verdict.deviation || (*deviation)->rmse < verdict.deviation->rmse);
        if (expected != accepted.front() && !is_nearer) continue;
        verdict.expected_hash = expected->hash;
        verdict.deviation = *deviation;
    }
    if (verdict.deviation && verdict.deviation->rmse <= tolerance && tolerance > 0)
        verdict.agreement = Agreement::within_tolerance;
    return verdict;
}

/// The images of that name of a pass of the accepted results, newest first; some may have none.
std::vector<const ExpectedImage*> accepted_images(std::span<const Expectation* const> accepted, std::size_t pass,
                                                  std::string_view name) {
    std::vector<const ExpectedImage*> images;
    for (const Expectation* each : accepted)
        if (const ExpectedImage* image = find(each->passes[pass], name)) images.push_back(image);
    return images;
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

std::vector<const Expectation*> accepted_for(std::span<const Expectation> all, const Expectation& got) {
    std::vector<const Expectation*> accepted;
    for (std::size_t i = all.size(); i-- > 0;) {
        if (all[i].on != got.on || !same_frame_and_choices(all[i], got)) continue;
        accepted.push_back(&all[i]);
        if (!all[i].also) break;
    }
    return accepted;
}

Result<ExpectationVerdict> compare_with(const Capture& capture, std::span<const Expectation* const> accepted, const Run& run,
                                        const Expectation& got, double tolerance) {
    ExpectationVerdict verdict{.agreement = Agreement::exact};
    const Expectation& newest = *accepted.front();
    if (newest.on != got.on) verdict.elsewhere = newest.on;
    // The passes of all are the same ones: see same_frame_and_choices().
    for (std::size_t i = 0; i < got.passes.size(); ++i) {
        const auto add = [&](ImageVerdict image) {
            image.pass = got.passes[i].label;
            image.accepted = accepted.size();
            verdict.agreement = std::max(verdict.agreement, image.agreement);
            verdict.images.push_back(std::move(image));
        };
        for (const ExpectedImage& image : got.passes[i].images) {
            const GivenImage given{image, run.passes[i].images.at(image.name)};
            auto one = judge_image(capture, accepted_images(accepted, i, image.name), given, tolerance);
            if (!one) return one.error();
            add(*std::move(one));
        }
        for (const ExpectedImage& image : newest.passes[i].images)
            if (!find(got.passes[i], image.name) && accepted_images(accepted, i, image.name).size() == accepted.size())
                add({.image = image.name, .agreement = Agreement::diverges, .expected_hash = image.hash});
    }
    return verdict;
}

Result<ExpectationVerdict> check_expectations(const Capture& capture, std::span<const Expectation> all, const Run& run,
                                              const Expectation& got, double tolerance) {
    if (const auto own = accepted_for(all, got); !own.empty()) return compare_with(capture, own, run, got, tolerance);
    ExpectationVerdict best;
    for (std::size_t i = all.size(); i-- > 0;) {
        if (!same_frame_and_choices(all[i], got)) continue;
        const auto accepted = accepted_for(all, all[i]);
        if (accepted.front() != &all[i]) continue;  // compared with the newest of its device, or replaced
        auto other = compare_with(capture, accepted, run, got, tolerance);
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
    const auto of_several = [&](const char* which) {
        return verdict.accepted > 1 ? fmt::format(", the {} of {} accepted results", which, verdict.accepted) : "";
    };
    if (!verdict.deviation)
        return text + fmt::format(" has hash {}, expected was {}", verdict.hash, verdict.expected_hash) + of_several("newest");
    const WorstTexel& w = verdict.deviation->worst;
    return text +
           fmt::format(
               " differs in {} of {} texels, relative rmse {:.3g}; the worst is ({}, {}) of layer {}: "
               "({:.7g}, {:.7g}, {:.7g}, {:.7g}), expected ({:.7g}, {:.7g}, {:.7g}, {:.7g})",
               verdict.deviation->differing, verdict.deviation->texels, verdict.deviation->rmse, w.x, w.y, w.layer, w.got.x,
               w.got.y, w.got.z, w.got.w, w.wanted.x, w.wanted.y, w.wanted.z, w.wanted.w) +
           of_several("nearest");
}

}  // namespace strata
