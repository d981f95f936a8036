#include "tests/support/similar_frame.h"

#include "capture_format/frame/draw.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/particles.h"
#include "capture_format/light_types.h"

namespace strata {
namespace {

/// Moves parts of a frame; a function is named after the kind of part.
class Mover {
public:
    explicit Mover(const Similarity& by) : by_(by), linear_(by.scale * by.turn) {}

    bool is_mirror() const { return glm::determinant(by_.turn) < 0; }

    void point(glm::dvec3& p) const { p = linear_ * (p - by_.around) + by_.around + by_.shift; }
    void direction(glm::vec3& d) const { d = glm::vec3(by_.turn * glm::dvec3(d)); }
    void length(float& l) const { l *= float(by_.scale); }

    void place(glm::dmat4& to_world) const {
        glm::dvec3 at(to_world[3]);
        point(at);
        to_world = glm::dmat4(linear_) * to_world;
        to_world[3] = glm::dvec4(at, 1);
    }

    void plane(ClipPlane& plane) const {
        glm::dvec3 on = -plane.distance / glm::dot(plane.normal, plane.normal) * plane.normal;
        point(on);
        plane.normal = by_.turn * plane.normal;
        plane.distance = -glm::dot(plane.normal, on);
    }

    void view(View& view) const {
        point(view.origin);
        view.to_view = view.to_view * glm::transpose(by_.turn);
        if (is_mirror()) {
            view.to_view = mirror_x * view.to_view;
            view.jitter.x = -view.jitter.x;
            view.projection[2][0] = -view.projection[2][0];
        }
        length(view.near);
        view.projection[3][2] = view.near;
    }

    void light(Light& light) const {
        point(light.position);
        direction(light.direction), direction(light.axis_u);
        length(light.range), length(light.source_radius), length(light.shadow.bias);
        length(light.half_extent.x), length(light.half_extent.y);
        if (!is_area(light.type) && light.type != LightType::directional) light.intensity *= float(by_.scale * by_.scale);
        for (ClipPlane& each : light.clip_planes) plane(each);
    }

    /// A blocker or a portal.
    void rectangle(auto& rectangle) const {
        point(rectangle.center);
        direction(rectangle.u), direction(rectangle.v);
        length(rectangle.half_u), length(rectangle.half_v);
    }

    void blocker(Blocker& blocker) const {
        rectangle(blocker);
        if (is_mirror()) blocker.v = -blocker.v;  // cross(u, v) turns around in a mirror image
    }

    void volume(LightVolume& volume) const {
        point(volume.center);
        volume.half_extent = glm::vec3(glm::abs(linear_ * glm::dvec3(volume.half_extent)));
        volume.cells = glm::uvec3(glm::abs(by_.turn * glm::dvec3(volume.cells)) + .5);
    }

    void emitter(Emitter& emitter) const {
        length(emitter.soft_depth_fade);
        for (Particle& particle : emitter.particles) {
            point(particle.center);
            length(particle.size), length(particle.depth_offset);
            if (is_mirror()) {
                particle.rotation = -particle.rotation;
                particle.uv_frame.x += particle.uv_frame.z;
                particle.uv_frame.z = -particle.uv_frame.z;
            }
        }
    }

private:
    const Similarity& by_;
    glm::dmat3 linear_;
};

}  // namespace

Frame similar(Frame frame, const Similarity& by) {
    const Mover move(by);
    move.view(frame.view);
    for (Draw& draw : frame.draws) move.place(draw.to_world), move.place(draw.previous_to_world);
    for (Emitter& emitter : frame.emitters) move.emitter(emitter);
    for (Light& light : frame.lights) move.light(light);
    for (Blocker& blocker : frame.blockers) move.blocker(blocker);
    for (Portal& portal : frame.portals) move.rectangle(portal);
    for (LightVolume& volume : frame.light_volumes) move.volume(volume);
    move.direction(frame.sun.direction);
    move.length(frame.sun.shadow_distance), move.length(frame.sun.shadow.bias);
    move.direction(frame.rain.direction);
    frame.fog.density /= float(by.scale);
    move.length(frame.lens.focus_distance), move.length(frame.lens.aperture);
    return frame;
}

}  // namespace strata
