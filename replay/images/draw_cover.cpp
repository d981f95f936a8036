#include "replay/images/draw_cover.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/reference/fragments.h"
#include "passes/reference/raster.h"

namespace strata {

std::vector<Cover> draw_cover(const Frame& frame, std::uint32_t draw, const ReferenceImage* depth) {
    const std::vector<std::uint32_t> opaque = opaque_draws(frame);
    const bool writes_depth = std::ranges::find(opaque, draw) != opaque.end();
    std::vector<Cover> cover(std::size_t(frame.view.width) * frame.view.height, Cover::none);
    rasterize(frame, std::span(&draw, 1), {}, [&](const RasterPoint& point) {
        const double before = (depth ? depth->at(point.x, point.y, point.sample).x : 0.0) - point.depth;  // reversed depth
        const double tolerance = depth_tolerance(point);
        const bool shown = writes_depth ? std::abs(before) <= tolerance : before <= tolerance;
        Cover& pixel = cover[std::size_t(point.y) * frame.view.width + point.x];
        pixel = std::max(pixel, shown ? Cover::shown : Cover::hidden);
    });
    return cover;
}

}  // namespace strata
