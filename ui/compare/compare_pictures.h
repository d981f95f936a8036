// Two pictures against each other: what has to be done that they can be compared, the numbers, and maps of where they differ.
// A is the reference. No device, no screen.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "replay/difference/compare_images.h"

namespace strata::ui {

/// A side of a comparison.
struct SidePicture {
    std::shared_ptr<const HostImage> image;  ///< null: none yet. Light is linear, that of a file of bytes, too
    bool is_bytes = false;                   ///< a file of 8 bits a channel (sRGB)
    /// Of a truth, else null: empty, or per texel whether its coverage hangs on rounding. Such texels count as equal.
    std::shared_ptr<const std::vector<bool>> undecided = nullptr;
    std::string about = {};  ///< where it comes from, for people
};

/// Four channels of floats: which of them mean something, what it is compared with knows.
SidePicture picture_of(const ReferenceImage& truth);
/// Of a PNG, or of an EXR the image of that name, or the only one it has.
Result<SidePicture> read_picture(const std::filesystem::path&, const std::string& image);

struct PicturePair {
    std::string image;  ///< its name in the frame
    SidePicture a, b;
};

struct ComparedPictures {
    PicturePair pair;
    ImageComparison measured;
    std::string unit;           ///< of the values: "radiance"
    std::size_t undecided = 0;  ///< texels that count as equal
    /// All layers. Several channels: |B - A|; a single one: B - A. What is no number in A or B is none here.
    std::shared_ptr<const HostImage> difference;
    /// r32f: the largest channel of |B - A| / max(|A|, root mean square of A), as in Tolerance.
    std::shared_ptr<const HostImage> relative;
    /// r32f, one layer; null where there is no light to be seen.
    std::shared_ptr<const HostImage> flip;
};

/// Fails with a sentence where sizes, channels or kinds of number differ. Beside bytes everything is bytes; beside a truth
/// everything is floats.
Result<ComparedPictures> compare(const PicturePair&);

}  // namespace strata::ui
