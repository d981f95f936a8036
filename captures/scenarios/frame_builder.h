// A frame put together piece by piece. The world is right-handed with +y up, as in glTF.
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "capture_format/frame.h"
#include "captures/scenarios.h"

namespace strata::scenario {

/// How much of the animation is over: 1 in the last frame, so a single frame shows the scene as it is meant.
double progress(std::uint32_t frame, const ScenarioOptions&);

struct Camera {
    glm::dvec3 eye{0, 0, 0}, target{0, 0, -1};
    double vertical_fov = 0.8;  ///< radians
    double near = 0.1;
    double swing = 0.25;  ///< radians around the target's vertical axis, from the first frame to the last, which is at `eye`
};

/// Object to world, rotation around y in radians (counter-clockwise from above), then scale.
struct Pose {
    glm::dvec3 position{0};
    double yaw = 0;
    glm::dvec3 scale{1};
};
glm::dmat4 transform(const Pose&);

/// Common materials.
Material lambert(std::string name, glm::vec3 color);
Material unlit(std::string name, glm::vec4 color);         ///< blends when its alpha is below 1
Material glass(std::string name, glm::vec3 transmission);  ///< full coverage, reflects nothing

class FrameBuilder {
public:
    FrameBuilder(std::uint32_t frame, const ScenarioOptions&);

    double progress() const { return progress_; }
    double previous_progress() const { return previous_progress_; }
    std::uint64_t seed() const { return frame.seed; }

    void look(const Camera&);
    std::uint32_t add(Mesh);
    std::uint32_t add(Material);
    std::uint32_t add(Texture);
    /// A draw at rest; the reference holds until the next draw.
    Draw& draw(std::uint32_t mesh, std::uint32_t material, const Pose&);

    Frame frame;  ///< what has been built

private:
    double progress_, previous_progress_;
};

}  // namespace strata::scenario
