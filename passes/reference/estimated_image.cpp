#include "passes/reference/estimated_image.h"

#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include "passes/reference/decoded.h"

namespace strata {
namespace {

struct Estimate {
    glm::dvec3 mean{0}, standard_error{0};
};

Estimate estimate(const std::vector<glm::dvec3>& batches) {
    const double count = double(batches.size());
    Estimate result;
    for (const glm::dvec3& batch : batches) result.mean += batch / count;
    glm::dvec3 squares(0);
    for (const glm::dvec3& batch : batches) squares += (batch - result.mean) * (batch - result.mean);
    if (batches.size() > 1) result.standard_error = glm::sqrt(squares / (count - 1) / count);
    return result;
}

/// A surface's place, in depth and in the pixel (passes/reference/place_code.h), and its side are all that is asked; of hair, the
/// lighting model makes a side of the fiber.
bool is_first_again(const GivenSurfaces& given, std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
    const glm::dvec4 &first = given.material.at(x, y), &other = given.material.at(x, y, sample);
    return given.normal.at(x, y) == given.normal.at(x, y, sample) && first.x == other.x && first.w == other.w;
}

}  // namespace

ReferenceImage estimated_image(const Frame& frame, const GivenSurfaces& given, std::uint32_t batches, const glm::dvec4& nothing,
                               const EstimateBatch& batch) {
    const ReferenceImage& normal = given.normal;
    ReferenceImage image(normal.width, normal.height, normal.layers, nothing);
    image.standard_error.resize(image.texels.size());
    const auto estimate_at = [&](std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
        DecodedTexels texels{normal.at(x, y, sample), {}, {}};
        texels.material = given.material.at(x, y, sample);
        const SurfacePoint point = decoded_surface(frame, texels, x, y);
        const std::size_t texel = normal.index(x, y, sample);
        std::vector<glm::dvec3> estimates;
        for (std::uint32_t i = 0; i < batches; ++i) estimates.push_back(batch(point, DrawnNumbers(texel + 1, i + 1)));
        const auto [mean, error] = estimate(estimates);
        image.texels[texel] = glm::dvec4(mean, 1);
        image.standard_error[texel] = error;
    };
    tbb::parallel_for(0u, normal.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < normal.width; ++x)
            for (std::uint32_t sample = 0; sample < normal.layers; ++sample) {
                if (tbb::is_current_task_group_canceling()) return;
                if (normal.at(x, y, sample).w <= 0) continue;
                if (sample == 0 || !is_first_again(given, x, y, sample)) {
                    estimate_at(x, y, sample);
                    continue;
                }
                image.at(x, y, sample) = image.at(x, y);
                image.standard_error[image.index(x, y, sample)] = image.standard_error[image.index(x, y)];
            }
    });
    return image;
}

}  // namespace strata
