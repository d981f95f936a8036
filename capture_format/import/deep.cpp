// Samples become triangles of one mesh, submitted far to near: of equal depths the renderer takes the later submission for the
// nearer one, so the earlier sample of the file comes last.
#include "capture_format/import/deep.h"

#include <oneapi/tbb/cache_aligned_allocator.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "capture_format/container/file.h"
#include "capture_format/container/picture.h"
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/import/deep_triangles.h"
#include "capture_format/inspection.h"
#include "capture_format/memory_budget.h"
#include "capture_format/out_of_memory.h"
#include "capture_format/view.h"

namespace strata {
namespace {

/// Three vertices of position and color with their indices. They are there three times while the frame is recorded: in its
/// meshes, rearranged, and compressed.
constexpr std::uint64_t bytes_per_fragment = 3 * 3 * (sizeof(glm::vec3) + sizeof(glm::vec4) + sizeof(std::uint32_t));

/// At its first use oneTBB looks for an allocator by dlopen(), which in glibc 2.36 ends a program that has no memory for a
/// message. It has when it starts.
[[maybe_unused]] const bool tbb_has_allocator = [] {
    oneapi::tbb::cache_aligned_allocator<char> allocator;
    allocator.deallocate(allocator.allocate(1), 1);
    return true;
}();

constexpr DeepLayer gray[] = {{"deep samples", glm::vec3(0)}};
// A sample that hides red, green and blue differently is three at one depth: channels do not know of each other.
constexpr DeepLayer chromatic[] = {{"deep samples, red", glm::vec3(0, 1, 1)},
                                   {"deep samples, green", glm::vec3(1, 0, 1)},
                                   {"deep samples, blue", glm::vec3(1, 1, 0)}};

void add_up(DeepCensus& sum, const DeepCensus& more) {
    using Count = std::uint64_t DeepCensus::*;
    constexpr Count added[] = {&DeepCensus::samples,
                               &DeepCensus::fragments,
                               &DeepCensus::pixels,
                               &DeepCensus::unsorted_pixels,
                               &DeepCensus::ties,
                               &DeepCensus::volumes,
                               &DeepCensus::split_pixels,
                               &DeepCensus::cuts,
                               &DeepCensus::depth_not_a_number,
                               &DeepCensus::depth_not_in_front,
                               &DeepCensus::depth_too_near,
                               &DeepCensus::depth_infinite,
                               &DeepCensus::bad_color,
                               &DeepCensus::bad_alpha,
                               &DeepCensus::without_alpha,
                               &DeepCensus::faint,
                               &DeepCensus::outside};
    static_assert(sizeof(DeepCensus) == (std::size(added) + 1) * sizeof(std::uint64_t), "a count is left out");
    for (const Count count : added) sum.*count += more.*count;
    sum.deepest = std::max(sum.deepest, more.deepest);
}

class DeepImport {
public:
    DeepImport(const DeepFile& file, const DeepOptions& options)
        : file_(file),
          options_(options),
          window_(options.window.value_or(file.display_window())),
          read_(options.window.value_or(file.data_window())),
          layers_(is_chromatic() ? std::span<const DeepLayer>(chromatic) : gray) {}

    Result<ImportedDeep> run() {
        if (window_.width < 1 || window_.height < 1 || window_.width > largest_extent || window_.height > largest_extent)
            return fail(Fault::usage, "import.deep.window_size",
                        "a window has 1 to {most} pixels each way, not {width} x {height}", largest_extent, window_.width,
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
        const ThumbnailExtent small = thumbnail_extent(window_.width, window_.height);
        result_.preview.resize(std::size_t{small.width} * small.height);
        const DeepTriangleMaker maker(window_, result_.frame.view, layers_);
        if (const auto done = add_blocks(maker); !done) return done.error();
        place_infinite_samples(maker);
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

    /// A block on its way through add_blocks().
    struct Slot {
        std::size_t block = 0;
        DeepTriangles triangles = {};
        Result<void> done = {};
    };

    /// Threads unpack blocks and make their triangles, ahead of the one that adds them in the order of the file.
    Result<void> add_blocks(const DeepTriangleMaker& maker) {
        namespace tbb = oneapi::tbb;
        std::vector<Slot> slots(2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()));  // used in turn
        tbb::enumerable_thread_specific<DeepBlock> reused;
        std::atomic<bool> failed = false;
        std::size_t taken = 0, next = 0;
        const auto take = [&](tbb::flow_control& flow) -> Slot* {
            while (next < file_.blocks() && !overlap(file_.window(next), read_)) ++next;
            if (next == file_.blocks() || failed) return flow.stop(), nullptr;
            Slot& slot = slots[taken++ % slots.size()];
            slot.block = next++;
            return &slot;
        };
        const auto make = [&](Slot* slot) {
            auto block = file_.read(slot->block, std::move(reused.local()));
            slot->done = block ? maker.make(*block, slot->triangles) : block.error();
            if (block) reused.local() = *std::move(block);
            return slot;
        };
        Result<void> result;
        const auto join = [&](const Slot* slot) {
            if (result) result = slot->done ? add(slot->triangles) : slot->done;
            failed = !result;
        };
        using Mode = tbb::filter_mode;
        try {
            tbb::parallel_pipeline(slots.size(), tbb::make_filter<void, Slot*>(Mode::serial_in_order, take) &
                                                     tbb::make_filter<Slot*, Slot*>(Mode::parallel, make) &
                                                     tbb::make_filter<Slot*, void>(Mode::serial_in_order, join));
        } catch (const std::runtime_error& refused) {  // of pthread_create, by oneTBB 2021.8
            return no_thread(refused);
        }
        return result;
    }

    Result<void> add(const DeepTriangles& block) {
        for (const auto& [first, pixel] : block.infinite) infinite_.emplace_back(meshes_[0].positions.size() + first, pixel);
        for (const auto& [texel, radiance] : block.seen) result_.preview[texel] += radiance;
        for (std::size_t i = 0; i < meshes_.size(); ++i) {
            const auto& [positions, colors] = block.layers[i];
            Mesh& mesh = meshes_[i];
            mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
            mesh.colors.insert(mesh.colors.end(), colors.begin(), colors.end());
            while (mesh.indices.size() < mesh.positions.size())
                mesh.indices.push_back(static_cast<std::uint32_t>(mesh.indices.size()));
        }
        add_up(result_.census, block.census);
        nearest_ = std::min(nearest_, block.nearest);
        farthest_ = std::max(farthest_, block.farthest);
        return check_cuts(result_.census);
    }

    /// What is infinitely far lies at twice the depth of the farthest other sample.
    void place_infinite_samples(const DeepTriangleMaker& maker) {
        const double depth = farthest_ > 0 ? 2 * farthest_ : 1;
        if (!infinite_.empty()) nearest_ = std::min(nearest_, depth);
        for (const auto& [first, pixel] : infinite_)
            for (Mesh& mesh : meshes_)
                for (std::size_t corner = 0; corner < 3; ++corner)
                    mesh.positions[first + corner] = maker.position(pixel, corner, depth);
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
            warnings.emplace_back(file_.has(DeepChannel::gray) ? "there is no color: Y is taken for all three channels"
                                                               : "there is no color: the samples are black");
        else if (!red || !green || !blue) warnings.emplace_back("color channels are missing: they are black");
        if (!file_.has(DeepChannel::alpha) && !is_chromatic()) warnings.emplace_back("there is no alpha: every sample is opaque");
        if (is_chromatic()) warnings.emplace_back("alpha differs by channel: every sample is three fragments, one per channel");
    }

    const DeepFile& file_;
    const DeepOptions& options_;
    const DeepWindow window_;  ///< of the image that is the frame
    const DeepWindow read_;    ///< whose blocks are read: all, unless a window was asked for
    std::span<const DeepLayer> layers_;
    ImportedDeep result_;
    std::vector<Mesh> meshes_;                                  ///< one per layer
    std::vector<std::pair<std::size_t, glm::dvec2>> infinite_;  ///< first vertex and pixel
    double nearest_ = std::numeric_limits<double>::max(), farthest_ = 0;
};

}  // namespace

Result<ImportedDeep> import_deep(std::span<const std::byte> bytes, std::string_view name, const DeepOptions& options) {
    return within_memory("import", name, [&]() -> Result<ImportedDeep> {
        const auto file = DeepFile::open(bytes, name, options.part);
        if (!file) return file.error();
        auto imported = DeepImport(*file, options).run();
        if (!imported) return within(imported.error(), "{file}", name);
        return imported;
    });
}

Result<ImportedDeep> import_deep(const std::filesystem::path& path, const DeepOptions& options) {
    return within_memory("import", path.native(), [&] {
        return ReadableFile::open(path).and_then([](auto& file) { return file.read(0, file.size()); }).and_then([&](auto& bytes) {
            return import_deep(bytes, path.filename().string(), options);
        });
    });
}

}  // namespace strata
