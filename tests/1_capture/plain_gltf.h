// A second reader of glTF, for tests: what a scene's triangles are together. It shares no code with the import; files must be
// sound, with base64 buffers, and without skins and animations.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace strata {

/// Triangles of all draws, world space.
struct TriangleMeasures {
    std::size_t triangles = 0;
    double area = 0;
    std::array<double, 3> low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

    void add(const std::array<std::array<double, 3>, 3>& corners);
};

TriangleMeasures measure_plainly(const std::string& gltf);

}  // namespace strata
