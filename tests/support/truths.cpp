#include "tests/support/truths.h"

#include <map>
#include <tuple>

#include "capture_format/frame/frame.h"
#include "passes/stages.h"

namespace strata {

const ImageSet& truth_of(Stage stage, const Request& request) {
    static std::map<std::tuple<Stage, std::size_t, std::uint32_t>, ImageSet> known;
    const auto key = std::tuple(stage, request.variant.frame, request.variant.samples);
    if (const auto found = known.find(key); found != known.end()) return found->second;
    return known.emplace(key, must(session_of_scenarios().truth(request, stage))).first->second;
}

std::optional<std::string> unneeded(const Request& request, Stage stage) {
    Frame frame = must(session_of_scenarios().frame(request.variant.frame));
    if (request.variant.samples != 0) frame.view.samples = request.variant.samples;
    return info(stage).unwanted(frame_features(frame));
}

}  // namespace strata
