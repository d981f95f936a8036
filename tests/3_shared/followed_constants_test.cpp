// Which functions a driver is given where constants reach a branch through parameters, variables and calls. Leaving out too
// little costs time; leaving out too much would change pictures.
#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "passes/graph/reached_code.h"
#include "tests/support/glsl.h"

namespace strata {
namespace {

// With the constant `features`, the writable buffer `result` and the functions rare() and asks(features, bit).
constexpr std::string_view head = R"(
    layout(local_size_x = 1) in;
    layout(constant_id = 0) const uint features = 0u;
    layout(set = 0, binding = 0, scalar) buffer Result { uint result; };
    bool asks(uint features, uint bit) { return (features & bit) != 0u; }
    uint rare() { return 7u * result; }
)";

/// Whether the function rare() is given to the driver, with the constant's value.
bool has_rare(const std::string& source, std::uint32_t features) {
    const Shader shader = glsl("followed.comp", std::string(head) + source);
    const ConstantBits given{.id = 0, .bits = features};
    const auto count = [](std::span<const std::uint32_t> code) {
        constexpr std::uint32_t op_function = 54;  // SPIR-V 1.6, 3.49.9
        std::size_t functions = 0;
        for (std::size_t at = 5; at < code.size(); at += code[at] >> 16) functions += (code[at] & 0xffffu) == op_function;
        return functions;
    };
    const std::size_t all = count(shader.code), reached = count(reached_code(shader.code, std::span(&given, 1)));
    EXPECT_LE(all - reached, 1u) << "only rare() may be left out";
    return all == reached;
}

TEST(FollowedConstants, AreKnownInAFunctionThatAllCallsGiveTheSame) {
    const std::string source = R"(
        uint shade(uint given) { return asks(given, 4u) && result > 0u ? rare() : 1u; }
        void main() { result = shade(features) + shade(features); })";
    EXPECT_FALSE(has_rare(source, 3));
    EXPECT_TRUE(has_rare(source, 4));
}

TEST(FollowedConstants, AreUnknownWhereTwoCallsDiffer) {
    const std::string source = R"(
        uint shade(uint given) { return asks(given, 4u) ? rare() : asks(given, 8u) ? 2u : 1u; }
        void main() { result = shade(features) + shade(12u); })";
    EXPECT_TRUE(has_rare(source, 3));
}

TEST(FollowedConstants, AreUnknownWhereTheBufferHasASay) {
    EXPECT_TRUE(
        has_rare("void main() { const uint given = features | result; if (asks(given, 4u)) result = rare(); asks(1u, 2u); }", 3));
    EXPECT_FALSE(
        has_rare("void main() { const uint given = features & result; if (given != 0u) result = rare(); asks(1u, 2u); }", 0));
}

TEST(FollowedConstants, EndWhereAVariableIsWrittenAgain) {
    EXPECT_TRUE(has_rare(R"(
        void main() {
            uint given = features;
            if (result > 3u) given = 4u;
            if (asks(given, 4u)) result = rare();
        })",
                         3));
    EXPECT_TRUE(has_rare(R"(
        void main() {
            uint given = features;
            for (uint i = 0u; i < result; ++i) {
                if (asks(given, 4u)) result = rare();
                given = 4u;
            }
        })",
                         3))
        << "the second turn of the loop asks for it";
    EXPECT_FALSE(has_rare(R"(
        void main() {
            uint given = features;
            if (features == 5u) given = 4u;
            if (asks(given, 4u)) result = rare();
        })",
                          3))
        << "that never happens";
}

TEST(FollowedConstants, EndWhereAFunctionWritesItsParameter) {
    EXPECT_TRUE(has_rare(R"(
        uint shade(uint given) {
            given |= result;
            return asks(given, 4u) ? rare() : 1u;
        }
        void main() { result = shade(features); })",
                         3));
    EXPECT_TRUE(has_rare(R"(
        void widen(inout uint given) { given |= result; }
        void main() {
            uint given = features;
            widen(given);
            if (asks(given, 4u)) result = rare();
        })",
                         3));
    EXPECT_TRUE(has_rare(R"(
        bool asks_wider(uint given) {
            given |= result;
            return asks(given, 4u);
        }
        void main() { if (asks_wider(features)) result = rare(); })",
                         3));
}

TEST(FollowedConstants, OfEitherSideOfAnOrAreFollowed) {
    const std::string source =
        "void main() { if (asks(features, 1u) && result > 3u || asks(features, 2u) && result < 9u) result = rare(); }";
    EXPECT_FALSE(has_rare(source, 4));
    EXPECT_TRUE(has_rare(source, 1));
    EXPECT_TRUE(has_rare(source, 2));
}

}  // namespace
}  // namespace strata
