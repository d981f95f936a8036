#include "passes/transparency/truth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <ranges>
#include <utility>
#include <vector>

#include "passes/stage_input.h"
#include "passes/transparency/distortion/model.h"

namespace strata {

glm::dvec3 exact_blend(std::span<const Fragment> fragments, glm::dvec3 behind) {
    return exact_blend(fragments, transparency::nearest_first_order(fragments), behind);
}

glm::dvec3 exact_blend(std::span<const Fragment> fragments, std::span<const std::size_t> nearest_first, glm::dvec3 behind) {
    glm::dvec3 color(0), through(1);
    for (const std::size_t i : nearest_first) {
        const Fragment& fragment = fragments[i];
        color += through * (fragment.color + fragment.emission);
        through *= fragment.transmittance;
    }
    return color + through * behind;
}

glm::dvec2 exact_distortion(std::span<const Fragment> fragments) {
    glm::dvec2 offset(0);
    glm::dvec3 through(1);
    for (const std::size_t i : transparency::nearest_first_order(fragments)) {
        const Fragment& fragment = fragments[i];
        offset += transparency::luminance(through) * fragment.distortion;
        through *= fragment.transmittance;
    }
    return offset;
}

namespace {

/// One place of the order: fragments of which one is there, or none.
struct Place {
    std::vector<const Fragment*> either;
    bool or_none = false;

    const Fragment& first() const { return *either.front(); }
};

/// Near to far.
std::vector<Place> places_of(std::span<const Fragment> fragments, std::span<const NearMiss> near_misses) {
    std::vector<Place> places;
    for (const Fragment& fragment : fragments) {
        places.push_back({{&fragment}, fragment.may_be_absent});
        for (const NearMiss& miss : near_misses)
            if (miss.instead_of == fragment.submission) places.back().either.push_back(&miss.fragment);
    }
    for (const NearMiss& miss : near_misses)
        if (!miss.instead_of) places.push_back({{&miss.fragment}, true});
    std::ranges::sort(places, [](const Place& a, const Place& b) {
        return std::pair(a.first().depth, b.first().submission) < std::pair(b.first().depth, a.first().submission);
    });
    return places;
}

/// Effect of a fragment on the radiance or the offset behind it: own + through * behind.
struct Effect {
    glm::dvec3 own{0}, through{1};
};
using EffectOf = Effect (*)(const Fragment&);

Effect on_radiance(const Fragment& f) { return {f.color + f.emission, f.transmittance}; }
Effect on_offset(const Fragment& f) {
    return {glm::dvec3(f.distortion, 0), glm::dvec3(transparency::luminance(f.transmittance))};
}

/// Radiance through a fragment rises with the radiance behind it, and so do offsets: ends of an interval become ends.
RadianceInterval seen_through(const Place& place, EffectOf effect_of, const RadianceInterval& behind) {
    RadianceInterval seen = behind;
    bool is_first = !place.or_none;
    for (const Fragment* fragment : place.either) {
        const auto [own, through] = effect_of(*fragment);
        const RadianceInterval one{own + through * behind.low, own + through * behind.high};
        seen = is_first ? one : RadianceInterval{glm::min(seen.low, one.low), glm::max(seen.high, one.high)};
        is_first = false;
    }
    return seen;
}

constexpr std::ptrdiff_t most_permuted = 5;

/// Through places of which floats cannot tell the order.
RadianceInterval seen_in_any_order(std::span<const Place> places, EffectOf effect_of, const RadianceInterval& behind) {
    std::vector<std::size_t> order(places.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto seen_in_order = [&] {
        RadianceInterval seen = behind;
        for (const std::size_t i : order | std::views::reverse) seen = seen_through(places[i], effect_of, seen);
        return seen;
    };
    RadianceInterval all = seen_in_order();
    const auto add = [&] {
        const RadianceInterval one = seen_in_order();
        all = {glm::min(all.low, one.low), glm::max(all.high, one.high)};
    };
    if (std::ssize(order) <= most_permuted) {
        while (std::ranges::next_permutation(order).found) add();
    } else {
        for (std::size_t i = 1; i < order.size(); ++i) {
            std::swap(order[i - 1], order[i]);
            add();
            std::swap(order[i - 1], order[i]);
        }
    }
    return all;
}

RadianceInterval seen_through_all(std::span<const Place> places, EffectOf effect_of, RadianceInterval seen) {
    for (std::size_t end = places.size(); end > 0;) {
        std::size_t begin = end - 1;
        while (begin > 0 && order_is_undecided(places[begin - 1].first(), places[begin].first())) --begin;
        seen = seen_in_any_order(places.subspan(begin, end - begin), effect_of, seen);
        end = begin;
    }
    return seen;
}

/// Offsets, in pixels of one axis, between which the light of two neighboring pixels is mixed, and the ends: there the least and
/// the largest lie. `at` is the pixel's place, offsets are in uv.
std::vector<double> turns_of_light(double low, double high, std::uint32_t at, std::uint32_t extent) {
    std::vector<double> offsets{low, high};
    const double here = at + 0.5;
    for (double center = std::ceil(here + low * extent - 0.5) + 0.5; center < here + high * extent; ++center)
        offsets.push_back((center - here) / extent);
    return offsets;
}

constexpr std::size_t most_turns = 16;

/// Radiance behind a sample's fragments, which may bend light; nothing where it may come from anywhere.
std::optional<RadianceInterval> seen_behind_all(const ReferenceImage& before, glm::uvec3 at, std::span<const Place> places) {
    const auto [low, high] = seen_through_all(places, on_offset, {});
    if (low == high && low == glm::dvec3(0)) {
        const glm::dvec3 straight(before.at(at.x, at.y, at.z));
        return RadianceInterval{straight, straight};
    }
    const std::vector<double> across = turns_of_light(low.x, high.x, at.x, before.width);
    const std::vector<double> down = turns_of_light(low.y, high.y, at.y, before.height);
    if (across.size() > most_turns || down.size() > most_turns) return {};
    RadianceInterval behind{glm::dvec3(HUGE_VAL), glm::dvec3(-HUGE_VAL)};
    for (const double x : across)
        for (const double y : down) {
            const transparency::BlendedSample seen = transparency::seen_behind(before, at, {x, y});
            if (seen.undecided) return {};
            behind = {glm::min(behind.low, seen.radiance), glm::max(behind.high, seen.radiance)};
        }
    return behind;
}

void add_alternatives(ReferenceImage& color, const ReferenceImage& before, const FragmentLists& lists) {
    for (std::uint32_t s = 0; s < color.layers; ++s)
        for (std::uint32_t y = 0; y < color.height; ++y)
            for (std::uint32_t x = 0; x < color.width; ++x) {
                if (!lists.undecided(x, y, s)) continue;
                const std::vector<Place> places = places_of(lists.at(x, y, s), lists.near_misses(x, y, s));
                const auto behind = seen_behind_all(before, {x, y, s}, places);
                if (!behind) continue;
                const std::size_t i = color.index(x, y, s);
                const auto [low, high] = seen_through_all(places, on_radiance, *behind);
                for (const glm::dvec3& end : {low, high}) color.alternatives.push_back({i, glm::dvec4(end, color.texels[i].w)});
            }
}

}  // namespace

RadianceInterval blend_interval(std::span<const Fragment> fragments, std::span<const NearMiss> near_misses, glm::dvec3 behind) {
    return seen_through_all(places_of(fragments, near_misses), on_radiance, {behind, behind});
}

ImageSet transparency_truth(const StageInput& input) {
    const ReferenceImage& before = input.before.at("color");
    const transparency::PlacedBlend blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind,
                                                glm::uvec3 at) -> transparency::BlendedSample {
        const glm::dvec2 offset = exact_distortion(fragments);
        if (offset == glm::dvec2(0)) return {exact_blend(fragments, behind)};
        const transparency::BlendedSample seen = transparency::seen_behind(before, at, offset);
        return {exact_blend(fragments, seen.radiance), seen.undecided};
    };
    std::optional<FragmentLists> own;
    const FragmentLists& lists = transparency::fragments_of(input, before, own);
    ReferenceImage color =
        transparency::blended(before, {input.frame, input.before, input.fragments ? input.fragments : &own}, blend);
    add_alternatives(color, before, lists);
    return {{"color", std::move(color)}};
}

}  // namespace strata
