#include "capture_format/import/gltf_files.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>

namespace strata::gltf {
namespace {

constexpr std::string_view glb_magic = "glTF";
constexpr std::uint32_t glb_version = 2, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;

/// URIs can be of any length; a sentence shows their beginning.
std::string shown(std::string_view uri) { return std::string(uri.substr(0, 80)) + (uri.size() > 80 ? "..." : ""); }

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof(value));  // little-endian, like every host we build on
    return value;
}

int digit(char c, int base) {
    int value = 99;
    if (c >= '0' && c <= '9') value = c - '0';
    if (c >= 'a' && c <= 'f') value = c - 'a' + 10;
    if (c >= 'A' && c <= 'F') value = c - 'A' + 10;
    return value < base ? value : -1;
}

/// %20 and the like become bytes. Nothing when a percent sign begins no such thing.
std::optional<std::string> unescaped(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            text += uri[i];
            continue;
        }
        if (i + 2 >= uri.size() || digit(uri[i + 1], 16) < 0 || digit(uri[i + 2], 16) < 0) return std::nullopt;
        text += static_cast<char>(digit(uri[i + 1], 16) * 16 + digit(uri[i + 2], 16));
        i += 2;
    }
    return text;
}

/// The value of each base64 digit; 64 for what is none.
constexpr std::array<std::uint8_t, 256> base64_values = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(64);
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < digits.size(); ++i) {
        values[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
    }
    return values;
}();

Result<std::vector<std::byte>> decode_base64(std::string_view text, MemoryBudget& budget) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    if (text.size() % 4 == 1) return fail(Fault::bad_input, "import.gltf.uri_cut", "a data URI is cut short");
    if (const auto room = budget.take(text.size(), 1, "a data URI"); !room) return room.error();
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0, count = 0;
    for (const char c : text) {
        const std::uint32_t value = base64_values[static_cast<unsigned char>(c)];
        if (value > 63) return fail(Fault::bad_input, "import.gltf.base64", "a data URI is not base64");
        bits = bits << 6 | value;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> count & 0xff));
    }
    return bytes;
}

/// "data:TYPE;base64,DIGITS" or "data:TYPE,ESCAPED".
Result<std::vector<std::byte>> decode_data_uri(std::string_view uri, MemoryBudget& budget) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos)
        return fail(Fault::bad_input, "import.gltf.uri_no_data", "the data URI '{uri}' has no data", shown(uri));
    if (uri.substr(0, comma).ends_with(";base64")) return decode_base64(uri.substr(comma + 1), budget);
    if (const auto room = budget.take(uri.size(), 1, "a data URI"); !room) return room.error();
    const auto text = unescaped(uri.substr(comma + 1));
    if (!text) return fail(Fault::bad_input, "import.gltf.uri_escape", "the data URI '{uri}' is badly escaped", shown(uri));
    const auto bytes = std::as_bytes(std::span(*text));
    return std::vector<std::byte>(bytes.begin(), bytes.end());
}

}  // namespace

Result<Chunks> split_chunks(std::span<const std::byte> file) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    if (!text.starts_with(glb_magic)) return Chunks{text, {}};
    if (file.size() < 20) return fail(Fault::bad_input, "import.gltf.glb_header_cut", "the .glb is cut short within its header");
    if (word(file, 4) != glb_version)
        return fail(Fault::bad_input, "import.gltf.glb_version", ".glb version {version} is not supported; version 2 is",
                    word(file, 4));
    const std::uint64_t length = word(file, 8), json_length = word(file, 12);
    if (length > file.size() || length < 20) {
        return fail(Fault::bad_input, "import.gltf.glb_cut",
                    "the .glb is cut short: its header says {claimed_bytes} bytes, the file has {bytes}", length, file.size());
    }
    if (word(file, 16) != json_chunk || json_length > length - 20) {
        return fail(Fault::bad_input, "import.gltf.glb_json", "the first chunk of the .glb is not JSON of {bytes} bytes",
                    json_length);
    }
    Chunks chunks{text.substr(20, json_length), {}};
    std::uint64_t at = 20 + json_length;
    while (length - at >= 8) {  // chunks of unknown kinds are to be skipped
        const std::uint64_t size = word(file, at);
        if (size > length - at - 8)
            return fail(Fault::bad_input, "import.gltf.glb_chunk", "a chunk of {bytes} bytes extends past the end of the .glb",
                        size);
        if (word(file, at + 4) == binary_chunk && chunks.binary.empty()) chunks.binary = file.subspan(at + 8, size);
        at += 8 + size;
    }
    return chunks;
}

Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, MemoryBudget& budget) {
    std::error_code failure;
    const bool regular = std::filesystem::is_regular_file(path, failure);  // a pipe or a device would never end
    const std::uintmax_t size = regular ? std::filesystem::file_size(path, failure) : 0;
    std::ifstream file;
    if (regular) file.open(path, std::ios::binary);
    if (!regular && !failure) return fail(Fault::bad_input, "file.not_a_file", "{file} is not a file", path.string());
    if (failure || !file) {
        if (!failure && errno == ENOMEM) throw std::bad_alloc();
        const std::string reason = failure ? failure.message() : std::generic_category().message(errno);
        return fail(Fault::bad_input, "file.cannot_open", "cannot open {file}: {reason}", path.string(), reason);
    }
    if (const auto room = budget.take(size, 1, path.filename().string()); !room) return room.error();
    std::vector<std::byte> bytes(size);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<std::uintmax_t>(file.gcount()) != size)
        return fail(Fault::bad_input, "file.cannot_read", "cannot read {file}: {reason}", path.string(), "it ends early");
    return bytes;
}

Folder::Folder(const std::filesystem::path& file) {
    std::error_code failure;
    const std::filesystem::path parent = file.parent_path();
    root_ = std::filesystem::canonical(parent.empty() ? "." : parent, failure);
}

Result<std::vector<std::byte>> Folder::read(const std::string& uri, MemoryBudget& budget) const {
    if (uri.starts_with("data:")) return decode_data_uri(uri, budget);
    const auto name = unescaped(uri);
    if (!name || name->empty()) return fail(Fault::bad_input, "import.gltf.uri", "'{uri}' is not a URI", shown(uri));
    if (root_.empty())
        return fail(Fault::bad_input, "import.gltf.uri_not_read", "'{uri}' is another file; only the given bytes are read",
                    shown(uri));
    const std::filesystem::path relative(*name);
    const bool climbs = std::find(relative.begin(), relative.end(), "..") != relative.end();
    if (name->find_first_of(std::string_view(":\\\0", 3)) != std::string::npos || relative.is_absolute() || climbs) {
        return fail(Fault::bad_input, "import.gltf.uri_outside",
                    "'{uri}' is not below the folder of the glTF; such files are not read", shown(uri));
    }
    std::error_code failure;
    const std::filesystem::path found = std::filesystem::canonical(root_ / relative, failure);
    if (failure) return fail(Fault::bad_input, "import.gltf.file_missing", "the file '{uri}' is missing", shown(uri));
    const auto below = std::mismatch(root_.begin(), root_.end(), found.begin(), found.end());
    if (below.first != root_.end()) {
        return fail(Fault::bad_input, "import.gltf.uri_link",
                    "'{uri}' is a link that leaves the folder of the glTF; such files are not read", shown(uri));
    }
    return read_file(found, budget);
}

}  // namespace strata::gltf
