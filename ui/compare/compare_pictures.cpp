#include "ui/compare/compare_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "capture_format/srgb.h"
#include "replay/images/image_io.h"

namespace strata::ui {
namespace {

using Pixels = std::shared_ptr<const HostImage>;

Format float_format(std::uint32_t channels) {
    return channels == 1 ? Format::r32f : channels == 2 ? Format::rg32f : Format::rgba32f;
}

/// An image whose every value is made by the caller: value(x, y, layer, channel).
template <typename Value>
Pixels floats(Shape shape, std::uint32_t channels, const Value& value) {
    shape.format = float_format(channels);
    const std::uint32_t layers = shape.layers * shape.extent.depth;
    std::vector<float> made;
    made.reserve(std::size_t{row(shape.format).channels} * shape.extent.width * shape.extent.height * layers);
    for (std::uint32_t layer = 0; layer < layers; ++layer)
        for (std::uint32_t y = 0; y < shape.extent.height; ++y)
            for (std::uint32_t x = 0; x < shape.extent.width; ++x) {
                const glm::dvec4 texel = value(x, y, layer);
                for (std::uint32_t c = 0; c < row(shape.format).channels; ++c)
                    made.push_back(static_cast<float>(texel[static_cast<glm::length_t>(c)]));
            }
    const auto bytes = std::as_bytes(std::span(made));
    return std::make_shared<HostImage>(HostImage{shape, {bytes.begin(), bytes.end()}});
}

Pixels as_floats(const Pixels& image, std::uint32_t channels) {
    return floats(image->shape, channels, [&](auto x, auto y, auto layer) { return texel(*image, x, y, layer); });
}

/// What a PNG of it has.
Pixels as_bytes(const Pixels& image) {
    auto made = std::make_shared<HostImage>(HostImage{image->shape, {}});
    made->shape.format = Format::rgba8_unorm;
    const Extent& extent = image->shape.extent;
    for (std::uint32_t y = 0; y < extent.height; ++y)
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const glm::dvec4 light = texel(*image, x, y);
            for (glm::length_t c = 0; c < 3; ++c) made->texels.push_back(display_byte(light[c]));
            made->texels.push_back(std::byte{255});
        }
    return made;
}

/// The light that bytes stand for; display_byte() gives the bytes back.
Pixels as_light(const HostImage& bytes) {
    return floats(bytes.shape, 4, [&](auto x, auto y, auto layer) {
        const glm::dvec4 value = texel(bytes, x, y, layer);
        return glm::dvec4(decode_srgb(value.x), decode_srgb(value.y), decode_srgb(value.z), value.w);
    });
}

/// `to` with the other's texels where the truth cannot say.
Pixels filled(const Pixels& to, const Pixels& from, const std::vector<bool>& undecided) {
    if (undecided.empty() || to->texels.size() != from->texels.size()) return to;
    auto made = std::make_shared<HostImage>(*to);
    const std::size_t bytes = row(to->shape.format).bytes;
    for (std::size_t i = 0; i < undecided.size() && (i + 1) * bytes <= made->texels.size(); ++i)
        if (undecided[i]) std::memcpy(made->texels.data() + i * bytes, from->texels.data() + i * bytes, bytes);
    return made;
}

std::size_t count(const SidePicture& side) {
    return side.undecided ? static_cast<std::size_t>(std::ranges::count(*side.undecided, true)) : 0;
}

struct Together {
    Pixels a, b;
};

/// A truth has four channels whatever the image has.
Together beside_truth(const PicturePair& pair) {
    const auto channels = [](const SidePicture& side) { return row(side.image->shape.format).channels; };
    const std::uint32_t of_both = std::min(channels(pair.a), channels(pair.b));
    Together made{as_floats(pair.a.image, of_both), as_floats(pair.b.image, of_both)};
    if (pair.a.undecided) made.a = filled(made.a, made.b, *pair.a.undecided);
    if (pair.b.undecided) made.b = filled(made.b, made.a, *pair.b.undecided);
    return made;
}

Result<Together> bring_together(const PicturePair& pair) {
    Together made{pair.a.image, pair.b.image};
    if (pair.a.undecided || pair.b.undecided) made = beside_truth(pair);
    if (!pair.a.is_bytes && !pair.b.is_bytes) return made;
    const bool both_are_bytes = pair.a.is_bytes && pair.b.is_bytes;
    if (!both_are_bytes && content_of(pair.image, made.a->shape.format) != Content::display)
        return fail(Fault::usage, "compare.not_display_values",
                    "'{image}' has no display values, and a PNG has no others; compare 'display', or an EXR", pair.image);
    if (const auto fit = check_comparable(pair.image, *made.a, *made.b); !fit) return fit.error();
    if (made.a->shape.layers * made.a->shape.extent.depth > 1)
        return fail(Fault::usage, "compare.several_layers", "'{image}' has several layers, and a PNG has one", pair.image);
    return Together{as_bytes(made.a), as_bytes(made.b)};
}

std::string unit_of(const PicturePair& pair, const HostImage& compared) {
    if (pair.a.is_bytes || pair.b.is_bytes) return "sRGB bytes / 255";
    switch (content_of(pair.image, compared.shape.format)) {
        case Content::radiance:
            return "radiance";
        case Content::display:
            return "display light, 1: white";
        case Content::depth:
            return "depth, near / z";
        case Content::numbers:
        case Content::coded:
            break;
    }
    return "its own numbers";
}

Pixels difference_of(const Together& both) {
    const std::uint32_t channels = row(both.a->shape.format).channels;
    return floats(both.a->shape, channels, [&](auto x, auto y, auto layer) {
        const glm::dvec4 a = texel(*both.a, x, y, layer), b = texel(*both.b, x, y, layer);
        return channels == 1 ? b - a : glm::abs(b - a);
    });
}

double relative_of(double a, double b, double least) {
    return a == b ? 0 : std::abs(b - a) / std::max({std::abs(a), least, 1e-9});
}

Pixels relative_of(const Together& both, double least) {
    const std::uint32_t channels = row(both.a->shape.format).channels;
    return floats(both.a->shape, 1, [&](auto x, auto y, auto layer) {
        const glm::dvec4 a = texel(*both.a, x, y, layer), b = texel(*both.b, x, y, layer);
        double worst = 0;
        for (glm::length_t c = 0; c < static_cast<glm::length_t>(channels); ++c) {
            const double error = relative_of(a[c], b[c], least);
            // What is no number is worse than any error.
            if (std::isnan(error) || error > worst) worst = error;
            if (std::isnan(worst)) break;
        }
        return glm::dvec4(worst);
    });
}

/// Zero where nothing differs: FLIP is not computed of equal images.
Pixels flip_of(const ImageComparison& measured, const Shape& shape) {
    if (!measured.flip) return nullptr;
    const std::vector<float>& map = measured.flip->map;
    return floats({.extent = {shape.extent.width, shape.extent.height, 1}}, 1, [&](auto x, auto y, auto) {
        const std::size_t at = std::size_t{y} * shape.extent.width + x;
        return glm::dvec4(map.empty() ? 0 : double{map[at]});
    });
}

}  // namespace

SidePicture picture_of(const ReferenceImage& truth) {
    const Shape shape{.extent = {truth.width, truth.height, 1}, .layers = truth.layers};
    return {.image = floats(shape, 4, [&](auto x, auto y, auto layer) { return truth.at(x, y, layer); }),
            .undecided = std::make_shared<std::vector<bool>>(truth.undecided)};
}

Result<SidePicture> read_picture(const std::filesystem::path& path, const std::string& image) {
    const std::string kind = path.extension().string(), file = path.filename().string();
    if (kind == ".png") {
        return read_png(path).and_then(
            [&](auto& bytes) { return SidePicture{.image = as_light(bytes), .is_bytes = true, .about = file}; });
    }
    if (kind != ".exr")
        return fail(Fault::usage, "compare.file_type", "pictures are read from .png and .exr, not from '{file}'", file);
    auto images = read_exr(path);
    if (!images) return images.error();
    const auto named = images->size() == 1 ? images->begin() : images->find(image);
    if (named != images->end()) return SidePicture{.image = std::make_shared<HostImage>(std::move(named->second)), .about = file};
    std::string known;
    for (const auto& [name, each] : *images) known += fmt::format("{}'{}'", known.empty() ? "" : ", ", name);
    return fail(Fault::usage, "compare.no_image_in_file", "{file} has no image '{image}'; its images are {known}", file, image,
                known);
}

Result<ComparedPictures> compare(const PicturePair& pair) {
    const auto both = bring_together(pair);
    if (!both) return both.error();
    // Of two files of bytes the frame's name says nothing.
    const bool both_are_bytes = pair.a.is_bytes && pair.b.is_bytes;
    auto measured = compare_images(both_are_bytes ? "" : pair.image, *both->a, *both->b, {});
    if (!measured) return measured.error();
    ComparedPictures made{.pair = pair, .measured = *std::move(measured), .unit = unit_of(pair, *both->a)};
    made.undecided = count(pair.a) + count(pair.b);
    made.difference = difference_of(*both);
    made.relative = relative_of(*both, made.measured.error.reference);
    made.flip = flip_of(made.measured, both->a->shape);
    return made;
}

}  // namespace strata::ui
