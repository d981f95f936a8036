// Screen-space ambient occlusion in double, from docs/algorithms/deferred.md 8.4 and Jimenez et al. 2016. Which texel a tap reads
// hangs on rounding where it lies on a border between two, and whether it counts where it lies at the radius: what both ways
// differ by is followed through blur and upsampling, and texels that it changes visibly are undecided.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "capture_format/frame/frame.h"
#include "passes/edges/plain_pixels.h"
#include "passes/occlusion/radii.h"
#include "passes/occlusion/ssao/ssao.shared.h"
#include "passes/occlusion/ssao/ssao_params.h"
#include "passes/occlusion/truth.h"
#include "passes/reference/decoded.h"
#include "passes/reference/pcg.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::occlusion {
namespace {

using std::numbers::pi;

// Pixels, and shares of a threshold, within which float and double may disagree; and how much of visibility may hang on that.
constexpr double close_pixels = 1e-4, close_share = 1e-5, most_spread = 1e-3;

struct Place {
    bool exists = false;
    glm::dvec3 position{0}, normal{0};
    double material = 1;
};

struct Estimate {
    double visibility = 1;
    double spread = 0;  ///< what it may differ by, if rounding decides otherwise
};

/// The places of all samples, and what estimators ask of the frame.
class Scene {
public:
    Scene(const StageInput& input, const SsaoParams& chosen)
        : input(input), params(chosen), view(input.frame.view), radius(radii[chosen.radius]) {
        const ReferenceImage &normals = input.before.at("surface_normal"), &materials = input.before.at("surface_material");
        places_.resize(normals.texels.size());
        for (std::uint32_t s = 0; s < normals.layers; ++s)
            for (std::uint32_t y = 0; y < normals.height; ++y)
                for (std::uint32_t x = 0; x < normals.width; ++x) {
                    const std::size_t i = normals.index(x, y, s);
                    if (normals.texels[i].w <= 0) continue;
                    const SurfacePoint p = decoded_surface(input.frame, {normals.texels[i], {}, materials.texels[i]}, x, y);
                    places_[i] = {true, p.position, facing_normal(p), p.occlusion};
                }
    }
    const Place& at(glm::ivec2 p, std::uint32_t s) const {
        return places_[(std::size_t(s) * view.height + std::size_t(p.y)) * view.width + std::size_t(p.x)];
    }
    bool has(glm::ivec2 p) const { return p.x >= 0 && p.y >= 0 && p.x < int(view.width) && p.y < int(view.height); }
    /// In pixels.
    glm::dvec2 project(const glm::dvec3& p) const {
        const glm::dvec4 clip = glm::dmat4(view.projection) * glm::dvec4(p, 1);
        return (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * glm::dvec2(view.width, view.height);
    }

    const StageInput& input;
    const SsaoParams params;
    const View& view;
    const double radius;

private:
    std::vector<Place> places_;
};

/// Shares of the turn to the next direction and of the way to the next tap.
glm::dvec2 noise_at(const Scene& scene, glm::uvec2 texel) {
    const Frame& frame = scene.input.frame;
    if (scene.params.noise == noise_none) return {0, 0.5};
    if (scene.params.noise == noise_hash) {
        std::uint32_t h = static_cast<std::uint32_t>(frame.seed);
        for (const std::uint32_t part : {texel.x, texel.y, static_cast<std::uint32_t>(frame.index)}) h = pcg(h ^ part);
        return {((h >> 16) + 0.5) / 65536, ((h & 0xffff) + 0.5) / 65536};
    }
    const std::uint32_t x = texel.x % 4, y = texel.y % 4;
    return {((x + y) % 4 * 4 + x) / 16.0, ((y + 4 - x) % 4 + 0.5) / 4};
}

/// One estimate at a sample.
class Estimator {
public:
    Estimator(const Scene& scene, glm::ivec2 pixel, std::uint32_t sample, glm::uvec2 texel)
        : scene_(scene),
          center_(scene.at(pixel, sample)),
          pixel_(glm::dvec2(pixel) + 0.5),
          sample_(sample),
          noise_(noise_at(scene, texel)),
          to_eye_(-glm::normalize(center_.position)) {}

    Estimate run() {
        const double visibility = visible();
        if (!is_close_) return {visibility, 0};
        decides_otherwise_ = true;
        return {visibility, std::abs(visibility - visible())};
    }

private:
    double visible() {
        const double visibility = scene_.params.form == form_xray ? rings() : slices();
        return std::isnan(visibility) ? 1 : std::clamp(visibility, 0.0, 1.0);
    }

    /// a > b; the other way, if that is asked for, where rounding decides.
    bool is_more(double a, double b) {
        const bool is_close = std::abs(a / b - 1) < close_share;
        is_close_ = is_close_ || is_close;
        return (a > b) != (is_close && decides_otherwise_);
    }

    /// The pixel of a place; its neighbor, if that is asked for, where rounding decides.
    glm::ivec2 pixel_under(const glm::dvec2& place) {
        const glm::dvec2 border = glm::round(place), off = place - border;
        glm::ivec2 pixel(glm::floor(place));
        for (int axis = 0; axis < 2; ++axis) {
            if (std::abs(off[axis]) > close_pixels) continue;
            is_close_ = true;
            if (decides_otherwise_) pixel[axis] = int(border[axis]) - (off[axis] >= 0 ? 1 : 0);
        }
        return pixel;
    }

    /// Slices through the way to the eye: what is left of the cosine-weighted arcs between horizons.
    double slices() {
        constexpr std::array<std::array<int, 2>, 4> kernels = {{{1, 4}, {1, 6}, {2, 6}, {4, 12}}};
        const auto [count, steps] = kernels[scene_.params.taps];
        const glm::dvec3 x_axis = glm::normalize(glm::dvec3(1, 0, 0) - to_eye_ * to_eye_.x);
        const glm::dvec3 y_axis = glm::cross(to_eye_, x_axis);
        double open = 0, left = 0;
        for (int i = 0; i < count; ++i) {
            const double turn = pi * (i + noise_.x) / count;
            const glm::dvec3 along = std::cos(turn) * x_axis + std::sin(turn) * y_axis;
            const glm::dvec2 normal(glm::dot(center_.normal, to_eye_), glm::dot(center_.normal, along));
            const double length = glm::length(normal);
            if (length < 1e-5) continue;
            const double n = std::clamp(std::atan2(normal.y, normal.x), -pi / 2, pi / 2);
            const double right = std::min(n + pi / 2, horizon(along, steps)),
                         before = std::max(n - pi / 2, -horizon(-along, steps));
            const auto arc = [n](double h) { return (2 * h * std::sin(n) + std::cos(n) - std::cos(2 * h - n)) / 4; };
            open += length * (arc(n + pi / 2) + arc(n - pi / 2));
            left += length * (arc(right) + arc(before));
        }
        return open > 0 ? left / open : 1;
    }

    /// The angle from the way to the eye to the highest occluder; more than pi where there is none.
    double horizon(const glm::dvec3& along, int steps) {
        const glm::dvec2 way = reach(along);
        const double pixels = glm::length(way);
        double least = 2 * pi;
        const Place* last = &center_;
        if (pixels < 1e-3) return least;
        for (int i = 0; i < steps; ++i) {
            const double part = (i + noise_.y) / steps;
            const glm::dvec2 tapped = pixel_ + way / pixels * std::max(part * pixels, i + 1.0);
            const Place* tap = surface_under(tapped);
            if (!tap) continue;
            glm::dvec3 d = tap->position - center_.position;
            if (is_more(glm::length(d), scene_.radius)) {
                if (!is_one_plane(*last, *tap)) continue;
                d = on_sphere(last->position - center_.position, d);
            } else {
                last = tap;
            }
            const double seen = std::abs(glm::dot(center_.position, center_.normal)),
                         other = std::abs(glm::dot(tap->position, center_.normal));
            const double lower = double(scene_.params.depth_error) * (seen + other) + double(scene_.params.bias) * glm::length(d);
            if (glm::dot(d, center_.normal) <= lower) continue;
            const glm::dvec3 counted = d - center_.normal * lower;
            const glm::dvec2 in_slice(glm::dot(counted, to_eye_), glm::dot(counted, along));
            least = std::min(least, std::acos(std::clamp(in_slice.x / std::max(glm::length(in_slice), 1e-9), -1.0, 1.0)));
        }
        return least;
    }

    /// To the end of the sphere of the radius as seen along a slice, or of the picture.
    glm::dvec2 reach(const glm::dvec3& along) {
        const glm::dvec2 size(scene_.view.width, scene_.view.height);
        const double sine = scene_.radius / glm::length(center_.position);
        glm::dvec2 way(0);
        const glm::dvec3 touching = sine * along - std::sqrt(std::max(0.0, 1 - sine * sine)) * to_eye_;
        if (sine < 1 && touching.z > 0.05) {
            way = scene_.project(touching) - pixel_;
        } else {  // which way: a step so small that the projection is straight
            const double step = 1e-4 * center_.position.z;
            way = scene_.project(center_.position + step * along) - scene_.project(center_.position - step * along);
            way = glm::normalize(way) * (size.x + size.y);
        }
        double share = 1;
        for (int axis = 0; axis < 2; ++axis) {
            const double room = (way[axis] > 0 ? size[axis] - pixel_[axis] : pixel_[axis]) - 1e-3;
            share = std::min(share, room / std::max(std::abs(way[axis]), 1e-6));
        }
        return way * share;
    }

    /// The surface under a place of the picture, if there is one.
    const Place* surface_under(const glm::dvec2& tapped) {
        const glm::ivec2 at = pixel_under(tapped);
        return scene_.has(at) && scene_.at(at, sample_).exists ? &scene_.at(at, sample_) : nullptr;
    }

    /// Normals within 26 degrees and a way of less than .02 of its length off the first one's plane.
    bool is_one_plane(const Place& a, const Place& b) {
        const glm::dvec3 way = b.position - a.position;
        const double cosine = glm::dot(a.normal, b.normal), off = std::abs(glm::dot(way, a.normal)) / glm::length(way);
        return is_more(cosine, 0.9) && is_more(0.02, off);
    }

    /// Where the way from inside the sphere of the radius to outside meets it: by halving.
    glm::dvec3 on_sphere(const glm::dvec3& inside, const glm::dvec3& outside) const {
        double low = 0, high = 1;
        for (int i = 0; i < 50; ++i) {
            const double middle = 0.5 * (low + high);
            (glm::length(glm::mix(inside, outside, middle)) > scene_.radius ? high : low) = middle;
        }
        return glm::mix(inside, outside, low);
    }

    /// docs/algorithms/deferred.md 8.4: (sum w v / sum w + .2) / 1.2.
    double rings() {
        constexpr std::array<std::array<int, 2>, 4> kernels = {{{4, 2}, {4, 3}, {8, 3}, {16, 6}}};
        const auto [count, ring_count] = kernels[scene_.params.taps];
        const glm::dvec2 size(scene_.view.width, scene_.view.height), last = size - 0.5;
        const double half_height = 1 / std::abs(double(scene_.view.projection[1][1]));
        const double k = 150 * std::tan(33.75 * pi / 180) / half_height / std::max(center_.position.z, 1.3);
        double weights = 0, values = 0;
        for (int ring = 1; ring <= ring_count; ++ring)
            for (int i = 0; i < count; ++i) {
                const double turn = 2 * pi * (i + 0.5 * ring + noise_.x) / count;
                const glm::dvec2 uv = k * glm::dvec2(0.5 / 1024, 0.5 / 768) * glm::dvec2(std::cos(turn), std::sin(turn));
                const glm::dvec2 tapped = glm::clamp(pixel_ + uv * size * (double(ring) / ring_count), glm::dvec2(0.5), last);
                const Place* tap = surface_under(tapped);
                const glm::dvec3 d = tap ? tap->position - center_.position : glm::dvec3(0);
                const double l = glm::length(d);
                if (l == 0 || l > scene_.radius) continue;
                const double influence = std::max(0.0, glm::dot(d / l, center_.normal));
                const double weight = (influence + 0.01) * std::clamp(1 - l / scene_.radius, 0.0, 1.0);
                weights += weight;
                values += weight * glm::mix(1.0, std::min(l, 1.0), influence);
            }
        return weights < 1e-6 ? 1 : (values / weights + 0.2) / 1.2;
    }

    const Scene& scene_;
    const Place& center_;
    const glm::dvec2 pixel_;
    const std::uint32_t sample_;
    const glm::dvec2 noise_;
    const glm::dvec3 to_eye_;
    bool is_close_ = false, decides_otherwise_ = false;
};

/// How much a surface says about another, 0 to 1.
double fit(const Place& center, const Place& other, std::uint32_t edge_stop) {
    if (!other.exists) return 0;
    const double z = center.position.z, other_z = other.position.z;
    if (edge_stop == edge_stop_depth) return std::clamp(1 - 8 * std::abs(z - other_z) / std::min(z, other_z), 0.0, 1.0);
    const double off_plane = std::abs(glm::dot(other.position - center.position, center.normal));
    return std::max(0.0, 1 - off_plane / (0.02 * z)) * std::max(0.0, glm::dot(center.normal, other.normal));
}

/// Texels that each stand for divisor x divisor pixels.
struct Estimates {
    std::uint32_t divisor = 1, width = 0, height = 0, layers = 1;
    std::vector<Estimate> texels;

    Estimates(const Scene& scene, std::uint32_t each)
        : divisor(each),
          width((scene.view.width + each - 1) / each),
          height((scene.view.height + each - 1) / each),
          layers(each > 1 ? 1 : scene.view.samples),
          texels(std::size_t(width) * height * layers) {}
    Estimate& at(std::uint32_t x, std::uint32_t y, std::uint32_t s) { return texels[(std::size_t(s) * height + y) * width + x]; }
    const Estimate& at(std::uint32_t x, std::uint32_t y, std::uint32_t s) const {
        return texels[(std::size_t(s) * height + y) * width + x];
    }
    glm::ivec2 pixel(std::uint32_t x, std::uint32_t y) const { return glm::ivec2(x, y) * int(divisor); }
};

/// Fills every texel of a surface; in plain pixels with what the first sample has.
template <typename Make>
void fill(const Scene& scene, Estimates& made, const Make& make) {
    tbb::parallel_for(0u, made.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < made.width; ++x)
            for (std::uint32_t s = 0; s < made.layers; ++s) {
                const glm::ivec2 p = made.pixel(x, y);
                const bool repeats = s > 0 && is_plain_pixel(scene.input, std::uint32_t(p.x), std::uint32_t(p.y));
                if (repeats) made.at(x, y, s) = made.at(x, y, 0);
                else if (scene.at(p, s).exists) made.at(x, y, s) = make(x, y, s);
            }
    });
}

/// 5 x 5 texels, the outer ones half.
Estimate blurred(const Scene& scene, const Estimates& from, glm::ivec2 texel, std::uint32_t s) {
    const Place& center = scene.at(texel * int(from.divisor), s);
    double sum = 0, spreads = 0, weights = 0;
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
            const glm::ivec2 other = texel + glm::ivec2(dx, dy);
            if (other.x < 0 || other.y < 0 || other.x >= int(from.width) || other.y >= int(from.height)) continue;
            const bool is_center = dx == 0 && dy == 0;
            const double fits = is_center ? 1 : fit(center, scene.at(other * int(from.divisor), s), scene.params.edge_stop);
            const double weight = fits * (std::abs(dx) == 2 ? 0.5 : 1) * (std::abs(dy) == 2 ? 0.5 : 1);
            const Estimate& there = from.at(std::uint32_t(other.x), std::uint32_t(other.y), s);
            sum += weight * there.visibility;
            spreads += weight * there.spread;
            weights += weight;
        }
    return {sum / weights, spreads / weights};
}

/// Bilinear among the four around, by fit.
Estimate upsampled(const Scene& scene, const Estimates& from, glm::ivec2 pixel, std::uint32_t s) {
    const Place& center = scene.at(pixel, s);
    const glm::dvec2 place = glm::dvec2(pixel) / 2.0, part = glm::fract(place);
    double sum = 0, spreads = 0, weights = 0, nearest = HUGE_VAL;
    Estimate of_nearest;
    for (std::uint32_t i = 0; i < 4; ++i) {
        const glm::dvec2 far(i % 2, i / 2);
        const glm::dvec2 share = glm::mix(1.0 - part, part, far);
        if (share.x * share.y == 0) continue;
        const auto x = std::min(std::uint32_t(place.x) + i % 2, from.width - 1),
                   y = std::min(std::uint32_t(place.y) + i / 2, from.height - 1);
        const Place& other = scene.at(from.pixel(x, y), 0);
        const Estimate& there = from.at(x, y, 0);
        const double weight = share.x * share.y * fit(center, other, scene.params.edge_stop);
        sum += weight * there.visibility;
        spreads += weight * there.spread;
        weights += weight;
        const double off = other.exists ? std::abs(glm::dot(other.position - center.position, center.normal)) : HUGE_VAL;
        if (off < nearest) nearest = off, of_nearest = there;
    }
    return weights >= 1e-3 ? Estimate{sum / weights, spreads / weights} : of_nearest;
}

ReferenceImage image_of(const Scene& scene, const Estimates& made) {
    ReferenceImage image(made.width, made.height, made.layers, glm::dvec4(1, 0, 0, 1));
    image.channels = 1;
    image.undecided.resize(image.texels.size());
    const MaterialRule rule = scene.params.material == material_min ? MaterialRule::darker : MaterialRule::product;
    for (std::uint32_t s = 0; s < made.layers; ++s)
        for (std::uint32_t y = 0; y < made.height; ++y)
            for (std::uint32_t x = 0; x < made.width; ++x) {
                const Estimate& estimate = made.at(x, y, s);
                const bool is_plain = is_plain_pixel(scene.input, x, y);
                const Place& place = scene.at({int(x), int(y)}, is_plain ? 0 : s);
                if (place.exists) image.at(x, y, s).x = occlusion_of(estimate.visibility, place.material, rule);
                image.undecided[image.index(x, y, s)] = estimate.spread > most_spread;
            }
    return image;
}

}  // namespace

ImageSet ssao_model(const StageInput& input, const Settings& settings) {
    const Scene scene(input, settings.as<SsaoParams>());
    const bool is_half = scene.params.resolution == resolution_half;
    Estimates made(scene, is_half ? 2 : 1);
    fill(scene, made, [&](std::uint32_t x, std::uint32_t y, std::uint32_t s) {
        return Estimator(scene, made.pixel(x, y), s, {x, y}).run();
    });
    if (scene.params.blur != 0) {
        const Estimates from = made;
        fill(scene, made, [&](std::uint32_t x, std::uint32_t y, std::uint32_t s) { return blurred(scene, from, {x, y}, s); });
    }
    if (is_half) {
        const Estimates from = std::exchange(made, Estimates(scene, 1));
        fill(scene, made, [&](std::uint32_t x, std::uint32_t y, std::uint32_t s) { return upsampled(scene, from, {x, y}, s); });
    }
    return {{"occlusion", image_of(scene, made)}};
}

}  // namespace strata::occlusion
