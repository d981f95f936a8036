#include "tests/support/second_device.h"

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>

#include "capture_format/frame.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr const char* added_drivers = "VK_ADD_DRIVER_FILES";

std::string variable(const char* name, std::string_view otherwise) {
    const char* value = std::getenv(name);
    return std::string(value ? value : otherwise);
}

}  // namespace

std::string second_gpu() { return variable("STRATA_SECOND_GPU", "SwiftShader"); }

std::string second_driver() {
    const std::string file = variable("STRATA_SECOND_DRIVER", "/usr/lib/chromium/vk_swiftshader_icd.json");
    return std::filesystem::exists(file) ? file : "";
}

std::unique_ptr<Session> second_session(std::vector<Frame> frames) {
    // Read when an instance is made. Afterwards the other tests' device is the first again.
    setenv(added_drivers, second_driver().c_str(), /*overwrite=*/1);
    auto session = Session::open(std::move(frames), {.gpu = second_gpu(), .validation = true});
    unsetenv(added_drivers);
    return must(std::move(session));
}

}  // namespace strata
