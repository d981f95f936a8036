// Times of the modes of coverage.shared.h against the plain alpha test.
#include "capture_format/frame/frame.h"
#include "passes/gbuffer/coverage/fill_coverage.h"

namespace strata::gbuffer {
namespace {

void with_four_samples(Frame& frame) { frame.view.samples = 4; }
constexpr FrameChange four_samples{"4 samples", with_four_samples};

struct Row {
    std::string_view name, of, source = {};
    std::optional<double> published = {};
};
constexpr Row rows[] = {
    {"masked surfaces at 4 samples: alpha at every sample, against the pixel's center", "masked=per_sample",
     "taps per fragment, docs/algorithms/deferred.md 4.1", 4},
    {"masked surfaces at 4 samples: dithered and hashed bands, against the pixel's center", "masked=unbiased",
     "taps per fragment, docs/algorithms/deferred.md 4.2", 1},
    {"masked surfaces at 4 samples: sharpened alpha, against the pixel's center", "masked=sharpened",
     "taps per fragment, docs/algorithms/deferred.md 4.4", 3},
    {"masked surfaces at 4 samples: alpha scaled by mip, against the pixel's center", "masked=mip_coverage",
     "taps per fragment, docs/algorithms/deferred.md 4.4", 1},
    {"masked surfaces at 4 samples: alpha to coverage in two passes, against the test in one", "masked=hardware",
     "draws of all geometry, docs/algorithms/deferred.md 4.3", 2},
};

}  // namespace

std::vector<TimeRatio> coverage_ratios() {
    std::vector<TimeRatio> ratios;
    for (const Row& row : rows)
        ratios.push_back({.name = row.name,
                          .of = row.of,
                          .against = "masked=clip",
                          .steps = {"/fill", "/coverage/"},
                          .published = row.published,
                          .source = row.source,
                          .scenario = "fence_and_foliage",
                          .of_frame = four_samples,
                          .against_frame = four_samples});
    return ratios;
}

}  // namespace strata::gbuffer
