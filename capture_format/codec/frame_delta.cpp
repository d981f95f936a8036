// Packs and unpacks chains of frames. The grammar of a frame section's payload, version 2:
//
//   frame  = header  run{runs}  zstd frame
//   header = reach:u32  runs:u32  echo:i64  hash:u64                 hash is XXH3-64 of the flatbuffer
//   run    = from:u32  words:u32
//
// The flatbuffer is taken as 64-bit words. Runs say which words of the last frame the words of this one continue, from 0xffffffff
// for new ones; a key has none. Every word is forecast from the last four frames, and what it differs by is stored:
//
//   new           0
//   still         what it was, when it was so twice
//   echo          what the word `echo` before it was, when that held last time: previous_to_world repeats to_world
//   moving        a double goes on as it went, straight or around: the steps d of a point that turns by w obey
//                 d' + d''' = 2 cos(w) d''; anything else by the same difference
//
// Differences are zigzag coded (0, -1, 1, -2 ...), those of moving words first and the others behind them, each part byte by byte
// from the highest: so zeros meet zeros, and zstd finds next to nothing to store.
#include "capture_format/codec/frame_delta.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cfenv>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <utility>

#include <xxhash.h>

namespace strata {
namespace {

static_assert(FLT_EVAL_METHOD == 0, "a forecast must round the same way everywhere");

struct Header {
    std::uint32_t reach, runs;
    std::int64_t echo;
    std::uint64_t hash;
};
static_assert(sizeof(Header) == 24 && sizeof(FrameChain::Run) == 8);

/// Round to nearest, subnormals as they are, whatever the application has set for its own threads: a forecast that rounds
/// differently when read would be another frame.
class StandardArithmetic {
public:
    StandardArithmetic() {
        std::fegetenv(&before_);
        std::fesetenv(FE_DFL_ENV);
    }
    StandardArithmetic(const StandardArithmetic&) = delete;
    StandardArithmetic& operator=(const StandardArithmetic&) = delete;
    ~StandardArithmetic() { std::fesetenv(&before_); }

private:
    std::fenv_t before_;
};

double number(std::uint64_t word) { return std::bit_cast<double>(word); }

/// A double that sums and quotients leave far from overflow and underflow. Integers and pairs of floats rarely look like one.
bool is_number(std::uint64_t word) {
    const std::uint64_t exponent = word >> 52 & 0x7ff;
    return word << 1 == 0 || (exponent > 0x100 && exponent < 0x6ff);
}

/// The next value of a word that changed, from the values before it, newest first.
std::uint64_t continued(std::span<const std::uint64_t> was) {
    if (!std::ranges::all_of(was, is_number)) return 2 * was[0] - was[1];
    const double x0 = number(was[0]), x1 = number(was[1]), ahead = 2 * x0 - x1;
    if (was.size() < 4) return std::bit_cast<std::uint64_t>(ahead);
    const double x2 = number(was[2]), step0 = x0 - x1, step1 = x1 - x2, step2 = x2 - number(was[3]);
    // Steps that differ by rounding alone are those of a straight line.
    const bool straight = std::abs(step0 - step1) <= 0x1p-49 * (std::abs(x0) + std::abs(x1));
    const double twice_cosine = straight || step1 == 0 ? 2 : (step0 + step2) / step1;
    const bool turning = std::abs(twice_cosine) < 2;
    return std::bit_cast<std::uint64_t>(turning ? x0 + (twice_cosine * step0 - step1) : ahead);
}

std::uint64_t zigzag(std::uint64_t difference) { return difference << 1 ^ (0 - (difference >> 63)); }
std::uint64_t unzigzag(std::uint64_t folded) { return folded >> 1 ^ (0 - (folded & 1)); }

/// Flatbuffers are built from their end: what was there before keeps its distance from it when something is added.
std::vector<FrameChain::Run> end_to_end(std::size_t before, std::size_t now) {
    const auto kept = static_cast<std::uint32_t>(std::min(before, now));
    std::vector<FrameChain::Run> runs;
    if (now > before) runs.push_back({FrameChain::nowhere, static_cast<std::uint32_t>(now - before)});
    runs.push_back({static_cast<std::uint32_t>(before - kept), kept});
    return runs;
}

/// Calls visit(word, its place in the sorted bytes, from one byte of it to the next) for every word; `moving` ascends.
template <typename Visit>
void for_sorted(std::size_t words, std::span<const std::uint32_t> moving, const Visit& visit) {
    const std::size_t still = words - moving.size(), first_still = moving.size() * sizeof(std::uint64_t);
    for (std::size_t word = 0, before = 0; word < words; ++word) {
        if (before < moving.size() && moving[before] == word) {
            visit(word, before++, moving.size());
        } else {
            visit(word, first_still + word - before, still);
        }
    }
}

std::vector<std::byte> payload_of(const Header& header, std::span<const FrameChain::Run> runs, std::span<const std::byte> sorted,
                                  Compression& compression) {
    std::vector<std::byte> payload(sizeof(header) + runs.size_bytes());
    std::memcpy(payload.data(), &header, sizeof(header));
    if (!runs.empty()) std::memcpy(payload.data() + sizeof(header), runs.data(), runs.size_bytes());
    compression.append(payload, sorted);  // level 6 gains 4 % and takes twice as long
    return payload;
}

}  // namespace

void FrameChain::clear() {
    for (Words& frame : history_) frame = {};
    known_ = reach_ = 0;
}

void FrameChain::remember(Words frame) {
    std::rotate(history_.begin(), history_.end() - 1, history_.end());  // clang 14 cannot compile the one of std::ranges
    history_[0] = std::move(frame);
    known_ = std::min<std::uint32_t>(known_ + 1, static_cast<std::uint32_t>(history_.size()));
    reach_ = (reach_ + 1) % frames_per_key;
    if (reach_ == 0) known_ = 0;
}

/// Brings the frames before into the order of the next one.
void FrameChain::rearrange(std::span<const Run> runs) {
    if (runs.size() == 1 && runs[0].from == 0 && runs[0].words == history_[0].size()) return;
    for (Words& frame : std::span(history_).first(known_)) {
        Words ordered;
        for (const Run& run : runs) {
            if (run.from == nowhere) {
                ordered.resize(ordered.size() + run.words);
            } else {
                const auto first = frame.begin() + run.from;
                ordered.insert(ordered.end(), first, first + run.words);
            }
        }
        frame = std::move(ordered);
    }
}

/// Fills forecast_ and moving_ from the frames before.
void FrameChain::forecast(std::size_t words, std::ptrdiff_t echo) {
    const StandardArithmetic standard;
    moving_.clear();
    if (known_ == 0) return forecast_.assign(words, 0);
    forecast_ = history_[0];
    if (known_ == 1) return;
    for (std::size_t i = 0; i < words; ++i) {
        if (history_[0][i] == history_[1][i]) continue;
        const std::size_t source = i - static_cast<std::size_t>(echo);  // beyond the frame when it would lie before it
        if (source < words && history_[1][source] == history_[0][i]) {
            forecast_[i] = history_[0][source];
            continue;
        }
        std::array<std::uint64_t, 4> was{};
        for (std::size_t age = 0; age < known_; ++age) was[age] = history_[age][i];
        forecast_[i] = continued(std::span(was).first(known_));
        moving_.push_back(static_cast<std::uint32_t>(i));
    }
}

std::vector<std::byte> FrameChain::pack(std::span<const std::byte> raw, std::int64_t echo, std::vector<Run> runs) {
    assert(raw.size() % sizeof(std::uint64_t) == 0 && raw.size() <= largest_frame_section);
    Words words(raw.size() / sizeof(std::uint64_t));
    std::memcpy(words.data(), raw.data(), raw.size());
    if (reach_ == 0) runs.clear();
    if (reach_ > 0 && runs.empty()) runs = end_to_end(history_[0].size(), words.size());
    const Header header = {reach_, static_cast<std::uint32_t>(runs.size()), echo, XXH3_64bits(raw.data(), raw.size())};
    rearrange(runs);
    forecast(words.size(), echo);
    std::vector<std::byte> sorted(raw.size());
    for_sorted(words.size(), moving_, [&](std::size_t word, std::size_t place, std::size_t stride) {
        const std::uint64_t folded = zigzag(words[word] - forecast_[word]);
        if (folded == 0) return;  // as it is already; that is nine words in ten
        for (int byte = 7; byte >= 0; --byte, place += stride) sorted[place] = static_cast<std::byte>(folded >> 8 * byte);
    });
    remember(std::move(words));
    return payload_of(header, runs, sorted, compression_);
}

Result<std::uint32_t> FrameChain::reach(std::span<const std::byte> payload) {
    Header header{};
    if (payload.size() < sizeof(header))
        return fail(Fault::bad_input, "capture.frame.too_short", "the section is too short for a frame");
    std::memcpy(&header, payload.data(), sizeof(header));
    if (header.reach >= frames_per_key) {
        return fail(Fault::bad_input, "capture.frame.too_many_before",
                    "the frame builds on {reach} frames before it; the limit is {most}", header.reach, frames_per_key - 1);
    }
    return header.reach;
}

Result<std::span<const std::byte>> FrameChain::unpack(std::span<const std::byte> payload, std::uint64_t raw_bytes) {
    if (const Result<void> unpacked = continue_with(payload, raw_bytes); !unpacked) {
        clear();
        return unpacked.error();
    }
    return newest();
}

namespace {

/// The runs of a payload, which must make a frame of so many words out of the last one.
Result<std::vector<FrameChain::Run>> read_runs(std::span<const std::byte> stored, std::size_t before, std::size_t now) {
    std::vector<FrameChain::Run> runs(stored.size() / sizeof(FrameChain::Run));
    if (!runs.empty()) std::memcpy(runs.data(), stored.data(), stored.size());
    std::uint64_t sum = 0;
    for (const FrameChain::Run& run : runs) {
        if (run.from != FrameChain::nowhere && (run.from > before || run.words > before - run.from)) {
            return fail(Fault::bad_input, "capture.frame.run_range",
                        "a run of words starts at word {from} and has {words} words, in a frame of {frame_words}", run.from,
                        run.words, before);
        }
        sum += run.words;
    }
    if (sum != now)
        return fail(Fault::bad_input, "capture.frame.run_sum",
                    "the {runs} runs have {words} words together; the frame has {frame_words}", runs.size(), sum, now);
    return runs;
}

}  // namespace

Result<void> FrameChain::continue_with(std::span<const std::byte> payload, std::uint64_t raw_bytes) {
    const Result<std::uint32_t> needed = reach(payload);
    if (!needed) return needed.error();
    if (*needed == 0) clear();
    if (*needed != reach_)
        return fail(Fault::bad_input, "capture.frame.order", "the frame builds on {reach} frames before it, but follows {frames}",
                    *needed, reach_);
    Header header{};
    std::memcpy(&header, payload.data(), sizeof(header));
    payload = payload.subspan(sizeof(header));
    if (raw_bytes > largest_frame_section || raw_bytes % sizeof(std::uint64_t) != 0) {
        return fail(Fault::bad_input, "capture.frame.claimed_size",
                    "the section claims {bytes} bytes; a frame has whole words of 8 bytes and at most {most} bytes", raw_bytes,
                    largest_frame_section);
    }
    const std::uint64_t runs_bytes = std::uint64_t{header.runs} * sizeof(Run);
    if (runs_bytes > payload.size())
        return fail(Fault::bad_input, "capture.frame.runs_cut", "the section is too short for its {runs} runs", header.runs);
    const std::span<const std::byte> packed = payload.subspan(runs_bytes);
    if (const auto sized = check_frame_size(packed, raw_bytes); !sized) return sized;
    const std::size_t count = raw_bytes / sizeof(std::uint64_t);
    if (*needed > 0) {
        const auto runs = read_runs(payload.first(runs_bytes), history_[0].size(), count);
        if (!runs) return runs.error();
        rearrange(*runs);
    }
    std::vector<std::byte> sorted(raw_bytes);
    if (const auto done = decompress(packed, sorted); !done) return done;
    forecast(count, header.echo);
    Words words(count);
    for_sorted(count, moving_, [&](std::size_t word, std::size_t place, std::size_t stride) {
        std::uint64_t folded = 0;
        for (int byte = 0; byte < 8; ++byte, place += stride) folded = folded << 8 | static_cast<std::uint64_t>(sorted[place]);
        words[word] = forecast_[word] + unzigzag(folded);
    });
    if (XXH3_64bits(words.data(), raw_bytes) != header.hash)
        return fail(Fault::bad_input, "capture.frame.hash", "the frame is not the one that was recorded: its hash is wrong");
    remember(std::move(words));
    return {};
}

}  // namespace strata
