// A variant that is copied without harm where memory lacks.
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

namespace strata {

/// std::variant, but a copy that throws leaves nothing behind. libstdc++ 12 destroys what its copy constructor has not made yet
/// where all alternatives are strings, vectors and scalars, and jumps anywhere. The alternatives are of different types.
template <typename... Alternatives>
class SafeVariant : public std::variant<Alternatives...> {
    using Base = std::variant<Alternatives...>;

    static Base copy_of(const Base& other) {
        return std::visit(
            [](const auto& value) {
                auto copy = value;
                return Base(std::in_place_type<std::remove_cvref_t<decltype(value)>>, std::move(copy));
            },
            other);
    }

public:
    using Base::Base;
    SafeVariant() = default;
    SafeVariant(const SafeVariant& other) : Base(copy_of(other)) {}
    SafeVariant(SafeVariant&&) noexcept = default;
    SafeVariant& operator=(const SafeVariant& other) {
        Base::operator=(copy_of(other));
        return *this;
    }
    SafeVariant& operator=(SafeVariant&&) noexcept = default;
    ~SafeVariant() = default;
};

}  // namespace strata
