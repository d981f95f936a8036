#include "passes/indirect/truth.h"

#include <numbers>
#include <span>
#include <vector>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/indirect/direct_light.h"
#include "passes/indirect/leg_blockers.h"
#include "passes/reference/estimated_image.h"
#include "passes/reference/surfaces.h"
#include "passes/reference/triangles.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

using indirect::DirectLight, indirect::LegBlockers, indirect::LitSide;

constexpr double endless = 1e9;  // meters

/// Gathers for one sample after the other.
class Gathering {
public:
    Gathering(const Frame& frame, const GatheredDirections& directions)
        : frame_(frame), directions_(directions), scene_(frame, RayMask::opaque), direct_(frame), blockers_(frame) {
        for (std::uint32_t i = 0; i < frame.draws.size(); ++i) spaces_.push_back(draw_space(frame, i));
    }

    /// The mean over a batch of paths from a surface that a G-buffer gave: irradiance / pi.
    glm::dvec3 batch(const LitSide& given, DrawnNumbers random) const {
        const Departure sample = seen_surface(scene_, given.position, given.normal);
        std::vector<Leg> legs(directions_.bounces);
        for (Leg& leg : legs) {
            leg.directions = &leg == &legs.front() ? stratified(directions_.side, random) : shuffled(directions_.side, random);
            for (std::size_t i = 0; i < direct_.lights(); ++i) leg.places.push_back(shuffled(directions_.side, random));
        }
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < legs.front().directions.size(); ++i) sum += radiance(sample, legs, i);
        return sum / double(legs.front().directions.size());
    }

private:
    /// Of all paths from one surface to the next, in places of the unit square.
    struct Leg {
        std::vector<glm::dvec2> directions;
        std::vector<std::vector<glm::dvec2>> places;  ///< on each light, as the next surface sees it
    };

    /// What comes along a path, which has these legs yet to go.
    glm::dvec3 radiance(const Departure& sample, std::span<const Leg> legs, std::size_t path) const {
        const glm::dvec3 direction = cosine_direction(sample.normal, legs.front().directions[path]);
        const std::optional<Hit> hit = sample.closest(scene_, direction, endless);
        if (!hit) return glm::dvec3(0);
        const Attributes attributes = attributes_at(frame_, hit->draw, hit->triangle, hit->barycentric);
        const glm::dvec3 albedo = diffuse_albedo(frame_, hit->draw, attributes);
        if (albedo == glm::dvec3(0)) return glm::dvec3(0);
        const LitSide reflecting{sample.position + direction * hit->distance, facing_normal(*hit, attributes, direction)};
        glm::dvec3 irradiance(0);
        for (std::size_t i = 0; i < direct_.lights(); ++i)
            irradiance += direct_.irradiance(i, reflecting, legs.front().places[i][path]);
        if (legs.size() > 1)
            irradiance += std::numbers::pi * radiance({reflecting.position, reflecting.normal, hit->draw}, legs.subspan(1), path);
        if (irradiance == glm::dvec3(0)) return glm::dvec3(0);
        if (!blockers_.let_through(off_surface(reflecting.position, reflecting.normal),
                                   off_surface(sample.position, sample.normal)))
            return glm::dvec3(0);
        return albedo * irradiance / std::numbers::pi;
    }

    /// The vertex normal, or the triangle's where there is none, on the side that was hit.
    glm::dvec3 facing_normal(const Hit& hit, const Attributes& attributes, const glm::dvec3& direction) const {
        const DrawSpace& space = spaces_[hit.draw];
        const glm::dvec3 smooth = space.normals * attributes.normal;
        const Corners corners = view_corners(frame_, space, hit.draw, hit.triangle);
        const glm::dvec3 flat = space.handedness * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const glm::dvec3 outward = glm::dot(smooth, smooth) > 0 ? smooth : flat;
        return glm::normalize(glm::dot(flat, direction) > 0 ? -outward : outward);
    }

    const Frame& frame_;
    const GatheredDirections directions_;
    RayScene scene_;
    DirectLight direct_;
    LegBlockers blockers_;
    std::vector<DrawSpace> spaces_;
};

}  // namespace

ReferenceImage gathered_light(const StageInput& input, const GatheredDirections& directions) {
    const Gathering gathering(input.frame, directions);
    const GivenSurfaces given{input.before.at("surface_normal"), input.before.at("surface_material")};
    return estimated_image(input.frame, given, directions.batches, glm::dvec4(0),
                           [&](const SurfacePoint& at, DrawnNumbers random) {
                               return gathering.batch({at.position, facing_normal(at)}, random);
                           });
}

ImageSet indirect_truth(const StageInput& input) { return {{"indirect", gathered_light(input)}}; }

ImageSet two_bounce_truth(const StageInput& input) {
    GatheredDirections directions = truth_directions;
    directions.bounces = 2;
    return {{"indirect", gathered_light(input, directions)}};
}

}  // namespace strata
