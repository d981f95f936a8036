#include "passes/gbuffer/truth.h"

#include "passes/gbuffer/coverage/truth.h"
#include "passes/gbuffer/nearest.h"
#include "passes/stage_input.h"

namespace strata {

ImageSet gbuffer_truth(const StageInput& input) {
    ImageSet images = gbuffer::surface_images(input.frame, gbuffer::nearest_surfaces(input.frame, ShadeAt::sample));
    gbuffer::add_true_coverage(images, input.frame);
    return images;
}

}  // namespace strata
