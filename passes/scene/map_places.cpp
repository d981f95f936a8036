// How large shadow maps are and where they lie.
#include "passes/scene/map_places.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "capture_format/frame/frame.h"
#include "passes/scene/view_space.h"

namespace strata {

namespace {

// Pixels between the two tangents from the eye at a sphere, seen along one axis of the picture. `side` and `ahead` are its
// center's coordinates; slopes of the tangents are (side ahead +- radius sqrt(side^2 + ahead^2 - radius^2)) / (ahead^2 -
// radius^2).
double extent_on_screen(glm::dvec2 center, double radius, double pixels_per_slope) {
    const double side = center.x, ahead = center.y;
    const double root = std::sqrt(side * side + ahead * ahead - radius * radius);
    return pixels_per_slope * 2 * radius * root / (ahead * ahead - radius * radius);
}

// Every second bit of a number.
std::uint32_t every_second_bit(std::uint64_t bits) {
    std::uint32_t result = 0;
    for (std::uint32_t i = 0; i < 32; ++i) result |= static_cast<std::uint32_t>(bits >> (2 * i) & 1u) << i;
    return result;
}

std::uint64_t cell(const ShadowView& view) { return std::bit_ceil(view.size); }

// Squares in descending order of powers of two along a Morton curve: each begins where its size divides the way gone so far.
void pack(std::span<ShadowView> views) {
    std::vector<std::size_t> order(views.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return cell(views[a]) > cell(views[b]); });
    const std::uint64_t layer_texels = cell(views[order[0]]) * cell(views[order[0]]);
    std::uint64_t way = 0;  // in texels
    for (const std::size_t i : order) {
        views[i].layer = static_cast<std::uint32_t>(way / layer_texels);
        views[i].offset = {every_second_bit(way % layer_texels), every_second_bit(way % layer_texels >> 1)};
        way += cell(views[i]) * cell(views[i]);
    }
}

}  // namespace

std::uint32_t needed_size(const Frame& frame, const Light& light) {
    const glm::dvec3 center = in_view_space(frame.view, light.position);
    const double radius = double(light.range), own = std::max(light.shadow.map_size, 1u);
    const View& view = frame.view;
    double pixels = own;
    if (center.z + radius <= double(view.near)) {
        pixels = 0;
    } else if (center.z - radius > double(view.near)) {
        pixels =
            std::max(extent_on_screen({center.x, center.z}, radius, 0.5 * view.width * double(view.projection[0][0])),
                     extent_on_screen({center.y, center.z}, radius, 0.5 * view.height * std::abs(double(view.projection[1][1]))));
    }
    const double capped = std::clamp(pixels, double(std::min(smallest_needed_map, light.shadow.map_size)), own);
    return std::min(std::bit_ceil(static_cast<std::uint32_t>(std::ceil(capped))), static_cast<std::uint32_t>(own));
}

void place_maps(std::span<ShadowView> views, Allocation allocation) {
    if (views.empty()) return;
    if (allocation == Allocation::need) return pack(views);
    for (std::uint32_t i = 0; i < views.size(); ++i) views[i].layer = i;
}

MapLayers map_layers(std::span<const ShadowView> views) {
    MapLayers found;
    for (const ShadowView& view : views) {
        found.extent = std::max(found.extent, std::max(view.offset.x, view.offset.y) + view.size);
        found.layers = std::max(found.layers, view.layer + 1);
    }
    return found;
}

}  // namespace strata
