// Transparent fragments per sample, and the nearest surfaces. Rows are independent, so bits do not depend on threads.
#include "passes/reference/fragments.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame_features.h"
#include "passes/reference/blockers.h"
#include "passes/reference/lights.h"
#include "passes/reference/ordering.h"
#include "passes/reference/raster.h"
#include "passes/reference/surfaces.h"
#include "passes/reference/white_radiance.h"

namespace strata {
namespace {

// Depths a float cannot tell apart after an interpolation, relative: two ulps.
constexpr double depth_rounding = 0x1p-22;
// Device depth of a level triangle changes by no more in a pixel, relative, as doubles round.
constexpr double level_slope = 0x1p-40;
// Smaller coverage and emission than this is not a fragment (docs/algorithms/transparency.md 0.2).
constexpr double smallest_alpha = 1e-5, smallest_emission = 1e-6;

double finite(double value) { return std::isfinite(value) ? value : 0; }
glm::dvec3 finite(const glm::dvec3& v) { return {finite(v.x), finite(v.y), finite(v.z)}; }

struct LitFrame {
    LitFrame(const Frame& f, LightAround a) : frame(f), around(std::move(a)), white(around ? white_radiance(f) : 0) {
        for (const Light& light : f.lights) blockers.push_back(light_blockers(f, light));
    }
    const Frame& frame;
    LightAround around;
    double white;                         ///< 0: no volumes light particles
    std::vector<LightBlockers> blockers;  ///< of Frame::lights; none stops the sun
};

// Radiance a transparent mesh reflects with blockers and without shadows; unlit surfaces show their base color.
glm::dvec3 lit(const LitFrame& scene, const SurfacePoint& surface) {
    const Frame& frame = scene.frame;
    if (surface.model == LightingModel::unlit) return surface.base_color * frame.pre_exposure;
    glm::dvec3 sum = hemisphere_light(frame, surface);
    const Light sun = sun_light(frame);
    if (sun.intensity != glm::vec3(0)) sum += reflected(frame, surface, sun);
    const glm::dvec3 off = off_surface(surface.position, facing_normal(surface));
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
        if (lets_through(scene.blockers[i], light_point(frame, frame.lights[i]), off))
            sum += reflected(frame, surface, frame.lights[i]);
    if (scene.around) {
        const glm::dvec3 albedo = surface.base_color * (1 - surface.metallic) * surface.occlusion;
        sum += albedo * scene.around(surface.position, facing_normal(surface));
    }
    return sum;
}

Fragment fragment_of(AlphaMode mode, double alpha, const SurfacePoint& surface, const glm::dvec3& light) {
    Fragment result;
    if (mode == AlphaMode::additive) {
        result.emission = alpha * (light + surface.emissive);
        return result;
    }
    result.alpha = alpha;
    result.transmittance = 1.0 - alpha * (1.0 - surface.transmission);
    result.color = mode == AlphaMode::premultiplied ? light + alpha * surface.emissive : alpha * (light + surface.emissive);
    return result;
}

// The color a particle is recorded with, already lit, and what its albedo makes of light around it: the same color over the
// radiance of a white surface.
glm::dvec3 particle_color(const LitFrame& scene, const SurfacePoint& surface) {
    if (scene.white == 0) return surface.base_color;
    const glm::dvec3 albedo = glm::clamp(surface.base_color / scene.white, 0.0, 1.0);
    return surface.base_color + albedo * scene.around(surface.position, glm::dvec3(0));
}

// surface.base_color is c, its emissive e before fading.
Fragment particle_fragment(AlphaMode mode, double particle_alpha, const SurfacePoint& surface, double fade) {
    const double alpha = std::clamp(finite(surface.alpha * fade), 0.0, 1.0);
    Fragment result;
    result.emission = surface.emissive * fade;
    if (mode == AlphaMode::additive) {
        result.emission += alpha * surface.base_color;
        return result;
    }
    result.alpha = alpha;
    result.transmittance = glm::dvec3(1 - alpha);
    result.color = surface.base_color * (mode == AlphaMode::premultiplied ? particle_alpha * fade : alpha);
    return result;
}

double brightest(const glm::dvec3& color) { return std::max({color.x, color.y, color.z}); }

void fog(const Frame& frame, const glm::dvec3& position, Fragment& fragment) {
    const FogAt at = fog_at(frame, fog_way(frame.fog.path, position));
    fragment.fog = at.remains;
    fragment.color = fragment.color * at.remains + (1.0 - fragment.transmittance) * at.added;
    fragment.emission *= at.remains;
}

// The fragment of a point, or nothing where it is too faint to count.
std::optional<Fragment> fragment_at(const LitFrame& scene, const RasterPoint& point, const RasterTriangle& triangle,
                                    double opaque_depth) {
    const Frame& frame = scene.frame;
    const double z = double(frame.view.near) / point.depth;
    if (!std::isfinite(z)) return std::nullopt;
    SurfacePoint surface = surface_at(frame, point, triangle.corners);
    Fragment fragment;
    double depth_offset = 0;
    if (const Material* material = material_of(frame, point.draw)) {
        const double alpha = std::clamp(finite(surface.alpha), 0.0, 1.0);
        fragment = fragment_of(material->alpha_mode, alpha, surface, lit(scene, surface));
        fragment.distortion = double(material->distortion) * glm::dvec2(surface.normal.x, -surface.normal.y);
    } else {
        const Emitter& emitter = frame.emitters[point.draw - frame.draws.size()];
        const Particle& particle = emitter.particles[point.triangle / 2];
        if (!std::isfinite(particle.depth_offset)) return std::nullopt;  // it is at no depth
        const double room = double(frame.view.near) / opaque_depth - z;
        const bool soft = emitter.soft_depth_fade > 0 && opaque_depth > 0;
        const double fade = soft ? std::clamp(room / double(emitter.soft_depth_fade), 0.0, 1.0) : 1.0;
        surface.base_color = particle_color(scene, surface);
        fragment = particle_fragment(emitter.alpha_mode, particle.alpha, surface, fade);
        fragment.soft_fade = double(emitter.soft_depth_fade);
        depth_offset = particle.depth_offset;
    }
    fog(frame, surface.position, fragment);
    fragment.color = finite(fragment.color);
    fragment.emission = finite(fragment.emission);
    if (fragment.alpha < smallest_alpha && brightest(fragment.color) < smallest_alpha &&
        brightest(fragment.emission) < smallest_emission && fragment.distortion == glm::dvec2(0))
        return std::nullopt;
    fragment.depth = z - depth_offset;
    fragment.submission = triangle.ordinal;
    return fragment;
}

enum class DepthTest { fails, passes, undecided_fails, undecided_passes };

// GREATER_OR_EQUAL on floats.
DepthTest depth_test(const RasterPoint& point, double opaque_depth) {
    const bool passes = static_cast<float>(point.depth) >= static_cast<float>(opaque_depth);
    const bool close = opaque_depth > 0 && std::abs(point.depth - opaque_depth) <= depth_tolerance(point);
    if (close) return passes ? DepthTest::undecided_passes : DepthTest::undecided_fails;
    return passes ? DepthTest::passes : DepthTest::fails;
}

// Fragments of one row in the order they were found, with the sample each belongs to.
struct FoundRow {
    std::vector<Fragment> fragments;
    std::vector<std::uint32_t> slots;
    std::vector<std::size_t> next;  ///< where a slot's next fragment goes
    /// Points whose side of a triangle is undecided, each with its place in `fragments` or, beside the triangle, in near_misses.
    std::vector<std::pair<RasterPoint, std::size_t>> inside, beside;
};

// Pairs near misses with the fragments whose triangles continue theirs across a side near the sample: one of both is surely
// there.
void pair_neighbors(FoundRow& found, std::vector<NearMiss>& near_misses) {
    const auto slot_of = [&](const auto& other) { return near_misses[other.second].slot; };
    std::ranges::stable_sort(found.beside, {}, slot_of);
    for (const auto& here : found.inside) {
        const auto of_sample = std::ranges::equal_range(found.beside, found.slots[here.second], {}, slot_of);
        const auto neighbor = std::ranges::find_if(of_sample, [&](const auto& other) {
            return !near_misses[other.second].instead_of && share_a_side(here.first, other.first);
        });
        if (neighbor == of_sample.end()) continue;
        Fragment& fragment = found.fragments[here.second];
        fragment.may_be_absent = false;
        near_misses[neighbor->second].instead_of = fragment.submission;
    }
}

// `sorted` is memory to reuse.
bool order_is_undecided(std::span<const Fragment> list, std::vector<const Fragment*>& sorted) {
    sorted.resize(list.size());
    std::transform(list.begin(), list.end(), sorted.begin(), [](const Fragment& f) { return &f; });
    std::ranges::sort(sorted, {}, [](const Fragment* f) { return std::pair(f->depth, f); });
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (strata::order_is_undecided(*sorted[i - 1], *sorted[i])) return true;
    return false;
}

}  // namespace

void rasterize(const Frame& frame, std::span<const std::uint32_t> draws, RasterOptions options,
               const std::function<void(const RasterPoint&)>& visit) {
    const Raster raster(frame, draws);
    oneapi::tbb::parallel_for(std::uint32_t{0}, frame.view.height, [&](std::uint32_t y) {
        raster.row(y, options, [&](const RasterPoint& point, const RasterTriangle&) { visit(point); });
    });
}

std::vector<bool> samples_near_sides(const Frame& frame, double steps) {
    const View& view = frame.view;
    std::vector<std::uint32_t> draws = opaque_draws(frame);
    std::ranges::copy(transparent_draws(frame), std::back_inserter(draws));
    const Raster raster(frame, draws, steps);
    std::vector<std::uint8_t> near(std::size_t(view.width) * view.height * view.samples);  // rows write beside each other
    oneapi::tbb::parallel_for(std::uint32_t{0}, view.height, [&](std::uint32_t y) {
        raster.row(y, {.near_misses = true}, [&](const RasterPoint& point, const RasterTriangle&) {
            if (point.undecided) near[(std::size_t(point.sample) * view.height + y) * view.width + point.x] = 1;
        });
    });
    return {near.begin(), near.end()};
}

std::vector<std::uint32_t> opaque_draws(const Frame& frame) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < frame.draws.size(); ++i) {
        const AlphaMode mode = material_of(frame, i)->alpha_mode;
        if (!is_transparent(mode)) result.push_back(i);
    }
    return result;
}

std::vector<std::uint32_t> transparent_draws(const Frame& frame) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < frame.draws.size(); ++i) {
        const AlphaMode mode = material_of(frame, i)->alpha_mode;
        if (is_transparent(mode)) result.push_back(i);
    }
    const std::size_t meshes = result.size();
    result.resize(meshes + frame.emitters.size());
    std::iota(result.begin() + static_cast<std::ptrdiff_t>(meshes), result.end(), static_cast<std::uint32_t>(frame.draws.size()));
    return result;
}

FragmentLists::FragmentLists(std::uint32_t width, std::uint32_t height, std::uint32_t samples)
    : width_(width), height_(height), samples_(samples), rows_(height) {
    const std::size_t slots = std::size_t(width) * samples;
    for (FragmentRow& row : rows_) {
        row.begin.assign(slots + 1, 0);
        row.undecided.assign(slots, 0);
    }
}

std::span<const Fragment> FragmentLists::at(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    return rows_[y].at(std::size_t(x) * samples_ + sample);
}

bool FragmentLists::undecided(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    return rows_[y].undecided[std::size_t(x) * samples_ + sample] != 0;
}

std::span<const NearMiss> FragmentLists::near_misses(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    const auto found = std::ranges::equal_range(rows_[y].near_misses, x * samples_ + sample, {}, &NearMiss::slot);
    return {found.begin(), found.end()};
}

std::uint64_t FragmentLists::total() const {
    return std::accumulate(rows_.begin(), rows_.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const FragmentRow& row) { return sum + row.fragments.size(); });
}

void FragmentLists::scale_light(double factor) {
    if (factor == 1) return;
    const auto scale = [factor](Fragment& fragment) {
        fragment.color *= factor;
        fragment.emission *= factor;
    };
    for (FragmentRow& row : rows_) {
        std::ranges::for_each(row.fragments, scale);
        std::ranges::for_each(row.near_misses, scale, &NearMiss::fragment);
    }
}

std::uint32_t FragmentLists::deepest() const {
    std::size_t most = 0;
    for (const FragmentRow& row : rows_) {
        for (std::size_t i = 1; i < row.begin.size(); ++i) most = std::max(most, row.begin[i] - row.begin[i - 1]);
    }
    return static_cast<std::uint32_t>(most);
}

struct FragmentRows::Scene {
    Scene(const Frame& f, const ReferenceImage& d, LightAround around, std::span<const std::uint32_t> draws)
        : lit(f, std::move(around)),
          depth(d),
          raster(f, draws.empty() ? transparent_draws(f) : std::vector(draws.begin(), draws.end())),
          has_interfaces(frame_features(f).has(Feature::interface_layers)) {}

    LitFrame lit;
    const ReferenceImage& depth;
    Raster raster;
    bool has_interfaces;
    /// Kept, because fresh pages for every row take longer than the fragments.
    mutable oneapi::tbb::enumerable_thread_specific<FoundRow> found = {};
};

FragmentRows::FragmentRows(const Frame& frame, const ReferenceImage& depth, LightAround around,
                           std::span<const std::uint32_t> draws)
    : scene_(std::make_unique<const Scene>(frame, depth, std::move(around), draws)) {}
FragmentRows::FragmentRows(FragmentRows&&) noexcept = default;
FragmentRows::~FragmentRows() = default;

const View& FragmentRows::view() const { return scene_->lit.frame.view; }

void FragmentRows::fill(std::uint32_t y, FragmentRow& row) const {
    const Frame& frame = scene_->lit.frame;
    const std::uint32_t samples = frame.view.samples;
    const std::size_t slots = std::size_t(frame.view.width) * samples;
    row.begin.assign(slots + 1, 0);
    row.undecided.assign(slots, 0);
    FoundRow& found = scene_->found.local();
    found.fragments.clear();
    found.slots.clear();
    found.inside.clear();
    found.beside.clear();
    row.near_misses.clear();
    scene_->raster.row(y, {.near_misses = true}, [&](const RasterPoint& point, const RasterTriangle& triangle) {
        const double opaque_depth = scene_->depth.at(point.x, point.y, point.sample).x;
        const DepthTest test = depth_test(point, opaque_depth);
        if (test == DepthTest::fails) return;
        std::optional<Fragment> fragment = fragment_at(scene_->lit, point, triangle, opaque_depth);
        if (!fragment) return;
        if (scene_->has_interfaces) {
            fragment->layer = layer_of(frame, point.draw);
            fragment->depth = ordering_depth(frame, fragment->layer, fragment->depth);
        }
        const std::uint32_t slot = point.x * samples + point.sample;
        fragment->may_be_absent = point.undecided || test != DepthTest::passes;
        fragment->is_level = point.depth_slope <= point.depth * level_slope;
        if (fragment->may_be_absent) row.undecided[slot] = 1;
        if (!point.covered || test == DepthTest::undecided_fails) {
            if (test == DepthTest::passes) found.beside.emplace_back(point, row.near_misses.size());
            row.near_misses.push_back({slot, *fragment});
            return;
        }
        if (test == DepthTest::passes && point.undecided) found.inside.emplace_back(point, found.fragments.size());
        found.fragments.push_back(*fragment);
        found.slots.push_back(slot);
        ++row.begin[slot + 1];
    });
    pair_neighbors(found, row.near_misses);
    std::ranges::stable_sort(row.near_misses, {}, &NearMiss::slot);
    for (std::size_t i = 1; i < row.begin.size(); ++i) row.begin[i] += row.begin[i - 1];
    row.fragments.resize(found.fragments.size());
    found.next.assign(row.begin.begin(), row.begin.end() - 1);
    for (std::size_t i = 0; i < found.fragments.size(); ++i) row.fragments[found.next[found.slots[i]]++] = found.fragments[i];
}

bool order_is_undecided(const Fragment& nearer, const Fragment& farther) {
    const double gap = std::abs(farther.depth - nearer.depth);
    const bool commute = nearer.transmittance == glm::dvec3(1) && farther.transmittance == glm::dvec3(1);
    const bool is_tie = gap == 0 && nearer.is_level && farther.is_level;
    return !commute && !is_tie && gap <= std::abs(farther.depth) * depth_rounding;
}

FragmentLists transparent_fragments(const Frame& frame, const ReferenceImage& depth, PixelRows rows, LightAround around,
                                    std::span<const std::uint32_t> draws) {
    FragmentLists lists(frame.view.width, frame.view.height, frame.view.samples);
    const FragmentRows made(frame, depth, std::move(around), draws);
    const std::uint32_t end = std::min(rows.end, frame.view.height);
    oneapi::tbb::enumerable_thread_specific<std::vector<const Fragment*>> sorted;
    oneapi::tbb::parallel_for(std::min(rows.begin, end), end, [&](std::uint32_t y) {
        FragmentRow& row = lists.rows_[y];
        made.fill(y, row);
        for (std::size_t slot = 0; slot < row.undecided.size(); ++slot)
            if (order_is_undecided(row.at(slot), sorted.local())) row.undecided[slot] = 1;
    });
    return lists;
}

}  // namespace strata
