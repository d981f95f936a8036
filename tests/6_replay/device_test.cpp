// Finding devices: by index, by a part of the name, and what is said where there is none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/device.h"
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

TEST(Devices, ThatDoNotExistAreAnsweredWithTheList) {
    for (const char* gpu : {"no such gpu", "99"}) {
        const auto opened = Device::open({.gpu = gpu});
        ASSERT_FALSE(opened);
        EXPECT_EQ(opened.error().fault, Fault::usage);
        EXPECT_THAT(opened.error().sentence, HasSubstr(shared_device().info().name));
    }
}

}  // namespace
}  // namespace strata
