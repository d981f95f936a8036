#include "passes/lens/bloom/scattered.h"

#include <algorithm>
#include <cmath>

namespace strata::lens {
namespace {

/// Shares of pixels 0 .. n from the middle of a Gaussian, integrated over each.
std::vector<double> shares(double deviation) {
    const int reach = int(std::ceil(4 * deviation)) + 1;
    std::vector<double> share;
    for (int i = 0; i <= reach; ++i)
        share.push_back(.5 *
                        (std::erf((i + .5) / (deviation * std::sqrt(2.))) - std::erf((i - .5) / (deviation * std::sqrt(2.)))));
    double sum = share[0];
    for (std::size_t i = 1; i < share.size(); ++i) sum += 2 * share[i];
    for (double& one : share) one /= sum;
    return share;
}

ReferenceImage blurred(const ReferenceImage& image, const std::vector<double>& share, const glm::ivec2& along) {
    ReferenceImage result(image.width, image.height);
    const int reach = int(share.size()) - 1;
    for (int y = 0; y < int(image.height); ++y)
        for (int x = 0; x < int(image.width); ++x) {
            glm::dvec4 sum(0);
            for (int i = -reach; i <= reach; ++i)
                sum += share[std::size_t(std::abs(i))] *
                       image.at(std::uint32_t(std::clamp(x + i * along.x, 0, int(image.width) - 1)),
                                std::uint32_t(std::clamp(y + i * along.y, 0, int(image.height) - 1)));
            result.at(std::uint32_t(x), std::uint32_t(y)) = sum;
        }
    return result;
}

}  // namespace

ReferenceImage scattered(const ReferenceImage& glowing, std::uint32_t levels) {
    ReferenceImage mean(glowing.width, glowing.height);
    for (std::uint32_t level = 1; level <= levels; ++level) {
        // A pixel's own area has a variance of 1/12 each way, which integrating over pixels adds.
        const std::vector<double> share = shares(std::sqrt((std::pow(4., level) - 1) / 2 - 1. / 12));
        const ReferenceImage one = blurred(blurred(glowing, share, {1, 0}), share, {0, 1});
        for (std::size_t i = 0; i < mean.texels.size(); ++i) mean.texels[i] += one.texels[i] / double(levels);
    }
    return mean;
}

}  // namespace strata::lens
