#include "replay/report/flicker.h"

#include <algorithm>
#include <cmath>

#include "passes/registry.h"
#include "passes/scene/draw_lists.h"
#include "passes/scene/view_space.h"

namespace strata {
namespace {

// Of the distance: at 4 m and 64 frames 3 mm a frame, a slow walk; far enough for objects at nearly one depth to change places.
constexpr double dolly_share = .05;

/// The nearest and the farthest view depth of the listed draws' points before the near plane.
std::optional<glm::dvec2> depth_range(const Frame& frame, std::span<const std::uint32_t> listed) {
    glm::dvec2 range(HUGE_VAL, -HUGE_VAL);
    const auto add = [&](const glm::dvec3& world) {
        const double depth = in_view_space(frame.view, world).z;
        if (depth > double(frame.view.near)) range = {std::min(range.x, depth), std::max(range.y, depth)};
    };
    for (const std::uint32_t index : listed) {
        if (index >= frame.draws.size()) {
            for (const Particle& particle : frame.emitters[index - frame.draws.size()].particles) add(particle.center);
            continue;
        }
        const Draw& draw = frame.draws[index];
        for (const glm::vec3& point : frame.meshes[draw.mesh].positions) add(glm::dvec3(draw.to_world * glm::dvec4(point, 1)));
    }
    return range.x <= range.y ? std::optional(range) : std::nullopt;
}

/// The first technique that stands in for the stage's truth and can do the frame; nothing where none does.
Result<std::optional<Request>> stand_in(Session& session, Stage stage, Request base) {
    const auto planned = session.plan(base);
    if (!planned) return planned.error();
    for (const Technique* technique : techniques_of(stage)) {
        if (!technique->abilities.stands_in_for_truth || unsupported(*technique, planned->features)) continue;
        base.choices.use(*technique);
        return std::optional(std::move(base));
    }
    return std::optional<Request>();
}

Result<ReferenceImage> picture(Session& session, Request request, Stage stage) {
    const std::string output(info(stage).outputs.front());
    request.outputs = {output};
    return session.run(request).and_then([&](auto& run) { return in_double(run.images.at(output)); });
}

Result<ReferenceImage> truth_in_double(Session& session, const Request& request, Stage stage) {
    return session.truth(request, stage).and_then([&](auto& truth) {
        return std::move(truth.at(std::string(info(stage).outputs.front())));
    });
}

}  // namespace

void Flicker::add_frame(const ReferenceImage& got, const ReferenceImage& truth) {
    std::vector<glm::dvec3> error;
    for (std::size_t i = 0; i < truth.texels.size(); ++i) error.emplace_back(got.texels[i] - truth.texels[i]);
    if (!error_.empty()) {
        ++steps_;
        for (std::size_t i = 0; i < error.size(); ++i) {
            const glm::dvec3 change = glm::abs(error[i] - error_[i]);
            sum_ += (change.x + change.y + change.z) / 3;
        }
    }
    error_ = std::move(error);
}

double Flicker::mean() const { return steps_ == 0 ? 0 : sum_ / double(steps_) / double(error_.size()); }

std::optional<double> default_dolly(const Frame& frame) {
    const DrawLists lists = draw_lists(frame);
    for (const auto& listed : {lists.transparent, lists.opaque})
        if (const auto range = depth_range(frame, listed)) return dolly_share * (range->x + range->y) / 2;
    return {};
}

Result<std::vector<double>> measure_flicker(Session& session, const ReportRequest& wanted, std::span<const Request> rows,
                                            const Progress& tell) {
    const auto exact = stand_in(session, wanted.stage, wanted.base);
    if (!exact) return exact.error();
    const Walk& walk = *wanted.flicker;
    std::vector<Flicker> flickers(rows.size());
    for (std::uint32_t i = 0; i < walk.frames; ++i) {
        if (tell) tell(fmt::format("flicker, frame {} of {}", i + 1, walk.frames), double(i) / walk.frames);
        const auto placed = [&](Request request) {
            const double way = double(i) / std::max(1u, walk.frames - 1);
            request.variant.eye = {.dolly = *walk.dolly * way, .pan = glm::radians(walk.pan) * way};
            return request;
        };
        const auto truth = *exact ? picture(session, placed(**exact), wanted.stage)
                                  : truth_in_double(session, placed(wanted.base), wanted.stage);
        if (!truth) return truth.error();
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const auto got = picture(session, placed(rows[r]), wanted.stage);
            if (!got) return got.error();
            flickers[r].add_frame(*got, *truth);
        }
    }
    std::vector<double> means;
    for (const Flicker& flicker : flickers) means.push_back(flicker.mean());
    return means;
}

}  // namespace strata
