#include "passes/transparency/weighted_additive/model.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "passes/transparency/rounding.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {
namespace {

constexpr double largest_half = half_float.largest;

double saturated(double value) { return std::clamp(value, 0., 1.); }
glm::dvec3 bounded(const glm::dvec3& v) { return glm::clamp(v, -largest_half, largest_half); }
double mean(const glm::dvec3& v) { return (v.x + v.y + v.z) / 3; }
double covered(const Fragment& f) { return saturated(coverage(f)); }
double relative_emission(const Fragment& f, double exposure) {
    return glm::dot(f.emission, glm::dvec3(.2126, .7152, .0722)) * exposure;
}

double stored(double value, const WeightedAdditiveParams& params) {
    return params.reveal == reveal_r8 ? std::round(saturated(value) * 255) / 255 : value;
}

}  // namespace

double additive_depth_weight(const WeightedAdditiveParams& params, double z) {
    const double near = .5, far = double(params.far);
    const double canonical = saturated(far / (far - near) - far * near / (z * (far - near)));
    return std::min(1e4 * std::pow(1 - canonical, 3) + 5, 20.);
}

double additive_weight(const WeightedAdditiveParams& params, double exposure, const Fragment& f) {
    const double emission = saturated(relative_emission(f, exposure)) / double(params.feather_start);
    return additive_depth_weight(params, f.depth) * std::pow(saturated(3 * covered(f) + emission), 3);
}

AdditiveSums summed(std::span<const Fragment> fragments, const WeightedAdditiveParams& params, double exposure) {
    AdditiveSums sums;
    const glm::dvec3 brightest(1000);
    for (const Fragment& f : fragments) {
        const double weight = additive_weight(params, exposure, f);
        if (params.normalization == normalization_published) {
            sums.colors += glm::min(f.color + f.emission, brightest) * weight;
            sums.weights += weight;
        } else {
            sums.colors += glm::min(f.color, brightest) * weight;
            sums.weights += covered(f) * weight;
            sums.emissions += glm::min(f.emission, brightest) * weight;
            if (f.emission != glm::dvec3(0)) sums.emission_weights += weight;
        }
        for (int c = 0; c < 3; ++c) sums.reveal[c] = stored(sums.reveal[c] * f.transmittance[c], params);
        sums.additiveness = stored(sums.additiveness + saturated(10 * relative_emission(f, exposure)) / 8, params);
    }
    return merged(sums, {});
}

AdditiveSums merged(const AdditiveSums& a, const AdditiveSums& b) {
    return {.colors = bounded(a.colors + b.colors),
            .emissions = bounded(a.emissions + b.emissions),
            .weights = std::min(a.weights + b.weights, largest_half),
            .emission_weights = std::min(a.emission_weights + b.emission_weights, largest_half),
            .reveal = a.reveal * b.reveal,
            .additiveness = a.additiveness + b.additiveness};
}

glm::dvec3 composite(const AdditiveSums& sums, glm::dvec3 behind, const WeightedAdditiveParams& params) {
    const double reveal = mean(sums.reveal), layers = 8 * sums.additiveness;
    const glm::dvec3 average = sums.colors / std::max(sums.weights, 1e-5);
    const glm::dvec3 largest = glm::max(sums.colors, sums.emissions);
    glm::dvec3 light(100);
    if (std::max({largest.x, largest.y, largest.z}) < largest_half) {
        if (params.normalization == normalization_published) {
            light = average * std::max(layers / 4 * (1 - reveal) + layers * reveal + std::min(2 * (1 - reveal), 1.), 1.);
        } else {
            const glm::dvec3 emitted = sums.emissions / std::max(sums.emission_weights, 1e-5);
            light = average * (1.0 - sums.reveal) + emitted * std::max(layers, 1.) * (reveal + (1 - reveal) / 4);
        }
    }
    return light + behind * sums.reveal;
}

namespace {

Frame drawn_at(Frame frame, Resolution resolution) {
    const auto is_other = [&](const auto& submission) { return submission.resolution != resolution; };
    std::erase_if(frame.draws, is_other);
    std::erase_if(frame.emitters, is_other);
    return frame;
}

/// The farthest depth under each pixel of half the size.
ReferenceImage farthest(const ReferenceImage& depth, std::uint32_t width, std::uint32_t height) {
    ReferenceImage low(width, height, 1, glm::dvec4(1));
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            for (std::uint32_t s = 0; s < depth.layers; ++s)
                for (std::uint32_t v = y * depth.height / height; v * height < (y + 1) * depth.height; ++v)
                    for (std::uint32_t u = x * depth.width / width; u * width < (x + 1) * depth.width; ++u)
                        low.at(x, y) = glm::min(low.at(x, y), depth.at(u, v, s));
    return low;
}

/// Half-resolution fragments, summed where they were drawn, and read bilinearly with edges held.
class LowResolution {
public:
    LowResolution(const StageInput& input, const WeightedAdditiveParams& params) {
        Frame frame = drawn_at(input.frame, Resolution::low);
        if (transparent_draws(frame).empty()) return;
        View& view = frame.view;
        view.width = (view.width + 1) / 2, view.height = (view.height + 1) / 2, view.samples = 1;
        lists_.emplace(transparent_fragments(frame, farthest(input.before.at("depth_layers"), view.width, view.height)));
        for (std::uint32_t y = 0; y < view.height; ++y)
            for (std::uint32_t x = 0; x < view.width; ++x)
                sums_.push_back(summed(lists_->at(x, y), params, double(view.exposure)));
    }

    struct Read {
        AdditiveSums sums;
        bool undecided = false;
    };
    /// At a place of the image, 0 to 1 each way.
    Read at(glm::dvec2 place) const {
        Read result;
        if (!lists_) return result;
        result.sums.reveal = glm::dvec3(0);
        const glm::dvec2 size(lists_->width(), lists_->height()), texel = place * size - .5, low = glm::floor(texel);
        for (int corner = 0; corner < 4; ++corner) {
            const glm::dvec2 offset(corner % 2, corner / 2), to = glm::abs(low + 1.0 - offset - texel);
            const glm::uvec2 at(glm::clamp(low + offset, glm::dvec2(0), size - 1.0));
            add(result.sums, sums_[at.y * lists_->width() + at.x], to.x * to.y);
            result.undecided |= lists_->undecided(at.x, at.y);
        }
        return result;
    }

private:
    static void add(AdditiveSums& to, const AdditiveSums& texel, double share) {
        to.colors += texel.colors * share;
        to.emissions += texel.emissions * share;
        to.weights += texel.weights * share;
        to.emission_weights += texel.emission_weights * share;
        to.reveal += texel.reveal * share;
        to.additiveness += texel.additiveness * share;
    }

    std::optional<FragmentLists> lists_;
    std::vector<AdditiveSums> sums_;
};

}  // namespace

ImageSet weighted_additive_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<WeightedAdditiveParams>();
    const View& view = input.frame.view;
    const LowResolution low(input, params);
    const auto blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3 at) -> BlendedSample {
        const auto read = low.at((glm::dvec2(at) + .5) / glm::dvec2(view.width, view.height));
        const AdditiveSums all = merged(summed(fragments, params, double(view.exposure)), read.sums);
        return {composite(all, behind, params), read.undecided};
    };
    return {{"color", blended(input.before.at("color"), drawn_at(input.frame, Resolution::full), input.before, blend)}};
}

}  // namespace strata::transparency
