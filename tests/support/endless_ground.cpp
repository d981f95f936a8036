#include "tests/support/endless_ground.h"

namespace strata {

Frame endless_ground(const Camera& camera, std::uint32_t samples) {
    Frame frame;
    frame.view = look_at(camera);
    frame.view.samples = samples;
    Mesh mesh;
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1)})
        mesh.positions.emplace_back(1000 * corner.x, 0, 1000 * corner.y);
    mesh.indices = {0, 1, 2, 0, 2, 3};
    frame.meshes.push_back(mesh);
    frame.materials.push_back({.lighting_model = LightingModel::lambert, .double_sided = true});
    frame.draws.push_back({});
    frame.hemisphere = {.sky = glm::vec3(1), .ground = glm::vec3(1)};
    return frame;
}

}  // namespace strata
