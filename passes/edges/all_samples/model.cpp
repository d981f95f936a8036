
#include "capture_format/frame/frame.h"
#include "passes/settings.h"
#include "passes/stage_input.h"
// Every pixel is an edge where there is more than one sample.

namespace strata::edges {

ImageSet all_samples_model(const StageInput& input, const Settings&) {
    const View& view = input.frame.view;
    if (view.samples == 1) return {};
    ReferenceImage edges(view.width, view.height, 1, glm::dvec4(1, 0, 0, 1));
    edges.channels = 1;
    return {{"edges", edges}};
}

}  // namespace strata::edges
