// Nothing is occluded.
#include "passes/technique.h"

namespace strata::occlusion {

ImageSet none_model(const StageInput& input, const Settings&) {
    const View& view = input.frame.view;
    ReferenceImage ones(view.width, view.height, view.samples, glm::dvec4(1, 0, 0, 1));
    ones.channels = 1;
    return {{"occlusion", ones}};
}

}  // namespace strata::occlusion
