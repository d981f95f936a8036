#include "tests/support/session.h"

#include "captures/scenarios.h"

namespace strata {

std::vector<Frame> scenario_frames(std::string_view scenario, std::uint32_t samples, std::uint32_t count) {
    const Scenario& found = *must(find_scenario(scenario));
    const ScenarioOptions options{.width = found.width, .height = found.height, .samples = samples, .frames = count};
    std::vector<Frame> frames;
    for (std::uint32_t i = 0; i < count; ++i) frames.push_back(found.build(i, options));
    return frames;
}

std::unique_ptr<Session> scenario_session(std::string_view scenario, std::uint32_t samples, std::uint32_t count) {
    return must(Session::open(scenario_frames(scenario, samples, count), {.validation = true}));
}

}  // namespace strata
