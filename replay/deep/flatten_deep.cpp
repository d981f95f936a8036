#include "replay/deep/flatten_deep.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <cstring>
#include <limits>
#include <mutex>
#include <optional>

#include "capture_format/import/deep_pixel.h"

namespace strata {
namespace {

// A file of a megabyte may claim 16384 x 16384 pixels.
constexpr std::uint64_t largest_image_bytes = std::uint64_t{1} << 30;

/// The pixel composited where its samples are points, sorted and good, as nearly all are; else nothing.
std::optional<glm::dvec4> composite_sorted(const DeepBlock& block, std::size_t begin, std::size_t end) {
    double r = 0, g = 0, b = 0, through = 1, nearest = nearest_depth;
    bool good = true;
    const float *red = block.color[0].data(), *green = block.color[1].data(), *blue = block.color[2].data();
    const float *alpha = block.alpha[0].data(), *depth = block.depth.data();
    for (std::size_t i = begin; i < end; ++i) {
        const double a = double(alpha[i]), z = double(depth[i]);
        good = good && z >= nearest && a >= 0 && a <= 1;  // false for NaN
        nearest = z;
        r += through * double(red[i]);
        g += through * double(green[i]);
        b += through * double(blue[i]);
        through *= 1 - a;
    }
    // A color that is no number leaves a sum that is none: x - x is 0 for numbers only.
    if (!good || nearest > farthest_depth || r + g + b - (r + g + b) != 0) return std::nullopt;
    return glm::dvec4(r, g, b, 1 - through);
}

class Flattening {
public:
    explicit Flattening(const DeepFile& file)
        : file_(file),
          points_(!file.has(DeepChannel::back) && !file.has(DeepChannel::alpha_red) && !file.has(DeepChannel::alpha_green) &&
                  !file.has(DeepChannel::alpha_blue)),
          flat_{.window = file.data_window()} {
        flat_.image.shape = {.extent = {flat_.window.width, flat_.window.height, 1}, .format = Format::rgba32f};
    }

    Result<FlatDeep> run() {
        if (bytes(flat_.image.shape) > largest_image_bytes)
            return fail(Fault::bad_input, "deep.too_many_pixels", "{width} x {height} pixels are too many to flatten",
                        flat_.window.width, flat_.window.height);
        flat_.image.texels.resize(bytes(flat_.image.shape));
        oneapi::tbb::enumerable_thread_specific<DeepBlock> reused;
        oneapi::tbb::parallel_for(std::size_t{0}, file_.blocks(), [&](std::size_t i) {
            auto block = file_.read(i, std::move(reused.local()));
            const Result<void> done = block ? add(*block) : block.error();
            if (block) reused.local() = *std::move(block);
            if (done) return;
            const std::lock_guard lock(failing_);
            if (i <= failed_) failed_ = i, problem_ = done.error();
        });
        if (problem_) return *problem_;
        return std::move(flat_);
    }

private:
    Result<void> add(const DeepBlock& block) {
        DeepCensus census;
        const std::size_t width = block.window.width;
        for (std::size_t i = 0; i + 1 < block.begin.size(); ++i) {
            std::optional<glm::dvec4> color;
            if (points_) color = composite_sorted(block, block.begin[i], block.begin[i + 1]);
            if (!color) {
                const auto samples = pixel_samples(block, i, census);
                if (!samples) return samples.error();
                color = composite(*samples);
            }
            const auto x = static_cast<std::size_t>(block.window.x - flat_.window.x) + i % width;
            const auto y = static_cast<std::size_t>(block.window.y - flat_.window.y) + i / width;
            const glm::vec4 texel(*color);
            std::memcpy(&flat_.image.texels[(y * flat_.window.width + x) * sizeof texel], &texel, sizeof texel);
        }
        return {};
    }

    const DeepFile& file_;
    const bool points_;  ///< no volumes and one alpha for all channels
    FlatDeep flat_;
    std::mutex failing_;
    std::size_t failed_ = std::numeric_limits<std::size_t>::max();  ///< the first block that failed, whatever the threads do
    std::optional<Error> problem_;
};

}  // namespace

Result<FlatDeep> flatten_deep(std::span<const std::byte> bytes, std::string_view name, std::string_view part) {
    const auto file = DeepFile::open(bytes, name, part);
    if (!file) return file.error();
    auto flat = Flattening(*file).run();
    if (!flat) return within(flat.error(), "{file}", name);
    return flat;
}

}  // namespace strata
