#include "passes/lens/depth_of_field/truth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <tbb/parallel_for.h>

#include "passes/lens/depth_of_field/focus_model.h"
#include "passes/stage_input.h"

namespace strata::lens {
namespace {

/// One sample of each pixel, as a surface that rays from places of the lens meet. Beyond its border it goes on as it is there.
class Surface {
public:
    Surface(const StageInput& input, const ReferenceImage& color, std::uint32_t sample)
        : width(int(color.width)), height(int(color.height)) {
        const double most = std::hypot(width, height);  // a disc as large as the picture
        for (std::uint32_t y = 0; y < color.height; ++y)
            for (std::uint32_t x = 0; x < color.width; ++x)
                blurs.push_back(std::clamp(blur_radius(input.frame, depth_of(input, x, y, sample)), -most, most));
        farthest = std::ranges::max(blurs);
        find_first();
    }

    /// The pixel that the ray from this place (within the unit disc) sees in the middle of pixel `to`. At the depth whose blur is
    /// b, the ray passes the picture at `to` - b * place.
    std::size_t seen(const glm::ivec2& to, const glm::dvec2& place) const {
        Walk walk(to, place, first[tile_of(to.x, to.y)]);
        std::size_t before = index(walk.at);  // the last pixel whose surface the ray has not reached
        for (bool is_before = true;;) {
            const std::size_t here = index(walk.at);
            const double end = std::min(walk.next(), farthest);
            if (blurs[here] > end) {
                before = here;
                is_before = true;
            } else if (blurs[here] >= walk.blur) {
                return here;
            } else {
                if (is_before && blurs[before] - blurs[here] < steepest) return before;  // between two pixels of a slant
                is_before = false;
            }
            if (end >= farthest) return before;
            walk.step();
        }
    }

private:
    /// Radius by which blur changes from pixel to pixel on a plane that all of the lens sees from one side: less than the
    /// distance.
    static constexpr double steepest = 1;

    /// The pixels along a ray, from the nearest surface's depth to farther ones.
    struct Walk {
        Walk(const glm::ivec2& to, const glm::dvec2& place, double first_blur) : blur(first_blur) {
            for (int i = 0; i < 2; ++i) {
                const double from = to[i] + .5 - place[i] * blur;
                at[i] = int(std::floor(from));
                way[i] = place[i] > 0 ? -1 : 1;
                per_pixel[i] = place[i] == 0 ? HUGE_VAL : 1 / std::abs(place[i]);
                border[i] = place[i] == 0 ? HUGE_VAL : blur + (way[i] > 0 ? at[i] + 1 - from : from - at[i]) * per_pixel[i];
            }
        }
        /// The blur at which the ray leaves the pixel.
        double next() const { return std::min(border.x, border.y); }
        void step() {
            const int axis = border.x < border.y ? 0 : 1;
            blur = border[axis];
            at[axis] += way[axis];
            border[axis] += per_pixel[axis];
        }

        double blur;  ///< at which the ray enters the pixel
        glm::ivec2 at{0}, way{0};
        glm::dvec2 border{0}, per_pixel{0};
    };

    std::size_t tile_of(int x, int y) const { return std::size_t(y / tile) * std::size_t(across) + std::size_t(x / tile); }

    /// At the depth whose blur is b, a ray is within |b| pixels of where it ends. So rays to a tile meet nothing nearer than the
    /// nearest of what lies within its own blur, or within the largest blur behind the plane in focus.
    void find_first() {
        across = (width + tile - 1) / tile;
        const int down = (height + tile - 1) / tile;
        std::vector<double> own(std::size_t(across * down), HUGE_VAL);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) own[tile_of(x, y)] = std::min(own[tile_of(x, y)], blurs[index({x, y})]);
        first.assign(own.size(), HUGE_VAL);
        for (int to = 0; to < across * down; ++to)
            for (int from = 0; from < across * down; ++from) {
                const double blur = own[std::size_t(from)];
                const int columns = std::abs(to % across - from % across) - 1, rows = std::abs(to / across - from / across) - 1;
                if (tile * std::max(columns, rows) > std::max(std::abs(blur), farthest) + 1) continue;
                first[std::size_t(to)] = std::min(first[std::size_t(to)], blur);
            }
    }

    std::size_t index(const glm::ivec2& at) const {
        return std::size_t(std::clamp(at.y, 0, height - 1)) * std::size_t(width) + std::size_t(std::clamp(at.x, 0, width - 1));
    }

    static constexpr int tile = 16;
    int width, height, across = 0;
    double farthest = 0;
    std::vector<double> blurs;
    std::vector<double> first;  ///< by tile: no ray to it meets a smaller blur
};

/// Evenly over the area of the unit disc: a spiral of Vogel.
std::vector<glm::dvec2> places_of_lens(std::uint32_t count) {
    std::vector<glm::dvec2> places;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double from_center = std::sqrt((i + .5) / count), angle = i * std::numbers::pi * (3 - std::sqrt(5.));
        places.push_back(from_center * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return places;
}

}  // namespace

ReferenceImage seen_through_lens(const StageInput& input, const ReferenceImage& color, std::uint32_t places) {
    const std::vector<glm::dvec2> lens = places_of_lens(places);
    ReferenceImage mean(color.width, color.height, color.layers);
    for (std::uint32_t s = 0; s < color.layers; ++s) {
        const Surface surface(input, color, s);
        const std::size_t first = color.index(0, 0, s);
        tbb::parallel_for(0u, color.height, [&](std::uint32_t y) {
            for (std::uint32_t x = 0; x < color.width; ++x) {
                glm::dvec4 sum(0);
                for (const glm::dvec2& place : lens) {
                    const glm::dvec3 radiance(color.texels[first + surface.seen({x, y}, place)]);
                    if (std::isfinite(radiance.x + radiance.y + radiance.z)) sum += glm::dvec4(radiance, 1);
                }
                const glm::dvec4& own = color.at(x, y, s);
                mean.at(x, y, s) = sum.w > 0 ? glm::dvec4(glm::dvec3(sum) / sum.w, own.w) : own;
            }
        });
    }
    return mean;
}

}  // namespace strata::lens
