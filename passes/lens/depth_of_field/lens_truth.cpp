#include "passes/lens/depth_of_field/lens_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

#include "passes/lens/depth_of_field/focus_model.h"

namespace strata::lens {
namespace {

struct Seen {
    glm::dvec3 radiance{0};
    double depth = -1;  ///< below 0: nothing yet
};

/// A layer of the picture from one place of the lens.
class Shifted {
public:
    Shifted(std::uint32_t w, std::uint32_t h) : width(int(w)), height(int(h)), pixels(std::size_t(w) * h) {}

    void draw(const glm::dvec2& at, const Seen& sample) {
        const int x = int(std::floor(at.x)), y = int(std::floor(at.y));
        if (x < 0 || y < 0 || x >= width || y >= height) return;
        Seen& there = pixel(x, y);
        if (there.depth < 0 || sample.depth < there.depth) there = sample;
    }

    /// Pixels that nothing fell on take the farthest of their neighbors, again and again.
    void fill() {
        std::vector<std::size_t> empty;
        for (std::size_t i = 0; i < pixels.size(); ++i)
            if (pixels[i].depth < 0) empty.push_back(i);
        while (!empty.empty()) {
            std::vector<std::pair<std::size_t, Seen>> found;
            for (const std::size_t i : empty)
                if (const Seen one = farthest_beside(int(i) % width, int(i) / width); one.depth >= 0) found.emplace_back(i, one);
            if (found.empty()) return;
            for (const auto& [i, one] : found) pixels[i] = one;
            std::erase_if(empty, [&](std::size_t i) { return pixels[i].depth >= 0; });
        }
    }

    int width, height;
    std::vector<Seen> pixels;

private:
    Seen& pixel(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }

    Seen farthest_beside(int x, int y) {
        Seen farthest;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (x + dx >= 0 && y + dy >= 0 && x + dx < width && y + dy < height)
                    if (const Seen& there = pixel(x + dx, y + dy); there.depth > farthest.depth) farthest = there;
        return farthest;
    }
};

void add_view(const StageInput& input, const ReferenceImage& color, const glm::dvec2& place, ReferenceImage& sum) {
    for (std::uint32_t s = 0; s < color.layers; ++s) {
        Shifted view(color.width, color.height);
        for (std::uint32_t y = 0; y < color.height; ++y)
            for (std::uint32_t x = 0; x < color.width; ++x) {
                const double z = depth_of(input, x, y, s);
                const glm::dvec2 at = glm::dvec2(x, y) + .5 + place * blur_radius(input.frame, z);
                view.draw(at, {glm::dvec3(color.at(x, y, s)), std::min(z, 1e300)});
            }
        view.fill();
        for (std::size_t i = 0; i < view.pixels.size(); ++i)
            sum.texels[s * view.pixels.size() + i] += glm::dvec4(view.pixels[i].radiance, 0);
    }
}

}  // namespace

ReferenceImage seen_through_lens(const StageInput& input, const ReferenceImage& color, std::uint32_t places) {
    // In chunks that are summed in their order: equal for equal inputs, whatever the number of threads.
    constexpr std::uint32_t chunks = 16;
    std::vector<ReferenceImage> sums(chunks, ReferenceImage(color.width, color.height, color.layers));
    tbb::parallel_for(0u, chunks, [&](std::uint32_t chunk) {
        for (std::uint32_t i = chunk; i < places; i += chunks) {
            const double from_center = std::sqrt((i + .5) / places), angle = i * std::numbers::pi * (3 - std::sqrt(5.));
            add_view(input, color, from_center * glm::dvec2(std::cos(angle), std::sin(angle)), sums[chunk]);
        }
    });
    ReferenceImage mean(color.width, color.height, color.layers);
    for (std::size_t i = 0; i < mean.texels.size(); ++i) {
        for (const ReferenceImage& sum : sums) mean.texels[i] += sum.texels[i];
        mean.texels[i] = glm::dvec4(glm::dvec3(mean.texels[i]) / double(places), color.texels[i].w);
    }
    return mean;
}

}  // namespace strata::lens
