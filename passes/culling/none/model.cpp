// Every draw is visible; so are the texels after the last one, which stand for no draw.
#include "passes/culling/visible_image.h"
#include "passes/reference/fragments.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::culling {

ImageSet none_model(const StageInput& input, const Settings&) {
    const std::uint32_t rows = visible_rows(opaque_draws(input.frame).size());
    ReferenceImage visible(visible_width, rows, 1, glm::dvec4(1, 0, 0, 1));
    visible.channels = 1;
    return {{"visible", visible}};
}

}  // namespace strata::culling
