// How a step touches a resource. The verb a pass uses is the access; layouts and barriers follow from it.
#pragma once

#include <cstdint>
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
/// Whether the access needs what was there before.
bool reads(Access);

}  // namespace strata
