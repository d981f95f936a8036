// Judges visibility where it can be seen.
#include "passes/shadows/judge.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/light_types.h"
#include "passes/reference/difference.h"
#include "passes/reference/light_sets.h"
#include "passes/shadows/receivers.h"
#include "passes/stage_input.h"

namespace strata {

namespace {

// Whether the light would light the receiver if nothing stood between: its visibility shows nowhere else.
bool matters(const Frame& frame, const Light& light, const Receiver& receiver) {
    const Towards to = towards(frame, light, receiver.position);
    if (receiver.normal != glm::dvec3(0) && glm::dot(receiver.normal, to.direction) <= 0) return false;
    if (!has_range(light.type)) return true;
    if (to.distance >= double(light.range)) return false;
    if (facts_of(light.type).cone != LightCone::round) return true;
    const glm::dvec3 axis = frame.view.to_view * glm::normalize(glm::dvec3(light.direction));
    return glm::dot(-to.direction, axis) > std::cos(double(light.outer_angle));
}

struct Sums {
    double squares = 0, samples = 0, wrongly_lit = 0, wrongly_shadowed = 0;

    void add(double got, double wanted) {
        const double error = signed_error(got, wanted);
        samples += 1;
        squares += error * error;
        wrongly_lit += wanted < 0.5 && !(got < 0.5);  // NaN counts as wrong, too
        wrongly_shadowed += wanted >= 0.5 && !(got >= 0.5);
    }
    void add(const Sums& other) {
        samples += other.samples;
        squares += other.squares;
        wrongly_lit += other.wrongly_lit;
        wrongly_shadowed += other.wrongly_shadowed;
    }
};

}  // namespace

std::vector<Metric> shadows_judge(const ImageSet& result, const ImageSet& truth, const StageInput& input) {
    const auto got = result.find("visibility"), wanted = truth.find("visibility");
    Sums sums;
    if (got != result.end() && wanted != truth.end()) {
        const std::vector<std::uint32_t> shadowed = mapped_lights(input.frame);
        const std::vector<Light> lights = shining_lights(input.frame);
        const std::uint32_t samples = input.before.at("depth_layers").layers;
        std::vector<Sums> rows(input.before.at("depth_layers").height);  // one each: rows run in parallel
        for_each_receiver(input, [&](const Receiver& receiver) {
            for (std::uint32_t k = 0; k < shadowed.size(); ++k) {
                if (!matters(input.frame, lights[shadowed[k]], receiver)) continue;
                const std::uint32_t layer = k * samples + receiver.sample;
                rows[receiver.y].add(got->second.at(receiver.x, receiver.y, layer).x,
                                     wanted->second.at(receiver.x, receiver.y, layer).x);
            }
        });
        for (const Sums& row : rows) sums.add(row);
    }
    const double per_sample = 1 / std::max(sums.samples, 1.0);
    return {{"rmse", "visibility", std::sqrt(sums.squares * per_sample)},
            {"wrongly lit", "%", 100 * sums.wrongly_lit * per_sample},
            {"wrongly shadowed", "%", 100 * sums.wrongly_shadowed * per_sample}};
}

}  // namespace strata
