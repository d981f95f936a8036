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
#include <cassert>
#include <cstring>
#include <exception>
#include <memory>
#include <new>

#include <ImfChannelList.h>
#include <ImfDeepImageStateAttribute.h>
#include <ImfHeader.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfVersion.h>
#include <libdeflate.h>

#include "replay/deep/deep_image.h"
#include "replay/images/exr_bytes.h"

namespace strata {
namespace {

// OpenEXR's own for ZIPS.
constexpr int compression_level = 4;
// Longer names of attributes need a flag in the version (OpenEXR File Layout, "Version Field").
constexpr std::size_t longest_short_name = 31;

/// A line's bytes, and what they are made from.
class LinePacker {
public:
    std::string pack(const DeepLine& source, std::size_t y) {
        const std::string counts = packed(std::as_bytes(std::span(source.ends)));
        const auto values = std::as_bytes(std::span(source.values));
        const std::string samples = packed(values);
        std::string line;
        const auto put = [&](auto value) { line.append(reinterpret_cast<const char*>(&value), sizeof value); };
        put(static_cast<std::int32_t>(y));
        put(std::uint64_t{counts.size()});
        put(std::uint64_t{samples.size()});
        put(std::uint64_t{values.size()});
        return line + counts + samples;
    }

private:
    struct Free {
        void operator()(libdeflate_compressor* freed) const { libdeflate_free_compressor(freed); }
    };

    /// As ZIPS packs them: bytes at even places first, then differences, then deflate; as they are where that is not smaller.
    std::string packed(std::span<const std::byte> bytes) {
        halves_.resize(bytes.size());
        deltas_.resize(bytes.size());
        const std::size_t odd = bytes.size() / 2, even = bytes.size() - odd;
        for (std::size_t i = 0; i < odd; ++i) {
            halves_[i] = std::to_integer<std::uint8_t>(bytes[2 * i]);
            halves_[even + i] = std::to_integer<std::uint8_t>(bytes[2 * i + 1]);
        }
        if (even > odd) halves_[odd] = std::to_integer<std::uint8_t>(bytes.back());
        if (!bytes.empty()) deltas_[0] = halves_[0];
        for (std::size_t i = 1; i < bytes.size(); ++i) deltas_[i] = static_cast<std::uint8_t>(halves_[i] - halves_[i - 1] + 128);
        std::string packed(bytes.size(), '\0');
        if (!compressor_) throw std::bad_alloc();
        packed.resize(libdeflate_zlib_compress(compressor_.get(), deltas_.data(), deltas_.size(), packed.data(), packed.size()));
        // 0 where it does not fit; as many bytes as there are would be read as not packed.
        if (packed.empty() || packed.size() == bytes.size())
            packed.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return packed;
    }

    std::unique_ptr<libdeflate_compressor, Free> compressor_{libdeflate_alloc_compressor(compression_level)};
    std::vector<std::uint8_t> halves_, deltas_;
};

Imf::Header header_of(const DeepImage& image, const Metadata& metadata) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.lines.size()));
    header.setType(Imf::DEEPSCANLINE);
    header.setVersion(1);
    header.setChunkCount(static_cast<int>(image.lines.size()));
    header.compression() = Imf::ZIPS_COMPRESSION;
    for (const std::string_view channel : image.channels)
        header.channels().insert(std::string(channel), Imf::Channel(Imf::FLOAT));
    Imf::addDeepImageState(header, Imf::DIS_SORTED);
    for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
    return header;
}

/// All that comes before the offsets of lines.
std::string head_of(const DeepImage& image, const Metadata& metadata, ExrBytes& bytes) {
    const bool long_names = std::ranges::any_of(metadata, [](const auto& row) { return row.first.size() > longest_short_name; });
    const std::int32_t version = Imf::EXR_VERSION | Imf::NON_IMAGE_FLAG | (long_names ? Imf::LONG_NAMES_FLAG : 0);
    for (const std::int32_t number : {std::int32_t{Imf::MAGIC}, version})
        bytes.write(reinterpret_cast<const char*>(&number), sizeof number);
    header_of(image, metadata).writeTo(bytes);
    return bytes.take();
}

}  // namespace

Result<std::string> deep_exr(const DeepImage& image, const Metadata& metadata) {
    assert(std::ranges::is_sorted(image.channels));  // the file's header sorts their names, but not their values
    std::string file;
    ExrBytes bytes;
    try {
        file = head_of(image, metadata, bytes);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& problem) {
        bytes.rethrow_lack_of_memory(problem);
        return fail(Fault::usage, "deep.cannot_encode", "a deep image of {width} x {height} pixels cannot be made: {reason}",
                    image.width, image.lines.size(), problem.what());
    }
    std::vector<std::string> lines(image.lines.size());
    oneapi::tbb::enumerable_thread_specific<LinePacker> packers;
    oneapi::tbb::parallel_for(std::size_t{0}, lines.size(),
                              [&](std::size_t y) { lines[y] = packers.local().pack(image.lines[y], y); });
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
