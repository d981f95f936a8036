// JSON that is written: members in the order in which they were added. Destroying a value takes no memory, unlike one of
// nlohmann's (3.11.2), which ends a program without any.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "capture_format/safe_variant.h"

namespace strata::to_gltf_parts {

class Json {
public:
    Json() = default;  ///< null, which the first element makes a list and the first member an object
    Json(bool value) : value_(value) {}
    Json(std::integral auto value) : value_(static_cast<std::int64_t>(value)) {}
    Json(std::floating_point auto value) : value_(static_cast<double>(value)) {}
    Json(const char* text) : value_(std::string(text)) {}
    Json(std::string text) : value_(std::move(text)) {}
    Json(const std::vector<std::size_t>& numbers) : value_(List(numbers.begin(), numbers.end())) {}
    class Part;
    /// An object where every element is a list of a text and a value, otherwise a list.
    Json(std::initializer_list<Part>);
    static Json array(std::initializer_list<Part> elements);
    static Json array();
    static Json object();

    std::size_t size() const;
    bool empty() const { return size() == 0; }
    void push_back(Json element);
    /// Whether a list has this text.
    bool has_text(std::string_view) const;
    bool contains(std::string_view member) const;
    /// The member of an object, added where it is not there yet.
    Json& operator[](std::string_view member);
    /// Adds or replaces members.
    void update(const Json& object);
    /// Numbers that are not finite are null, texts as clean_text() leaves them.
    std::string dump() const;

private:
    using List = std::vector<Json>;
    using Object = std::vector<std::pair<std::string, Json>>;
    static Json of(const Part&);
    static List list_of(std::initializer_list<Part>);
    void append_to(std::string&) const;

    SafeVariant<std::nullptr_t, bool, std::int64_t, double, std::string, List, Object> value_ = nullptr;
};

/// An element in braces, as a view: where one of them throws, GCC 12 also destroys those elements of the list that are not made
/// yet.
class Json::Part {
public:
    Part(bool value) : value_(value) {}
    Part(std::integral auto value) : value_(static_cast<std::int64_t>(value)) {}
    Part(std::floating_point auto value) : value_(static_cast<double>(value)) {}
    Part(const char* text) : value_(std::string_view(text)) {}
    Part(const std::string& text) : value_(std::string_view(text)) {}
    Part(const std::vector<std::size_t>& numbers) : value_(&numbers) {}
    Part(const Json& json) : value_(&json) {}
    Part(std::initializer_list<Part> parts) : value_(parts) {}

private:
    friend class Json;
    std::variant<bool, std::int64_t, double, std::string_view, std::initializer_list<Part>, const std::vector<std::size_t>*,
                 const Json*>
        value_;
};

}  // namespace strata::to_gltf_parts
