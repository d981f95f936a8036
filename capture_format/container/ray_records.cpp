// Every float x = float(t * z) leaves an interval of numbers t. Intervals of the same ray overlap, those of two rays do not:
// rays are found by narrowing, and any number that is left in an interval gives back all of its floats.
#include "capture_format/container/ray_records.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <future>
#include <limits>

namespace strata {
namespace {

constexpr std::size_t most_rays = std::size_t{1} << 16;  // what a record can tell apart
// Four per pixel at 16384 pixels, twice as many as a deep image has rays.
constexpr std::size_t bins = std::size_t{1} << 18;
constexpr std::uint32_t no_ray = ~0u;

using Position = std::array<float, 3>;
static_assert(sizeof(Position) == position_bytes);

Position position_at(std::span<const std::byte> positions, std::size_t i) {
    Position position;
    std::memcpy(&position, &positions[i * position_bytes], position_bytes);
    return position;
}

/// Whether the first triangles face the eye, each at one depth. Other positions are not worth looking for rays.
bool may_have_rays(std::span<const std::byte> positions) {
    constexpr std::size_t corners = 3, looked_at = 64;
    const std::size_t count = std::min(positions.size() / position_bytes, corners * looked_at);
    for (std::size_t i = 0; i < count; ++i) {
        const float z = position_at(positions, i)[2];
        if (!(z > 0) || z != position_at(positions, i - i % corners)[2]) return false;
    }
    return true;
}

struct Interval {
    double low = 0, high = 0;
};

/// Numbers t for which t * z rounds to x.
Interval numbers_for(float x, double inverse_z) {
    // Half a unit in the last place, from the exponent alone.
    const double half_unit = double(std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & 0x7f800000u)) * 0x1p-24;
    return {(double(x) - half_unit) * inverse_z, (double(x) + half_unit) * inverse_z};
}

/// The number in the interval with the fewest bits: short numbers compress.
double shortest(const Interval& interval) {
    const double middle = interval.low / 2 + interval.high / 2;
    int exponent = 0;
    std::frexp(middle, &exponent);
    for (int bits = 1; bits < std::numeric_limits<double>::digits; ++bits) {
        const double rounded = std::ldexp(std::round(std::ldexp(middle, bits - exponent)), exponent - bits);
        if (rounded >= interval.low && rounded <= interval.high) return rounded;
    }
    return middle;
}

/// The rays of one coordinate.
class Rays {
public:
    explicit Rays(const Interval& range)
        : first_(range.low), per_number_(range.high > range.low ? double(bins - 1) / (range.high - range.low) : 0) {}

    /// The ray of a coordinate, or `no_ray` where there are too many rays, or two too close to each other.
    std::uint32_t find(float x, double inverse_z) {
        const Interval numbers = numbers_for(x, inverse_z);
        const auto bin =
            static_cast<std::size_t>(std::clamp((double(x) * inverse_z - first_) * per_number_, 0.0, double(bins - 1)));
        for (const std::size_t near : {bin, bin - std::min<std::size_t>(bin, 1), std::min(bin + 1, bins - 1)})
            if (by_bin_[near] != no_ray && narrow(rays_[by_bin_[near]], numbers)) return by_bin_[near];
        if (by_bin_[bin] != no_ray || rays_.size() == most_rays) return no_ray;
        by_bin_[bin] = static_cast<std::uint32_t>(rays_.size());
        rays_.push_back(numbers);
        return by_bin_[bin];
    }

    /// Fills the numbers of all rays, ascending; returns each ray's place there.
    std::vector<std::uint16_t> sort(std::vector<double>& numbers) const {
        std::vector<std::uint32_t> order(rays_.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
        std::ranges::sort(order, {}, [&](std::uint32_t i) { return rays_[i].low; });
        std::vector<std::uint16_t> places(rays_.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            places[order[i]] = static_cast<std::uint16_t>(i);
            numbers.push_back(shortest(rays_[order[i]]));
        }
        return places;
    }

private:
    static bool narrow(Interval& ray, const Interval& numbers) {
        const Interval both{std::max(ray.low, numbers.low), std::min(ray.high, numbers.high)};
        if (both.low > both.high) return false;
        ray = both;
        return true;
    }

    double first_, per_number_;
    std::vector<Interval> rays_;
    std::vector<std::uint32_t> by_bin_ = std::vector<std::uint32_t>(bins, no_ray);
};

/// The least and the greatest x / z, or nothing where a position is not in front of the origin.
std::optional<Interval> range_of(std::span<const std::byte> positions, std::size_t axis) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Interval range{infinity, -infinity};
    for (std::size_t i = 0; i < positions.size() / position_bytes; ++i) {
        const Position at = position_at(positions, i);
        if (!(at[2] > 0 && std::isfinite(at[axis]) && std::isfinite(at[2]))) return std::nullopt;
        const double number = double(at[axis]) * (1 / double(at[2]));
        range.low = std::min(range.low, number);
        range.high = std::max(range.high, number);
    }
    return range;
}

float coordinate(double number, float z) { return static_cast<float>(number * double(z)); }

/// The rays of one coordinate (0: x, 1: y), and the place among them of every position's.
struct Coordinates {
    std::vector<double> numbers;
    std::vector<std::uint16_t> places;
};

/// Nothing where the coordinates are not on few rays, to the bit.
std::optional<Coordinates> coordinates(std::span<const std::byte> positions, std::size_t axis) {
    const auto range = range_of(positions, axis);
    if (!range) return std::nullopt;
    Rays rays(*range);
    Coordinates result;
    result.places.reserve(positions.size() / position_bytes);
    for (std::size_t i = 0; i < positions.size() / position_bytes; ++i) {
        const Position at = position_at(positions, i);
        const std::uint32_t ray = rays.find(at[axis], 1 / double(at[2]));
        if (ray == no_ray) return std::nullopt;
        result.places.push_back(static_cast<std::uint16_t>(ray));
    }
    const std::vector<std::uint16_t> sorted = rays.sort(result.numbers);
    for (std::size_t i = 0; i < result.places.size(); ++i) {
        std::uint16_t& place = result.places[i];
        place = sorted[place];
        const Position at = position_at(positions, i);
        if (std::bit_cast<std::uint32_t>(coordinate(result.numbers[place], at[2])) != std::bit_cast<std::uint32_t>(at[axis]))
            return std::nullopt;
    }
    return result;
}

}  // namespace

std::optional<RayRecords> ray_records(std::span<const std::byte> positions) {
    if (positions.empty() || positions.size() % position_bytes != 0 || !may_have_rays(positions)) return std::nullopt;
    // Half of the time to write a deep image, so each coordinate has a thread; both run here where there is none to be had.
    auto columns = std::async([&] { return coordinates(positions, 0); });
    auto rows = coordinates(positions, 1);
    auto found = columns.get();
    if (!found || !rows) return std::nullopt;
    RayRecords result{.x_per_z = std::move(found->numbers), .y_per_z = std::move(rows->numbers), .records = {}};
    result.records.reserve(rows->places.size());
    for (std::size_t i = 0; i < rows->places.size(); ++i)
        result.records.push_back({found->places[i], rows->places[i], position_at(positions, i)[2]});
    return result;
}

bool undo_ray_records(const RayRecords& rays, std::span<std::byte> positions) {
    for (std::size_t i = 0; i < rays.records.size(); ++i) {
        const auto& [column, row, z] = rays.records[i];
        if (column >= rays.x_per_z.size() || row >= rays.y_per_z.size()) return false;
        const Position at = {coordinate(rays.x_per_z[column], z), coordinate(rays.y_per_z[row], z), z};
        std::memcpy(&positions[i * position_bytes], &at, position_bytes);
    }
    return true;
}

}  // namespace strata
