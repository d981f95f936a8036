// One opened device per test program, which session_of() opens its sessions on, and one executor, with the validation layer on. A
// message of the layer fails the test that caused it, and so does the lack of a device.
#pragma once

#include "replay/gpu/device.h"
#include "replay/gpu/executor.h"

namespace strata {

Device& shared_device();
Executor& shared_executor();

}  // namespace strata
