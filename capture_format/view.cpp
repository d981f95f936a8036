// The matrices of a View.
#include "capture_format/view.h"

#include <cmath>

namespace strata {
namespace {

/// Two directions between which no rotation can be told.
bool are_parallel(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(glm::cross(a, b)) <= 1e-9 * glm::length(a) * glm::length(b);
}

}  // namespace

View look_at(const Camera& camera) {
    const glm::dvec3 forward = camera.target - camera.eye, back(0, 0, -1);
    glm::dvec3 up = camera.up;
    if (are_parallel(forward, up)) up = are_parallel(forward, back) ? glm::dvec3(0, 1, 0) : back;
    View view{.origin = camera.eye, .width = camera.width, .height = camera.height, .near = static_cast<float>(camera.near)};
    view.to_view = look_along(forward, up, camera.handedness);
    view.projection = perspective(camera.vertical_fov, static_cast<double>(camera.width) / camera.height, camera.near);
    return view;
}

glm::dmat3 look_along(glm::dvec3 forward, glm::dvec3 up, Handedness handedness) {
    forward = glm::normalize(forward);
    // A cross product turns with the handedness of the world; right, up and forward do not.
    const double hand = handedness == Handedness::right ? 1 : -1;
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up)) * hand;
    return glm::transpose(glm::dmat3(right, glm::cross(right, forward) * hand, forward));
}

glm::mat4 perspective(double vertical_fov, double width_over_height, double near) {
    const double scale_y = 1 / std::tan(vertical_fov / 2);
    glm::mat4 projection{0};
    projection[0][0] = static_cast<float>(scale_y / width_over_height);
    projection[1][1] = static_cast<float>(-scale_y);  // Vulkan's y grows downwards
    projection[2][3] = 1;                             // w is the view depth
    projection[3][2] = static_cast<float>(near);      // z / w = near / depth: 1 at the near plane, 0 at infinity
    return projection;
}

}  // namespace strata
