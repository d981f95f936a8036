#include "replay/gpu/library_build.h"

#include <elf.h>
#include <link.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>

#include <fmt/format.h>

namespace strata {
namespace {

struct Search {
    std::string_view name_part;
    std::optional<std::string> build;
};

std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

std::string hexadecimal(std::span<const std::byte> bytes) {
    std::string text;
    for (const std::byte byte : bytes) text += fmt::format("{:02x}", std::to_integer<unsigned>(byte));
    return text;
}

/// Notes stand one after the other: a header, a name, a description, each padded to words.
std::optional<std::string> build_in(std::span<const std::byte> notes) {
    ElfW(Nhdr) header;
    while (notes.size() >= sizeof header) {
        std::memcpy(&header, notes.data(), sizeof header);
        const std::size_t described = sizeof header + padded(header.n_namesz);
        if (notes.size() < described || notes.size() - described < header.n_descsz) return std::nullopt;
        const bool is_gnu = header.n_namesz == 4 && std::memcmp(notes.data() + sizeof header, ELF_NOTE_GNU, 4) == 0;
        if (is_gnu && header.n_type == NT_GNU_BUILD_ID) return hexadecimal(notes.subspan(described, header.n_descsz));
        notes = notes.subspan(std::min(described + padded(header.n_descsz), notes.size()));
    }
    return std::nullopt;
}

/// For dl_iterate_phdr, which stops at the first result that is not 0.
int look_at(dl_phdr_info* library, std::size_t, void* search) {
    auto& wanted = *static_cast<Search*>(search);
    const std::string_view path = library->dlpi_name;
    if (path.substr(path.rfind('/') + 1).find(wanted.name_part) == std::string_view::npos) return 0;
    for (const ElfW(Phdr) & segment : std::span(library->dlpi_phdr, library->dlpi_phnum)) {
        if (segment.p_type != PT_NOTE || wanted.build) continue;
        const auto* start = reinterpret_cast<const std::byte*>(library->dlpi_addr + segment.p_vaddr);
        wanted.build = build_in({start, segment.p_memsz});
    }
    return 1;
}

}  // namespace

std::optional<std::string> build_of_library(std::string_view name_part) {
    Search search{name_part, std::nullopt};
    dl_iterate_phdr(look_at, &search);
    return search.build;
}

}  // namespace strata
