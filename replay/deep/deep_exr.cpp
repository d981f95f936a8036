// Writes deep scan lines. OpenEXR's library makes the header; lines are packed here, on every core and by libdeflate, because
// packing them was half of an export's time.
//
//   file  = magic:u32  version:u32  header  offset:u64{height}  line{height}
//   line  = y:i32  packed counts:u64  packed samples:u64  samples:u64  counts  samples       all but the data are byte counts
//
// ("OpenEXR File Layout", deep scan line block.) Counts are running sums along the line; samples lie channel by channel.
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <sstream>

#include <ImfChannelList.h>
#include <ImfDeepImageStateAttribute.h>
#include <ImfHeader.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>
#include <libdeflate.h>

#include "replay/deep/deep_image.h"

namespace strata {
namespace {

// OpenEXR's own for ZIPS.
constexpr int compression_level = 4;
// Longer names of attributes need a flag in the version (OpenEXR File Layout, "Version Field").
constexpr std::size_t longest_short_name = 31;

/// A line's bytes, and what they are made from.
class LinePacker {
public:
    std::string pack(const DeepImage& image, std::span<const std::size_t> channels, std::size_t y) {
        const auto begin = std::span(image.begin).subspan(y * image.width, image.width + 1);
        raw_.clear();
        for (std::size_t x = 0; x < image.width; ++x) append(std::uint32_t(begin[x + 1] - begin[0]));
        const std::string counts = packed();
        raw_.clear();
        for (const std::size_t channel : channels)
            append_bytes(std::as_bytes(std::span(image.channels[channel].values).subspan(begin[0], begin.back() - begin[0])));
        const std::uint64_t samples_bytes = raw_.size();
        const std::string samples = packed();
        std::string line;
        const auto put = [&](auto value) { line.append(reinterpret_cast<const char*>(&value), sizeof value); };
        put(static_cast<std::int32_t>(y));
        put(std::uint64_t{counts.size()});
        put(std::uint64_t{samples.size()});
        put(samples_bytes);
        return line + counts + samples;
    }

private:
    struct Free {
        void operator()(libdeflate_compressor* freed) const { libdeflate_free_compressor(freed); }
    };

    void append(std::uint32_t value) { append_bytes(std::as_bytes(std::span(&value, 1))); }
    void append_bytes(std::span<const std::byte> bytes) { raw_.insert(raw_.end(), bytes.begin(), bytes.end()); }

    /// As ZIPS packs them: bytes at even places first, then differences, then deflate; as they are where that is not smaller.
    std::string packed() {
        deltas_.resize(raw_.size());
        const std::size_t even = (raw_.size() + 1) / 2;
        for (std::size_t i = 0; i < raw_.size(); ++i) deltas_[i % 2 * even + i / 2] = std::to_integer<std::uint8_t>(raw_[i]);
        for (std::size_t i = deltas_.size(); i-- > 1;) deltas_[i] = static_cast<std::uint8_t>(deltas_[i] - deltas_[i - 1] + 128);
        std::string packed(raw_.size(), '\0');
        packed.resize(libdeflate_zlib_compress(compressor_.get(), deltas_.data(), deltas_.size(), packed.data(), packed.size()));
        // 0 where it does not fit; as many bytes as there are would be read as not packed.
        if (packed.empty() || packed.size() == raw_.size())
            packed.assign(reinterpret_cast<const char*>(raw_.data()), raw_.size());
        return packed;
    }

    std::unique_ptr<libdeflate_compressor, Free> compressor_{libdeflate_alloc_compressor(compression_level)};
    std::vector<std::byte> raw_;
    std::vector<std::uint8_t> deltas_;
};

Imf::Header header_of(const DeepImage& image, const Metadata& metadata) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.setType(Imf::DEEPSCANLINE);
    header.setVersion(1);
    header.setChunkCount(static_cast<int>(image.height));
    header.compression() = Imf::ZIPS_COMPRESSION;
    for (const DeepImage::Channel& channel : image.channels)
        header.channels().insert(std::string(channel.name), Imf::Channel(Imf::FLOAT));
    Imf::addDeepImageState(header, Imf::DIS_SORTED);
    for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
    return header;
}

/// All that comes before the offsets of lines.
std::string head_of(const DeepImage& image, const Metadata& metadata) {
    const bool long_names = std::ranges::any_of(metadata, [](const auto& row) { return row.first.size() > longest_short_name; });
    const std::int32_t version = Imf::EXR_VERSION | Imf::NON_IMAGE_FLAG | (long_names ? Imf::LONG_NAMES_FLAG : 0);
    Imf::StdOSStream stream;
    for (const std::int32_t number : {std::int32_t{Imf::MAGIC}, version})
        stream.write(reinterpret_cast<const char*>(&number), sizeof number);
    header_of(image, metadata).writeTo(stream);
    return stream.str();
}

/// Places of the channels in the order of their names, which is the file's.
std::vector<std::size_t> channels_by_name(const DeepImage& image) {
    std::vector<std::size_t> order(image.channels.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [&](std::size_t i) { return image.channels[i].name; });
    return order;
}

}  // namespace

Result<std::string> deep_exr(const DeepImage& image, const Metadata& metadata) {
    std::string file;
    try {
        file = head_of(image, metadata);
    } catch (const std::exception& problem) {
        return fail(Fault::usage, "a deep image of {} x {} pixels cannot be made: {}", image.width, image.height, problem.what());
    }
    const std::vector<std::size_t> channels = channels_by_name(image);
    std::vector<std::string> lines(image.height);
    oneapi::tbb::enumerable_thread_specific<LinePacker> packers;
    oneapi::tbb::parallel_for(std::size_t{0}, lines.size(),
                              [&](std::size_t y) { lines[y] = packers.local().pack(image, channels, y); });
    std::uint64_t offset = file.size() + lines.size() * sizeof offset;
    for (const std::string& line : lines) {
        file.append(reinterpret_cast<const char*>(&offset), sizeof offset);
        offset += line.size();
    }
    file.reserve(offset);
    for (const std::string& line : lines) file += line;
    return file;
}

}  // namespace strata
