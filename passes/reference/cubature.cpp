#include "passes/reference/cubature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace strata {
namespace {

using glm::dvec2, glm::dvec3;
using Integrand = std::function<dvec3(dvec2)>;

/// center +- half, with its integral.
struct Cell {
    dvec2 center, half;
    dvec3 sum{0};
    double error = 0;
    int longer = 0;  ///< the axis along which it bends more
};

constexpr std::size_t points_per_cell = 17;

double largest(const dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// Genz and Malik's rules of degree 7 and 5 for two dimensions; weights are shares of the cell's area.
void evaluate(const Integrand& f, Cell& cell) {
    const double l2 = std::sqrt(9.0 / 70), l4 = std::sqrt(9.0 / 10), l5 = std::sqrt(9.0 / 19);
    const auto at = [&](double x, double y) { return f(cell.center + cell.half * dvec2(x, y)); };
    const dvec3 middle = at(0, 0);
    dvec3 near(0), far(0), corners(0), outer(0);
    std::array<double, 2> bend{};
    for (int axis : {0, 1}) {
        const dvec2 along(axis == 0 ? 1 : 0, axis == 0 ? 0 : 1);
        const dvec3 n = at(l2 * along.x, l2 * along.y) + at(-l2 * along.x, -l2 * along.y);
        const dvec3 w = at(l4 * along.x, l4 * along.y) + at(-l4 * along.x, -l4 * along.y);
        // Their fourth difference: the ratio of the squared distances is 1/7.
        bend[static_cast<std::size_t>(axis)] = largest(n - 2.0 * middle - (w - 2.0 * middle) / 7.0);
        near += n;
        far += w;
    }
    for (double x : {-1.0, 1.0})
        for (double y : {-1.0, 1.0}) {
            corners += at(l4 * x, l4 * y);
            outer += at(l5 * x, l5 * y);
        }
    const dvec3 degree7 = (-3816.0 * middle + 2940.0 * near + 1020.0 * far + 200.0 * corners + 1714.75 * outer) / 19683.0;
    const dvec3 degree5 = (-971.0 * middle + 367.5 * near + 32.5 * far + 25.0 * corners) / 729.0;
    const double area = 4 * cell.half.x * cell.half.y;
    cell.sum = area * degree7;
    cell.error = area * largest(degree7 - degree5);
    const bool level = std::abs(bend[0] - bend[1]) <= 1e-9 * (bend[0] + bend[1]);
    cell.longer = level ? (cell.half.x >= cell.half.y ? 0 : 1) : (bend[0] > bend[1] ? 0 : 1);
}

bool touches(const Cell& cell, const dvec2& place) {
    const dvec2 away = glm::abs(place - cell.center);
    return away.x <= 1.01 * cell.half.x && away.y <= 1.01 * cell.half.y;
}

std::vector<Cell> first_cells(const CubatureOptions& options) {
    std::vector<Cell> cells = {{dvec2(0.5), dvec2(0.5)}};
    for (int level = 0; level < options.levels; ++level) {
        std::vector<Cell> finer;
        for (const Cell& cell : cells) {
            if (!touches(cell, options.peak)) {
                finer.push_back(cell);
                continue;
            }
            const dvec2 half = 0.5 * cell.half;
            for (double x : {-1.0, 1.0})
                for (double y : {-1.0, 1.0}) finer.push_back({cell.center + half * dvec2(x, y), half});
        }
        cells = std::move(finer);
    }
    return cells;
}

}  // namespace

glm::dvec3 integral(const Integrand& f, const CubatureOptions& options) {
    std::vector<Cell> cells = first_cells(options);
    dvec3 sum(0);
    double error = 0;
    std::size_t evaluated = 0;
    const auto count = [&](Cell& cell) {
        evaluate(f, cell);
        evaluated += points_per_cell;
        sum += cell.sum;
        error += cell.error;
    };
    for (Cell& cell : cells) count(cell);
    const auto by_error = [](const Cell& a, const Cell& b) { return a.error < b.error; };
    std::ranges::make_heap(cells, by_error);
    while (error > options.tolerance * largest(sum) && evaluated < options.most) {
        std::ranges::pop_heap(cells, by_error);
        const Cell parent = cells.back();
        cells.pop_back();
        sum -= parent.sum;
        error -= parent.error;
        dvec2 half = parent.half, step(0);
        half[parent.longer] *= 0.5;
        step[parent.longer] = half[parent.longer];
        for (const dvec2& center : {parent.center - step, parent.center + step}) {
            Cell cell{center, half};
            count(cell);
            cells.push_back(cell);
            std::ranges::push_heap(cells, by_error);
        }
    }
    return sum;
}

}  // namespace strata
