#include "replay/measure/image_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "passes/error_sums.h"

namespace strata {
namespace {

using Kind = ImageError::Kind;

Kind kind_of(std::string_view name, Format format) {
    if (row(format).kind == FormatKind::integer) return Kind::integers;
    return content_of(name, format) == Content::depth ? Kind::depth : Kind::values;
}

bool is_opaque(const HostImage& image) {
    const Extent& extent = image.shape.extent;
    for (std::uint32_t layer = 0; layer < image.shape.layers * extent.depth; ++layer)
        for (std::uint32_t y = 0; y < extent.height; ++y)
            for (std::uint32_t x = 0; x < extent.width; ++x)
                if (texel(image, x, y, layer).w != 1) return false;
    return true;
}

/// Neighboring floats are one apart, -0 and +0 are the same.
std::int64_t place_among_floats(double value) {
    const auto real = static_cast<float>(value);
    std::int32_t bits = 0;
    std::memcpy(&bits, &real, sizeof bits);
    return bits < 0 ? -std::int64_t{bits & 0x7fffffff} : bits;
}

double distance(Kind kind, double a, double b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
    if (!std::isfinite(a) || !std::isfinite(b)) return HUGE_VAL;
    if (kind != Kind::depth) return std::abs(a - b);
    return static_cast<double>(std::abs(place_among_floats(a) - place_among_floats(b)));
}

void count(double value, ImageError::Count& counts) {
    counts.nan += std::isnan(value);
    counts.inf += std::isinf(value);
}

/// What a pixel may differ by in each kind.
double limit_of(Kind kind, const ErrorLimits& limits) {
    if (kind == Kind::values) return limits.limit.value_or(0);
    return kind == Kind::depth ? double(limits.ulps) : 0;
}

/// "(4, 0) to (19, 8)".
std::string window_text(const HostImage& image) {
    const auto last = [](int first, std::uint32_t edge) { return std::int64_t{first} + edge - 1; };
    return fmt::format("({}, {}) to ({}, {})", image.place.x, image.place.y, last(image.place.x, image.shape.extent.width),
                       last(image.place.y, image.shape.extent.height));
}

}  // namespace

std::string shape_text(const Shape& shape) {
    std::string text = fmt::format("{} x {}", shape.extent.width, shape.extent.height);
    if (shape.extent.depth > 1) text += fmt::format(" x {}", shape.extent.depth);
    if (shape.layers > 1) text += fmt::format(", {} layers", shape.layers);
    return text + fmt::format(", {}", row(shape.format).name);
}

Result<void> check_comparable(const std::string& name, const HostImage& a, const HostImage& b) {
    const FormatRow &of_a = row(a.shape.format), &of_b = row(b.shape.format);
    const bool integers = of_a.kind == FormatKind::integer, same_kind = integers == (of_b.kind == FormatKind::integer);
    const bool same_shape =
        a.shape.extent == b.shape.extent && a.shape.layers == b.shape.layers && of_a.channels == of_b.channels && same_kind;
    if (same_shape && a.place == b.place) return {};
    if (same_shape)
        return fail(Fault::usage, "image.windows_differ",
                    "'{image}' cannot be compared: A covers the pixels {a} of its picture, B {b}; bring both to one data window",
                    name, window_text(a), window_text(b));
    return fail(Fault::usage, "image.shapes_differ",
                "'{image}' cannot be compared: A is {a}, B is {b}; bring both to one size, number of layers and channels", name,
                shape_text(a.shape), shape_text(b.shape));
}

Content content_of(std::string_view image, Format format) {
    if (const FrameImageRow* known = find_frame_image(image)) return known->content;
    const FormatRow& f = row(format);
    if (f.kind == FormatKind::depth) return Content::depth;
    if (f.kind == FormatKind::integer || f.channels < 3) return Content::numbers;
    return f.bytes == f.channels ? Content::display : Content::radiance;
}

std::uint32_t judged_channels(std::string_view image, const HostImage& a, const HostImage& b) {
    const std::uint32_t channels = row(a.shape.format).channels;
    const Content content = content_of(image, a.shape.format);
    if (channels < 4 || (content != Content::radiance && content != Content::display) || image == "emission") return channels;
    return find_frame_image(image) || (is_opaque(a) && is_opaque(b)) ? 3 : 4;
}

ImageError image_error(const HostImage& a, const HostImage& b, const ErrorLimits& limits, std::string_view name) {
    assert(check_comparable("", a, b));
    const Extent& extent = a.shape.extent;
    const std::uint32_t channels = row(a.shape.format).channels, layers = a.shape.layers * extent.depth,
                        judged = judged_channels(name, a, b);
    const Kind kind = kind_of(name, a.shape.format);
    ImageError error{.kind = kind,
                     .identical = a.shape.format == b.shape.format && a.texels == b.texels,
                     .pixels = std::uint64_t{extent.width} * extent.height * layers,
                     .channels = channels};
    const double limit = limit_of(kind, limits), warn_limit = kind == Kind::values ? limits.warn_limit : ErrorLimits::none;
    ErrorSums sums;
    double alpha = 0;
    std::vector<bool> is_over(std::size_t(extent.width) * extent.height);
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        is_over.assign(is_over.size(), false);
        const std::uint64_t over_before = error.over_limit;
        for (std::uint32_t y = 0; y < extent.height; ++y)
            for (std::uint32_t x = 0; x < extent.width; ++x) {
                if (limits.ignored.has(x, y)) {
                    ++error.ignored;
                    continue;
                }
                const glm::dvec4 p = texel(a, x, y, layer), q = texel(b, x, y, layer);
                double worst = 0;
                for (std::uint32_t channel = 0; channel < channels; ++channel) {
                    const auto c = static_cast<glm::length_t>(channel);
                    const double apart = distance(kind, p[c], q[c]);
                    count(p[c], error.in_a);
                    count(q[c], error.in_b);
                    if (channel < judged && !std::isinf(apart) && !std::isnan(p[c])) sums.add(q[c], p[c]);
                    if (channel == 3 && !std::isinf(apart)) alpha += apart;
                    error.disagreeing += std::isinf(apart);
                    worst = std::max(worst, apart);
                    if (apart <= error.worst) continue;
                    error.worst = apart;
                    error.worst_pixel = {x, y, layer, channel, p[c], q[c]};
                }
                error.over_limit += worst > limit;
                error.over_warn_limit += worst > warn_limit;
                is_over[std::size_t(y) * extent.width + x] = worst > limit;
            }
        if (error.over_limit == over_before) continue;
        auto region = worst_region(is_over, extent.width, extent.height);
        if (!region || (error.region && error.region->block_density >= region->block_density)) continue;
        region->layer = layer;
        error.region = region;
    }
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    error.rmse = sums.values > 0 ? sums.rmse() : nothing;
    error.reference = sums.reference();
    error.relative_rmse = sums.values > 0 ? sums.relative() : nothing;
    if (judged == 4 && kind == Kind::values) error.alpha_mean = alpha / std::max(1.0, double(error.pixels));
    return error;
}

}  // namespace strata
