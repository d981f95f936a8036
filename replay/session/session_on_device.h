// A session on a device that is open already. Sessions on one device share its pipelines, which on a CPU driver are most of what
// a small frame costs; they run one after the other, and what a run says of the device's memory is of all of them.
#pragma once

#include "capture_format/frame/frame.h"
#include "replay/session/session.h"

namespace strata {

/// Frames made in code. The device outlives the session.
std::unique_ptr<Session> open_session_on(Device&, std::vector<Frame>);

}  // namespace strata
