#include "passes/lens/depth_of_field/focus_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <tbb/parallel_for.h>

#include "capture_format/frame/frame.h"
#include "passes/lens/depth_of_field/xray_model.h"
#include "passes/lens/lens.shared.h"
#include "passes/reference/pcg.h"
#include "passes/stage_input.h"

namespace strata::lens {
namespace {

using std::numbers::pi;
constexpr double sharp = .5;

struct Pixel {
    std::uint32_t x = 0, y = 0, sample = 0;
};

bool is_number(const glm::dvec4& c) { return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z); }

/// A color with the share of the pixel that it covers.
struct Layer {
    glm::dvec3 sum{0};
    double covered = 0;
    int taps = 0;  ///< that fall on it
    void add(const glm::dvec4& color, double share) {
        sum += share * glm::dvec3(color);
        covered += share;
        taps += share > 0;
    }
    glm::dvec3 mean() const { return covered > 0 ? sum / covered : glm::dvec3(0); }
};

class Gather {
public:
    Gather(const StageInput& stage, const ReferenceImage& image, const LensParams& params)
        : input(stage),
          color(image),
          most(double(params.focus_reach) * stage.frame.view.height),
          half_taps(params.focus_taps == focus_taps_16    ? 8
                    : params.focus_taps == focus_taps_64  ? 32
                    : params.focus_taps == focus_taps_128 ? 64
                                                          : 128),
          across((image.width + 7) / 8) {
        blurs.resize(color.texels.size());
        for (std::uint32_t s = 0; s < color.layers; ++s)
            for (std::uint32_t y = 0; y < color.height; ++y)
                for (std::uint32_t x = 0; x < color.width; ++x)
                    blurs[color.index(x, y, s)] = std::clamp(blur_radius(input.frame, depth_of(input, x, y, s)), -most, most);
        find_reach();
    }

    /// The color of a sample, and whether rounding may change it.
    std::pair<glm::dvec3, bool> seen(const Pixel& p) const {
        const std::size_t tile = p.y / 8 * across + p.x / 8;
        const std::size_t i = color.index(p.x, p.y, p.sample);
        const glm::dvec4& own = color.texels[i];
        bool doubtful = doubtful_tiles[tile] || std::abs(std::abs(blurs[i]) - sharp) < 1e-5;
        if (reach[tile] <= sharp) return {glm::dvec3(own), doubtful && std::abs(reach[tile] - sharp) < 1e-5};
        Layers layers;
        if (is_number(own)) layers.on.add(own, 1 / disc_area(blurs[i]));
        doubtful |= add_taps(p, layers);
        if (std::abs(blurs[i]) > sharp) return {composed(layers, own), doubtful};
        if (layers.before.covered == 0) return {glm::dvec3(own), doubtful};
        const double share = std::min(layers.before.covered, 1.);
        return {(1 - share) * glm::dvec3(own) + share * layers.before.mean(), doubtful};
    }

    /// Taps that fall before a sample's surface, on it and behind it.
    glm::dvec3 counted(const Pixel& p) const {
        if (reach[p.y / 8 * across + p.x / 8] <= sharp) return glm::dvec3(0);
        Layers layers;
        add_taps(p, layers);
        if (std::abs(blurs[color.index(p.x, p.y, p.sample)]) <= sharp) return glm::dvec3(layers.before.taps, 0, 0);
        return {layers.before.taps, layers.on.taps, layers.behind.taps};
    }

private:
    struct Layers {
        Layer before, on, behind;
    };

    /// Adds all taps of a sample; whether rounding may move one to another.
    bool add_taps(const Pixel& p, Layers& layers) const {
        const double outer = reach[p.y / 8 * across + p.x / 8] + .5;
        const double inner = std::min(std::abs(blurs[color.index(p.x, p.y, p.sample)]) + .5, outer);
        const std::uint32_t hash = pcg(pcg(pcg(std::uint32_t(input.frame.seed) ^ p.x) ^ p.y));
        const double turn = 2 * std::atan((hash >> 16) / 32768. - 1);
        bool doubtful = false;
        for (int k = 0; k < 2 * half_taps; ++k) {
            const double angle = turn + (k / 2) * pi * (3 - std::sqrt(5.)) + (k % 2) * pi;
            const double away = std::sqrt((k / 2 + .5) / half_taps) * (k % 2 == 0 ? outer : inner);
            const glm::dvec2 at = glm::dvec2(p.x, p.y) + .5 + away * glm::dvec2(std::cos(angle), std::sin(angle));
            doubtful |= hangs_on_rounding(at);
            add_tap(p, at, {outer, inner}, layers);
        }
        return doubtful;
    }

    struct Discs {
        double outer, inner;
    };

    static double disc_area(double blur) { return std::max(1., pi * blur * blur); }

    /// Floats of places have steps of 1.2e-7 of the extent.
    bool hangs_on_rounding(const glm::dvec2& at) const {
        const glm::dvec2 off = glm::abs(at - glm::round(at));
        return std::min(off.x, off.y) < std::max(3e-5, 2e-7 * color.width);
    }

    /// The largest blur that comes into each tile of 8 x 8 pixels.
    void find_reach() {
        const std::uint32_t down = (color.height + 7) / 8;
        std::vector<double> own(std::size_t(across) * down);
        for (std::uint32_t s = 0; s < color.layers; ++s)
            for (std::uint32_t y = 0; y < color.height; ++y)
                for (std::uint32_t x = 0; x < color.width; ++x) {
                    double& largest = own[y / 8 * across + x / 8];
                    largest = std::max(largest, std::abs(blurs[color.index(x, y, s)]));
                }
        reach.assign(own.size(), 0);
        doubtful_tiles.assign(own.size(), false);
        for (std::size_t to = 0; to < own.size(); ++to)
            for (std::size_t from = 0; from < own.size(); ++from) {
                const auto gap = [](std::size_t a, std::size_t b) {
                    return a == b ? 0. : 8 * (double(std::max(a, b)) - double(std::min(a, b)) - 1) + 1;
                };
                const double apart = std::hypot(gap(to % across, from % across), gap(to / across, from / across));
                if (own[from] + 1 >= apart) reach[to] = std::max(reach[to], own[from]);
                if (std::abs(own[from] + 1 - apart) < 1e-4) doubtful_tiles[to] = true;
            }
    }

    void add_tap(const Pixel& p, const glm::dvec2& at, const Discs& discs, Layers& layers) const {
        const auto x = std::uint32_t(std::clamp(std::floor(at.x), 0., color.width - 1.));
        const auto y = std::uint32_t(std::clamp(std::floor(at.y), 0., color.height - 1.));
        const std::size_t tap = color.index(x, y, p.sample);
        if ((x == p.x && y == p.y) || !is_number(color.texels[tap])) return;
        const double away = std::hypot(double(x) - p.x, double(y) - p.y);
        const double blur = blurs[tap], deeper = blur - blurs[color.index(p.x, p.y, p.sample)];
        const double in_inner = std::clamp(discs.inner - away + .5, 0., 1.);
        const double density = half_taps / pi * (1 / (discs.outer * discs.outer) + in_inner / (discs.inner * discs.inner));
        const double thrown = std::clamp(std::abs(blur) - away + .5, 0., 1.) / disc_area(blur) / density;
        if (deeper < 0) layers.before.add(color.texels[tap], std::min(-deeper, 1.) * thrown);
        if (deeper > 0) layers.behind.add(color.texels[tap], std::min(deeper, 1.) * in_inner / density / (away * away));
        layers.on.add(color.texels[tap], std::max(0., 1 - std::abs(deeper)) * thrown);
    }

    static glm::dvec3 composed(const Layers& layers, const glm::dvec4& own) {
        const auto& [before, on, behind] = layers;
        const double first = std::min(before.covered, 1.), second = std::min(on.covered, 1 - first);
        const double third = behind.covered > 0 ? 1 - first - second : 0;
        if (first + second + third == 0) return glm::dvec3(own);
        return (first * before.mean() + second * on.mean() + third * behind.mean()) / (first + second + third);
    }

    const StageInput& input;
    const ReferenceImage& color;
    double most;
    int half_taps;
    std::uint32_t across;
    std::vector<double> blurs, reach;
    std::vector<bool> doubtful_tiles;
};

}  // namespace

double blur_radius(const Frame& frame, double z) {
    const double focus = std::max(double(frame.lens.focus_distance), double(frame.view.near));
    const double pixels = std::abs(double(frame.view.projection[1][1])) * frame.view.height / 2;
    return double(frame.lens.aperture) / 2 * (1 / focus - 1 / z) * pixels;
}

double depth_of(const StageInput& input, std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
    const auto found = input.before.find("depth_layers");
    const double depth = found == input.before.end() ? 0 : found->second.at(x, y, sample).x;
    return depth > 0 ? double(input.frame.view.near) / depth : HUGE_VAL;
}

ReferenceImage focus_model(const StageInput& input, const ReferenceImage& color, const LensParams& params) {
    if (params.focus == focus_xray) return xray_focus_model(input, color);
    const Gather gather(input, color, params);
    ReferenceImage result = color;
    std::vector<char> doubtful(color.texels.size());
    tbb::parallel_for(0u, color.height * color.layers, [&](std::uint32_t row) {
        for (std::uint32_t x = 0; x < color.width; ++x) {
            const Pixel pixel{x, row % color.height, row / color.height};
            const std::size_t i = color.index(x, pixel.y, pixel.sample);
            const auto [seen, hangs] = gather.seen(pixel);
            result.texels[i] = glm::dvec4(seen, color.texels[i].w);
            doubtful[i] = hangs;
        }
    });
    result.undecided.assign(doubtful.begin(), doubtful.end());
    return result;
}

ReferenceImage counted_taps(const StageInput& input, const LensParams& params) {
    const ReferenceImage& color = input.before.at("color");
    const Gather gather(input, color, params);
    ReferenceImage counts(color.width, color.height);
    for (std::uint32_t y = 0; y < color.height; ++y)
        for (std::uint32_t x = 0; x < color.width; ++x) counts.at(x, y) = glm::dvec4(gather.counted({x, y, 0}), 1);
    return counts;
}

}  // namespace strata::lens
