#include "passes/transparency/multi_layer/model.h"

#include <algorithm>
#include <cmath>

#include "passes/reference/ordering.h"
#include "passes/stage_input.h"
#include "passes/transparency/distortion/model.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/multi_layer/multi_layer_params.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {
namespace {

struct Node {
    double depth = 0;
    glm::dvec3 color{0}, transmittance{1};
};

}  // namespace

glm::dvec3 multi_layer_blend(std::span<const Fragment> fragments, glm::dvec3 behind, std::uint32_t layers) {
    std::vector<Node> nodes;
    for (const Fragment& f : fragments) {
        nodes.insert(std::ranges::lower_bound(nodes, f.depth, {}, &Node::depth),
                     {f.depth, f.color + f.emission, f.transmittance});
        if (nodes.size() <= layers) continue;
        Node& kept = nodes[layers - 1];
        kept.color += kept.transmittance * nodes[layers].color;
        kept.transmittance *= nodes[layers].transmittance;
        nodes.pop_back();
    }
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) behind = node->color + node->transmittance * behind;
    return behind;
}

ImageSet multi_layer_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<MultiLayerParams>();
    const DepthRange range = transparent_depth_range(input.frame);
    const double nearest = double(range.nearest), octaves = std::log(double(range.farthest) / nearest);
    const auto bucket_of = [&](const Fragment& f) {
        return std::clamp(std::floor(std::log(f.depth / nearest) / octaves * params.buckets), 0., params.buckets - 1.);
    };
    const SampleBlend blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind) {
        for (std::uint32_t bucket = params.buckets; bucket-- > 0;) {
            std::vector<Fragment> inside;
            std::ranges::copy_if(fragments, std::back_inserter(inside),
                                 [&](const Fragment& f) { return bucket_of(f) == bucket; });
            behind = multi_layer_blend(inside, behind, params.layers);
        }
        return behind;
    };
    return {{"color", blended(background(input), input, blend)}};
}

}  // namespace strata::transparency
