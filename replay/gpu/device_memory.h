// What is thrown where memory does not suffice: the device itself is well and can go on with less.
#pragma once

#include "replay/gpu/executor.h"

namespace strata {

/// The device or the driver has not the memory that was asked for; what() says at which step.
class MemoryLacks : public DeviceFailure {
public:
    using DeviceFailure::DeviceFailure;
};

}  // namespace strata
