
#include "capture_format/frame/frame.h"
#include "passes/settings.h"
#include "passes/stage_input.h"
// Nothing is occluded.

namespace strata::occlusion {

ImageSet none_model(const StageInput& input, const Settings&) {
    const View& view = input.frame.view;
    ReferenceImage ones(view.width, view.height, view.samples, glm::dvec4(1, 0, 0, 1));
    ones.channels = 1;
    return {{"occlusion", ones}};
}

}  // namespace strata::occlusion
