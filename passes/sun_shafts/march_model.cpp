// Marched sun shafts in double, from docs/algorithms/deferred.md 6.2 to 6.4. Which texel a step reads hangs on rounding where it
// lies on a border between two, and whether it is lit where it lies on the caster: what a step may gain or lose by that is
// followed through the sum and the upsampling, and pixels that it changes visibly are undecided.
#include "passes/sun_shafts/march_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "capture_format/frame/frame.h"
#include "passes/edges/plain_pixels.h"
#include "passes/reference/pcg.h"
#include "passes/reference/shade.h"
#include "passes/settings.h"
#include "passes/shadows/lookup.h"
#include "passes/stage_input.h"
#include "passes/sun_shafts/march.shared.h"
#include "passes/sun_shafts/march_params.h"
#include "passes/sun_shafts/truths.h"

namespace strata::sun_shafts {
namespace {

using std::numbers::pi;

// How much of a pixel, or of the picture's root mean square where that is more, may hang on rounding before it is left out.
constexpr double most_spread = 2e-3;
// Float positions are good to this share of their size, map coordinates to this share of the map's edge, depths to this step.
constexpr double close_share = 5e-7, close_edge = 2.5e-7, close_depth = 1e-6;
// Of a step: the gradient's factors are fixed-point numbers, their product is cut to 16 bits; per pixel of x + y and at all.
constexpr double close_gradient_pixel = 7e-9, close_gradient = 1.6e-5;

/// A part of what a ray scatters if it is lit throughout, and what it may differ by if rounding decides otherwise.
struct Amount {
    double share = 0, spread = 0;
};

struct MarchedRay {
    glm::dvec3 direction{0};
    double meters = 0, z = 0;
};

/// A frame's rays and what one step of them finds.
class March {
public:
    March(const StageInput& input, const MarchParams& chosen)
        : input(input),
          params(chosen),
          depths(input.before.at("depth_layers")),
          density_(double(input.frame.fog.density)),
          near_(double(input.frame.view.near)),
          to_sun_(-(input.frame.view.to_view * glm::normalize(glm::dvec3(input.frame.sun.direction)))) {
        const auto maps = input.before.find("shadow_maps");
        if (maps == input.before.end() || !input.frame.sun.shadow.casts) return;
        maps_ = &maps->second;
        // The settings of the maps' technique are not given: with a map per layer every light has its own.
        ShadowFilter filter;
        const auto own = shadow_views_of(filter);
        const auto largest = std::ranges::max_element(own, {}, &ShadowView::size)->size;
        if (maps_->layers != own.size() || maps_->width != largest) filter.allocation = 1;
        for (const ShadowView& view : shadow_views_of(filter))
            if (view.light == 0) cascades_.push_back(view);
    }

    MarchedRay ray_to(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
        const glm::dvec2 offset = sample_position(depths.layers, sample);
        const double z = end_depth(x, y, sample);
        const glm::dvec3 end = z * pixel_ray(input.frame, x + offset.x, y + offset.y);
        return {glm::normalize(end), glm::length(end), z};
    }
    double end_depth(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
        const double far = std::max(double(input.frame.sun.shadow_distance), 2 * near_);
        const double depth = depths.at(x, y, sample).x;
        return depth > 0 ? std::min(near_ / depth, far) : far;
    }
    /// What a ray that is lit throughout scatters.
    double whole(const MarchedRay& ray) const { return scatters_by_step() ? 1 : -std::expm1(-density_ * ray.meters); }
    Amount marched(const MarchedRay&, glm::uvec2 texel) const;
    glm::dvec3 radiance(const MarchedRay&) const;

    const StageInput& input;
    const MarchParams params;
    const ReferenceImage& depths;

private:
    struct Lit {
        double lit = 1, low = 1, high = 1;
    };
    std::vector<ShadowView> shadow_views_of(const ShadowFilter& filter) const {
        return shadows::LookupScene(input.frame, *maps_, filter).views;
    }
    bool scatters_by_step() const { return params.normalization == normalization_steps; }
    double drawn(glm::uvec2 texel) const;
    double weight(std::uint32_t step, const MarchedRay&, double place) const;
    double close_meters(const MarchedRay&, glm::uvec2 texel) const;
    Lit lit_at(const MarchedRay&, double place, double close_meters) const;
    Lit lit_in(const ShadowView&, const glm::dvec3& place, double close_meters) const;
    double looked_up(const shadows::Lookup&) const;

    const double density_, near_;
    const glm::dvec3 to_sun_;
    const ReferenceImage* maps_ = nullptr;
    std::vector<ShadowView> cascades_;
};

double March::drawn(glm::uvec2 texel) const {
    if (params.jitter == jitter_none) return params.stepping == stepping_xray ? 0 : 0.5;
    if (params.jitter == jitter_hash) {
        std::uint32_t h = static_cast<std::uint32_t>(input.frame.seed);
        for (const std::uint32_t part : {texel.x, texel.y, static_cast<std::uint32_t>(input.frame.index)}) h = pcg(h ^ part);
        return ((h >> 16) + 0.5) / 65536;
    }
    if (params.jitter == jitter_interleaved) {
        constexpr std::array<int, 16> bayer = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
        return (bayer.at(texel.y % 4 * 4 + texel.x % 4) + 0.5) / 16;
    }
    const double gradient = 52.9829189 * glm::fract(0.06711056 * texel.x + 0.00583715 * texel.y);
    return (std::floor(65536 * glm::fract(gradient)) + 0.5) / 65536;
}

/// Of a step in the sum that gives whole() where every step is lit, with sampled extinction but for its error.
double March::weight(std::uint32_t step, const MarchedRay& ray, double place) const {
    const double n = params.steps, depth = density_ * ray.meters / n;
    if (scatters_by_step()) return 1 / n;
    if (params.extinction == extinction_sampled) return depth * std::exp(-density_ * place);
    const double stratum = params.stepping == stepping_xray ? n - 1 - step : step;
    return std::exp(-depth * stratum) - std::exp(-depth * (stratum + 1));
}

double March::looked_up(const shadows::Lookup& at) const {
    if (params.taps == taps_4) return shadows::filter_map(*maps_, at, 2).lit;
    return std::max(at.depth, 0.0) >= shadows::map_depth(*maps_, at, glm::ivec2(glm::floor(at.u))) ? 1 : 0;
}

March::Lit March::lit_in(const ShadowView& view, const glm::dvec3& place, double close_meters) const {
    const glm::dvec4 map = view.view_to_map * glm::dvec4(place + view.bias * to_sun_, 1);
    const shadows::Lookup at{
        .layer = view.layer, .size = view.size, .u = glm::dvec2(map) * double(view.size), .depth = map.z, .offset = view.offset};
    const double lit = looked_up(at), meters = close_meters + close_share * (1 + glm::length(place));
    const double texels = close_edge * double(view.size) + meters / view.texel;
    const double depth = close_depth + meters * glm::length(glm::dvec3(glm::transpose(view.view_to_map)[2]));
    Lit found{lit, lit, lit};
    for (int corner = 0; corner < 8; ++corner) {
        shadows::Lookup other = at;
        other.u += texels * glm::dvec2(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1);
        other.depth += corner & 4 ? depth : -depth;
        const double there = looked_up(other);
        found.low = std::min(found.low, there);
        found.high = std::max(found.high, there);
    }
    return found;
}

/// How far a step's place may be from its like on the device, for the numbers that are drawn.
double March::close_meters(const MarchedRay& ray, glm::uvec2 texel) const {
    if (params.jitter != jitter_interleaved_gradient) return 0;
    return (close_gradient + close_gradient_pixel * (texel.x + texel.y)) * ray.meters / params.steps;
}

March::Lit March::lit_at(const MarchedRay& ray, double place, double close_meters) const {
    if (cascades_.empty()) return {};
    // Maps begin at the near plane: what lies before it is lit as the place on it.
    const glm::dvec3 position = std::max(place, near_ / ray.direction.z) * ray.direction;
    std::size_t slot = cascades_.size() - 1;
    if (params.cascade == cascade_of_step)
        while (slot > 0 && position.z < cascades_[slot - 1].range_end) --slot;
    Lit found = lit_in(cascades_[slot], position, close_meters);
    for (std::size_t other = 0; other + 1 < cascades_.size(); ++other) {
        const double border = cascades_[other].range_end;
        if (params.cascade == cascade_last || std::abs(position.z - border) > 1e-5 * border + close_meters) continue;
        for (const std::size_t side : {other, other + 1}) {
            const Lit there = lit_in(cascades_[side], position, close_meters);
            found.low = std::min(found.low, there.low);
            found.high = std::max(found.high, there.high);
        }
    }
    return found;
}

Amount March::marched(const MarchedRay& ray, glm::uvec2 texel) const {
    const double n = params.steps, offset = drawn(texel), close = close_meters(ray, texel);
    Amount sum;
    for (std::uint32_t k = 0; k < params.steps; ++k) {
        const double share = params.stepping == stepping_xray ? 1 - k * (n - offset) / (n * n) : (k + offset) / n;
        const double place = share * ray.meters, part = weight(k, ray, place) / whole(ray);
        const Lit found = lit_at(ray, place, close);
        sum.share += part * found.lit;
        sum.spread += part * std::max(found.high - found.lit, found.lit - found.low);
    }
    return sum;
}

/// Of a ray that scatters all of the sun's light and is lit throughout.
glm::dvec3 March::radiance(const MarchedRay& ray) const {
    double factor = params.phase == phase_xray ? 0.8 * (0.5 * to_sun_.z + 0.5) + 0.2 : 1;
    if (params.phase == phase_henyey_greenstein) {
        const double g = phase_asymmetries.at(params.asymmetry);
        factor = (1 - g * g) * std::pow(1 + g * g - 2 * g * glm::dot(ray.direction, to_sun_), -1.5);
    }
    return glm::dvec3(input.frame.sun.irradiance) * factor * (scatters_by_step() ? double(params.intensity) : 1 / (4 * pi));
}

/// Lit shares of all rays, one for `divisor` x `divisor` pixels.
class Shares {
public:
    explicit Shares(const March& march)
        : march_(march),
          divisor_(march.params.resolution == resolution_half ? 2 : 1),
          width_((march.depths.width + divisor_ - 1) / divisor_),
          height_((march.depths.height + divisor_ - 1) / divisor_),
          layers_(divisor_ > 1 ? 1 : march.depths.layers) {
        fill([&](std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
            return march_.marched(march_.ray_to(divisor_ * x, divisor_ * y, sample), {x, y});
        });
        if (march.params.blur == 0) return;
        const std::vector<Amount> from = amounts_;
        fill([&](std::uint32_t x, std::uint32_t y, std::uint32_t sample) { return blurred(from, {x, y}, sample); });
    }
    /// The share of a sample; among the four around a pixel bilinear where one stands for 2 x 2, by fit.
    Amount of(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
        if (divisor_ == 1) return amounts_[index(x, y, sample)];
        const double z = march_.end_depth(x, y, sample);
        const glm::dvec2 part(0.5 * (x % 2), 0.5 * (y % 2));
        Amount sum;
        double weights = 0;
        for (std::uint32_t i = 0; i < 4; ++i) {
            const std::uint32_t dx = i % 2, dy = i / 2;
            const std::uint32_t tx = std::min(x / 2 + dx, width_ - 1), ty = std::min(y / 2 + dy, height_ - 1);
            const double near = (dx == 1 ? part.x : 1 - part.x) * (dy == 1 ? part.y : 1 - part.y),
                         weight = near * fit(z, tx, ty, 0);
            sum.share += weight * amounts_[index(tx, ty, 0)].share;
            sum.spread += weight * amounts_[index(tx, ty, 0)].spread;
            weights += weight;
        }
        return {sum.share / weights, sum.spread / weights};
    }

private:
    std::size_t index(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
        return (std::size_t(sample) * height_ + y) * width_ + x;
    }
    /// 1 / (1 + (32 dz / z)^2) of the ends of rays.
    double fit(double z, std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
        const double other = march_.end_depth(divisor_ * x, divisor_ * y, sample);
        const double off = 32 * (other - z) / std::min(other, z);
        return 1 / (1 + off * off);
    }
    /// In plain pixels what the first sample has.
    template <typename Make>
    void fill(const Make& make) {
        amounts_.resize(std::size_t(width_) * height_ * layers_);
        tbb::parallel_for(0u, height_, [&](std::uint32_t y) {
            for (std::uint32_t x = 0; x < width_; ++x)
                for (std::uint32_t sample = 0; sample < layers_; ++sample) {
                    const bool repeats = sample > 0 && is_plain_pixel(march_.input, x, y);
                    amounts_[index(x, y, sample)] = repeats ? amounts_[index(x, y, 0)] : make(x, y, sample);
                }
        });
    }
    /// 5 x 5 texels, the outer ones half, by fit and by how many steps' shares lie between: 1 / (1 + (N dV)^2).
    Amount blurred(const std::vector<Amount>& from, glm::ivec2 texel, std::uint32_t sample) const {
        const glm::uvec2 center(texel);
        const double z = march_.end_depth(divisor_ * center.x, divisor_ * center.y, sample);
        const Amount& own = from[index(center.x, center.y, sample)];
        double sum = 0, weights = 0, spreads = 0;
        for (int dy = -2; dy <= 2; ++dy)
            for (int dx = -2; dx <= 2; ++dx) {
                const glm::ivec2 other = texel + glm::ivec2(dx, dy);
                if (other.x < 0 || other.y < 0 || other.x >= int(width_) || other.y >= int(height_)) continue;
                const glm::uvec2 at(other);
                const Amount& there = from[index(at.x, at.y, sample)];
                const double near = (std::abs(dx) == 2 ? 0.5 : 1) * (std::abs(dy) == 2 ? 0.5 : 1) * fit(z, at.x, at.y, sample);
                const double apart = march_.params.steps * (there.share - own.share), weight = near / (1 + apart * apart);
                sum += weight * there.share;
                weights += weight;
                spreads += near * there.spread;
            }
        // What rounding changes of a share changes its weight, too, and of the own one all weights.
        return {sum / weights, spreads / weights + own.spread};
    }

    const March& march_;
    std::uint32_t divisor_, width_, height_, layers_;
    std::vector<Amount> amounts_;
};

/// Marks texels whose colors rounding may move by too much.
void leave_out(ReferenceImage& image, std::span<const double> spreads) {
    double squares = 0;
    for (const glm::dvec4& texel : image.texels) squares += glm::dot(glm::dvec3(texel), glm::dvec3(texel));
    const double typical = std::sqrt(squares / double(image.texels.size()));
    for (std::size_t i = 0; i < spreads.size(); ++i)
        image.undecided.push_back(spreads[i] > most_spread * std::max(typical, glm::length(glm::dvec3(image.texels[i]))));
}

}  // namespace

ImageSet march_model(const StageInput& input, const Settings& settings) {
    if (!input.before.contains("depth_layers")) return {};
    const March march(input, settings.as<MarchParams>());
    const Shares shares(march);
    const ReferenceImage& shape = march.depths;
    ReferenceImage shafts(shape.width, shape.height, shape.layers, {0, 0, 0, 1});
    std::vector<double> spreads(shafts.texels.size());
    tbb::parallel_for(0u, shape.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < shape.width; ++x)
            for (std::uint32_t sample = 0; sample < shape.layers; ++sample) {
                const bool repeats = sample > 0 && is_plain_pixel(input, x, y);
                const MarchedRay ray = march.ray_to(x, y, repeats ? 0 : sample);
                const Amount found = shares.of(x, y, repeats ? 0 : sample);
                const glm::dvec3 whole = march.whole(ray) * march.radiance(ray);
                const std::size_t texel = shafts.index(x, y, sample);
                shafts.texels[texel] = glm::dvec4(found.share * whole, 1);
                spreads[texel] = found.spread * glm::length(whole);
            }
    });
    leave_out(shafts, spreads);
    return {{"shafts", shafts}};
}

}  // namespace strata::sun_shafts
