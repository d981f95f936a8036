// Bytes that count against the recorder's budget, and how an error names what takes too many of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace strata {

struct Draw;
struct Emitter;
struct Frame;
struct Light;
struct Material;
struct Mesh;
struct Texture;

std::uint64_t footprint(const Texture&);
std::uint64_t footprint(const Mesh&);
std::uint64_t footprint(const Material&);
std::uint64_t footprint(const Draw&);
std::uint64_t footprint(const Emitter&);
std::uint64_t footprint(const Light&);
/// The size of parts of which only a few are ever submitted.
template <typename T>
std::uint64_t footprint(const T& value) {
    return sizeof(value);
}

/// "texture 3 'sky'".
std::string label(std::size_t index, const Texture&);
std::string label(std::size_t index, const Mesh&);
std::string label(std::size_t index, const Material&);
/// "frame 3 with 20 draws"; or the one resource of it that exceeds the budget alone: "texture 2 'sky' of frame 3".
std::string label(const Frame&, std::uint64_t number, std::uint64_t budget);

}  // namespace strata
