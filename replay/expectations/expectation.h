// What a replay of a frame is expected to give, on one device with one choice of techniques: a hash of every image that every
// pass wrote, and perhaps the images. A capture keeps any number of them as JSON; accepted_for() finds those that count.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "capture_format/result.h"
#include "replay/session/session.h"

namespace strata {

/// What decides the low bits of a result: CPU drivers compile for the CPU and its vector width, and differ between vendors.
struct ExpectedOn {
    std::string device, driver, driver_version, cpu;
    std::uint32_t vector_width = 0;  ///< lanes
    friend bool operator==(const ExpectedOn&, const ExpectedOn&) = default;
};
ExpectedOn expected_on(const DeviceInfo&);
/// "llvmpipe (LLVM 15.0.6, 256 bits), llvmpipe Mesa 22.3.6, 8 lanes, AMD EPYC"
std::string text(const ExpectedOn&);

struct ExpectedImage {
    std::string name, hash;  ///< hash_of() the image
    Shape shape;
    std::string texels;  ///< what Capture::expected_image() finds them by; empty: only the hash is kept
};

struct ExpectedPass {
    std::string label, choice;  ///< as in PassImages
    std::vector<ExpectedImage> images;
};

struct Expectation {
    std::size_t frame = 0;
    std::uint32_t samples = 1;        ///< per pixel
    std::vector<std::string> forced;  ///< features, in the order of the command line
    ExpectedOn on;
    std::string tool;   ///< revision that wrote it
    bool also = false;  ///< those accepted before for this device, frame and choice stay accepted
    std::vector<ExpectedPass> passes;
};

/// What a run with Passes::read_back gave, as an expectation without kept images.
Expectation expectation_of(const Session&, const Request&, const Run&);

/// Whether both are of one frame and made the same way, wherever they ran.
bool same_frame_and_choices(const Expectation&, const Expectation&);

/// JSON, and back. Fails for what is no expectation: a capture may come from anywhere.
std::string as_json(const Expectation&);
Result<Expectation> parse_expectation(std::string_view json);
/// All of a capture's, oldest first.
Result<std::vector<Expectation>> expectations_of(const Capture&);

/// The hashes alone, by pass and image: what would be accepted, on one line of JSON.
std::string short_json(const Expectation&);

}  // namespace strata
