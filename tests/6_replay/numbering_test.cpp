// Places (replay/scene/numbering.h): triangles keep their vertices, each begins with a place of its own, and few vertices are
// shaded twice.
#include "replay/scene/numbering.h"

#include <set>

#include <gtest/gtest.h>

namespace strata {
namespace {

/// Two triangles for each square of a grid of n x n, after some indices that are not of the range.
std::vector<std::uint32_t> grid_after(std::uint32_t others, std::uint32_t n) {
    std::vector<std::uint32_t> indices(others, 7);
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, below = a + n + 1;
            for (const std::uint32_t corner : {a, below, a + 1, a + 1, below, below + 1}) indices.push_back(corner);
        }
    return indices;
}

std::vector<std::uint32_t> places_of(const std::vector<std::uint32_t>& indices, std::uint32_t first, std::size_t count) {
    std::vector<std::uint32_t> places{99};  // what is there stays
    add_places(indices, first, static_cast<std::uint32_t>(count), places);
    EXPECT_EQ(places.front(), 99u);
    places.erase(places.begin());
    return places;
}

void expect_numbered(const std::vector<std::uint32_t>& indices, std::uint32_t first, const std::vector<std::uint32_t>& places) {
    ASSERT_EQ(places.size(), indices.size() - first);
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        ASSERT_EQ(indices[places[i]], indices[first + i]) << "the vertex of corner " << i;
        if (i % 3 == 0) {
            ASSERT_EQ(places[i], first + i) << "a triangle begins with its own place";
        }
    }
}

TEST(Numbering, OfAGridShadesAboutOneVertexPerTriangle) {
    const std::vector<std::uint32_t> indices = grid_after(5, 40);
    const std::vector<std::uint32_t> places = places_of(indices, 5, indices.size() - 5);
    expect_numbered(indices, 5, places);
    const std::size_t triangles = 2 * 40 * 40, shaded = std::set(places.begin(), places.end()).size();
    EXPECT_LE(shaded, triangles + 2 * 41) << "and those at two sides, where no triangle begins";
}

TEST(Numbering, OfTwoTrianglesThatBeginWithTheSameVertexHasItTwice) {
    const std::vector<std::uint32_t> quad{0, 1, 2, 0, 2, 3};
    EXPECT_EQ(places_of(quad, 0, 6), (std::vector<std::uint32_t>{0, 1, 2, 3, 2, 5}));
}

TEST(Numbering, OfAShuffledSoupIsRightToo) {
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < 3000; ++i) indices.push_back(i * 7919 % 101);
    expect_numbered(indices, 0, places_of(indices, 0, indices.size()));
}

TEST(Numbering, OfNothingIsNothing) { EXPECT_TRUE(places_of({1, 2, 3}, 3, 0).empty()); }

}  // namespace
}  // namespace strata
