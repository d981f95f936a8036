#include "replay/measure/observer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "passes/luminance.h"

namespace strata {
namespace {

using std::numbers::pi;
using Symmetry = FlipKernel::Symmetry;

// A register of the baseline of x86-64. Filters name it: of a loop over floats GCC 12 made scalar code for the columns.
using Register [[gnu::vector_size(16)]] = float;
constexpr std::size_t floats_per_register = sizeof(Register) / sizeof(float);
// Floats handled at once by a filter.
constexpr std::size_t lanes = 4 * floats_per_register;

// XYZ of BT.709 red, green and blue at white D65 (0.3127, 0.3290), each divided by white's: rows x, y, z add up to 1.
constexpr float xyz[3][3] = {
    {.43389539f, .37624237f, .18986224f}, {.21263682f, .71518298f, .07218020f}, {.01775242f, .10946563f, .87278195f}};
// Its inverse.
constexpr float rgb[3][3] = {
    {3.08034199f, -1.53739897f, -.54294302f}, {-.92117840f, 1.87592998f, .04524841f}, {.05288129f, -.20401121f, 1.15112991f}};

// By value: references to one of two floats keep a loop from becoming vector code.
inline float smaller(float a, float b) { return a < b ? a : b; }
inline float larger(float a, float b) { return a > b ? a : b; }

inline Register load(const float* from) {
    Register loaded;
    std::memcpy(&loaded, from, sizeof loaded);
    return loaded;
}

inline void store(const Register& from, float* to) { std::memcpy(to, &from, sizeof from); }

using Lanes = std::array<Register, lanes / floats_per_register>;

/// in(x + k) and in(x - k) are `ahead` and `behind` of distance k.
template <Symmetry symmetry, typename Ahead, typename Behind>
inline Lanes filtered(const std::vector<float>& weights, const float* center, const Ahead& ahead, const Behind& behind) {
    Lanes sum;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = weights[0] * load(center + i * floats_per_register);
    for (std::size_t k = 1; k < weights.size(); ++k) {
        const float weight = weights[k], *a = ahead(k), *b = behind(k);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const Register one = load(a + i * floats_per_register), other = load(b + i * floats_per_register);
            sum[i] += weight * (symmetry == Symmetry::even ? one + other : one - other);
        }
    }
    return sum;
}

template <Symmetry symmetry>
inline void filter_across(const std::vector<float>& weights, const float* in, float* out, std::size_t count) {
    for (std::size_t x = 0; x < count; x += lanes) {
        const float* center = in + x;
        const Lanes sum = filtered<symmetry>(
            weights, center, [=](std::size_t k) { return center + k; }, [=](std::size_t k) { return center - k; });
        for (std::size_t i = 0; i < sum.size(); ++i) store(sum[i], out + x + i * floats_per_register);
    }
}

void across(const FlipKernel& kernel, const float* in, float* out, std::size_t count) {
    if (kernel.symmetry == Symmetry::even) filter_across<Symmetry::even>(kernel.weights, in, out, count);
    else filter_across<Symmetry::odd>(kernel.weights, in, out, count);
}

/// rows[radius] is the row itself, rows[radius + k] the one k below it. Adds to out.
template <Symmetry symmetry>
inline void filter_down(const std::vector<float>& weights, const float* const* rows, float* out, std::size_t count) {
    const float* const* middle = rows + weights.size() - 1;
    for (std::size_t x = 0; x < count; x += lanes) {
        const Lanes sum = filtered<symmetry>(
            weights, middle[0] + x, [=](std::size_t k) { return middle[k] + x; },
            [=](std::size_t k) { return *(middle - k) + x; });
        for (std::size_t i = 0; i < sum.size(); ++i) {
            float* const to = out + x + i * floats_per_register;
            store(load(to) + sum[i], to);
        }
    }
}

void down(const FlipKernel& kernel, const float* const* rows, float* out, std::size_t count) {
    if (kernel.symmetry == Symmetry::even) filter_down<Symmetry::even>(kernel.weights, rows, out, count);
    else filter_down<Symmetry::odd>(kernel.weights, rows, out, count);
}

/// Where every curve is at its end: beyond, squares would leave the range of a float.
constexpr float brightest = 1e15f;

inline float tone_mapped(const ToneCurve& curve, float light) {
    const float x = smaller(light, brightest);
    const auto [a, b, c] = curve.above;
    const auto [d, e, f] = curve.below;
    return smaller(1.f, (x * (a * x + b) + c) / (x * (d * x + e) + f));
}

struct Light {
    float r, g, b;
};

/// Luminance over white's, X' - Y' and Y' - Z' (both over white's): YCxCz without its scales and its offset, which cancel
/// because every filter keeps a constant.
struct Opponent {
    float luminance, red_green, blue_yellow;
};

inline Opponent opponent(float r, float g, float b) {
    const float x = xyz[0][0] * r + xyz[0][1] * g + xyz[0][2] * b;
    const float y = xyz[1][0] * r + xyz[1][1] * g + xyz[1][2] * b;
    const float z = xyz[2][0] * r + xyz[2][1] * g + xyz[2][2] * b;
    return {y, x - y, y - z};
}

inline float on_display(float light) { return smaller(1.f, larger(0.f, light)); }

/// `in` and `out` are three rows each.
template <typename Shown>
inline void opponent_row(const float* const* in, float* const* out, std::size_t count, const Shown& shown) {
    const float *red = in[0], *green = in[1], *blue = in[2];
    float *luminance = out[0], *red_green = out[1], *blue_yellow = out[2];
#pragma GCC ivdep  // rows are apart
    for (std::size_t i = 0; i < count; ++i) {
        const Light light = shown(red[i], green[i], blue[i]);
        const Opponent o = opponent(light.r, light.g, light.b);
        luminance[i] = o.luminance;
        red_green[i] = o.red_green;
        blue_yellow[i] = o.blue_yellow;
    }
}

void displayed_row(const float* const* in, float* const* out, std::size_t count) {
    opponent_row(in, out, count, [](float r, float g, float b) { return Light{on_display(r), on_display(g), on_display(b)}; });
}

void exposed_row(const float* const* in, float* const* out, std::size_t count, float scale, const ToneCurve& curve) {
    const auto exposed = [=](float light) { return larger(0.f, light) * scale; };
    if (curve.of_luminance) {
        opponent_row(in, out, count, [=](float r, float g, float b) {
            const Light light{smaller(exposed(r), brightest), smaller(exposed(g), brightest), smaller(exposed(b), brightest)};
            const float luminance = strata::luminance(light.r, light.g, light.b);
            const float share = luminance > 0 ? tone_mapped(curve, luminance) / luminance : 0.f;
            return Light{on_display(light.r * share), on_display(light.g * share), on_display(light.b * share)};
        });
        return;
    }
    opponent_row(in, out, count, [=](float r, float g, float b) {
        return Light{tone_mapped(curve, exposed(r)), tone_mapped(curve, exposed(g)), tone_mapped(curve, exposed(b))};
    });
}

/// Relative error below 2e-7 for t in [.008, 1]: a third of the exponent, then Halley's iteration twice.
inline float cube_root(float t) {
    float y = std::bit_cast<float>(static_cast<std::int32_t>(static_cast<float>(std::bit_cast<std::int32_t>(t)) * (1 / 3.f)) +
                                   0x2a514067);
    y *= (y * y * y + 2 * t) / (2 * y * y * y + t);
    return y * (y * y * y + 2 * t) / (2 * y * y * y + t);
}

/// t > 0 and normal. The logarithm's series in (m - 1) / (m + 1), m in [.7, 1.42]: error below 1e-9.
inline float log2_of(float t) {
    const std::int32_t bits = std::bit_cast<std::int32_t>(t), shifted = bits - 0x3f3504f3;
    const float exponent = static_cast<float>(shifted >> 23);
    const float m = std::bit_cast<float>((shifted & 0x007fffff) + 0x3f3504f3);
    const float s = (m - 1) / (m + 1), q = s * s;
    return exponent + s * (2.8853901f + q * (.96179669f + q * (.57707802f + q * (.41219858f + q * .32059890f))));
}

/// -126 < t < 126. Taylor's polynomial around the nearest integer: error below 2e-7.
inline float exp2_of(float t) {
    const float whole = static_cast<float>(static_cast<std::int32_t>(t + (t < 0 ? -.5f : .5f))), f = t - whole;
    const float p =
        1 + f * (.69314718f + f * (.24022651f + f * (.055504109f + f * (.0096181291f + f * (.0013333558f + f * .00015403530f)))));
    return p * std::bit_cast<float>((static_cast<std::int32_t>(whole) + 127) << 23);
}

inline float power(float base, float exponent) { return exp2_of(exponent * log2_of(larger(base, 1e-18f))); }

inline float lab_curve(float t) {
    const float root = cube_root(larger(t, .008f));
    return t > .00885645168f ? root : t * 7.78703704f + 4.f / 29;
}

/// CIELAB with Hunt's adjustment, of a filtered opponent color that is clamped to what a display shows.
struct Lab {
    float lightness, a, b;
};

inline float shown(float x, float y, float z, int channel) {
    return on_display(rgb[channel][0] * x + rgb[channel][1] * y + rgb[channel][2] * z);
}

inline Lab hunt_lab(float luminance, float red_green, float blue_yellow) {
    const float x = luminance + red_green, z = luminance - blue_yellow;
    const float r = shown(x, luminance, z, 0), g = shown(x, luminance, z, 1), b = shown(x, luminance, z, 2);
    const float fx = lab_curve(xyz[0][0] * r + xyz[0][1] * g + xyz[0][2] * b);
    const float fy = lab_curve(xyz[1][0] * r + xyz[1][1] * g + xyz[1][2] * b);
    const float fz = lab_curve(xyz[2][0] * r + xyz[2][1] * g + xyz[2][2] * b);
    const float lightness = 116 * fy - 16;
    return {lightness, 5 * lightness * (fx - fy), 2 * lightness * (fy - fz)};
}

/// Lightness and hue differ independently.
inline float hyab(const Lab& p, const Lab& q) {
    const float a = p.a - q.a, b = p.b - q.b;
    return std::abs(p.lightness - q.lightness) + std::sqrt(a * a + b * b);
}

FlipKernel kernel(double reach, double (*shape)(double position, double parameter), double parameter) {
    FlipKernel made;
    for (int k = 0; k <= static_cast<int>(std::ceil(reach)); ++k) made.weights.push_back(static_cast<float>(shape(k, parameter)));
    return made;
}

double gauss(double x, double deviation) { return std::exp(-x * x / (2 * deviation * deviation)); }
double gauss_slope(double x, double deviation) { return -x * gauss(x, deviation); }
double gauss_bend(double x, double deviation) { return (x * x / (deviation * deviation) - 1) * gauss(x, deviation); }

/// Sum over both sides of the weights of one sign.
double total(const FlipKernel& kernel, double sign) {
    double sum = std::max(0., sign * double(kernel.weights[0]));
    for (std::size_t k = 1; k < kernel.weights.size(); ++k) sum += 2 * std::max(0., sign * double(kernel.weights[k]));
    return sum;
}

FlipKernel scaled(FlipKernel kernel, double factor) {
    for (float& w : kernel.weights) w = static_cast<float>(double(w) * factor);
    return kernel;
}

/// A sensitivity a * sqrt(pi / b) * exp(-pi^2 x^2 / b), x in degrees (2020, table 1).
struct Sensitivity {
    double a, b;
    double deviation() const { return std::sqrt(b / (2 * pi * pi)); }
    double height() const { return a * std::sqrt(pi / b); }
};
constexpr Sensitivity to_luminance{1, .0047}, to_red_green{1, .0053}, to_blue_yellow[] = {{34.1, .04}, {13.5, .025}};
// Beyond five deviations a Gaussian's weights are below 4e-6 of its middle's.
constexpr double cut = 5;

FlipKernel see(const Sensitivity& s, double pixels_per_degree) {
    // The papers cut every filter at three deviations of the widest.
    const double widest = 3 * to_blue_yellow[0].deviation() * pixels_per_degree, deviation = s.deviation() * pixels_per_degree;
    return kernel(std::min(std::ceil(widest), cut * deviation), gauss, deviation);
}

FlipKernel normalized(const FlipKernel& kernel) { return scaled(kernel, 1 / total(kernel, 1)); }

}  // namespace

/// One row of a picture after all filters.
struct Observer::Rows {
    enum { luminance, red_green, blue_yellow, slope_x, slope_y, bend_x, bend_y, count };
    std::array<std::vector<float>, count> rows;
};

ToneCurve tone_curve(ToneMapper mapper) {
    switch (mapper) {
        case ToneMapper::aces:
            return {{.36f * 2.51f, .6f * .03f, 0}, {.36f * 2.43f, .6f * .59f, .14f}};
        case ToneMapper::hable:
            return {{.231683f, .013791f, 0}, {.18f, .3f, .018f}};
        case ToneMapper::reinhard:
            break;
    }
    return {{0, 1, 0}, {0, 1, 1}, true};
}

Observer::Observer(std::uint32_t width, std::uint32_t height, double pixels_per_degree)
    : width_(width), height_(height), stride_((width + lanes - 1) / lanes * lanes), map_(std::size_t(width) * height) {
    across_[luminance] = normalized(see(to_luminance, pixels_per_degree));
    across_[red_green] = normalized(see(to_red_green, pixels_per_degree));
    // Blue and yellow see through two Gaussians; each has a share of the whole, which sums to 1 over the square.
    const FlipKernel wide = see(to_blue_yellow[0], pixels_per_degree), narrow = see(to_blue_yellow[1], pixels_per_degree);
    const double wide_sum = to_blue_yellow[0].height() * std::pow(total(wide, 1), 2);
    const double narrow_sum = to_blue_yellow[1].height() * std::pow(total(narrow, 1), 2);
    across_[blue_yellow_wide] = normalized(wide);
    across_[blue_yellow_narrow] = normalized(narrow);
    down_wide_ = scaled(across_[blue_yellow_wide], wide_sum / (wide_sum + narrow_sum));
    down_narrow_ = scaled(across_[blue_yellow_narrow], narrow_sum / (wide_sum + narrow_sum));

    // Edges and points are 0.082 degrees wide (2020, section 4.2).
    const double deviation = .5 * .082 * pixels_per_degree;
    const FlipKernel g = kernel(3 * deviation, gauss, deviation);
    across_[smooth] = normalized(g);
    FlipKernel first = kernel(3 * deviation, gauss_slope, deviation);
    first.symmetry = Symmetry::odd;
    across_[slope] = scaled(first, 2 / total(first, -1));
    FlipKernel second = kernel(3 * deviation, gauss_bend, deviation);
    const double below = total(second, -1), above = total(second, 1);
    for (float& w : second.weights) w = static_cast<float>(double(w) / (w > 0 ? above : below));
    across_[bend] = second;

    // Error is compressed by the power 0.7; 0.4 of the largest one, green against blue, becomes 0.95.
    const auto of_rgb = [](int c) { return hunt_lab(xyz[1][c], xyz[0][c] - xyz[1][c], xyz[1][c] - xyz[2][c]); };
    largest_ = std::pow(hyab(of_rgb(1), of_rgb(2)), .7f);
    knee_ = .4f * largest_;
    for (Planes* planes : {&reference_, &test_})
        for (std::vector<float>& plane : *planes) plane.resize(stride_ * height);
}

void Observer::filter_rows(const ColorPlanes& picture, const std::optional<Exposed>& exposed, Planes& planes) const {
    constexpr std::size_t channel[plane_count] = {0, 1, 2, 2, 0, 0, 0};
    std::size_t reach = 0;
    for (const FlipKernel& k : across_) reach = std::max(reach, k.weights.size());
    const float scale = exposed ? static_cast<float>(std::exp2(exposed->exposure)) : 1.f;
    const ToneCurve curve = tone_curve(exposed ? exposed->tone_mapper : ToneMapper::aces);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, height_, 8), [&](const tbb::blocked_range<std::size_t>& range) {
        std::array<std::vector<float>, 3> rows;
        for (std::vector<float>& row : rows) row.resize(stride_ + 2 * reach);
        for (std::size_t y = range.begin(); y < range.end(); ++y) {
            const float* in[3];
            float* out[3];
            for (std::size_t c = 0; c < 3; ++c) {
                in[c] = picture.rgb[c].data() + y * width_;
                out[c] = rows[c].data() + reach;
            }
            if (exposed) exposed_row(in, out, width_, scale, curve);
            else displayed_row(in, out, width_);
            for (float* row : out) {  // beyond its border a picture goes on as its border
                std::fill(row - reach, row, row[0]);
                std::fill(row + width_, row + stride_ + reach, row[width_ - 1]);
            }
            for (std::size_t p = 0; p < plane_count; ++p)
                across(across_[p], out[channel[p]], planes[p].data() + y * stride_, stride_);
        }
    });
}

void Observer::filter_columns(const Planes& planes, std::uint32_t y, Rows& rows) const {
    struct Column {
        Plane from;
        const FlipKernel& kernel;
        std::size_t to;
    };
    const Column filters[] = {{luminance, across_[luminance], Rows::luminance},
                              {red_green, across_[red_green], Rows::red_green},
                              {blue_yellow_wide, down_wide_, Rows::blue_yellow},
                              {blue_yellow_narrow, down_narrow_, Rows::blue_yellow},
                              {slope, across_[smooth], Rows::slope_x},
                              {smooth, across_[slope], Rows::slope_y},
                              {bend, across_[smooth], Rows::bend_x},
                              {smooth, across_[bend], Rows::bend_y}};
    for (std::vector<float>& row : rows.rows) row.assign(stride_, 0);
    std::vector<const float*> near;
    for (const Column& filter : filters) {
        near.clear();
        const auto reach = static_cast<std::int64_t>(filter.kernel.weights.size()) - 1;
        for (std::int64_t k = -reach; k <= reach; ++k) {
            const auto row = static_cast<std::size_t>(std::clamp<std::int64_t>(y + k, 0, height_ - 1));
            near.push_back(planes[filter.from].data() + row * stride_);
        }
        down(filter.kernel, near.data(), rows.rows[filter.to].data(), stride_);
    }
}

namespace {

inline float length(float x, float y) { return std::sqrt(x * x + y * y); }

/// What the columns' filters left of one row.
struct SeenRow {
    const float *luminance, *red_green, *blue_yellow, *slope_x, *slope_y, *bend_x, *bend_y;
};

struct Knee {
    float knee, largest;
};

void difference_row(SeenRow a, SeenRow b, Knee errors, std::span<float> out) {
    const float below = .95f / errors.knee, above = .05f / (errors.largest - errors.knee);
    float* const to = out.data();
    const std::size_t count = out.size();
#pragma GCC ivdep  // rows are apart
    for (std::size_t i = 0; i < count; ++i) {
        const Lab p = hunt_lab(a.luminance[i], a.red_green[i], a.blue_yellow[i]);
        const Lab q = hunt_lab(b.luminance[i], b.red_green[i], b.blue_yellow[i]);
        const float apart = hyab(p, q), error = power(apart, .7f);
        const float color = error < errors.knee ? below * error : .95f + (error - errors.knee) * above;
        const float edges = std::abs(length(a.slope_x[i], a.slope_y[i]) - length(b.slope_x[i], b.slope_y[i]));
        const float points = std::abs(length(a.bend_x[i], a.bend_y[i]) - length(b.bend_x[i], b.bend_y[i]));
        const float feature = std::sqrt(larger(edges, points) * .70710678f);
        to[i] = apart > 0 ? smaller(1.f, power(color, 1 - feature)) : 0.f;
    }
}

}  // namespace

void Observer::compare_row(const Rows& reference, const Rows& test, std::span<float> out) const {
    const auto row = [](const Rows& rows) {
        const auto& r = rows.rows;
        return SeenRow{r[0].data(), r[1].data(), r[2].data(), r[3].data(), r[4].data(), r[5].data(), r[6].data()};
    };
    difference_row(row(reference), row(test), {knee_, largest_}, out);
}

std::span<const float> Observer::compare(const ColorPlanes& reference, const ColorPlanes& test,
                                         const std::optional<Exposed>& exposed) {
    filter_rows(reference, exposed, reference_);
    filter_rows(test, exposed, test_);
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, height_, 8), [&](const tbb::blocked_range<std::uint32_t>& range) {
        Rows a, b;
        for (std::uint32_t y = range.begin(); y < range.end(); ++y) {
            filter_columns(reference_, y, a);
            filter_columns(test_, y, b);
            compare_row(a, b, std::span(map_).subspan(std::size_t(y) * width_, width_));
        }
    });
    return map_;
}

}  // namespace strata
