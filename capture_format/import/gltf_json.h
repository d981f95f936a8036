// The JSON of a glTF, read with suspicion: nesting and size are bounded while it is parsed, and a member of the wrong type is
// refused with its place. The first thing that is wrong stays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata::gltf {

/// A JSON value. Nlohmann's own (3.11.2) allocates when it is destroyed, and so ends the program where there is no memory.
struct Json {
    using List = std::vector<Json>;
    using Object = std::map<std::string, Json, std::less<>>;
    /// Whole numbers from 0 apart from all others.
    std::variant<std::nullptr_t, bool, std::uint64_t, double, std::string, List, Object> value = nullptr;

    std::optional<double> number() const;
};

/// Fails for what is no JSON object, nests deeper than 64, or has more objects than the budget holds.
Result<Json> parse_json(std::string_view text, MemoryBudget&);

/// The members of one object. Missing members give the fallback; those of a wrong type make the problem.
class Fields {
public:
    /// `where` is for sentences: "nodes[3]".
    Fields(const Json& object, std::string where, std::optional<Error>& problem);

    const std::string& where() const { return where_; }
    bool has(const char* name) const { return member(name) != nullptr; }
    /// A reference to an element of a list; -1 when missing. Whoever follows it checks that the element is there.
    int index(const char* name);
    std::uint64_t size(const char* name, std::uint64_t fallback);
    double number(const char* name, double fallback);
    bool flag(const char* name, bool fallback);
    std::string text(const char* name, const char* fallback = "");
    std::vector<int> indices(const char* name);
    /// Exactly `count` finite numbers, or any count when it is 0; empty when missing.
    std::vector<double> numbers(const char* name, std::size_t count);
    /// A number or a list of numbers; empty when missing.
    std::vector<double> components(const char* name);
    /// An object inside this one; empty when missing.
    Fields object(const char* name);
    /// Calls visit(Fields) for every element of a list of objects.
    template <typename Visit>
    void each(const char* name, const Visit& visit) {
        const Json::List* list = member_list(name);
        for (std::size_t i = 0; list != nullptr && i < list->size() && !problem_; ++i) {
            visit(Fields((*list)[i], where_ + "." + name + "[" + std::to_string(i) + "]", problem_));
        }
    }
    /// Name and index for every member of this object, which is one of references (a primitive's attributes).
    std::vector<std::pair<std::string, int>> references();
    /// The strings of a list.
    std::vector<std::string> texts(const char* name);

private:
    const Json* member(const char* name) const;
    const Json::List* member_list(const char* name);
    void wrong(const char* name, std::string_view wanted);

    const Json::Object* object_;
    std::string where_;
    std::optional<Error>& problem_;
};

}  // namespace strata::gltf
