#include "replay/deep/deep_image.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>

#include "passes/transparency/sample_blend.h"
#include "replay/plural.h"
#include "replay/session/drawn_by.h"

namespace strata {
namespace {

bool is_chromatic(const Fragment& fragment) {
    const glm::dvec3& t = fragment.transmittance;
    return t.x != t.y || t.y != t.z;
}

Result<void> refuse_chromatic(const FragmentLists& lists, std::uint32_t sample, const Frame& frame) {
    std::map<std::uint32_t, std::uint64_t> by_triangle;
    std::uint64_t count = 0;
    for (std::uint32_t y = 0; y < lists.height(); ++y)
        for (std::uint32_t x = 0; x < lists.width(); ++x)
            for (const Fragment& fragment : lists.at(x, y, sample))
                if (is_chromatic(fragment)) ++count, ++by_triangle[fragment.submission];
    if (count == 0) return {};
    std::map<std::string, std::uint64_t> by_draw;
    for (const auto& [triangle, fragments] : by_triangle) by_draw[drawn_by(frame, triangle)] += fragments;
    const auto most = std::ranges::max_element(by_draw, {}, [](const auto& entry) { return entry.second; });
    return fail(Fault::usage,
                "{} let red, green and blue through differently, {} of them of {}; a plain deep image has one alpha: choose "
                "--transmittance mean, or channels for AR, AG and AB besides",
                plural(count, "fragment"), most->second, most->first);
}

void set_sample(DeepImage& image, std::size_t i, const Fragment& fragment) {
    const glm::dvec3 color = fragment.color + fragment.emission, alpha = 1.0 - fragment.transmittance;
    const double values[] = {color.x,        color.y, color.z, (alpha.x + alpha.y + alpha.z) / 3,
                             fragment.depth, alpha.x, alpha.y, alpha.z};
    for (std::size_t c = 0; c < image.channels.size(); ++c) image.channels[c].values[i] = static_cast<float>(values[c]);
}

}  // namespace

Result<DeepImage> deep_image(const FragmentLists& lists, std::uint32_t sample, Transmittance transmittance, const Frame& frame) {
    if (transmittance == Transmittance::refused)
        if (const auto done = refuse_chromatic(lists, sample, frame); !done) return done.error();
    DeepImage image{.width = lists.width(), .height = lists.height(), .begin = {0}};
    for (std::uint32_t y = 0; y < lists.height(); ++y)
        for (std::uint32_t x = 0; x < lists.width(); ++x)
            image.begin.push_back(image.begin.back() + lists.at(x, y, sample).size());
    for (const std::string_view name : {"R", "G", "B", "A", "Z"}) image.channels.push_back({name, {}});
    if (transmittance == Transmittance::channels)
        for (const std::string_view name : {"AR", "AG", "AB"}) image.channels.push_back({name, {}});
    for (DeepImage::Channel& channel : image.channels) channel.values.resize(image.begin.back());
    oneapi::tbb::parallel_for(std::uint32_t{0}, lists.height(), [&](std::uint32_t y) {
        std::size_t next = image.begin[std::size_t{y} * image.width];
        for (std::uint32_t x = 0; x < lists.width(); ++x) {
            const std::span<const Fragment> fragments = lists.at(x, y, sample);
            for (const std::size_t i : transparency::nearest_first_order(fragments)) set_sample(image, next++, fragments[i]);
        }
    });
    return image;
}

}  // namespace strata
