// The prefix sums and the sort of the lists of fragments on the device against the CPU: its own steps on lists made here.
// lavapipe 22.3 returned a bubble sort unsorted from 8 elements on; every length around its limits is tried.
#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <random>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "passes/graph/graph.h"
#include "passes/graph/plan.h"
#include "passes/transparency/lists/pixel_lists.h"
#include "tests/support/device.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using transparency::Band;
using transparency::cells_per_group;
using transparency::ListKey;
using transparency::ListSubmission;

template <typename T>
std::vector<T> values_of(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

struct Unsorted {
    std::vector<ListKey> keys;
    std::vector<ListSubmission> submissions;  ///< by ListKey::fragment
};

class ListsOnDevice : public testing::Test {
protected:
    template <typename T>
    Buffer import(Graph& graph, const char* name, const std::vector<T>& values) {
        const ImportId id{++imports_};
        const auto bytes = std::as_bytes(std::span(values));
        shared_executor().upload(id, bytes);
        return graph.import(name, bytes.size(), id);
    }

    std::vector<std::byte> run(const Graph& graph, const Buffer& wanted) {
        return shared_executor().run(must(compile(graph, ShaderLibrary::built_in())), {}).buffers.at(wanted.id);
    }

    /// Counts of one cell each become the places where the cells' lists start.
    std::vector<std::uint32_t> starts(const std::vector<std::uint32_t>& counts) {
        const auto cells = static_cast<std::uint32_t>(counts.size());
        const std::uint32_t groups = (cells + cells_per_group - 1) / cells_per_group;
        const Band band{0, 1, cells, 1, 0};
        Graph graph;
        transparency::PixelLists lists{.starts = graph.create("starts", cells * sizeof(std::uint32_t)),
                                       .ends = import(graph, "counts", counts),
                                       .group_starts = graph.create("group starts", groups * sizeof(std::uint32_t))};
        Buffer counters = graph.create("counters", sizeof(transparency::ListCounters));
        graph.clear(counters, 0);
        graph.offer("Counters", counters);
        transparency::place_lists(graph, lists, band);
        graph.keep(lists.starts);
        return values_of<std::uint32_t>(run(graph, lists.starts));
    }

    /// Lists of these lengths lie one after the other, one per cell.
    std::vector<ListKey> sorted(const std::vector<std::uint32_t>& lengths, const Unsorted& unsorted, std::uint32_t order) {
        const Band band{0, 1, static_cast<std::uint32_t>(lengths.size()), 1, static_cast<std::uint32_t>(unsorted.keys.size())};
        std::vector<std::uint32_t> starts, ends;
        for (const std::uint32_t length : lengths) {
            starts.push_back(ends.empty() ? 0 : ends.back());
            ends.push_back(starts.back() + length);
        }
        Graph graph;
        transparency::PixelLists lists{
            .starts = import(graph, "starts", starts), .ends = import(graph, "ends", ends), .layers = std::ranges::max(lengths)};
        transparency::create_keys(graph, lists, band.pool);
        graph.copy(import(graph, "keys", unsorted.keys), lists.keys);
        graph.copy(import(graph, "submissions", unsorted.submissions), lists.submissions);
        Buffer counters = graph.create("counters", sizeof(transparency::ListCounters));
        graph.clear(counters, 0);
        graph.offer("Counters", counters);
        transparency::sort_lists(graph, lists, band, order);
        graph.keep(lists.keys);
        return values_of<ListKey>(run(graph, lists.keys));
    }

    /// Of so many different depths: few, so that submission decides, too.
    void expect_all_sorted(const std::vector<std::uint32_t>& lengths, std::uint32_t depths);

private:
    std::uint64_t imports_ = 5000;  // ids are the device's: away from those of scenes
};

/// Seeded keys of so many different depths, in an order of their own.
Unsorted random_keys(std::size_t count, std::uint32_t depths) {
    std::mt19937 random(7);
    const auto below = [&](std::uint32_t limit) { return static_cast<std::uint32_t>(random() % limit); };
    Unsorted made;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t depth = below(depths), draw = below(3);
        made.keys.push_back({.z = .25f * float(depth), .fragment = i});
        made.submissions.push_back({.draw = draw, .primitive = i ^ 0x55u});
    }
    return made;
}

std::tuple<float, std::int64_t, std::int64_t> rank(const ListKey& key, const ListSubmission& s, std::uint32_t order) {
    if (order == transparency::list_order_submission) return {0, s.draw, s.primitive};
    return {key.z, -std::int64_t{s.draw}, -std::int64_t{s.primitive}};
}

void ListsOnDevice::expect_all_sorted(const std::vector<std::uint32_t>& lengths, std::uint32_t depths) {
    const Unsorted unsorted = random_keys(std::accumulate(lengths.begin(), lengths.end(), std::size_t{0}), depths);
    for (const std::uint32_t order : {transparency::list_order_depth, transparency::list_order_submission}) {
        std::vector<ListKey> wanted = unsorted.keys;
        const std::vector<ListKey> got = sorted(lengths, unsorted, order);
        std::size_t first = 0;
        for (const std::uint32_t length : lengths) {
            std::ranges::sort(std::span(wanted).subspan(first, length), {},
                              [&](const ListKey& key) { return rank(key, unsorted.submissions[key.fragment], order); });
            for (std::size_t i = first; i < first + length; ++i)
                ASSERT_EQ(got[i].fragment, wanted[i].fragment) << "at " << i - first << " of a list of " << length;
            first += length;
        }
    }
}

TEST_F(ListsOnDevice, AreSortedAtEveryLength) {
    const std::vector<std::uint32_t> lengths{0, 1, 2, 3, 8, 12, 13, 16, 31, 32, 33, 64, 0, 300, 511, 512};
    for (const std::uint32_t depths : {1u, 2u, 40u, 1'000'000u}) expect_all_sorted(lengths, depths);
}

TEST_F(ListsOnDevice, AreSortedInChunksWhereTheyAreLong) {
    const std::vector<std::uint32_t> lengths{5,    513,  1,   1023,   1024,    1025,      0, 2048,
                                             2049, 4097, 512, 20'000, 100'000, 1'000'000, 3};
    expect_all_sorted(lengths, 40);
    expect_all_sorted({513, 2049, 20'000}, 1'000'000);
}

TEST_F(ListsOnDevice, StartWhereTheListsBeforeThemEnd) {
    // One group, its edges, and more groups than the second level sums at a time (256).
    for (const std::size_t cells : std::array<std::size_t, 5>{1, 1023, 1024, 1025, 300 * 1024 + 7}) {
        std::mt19937 random(11);
        std::vector<std::uint32_t> counts(cells);
        for (std::uint32_t& count : counts) count = static_cast<std::uint32_t>(random() % 5);
        const std::vector<std::uint32_t> got = starts(counts);
        std::uint32_t wanted = 0;
        for (std::size_t i = 0; i < cells; ++i) {
            ASSERT_EQ(got[i], wanted) << "cell " << i << " of " << cells;
            wanted += counts[i];
        }
    }
}

}  // namespace
}  // namespace strata
