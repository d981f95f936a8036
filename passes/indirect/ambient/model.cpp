
#include "capture_format/frame/frame.h"
#include "passes/settings.h"
#include "passes/stage_input.h"
// No bounced light anywhere.

namespace strata::indirect {

ImageSet ambient_model(const StageInput& input, const Settings&) {
    const View& view = input.frame.view;
    return {{"indirect", ReferenceImage(view.width, view.height, view.samples)}};
}

}  // namespace strata::indirect
