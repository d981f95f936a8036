// Matches the matrices of draws, then grows each match into the bytes in front of it.
#include "capture_format/codec/draw_runs.h"

#include <algorithm>
#include <cstring>
#include <unordered_map>

#include <xxhash.h>

#include "capture_format/schema/capture_generated.h"

namespace strata {
namespace {

using Run = FrameChain::Run;
using Draws = flatbuffers::Vector<flatbuffers::Offset<schema::Draw>>;

constexpr std::size_t word = sizeof(std::uint64_t);

const Draws& draws_of(std::span<const std::byte> flatbuffer) { return *schema::GetFrame(flatbuffer.data())->draws(); }

bool same(const schema::DMat4& a, const schema::DMat4& b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

/// The draw before that each draw continues, or none.
std::vector<const schema::Draw*> partners(const Draws& before, const Draws& now) {
    std::unordered_multimap<std::uint64_t, const schema::Draw*> by_place;
    std::vector<const schema::Draw*> found(now.size());
    for (flatbuffers::uoffset_t i = 0; i < now.size(); ++i) {
        // Most often it has the same number, or the one after the last partner's.
        if (i < before.size() && same(*before.Get(i)->to_world(), *now.Get(i)->previous_to_world())) {
            found[i] = before.Get(i);
            continue;
        }
        if (by_place.empty())
            for (const schema::Draw* draw : before) by_place.emplace(XXH3_64bits(draw->to_world(), sizeof(schema::DMat4)), draw);
        const auto partner = by_place.find(XXH3_64bits(now.Get(i)->previous_to_world(), sizeof(schema::DMat4)));
        if (partner == by_place.end()) continue;
        found[i] = partner->second;
        by_place.erase(partner);  // draws in the same place are taken one by one
    }
    return found;
}

/// Where a draw's bytes lie in its flatbuffer, in words.
std::uint32_t place_of(const schema::Draw& draw, std::span<const std::byte> flatbuffer) {
    const auto* first = reinterpret_cast<const std::byte*>(std::min<const void*>(draw.to_world(), draw.previous_to_world()));
    return static_cast<std::uint32_t>(static_cast<std::size_t>(first - flatbuffer.data()) / word);
}

/// Appends words up to `end` that continue those up to `from_end`, as far back as there are any.
void extend(std::vector<Run>& runs, std::uint32_t& cursor, std::uint32_t end, std::uint32_t from_end) {
    const std::uint32_t words = end - cursor, known = std::min(words, from_end);
    if (known < words) runs.push_back({FrameChain::nowhere, words - known});
    cursor = end;
    if (known == 0) return;
    const std::uint32_t from = from_end - known;
    if (!runs.empty() && runs.back().from != FrameChain::nowhere && runs.back().from + runs.back().words == from) {
        runs.back().words += known;
    } else {
        runs.push_back({from, known});
    }
}

}  // namespace

std::vector<Run> draw_runs(std::span<const std::byte> before, std::span<const std::byte> now) {
    const Draws &old = draws_of(before), &fresh = draws_of(now);
    const std::vector<const schema::Draw*> found = partners(old, fresh);
    struct Match {
        std::uint32_t place, from;
    };
    std::vector<Match> matches;
    for (flatbuffers::uoffset_t i = 0; i < fresh.size(); ++i)
        if (found[i]) matches.push_back({place_of(*fresh.Get(i), now), place_of(*found[i], before)});
    std::ranges::sort(matches, {}, &Match::place);
    std::vector<Run> runs;
    std::uint32_t cursor = 0;
    constexpr std::uint32_t matrices = 2 * sizeof(schema::DMat4) / word;
    for (const Match& match : matches) extend(runs, cursor, match.place + matrices, match.from + matrices);
    // Behind the draws, towards the end flatbuffers are built from, lie the resources.
    extend(runs, cursor, static_cast<std::uint32_t>(now.size() / word), static_cast<std::uint32_t>(before.size() / word));
    return runs;
}

}  // namespace strata
