// Judges an edge mask.
#include "passes/edges/judge.h"

#include <cstddef>

#include "passes/reference/difference.h"
#include "passes/stage_input.h"

namespace strata {

std::vector<Metric> edges_judge(const ImageSet& result, const ImageSet& truth, const StageInput&) {
    const auto got = result.find("edges"), wanted = truth.find("edges");
    double missed = 0, needless = 0, flagged = 0, pixels = 0;
    if (got != result.end() && wanted != truth.end()) {
        for (std::size_t i = 0; i < wanted->second.texels.size(); ++i) {
            if (!decided(got->second, wanted->second, i)) continue;
            ++pixels;
            const bool is_edge = wanted->second.texels[i].x != 0, is_flagged = got->second.texels[i].x != 0;
            missed += is_edge && !is_flagged;
            needless += is_flagged && !is_edge;
            flagged += is_flagged;
        }
    }
    const double percent = pixels > 0 ? 100 / pixels : 0;
    return {{"missed", "% of pixels", missed * percent},
            {"needless", "% of pixels", needless * percent},
            {"shaded per sample", "% of pixels", flagged * percent}};
}

}  // namespace strata
