#include "replay/gpu/sample_layers.h"

#include <cassert>

#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "replay/gpu/step_recorder.h"

namespace strata {
namespace {

constexpr ImportId multisampled_id{};

Plan plan_for(const Shape& shape) {
    Graph graph;
    const Image multisampled = graph.import("multisampled", shape, multisampled_id);
    graph.keep(spread(graph, multisampled, "samples"));
    auto plan = compile(graph, ShaderLibrary::built_in());
    assert(plan);
    return *std::move(plan);
}

}  // namespace

SampleLayers::SampleLayers(OpenedDevice& device, DeviceImage& multisampled, const Samplers& samplers, Placeholders& placeholders)
    : plan_(plan_for(multisampled.shape())),
      imports_(device),
      memory_(device, plan_),
      sets_(device, plan_, samplers, placeholders),
      resources_(plan_, memory_, imports_) {
    imports_.lend(multisampled_id, multisampled);
}

DeviceImage& SampleLayers::record(const vk::raii::CommandBuffer& commands, PipelineStore& pipelines) {
    StepRecorder recorder(commands, plan_, resources_, pipelines, sets_);
    full_barrier(commands);  // this plan does not know who wrote the image
    for (const PlannedStep& planned : plan_.steps) {
        recorder.barriers(planned.barriers);
        recorder.work(planned);
    }
    recorder.barriers(plan_.final_barriers);
    return resources_.image(plan_.kept_images.front());
}

}  // namespace strata
