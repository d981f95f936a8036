// Hashes of values, for those who ask whether something is as it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <xxhash.h>

namespace strata {

/// XXH3 of the bytes of everything that was added, in order. 0 and -0 differ, as do all NaNs.
class Digest {
public:
    /// Of a type without padding.
    template <typename T>
    Digest& add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto bytes = std::as_bytes(std::span(&value, 1));
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
        return *this;
    }
    /// Their number, and a hash of their bytes.
    template <typename T>
    Digest& add_all(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T>);
        return add(std::uint64_t{values.size()}).add(XXH3_64bits(values.data(), values.size() * sizeof(T)));
    }
    std::uint64_t value() const { return XXH3_64bits(bytes_.data(), bytes_.size()); }

private:
    std::vector<std::byte> bytes_;
};

}  // namespace strata
