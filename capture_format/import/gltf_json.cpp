#include "capture_format/import/gltf_json.h"

#include <cmath>
#include <limits>

#include <nlohmann/json.hpp>

namespace strata::gltf {
namespace {

/// glTF itself nests eight deep; extras may go on. What reads JSON by recursion must not run out of stack.
constexpr int deepest = 64;
/// What a JSON value takes while it is parsed and read: itself, its place in a tree, its key.
constexpr std::uint64_t bytes_per_value = 128;
/// An upper bound of what an object or a list becomes: a node, say, or a material.
constexpr std::uint64_t bytes_per_structure = 1024;

const Json no_members{Json::Object()};

/// glTF allows a fraction of zero, "3.0", where it wants an integer.
std::optional<std::uint64_t> whole(const Json& value) {
    if (const auto* exact = std::get_if<std::uint64_t>(&value.value)) return *exact;
    const auto* found = std::get_if<double>(&value.value);
    if (!found) return std::nullopt;
    const double number = *found;
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
        if (++depth > deepest)
            return fail(Fault::bad_input, "import.gltf.json_depth", "the JSON nests deeper than {most} levels", deepest);
    }
    if (const auto room = budget.take(values, bytes_per_value, "the values of the JSON"); !room) return room;
    return budget.take(structures, bytes_per_structure, "the objects and lists of the JSON");
}

/// Makes values of JSON.
class Builder : public nlohmann::json_sax<nlohmann::json> {
public:
    Json& root() { return root_; }

    bool null() override { return put({}); }
    bool boolean(bool value) override { return put({value}); }
    bool number_integer(number_integer_t value) override { return put({static_cast<double>(value)}); }
    bool number_unsigned(number_unsigned_t value) override { return put({std::uint64_t{value}}); }
    bool number_float(number_float_t value, const string_t&) override { return put({value}); }
    bool string(string_t& value) override { return put({std::move(value)}); }
    bool binary(binary_t&) override { return false; }
    bool key(string_t& name) override {
        key_ = std::move(name);
        return true;
    }
    bool start_object(std::size_t) override { return begin({Json::Object()}); }
    bool start_array(std::size_t) override { return begin({Json::List()}); }
    bool end_object() override { return end(); }
    bool end_array() override { return end(); }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

private:
    Json& add(Json value) {
        if (open_.empty()) return root_ = std::move(value);
        if (auto* list = std::get_if<Json::List>(&open_.back()->value)) return list->emplace_back(std::move(value));
        return std::get<Json::Object>(open_.back()->value)[key_] = std::move(value);
    }
    bool put(Json value) {
        add(std::move(value));
        return true;
    }
    bool begin(Json value) {
        open_.push_back(&add(std::move(value)));  // stays where it is: its list grows when it is complete
        return true;
    }
    bool end() {
        open_.pop_back();
        return true;
    }

    Json root_;
    std::vector<Json*> open_;
    std::string key_;
};

/// Reads JSON for the place and the kind of its first error alone.
class FirstError : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit FirstError(std::string_view text) : text_(text) {}

    const Error& error() const { return error_.value(); }

    bool null() override { return next(); }
    bool boolean(bool) override { return next(); }
    bool number_integer(number_integer_t) override { return next(); }
    bool number_unsigned(number_unsigned_t) override { return next(); }
    bool number_float(number_float_t, const string_t&) override { return next(); }
    bool string(string_t&) override { return next(); }
    bool binary(binary_t&) override { return next(); }
    bool key(string_t& name) override {
        open_.back().name = name;
        return true;
    }
    bool start_object(std::size_t) override { return begin(); }
    bool start_array(std::size_t) override { return begin(0); }
    bool end_object() override { return end(); }
    bool end_array() override { return end(); }

    bool parse_error(std::size_t read, const std::string& token, const nlohmann::detail::exception& error) override {
        constexpr int out_of_range = 406;
        constexpr std::string_view marks = " \t\r\n,:[]{}\"";
        const std::string at = open_.empty() ? std::string("the file") : place();
        if (error.id == out_of_range) {
            error_ =
                fail(Fault::bad_input, "import.gltf.json_number", "{place}: {number:.40} is too large for a number", at, token);
        } else if (read > text_.size()) {
            error_ = fail(Fault::bad_input, "import.gltf.json_cut", "the JSON is cut short in {place} after {bytes} bytes", at,
                          text_.size());
        } else {
            // The word around the byte that is wrong; the parser's token has what lies before it, too.
            const std::size_t wrong = read - std::min<std::size_t>(read, 1), mark = text_.find_last_of(marks, wrong),
                              begin = mark == text_.npos ? 0 : std::min(mark + 1, wrong);
            const std::size_t end = std::min(text_.size(), std::max(text_.find_first_of(marks, begin), begin + 1));
            const auto first = static_cast<unsigned char>(text_[begin]);
            const bool is_text = first >= ' ' && first <= '~';
            const std::string word =
                is_text ? fmt::format("'{:.40}'", text_.substr(begin, end - begin)) : fmt::format("{:#04x}", first);
            error_ =
                fail(Fault::bad_input, "import.gltf.json_syntax", "{place}: {word} at byte {byte} is not JSON", at, word, begin);
        }
        return false;
    }

private:
    struct Open {
        std::string name;                  ///< of the member that is read
        std::optional<std::size_t> index;  ///< of a list
    };

    std::string place() const {
        std::string text = "glTF";
        for (const Open& each : open_)
            if (each.index) text += fmt::format("[{}]", *each.index);
            else if (!each.name.empty()) text += fmt::format(".{:.40}", each.name);
        return text;
    }
    bool next() {
        if (!open_.empty() && open_.back().index) ++*open_.back().index;
        return true;
    }
    bool begin(std::optional<std::size_t> index = {}) {
        open_.push_back({"", index});
        return true;
    }
    bool end() {
        open_.pop_back();
        return next();
    }

    std::string_view text_;
    std::vector<Open> open_;
    std::optional<Error> error_;
};

}  // namespace

Result<Json> parse_json(std::string_view text, MemoryBudget& budget) {
    if (const auto bounded = check_extent(text, budget); !bounded) return bounded.error();
    Builder builder;
    if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) {
        FirstError error(text);
        nlohmann::json::sax_parse(text.begin(), text.end(), &error);
        return error.error();
    }
    if (!std::holds_alternative<Json::Object>(builder.root().value))
        return fail(Fault::bad_input, "import.gltf.not_an_object", "{place} is not an object", "the JSON");
    return std::move(builder.root());
}

std::optional<double> Json::number() const {
    if (const auto* whole = std::get_if<std::uint64_t>(&value)) return static_cast<double>(*whole);
    const auto* found = std::get_if<double>(&value);
    return found ? std::optional(*found) : std::nullopt;
}

Fields::Fields(const Json& object, std::string where, std::optional<Error>& problem)
    : object_(std::get_if<Json::Object>(&object.value)), where_(std::move(where)), problem_(problem) {
    if (object_) return;
    object_ = std::get_if<Json::Object>(&no_members.value);
    if (!problem_) problem_ = fail(Fault::bad_input, "import.gltf.not_an_object", "{place} is not an object", where_);
}

const Json* Fields::member(const char* name) const {
    const auto found = object_->find(std::string_view(name));
    return found == object_->end() ? nullptr : &found->second;
}

const Json::List* Fields::member_list(const char* name) {
    const Json* value = member(name);
    if (value == nullptr) return nullptr;
    const auto* list = std::get_if<Json::List>(&value->value);
    if (!list) wrong(name, "a list");
    return list;
}

void Fields::wrong(const char* name, std::string_view wanted) {
    if (!problem_)
        problem_ = fail(Fault::bad_input, "import.gltf.member_type", "{place}.{member} is not {wanted}", where_, name, wanted);
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
    const auto number = value->number();
    if (number && std::isfinite(*number)) return *number;
    wrong(name, "a number");
    return fallback;
}

bool Fields::flag(const char* name, bool fallback) {
    const Json* value = member(name);
    if (value == nullptr) return fallback;
    if (const auto* flag = std::get_if<bool>(&value->value)) return *flag;
    wrong(name, "true or false");
    return fallback;
}

std::string Fields::text(const char* name, const char* fallback) {
    const Json* value = member(name);
    if (value == nullptr) return fallback;
    if (const auto* text = std::get_if<std::string>(&value->value)) return *text;
    wrong(name, "a text");
    return fallback;
}

std::vector<int> Fields::indices(const char* name) {
    std::vector<int> result;
    const Json::List* list = member_list(name);
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
    const Json::List* list = member_list(name);
    if (list == nullptr) return result;
    for (const Json& value : *list) {
        const auto number = value.number();
        if (!number || !std::isfinite(*number)) {
            wrong(name, "a list of numbers");
            return {};
        }
        result.push_back(*number);
    }
    if (count == 0 || result.size() == count) return result;
    wrong(name, fmt::format("a list of {} numbers", count));
    return {};
}

std::vector<double> Fields::components(const char* name) {
    const Json* value = member(name);
    if (value == nullptr) return {};
    return std::holds_alternative<Json::List>(value->value) ? numbers(name, 0) : std::vector{number(name, 0)};
}

Fields Fields::object(const char* name) {
    const Json* value = member(name);
    return Fields(value == nullptr ? no_members : *value, where_ + "." + name, problem_);
}

std::vector<std::pair<std::string, int>> Fields::references() {
    std::vector<std::pair<std::string, int>> result;
    for (const auto& [key, value] : *object_) {
        const auto index = index_of(value);
        if (!index) wrong(key.c_str(), "an index");
        result.emplace_back(key, index.value_or(-1));
    }
    return result;
}

std::vector<std::string> Fields::texts(const char* name) {
    std::vector<std::string> result;
    const Json::List* list = member_list(name);
    if (list == nullptr) return result;
    for (const Json& value : *list)
        if (const auto* text = std::get_if<std::string>(&value.value)) result.push_back(*text);
    return result;
}

}  // namespace strata::gltf
