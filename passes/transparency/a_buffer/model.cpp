#include "passes/transparency/a_buffer/model.h"

#include <algorithm>
#include <cmath>
#include <compare>

#include "capture_format/frame_features.h"
#include "passes/settings.h"
#include "passes/stage_input.h"
#include "passes/transparency/a_buffer/a_buffer_params.h"
#include "passes/transparency/distortion/model.h"
#include "passes/transparency/rounding.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {
namespace {

/// Without a sign, as colors are stored and depths are.
double stored_as(double x, SmallFloat format) { return nearest_code(std::clamp(x, 0., format.largest), format); }

glm::dvec3 through(const Fragment& f, StoredAs kind) {
    return kind == StoredAs::rgb ? f.transmittance : glm::dvec3(1 - coverage(f));
}

Fragment stored(const Fragment& f, StoredAs kind) {
    const glm::dvec3 t = through(f, kind);
    return {.depth = nearest_half(f.depth),
            .color = nearest_r11g11b10(f.color + f.emission),
            .transmittance = kind == StoredAs::rgb ? nearest_r11g11b10(t) : glm::dvec3(nearest_unorm8(t.x))};
}

/// Everything that came too late, as one layer over what is behind.
glm::dvec3 merged_over(std::span<const Fragment> late, glm::dvec3 behind, StoredAs kind) {
    glm::dvec3 sum(0), remains(1);
    double coverages = 0;
    for (const Fragment& f : late) {
        sum += f.color + f.emission;
        remains *= through(f, kind);
        coverages += coverage(f);
    }
    if (coverages > 0) sum *= (1. - remains) / coverages;
    return sum + remains * behind;
}

StoredAs stored_by(std::uint32_t layout, const Frame& frame) {
    if (layout == layout_automatic && !frame_features(frame).has(Feature::chromatic)) return StoredAs::mono;
    return layout == layout_mono ? StoredAs::mono : StoredAs::rgb;
}

/// Whether two depths that are not equal would share a half float, or no longer share one, were floats rounded otherwise.
bool hang_on_rounding(const Fragment& a, const Fragment& b) {
    const auto order = [&](double nudge) { return nearest_half(a.depth * (1 + nudge)) <=> nearest_half(b.depth * (1 - nudge)); };
    return a.depth != b.depth && order(0x1p-20) != order(-0x1p-20);
}

/// As in FragmentLists, of half floats: among those that are stored.
bool is_doubtful(std::span<const Fragment> fragments, std::size_t layers) {
    std::vector<Fragment> sorted(fragments.begin(), fragments.begin() + std::ptrdiff_t(std::min(layers, fragments.size())));
    std::ranges::stable_sort(sorted, {}, &Fragment::depth);
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (hang_on_rounding(sorted[i - 1], sorted[i])) return true;
    return false;
}

}  // namespace

glm::dvec3 nearest_r11g11b10(glm::dvec3 c) { return {stored_as(c.x, float11), stored_as(c.y, float11), stored_as(c.z, float10)}; }

double nearest_half(double x) { return stored_as(x, half_float); }

double nearest_unorm8(double x) { return nearest_code(std::clamp(x, 0., 1.) * 255) / 255; }

glm::dvec3 a_buffer_blend(std::span<const Fragment> fragments, glm::dvec3 behind, std::size_t layers, StoredAs kind) {
    const std::size_t kept = std::min(layers, fragments.size());
    std::vector<Fragment> first;
    for (const Fragment& f : fragments.first(kept)) first.push_back(stored(f, kind));
    glm::dvec3 radiance = merged_over(fragments.subspan(kept), behind, kind);
    const std::vector<Fragment> sorted = nearest_first(first);
    for (auto f = sorted.rbegin(); f != sorted.rend(); ++f) radiance = f->color + f->transmittance * radiance;
    return radiance;
}

ImageSet a_buffer_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<ABufferParams>();
    const StoredAs kind = stored_by(params.stored_as, input.frame);
    const PlacedBlend blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3) -> BlendedSample {
        return {a_buffer_blend(fragments, behind, params.layers, kind), is_doubtful(fragments, params.layers)};
    };
    return {{"color", blended(background(input), input, blend)}};
}

}  // namespace strata::transparency
