// How much memory what a glTF asks for may take. A few bytes of JSON can claim gigabytes (accessors without buffers, accessors
// used a thousand times, pictures of one color), so whoever is about to allocate by a number from the file asks here first.
#pragma once

#include <cstdint>
#include <string_view>

#include "capture_format/result.h"

namespace strata::gltf {

class Budget {
public:
    explicit Budget(std::uint64_t bytes) : total_(bytes), left_(bytes) {}

    /// Fails, and names what, when count * size bytes are more than what is left.
    Result<void> take(std::uint64_t count, std::uint64_t size, std::string_view what) {
        if (size != 0 && count > left_ / size) {
            return fail(Fault::bad_input, "{} would take {} x {} bytes; together at most {} bytes are used for a glTF", what,
                        count, size, total_);
        }
        left_ -= count * size;
        return {};
    }

private:
    std::uint64_t total_, left_;
};

}  // namespace strata::gltf
