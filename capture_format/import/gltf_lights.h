// The punctual lights of a glTF, the light of a scene that has none, and how bright that makes it.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/import/gltf_document.h"
#include "capture_format/import/gltf_nodes.h"
#include "capture_format/import/gltf_view.h"

namespace strata::gltf {

/// Lights of KHR_lights_punctual on shown nodes into the frame: the first directional one is the sun. Returns warnings.
std::vector<std::string> add_lights(Frame&, const Document&, const Hierarchy&, const std::vector<glm::dmat4>& to_world);

/// Gives the lights without a range one at which they end unseen: glTF's reach infinitely far.
void end_lights(Frame&, const Bounds&);

/// A sun and a sky, so that there is something to see.
void add_default_light(Frame&);

/// The radiance of a white surface in the middle of the scene that faces every light at once. Lights nearer than half the
/// scene's radius count as if they stood there: a bulb in its lampshade does not light the room as it lights the shade.
double white_radiance(const Frame&, const Bounds&);

}  // namespace strata::gltf
