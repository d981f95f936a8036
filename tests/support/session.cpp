#include "tests/support/session.h"

#include "capture_format/frame/frame.h"
#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "replay/session/choice_text.h"
#include "replay/session/session_on_device.h"
#include "tests/support/device.h"

namespace strata {
namespace {

// Truths and models in double take a minute for the largest scenario at its natural extent and four samples.
constexpr std::uint32_t largest_width = 160;

}  // namespace

std::vector<Frame> scenario_frames(std::string_view scenario, std::uint32_t samples, std::uint32_t count) {
    const Scenario& found = *must(find_scenario(scenario));
    const ScenarioOptions options{.width = found.width, .height = found.height, .samples = samples, .frames = count};
    std::vector<Frame> frames;
    for (std::uint32_t i = 0; i < count; ++i) frames.push_back(found.build(i, options));
    return frames;
}

std::unique_ptr<Session> scenario_session(std::string_view scenario, std::uint32_t samples, std::uint32_t count) {
    return session_of(scenario_frames(scenario, samples, count));
}

std::unique_ptr<Session> session_of(std::vector<Frame> frames) { return open_session_on(shared_device(), std::move(frames)); }

Session& session_of_scenarios() {
    static const std::unique_ptr<Session> session = [] {
        std::vector<Frame> frames;
        for (const Scenario& scenario : scenarios()) frames.push_back(scenario_frames(scenario.name).front());
        return session_of(std::move(frames));
    }();
    return *session;
}

Request on_scenario(std::string_view name, std::uint32_t samples) {
    const Scenario* scenario = must(find_scenario(name));
    const auto index = static_cast<std::size_t>(scenario - scenarios().data());
    const std::uint32_t divisor = (scenario->width + largest_width - 1) / largest_width;
    return {.variant = {.frame = index, .extent_divisor = divisor, .samples = samples}};
}

ChoiceChanges chosen(const std::vector<std::string>& uses, const std::vector<std::string>& sets) {
    return must(parse_choices(uses, sets));
}

void set(Request& request, const std::string& text) { request.choices.settings.push_back(chosen({}, {text}).settings.front()); }

std::uint64_t counted(const Run& run, std::string_view name) {
    for (const CounterRecord& counter : run.counters)
        if (counter.technique.starts_with("transparency/") && counter.name == name) return counter.value;
    throw std::runtime_error(fmt::format("no counter {}", name));
}

std::string display_hash(Session& session) { return hash_of(must(session.run({})).images.at("display")); }

}  // namespace strata
