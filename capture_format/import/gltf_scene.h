// The node hierarchy of a glTF scene, flattened: every node of the active scene with its object-to-world transform.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <tiny_gltf.h>
#include <glm/glm.hpp>

#include "capture_format/frame.h"
#include "capture_format/import/gltf.h"
#include "capture_format/result.h"

namespace strata::gltf {

struct PlacedNode {
    const tinygltf::Node* node = nullptr;
    glm::dmat4 to_world{1};
};

/// Parents before children. Fails when a child does not exist or a node is reached twice (a cycle, say).
Result<std::vector<PlacedNode>> place_nodes(const tinygltf::Model&);

/// An axis-aligned box in the world; empty until something is in it.
struct Bounds {
    glm::dvec3 low{1e300}, high{-1e300};

    bool empty() const { return low.x > high.x; }
    glm::dvec3 center() const { return empty() ? glm::dvec3(0) : (low + high) * 0.5; }
    double radius() const { return empty() ? 1 : glm::length(high - low) * 0.5; }
};

/// A view with the eye's axes: glTF cameras look along -z of a right-handed space, views along +z of a left-handed one.
View look_along(glm::dvec3 eye, glm::dvec3 forward, glm::dvec3 up);

/// A view of all these points, which lie in these bounds, as near as it may be from the side that the options name. Sets no
/// extent.
View framing_view(std::span<const glm::dvec3> points, const Bounds&, const GltfOptions&);

/// The radiance of a white surface in the middle of the scene that faces every light at once. Lights nearer than half the
/// scene's radius count as if they stood there: a bulb in its lampshade does not light the room as it lights the shade.
double white_radiance(const Frame&, const Bounds&);

/// Punctual lights of KHR_lights_punctual into the frame: the first directional one is the sun.
std::vector<std::string> add_lights(Frame&, const tinygltf::Model&, const std::vector<PlacedNode>&);

}  // namespace strata::gltf
