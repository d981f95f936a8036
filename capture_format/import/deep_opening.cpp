// Opens a deep file: parts, windows, channels, and where the blocks lie. OpenEXR's C library reads the headers; that every
// block lies inside the file is checked here, because its offsets are the file's word.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>

#include <openexr.h>

#include "capture_format/import/deep_file.h"
#include "capture_format/inspection.h"

namespace strata {
namespace {

constexpr std::string_view channel_names[] = {"R", "G", "B", "A", "AR", "AG", "AB", "Y", "Z", "ZBack"};
static_assert(std::size(channel_names) == static_cast<std::size_t>(DeepChannel::count_), "one name per channel, in order");

/// The file as OpenEXR's library reads it, and what it last complained of.
struct Stream {
    std::span<const std::byte> bytes;
    std::string problem;
};

std::int64_t read_at(exr_const_context_t, void* user, void* buffer, std::uint64_t size, std::uint64_t offset,
                     exr_stream_error_func_ptr_t) {
    const std::span<const std::byte> bytes = static_cast<const Stream*>(user)->bytes;
    if (offset >= bytes.size()) return 0;
    const std::uint64_t count = std::min<std::uint64_t>(size, bytes.size() - offset);
    std::memcpy(buffer, bytes.data() + offset, count);
    return static_cast<std::int64_t>(count);
}

std::int64_t size_of(exr_const_context_t, void* user) {
    return static_cast<std::int64_t>(static_cast<const Stream*>(user)->bytes.size());
}

void keep_problem(exr_const_context_t context, exr_result_t, const char* message) {
    void* user = nullptr;
    if (context == nullptr || exr_get_user_data(context, &user) != EXR_ERR_SUCCESS || user == nullptr) return;
    try {
        static_cast<Stream*>(user)->problem = message;
    } catch (const std::bad_alloc&) {}  // the code says enough, and what calls this knows no exceptions
}

/// Set where OpenEXR got no memory: its library (3.1.5) then leaves attributes and channels out, and may call the file damaged.
thread_local bool lacked_memory = false;

void* allocate(std::size_t bytes) {
    void* const memory = std::malloc(bytes);
    if (!memory) lacked_memory = true;
    return memory;
}

/// Whether a call succeeded. Throws where it got no memory, whatever it says.
bool succeeded(exr_result_t code) {
    if (lacked_memory) throw std::bad_alloc();
    return code == EXR_ERR_SUCCESS;
}

struct Context {
    exr_context_t handle = nullptr;
    ~Context() { exr_finish(&handle); }
};

Result<DeepWindow> window_of(const exr_attr_box2i_t& box, std::string_view what) {
    const std::int64_t width = std::int64_t{box.max.x} - box.min.x + 1, height = std::int64_t{box.max.y} - box.min.y + 1;
    if (width < 1 || height < 1 || width > largest_extent || height > largest_extent)
        return fail(Fault::bad_input, "import.deep.image_size",
                    "the {window} window has {width} x {height} pixels; 1 to {most} each way can be read", what, width, height,
                    largest_extent);
    return DeepWindow{box.min.x, box.min.y, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

}  // namespace

/// Fills a DeepFile from a header; lives while it is opened.
struct DeepFile::Opening {
    DeepFile& file;
    std::string file_name;
    Stream stream;
    Context context;
    int part = 0;

    Result<void> run(std::string_view wanted) {
        exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
        initializer.error_handler_fn = keep_problem;
        initializer.user_data = &stream;
        initializer.read_fn = read_at;
        initializer.size_fn = size_of;
        initializer.alloc_fn = allocate;
        initializer.free_fn = std::free;
        lacked_memory = false;
        initializer.max_image_width = initializer.max_image_height = static_cast<int>(largest_extent);
        initializer.max_tile_width = initializer.max_tile_height = static_cast<int>(largest_extent);
        initializer.flags = EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE | EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
        const exr_result_t opened = exr_start_read(&context.handle, file_name.c_str(), &initializer);
        if (!succeeded(opened)) return unreadable(opened);
        if (const auto done = find_part(wanted); !done) return done;
        if (const auto done = read_header(); !done) return done;
        if (const auto done = read_channels(); !done) return done;
        return tiled() ? place_tiles() : place_lines();
    }

    Error unreadable(exr_result_t code) const {
        return fail(Fault::bad_input, "import.deep.not_openexr", "the file is not a readable OpenEXR file: {reason}",
                    reason(code));
    }

    const char* reason(exr_result_t code) const {
        return stream.problem.empty() ? exr_get_default_error_message(code) : stream.problem.c_str();
    }

    bool is_deep(int index) const {
        exr_storage_t storage = EXR_STORAGE_SCANLINE;
        return succeeded(exr_get_storage(context.handle, index, &storage)) &&
               (storage == EXR_STORAGE_DEEP_SCANLINE || storage == EXR_STORAGE_DEEP_TILED);
    }

    bool tiled() const {
        exr_storage_t storage = EXR_STORAGE_SCANLINE;
        return succeeded(exr_get_storage(context.handle, part, &storage)) && storage == EXR_STORAGE_DEEP_TILED;
    }

    std::string name_of(int index) const {
        const char* name = nullptr;
        return succeeded(exr_get_name(context.handle, index, &name)) && name != nullptr ? name : "";
    }

    Result<void> find_part(std::string_view wanted) {
        int parts = 0;
        if (const exr_result_t counted = exr_get_count(context.handle, &parts); !succeeded(counted)) return unreadable(counted);
        std::string known;
        int found = -1;
        for (int i = 0; i < parts; ++i) {
            const std::string number = std::to_string(i);
            if (!is_deep(i)) continue;
            ++file.deep_parts_;
            known += fmt::format("{}{} '{:.60}'", known.empty() ? "" : ", ", number, name_of(i));
            if (found < 0 && (wanted.empty() || wanted == number || wanted == name_of(i))) found = i;
        }
        if (file.deep_parts_ == 0) return fail(Fault::bad_input, "import.deep.no_deep_part", "the file has no deep part");
        if (found < 0)
            return fail(Fault::usage, "import.deep.part_missing", "there is no deep part '{part}'; the deep parts are {parts}",
                        wanted, known);
        part = found;
        return {};
    }

    Result<void> read_header() {
        exr_attr_box2i_t data{}, display{};
        exr_compression_t compression = EXR_COMPRESSION_NONE;
        for (const exr_result_t read :
             {exr_get_data_window(context.handle, part, &data), exr_get_display_window(context.handle, part, &display),
              exr_get_compression(context.handle, part, &compression)})
            if (!succeeded(read)) return unreadable(read);
        const auto data_window = window_of(data, "data"), display_window = window_of(display, "display");
        if (!data_window) return data_window.error();
        if (!display_window) return display_window.error();
        file.data_ = *data_window;
        file.display_ = *display_window;
        if (compression != EXR_COMPRESSION_NONE && compression != EXR_COMPRESSION_RLE && compression != EXR_COMPRESSION_ZIPS &&
            compression != EXR_COMPRESSION_ZIP)
            return fail(Fault::bad_input, "import.deep.compression",
                        "deep images are compressed with NONE, RLE, ZIPS or ZIP, not with compression {compression}",
                        static_cast<int>(compression));
        file.compression_ = compression;
        return {};
    }

    Result<void> read_channels() {
        const exr_attr_chlist_t* list = nullptr;
        if (!succeeded(exr_get_channels(context.handle, part, &list)) || list == nullptr)
            return fail(Fault::bad_input, "import.deep.no_channel_list", "the part has no list of channels");
        file.source_.fill(-1);
        std::string names;
        for (int i = 0; i < list->num_channels; ++i) {
            const exr_attr_chlist_entry_t& channel = list->entries[i];
            const std::string_view name(channel.name.str, static_cast<std::size_t>(channel.name.length));
            if (channel.x_sampling != 1 || channel.y_sampling != 1)
                return fail(Fault::bad_input, "import.deep.channel_sampling",
                            "channel '{channel:.60}' does not have a value for every sample", name);
            const auto known = std::ranges::find(channel_names, name);
            if (known == std::end(channel_names)) file.ignored_.push_back(fmt::format("{:.60}", name));
            else file.source_[static_cast<std::size_t>(known - channel_names)] = i;
            file.channels_.push_back({static_cast<std::uint32_t>(channel.pixel_type), file.sample_bytes_});
            file.sample_bytes_ += channel.pixel_type == EXR_PIXEL_HALF ? 2 : 4;
            names += fmt::format("{}{:.60}", names.empty() ? "" : " ", name);
        }
        if (!file.has(DeepChannel::depth))
            return fail(Fault::bad_input, "import.deep.no_depth", "the part has no channel Z; its channels are {channels:.200}",
                        names);
        return {};
    }

    Result<void> place_lines() {
        for (std::uint32_t line = 0; line < file.data_.height;) {
            exr_chunk_info_t chunk{};
            const int y = file.data_.y + static_cast<int>(line);
            const exr_result_t found = exr_read_scanline_chunk_info(context.handle, part, y, &chunk);
            if (!succeeded(found) || chunk.height < 1)
                return fail(Fault::bad_input, "import.deep.line_missing", "line {y} cannot be found: {reason}", y, reason(found));
            const auto height = std::min(static_cast<std::uint32_t>(chunk.height), file.data_.height - line);
            const DeepWindow window{file.data_.x, y, file.data_.width, height};
            if (const auto done = add(window, std::uint64_t{window.width} * height, chunk); !done) return done;
            line += height;
        }
        return {};
    }

    /// The tiles of the finest level.
    Result<void> place_tiles() {
        std::int32_t width = 0, height = 0;
        const exr_result_t sized = exr_get_tile_sizes(context.handle, part, 0, 0, &width, &height);
        if (!succeeded(sized) || width < 1 || height < 1)
            return fail(Fault::bad_input, "import.deep.tile_size", "the tiles have no size: {reason}", reason(sized));
        const DeepWindow& data = file.data_;
        const auto tile_width = static_cast<std::uint32_t>(width), tile_height = static_cast<std::uint32_t>(height);
        for (std::uint32_t y = 0; y < data.height; y += tile_height)
            for (std::uint32_t x = 0; x < data.width; x += tile_width) {
                const auto column = static_cast<int>(x / tile_width), row = static_cast<int>(y / tile_height);
                exr_chunk_info_t chunk{};
                const exr_result_t found = exr_read_tile_chunk_info(context.handle, part, column, row, 0, 0, &chunk);
                if (!succeeded(found))
                    return fail(Fault::bad_input, "import.deep.tile_missing", "tile ({column}, {row}) cannot be found: {reason}",
                                column, row, reason(found));
                const DeepWindow window{data.x + static_cast<int>(x), data.y + static_cast<int>(y),
                                        std::min(tile_width, data.width - x), std::min(tile_height, data.height - y)};
                if (const auto done = add(window, std::uint64_t{tile_width} * tile_height, chunk); !done) return done;
            }
        return {};
    }

    Result<void> add(const DeepWindow& window, std::uint64_t table_pixels, const exr_chunk_info_t& chunk) {
        const auto part_of_file = [&](std::uint64_t offset, std::uint64_t size) -> std::optional<std::span<const std::byte>> {
            if (offset > stream.bytes.size() || size > stream.bytes.size() - offset) return std::nullopt;
            return stream.bytes.subspan(offset, size);
        };
        const auto counts = part_of_file(chunk.sample_count_data_offset, chunk.sample_count_table_size);
        const auto samples = part_of_file(chunk.data_offset, chunk.packed_size);
        if (!counts || !samples)
            return fail(Fault::bad_input, "import.deep.block_range",
                        "the block of pixels at ({x}, {y}) lies beyond the end of the file", window.x, window.y);
        file.blocks_.push_back({window, table_pixels, *counts, *samples, chunk.unpacked_size});
        return {};
    }
};

Result<DeepFile> DeepFile::open(std::span<const std::byte> bytes, std::string_view name, std::string_view part) {
    DeepFile file;
    Opening opening{file, std::string(name), {bytes, {}}, {}};
    if (const auto done = opening.run(part); !done) return within(done.error(), "{file}", name);
    return file;
}

}  // namespace strata
