#include "passes/transparency/moments/canonical.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace strata::transparency {
namespace {

using Complex = std::complex<double>;

/// Gaussian elimination with column pivots.
template <typename Number>
std::vector<Number> solved(std::vector<std::vector<Number>> rows, std::vector<Number> right) {
    const std::size_t n = right.size();
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t pivot = i;
        for (std::size_t r = i + 1; r < n; ++r)
            if (std::abs(rows[r][i]) > std::abs(rows[pivot][i])) pivot = r;
        std::swap(rows[i], rows[pivot]);
        std::swap(right[i], right[pivot]);
        for (std::size_t r = i + 1; r < n; ++r) {
            const Number factor = rows[r][i] / rows[i][i];
            for (std::size_t c = i; c < n; ++c) rows[r][c] -= factor * rows[i][c];
            right[r] -= factor * right[i];
        }
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t c = i + 1; c < n; ++c) right[i] -= rows[i][c] * right[c];
        right[i] /= rows[i][i];
    }
    return right;
}

double value_at(std::span<const double> polynomial, double x) {
    double value = 0;
    for (std::size_t k = polynomial.size(); k-- > 0;) value = value * x + polynomial[k];
    return value;
}

/// The root in an interval where the polynomial is monotonous: Newton's steps, and halves where these would leave what is left of
/// the interval or do not get shorter by half.
double root_within(std::span<const double> polynomial, std::span<const double> slope, double low, double high) {
    const bool rises = value_at(polynomial, high) > 0;
    double x = .5 * (low + high), before = high - low, step = before;
    for (int i = 0; i < 200; ++i) {
        const double value = value_at(polynomial, x), newton = value / value_at(slope, x);
        ((value > 0) == rises ? high : low) = x;
        const bool is_newton = x - newton > low && x - newton < high && std::abs(newton) <= .5 * std::abs(before);
        before = step;
        step = is_newton ? newton : x - .5 * (low + high);
        if (value == 0 || std::abs(step) <= 1e-16 * std::abs(x)) break;
        x -= step;
    }
    return x;
}

/// No root is farther from the origin (Cauchy), or than is looked for.
double farthest_root(std::span<const double> polynomial) {
    constexpr double far = 1e5;
    double largest = 0;
    for (const double coefficient : polynomial.first(polynomial.size() - 1)) largest = std::max(largest, std::abs(coefficient));
    const double bound = 1.001 * (1 + largest / std::abs(polynomial.back()));
    return bound < far ? bound : far;  // also where it is no number
}

/// The real roots up to 1e5 from the origin: one between two extrema, ascending. All roots of these polynomials are real; one may
/// be farther out, or infinite where the leading coefficient is 0.
std::vector<double> real_roots(std::span<const double> polynomial) {
    if (polynomial.size() < 2) return {};
    const double far = farthest_root(polynomial);
    std::vector<double> slope;
    for (std::size_t k = 1; k < polynomial.size(); ++k) slope.push_back(double(k) * polynomial[k]);
    std::vector<double> bounds = real_roots(slope), roots;
    std::erase_if(bounds, [&](double bound) { return std::abs(bound) >= far; });
    bounds.insert(bounds.begin(), -far);
    bounds.push_back(far);
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i)
        if ((value_at(polynomial, bounds[i]) > 0) != (value_at(polynomial, bounds[i + 1]) > 0))
            roots.push_back(root_within(polynomial, slope, bounds[i], bounds[i + 1]));
    return roots;
}

/// Masses at the nodes with the moments 1, b1, ...: as many of them as there are nodes.
template <typename Number>
std::vector<Number> masses(std::span<const Number> nodes, std::span<const Number> moments) {
    std::vector<std::vector<Number>> powers(nodes.size(), std::vector<Number>(nodes.size(), Number(1)));
    std::vector<Number> right{Number(1)};
    for (std::size_t k = 1; k < nodes.size(); ++k) {
        for (std::size_t i = 0; i < nodes.size(); ++i) powers[k][i] = powers[k - 1][i] * nodes[i];
        right.push_back(moments[k - 1]);
    }
    return solved(powers, right);
}

/// Durand and Kerner's iteration: all roots at once.
std::vector<Complex> complex_roots(std::span<const Complex> polynomial) {
    const std::size_t degree = polynomial.size() - 1;
    std::vector<Complex> roots;
    for (std::size_t i = 0; i < degree; ++i) roots.push_back(std::pow(Complex(.4, .9), double(i)));
    for (int round = 0; round < 300; ++round) {
        double moved = 0;
        for (std::size_t i = 0; i < degree; ++i) {
            Complex value = 0, others = polynomial[degree];
            for (std::size_t k = degree + 1; k-- > 0;) value = value * roots[i] + polynomial[k];
            for (std::size_t j = 0; j < degree; ++j)
                if (j != i) others *= roots[i] - roots[j];
            const Complex step = value / others;
            roots[i] -= step;
            moved = std::max(moved, std::abs(step));
        }
        if (moved < 1e-15) break;
    }
    return roots;
}

/// The circle parameter of the shader: grows from -1 at angle 0 to 7 at 2 pi.
double around(Complex u) {
    double r = std::abs(u.imag()) - std::abs(u.real());
    if (u.real() < 0) r = 2 - r;
    return u.imag() < 0 ? 6 - r : r;
}

}  // namespace

double power_share(std::span<const double> moments, double w, double at_node) {
    const std::size_t order = moments.size() / 2 + 1;
    const auto moment = [&](std::size_t i) { return i == 0 ? 1. : moments[i - 1]; };
    std::vector<std::vector<double>> hankel(order, std::vector<double>(order));
    std::vector<double> powers(order);
    for (std::size_t i = 0; i < order; ++i) {
        powers[i] = std::pow(w, double(i));
        for (std::size_t j = 0; j < order; ++j) hankel[i][j] = moment(i + j);
    }
    std::vector<double> nodes = real_roots(solved(hankel, powers));
    nodes.insert(nodes.begin(), w);
    const std::vector<double> mass = masses<double>(nodes, moments);
    double share = at_node * mass[0];
    for (std::size_t i = 1; i < nodes.size(); ++i)
        if (nodes[i] < w) share += mass[i];
    return share;
}

double circle_share(std::span<const double> moments, double phase, double zone_begins, double at_node) {
    const std::size_t order = moments.size() / 2 + 1;
    std::vector<Complex> positive{1};
    for (std::size_t k = 1; k < order; ++k) positive.emplace_back(moments[2 * k - 2], moments[2 * k - 1]);
    const Complex pinned = std::polar(1., phase);
    std::vector<std::vector<Complex>> toeplitz(order, std::vector<Complex>(order));
    std::vector<Complex> powers(order);
    for (std::size_t i = 0; i < order; ++i) {
        powers[i] = std::pow(pinned, double(i));
        for (std::size_t j = 0; j < order; ++j) toeplitz[i][j] = i >= j ? positive[i - j] : std::conj(positive[j - i]);
    }
    std::vector<Complex> polynomial = solved(toeplitz, powers);
    for (Complex& c : polynomial) c = std::conj(c);
    std::vector<Complex> nodes = complex_roots(polynomial);
    for (Complex& node : nodes) node /= std::abs(node);
    nodes.insert(nodes.begin(), pinned);
    const std::vector<Complex> mass = masses<Complex>(nodes, std::span(positive).subspan(1));
    const double zone = around(std::polar(1., zone_begins));
    double share = at_node * mass[0].real();
    for (std::size_t i = 1; i < nodes.size(); ++i) {
        const double place = around(nodes[i]);
        share += mass[i].real() * ((place < around(pinned) ? 1 : 0) + std::clamp((place - zone) / (7 - zone), 0., 1.));
    }
    return share;
}

}  // namespace strata::transparency
