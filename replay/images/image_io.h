// OpenEXR (multi-part, with provenance) and PNG. What is written depends on pixels and metadata alone: equal runs give equal
// files, wherever and whenever they ran.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "capture_format/memory_budget.h"
#include "capture_format/result.h"
#include "replay/images/host_image.h"

namespace strata {

using Metadata = std::map<std::string, std::string>;

/// ZIP; half, float or uint channels as the image has them, so pixels survive bit for bit. Each layer of an image becomes a part
/// "name" or "name.layer2".
Result<void> write_exr(const std::filesystem::path&, const NamedImages&, const Metadata&);

/// The images of a flat file by their parts' names; parts "name.layer0", "name.layer1", ... become the layers of one image.
/// Channels are Z, Y, RG, RGB (read as RGBA with A = 1) or RGBA, all of one type; a part without a name is called "image". What
/// the images hold is taken from the budget, before it is allocated.
Result<NamedImages> read_exr(const std::filesystem::path&, MemoryBudget&);
/// Within a budget of its own, half of the machine's memory.
Result<NamedImages> read_exr(const std::filesystem::path&);

/// Display light (0..1 linear) as 8-bit sRGB, rounded to nearest; what is not finite is black.
std::byte display_byte(double light);
/// Every texel's display_byte()s; alpha dropped.
Result<void> write_png(const std::filesystem::path&, const HostImage&);
/// Bytes as they are, three a pixel, rows top to bottom.
Result<void> write_png(const std::filesystem::path&, const Extent&, std::span<const std::byte> rgb);

/// As rgba8_unorm, bytes as they are (sRGB); a file without alpha reads as opaque. Refuses 16 bits per channel. The budget is
/// that of read_exr().
Result<HostImage> read_png(const std::filesystem::path&, MemoryBudget&);
Result<HostImage> read_png(const std::filesystem::path&);

/// 32 hex digits over shape and texels.
std::string hash_of(const HostImage&);

}  // namespace strata
