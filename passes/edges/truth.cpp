// Which pixels need every sample shaded.
#include "passes/edges/truth.h"

#include <array>
#include <cstring>
#include <string_view>

#include "passes/stage_input.h"

namespace strata {

namespace {

constexpr std::array<std::string_view, 4> surface_images = {"gbuffer0", "gbuffer1", "gbuffer2", "emission"};

// Within one triangle all samples carry what was shaded at the pixel's center: they are equal to the bit. A mean of samples
// is no test: at 8 samples 46.7 % of pixels without an edge differ from theirs (docs/algorithms/deferred.md 3.2).
bool differs(const ReferenceImage& image, std::uint32_t x, std::uint32_t y) {
    // Bits and not numbers: zeros of both signs differ as words, and equal NaN do not.
    for (std::uint32_t sample = 1; sample < image.layers; ++sample) {
        if (std::memcmp(&image.at(x, y, sample), &image.at(x, y, 0), sizeof(glm::dvec4)) != 0) return true;
    }
    return false;
}

bool partly_covered(const ReferenceImage& depth, std::uint32_t x, std::uint32_t y) {
    for (std::uint32_t sample = 1; sample < depth.layers; ++sample) {
        if ((depth.at(x, y, sample).x > 0) != (depth.at(x, y, 0).x > 0)) return true;
    }
    return false;
}

bool is_edge(const StageInput& input, std::uint32_t x, std::uint32_t y) {
    for (const std::string_view name : surface_images) {
        const auto image = input.before.find(name);
        if (image != input.before.end() && differs(image->second, x, y)) return true;
    }
    return partly_covered(input.before.at("depth_layers"), x, y);
}

}  // namespace

ImageSet edges_truth(const StageInput& input) {
    const auto depth = input.before.find("depth_layers");
    if (depth == input.before.end() || depth->second.layers < 2) return {};
    ReferenceImage edges(depth->second.width, depth->second.height, 1, glm::dvec4(0, 0, 0, 1));
    for (std::uint32_t y = 0; y < edges.height; ++y) {
        for (std::uint32_t x = 0; x < edges.width; ++x) edges.at(x, y).x = is_edge(input, x, y) ? 1 : 0;
    }
    return {{"edges", edges}};
}

}  // namespace strata
