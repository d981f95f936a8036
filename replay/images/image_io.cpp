#include "replay/images/image_io.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <thread>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <oneapi/tbb/parallel_for.h>
#include <stb/stb_image.h>
#include <xxhash.h>

#include "capture_format/clean_text.h"
#include "capture_format/container/whole_file.h"
#include "capture_format/export/png.h"
#include "capture_format/import/stb_problem.h"
#include "capture_format/srgb.h"
#include "replay/images/exr_bytes.h"

namespace strata {
namespace {

/// One layer of one image with its channels as the file stores them.
struct LayerPart {
    std::string name;
    std::uint32_t width = 0, height = 0;
    Imf::PixelType type = Imf::HALF;
    std::vector<std::string> channels;  ///< in the order of the texel's channels
    std::vector<std::byte> texels;      ///< interleaved, channel_bytes each
    std::size_t channel_bytes = 2;
};

Imf::PixelType pixel_type(Format format) {
    const FormatRow& f = row(format);
    if (f.kind == FormatKind::integer) return Imf::UINT;
    if (f.bytes == f.channels * 2 && f.kind == FormatKind::real && format != Format::r16_unorm && format != Format::rgba16_unorm)
        return Imf::HALF;
    return Imf::FLOAT;
}

std::vector<std::string> channel_names(const HostImage& image) {
    if (row(image.shape.format).kind == FormatKind::depth) return {"Z"};
    static const std::vector<std::string> names = {"R", "G", "B", "A"};
    const std::uint32_t count = row(image.shape.format).channels;
    if (count == 1) return {"Y"};
    return {names.begin(), names.begin() + count};
}

/// Half and 32-bit formats go over unchanged; small and packed ones are widened to float or uint.
LayerPart layer_part(const std::string& name, const HostImage& image, std::uint32_t layer) {
    const FormatRow& format = row(image.shape.format);
    LayerPart out{.name = image.shape.layers > 1 ? fmt::format("{}.layer{}", name, layer) : name,
                  .width = image.shape.extent.width,
                  .height = image.shape.extent.height,
                  .type = pixel_type(image.shape.format),
                  .channels = channel_names(image)};
    out.channel_bytes = out.type == Imf::HALF ? 2 : 4;
    const std::size_t count = std::size_t(out.width) * out.height, texel_bytes = out.channels.size() * out.channel_bytes;
    out.texels.resize(count * texel_bytes);
    if (texel_bytes == format.bytes && format.bytes == format.channels * out.channel_bytes &&
        image.shape.format != Format::r11g11b10f) {
        std::memcpy(out.texels.data(), image.texels.data() + layer * out.texels.size(), out.texels.size());
        return out;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec4 value =
            texel(image, static_cast<std::uint32_t>(i % out.width), static_cast<std::uint32_t>(i / out.width), layer);
        for (std::size_t c = 0; c < out.channels.size(); ++c) {
            std::byte* at = out.texels.data() + i * texel_bytes + c * 4;
            const double channel = value[static_cast<glm::length_t>(c)];
            if (out.type == Imf::UINT) {
                const auto word = static_cast<std::uint32_t>(channel);
                std::memcpy(at, &word, 4);
            } else {
                const auto real = static_cast<float>(channel);
                std::memcpy(at, &real, 4);
            }
        }
    }
    return out;
}

Imf::Header header_of(const LayerPart& part, const Metadata& metadata) {
    Imf::Header header(static_cast<int>(part.width), static_cast<int>(part.height));
    header.setName(part.name);
    header.setType(Imf::SCANLINEIMAGE);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const std::string& channel : part.channels) header.channels().insert(channel, Imf::Channel(part.type));
    for (const auto& [key, value] : metadata) header.insert(key, Imf::StringAttribute(value));
    return header;
}

/// OpenEXR wants one display window of all parts of a file. Images of a frame and shadow maps differ in extent: the window shows
/// all.
void share_display_window(std::vector<Imf::Header>& headers) {
    auto window = headers.front().displayWindow();
    for (const Imf::Header& header : headers) window.extendBy(header.dataWindow());
    for (Imf::Header& header : headers) header.displayWindow() = window;
}

// A file may claim any size; more than this is not read.
constexpr std::uint32_t largest_edge = 1u << 16;
/// Layers of one image are put behind each other, and what grows takes twice its room.
constexpr std::uint64_t exr_bytes_per_byte = 2;
/// While a PNG is decoded: its texels as they are stored, converted to four channels, and the image's own.
constexpr std::uint64_t png_bytes_per_byte = 3;

std::string_view png_problem() { return stb_problem("it is damaged or cut short"); }

struct ChannelRow {
    std::string_view in_file;           ///< in the file's order, which is the alphabet's
    std::vector<const char*> in_texel;  ///< channels the file lacks read as 1
    Format half, real, whole;
};

/// The row of a part's channels, or null: what write_exr writes, and RGB.
const ChannelRow* find_channels(const Imf::ChannelList& channels) {
    static const ChannelRow table[] = {
        {"Y", {"Y"}, Format::r16f, Format::r32f, Format::r32ui},
        {"Z", {"Z"}, Format::r16f, Format::d32f, Format::r32ui},
        {"GR", {"R", "G"}, Format::rg16f, Format::rg32f, Format::rg32ui},
        {"BGR", {"R", "G", "B", "A"}, Format::rgba16f, Format::rgba32f, Format::rgba32ui},
        {"ABGR", {"R", "G", "B", "A"}, Format::rgba16f, Format::rgba32f, Format::rgba32ui},
    };
    std::string names;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const Imf::Channel& first = channels.begin().channel();
        if (channel.channel().type != first.type || channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            return nullptr;
        names += channel.name();
    }
    const auto found = std::ranges::find(table, names, &ChannelRow::in_file);
    return found == std::end(table) ? nullptr : found;
}

Result<HostImage> read_part(Imf::MultiPartInputFile& file, int index, MemoryBudget& budget) {
    const Imf::Header& header = file.header(index);
    if (header.hasType() && Imf::isDeepData(header.type()))
        return fail(Fault::bad_input, "image.deep_part", "part {part} is deep, not flat", index);
    const ChannelRow* channels = find_channels(header.channels());
    if (!channels)
        return fail(Fault::bad_input, "image.channels", "the channels of part {part} are not Z, Y, RG, RGB or RGBA of one type",
                    index);
    const Imf::PixelType type = header.channels().begin().channel().type;
    HostImage image{{.format = type == Imf::HALF ? channels->half : type == Imf::UINT ? channels->whole : channels->real}, {}};
    const auto window = header.dataWindow();
    const auto edge = [](int low, int high) { return static_cast<std::uint32_t>(std::int64_t{high} - low + 1); };
    const Extent extent{edge(window.min.x, window.max.x), edge(window.min.y, window.max.y), 1};
    image.shape.extent = extent;
    const auto display = header.displayWindow().min;
    // Far from each other, both are the file's word: in 64 bits, and what does not fit in 32 is only compared.
    const auto from = [](int at, int origin) { return static_cast<int>(std::int64_t{at} - origin); };
    image.place = {from(window.min.x, display.x), from(window.min.y, display.y)};
    if (std::max(extent.width, extent.height) > largest_edge)
        return fail(Fault::bad_input, "image.too_large", "part {part} claims {width} x {height} texels", index, extent.width,
                    extent.height);
    const std::string what = fmt::format("part {} of {} x {} texels", index, extent.width, extent.height);
    if (const auto room = budget.take(bytes(image.shape), exr_bytes_per_byte, what); !room) return room.error();
    image.texels.resize(bytes(image.shape));

    const std::size_t texel_bytes = row(image.shape.format).bytes, row_bytes = texel_bytes * image.shape.extent.width;
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < channels->in_texel.size(); ++c) {
        char* first = reinterpret_cast<char*>(image.texels.data()) + c * texel_bytes / channels->in_texel.size();
        buffer.insert(channels->in_texel[c], Imf::Slice::Make(type, first, window, texel_bytes, row_bytes, 1, 1, 1));
    }
    Imf::InputPart part(file, index);
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);
    return image;
}

/// "color.layer2" is layer 2 of "color"; "color" is no layer.
std::pair<std::string, std::optional<std::uint32_t>> split_layer(const std::string& part) {
    constexpr std::string_view mark = ".layer";
    const std::size_t at = part.rfind(mark);
    if (at == std::string::npos) return {part, {}};
    const std::string digits = part.substr(at + mark.size());
    if (digits.empty() || digits.size() > 6 || digits.find_first_not_of("0123456789") != std::string::npos) return {part, {}};
    return {part.substr(0, at), static_cast<std::uint32_t>(std::stoul(digits))};
}

/// Appends the layer, or puts the whole image in its place.
Result<void> add_part(NamedImages& images, const std::string& in_file, HostImage read) {
    const std::string part = clean_text(in_file);
    const auto& [name, layer] = split_layer(part);
    const auto known = images.find(name);
    const std::uint32_t expected = known == images.end() ? 0 : known->second.shape.layers;
    if (layer.value_or(0) != expected)
        return fail(Fault::bad_input, "image.layer_order", "part '{part}' comes where layer {layer} of '{image}' was expected",
                    part, expected, name);
    if (known == images.end()) {
        images.emplace(name, std::move(read));
        return {};
    }
    Shape& shape = known->second.shape;
    if (read.shape.extent != shape.extent || read.shape.format != shape.format || read.place != known->second.place)
        return fail(Fault::bad_input, "image.layers_differ",
                    "part '{part}' differs from the layers before it in size, place or channels", part);
    known->second.texels.insert(known->second.texels.end(), read.texels.begin(), read.texels.end());
    ++shape.layers;
    return {};
}

}  // namespace

Result<void> write_exr(const std::filesystem::path& path, const NamedImages& images, const Metadata& metadata) {
    std::vector<LayerPart> parts;
    for (const auto& [name, image] : images)
        for (std::uint32_t layer = 0; layer < image.shape.layers; ++layer) parts.push_back(layer_part(name, image, layer));
    std::vector<Imf::Header> headers;
    for (const LayerPart& part : parts) headers.push_back(header_of(part, metadata));
    if (!headers.empty()) share_display_window(headers);
    ExrBytes bytes;
    try {
        const auto threads = static_cast<int>(std::thread::hardware_concurrency());
        if (Imf::globalThreadCount() < threads) Imf::setGlobalThreadCount(threads);
        Imf::MultiPartOutputFile file(bytes, headers.data(), static_cast<int>(headers.size()), false, threads);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            LayerPart& part = parts[i];
            const std::size_t x_stride = part.channels.size() * part.channel_bytes;
            Imf::FrameBuffer buffer;
            for (std::size_t c = 0; c < part.channels.size(); ++c)
                buffer.insert(part.channels[c],
                              Imf::Slice(part.type, reinterpret_cast<char*>(part.texels.data()) + c * part.channel_bytes,
                                         x_stride, x_stride * part.width));
            Imf::OutputPart output(file, static_cast<int>(i));
            output.setFrameBuffer(buffer);
            output.writePixels(static_cast<int>(part.height));
        }
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& problem) {
        bytes.rethrow_lack_of_memory(problem);
        return fail(Fault::usage, "image.cannot_encode", "cannot write {file}: {reason}", path.string(), problem.what());
    }
    return write_whole_file(path, bytes.take());
}

Result<NamedImages> read_exr(const std::filesystem::path& path) {
    MemoryBudget budget;
    return read_exr(path, budget);
}

namespace {

/// OpenEXR calls a file damaged when zlib gets no memory. What is damaged still is when it is read again; where memory has ended,
/// std::bad_alloc comes as soon as the file is opened.
template <typename Work>
std::invoke_result_t<Work> tried_twice(const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
        return work();
    }
}

Result<NamedImages> parts_of_exr(const std::filesystem::path& path, MemoryBudget& budget) {
    Imf::MultiPartInputFile file(path.c_str());
    NamedImages images;
    for (int part = 0; part < file.parts(); ++part) {
        auto image = read_part(file, part, budget);
        if (!image) return within(image.error(), "cannot read {file}", path.string());
        const std::string name = file.header(part).hasName() ? file.header(part).name() : "image";
        if (const auto added = add_part(images, name, *std::move(image)); !added)
            return within(added.error(), "cannot read {file}", path.string());
    }
    return images;
}

}  // namespace

Result<NamedImages> read_exr(const std::filesystem::path& path, MemoryBudget& budget) {
    const MemoryBudget before = budget;
    try {
        return tried_twice([&] {
            budget = before;
            return parts_of_exr(path, budget);
        });
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& problem) {
        return fail(Fault::bad_input, "image.cannot_read", "cannot read {file}: {reason}", path.string(), problem.what());
    }
}

std::byte display_byte(double light) {
    // Where one byte ends and the next begins: a search in 255 doubles takes a tenth of the curve's power function.
    static const std::array<double, 255> ends = [] {
        std::array<double, 255> lights{};
        for (std::size_t i = 0; i < lights.size(); ++i) lights[i] = decode_srgb((static_cast<double>(i) + .5) / 255);
        return lights;
    }();
    if (!std::isfinite(light)) return std::byte{0};
    std::size_t below = 0;
    for (std::size_t step = 128; step > 0; step /= 2) below += light >= ends[below + step - 1] ? step : 0;
    return static_cast<std::byte>(below);
}

Result<void> write_png(const std::filesystem::path& path, const HostImage& image) {
    const Extent& extent = image.shape.extent;
    std::vector<std::byte> rgb(std::size_t{extent.width} * extent.height * 3);
    oneapi::tbb::parallel_for(std::uint32_t{0}, extent.height, [&](std::uint32_t y) {
        std::byte* to = rgb.data() + std::size_t{y} * extent.width * 3;
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const glm::dvec4 color = texel(image, x, y);
            for (int c = 0; c < 3; ++c) *to++ = display_byte(color[c]);
        }
    });
    return write_png(path, extent, rgb);
}

Result<void> write_png(const std::filesystem::path& path, const Extent& extent, std::span<const std::byte> rgb) {
    return write_whole_file(path, encode_png(extent.width, extent.height, 3, rgb));
}

Result<HostImage> read_png(const std::filesystem::path& path) {
    MemoryBudget budget;
    return read_png(path, budget);
}

Result<HostImage> read_png(const std::filesystem::path& path, MemoryBudget& budget) {
    int width = 0, height = 0, channels = 0;
    if (!stbi_info(path.c_str(), &width, &height, &channels))
        return fail(Fault::bad_input, "image.cannot_read", "cannot read {file}: {reason}", path.string(), png_problem());
    const auto wide = static_cast<std::uint32_t>(width), high = static_cast<std::uint32_t>(height);
    HostImage image{{.extent = {wide, high, 1}, .format = Format::rgba8_unorm}, {}};
    if (std::max(wide, high) > largest_edge)
        return fail(Fault::bad_input, "image.too_large", "cannot read {file}: it claims {width} x {height} texels", path.string(),
                    wide, high);
    const std::string what = fmt::format("{} of {} x {} texels", path.string(), wide, high);
    if (const auto room = budget.has_room(bytes(image.shape), png_bytes_per_byte, what); !room) return room.error();
    if (const auto taken = budget.take(bytes(image.shape), 1, what); !taken) return taken.error();
    if (stbi_is_16_bit(path.c_str()))
        return fail(Fault::bad_input, "image.sixteen_bits", "cannot read {file}: it has 16 bits per channel; convert it to EXR",
                    path.string());
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(stbi_load(path.c_str(), &width, &height, &channels, STBI_rgb_alpha),
                                                           stbi_image_free);
    if (!pixels) return fail(Fault::bad_input, "image.cannot_read", "cannot read {file}: {reason}", path.string(), png_problem());
    const auto texels = std::as_bytes(std::span(pixels.get(), bytes(image.shape)));
    image.texels.assign(texels.begin(), texels.end());
    return image;
}

std::string hash_of(const HostImage& image) {
    const std::uint32_t shape[] = {image.shape.extent.width, image.shape.extent.height, image.shape.layers,
                                   static_cast<std::uint32_t>(image.shape.format)};
    const XXH128_hash_t hash = XXH3_128bits_withSeed(image.texels.data(), image.texels.size(), XXH3_64bits(shape, sizeof shape));
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace strata
