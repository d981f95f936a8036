// How a step touches a resource. The verb a pass uses is the access; layouts and barriers follow from it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace strata {

enum class Access : std::uint32_t {
    none,           ///< not touched yet; contents undefined
    sampled,        ///< read through a sampler or texelFetch
    loaded,         ///< read as a storage image or a readonly buffer
    stored,         ///< written as a storage image or a writeonly buffer
    updated,        ///< read and written in place by a shader
    color_written,  ///< color attachment, overwritten
    color_blended,  ///< color attachment, blended with what is there
    depth_tested,   ///< depth attachment, read only
    depth_written,  ///< depth attachment, tested and written
    indirect,       ///< arguments of a draw or dispatch
    indexed,        ///< index buffer
    copied_from,    ///< source of a copy, or read back by the host
    copied_to,      ///< destination of a copy or clear
};

std::string_view name(Access);
/// Whether the access changes the resource.
bool writes(Access);
/// Whether the access needs what was there before. Attachments and stores may leave texels as they were; that is not meant here.
bool reads(Access);

/// Everything one step does to one part of a resource at once, such as testing depth against an image it also samples.
class AccessSet {
public:
    constexpr AccessSet() = default;
    constexpr AccessSet(Access access) : bits_(access == Access::none ? 0u : 1u << static_cast<std::uint32_t>(access)) {}
    constexpr bool has(Access access) const { return (bits_ & AccessSet(access).bits_) != 0; }
    constexpr bool empty() const { return bits_ == 0; }
    constexpr AccessSet& operator|=(AccessSet other) {
        bits_ |= other.bits_;
        return *this;
    }
    friend constexpr bool operator==(AccessSet, AccessSet) = default;

private:
    std::uint32_t bits_ = 0;
};

bool writes(AccessSet);
/// A writing one if there is any, else the first in the enumerators' order; none for the empty set.
Access leading(AccessSet);
/// "depth_tested and sampled"; "none" for the empty set.
std::string names(AccessSet);

}  // namespace strata
