#include "replay/session/drawn_by.h"

#include <fmt/format.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "passes/reference/fragments.h"
#include "passes/reference/triangles.h"

namespace strata {

std::string drawn_by(const Frame& frame, std::uint32_t submission) {
    std::uint32_t end = 0;
    for (const std::uint32_t draw : transparent_draws(frame)) {
        end += triangle_count(frame, draw);
        if (submission >= end) continue;
        if (draw < frame.draws.size()) return fmt::format("draw {} '{:.60}'", draw, frame.draws[draw].name);
        const std::size_t emitter = draw - frame.draws.size();
        return fmt::format("emitter {} '{:.60}'", emitter, frame.emitters[emitter].name);
    }
    return "no draw";
}

}  // namespace strata
