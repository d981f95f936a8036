// Row by row, because all fragments of a frame are six times as large as the image, and fresh memory takes as long as shading.
#include "replay/deep/deep_image.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "capture_format/view.h"
#include "passes/transparency/sample_blend.h"
#include "passes/transparency/truth.h"
#include "replay/session/drawn_by.h"

namespace strata {
namespace {

/// What a fragment gives to a channel.
struct ChannelValue {
    std::string_view name;
    double (*of)(const Fragment&);
    bool chromatic = false;  ///< only with Transmittance::channels
};

double alpha(const Fragment& fragment, glm::length_t c) { return 1.0 - fragment.transmittance[c]; }
double radiance(const Fragment& fragment, glm::length_t c) { return fragment.color[c] + fragment.emission[c]; }

constexpr ChannelValue channel_values[] = {
    {"A", [](const Fragment& f) { return (alpha(f, 0) + alpha(f, 1) + alpha(f, 2)) / 3; }},
    {"AB", [](const Fragment& f) { return alpha(f, 2); }, true},
    {"AG", [](const Fragment& f) { return alpha(f, 1); }, true},
    {"AR", [](const Fragment& f) { return alpha(f, 0); }, true},
    {"B", [](const Fragment& f) { return radiance(f, 2); }},
    {"G", [](const Fragment& f) { return radiance(f, 1); }},
    {"R", [](const Fragment& f) { return radiance(f, 0); }},
    {"Z", [](const Fragment& f) { return f.depth; }},
};

std::vector<ChannelValue> channels_of(Transmittance transmittance) {
    std::vector<ChannelValue> channels;
    for (const ChannelValue& channel : channel_values)
        if (!channel.chromatic || transmittance == Transmittance::channels) channels.push_back(channel);
    return channels;
}

bool is_chromatic(const Fragment& fragment) {
    const glm::dvec3& t = fragment.transmittance;
    return t.x != t.y || t.y != t.z;
}

/// How many chromatic fragments each triangle has.
using ChromaticTriangles = std::map<std::uint32_t, std::uint64_t>;

Error chromatic_error(const ChromaticTriangles& triangles, const Frame& frame) {
    std::uint64_t count = 0;
    std::map<std::string, std::uint64_t> by_draw;
    for (const auto& [triangle, fragments] : triangles) count += fragments, by_draw[drawn_by(frame, triangle)] += fragments;
    const auto most = std::ranges::max_element(by_draw, {}, [](const auto& entry) { return entry.second; });
    return fail(Fault::usage, "deep.chromatic",
                "the transmittance of {fragments} fragments differs between red, green and blue ({most} of {draw}), and a plain "
                "deep image has one alpha: choose --transmittance mean, or channels for AR, AG and AB besides",
                count, most->second, most->first);
}

/// Makes lines; one per thread.
class LineMaker {
public:
    LineMaker(const FragmentRows& rows, std::uint32_t sample, Transmittance transmittance)
        : rows_(rows), sample_(sample), transmittance_(transmittance), channels_(channels_of(transmittance)) {}

    /// `blend` is the line's.
    DeepLine make(std::uint32_t y, std::span<glm::dvec3> blend) {
        rows_.fill(y, row_);
        sorted_.clear();
        DeepLine line;
        for (std::size_t x = 0; x < blend.size(); ++x) {
            const std::span<const Fragment> fragments = row_.at(x * rows_.view().samples + sample_);
            const std::vector<std::size_t> order = transparency::nearest_first_order(fragments);
            blend[x] = exact_blend(fragments, order, glm::dvec3(0));
            for (const std::size_t i : order) sorted_.push_back(&fragments[i]);
            line.ends.push_back(static_cast<std::uint32_t>(sorted_.size()));
        }
        line.values.reserve(sorted_.size() * channels_.size());
        for (const ChannelValue& channel : channels_)
            for (const Fragment* fragment : sorted_) line.values.push_back(static_cast<float>(channel.of(*fragment)));
        if (transmittance_ == Transmittance::refused)
            for (const Fragment* fragment : sorted_)
                if (is_chromatic(*fragment)) ++chromatic_[fragment->submission];
        return line;
    }
    const ChromaticTriangles& chromatic() const { return chromatic_; }

private:
    const FragmentRows& rows_;
    std::uint32_t sample_;
    Transmittance transmittance_;
    std::vector<ChannelValue> channels_;
    FragmentRow row_;
    std::vector<const Fragment*> sorted_;
    ChromaticTriangles chromatic_;
};

}  // namespace

std::uint64_t DeepImage::samples() const {
    return std::accumulate(lines.begin(), lines.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const DeepLine& line) { return sum + line.ends.back(); });
}

Result<DeepImage> deep_image(const FragmentRows& rows, std::uint32_t sample, Transmittance transmittance, const Frame& frame) {
    DeepImage image{.width = rows.view().width,
                    .channels = {},
                    .lines = std::vector<DeepLine>(rows.view().height),
                    .blend = std::vector<glm::dvec3>(std::size_t{rows.view().width} * rows.view().height)};
    for (const ChannelValue& channel : channels_of(transmittance)) image.channels.push_back(channel.name);
    oneapi::tbb::enumerable_thread_specific<LineMaker> makers([&] { return LineMaker(rows, sample, transmittance); });
    oneapi::tbb::parallel_for(std::uint32_t{0}, rows.view().height, [&](std::uint32_t y) {
        image.lines[y] = makers.local().make(y, std::span(image.blend).subspan(std::size_t{y} * image.width, image.width));
    });
    ChromaticTriangles chromatic;
    for (const LineMaker& maker : makers)
        for (const auto& [triangle, fragments] : maker.chromatic()) chromatic[triangle] += fragments;
    if (!chromatic.empty()) return chromatic_error(chromatic, frame);
    return image;
}

}  // namespace strata
