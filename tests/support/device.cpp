#include "tests/support/device.h"

#include <gtest/gtest.h>

#include "replay/gpu/kept_pipelines.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// After every test: what the layer said meanwhile.
class MessagesFailTests : public testing::EmptyTestEventListener {
public:
    explicit MessagesFailTests(Device& device) : device_(&device) {}
    void OnTestEnd(const testing::TestInfo&) override {
        for (const std::string& message : device_->take_messages()) ADD_FAILURE() << "the validation layer says: " << message;
    }

private:
    Device* device_;
};

struct Opened {
    std::unique_ptr<Device> device = must(Device::open({.validation = true}));
    std::unique_ptr<Executor> executor = Executor::create(*device);
    Opened() {
        keep_pipelines(*device, many_pipelines);  // tests of one kind follow each other
        testing::UnitTest::GetInstance()->listeners().Append(new MessagesFailTests(*device));  // the framework owns it
    }
};

Opened& opened() {
    static Opened device;
    return device;
}

}  // namespace

Device& shared_device() { return *opened().device; }
Executor& shared_executor() { return *opened().executor; }

}  // namespace strata
