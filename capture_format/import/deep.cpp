// Samples become triangles of one mesh, submitted far to near: of equal depths the renderer takes the later submission for the
// nearer one, so the earlier sample of the file comes last.
#include "capture_format/import/deep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "capture_format/container/file.h"
#include "capture_format/container/picture.h"
#include "capture_format/import/deep_pixel.h"
#include "capture_format/inspection.h"
#include "capture_format/memory_budget.h"

namespace strata {
namespace {

/// Corners of a sample's triangle in pixels from the pixel's upper left corner. It holds Vulkan's four standard sample positions,
/// the center, and the lower right corner, which is the center of a pixel at half extent (thumbnails, quick truths); and none of
/// these points of any other pixel. All of them stay 8.8 steps of 1/256 pixel off its sides, the most that a search found, so
/// that no rounding of a vertex or of the rasterizer decides what is covered.
constexpr std::array<glm::dvec2, 3> corners = {{{.8604, -.2404}, {-.4087, .6061}, {1.2512, 1.3509}}};

/// Three vertices of position and color with their indices. They are there four times while the frame is recorded: in its meshes,
/// in the recorder's blobs, rearranged, and compressed.
constexpr std::uint64_t bytes_per_fragment = 4 * 3 * (sizeof(glm::vec3) + sizeof(glm::vec4) + sizeof(std::uint32_t));

/// Events below both are dropped by every technique (docs/algorithms/transparency.md 0.2).
constexpr double least_alpha = 1e-5;

/// Which channels of a mesh's samples hide what is behind: all, or with chromatic alpha one of three.
struct Layer {
    const char* name;
    glm::vec3 transmission;
};
constexpr Layer grey[] = {{"deep samples", glm::vec3(0)}};
// A sample that hides red, green and blue differently is three at one depth: channels do not know of each other.
constexpr Layer chromatic[] = {{"deep samples, red", glm::vec3(0, 1, 1)},
                               {"deep samples, green", glm::vec3(1, 0, 1)},
                               {"deep samples, blue", glm::vec3(1, 1, 0)}};

class DeepImport {
public:
    DeepImport(const DeepFile& file, const DeepOptions& options)
        : file_(file),
          options_(options),
          window_(options.window.value_or(file.display_window())),
          read_(options.window.value_or(file.data_window())),
          small_(thumbnail_extent(window_.width, window_.height)),
          layers_(is_chromatic() ? std::span<const Layer>(chromatic) : grey) {}

    Result<ImportedDeep> run() {
        if (window_.width < 1 || window_.height < 1 || window_.width > largest_extent || window_.height > largest_extent)
            return fail(Fault::usage, "a window has 1 to {} pixels each way, not {} x {}", largest_extent, window_.width,
                        window_.height);
        const auto count = file_.count_samples(read_, options_.most_samples);
        if (!count) return count.error();
        MemoryBudget budget(options_.memory_budget);
        if (const auto room = budget.take(*count * layers_.size(), bytes_per_fragment, "the image's samples"); !room)
            return room.error();
        set_view();
        meshes_.resize(layers_.size());
        for (Mesh& mesh : meshes_) {
            mesh.positions.reserve(3 * *count);
            mesh.colors.reserve(3 * *count);
            mesh.indices.reserve(3 * *count);
        }
        result_.preview.resize(std::size_t{small_.width} * small_.height);
        DeepBlock block;
        for (std::size_t i = 0; i < file_.blocks(); ++i) {
            if (!overlap(file_.window(i), read_)) continue;
            auto read = file_.read(i, std::move(block));
            if (!read) return read.error();
            block = *std::move(read);
            if (const auto done = add(block); !done) return done.error();
        }
        place_infinite_samples();
        set_near();
        add_draws();
        warn();
        return std::move(result_);
    }

private:
    bool is_chromatic() const {
        return file_.has(DeepChannel::alpha_red) || file_.has(DeepChannel::alpha_green) || file_.has(DeepChannel::alpha_blue);
    }

    /// One unit wide at one unit of depth where the window is wider than high. Pixels are square, whatever the file says.
    void set_view() {
        View& view = result_.frame.view;
        view.width = window_.width;
        view.height = window_.height;
        const double edge = std::max(view.width, view.height);
        view.projection[0][0] = static_cast<float>(2 * edge / view.width);
        view.projection[1][1] = static_cast<float>(-2 * edge / view.height);
        view.projection[2][3] = 1;
    }

    Result<void> add(const DeepBlock& block) {
        const DeepWindow& window = block.window;
        for (std::size_t i = 0; i + 1 < block.begin.size(); ++i) {
            if (block.begin[i] == block.begin[i + 1]) continue;
            const std::int64_t x = std::int64_t{window.x} - window_.x + std::int64_t(i % window.width);
            const std::int64_t y = std::int64_t{window.y} - window_.y + std::int64_t(i / window.width);
            if (x < 0 || y < 0 || x >= window_.width || y >= window_.height) {
                result_.census.outside += block.begin[i + 1] - block.begin[i];
                continue;
            }
            const auto samples = pixel_samples(block, i, result_.census);
            if (!samples) return samples.error();
            add_pixel(glm::uvec2(x, y), *samples);
        }
        return {};
    }

    void add_pixel(const glm::uvec2& pixel, const std::vector<DeepSample>& nearest_first) {
        DeepCensus& census = result_.census;
        if (nearest_first.empty()) return;
        ++census.pixels;
        if (const glm::uvec2 texel = pixel / small_.pixels; texel.x < small_.width && texel.y < small_.height) {
            const glm::uvec2 left = glm::uvec2(window_.width, window_.height) - texel * small_.pixels;
            const glm::dvec2 covered(glm::min(left, glm::uvec2(small_.pixels)));
            result_.preview[texel.y * small_.width + texel.x] += glm::dvec3(composite(nearest_first)) / (covered.x * covered.y);
        }
        census.deepest = std::max<std::uint64_t>(census.deepest, nearest_first.size());
        for (auto sample = nearest_first.rbegin(); sample != nearest_first.rend(); ++sample) {
            const glm::dvec3 &color = sample->color, &alpha = sample->alpha;
            const double brightest = std::max({color.x, color.y, color.z}), densest = std::max({alpha.x, alpha.y, alpha.z});
            if (densest == 0 && brightest > 0) ++census.without_alpha;
            if (densest < least_alpha && brightest < least_alpha) ++census.faint;
            DeepSample placed = *sample;
            placed.depth = std::max(placed.depth, nearest_depth);
            if (std::isinf(placed.depth)) infinite_.emplace_back(meshes_[0].positions.size(), pixel);
            else nearest_ = std::min(nearest_, placed.depth), farthest_ = std::max(farthest_, placed.depth);
            for (int layer = 0; layer < int(layers_.size()); ++layer) add_triangle(layer, pixel, placed);
        }
    }

    void add_triangle(int layer, const glm::dvec2& pixel, const DeepSample& sample) {
        Mesh& mesh = meshes_[static_cast<std::size_t>(layer)];
        const glm::dvec3 alone = glm::dvec3(1) - glm::dvec3(layers_[static_cast<std::size_t>(layer)].transmission);
        const glm::vec4 color(sample.color * alone, sample.alpha[layer]);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(position(pixel, corner, sample.depth));
            mesh.colors.push_back(color);
        }
        ++result_.census.fragments;
    }

    glm::vec3 position(const glm::dvec2& pixel, std::size_t corner, double depth) const {
        const View& view = result_.frame.view;
        const glm::dvec2 ndc = (pixel + corners[corner]) / glm::dvec2(view.width, view.height) * 2.0 - 1.0;
        return {ndc.x / double(view.projection[0][0]) * depth, ndc.y / double(view.projection[1][1]) * depth, depth};
    }

    /// What is infinitely far lies at twice the depth of the farthest other sample.
    void place_infinite_samples() {
        const double depth = farthest_ > 0 ? 2 * farthest_ : 1;
        if (!infinite_.empty()) nearest_ = std::min(nearest_, depth);
        for (const auto& [first, pixel] : infinite_)
            for (Mesh& mesh : meshes_)
                for (std::size_t corner = 0; corner < 3; ++corner)
                    mesh.positions[first + corner] = position(pixel, corner, depth);
    }

    /// A power of two at most half as far as the nearest sample.
    void set_near() {
        View& view = result_.frame.view;
        const bool empty = nearest_ == std::numeric_limits<double>::max();
        view.near = empty ? 0.125f : static_cast<float>(std::exp2(std::floor(std::log2(nearest_)) - 1));
        view.projection[3][2] = view.near;
    }

    void add_draws() {
        Frame& frame = result_.frame;
        if (meshes_[0].positions.empty()) return;
        for (std::size_t i = 0; i < layers_.size(); ++i) {
            const auto index = static_cast<std::uint32_t>(i);
            Material material{.name = layers_[i].name,
                              .lighting_model = LightingModel::unlit,
                              .alpha_mode = AlphaMode::premultiplied,
                              .transmission = layers_[i].transmission,
                              .double_sided = true};
            meshes_[i].name = layers_[i].name;
            frame.draws.push_back({.name = layers_[i].name, .mesh = index, .material = index, .casts_shadow = false});
            frame.meshes.push_back(std::move(meshes_[i]));
            frame.materials.push_back(std::move(material));
        }
    }

    void warn() {
        const DeepCensus& c = result_.census;
        const auto say = [&](std::uint64_t count, std::string_view what) {
            if (count > 0) result_.warnings.push_back(fmt::format("{} {}", count, what));
        };
        for (const std::string& channel : file_.ignored())
            result_.warnings.push_back(fmt::format("channel '{}' is ignored", channel));
        if (file_.deep_parts() > 1)
            result_.warnings.push_back(fmt::format("the file has {} deep parts; one is read", file_.deep_parts()));
        warn_of_missing_channels();
        say(c.unsorted_pixels, "pixels are not sorted by depth: they are now");
        say(c.ties, "samples lie at the depth of the one before: the earlier one counts as nearer");
        say(c.volumes, "samples are volumes (ZBack beyond Z): each is a fragment at its front");
        say(c.split_pixels, "pixels have overlapping volumes, which were cut and merged");
        say(c.depth_not_a_number, "samples are left out: their depth is NaN");
        say(c.depth_not_in_front, "samples are left out: their depth is not in front of the eye (0 or below)");
        say(c.depth_too_near, "samples are nearer than 1e-15: they are put there, in their order");
        say(c.depth_infinite, "samples are infinitely far: they are put behind all others");
        say(c.bad_color, "samples have a color or alpha that is NaN or infinite: it became 0");
        say(c.bad_alpha, "samples have an alpha below 0 or above 1: it was clamped");
        say(c.without_alpha, "samples have light but no alpha: they add and hide nothing");
        say(c.faint, "samples are fainter than 1e-5 in alpha and color: no technique draws them");
        if (!options_.window) say(c.outside, "samples are left out: they lie outside of the display window");
        if (result_.frame.draws.empty()) result_.warnings.emplace_back("there is no sample to be seen");
    }

    void warn_of_missing_channels() {
        const bool red = file_.has(DeepChannel::red), green = file_.has(DeepChannel::green), blue = file_.has(DeepChannel::blue);
        std::vector<std::string>& warnings = result_.warnings;
        if (!red && !green && !blue)
            warnings.emplace_back(file_.has(DeepChannel::grey) ? "there is no color: Y is taken for all three channels"
                                                               : "there is no color: the samples are black");
        else if (!red || !green || !blue) warnings.emplace_back("color channels are missing: they are black");
        if (!file_.has(DeepChannel::alpha) && !is_chromatic()) warnings.emplace_back("there is no alpha: every sample is opaque");
        if (is_chromatic()) warnings.emplace_back("alpha differs by channel: every sample is three fragments, one per channel");
    }

    const DeepFile& file_;
    const DeepOptions& options_;
    const DeepWindow window_;  ///< of the image that is the frame
    const DeepWindow read_;    ///< whose blocks are read: all, unless a window was asked for
    const ThumbnailExtent small_;
    std::span<const Layer> layers_;
    ImportedDeep result_;
    std::vector<Mesh> meshes_;                                  ///< one per layer
    std::vector<std::pair<std::size_t, glm::dvec2>> infinite_;  ///< first vertex and pixel
    double nearest_ = std::numeric_limits<double>::max(), farthest_ = 0;
};

}  // namespace

Result<ImportedDeep> import_deep(std::span<const std::byte> bytes, std::string_view name, const DeepOptions& options) {
    const auto file = DeepFile::open(bytes, name, options.part);
    if (!file) return file.error();
    auto imported = DeepImport(*file, options).run();
    if (!imported) return fail(imported.error().fault, "{}: {}", name, imported.error().sentence);
    return imported;
}

Result<ImportedDeep> import_deep(const std::filesystem::path& path, const DeepOptions& options) {
    return ReadableFile::open(path).and_then([](auto& file) { return file.read(0, file.size()); }).and_then([&](auto& bytes) {
        return import_deep(bytes, path.filename().string(), options);
    });
}

}  // namespace strata
