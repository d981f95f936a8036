#include "capture_format/container/compression.h"

#include <new>
#include <stdexcept>

#include <zstd.h>
#include <zstd_errors.h>

namespace strata {
namespace {

bool lacks_memory(std::size_t code) { return ZSTD_getErrorCode(code) == ZSTD_error_memory_allocation; }

/// The number that zstd returned, unless it is an error.
std::size_t checked(std::size_t code) {
    if (lacks_memory(code)) throw std::bad_alloc();
    if (ZSTD_isError(code)) throw std::logic_error(ZSTD_getErrorName(code));  // the room is what zstd asked for
    return code;
}

/// The size of the frame, or zstd's code of an error.
std::size_t compress(ZSTD_CCtx* context, std::span<const std::span<const std::byte>> parts, ZSTD_outBuffer out,
                     unsigned threads) {
    std::uint64_t sum = 0;
    for (const auto part : parts) sum += part.size();
    checked(ZSTD_CCtx_reset(context, ZSTD_reset_session_and_parameters));
    checked(ZSTD_CCtx_setParameter(context, ZSTD_c_compressionLevel, compression_level));
    checked(ZSTD_CCtx_setPledgedSrcSize(context, sum));
    // A zstd that was built without threads refuses this, and uses none. How many there are does not change the bytes.
    if (threads > 0) static_cast<void>(ZSTD_CCtx_setParameter(context, ZSTD_c_nbWorkers, static_cast<int>(threads)));
    for (std::size_t i = 0; i < parts.size(); ++i) {
        ZSTD_inBuffer in = {parts[i].data(), parts[i].size(), 0};
        const bool is_last = i + 1 == parts.size();
        std::size_t left = 1;
        while (in.pos < in.size || (is_last && left > 0)) {
            left = ZSTD_compressStream2(context, &out, &in, is_last ? ZSTD_e_end : ZSTD_e_continue);
            if (ZSTD_isError(left)) return left;
        }
    }
    return out.pos;
}

}  // namespace

void Compression::End::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }

ZSTD_CCtx_s* Compression::context() {
    if (!context_) context_.reset(ZSTD_createCCtx());
    if (!context_) throw std::bad_alloc();
    return context_.get();
}

void Compression::append(std::vector<std::byte>& to, std::span<const std::byte> bytes, int level) {
    ZSTD_CCtx_s* const kept = context();
    const std::size_t before = to.size();
    to.resize(before + checked(ZSTD_compressBound(bytes.size())));
    to.resize(before + checked(ZSTD_compressCCtx(kept, &to[before], to.size() - before, bytes.data(), bytes.size(), level)));
}

void Compression::append(std::vector<std::byte>& to, std::span<const std::span<const std::byte>> parts, unsigned threads) {
    ZSTD_CCtx_s* const kept = context();
    std::size_t sum = 0;
    for (const auto part : parts) sum += part.size();
    // Cleared memory would be touched before it is used, and most of it never is.
    const std::size_t bound = checked(ZSTD_compressBound(sum));
    const auto packed = std::make_unique_for_overwrite<std::byte[]>(bound);
    const ZSTD_outBuffer out = {packed.get(), bound, 0};
    std::size_t size = compress(kept, parts, out, threads);
    if (lacks_memory(size) && threads > 0)
        size = compress(kept, parts, out, 0);  // zstd says so of a thread that does not start, too
    to.insert(to.end(), packed.get(), packed.get() + checked(size));
}

Result<void> check_frame_size(std::span<const std::byte> packed, std::uint64_t raw_bytes) {
    if (ZSTD_getFrameContentSize(packed.data(), packed.size()) == raw_bytes) return {};
    return fail(Fault::bad_input, "capture.section.zstd_size", "the section does not hold a zstd frame of {bytes} bytes",
                raw_bytes);
}

Result<void> decompress(std::span<const std::byte> packed, std::span<std::byte> raw) {
    const std::size_t written = ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size());
    if (written == raw.size()) return {};
    if (lacks_memory(written)) throw std::bad_alloc();
    return fail(Fault::bad_input, "capture.section.decompress", "the section does not decompress: {reason}",
                ZSTD_isError(written) ? ZSTD_getErrorName(written) : "it ends early");
}

}  // namespace strata
