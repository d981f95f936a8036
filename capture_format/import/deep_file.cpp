// Unpacks blocks. A block's layout: line by line, channel by channel in the alphabet's order, the samples of the line.
#include "capture_format/import/deep_file.h"

#include <cstring>
#include <new>

#include <half.h>
#include <libdeflate.h>
#include <openexr.h>

#include "capture_format/import/deep_unpack.h"

namespace strata {
namespace {

// Deflate makes at most 1032 bytes of one; RLE makes 64. Whoever claims more is lying.
constexpr std::uint64_t largest_expansion = 1040;

std::uint32_t read_uint(const std::byte* from) {
    std::uint32_t value = 0;
    std::memcpy(&value, from, sizeof value);
    return value;
}

float read_value(exr_pixel_type_t type, const std::byte* from) {
    if (type == EXR_PIXEL_UINT) return static_cast<float>(read_uint(from));
    std::uint16_t bits = 0;
    std::memcpy(&bits, from, sizeof bits);
    return imath_half_to_float(bits);
}

}  // namespace

void DeepBlock::Storage::Free::operator()(libdeflate_decompressor* freed) const { libdeflate_free_decompressor(freed); }

Error DeepFile::damaged(const BlockLocation& place, const Error& error) {
    return within(error, "the block of pixels at ({x}, {y})", place.window.x, place.window.y);
}

Result<void> DeepFile::unpack(std::span<const std::byte> packed, std::vector<std::byte>& unpacked,
                              DeepBlock::Storage& storage) const {
    if (packed.size() == unpacked.size()) {
        std::ranges::copy(packed, unpacked.begin());
        return {};
    }
    storage.deltas.resize(unpacked.size());
    bool good = false;
    if (compression_ == EXR_COMPRESSION_RLE) good = unpack_rle(packed, storage.deltas);
    if (compression_ == EXR_COMPRESSION_ZIPS || compression_ == EXR_COMPRESSION_ZIP) {
        if (!storage.inflater) storage.inflater.reset(libdeflate_alloc_decompressor());
        if (!storage.inflater) throw std::bad_alloc();
        good = unpack_deflate(*storage.inflater, packed, storage.deltas);
    }
    if (!good)
        return fail(Fault::bad_input, "import.deep.unpack",
                    "the samples do not unpack to the {bytes} bytes that the block claims", unpacked.size());
    undo_deltas(storage.deltas, unpacked);
    return {};
}

Result<void> DeepFile::unpack_table(const BlockLocation& place, DeepBlock::Storage& storage) const {
    // At the right and lower border OpenEXR writes the table of a whole tile; only its beginning means something.
    const std::uint64_t pixels = std::uint64_t{place.window.width} * place.window.height;
    for (const std::uint64_t size : {place.table_pixels * sizeof(std::uint32_t), pixels * sizeof(std::uint32_t)}) {
        if (size > place.counts.size() * largest_expansion) continue;
        storage.counts.resize(size);
        if (unpack(place.counts, storage.counts, storage)) return {};
    }
    return damaged(place, fail(Fault::bad_input, "import.deep.count_table",
                               "the table of counts does not unpack to {pixels} pixels", pixels));
}

Result<void> DeepFile::unpack_counts(const BlockLocation& place, DeepBlock& block) const {
    const std::size_t pixels = std::size_t{place.window.width} * place.window.height;
    if (const auto done = unpack_table(place, block.storage); !done) return done;
    // Counts are running sums that begin anew in each line.
    block.window = place.window;
    block.begin.resize(pixels + 1);
    block.begin[0] = 0;
    std::uint64_t before = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (i % place.window.width == 0) before = block.begin[i];
        const std::uint64_t end = before + read_uint(&block.storage.counts[i * 4]);
        if (end < block.begin[i] || end > 0xffffffffu)
            return damaged(place,
                           fail(Fault::bad_input, "import.deep.counts_decrease", "the running sums of sample counts decrease"));
        block.begin[i + 1] = static_cast<std::uint32_t>(end);
    }
    if (block.begin[pixels] * sample_bytes_ != place.unpacked)
        return damaged(place, fail(Fault::bad_input, "import.deep.claimed_bytes",
                                   "the block counts {samples} samples of {sample_bytes} bytes but claims {bytes} bytes",
                                   block.begin[pixels], sample_bytes_, place.unpacked));
    return {};
}

Result<std::uint64_t> DeepFile::count_samples(const DeepWindow& window, std::uint64_t most) const {
    std::uint64_t sum = 0;
    DeepBlock block;
    for (const BlockLocation& place : blocks_) {
        if (!overlap(place.window, window)) continue;
        if (const auto done = unpack_counts(place, block); !done) return done.error();
        sum += block.begin.back();
    }
    if (sum > most)
        return fail(Fault::bad_input, "import.deep.too_many_samples", "the image has {samples} samples; the limit is {most}", sum,
                    most);
    return sum;
}

Result<DeepBlock> DeepFile::read(std::size_t index, DeepBlock reused) const {
    const BlockLocation& place = blocks_[index];
    if (const auto done = unpack_counts(place, reused); !done) return done.error();
    if (place.unpacked > place.samples.size() * largest_expansion)
        return damaged(place, fail(Fault::bad_input, "import.deep.expansion",
                                   "the block claims {bytes} bytes of samples in {packed_bytes} bytes", place.unpacked,
                                   place.samples.size()));
    reused.storage.bytes.resize(place.unpacked);
    if (const auto done = unpack(place.samples, reused.storage.bytes, reused.storage); !done) return damaged(place, done.error());
    set_planes(reused);
    return reused;
}

std::span<const float> DeepFile::plane(DeepBlock& block, std::size_t channel) const {
    const Stored& stored = channels_[channel];
    const auto type = static_cast<exr_pixel_type_t>(stored.type);
    const std::byte* bytes = block.storage.bytes.data();
    const std::size_t samples = block.begin.back(), width = block.window.width;
    const std::byte* first = bytes + samples * stored.bytes_before;
    if (type == EXR_PIXEL_FLOAT && block.window.height == 1 && reinterpret_cast<std::uintptr_t>(first) % alignof(float) == 0)
        return {reinterpret_cast<const float*>(first), samples};
    std::vector<float>& plane = block.storage.planes[channel];
    plane.resize(samples);
    for (std::size_t line = 0; line < block.window.height; ++line) {
        const std::size_t begin = block.begin[line * width], count = block.begin[(line + 1) * width] - begin;
        const std::byte* from = bytes + begin * sample_bytes_ + count * stored.bytes_before;
        if (type == EXR_PIXEL_FLOAT && count > 0) std::memcpy(&plane[begin], from, count * sizeof(float));
        for (std::size_t i = 0; type != EXR_PIXEL_FLOAT && i < count; ++i)
            plane[begin + i] = read_value(type, from + i * (type == EXR_PIXEL_HALF ? 2 : 4));
    }
    return plane;
}

void DeepFile::set_planes(DeepBlock& block) const {
    std::vector<std::vector<float>>& planes = block.storage.planes;
    planes.resize(channels_.size() + 2);
    const auto filled = [&](std::size_t which, float value) -> std::span<const float> {
        planes[channels_.size() + which].assign(block.begin.back(), value);
        return planes[channels_.size() + which];
    };
    const auto named = [&](DeepChannel channel) {
        return plane(block, static_cast<std::size_t>(source_[static_cast<std::size_t>(channel)]));
    };
    constexpr DeepChannel colors[] = {DeepChannel::red, DeepChannel::green, DeepChannel::blue};
    constexpr DeepChannel alphas[] = {DeepChannel::alpha_red, DeepChannel::alpha_green, DeepChannel::alpha_blue};
    const bool colored = has(DeepChannel::red) || has(DeepChannel::green) || has(DeepChannel::blue);
    block.color.fill(!colored && has(DeepChannel::gray) ? named(DeepChannel::gray) : filled(0, 0));
    block.alpha.fill(has(DeepChannel::alpha) ? named(DeepChannel::alpha) : filled(1, 1));
    for (std::size_t c = 0; c < 3; ++c) {
        if (has(colors[c])) block.color[c] = named(colors[c]);
        if (has(alphas[c])) block.alpha[c] = named(alphas[c]);
    }
    block.depth = named(DeepChannel::depth);
    block.back = has(DeepChannel::back) ? named(DeepChannel::back) : block.depth;
}

}  // namespace strata
