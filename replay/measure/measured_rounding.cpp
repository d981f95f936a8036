#include "replay/measure/measured_rounding.h"

#include <cassert>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "replay/gpu/executor.h"

namespace strata {
namespace {

Image one(Graph& graph, const char* name, Format format) {
    Image image = graph.create(name, {.extent = {1, 1}, .format = format});
    graph.clear(image, {{1, 1, 1, 1}});
    return image;
}

/// Of 1 and three quarters of a step.
Rounding direction(const HostImage& sum) { return texel(sum, 0, 0).x > 1 ? Rounding::to_nearest : Rounding::towards_zero; }

}  // namespace

BlendRounding measured_rounding(Device& device) {
    Graph graph;
    Image half = one(graph, "half", Format::rgba16f), packed = one(graph, "packed", Format::r11g11b10f);
    graph.fullscreen("shaders/rounding_probe").adds_to(half).adds_to(packed);
    graph.keep(half);
    graph.keep(packed);
    const auto plan = compile(graph, ShaderLibrary::built_in());
    assert(plan);
    // An executor of its own: what a session counts of its pipelines and plans stays as it is.
    const Execution run = Executor::create(device)->run(*plan, {});
    return {.half = direction(run.images.at(half.id)), .packed = direction(run.images.at(packed.id))};
}

}  // namespace strata
