#include "tests/support/one_pixel.h"

#include "capture_format/frame/frame.h"

namespace strata {

Frame one_pixel(std::uint32_t samples) {
    Frame frame;
    frame.view.width = frame.view.height = 1;
    frame.view.samples = samples;
    frame.view.projection = perspective(1, 1, 0.1);
    return frame;
}

}  // namespace strata
