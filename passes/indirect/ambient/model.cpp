// No bounced light anywhere.
#include "passes/technique.h"

namespace strata::indirect {

ImageSet ambient_model(const StageInput& input, const Settings&) {
    const View& view = input.frame.view;
    return {{"indirect", ReferenceImage(view.width, view.height, view.samples)}};
}

}  // namespace strata::indirect
