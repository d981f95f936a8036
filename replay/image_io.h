// OpenEXR (multi-part, with provenance) and PNG. What is written depends on pixels and metadata alone: equal runs give equal
// files, wherever and whenever they ran.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "capture_format/result.h"
#include "replay/host_image.h"

namespace strata {

/// A named image of a file; each of its layers becomes a part "name" or "name.layer2".
struct ExrPart {
    std::string name;
    const HostImage* image = nullptr;
};

using Metadata = std::map<std::string, std::string>;

/// ZIP; half, float or uint channels as the image has them, so pixels survive bit for bit.
Result<void> write_exr(const std::filesystem::path&, std::span<const ExrPart>, const Metadata&);

/// Display light (0..1 linear) as 8-bit sRGB; rounded to nearest, alpha dropped.
Result<void> write_png(const std::filesystem::path&, const HostImage&);

/// 32 hex digits over shape and texels.
std::string hash_of(const HostImage&);

}  // namespace strata
