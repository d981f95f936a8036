// What the words of the G-buffer say, in double: images are read back without loss, so equal bits are equal numbers of one sign.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

#include "passes/edges/surface_tests_model.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::edges {
namespace {

/// A texel's bits: zeros of different signs are different words, and equal NaN are one.
std::array<std::uint64_t, 4> bits_of(const glm::dvec4& texel) { return std::bit_cast<std::array<std::uint64_t, 4>>(texel); }

bool is_one_surface(const ReferenceImage& image, std::uint32_t x, std::uint32_t y) {
    for (std::uint32_t sample = 1; sample < image.layers; ++sample)
        if (bits_of(image.at(x, y, sample)) != bits_of(image.at(x, y, 0))) return false;
    return true;
}

}  // namespace

ImageSet bitwise_model(const StageInput& input, const Settings&) {
    std::vector<const ReferenceImage*> words;
    for (const std::string_view name : {"gbuffer0", "gbuffer1", "gbuffer2", "emission"})
        if (const auto image = input.before.find(name); image != input.before.end()) words.push_back(&image->second);
    return marked(input, [&](std::uint32_t x, std::uint32_t y) {
        const std::uint32_t covered = covered_samples(input, x, y);
        if (covered != 0 && covered != input.before.at("depth_layers").layers) return Verdict::edge;
        return verdict_of(!std::ranges::all_of(words, [&](const ReferenceImage* image) { return is_one_surface(*image, x, y); }));
    });
}

}  // namespace strata::edges
