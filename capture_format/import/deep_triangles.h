// The samples of one block of a deep image as triangles. Blocks do not depend on each other, so that threads make them; what
// joins them (deep.cpp) keeps the order of the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/container/picture.h"
#include "capture_format/import/deep.h"
#include "capture_format/import/deep_file.h"
#include "capture_format/import/deep_pixel.h"

namespace strata {

/// Which channels of a mesh's samples hide what is behind: all, or with chromatic alpha one of three.
struct DeepLayer {
    const char* name;
    glm::vec3 transmission;
};

/// What a block gives. All lists are empty or as make() left them.
struct DeepTriangles {
    /// Three corners per sample, far to near within each pixel.
    struct Corners {
        std::vector<glm::vec3> positions;
        std::vector<glm::vec4> colors;
    };
    std::vector<Corners> layers;
    DeepCensus census;
    std::vector<std::pair<std::size_t, glm::dvec3>> seen;      ///< texel of the thumbnail, and what a pixel adds to it
    std::vector<std::pair<std::size_t, glm::dvec2>> infinite;  ///< first corner and pixel of samples that are infinitely far
    double nearest = std::numeric_limits<double>::max(), farthest = 0;  ///< of the others
};

/// Makes the triangles of a window, which has the frame's view.
class DeepTriangleMaker {
public:
    DeepTriangleMaker(const DeepWindow& window, const View& view, std::span<const DeepLayer> layers);

    /// Fills what a block gives. Thread safe. Fails as pixel_samples() does.
    Result<void> make(const DeepBlock&, DeepTriangles&) const;
    /// A corner of a sample's triangle in view space.
    glm::vec3 position(const glm::dvec2& pixel, std::size_t corner, double depth) const;

private:
    void add_pixel(const glm::uvec2& pixel, const std::vector<DeepSample>& nearest_first, DeepTriangles&) const;
    void add_sample(const glm::uvec2& pixel, const DeepSample&, DeepTriangles&) const;

    const DeepWindow window_;
    const ThumbnailExtent small_;
    const glm::dvec2 extent_, scale_;  ///< of the window in pixels; of the projection
    const std::span<const DeepLayer> layers_;
};

}  // namespace strata
