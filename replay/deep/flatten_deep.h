// A deep image flattened: every sample composited near to far, in double.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "capture_format/import/deep_file.h"
#include "replay/images/host_image.h"

namespace strata {

struct FlatDeep {
    DeepWindow window;  ///< the data window: where the image lies
    HostImage image;    ///< rgba32f, premultiplied over black; a is the coverage
};

/// Every part of what import_deep() makes of the file, without a frame: bad numbers are mended, samples sorted, volumes cut.
/// Products are kept in double: after 200 layers of alpha .07, compositing in float is off by a percent and more. Uses every
/// core. `part` as in DeepOptions. Fails as import_deep() does.
Result<FlatDeep> flatten_deep(std::span<const std::byte> file, std::string_view name, std::string_view part = {});

}  // namespace strata
