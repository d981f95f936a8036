#include "tests/support/deep_exr.h"

#include <map>
#include <sstream>

#include <ImfChannelList.h>
#include <ImfCompositeDeepScanLine.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineInputFile.h>
#include <ImfDeepScanLineOutputPart.h>
#include <ImfDeepTiledOutputPart.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStdIO.h>
#include <half.h>

namespace strata {
namespace {

Imf::PixelType type_of(const std::string& channel) {
    if (channel.ends_with(":half")) return Imf::HALF;
    return channel.ends_with(":uint") ? Imf::UINT : Imf::FLOAT;
}

Imf::Header header_of(const std::string& name, const DeepSource& source) {
    const Imath::Box2i data({source.at.x, source.at.y},
                            {source.at.x + int(source.width) - 1, source.at.y + int(source.height) - 1});
    const bool same = source.display_from == source.display_to;
    const Imath::Box2i display =
        same ? data : Imath::Box2i({source.display_from.x, source.display_from.y}, {source.display_to.x, source.display_to.y});
    Imf::Header header(display, data);
    if (!name.empty()) header.setName(name);
    header.setType(source.layout == DeepLayout::lines ? Imf::DEEPSCANLINE : Imf::DEEPTILE);
    if (source.layout == DeepLayout::tiles) header.setTileDescription(Imf::TileDescription(4, 3));
    header.compression() = source.packing == DeepPacking::none  ? Imf::NO_COMPRESSION
                           : source.packing == DeepPacking::rle ? Imf::RLE_COMPRESSION
                                                                : Imf::ZIPS_COMPRESSION;
    for (const std::string& channel : source.channels)
        header.channels().insert(channel.substr(0, channel.find(':')), Imf::Channel(type_of(channel)));
    return header;
}

/// The samples in the memory that OpenEXR writes from: a count per pixel, and a pointer per pixel and channel.
struct Planes {
    explicit Planes(const DeepSource& source) : counts(source.pixels.size()) {
        const Imath::Box2i window({source.at.x, source.at.y},
                                  {source.at.x + int(source.width) - 1, source.at.y + int(source.height) - 1});
        const std::size_t row = source.width;
        buffer.insertSampleCountSlice(Imf::Slice::Make(Imf::UINT, counts.data(), window, 4, 4 * row));
        for (std::size_t c = 0; c < source.channels.size(); ++c) {
            const Imf::PixelType type = type_of(source.channels[c]);
            std::vector<std::vector<std::byte>>& plane = values.emplace_back(source.pixels.size());
            std::vector<const void*>& rows = pointers.emplace_back(source.pixels.size());
            for (std::size_t i = 0; i < source.pixels.size(); ++i) {
                counts[i] = static_cast<std::uint32_t>(source.pixels[i].size());
                for (const std::vector<float>& sample : source.pixels[i]) append(plane[i], type, sample[c]);
                rows[i] = plane[i].data();
            }
            const std::size_t bytes = type == Imf::HALF ? 2 : 4;
            // The address of pixel (0, 0), which may lie outside of the window.
            const std::ptrdiff_t first = -(source.at.y * std::ptrdiff_t(row) + source.at.x) * std::ptrdiff_t(sizeof(void*));
            buffer.insert(
                source.channels[c].substr(0, source.channels[c].find(':')),
                Imf::DeepSlice(type, reinterpret_cast<char*>(rows.data()) + first, sizeof(void*), sizeof(void*) * row, bytes));
        }
    }

    static void append(std::vector<std::byte>& to, Imf::PixelType type, float value) {
        const Imath::half small(value);
        const auto whole = type == Imf::UINT ? static_cast<std::uint32_t>(value) : 0u;
        const void* from = type == Imf::HALF   ? static_cast<const void*>(&small)
                           : type == Imf::UINT ? static_cast<const void*>(&whole)
                                               : static_cast<const void*>(&value);
        const auto* bytes = static_cast<const std::byte*>(from);
        to.insert(to.end(), bytes, bytes + (type == Imf::HALF ? 2 : 4));
    }

    std::vector<std::uint32_t> counts;
    std::vector<std::vector<std::vector<std::byte>>> values;
    std::vector<std::vector<const void*>> pointers;
    Imf::DeepFrameBuffer buffer;
};

}  // namespace

std::string deep_file(const std::vector<std::pair<std::string, DeepSource>>& parts) {
    std::vector<Imf::Header> headers;
    for (const auto& [name, source] : parts) headers.push_back(header_of(name, source));
    Imf::StdOSStream stream;
    {
        Imf::MultiPartOutputFile file(stream, headers.data(), int(headers.size()));
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const DeepSource& source = parts[i].second;
            const Planes planes(source);
            if (source.layout == DeepLayout::lines) {
                Imf::DeepScanLineOutputPart part(file, int(i));
                part.setFrameBuffer(planes.buffer);
                part.writePixels(int(source.height));
            } else {
                Imf::DeepTiledOutputPart part(file, int(i));
                part.setFrameBuffer(planes.buffer);
                part.writeTiles(0, part.numXTiles() - 1, 0, part.numYTiles() - 1);
            }
        }
    }
    return stream.str();
}

std::string deep_file(const DeepSource& source) { return deep_file({{std::string(), source}}); }

std::string flat_file(std::uint32_t width, std::uint32_t height, glm::ivec2 at) {
    Imf::StdOSStream stream;
    {
        Imf::Header header{int(width) + at.x, int(height) + at.y};
        header.dataWindow().min = {at.x, at.y};
        header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
        Imf::OutputFile file(stream, header);
        std::vector<float> texels(std::size_t{width} * height);
        Imf::FrameBuffer buffer;
        buffer.insert("Z", Imf::Slice::Make(Imf::FLOAT, texels.data(), header.dataWindow(), 4, 4 * std::size_t{width}));
        file.setFrameBuffer(buffer);
        file.writePixels(int(height));
    }
    return stream.str();
}

OpenExrComposite openexr_composite(const std::filesystem::path& path) {
    Imf::DeepScanLineInputFile file(path.c_str());
    Imf::CompositeDeepScanLine composite;
    composite.addSource(&file);
    const Imath::Box2i window = composite.dataWindow();
    const auto width = std::size_t(window.max.x - window.min.x + 1), height = std::size_t(window.max.y - window.min.y + 1);
    std::vector<glm::vec4> texels(width * height);
    Imf::FrameBuffer buffer;
    const char* names[] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < 4; ++c)
        buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, reinterpret_cast<char*>(texels.data()) + c * sizeof(float), window,
                                                 sizeof(glm::vec4), sizeof(glm::vec4) * width));
    composite.setFrameBuffer(buffer);
    composite.readPixels(window.min.y, window.max.y);
    return {std::move(texels), {window.min.x, window.min.y}, width};
}

}  // namespace strata
