// Whether equal replays give equal bits, and which act is the first that does not.
#pragma once

#include "replay/session/session.h"

namespace strata {

/// Replays a request `repeats` times in all, each time everything anew, and compares every image of every act with the first
/// run's (made with Acts::brought_back). Fails (not_repeatable) naming the first act that varies, its worst texel, the device,
/// the driver and the CPU.
Result<void> check_repeats(Session&, const Request&, const Run& first, std::size_t repeats);

}  // namespace strata
