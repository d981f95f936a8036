// A forger's changes: what a capture says and how it is cut into records, under checksums that stay right.
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "tests/fuzz/sealed_capture.h"

namespace strata {

/// Changes one of the records (there is at least one) and leaves the others' borders alone. Most often its bytes, by
/// `change_bytes`.
void mutate_record(std::vector<Record>&, std::minstd_rand&, const std::function<void(std::vector<std::byte>&)>& change_bytes);

}  // namespace strata
