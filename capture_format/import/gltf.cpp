#include "capture_format/import/gltf.h"

#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/import/gltf_files.h"
#include "capture_format/import/gltf_frame.h"
#include "capture_format/import/gltf_load.h"
#include "capture_format/out_of_memory.h"

namespace strata {
namespace {

Error two_cameras(std::string_view option, std::string_view other) {
    return fail(Fault::usage, "import.gltf.two_cameras", "{option} and {other} each choose the camera: pass one of them", option,
                other);
}

Result<void> check(const GltfOptions& options) {
    const double azimuth = options.azimuth.value_or(0), elevation = options.elevation.value_or(0);
    if (!(std::abs(azimuth) <= 360 && std::abs(elevation) < 90)) {
        return fail(Fault::usage, "import.gltf.orbit_range",
                    "--azimuth must be -360 to 360 degrees and --elevation between -90 and 90, not {azimuth} and {elevation}",
                    azimuth, elevation);
    }
    if ((options.azimuth || options.elevation) && (options.eye || options.inside))
        return two_cameras("--azimuth or --elevation", options.eye ? "--eye" : "--inside");
    if (options.target && !options.eye)
        return fail(Fault::usage, "import.gltf.target_without_eye", "--target needs --eye, the place to look from");
    if (options.eye && (options.inside || options.camera >= 0))
        return two_cameras("--eye", options.inside ? "--inside" : "--camera");
    if (options.inside && options.camera >= 0) return two_cameras("--camera", "--inside");
    if (options.eye && options.target && *options.eye == *options.target)
        return fail(Fault::usage, "import.gltf.eye_is_target", "the eye and its target are the same point");
    if (options.fov && !(*options.fov >= 1 && *options.fov <= 170))
        return fail(Fault::usage, "import.gltf.fov_range", "the field of view must be 1 to 170 degrees, not {fov}", *options.fov);
    if (options.exposure && !(std::isfinite(*options.exposure) && *options.exposure > 0))
        return fail(Fault::usage, "import.gltf.exposure_range", "the exposure must be above 0, not {exposure}",
                    *options.exposure);
    if (options.width == 0 || options.height == 0 || (options.samples != 1 && options.samples != 4)) {
        return fail(Fault::usage, "import.gltf.extent", "{width} x {height} pixels with {samples} samples cannot be rendered",
                    options.width, options.height, options.samples);
    }
    if (options.fps && !(*options.fps > 0 && *options.fps <= 1e6)) {
        return fail(Fault::usage, "import.gltf.fps_range", "frames per second must be above 0 and at most 1000000, not {fps}",
                    *options.fps);
    }
    return {};
}

}  // namespace

struct GltfScene::Contents {
    Contents(std::string from, gltf::Document document, const GltfOptions& options, MemoryBudget budget)
        : name(std::move(from)), source(std::move(document), options, budget) {}

    std::string name;
    gltf::FrameSource source;
};

GltfScene::GltfScene(std::unique_ptr<Contents> contents) : contents_(std::move(contents)) {}
GltfScene::GltfScene(GltfScene&&) noexcept = default;
GltfScene& GltfScene::operator=(GltfScene&&) noexcept = default;
GltfScene::~GltfScene() = default;

Result<GltfScene> GltfScene::read(std::vector<std::byte> bytes, const gltf::Folder& folder, std::string name,
                                  const GltfOptions& options) {
    if (const auto good = check(options); !good) return good.error();
    MemoryBudget budget(options.memory_budget);
    if (const auto room = budget.take(bytes.size(), 1, "the file"); !room) return room.error();
    auto document = gltf::load_document(std::move(bytes), folder, budget);
    if (!document && document.error().fault == Fault::device_lacks)  // nothing is known to be wrong with the file
        return within(document.error(), "{file}", name);
    if (!document) return within(document.error(), "{file} is not a readable glTF", name);
    auto contents = std::make_unique<Contents>(std::move(name), *std::move(document), options, budget);
    if (const auto read = contents->source.read(); !read) {
        return within(read.error(), "{file}", contents->name);
    }
    return GltfScene(std::move(contents));
}

Result<GltfScene> GltfScene::open(const std::filesystem::path& path, const GltfOptions& options) {
    return within_memory("import", path.native(), [&] {
        MemoryBudget budget(options.memory_budget);
        return gltf::read_file(path, budget).and_then([&](auto& bytes) {
            return read(std::move(bytes), gltf::Folder(path), path.string(), options);
        });
    });
}

Result<GltfScene> GltfScene::open(std::span<const std::byte> bytes, const std::string& name, const GltfOptions& options) {
    return within_memory("import", name, [&] { return read({bytes.begin(), bytes.end()}, gltf::Folder(), name, options); });
}

Result<Frame> GltfScene::frame(std::uint32_t index) {
    return within_memory("import", contents_->name, [&]() -> Result<Frame> {
        auto frame = contents_->source.frame(index);
        if (!frame) return within(frame.error(), "{file}", contents_->name);
        return frame;
    });
}

const std::vector<std::string>& GltfScene::warnings() const { return contents_->source.warnings(); }

Result<ImportedScene> import_gltf(const std::filesystem::path& path, const GltfOptions& options) {
    auto scene = GltfScene::open(path, options);
    if (!scene) return scene.error();
    return scene->frame(0).and_then([&](auto& frame) { return ImportedScene{std::move(frame), scene->warnings()}; });
}

}  // namespace strata
