// Whether equal replays give equal bits, and which pass is the first that does not.
#pragma once

#include "replay/session/session.h"

namespace strata {

/// Replays a request `repeats` times in all, each time everything anew, and compares every image of every pass with the first
/// run's (made with Passes::read_back). Fails (not_repeatable) naming the first pass that varies, its worst texel, the device,
/// the driver and the CPU.
Result<void> check_repeats(Session&, const Request&, const Run& first, std::size_t repeats);

}  // namespace strata
