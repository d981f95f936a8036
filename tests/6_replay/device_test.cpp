// Finding devices: by index, by a part of a name, and what is said where there is none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/stages.h"
#include "replay/expectations/expectation_check.h"
#include "replay/gpu/library_build.h"
#include "tests/support/device.h"
#include "tests/support/second_device.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(Devices, AreListedWithWhatTheyLack) {
    const auto devices = must(list_devices());
    ASSERT_THAT(devices, Not(IsEmpty())) << "install a Vulkan driver: mesa-vulkan-drivers has one for the CPU";
    for (std::uint32_t i = 0; i < devices.size(); ++i) {
        EXPECT_EQ(devices[i].index, i);
        EXPECT_THAT(devices[i].name, Not(IsEmpty()));
        EXPECT_THAT(devices[i].cpu, Not(IsEmpty()));
        EXPECT_GE(devices[i].max_buffer_bytes, 128u << 20);
    }
}

TEST(Devices, AreChosenByIndexOrByPartOfTheNameInAnyCase) {
    const DeviceInfo& shared = shared_device().info();
    std::string part = shared.name.substr(0, 4);
    for (char& c : part) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_EQ(must(Device::open({.gpu = part}))->info().name, shared.name);
    EXPECT_EQ(must(Device::open({.gpu = std::to_string(shared.index)}))->info().name, shared.name);
}

TEST(Devices, AreAlsoChosenByPartOfTheirDriversNameAndVersion) {
    const DeviceInfo& shared = shared_device().info();
    ASSERT_THAT(shared.driver_version, Not(IsEmpty()));
    EXPECT_EQ(must(Device::open({.gpu = shared.driver}))->info().name, shared.name);
    EXPECT_EQ(must(Device::open({.gpu = shared.driver_version}))->info().name, shared.name);
}

TEST(Devices, WhoseDriverHasNoVersionAreToldApartByTheBuildOfItsLibrary) {
    EXPECT_EQ(build_of_library("no such library"), std::nullopt);
    ASSERT_TRUE(build_of_library("libvulkan.so")) << "Debian's libraries have build IDs";
    EXPECT_EQ(build_of_library("libvulkan.so")->size(), 40u);
    if (second_driver().empty() || second_gpu() != "SwiftShader") GTEST_SKIP() << no_second_driver;
    const auto session = second_session(scenario_frames("one_pane"));
    EXPECT_EQ(session->device().driver_version, "build " + build_of_library("vk_swiftshader").value());
}

TEST(Devices, ThatDoNotExistAreAnsweredWithTheList) {
    for (const char* gpu : {"no such gpu", "99"}) {
        const auto opened = Device::open({.gpu = gpu});
        ASSERT_FALSE(opened);
        EXPECT_EQ(opened.error().fault, Fault::usage);
        EXPECT_THAT(opened.error().sentence, HasSubstr(shared_device().info().name));
    }
}

TEST(Devices, ThatCannotFilterFloatsHavePrepassesMixedInTheShader) {
    for (const char* technique : {"transparency/moments", "transparency/wavelet"}) {
        const Request request{.choices = chosen({technique}, {"resolution=quarter"}), .outputs = {"color"}};
        const auto color = [&](std::vector<std::string> without) {
            const DeviceChoice choice{.validation = true, .without = std::move(without)};
            const auto session = must(Session::open(scenario_frames("glass_and_smoke"), choice));
            return must(session->run(request)).images.at("color");
        };
        const HostImage by_sampler = color({}), in_shader = color({"filtered_floats"});
        EXPECT_LT(deviation_of("color", in_shader, by_sampler).rmse, 1e-3) << technique;
    }
}

}  // namespace
}  // namespace strata
