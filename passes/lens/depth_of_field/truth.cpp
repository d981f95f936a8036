#include "passes/lens/depth_of_field/truth.h"

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

    /// Samples move along one line, so a gap between them opens along it: it shows the farther of what lies at its two ends.
    void fill(const glm::dvec2& along) {
        const std::vector<Seen> drawn = pixels;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                if (pixel(x, y).depth < 0) {
                    const Seen one = end_of_gap(drawn, {x, y}, along), other = end_of_gap(drawn, {x, y}, -along);
                    pixel(x, y) = one.depth > other.depth ? one : other;
                }
    }

    int width, height;
    std::vector<Seen> pixels;

private:
    Seen& pixel(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }

    /// The first pixel that is drawn; beyond the border nothing is.
    Seen end_of_gap(const std::vector<Seen>& drawn, const glm::ivec2& from, const glm::dvec2& way) const {
        for (int i = 1; i < width + height; ++i) {
            const glm::ivec2 at = from + glm::ivec2(glm::round(way * double(i)));
            if (at.x < 0 || at.y < 0 || at.x >= width || at.y >= height) break;
            const Seen& there = drawn[std::size_t(at.y) * std::size_t(width) + std::size_t(at.x)];
            if (there.depth >= 0) return there;
        }
        return {};
    }
};

/// How far samples move at most, in pixels.
int margin_of(const StageInput& input, const ReferenceImage& color) {
    double largest = 0;
    for (std::uint32_t s = 0; s < color.layers; ++s)
        for (std::uint32_t y = 0; y < color.height; ++y)
            for (std::uint32_t x = 0; x < color.width; ++x)
                largest = std::max(largest, std::abs(blur_radius(input.frame, depth_of(input, x, y, s))));
    return int(std::ceil(std::min(largest, double(color.width))));
}

/// Beyond its border the picture goes on as it is there.
void add_view(const StageInput& input, const ReferenceImage& color, const glm::dvec2& place, int margin, ReferenceImage& sum) {
    const int width = int(color.width), height = int(color.height);
    for (std::uint32_t s = 0; s < color.layers; ++s) {
        Shifted view(color.width, color.height);
        for (int y = -margin; y < height + margin; ++y)
            for (int x = -margin; x < width + margin; ++x) {
                const auto px = std::uint32_t(std::clamp(x, 0, width - 1)), py = std::uint32_t(std::clamp(y, 0, height - 1));
                const double z = depth_of(input, px, py, s);
                const glm::dvec2 at = glm::dvec2(x, y) + .5 + place * blur_radius(input.frame, z);
                view.draw(at, {glm::dvec3(color.at(px, py, s)), std::min(z, 1e300)});
            }
        view.fill(place / std::max(glm::length(place), 1e-9));
        for (std::size_t i = 0; i < view.pixels.size(); ++i)
            sum.texels[s * view.pixels.size() + i] += glm::dvec4(view.pixels[i].radiance, 0);
    }
}

}  // namespace

ReferenceImage seen_through_lens(const StageInput& input, const ReferenceImage& color, std::uint32_t places) {
    // In chunks that are summed in their order: equal for equal inputs, whatever the number of threads.
    constexpr std::uint32_t chunks = 16;
    const int margin = margin_of(input, color);
    std::vector<ReferenceImage> sums(chunks, ReferenceImage(color.width, color.height, color.layers));
    tbb::parallel_for(0u, chunks, [&](std::uint32_t chunk) {
        for (std::uint32_t i = chunk; i < places; i += chunks) {
            const double from_center = std::sqrt((i + .5) / places), angle = i * std::numbers::pi * (3 - std::sqrt(5.));
            add_view(input, color, from_center * glm::dvec2(std::cos(angle), std::sin(angle)), margin, sums[chunk]);
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
