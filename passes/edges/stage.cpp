// The stage edges: what it writes, and when a frame does not need it.
#include "capture_format/frame_features.h"
#include "passes/edges/judge.h"
#include "passes/edges/truth.h"
#include "passes/stages.h"

namespace strata::edges {
namespace {

std::optional<std::string> unwanted(const Features& features) {
    if (features.has(Feature::multisampled)) return info(Stage::culling).unwanted(features);
    return "the frame has one sample per pixel";
}

}  // namespace

StageInfo stage() {
    return {.purpose = "finds pixels whose samples are shaded one by one",
            .unwanted = unwanted,
            .outputs = {"edges"},
            .truth = edges_truth,
            .judge = edges_judge,
            .scenarios = {"one_sphere", "sun_and_boxes", "city_of_boxes", "crossing_planes"}};
}

}  // namespace strata::edges
