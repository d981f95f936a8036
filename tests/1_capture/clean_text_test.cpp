// Text of unknown origin becomes UTF-8 without control characters.
#include "capture_format/clean_text.h"

#include <gtest/gtest.h>

namespace strata {
namespace {

TEST(CleanText, IsUnchangedWhereItIsUtf8WithoutControls) {
    for (const char* text : {"", "glass", "a line\nand\ta tab",
                             "Stra\xc3\x9f"
                             "e",
                             "\xe2\x82\xac", "\xf0\x9f\x94\xa5", "\xc2\xa0"})
        EXPECT_EQ(clean_text(text), text);
}

TEST(CleanText, HasAReplacementForEachControlCharacter) {
    EXPECT_EQ(clean_text("\x1b[31m"), "\xef\xbf\xbd[31m");
    EXPECT_EQ(clean_text("\x7f"), "\xef\xbf\xbd");
    EXPECT_EQ(clean_text("\r"), "\xef\xbf\xbd");
    EXPECT_EQ(clean_text("\xc2\x9b"), "\xef\xbf\xbd");  // C1: begins a command as ESC [ does
    EXPECT_EQ(clean_text(std::string_view("a\0b", 3)),
              "a\xef\xbf\xbd"
              "b");
}

TEST(CleanText, HasAReplacementForEachByteThatIsNoUtf8) {
    EXPECT_EQ(clean_text("\xff"), "\xef\xbf\xbd");
    EXPECT_EQ(clean_text("\xc3"), "\xef\xbf\xbd");                  // cut short
    EXPECT_EQ(clean_text("\xc3("), "\xef\xbf\xbd(");                // not continued
    EXPECT_EQ(clean_text("\xc0\xaf"), "\xef\xbf\xbd\xef\xbf\xbd");  // a long form of '/'
    EXPECT_EQ(clean_text("\xed\xa0\x80").size(), 9u);               // a surrogate
    EXPECT_EQ(clean_text("\xf4\x90\x80\x80").size(), 12u);          // beyond U+10FFFF
}

}  // namespace
}  // namespace strata
