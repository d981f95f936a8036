#include "replay/deep/deep_image.h"

#include <algorithm>
#include <exception>
#include <map>
#include <sstream>

#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepImageStateAttribute.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfHeader.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>

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

void add_sample(DeepImage& image, const Fragment& fragment) {
    const glm::dvec3 color = fragment.color + fragment.emission, alpha = 1.0 - fragment.transmittance;
    const double values[] = {color.x,        color.y, color.z, (alpha.x + alpha.y + alpha.z) / 3,
                             fragment.depth, alpha.x, alpha.y, alpha.z};
    for (std::size_t c = 0; c < image.channels.size(); ++c) image.channels[c].values.push_back(static_cast<float>(values[c]));
}

Imf::Header header_of(const DeepImage& image, const Metadata& metadata) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.setType(Imf::DEEPSCANLINE);
    header.compression() = Imf::ZIPS_COMPRESSION;
    for (const DeepImage::Channel& channel : image.channels)
        header.channels().insert(std::string(channel.name), Imf::Channel(Imf::FLOAT));
    Imf::addDeepImageState(header, Imf::DIS_SORTED);
    for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
    return header;
}

/// Line by line: the frame buffer's pointers are of one row, and its row stride is 0.
void write_lines(const DeepImage& image, Imf::DeepScanLineOutputFile& file) {
    std::vector<std::uint32_t> counts(image.width);
    std::vector<std::vector<const float*>> pointers(image.channels.size(), std::vector<const float*>(image.width));
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), sizeof(std::uint32_t), 0));
    for (std::size_t c = 0; c < image.channels.size(); ++c)
        buffer.insert(std::string(image.channels[c].name),
                      Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers[c].data()), sizeof(float*), 0, sizeof(float)));
    file.setFrameBuffer(buffer);
    for (std::size_t y = 0; y < image.height; ++y) {
        for (std::size_t x = 0; x < image.width; ++x) {
            const std::size_t pixel = y * image.width + x, begin = image.begin[pixel];
            counts[x] = static_cast<std::uint32_t>(image.begin[pixel + 1] - begin);
            for (std::size_t c = 0; c < pointers.size(); ++c) pointers[c][x] = image.channels[c].values.data() + begin;
        }
        file.writePixels(1);
    }
}

}  // namespace

Result<DeepImage> deep_image(const FragmentLists& lists, std::uint32_t sample, Transmittance transmittance, const Frame& frame) {
    if (transmittance == Transmittance::refused)
        if (const auto done = refuse_chromatic(lists, sample, frame); !done) return done.error();
    DeepImage image{.width = lists.width(), .height = lists.height(), .begin = {0}};
    for (const std::string_view name : {"R", "G", "B", "A", "Z"}) image.channels.push_back({name, {}});
    if (transmittance == Transmittance::channels)
        for (const std::string_view name : {"AR", "AG", "AB"}) image.channels.push_back({name, {}});
    for (std::uint32_t y = 0; y < lists.height(); ++y)
        for (std::uint32_t x = 0; x < lists.width(); ++x) {
            for (const Fragment& fragment : transparency::nearest_first(lists.at(x, y, sample))) add_sample(image, fragment);
            image.begin.push_back(image.channels[0].values.size());
        }
    return image;
}

Result<std::string> deep_exr(const DeepImage& image, const Metadata& metadata) {
    Imf::StdOSStream stream;
    try {
        Imf::DeepScanLineOutputFile file(stream, header_of(image, metadata));
        write_lines(image, file);
    } catch (const std::exception& problem) {
        return fail(Fault::usage, "a deep image of {} x {} pixels cannot be made: {}", image.width, image.height, problem.what());
    }
    return stream.str();
}

}  // namespace strata
