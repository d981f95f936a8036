// Bits of one resource among all marks, and what is known of them without a shader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "passes/graph/step.h"

namespace strata {

/// Texels of an image that lie together.
struct TexelBox {
    std::uint32_t first_column = 0, columns = 0, first_row = 0, rows = 0, first_layer = 0, layers = 0;
};

/// The bits of a resource's units.
class UnitBits {
public:
    explicit UnitBits(std::uint64_t units) : words_((units + 31) / 32), units_(units) {}

    /// Adds the marks of a region: as many words as hold a bit of each unit.
    void add(std::span<const std::uint32_t> words);
    void add_all() { add(0, units_); }
    void add(const Shape&, const TexelBox&);
    void add(const UnitBits&);
    void keep_only(const UnitBits&);
    std::uint64_t count() const;

private:
    void add(std::uint64_t begin, std::uint64_t end);

    std::vector<std::uint32_t> words_;
    std::uint64_t units_;
};

/// Marks of one kind of use of one resource.
struct MarkRegion {
    std::uint64_t units = 0;
    std::uint64_t first_word = 0;
    bool is_marked = false;            ///< by shaders
    bool is_whole = false;             ///< used all over
    std::vector<TexelBox> boxes = {};  ///< used there, of an image

    std::uint64_t words() const { return is_marked ? units / 32 + 1 : 0; }  ///< with the bit for units that are none
};

/// All units of the region that are used. `marks`: all of a frame.
UnitBits used_units(const MarkRegion&, const Shape&, std::span<const std::uint32_t> marks);

}  // namespace strata
