#include "tests/support/plain_flip.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/glm.hpp>

namespace strata {
namespace {

using std::numbers::pi;

struct Plane {
    int width = 0, height = 0;
    std::vector<double> values;

    Plane(int w, int h) : width(w), height(h), values(std::size_t(w) * std::size_t(h)) {}
    /// Beyond its border an image goes on as its border.
    double clamped(int x, int y) const {
        const auto column = std::size_t(std::clamp(x, 0, width - 1)), row = std::size_t(std::clamp(y, 0, height - 1));
        return values[row * std::size_t(width) + column];
    }
    double& at(int x, int y) { return values[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

using Colors = std::vector<glm::dvec3>;

struct Picture {
    int width = 0, height = 0;
    Colors pixels;
};

// BT.709 primaries and white point D65 (0.3127, 0.3290): columns are the XYZ of red, green and blue.
const glm::dmat3 xyz_of_rgb(0.4123865632529917, 0.2126368216773238, 0.0193306201524840,  //
                            0.3575914909206253, 0.7151829818412506, 0.1191971636402085,  //
                            0.1804504912035636, 0.0721801964814255, 0.9503725870054354);
const glm::dvec3 white = xyz_of_rgb * glm::dvec3(1);

glm::dvec3 opponent(const glm::dvec3& rgb) {
    const glm::dvec3 v = xyz_of_rgb * rgb / white;
    return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}

glm::dvec3 rgb_of_opponent(const glm::dvec3& c) {
    const double y = (c.x + 16) / 116;
    return glm::inverse(xyz_of_rgb) * (glm::dvec3(y + c.y / 500, y, y - c.z / 200) * white);
}

double lab_curve(double t) { return t > std::pow(6. / 29, 3) ? std::cbrt(t) : t * 841 / 108 + 4. / 29; }

/// CIELAB with Hunt's adjustment: colors matter less in the dark.
glm::dvec3 hunt_lab(const glm::dvec3& rgb) {
    const glm::dvec3 v = xyz_of_rgb * rgb / white;
    const double x = lab_curve(v.x), y = lab_curve(v.y), z = lab_curve(v.z), lightness = 116 * y - 16;
    return {lightness, .01 * lightness * 500 * (x - y), .01 * lightness * 200 * (y - z)};
}

double hyab(const glm::dvec3& a, const glm::dvec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

using Kernel = std::vector<double>;  // 2 radius + 1 weights

Plane filter(const Plane& in, const Kernel& across, const Kernel& down) {
    const int radius = static_cast<int>(across.size() / 2);
    Plane half(in.width, in.height), out(in.width, in.height);
    for (int y = 0; y < in.height; ++y)
        for (int x = 0; x < in.width; ++x)
            for (int k = -radius; k <= radius; ++k) half.at(x, y) += across[std::size_t(k + radius)] * in.clamped(x + k, y);
    for (int y = 0; y < in.height; ++y)
        for (int x = 0; x < in.width; ++x)
            for (int k = -radius; k <= radius; ++k) out.at(x, y) += down[std::size_t(k + radius)] * half.clamped(x, y + k);
    return out;
}

Kernel kernel(int radius, const std::function<double(double)>& weight) {
    Kernel weights;
    for (int k = -radius; k <= radius; ++k) weights.push_back(weight(k));
    return weights;
}

double sum(const Kernel& weights) {
    double total = 0;
    for (const double w : weights) total += w;
    return total;
}

/// Contrast sensitivity in space (2020, equation 3): a1 and b1, a2 and b2.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity achromatic{1, .0047, 0, 1e-5}, red_green{1, .0053, 0, 1e-5}, blue_yellow{34.1, .04, 13.5, .025};

Plane see(const Plane& in, const Sensitivity& s, double pixels_per_degree) {
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(blue_yellow.b1 / (2 * pi * pi)) * pixels_per_degree));
    const auto gauss = [&](double b) {
        return kernel(radius, [=](double k) { return std::exp(-pi * pi * k * k / (b * pixels_per_degree * pixels_per_degree)); });
    };
    const Kernel g1 = gauss(s.b1), g2 = gauss(s.b2);
    const double f1 = s.a1 * std::sqrt(pi / s.b1), f2 = s.a2 * std::sqrt(pi / s.b2);
    const Plane one = filter(in, g1, g1), two = filter(in, g2, g2);
    const double total = f1 * sum(g1) * sum(g1) + f2 * sum(g2) * sum(g2);
    Plane out(in.width, in.height);
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] = (f1 * one.values[i] + f2 * two.values[i]) / total;
    return out;
}

/// Strength of edges and of points in the lightness (2020, section 4.2).
struct Features {
    Plane edges, points;
};

Plane magnitude(const Plane& lightness, const Kernel& derivative, const Kernel& gauss) {
    const Plane x = filter(lightness, derivative, gauss), y = filter(lightness, gauss, derivative);
    Plane out(x.width, x.height);
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] = std::hypot(x.values[i], y.values[i]);
    return out;
}

Features find_features(const Plane& lightness, double pixels_per_degree) {
    const double deviation = .5 * .082 * pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto gauss = [=](double k) { return std::exp(-k * k / (2 * deviation * deviation)); };
    Kernel g = kernel(radius, gauss);
    Kernel first = kernel(radius, [&](double k) { return -k * gauss(k); });
    Kernel second = kernel(radius, [&](double k) { return (k * k / (deviation * deviation) - 1) * gauss(k); });
    // Positive weights sum to 1 and negative ones to -1, over the square kernel.
    const double total = sum(g);
    for (double& w : g) w /= total;
    for (Kernel* weights : {&first, &second}) {
        double positive = 0, negative = 0;
        for (const double w : *weights) (w > 0 ? positive : negative) += w;
        for (double& w : *weights) w /= w > 0 ? positive : -negative;
    }
    return {magnitude(lightness, first, g), magnitude(lightness, second, g)};
}

struct Seen {
    Colors lab;
    Features features;
};

Seen look(const Picture& picture, double pixels_per_degree) {
    std::vector<Plane> planes(3, Plane(picture.width, picture.height));
    Plane lightness(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const glm::dvec3 c = opponent(picture.pixels[i]);
        for (int k = 0; k < 3; ++k) planes[std::size_t(k)].values[i] = c[k];
        lightness.values[i] = (c.x + 16) / 116;
    }
    const Plane y = see(planes[0], achromatic, pixels_per_degree), cx = see(planes[1], red_green, pixels_per_degree),
                cz = see(planes[2], blue_yellow, pixels_per_degree);
    Seen seen{{}, find_features(lightness, pixels_per_degree)};
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        seen.lab.push_back(
            hunt_lab(glm::clamp(rgb_of_opponent({y.values[i], cx.values[i], cz.values[i]}), glm::dvec3(0), glm::dvec3(1))));
    return seen;
}

std::vector<double> map_of(const Picture& reference, const Picture& test, double pixels_per_degree) {
    const Seen a = look(reference, pixels_per_degree), b = look(test, pixels_per_degree);
    const double largest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), .7), knee = .4 * largest;
    std::vector<double> map;
    for (std::size_t i = 0; i < a.lab.size(); ++i) {
        const double error = std::pow(hyab(a.lab[i], b.lab[i]), .7);
        const double color = error < knee ? .95 / knee * error : .95 + (error - knee) / (largest - knee) * .05;
        const double edges = std::abs(a.features.edges.values[i] - b.features.edges.values[i]);
        const double points = std::abs(a.features.points.values[i] - b.features.points.values[i]);
        const double feature = std::sqrt(std::max(edges, points) / std::sqrt(2.));
        map.push_back(std::pow(color, 1 - feature));
    }
    return map;
}

/// Narkowicz's fit of the ACES curve, without its pre-exposure of 0.6.
double aces(double x) {
    x *= .6;
    return x * (2.51 * x + .03) / (x * (2.43 * x + .59) + .14);
}

/// Hable 2010, John Hable's constants A = .15 ... W = 11.2 multiplied out (FLIP's own table of coefficients).
double hable(double x) { return (.231683 * x * x + .013791 * x) / (.18 * x * x + .3 * x + .018); }

glm::dvec3 tone_mapped(glm::dvec3 light, const std::string& mapper) {
    light = glm::max(light, glm::dvec3(0));
    if (mapper == "reinhard") light /= 1 + glm::dot(light, glm::dvec3(.2126, .7152, .0722));
    if (mapper == "aces") light = {aces(light.x), aces(light.y), aces(light.z)};
    if (mapper == "hable") light = {hable(light.x), hable(light.y), hable(light.z)};
    return glm::clamp(light, 0., 1.);
}

Picture picture_of(const ColorPlanes& planes, const std::function<glm::dvec3(glm::dvec3)>& shown) {
    Picture picture{static_cast<int>(planes.width), static_cast<int>(planes.height), {}};
    for (std::size_t i = 0; i < planes.rgb[0].size(); ++i)
        picture.pixels.push_back(shown({double(planes.rgb[0][i]), double(planes.rgb[1][i]), double(planes.rgb[2][i])}));
    return picture;
}

PlainFlip pooled(std::vector<double> map) {
    double total = 0;
    for (const double v : map) total += v;
    const double count = double(map.size());
    return {std::move(map), total / count};
}

}  // namespace

PlainFlip plain_display_flip(const ColorPlanes& reference, const ColorPlanes& test, double pixels_per_degree) {
    const auto shown = [](glm::dvec3 light) { return glm::clamp(light, 0., 1.); };
    return pooled(map_of(picture_of(reference, shown), picture_of(test, shown), pixels_per_degree));
}

PlainFlip plain_radiance_flip(const ColorPlanes& reference, const ColorPlanes& test, const ExposureRange& range,
                              const std::string& tone_mapper) {
    std::vector<double> worst(reference.rgb[0].size());
    for (std::uint32_t i = 0; i < range.count; ++i) {
        const double exposure = std::exp2(range.start + (range.stop - range.start) * i / std::max(1u, range.count - 1));
        const auto shown = [&](glm::dvec3 light) { return tone_mapped(light * exposure, tone_mapper); };
        const std::vector<double> map =
            map_of(picture_of(reference, shown), picture_of(test, shown), pixels_per_degree_of_a_desk);
        for (std::size_t p = 0; p < map.size(); ++p) worst[p] = std::max(worst[p], map[p]);
    }
    return pooled(std::move(worst));
}

}  // namespace strata
