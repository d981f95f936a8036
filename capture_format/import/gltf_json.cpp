#include "capture_format/import/gltf_json.h"

#include <cmath>
#include <limits>

namespace strata::gltf {
namespace {

/// glTF itself nests eight deep; extras may go on. What reads JSON by recursion must not run out of stack.
constexpr int deepest = 64;
/// What a JSON value takes while it is parsed and read: itself, its place in a tree, its key.
constexpr std::uint64_t bytes_per_value = 128;
/// An upper bound of what an object or a list becomes: a node, say, or a material.
constexpr std::uint64_t bytes_per_structure = 1024;

const Json no_members = Json::object();

/// glTF allows a fraction of zero, "3.0", where it wants an integer.
std::optional<std::uint64_t> whole(const Json& value) {
    if (value.is_number_unsigned()) return value.get<std::uint64_t>();
    if (!value.is_number_float()) return std::nullopt;
    const double number = value.get<double>();
    if (!(number >= 0 && number < 9e15) || number != std::floor(number)) return std::nullopt;
    return static_cast<std::uint64_t>(number);
}

std::optional<int> index_of(const Json& value) {
    const auto number = whole(value);
    if (!number || *number > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) return std::nullopt;
    return static_cast<int>(*number);
}

/// Depth and number of values, told by the brackets and commas outside of strings, before anything is built. The parser's own
/// callbacks would do, but with them it looks at every element of a list each time one ends: 4 s for 100,000 nodes (3.11.2).
Result<void> check_extent(std::string_view text, MemoryBudget& budget) {
    std::uint64_t values = 0, structures = 0;
    int depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string && c == '\\') ++i;
        if (c == '"') in_string = !in_string;
        if (in_string) continue;
        if (c == ',') ++values;
        if (c == ']' || c == '}') --depth;
        if (c != '[' && c != '{') continue;
        ++structures;
        if (++depth > deepest) return fail(Fault::bad_input, "the JSON nests deeper than {} levels", deepest);
    }
    if (const auto room = budget.take(values, bytes_per_value, "the values of the JSON"); !room) return room;
    return budget.take(structures, bytes_per_structure, "the objects and lists of the JSON");
}

}  // namespace

Result<Json> parse_json(std::string_view text, MemoryBudget& budget) {
    if (const auto bounded = check_extent(text, budget); !bounded) return bounded.error();
    Json root = Json::parse(text.begin(), text.end(), nullptr, false);
    if (root.is_discarded()) return fail(Fault::bad_input, "it holds no JSON, or the JSON is cut short");
    if (!root.is_object()) return fail(Fault::bad_input, "the JSON is no object");
    return root;
}

Fields::Fields(const Json& object, std::string where, std::optional<Error>& problem)
    : object_(&object), where_(std::move(where)), problem_(problem) {
    if (object.is_object()) return;
    object_ = &no_members;
    if (!problem_) problem_ = fail(Fault::bad_input, "{} is no object", where_);
}

const Json* Fields::member(const char* name) const {
    const auto found = object_->find(name);
    return found == object_->end() ? nullptr : &*found;
}

const Json* Fields::member_list(const char* name) {
    const Json* value = member(name);
    if (value == nullptr || value->is_array()) return value;
    wrong(name, "a list");
    return nullptr;
}

void Fields::wrong(const char* name, std::string_view wanted) {
    if (!problem_) problem_ = fail(Fault::bad_input, "{}.{} is not {}", where_, name, wanted);
}

int Fields::index(const char* name) {
    const Json* value = member(name);
    if (value == nullptr) return -1;
    const auto index = index_of(*value);
    if (!index) wrong(name, "an index");
    return index.value_or(-1);
}

std::uint64_t Fields::size(const char* name, std::uint64_t fallback) {
    const Json* value = member(name);
    if (value == nullptr) return fallback;
    const auto number = whole(*value);
    if (!number) wrong(name, "a whole number from 0");
    return number.value_or(fallback);
}

double Fields::number(const char* name, double fallback) {
    const Json* value = member(name);
    if (value == nullptr) return fallback;
    if (value->is_number() && std::isfinite(value->get<double>())) return value->get<double>();
    wrong(name, "a number");
    return fallback;
}

bool Fields::flag(const char* name, bool fallback) {
    const Json* value = member(name);
    if (value == nullptr) return fallback;
    if (value->is_boolean()) return value->get<bool>();
    wrong(name, "true or false");
    return fallback;
}

std::string Fields::text(const char* name, const char* fallback) {
    const Json* value = member(name);
    if (value == nullptr) return fallback;
    if (value->is_string()) return value->get<std::string>();
    wrong(name, "a text");
    return fallback;
}

std::vector<int> Fields::indices(const char* name) {
    std::vector<int> result;
    const Json* list = member_list(name);
    if (list == nullptr) return result;
    for (const Json& value : *list) {
        const auto index = index_of(value);
        if (!index) wrong(name, "a list of indices");
        result.push_back(index.value_or(-1));
    }
    return result;
}

std::vector<double> Fields::numbers(const char* name, std::size_t count) {
    std::vector<double> result;
    const Json* list = member_list(name);
    if (list == nullptr) return result;
    for (const Json& value : *list) {
        if (!value.is_number() || !std::isfinite(value.get<double>())) {
            wrong(name, "a list of numbers");
            return {};
        }
        result.push_back(value.get<double>());
    }
    if (count == 0 || result.size() == count) return result;
    wrong(name, fmt::format("a list of {} numbers", count));
    return {};
}

std::vector<double> Fields::components(const char* name) {
    const Json* value = member(name);
    if (value == nullptr) return {};
    return value->is_array() ? numbers(name, 0) : std::vector{number(name, 0)};
}

Fields Fields::object(const char* name) {
    const Json* value = member(name);
    return Fields(value == nullptr ? no_members : *value, where_ + "." + name, problem_);
}

std::vector<std::pair<std::string, int>> Fields::references() {
    std::vector<std::pair<std::string, int>> result;
    for (const auto& [key, value] : object_->items()) {
        const auto index = index_of(value);
        if (!index) wrong(key.c_str(), "an index");
        result.emplace_back(key, index.value_or(-1));
    }
    return result;
}

std::vector<std::string> Fields::texts(const char* name) {
    std::vector<std::string> result;
    const Json* list = member_list(name);
    if (list == nullptr) return result;
    for (const Json& value : *list) {
        if (value.is_string()) result.push_back(value.get<std::string>());
    }
    return result;
}

}  // namespace strata::gltf
