#include "replay/report/flicker.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/scene/draw_lists.h"
#include "passes/scene/view_space.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/report/row_truth.h"
#include "replay/session/stand_in.h"

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

/// The rows' truths, each once: the request that asks for it, and per row which one it is.
struct Truths {
    std::vector<Request> asked;
    std::vector<std::size_t> of_row;
};

Result<Truths> truths_of(const ReportRequest& wanted, std::span<const Request> rows, const Frame& frame) {
    Truths found;
    std::vector<std::string_view> names;
    for (const Request& row : rows) {
        const auto truth = truth_asked_by(row, wanted.stage, frame);
        if (!truth) return truth.error();
        const auto known = std::ranges::find(names, truth->name);
        found.of_row.push_back(std::size_t(known - names.begin()));
        if (known != names.end()) continue;
        names.push_back(truth->name);
        found.asked.push_back(row);
    }
    return found;
}

/// One row of a report while the eye walks.
class RowFlicker {
public:
    void add_frame(const ReportRequest& wanted, const ImageSet& got, const ImageSet& truth, const Frame& frame) {
        const std::string_view judged = info(wanted.stage).outputs.front();
        error_.add_frame(got.find(judged)->second, truth.find(judged)->second);
        if (wanted.stage != Stage::gbuffer) return;
        const std::vector<gbuffer::PixelCoverage> coverage = gbuffer::pixel_coverage(got, truth, frame);
        has_coverage_ = !coverage.empty();
        coverage_.add_frame(coverage);
    }
    MeasuredFlicker measured() const {
        return {.error = error_.mean(), .coverage = has_coverage_ ? std::optional(coverage_.mean()) : std::nullopt};
    }

private:
    Flicker error_;
    CoverageFlicker coverage_;
    bool has_coverage_ = false;
};

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

void CoverageFlicker::add_frame(std::span<const gbuffer::PixelCoverage> pixels) {
    for (std::size_t i = 0; i < before_.size(); ++i) {
        const gbuffer::PixelCoverage &now = pixels[i], &before = before_[i];
        if (std::max({now.got, now.wanted, before.got, before.wanted}) == 0) continue;
        sum_ += std::abs((now.got - now.wanted) - (before.got - before.wanted));
        ++pixels_;
    }
    before_.assign(pixels.begin(), pixels.end());
}

double CoverageFlicker::mean() const { return sum_ / double(std::max<std::size_t>(1, pixels_)); }

std::optional<double> default_dolly(const Frame& frame) {
    const DrawLists lists = draw_lists(frame);
    for (const auto& listed : {lists.transparent, lists.opaque})
        if (const auto range = depth_range(frame, listed)) return dolly_share * (range->x + range->y) / 2;
    return {};
}

Result<std::vector<MeasuredFlicker>> measure_flicker(Session& session, const ReportRequest& wanted, std::span<const Request> rows,
                                                     const Progress& tell) {
    const auto exact = stand_in(session, wanted.stage, wanted.base);
    if (!exact) return exact.error();
    const auto frame = session.frame(wanted.base.variant.frame);
    if (!frame) return frame.error();
    auto truths = truths_of(wanted, rows, *frame);
    if (!truths) return truths.error();
    if (*exact) truths->asked = {**exact};
    const Walk& walk = *wanted.flicker;
    std::vector<RowFlicker> flickers(rows.size());
    for (std::uint32_t i = 0; i < walk.frames; ++i) {
        if (tell) tell(fmt::format("flicker, frame {} of {}", i + 1, walk.frames), double(i) / walk.frames);
        const auto placed = [&](Request request) {
            const double way = double(i) / std::max(1u, walk.frames - 1);
            request.variant.eye = {.dolly = *walk.dolly * way, .pan = glm::radians(walk.pan) * way};
            return request;
        };
        std::vector<ImageSet> wanted_images;
        for (const Request& asks : truths->asked) {
            auto truth = *exact ? session.stage_images(placed(asks), wanted.stage) : session.truth(placed(asks), wanted.stage);
            if (!truth) return truth.error();
            wanted_images.push_back(*std::move(truth));
        }
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const auto got = session.stage_images(placed(rows[r]), wanted.stage);
            if (!got) return got.error();
            flickers[r].add_frame(wanted, *got, wanted_images[*exact ? 0 : truths->of_row[r]], *frame);
        }
    }
    std::vector<MeasuredFlicker> measured;
    for (const RowFlicker& flicker : flickers) measured.push_back(flicker.measured());
    return measured;
}

}  // namespace strata
