// What of a frame glTF cannot say, so that nothing is dropped silently.
#pragma once

#include <string>
#include <vector>

namespace strata {

struct Frame;  // capture_format/frame.h
struct Light;  // capture_format/frame/light.h

}  // namespace strata

namespace strata::to_gltf_parts {

/// One sentence per kind of thing, with how many there are.
std::vector<std::string> losses(const Frame&);

/// True for lights that KHR_lights_punctual knows: points, round spots and directional ones that add light.
bool is_punctual(const Light&);

}  // namespace strata::to_gltf_parts
