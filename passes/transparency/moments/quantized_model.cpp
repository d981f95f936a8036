// Normalized moments on [0, 1] as 16 bits keep them (Muenstermann et al. 2018; the transforms as
// docs/algorithms/transparency.md 4.3 gives them).
#include <cmath>

#include <glm/glm.hpp>

#include "passes/transparency/moments/model.h"
#include "passes/transparency/moments/moments.shared.h"

namespace strata::transparency {
namespace {

/// Rows of a transform of `size` odd or even moments, and what is added behind it. Unused rows and columns are those of 1.
struct Transform {
    glm::dmat4 columns{1};  ///< glm keeps columns
    glm::dvec4 offset{0};

    Transform(std::initializer_list<std::initializer_list<double>> rows, glm::dvec4 added) : offset(added) {
        int r = 0;
        for (const auto& row : rows) {
            int c = 0;
            for (const double element : row) columns[c++][r] = element;
            ++r;
        }
    }
};

const double root3 = std::sqrt(3.);

const Transform odd_transforms[] = {
    {{{1.5, -2}, {root3 / 2, -2 * root3 / 9}}, glm::dvec4(.5)},
    {{{2.5, -10, 8}, {-1.8749986445, 4.20757543111, -1.83257678661}, {1.26583039016, -1.47644882902, .71061660238}},
     glm::dvec4(.5)},
    {{{3.48044635732474, -27.5760737514826, 55.1267384344761, -31.5311110403183},
      {1.26797185782836, -.928755808743913, -2.07520453231032, 1.23598848322588},
      {-2.1671560004294, 6.17950199592966, -.276515571579297, -4.23583042392097},
      {.974332879165755, -.443426830933027, -.360491648368785, .310149466050223}},
     glm::dvec4(.5)}};
const Transform even_transforms[] = {
    {{{4, -4}, {.5, .5}}, glm::dvec4(0)},
    {{{4, -4, 0}, {9, -24, 16}, {-.57759806484, 4.61936647543, -3.07953906655}}, {0, 0, .018888946, 0}},
    {{{.280504133158527, -.757633844606942, .392179589334688, -.887531871812237},
      {-2.01362265883247, .221551373038988, -1.06107954265125, 2.83887201588367},
      {-7.31010494985321, 13.9855979699139, -.114305766176437, -7.4361899359832},
      {-15.8954215629556, 79.6186327084103, -127.457278992502, 63.7349456687829}},
     {.972481993925964, 1, .999179192513328, .991778293073131}}};

/// Every second number from `first` on, and back.
glm::dvec4 every_second(std::span<const double> numbers, std::size_t first) {
    glm::dvec4 picked(0);
    for (std::size_t i = first; i < numbers.size(); i += 2) picked[static_cast<int>(i / 2)] = numbers[i];
    return picked;
}
std::vector<double> in_turns(glm::dvec4 odd, glm::dvec4 even, std::size_t count) {
    std::vector<double> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = (i % 2 ? even : odd)[static_cast<int>(i / 2)];
    return numbers;
}

double in_16_bits(double value) { return std::round(std::clamp(value, 0., 1.) * 65535) / 65535; }

}  // namespace

std::vector<double> quantized(std::uint32_t kind, std::span<const double> moments) {
    std::vector<double> numbers(moments.begin(), moments.end());
    if (kind >= moments_trig2) {
        for (double& number : numbers) number = .5 * number + .5;
    } else {
        const Transform &odd = odd_transforms[kind], &even = even_transforms[kind];
        numbers = in_turns(odd.columns * every_second(moments, 0) + odd.offset,
                           even.columns * every_second(moments, 1) + even.offset, moments.size());
    }
    for (double& number : numbers) number = in_16_bits(number);
    return numbers;
}

std::vector<double> dequantized(std::uint32_t kind, std::span<const double> stored) {
    std::vector<double> numbers(stored.begin(), stored.end());
    if (kind >= moments_trig2) {
        for (double& number : numbers) number = 2 * number - 1;
        return numbers;
    }
    const Transform &odd = odd_transforms[kind], &even = even_transforms[kind];
    return in_turns(glm::inverse(odd.columns) * (every_second(stored, 0) - odd.offset),
                    glm::inverse(even.columns) * (every_second(stored, 1) - even.offset), stored.size());
}

}  // namespace strata::transparency
