// Matchers of errors: a test asks for an error's id and the values of its sentence, never for the sentence.
//     EXPECT_THAT(GltfScene::open(file), FailsWith("import.gltf.accessor_range", Field("accessor", 3), Field("bytes", 1024)));
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/core.h>
#include <gmock/gmock.h>

#include "capture_format/result.h"

namespace strata {

/// A value of an error by its name: a number, a text, or a matcher of the text that "{}" makes of it.
class Field {
public:
    template <typename T>
    Field(std::string field_name, const T& value) : name(std::move(field_name)), text(as_matcher(value)) {}

    std::string name;
    testing::Matcher<const std::string&> text;

private:
    template <typename T>
    static testing::Matcher<const std::string&> as_matcher(const T& value) {
        if constexpr (std::is_arithmetic_v<T>) return testing::Eq(fmt::format("{}", value));
        else if constexpr (std::is_convertible_v<const T&, std::string_view>) return testing::Eq(std::string(value));
        else return testing::SafeMatcherCast<const std::string&>(value);
    }
};

/// Matches an Error, a Result that failed, or an optional that holds an Error. Fields that are not asked for may be there.
class FailsWithMatcher {
public:
    using is_gtest_matcher = void;
    FailsWithMatcher(std::string id, std::vector<Field> fields) : id_(std::move(id)), fields_(std::move(fields)) {}

    bool MatchAndExplain(const Error& error, std::ostream* why) const;
    bool MatchAndExplain(const std::optional<Error>& error, std::ostream* why) const;
    template <typename T>
    bool MatchAndExplain(const Result<T>& result, std::ostream* why) const {
        return result ? MatchAndExplain(std::optional<Error>(), why) : MatchAndExplain(result.error(), why);
    }
    void DescribeTo(std::ostream*) const;
    void DescribeNegationTo(std::ostream*) const;

private:
    std::string id_;  ///< empty: any
    std::vector<Field> fields_;
};

template <typename... Fields>
FailsWithMatcher FailsWith(std::string id, Fields... fields) {
    return {std::move(id), {std::move(fields)...}};
}

/// Matches an error of any id with that field.
template <typename T = std::decay_t<decltype(testing::_)>>
FailsWithMatcher HasField(std::string field_name, const T& value = T()) {
    return {"", {Field(std::move(field_name), value)}};
}

/// "accessor 3 needs ... (import.gltf.accessor_range: accessor=3 bytes=1024)".
std::string with_id(const Error&);

void PrintTo(const Error&, std::ostream*);
template <typename T>
void PrintTo(const Result<T>& result, std::ostream* out) {
    if (result) *out << "success";
    else PrintTo(result.error(), out);
}

}  // namespace strata
