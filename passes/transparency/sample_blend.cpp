#include "passes/transparency/sample_blend.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "passes/indirect/volume_light.h"
#include "passes/luminance.h"
#include "passes/reference/ordering.h"
#include "passes/stage_input.h"

namespace strata::transparency {
namespace {

/// Rows that a thread blends one after the other: neighbors share what a model keeps of a row.
constexpr std::uint32_t rows_in_turn = 8;

/// Particles far to near. What else the frame has stays: light is measured by all of it.
void sort_particles(Frame& frame, const Frame& whole, std::uint32_t object) {
    if (object < whole.draws.size()) return;
    const std::size_t place = object - whole.draws.size();
    const Emitter& emitter = whole.emitters[place];
    std::vector<Particle>& sorted = frame.emitters[place].particles;
    sorted.clear();
    for (const std::uint32_t particle : painters_order(whole, emitter)) sorted.push_back(emitter.particles[particle]);
}

}  // namespace

ReferenceImage opaque_depth(const ImageSet& before, const ReferenceImage& color) {
    const auto found = before.find("depth_layers");
    return found != before.end() ? found->second : ReferenceImage(color.width, color.height, color.layers);
}

FragmentLists fragments_before(const Frame& frame, const ReferenceImage& depth, const ImageSet& before) {
    return transparent_fragments(frame, depth, {}, indirect::volume_light(frame, before));
}

const FragmentLists& fragments_of(const StageInput& input, const ReferenceImage& color, std::optional<FragmentLists>& own) {
    std::optional<FragmentLists>& kept = input.fragments ? *input.fragments : own;
    if (!kept) kept = fragments_before(input.frame, opaque_depth(input.before, color), input.before);
    return *kept;
}

ReferenceImage blended(ReferenceImage color, const StageInput& input, const SampleBlend& blend) {
    return blended(std::move(color), input, [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3) {
        return BlendedSample{blend(fragments, behind)};
    });
}

ReferenceImage blended(ReferenceImage color, const StageInput& input, const PlacedBlend& blend) {
    std::optional<FragmentLists> own;
    const FragmentLists& lists = fragments_of(input, color, own);
    std::vector<std::uint8_t> undecided(color.texels.size());  // threads write to bytes of their own, not to bits
    const auto blend_row = [&](std::uint32_t y) {
        for (std::uint32_t s = 0; s < color.layers; ++s) {
            for (std::uint32_t x = 0; x < color.width; ++x) {
                glm::dvec4& texel = color.at(x, y, s);
                const BlendedSample result = blend(lists.at(x, y, s), glm::dvec3(texel), {x, y, s});
                texel = glm::dvec4(result.radiance, texel.w);
                undecided[color.index(x, y, s)] = lists.undecided(x, y, s) || result.undecided;
            }
        }
    };
    tbb::parallel_for(
        tbb::blocked_range<std::uint32_t>(0, color.height, rows_in_turn),
        [&](const auto& rows) {
            for (std::uint32_t y = rows.begin(); y != rows.end(); ++y) blend_row(y);
        },
        tbb::simple_partitioner());
    color.undecided.resize(color.texels.size());
    for (std::size_t i = 0; i < undecided.size(); ++i)
        if (undecided[i] != 0) color.undecided[i] = true;
    return color;
}

ReferenceImage blended_by_object(ReferenceImage color, const StageInput& input, const SampleBlend& blend) {
    Frame sorted = input.frame;
    const ReferenceImage depth = opaque_depth(input.before, color);
    const LightAround around = indirect::volume_light(input.frame, input.before);
    for (const std::uint32_t object : painters_order(input.frame)) {
        sort_particles(sorted, input.frame, object);
        std::optional<FragmentLists> lists = transparent_fragments(sorted, depth, {}, around, {&object, 1});
        color = blended(std::move(color), {sorted, input.before, &lists}, blend);
    }
    return color;
}

double luminance(glm::dvec3 color) { return strata::luminance(color); }

double coverage(const Fragment& f) { return 1 - (f.transmittance.x + f.transmittance.y + f.transmittance.z) / 3; }

glm::dvec3 transmittance_before(std::span<const Fragment> fragments, double depth) {
    glm::dvec3 through(1);
    for (const Fragment& fragment : fragments)
        if (fragment.depth < depth) through *= fragment.transmittance;
    return through;
}

std::vector<std::size_t> nearest_first_order(std::span<const Fragment> fragments) {
    // Pairs are sorted faster than what they stand for, and no two are equal.
    std::vector<std::pair<double, std::size_t>> keys;
    keys.reserve(fragments.size());
    for (std::size_t i = 0; i < fragments.size(); ++i) keys.emplace_back(fragments[i].depth, fragments.size() - 1 - i);
    std::ranges::sort(keys);
    std::vector<std::size_t> order;
    order.reserve(keys.size());
    for (const auto& [depth, from_last] : keys) order.push_back(fragments.size() - 1 - from_last);
    return order;
}

std::vector<Fragment> nearest_first(std::span<const Fragment> in_submission_order) {
    std::vector<Fragment> sorted;
    sorted.reserve(in_submission_order.size());
    for (const std::size_t i : nearest_first_order(in_submission_order)) sorted.push_back(in_submission_order[i]);
    return sorted;
}

}  // namespace strata::transparency
