#include "capture_format/export/json.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <type_traits>

#include <fmt/format.h>

#include "capture_format/clean_text.h"

namespace strata::to_gltf_parts {
namespace {

void append_text(std::string& to, std::string_view text) {
    to += '"';
    for (const char c : clean_text(text)) {
        if (c == '\t' || c == '\n') {
            to += c == '\t' ? "\\t" : "\\n";
            continue;
        }
        if (c == '"' || c == '\\') to += '\\';
        to += c;
    }
    to += '"';
}

}  // namespace

Json::Json(std::initializer_list<Part> parts) {
    const bool are_members = std::ranges::all_of(parts, [](const Part& part) {
        const auto* pair = std::get_if<std::initializer_list<Part>>(&part.value_);
        return pair && pair->size() == 2 && std::holds_alternative<std::string_view>(pair->begin()->value_);
    });
    if (!are_members) {
        value_ = list_of(parts);
        return;
    }
    Object members;
    for (const Part& part : parts) {
        const auto& pair = std::get<std::initializer_list<Part>>(part.value_);
        members.emplace_back(std::string(std::get<std::string_view>(pair.begin()->value_)), of(pair.begin()[1]));
    }
    value_ = std::move(members);
}

Json Json::of(const Part& part) {
    return std::visit(
        [](const auto& value) -> Json {
            using Value = std::remove_cvref_t<decltype(value)>;
            if constexpr (std::is_pointer_v<Value>) return Json(*value);
            else if constexpr (std::is_same_v<Value, std::string_view>) return Json(std::string(value));
            else return Json(value);
        },
        part.value_);
}

Json::List Json::list_of(std::initializer_list<Part> parts) {
    List list;
    for (const Part& part : parts) list.push_back(of(part));
    return list;
}

Json Json::array(std::initializer_list<Part> elements) {
    Json list = array();
    list.value_ = list_of(elements);
    return list;
}

Json Json::array() {
    Json list;
    list.value_ = List();
    return list;
}

Json Json::object() {
    Json object;
    object.value_ = Object();
    return object;
}

std::size_t Json::size() const {
    if (const auto* list = std::get_if<List>(&value_)) return list->size();
    const auto* members = std::get_if<Object>(&value_);
    return members ? members->size() : 0;
}

void Json::push_back(Json element) {
    if (std::holds_alternative<std::nullptr_t>(value_)) value_ = List();
    std::get<List>(value_).push_back(std::move(element));
}

bool Json::has_text(std::string_view text) const {
    const auto* list = std::get_if<List>(&value_);
    return list && std::ranges::any_of(*list, [&](const Json& element) {
               const auto* own = std::get_if<std::string>(&element.value_);
               return own && *own == text;
           });
}

bool Json::contains(std::string_view member) const {
    const auto* members = std::get_if<Object>(&value_);
    return members && std::ranges::any_of(*members, [&](const auto& each) { return each.first == member; });
}

Json& Json::operator[](std::string_view member) {
    if (std::holds_alternative<std::nullptr_t>(value_)) value_ = Object();
    Object& members = std::get<Object>(value_);
    const auto found = std::ranges::find_if(members, [&](const auto& each) { return each.first == member; });
    return found != members.end() ? found->second : members.emplace_back(std::string(member), Json()).second;
}

void Json::update(const Json& object) {
    for (const auto& [name, value] : std::get<Object>(object.value_)) (*this)[name] = value;
}

std::string Json::dump() const {
    std::string text;
    append_to(text);
    return text;
}

void Json::append_to(std::string& to) const {
    const auto append = [&](const auto& value) {
        using Value = std::remove_cvref_t<decltype(value)>;
        const char* separator = "";
        if constexpr (std::is_same_v<Value, List>) {
            to += '[';
            for (const Json& element : value) to += std::exchange(separator, ","), element.append_to(to);
            to += ']';
        } else if constexpr (std::is_same_v<Value, Object>) {
            to += '{';
            for (const auto& [name, member] : value) {
                to += std::exchange(separator, ",");
                append_text(to, name);
                to += ':';
                member.append_to(to);
            }
            to += '}';
        } else if constexpr (std::is_same_v<Value, std::string>) {
            append_text(to, value);
        } else if constexpr (std::is_same_v<Value, std::nullptr_t>) {
            to += "null";
        } else if constexpr (std::is_same_v<Value, double>) {
            if (std::isfinite(value)) fmt::format_to(std::back_inserter(to), "{}", value);
            else to += "null";
        } else {
            fmt::format_to(std::back_inserter(to), "{}", value);
        }
    };
    std::visit(append, value_);
}

}  // namespace strata::to_gltf_parts
