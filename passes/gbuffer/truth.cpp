#include "passes/gbuffer/truth.h"

#include "passes/gbuffer/nearest.h"

namespace strata {

ImageSet gbuffer_truth(const StageInput& input) {
    return gbuffer::surface_images(input.frame, gbuffer::nearest_surfaces(input.frame, ShadeAt::sample));
}

}  // namespace strata
