// One name per thing: the table "Terms" of docs/style.md names the words that are retired. They stand in no string, comment or
// document, and in no identifier as a part of its own ("colour" in colourOf and in my_colour).
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/8_rules/source_files.h"

namespace strata {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A retired word that may stand in files whose paths begin so.
struct Exception {
    std::string_view word, path, because;
};

constexpr std::array excepted = {
    Exception{"act", "replay/expectations/expectation_keys.h", "captures hold expectations of schema version 1, which are read"},
    Exception{"`--methods`", "replay/cli/renamed_options.h", "refused with its new name"},
    Exception{"`--points`", "replay/cli/renamed_options.h", "refused with its new name"},
    Exception{"`--repeat`", "replay/cli/renamed_options.h", "refused with its new name"},
    Exception{"method", "replay/cli/renamed_options.h", "refused with its new name"},
    Exception{"method", "passes/transparency/moments/power.glsl", "Newton's and Aberth's: numerical methods have these names"},
    Exception{"method", "capture_format/codec/frame_delta.cpp", "FLT_EVAL_METHOD of <cfloat>"},
    Exception{"grey", "passes/lens/", "exposure_grey: settings are recorded in captures by name"},
    Exception{"grey", "tests/", "exposure_grey: settings are recorded in captures by name"},
    Exception{"centre", "passes/indirect/lpv/", "faces=centre: settings are recorded in captures by name"},
    Exception{"centre", "tests/", "faces=centre: settings are recorded in captures by name"},
    Exception{"event", "ui/", "what a window hears of mouse and keys"},
    Exception{"event", "tests/7_inspector", "what a window hears of mouse and keys"},
    Exception{"event", "tests/7_tool/browser", "names of a browser's protocol"},
    Exception{"method", "tests/7_tool/browser", "names of a browser's protocol"},
    Exception{"event", "tests/7_tool/page_test", "what a page hears of mouse and keys"},
    Exception{"event", "tests/support/", "googletest's TestEventListener"},
    Exception{"", "tests/8_rules/terms_test.cpp", "this list"},
};

struct Retired {
    std::string word;  ///< in small letters; with backticks: refused as written
    std::string term;
};

std::vector<std::string> lines_of(const std::filesystem::path& path) {
    std::vector<std::string> lines;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<std::string> split(const std::string& text, char at) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(at, from), text.size());
        parts.push_back(trimmed(text.substr(from, to - from)));
        from = to + 1;
    }
    return parts;
}

/// The third column of the rows of a table of three.
std::vector<Retired> retired_of(const std::vector<std::string>& lines) {
    std::vector<Retired> all;
    bool in_terms = false;
    for (const std::string& line : lines) {
        if (line.starts_with("## ")) in_terms = line == "## Terms";
        const std::vector<std::string> cells = split(line, '|');
        if (!in_terms || cells.size() != 5 || cells[1] == "term" || cells[1].starts_with("---")) continue;
        for (const std::string& word : split(cells[3], ','))
            if (!word.empty()) all.push_back({word, cells[1]});
    }
    return all;
}

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_large(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

/// Small letters with a blank for whatever is none, and before a large letter that follows a small one.
std::string spoken_in(const std::string& line) {
    std::string words = " ";
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (i > 0 && is_large(line[i]) && is_letter(line[i - 1]) && !is_large(line[i - 1])) words += ' ';
        words += is_letter(line[i]) ? static_cast<char>(std::tolower(static_cast<unsigned char>(line[i]))) : ' ';
    }
    return words + ' ';
}

bool is_in_token(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; }

/// Whether the text has the token with nothing of an identifier or option around it.
bool has_token(const std::string& line, std::string_view token) {
    for (std::size_t at = line.find(token); at != std::string::npos; at = line.find(token, at + 1)) {
        const std::size_t end = at + token.size();
        if ((at == 0 || !is_in_token(line[at - 1])) && (end == line.size() || !is_in_token(line[end]))) return true;
    }
    return false;
}

bool is_excepted(const std::string& path, const Retired& retired) {
    return std::ranges::any_of(excepted, [&](const Exception& one) {
        return path.starts_with(one.path) && (one.word.empty() || one.word == retired.word);
    });
}

class Terms {
public:
    explicit Terms(std::vector<Retired> all) : all_(std::move(all)) {
        for (std::size_t i = 0; i < all_.size(); ++i) {
            const std::string& word = all_[i].word;
            if (word.starts_with('`')) tokens_.push_back(i);
            else if (word.find(' ') != std::string::npos) phrases_.push_back(i);
            else
                for (const char* end : {"", "s", "es"}) words_.emplace(word + end, i);
        }
    }

    /// What the line has of retired words.
    std::vector<const Retired*> in(const std::string& line) const {
        std::vector<const Retired*> found;
        for (const std::size_t i : tokens_)
            if (has_token(line, std::string_view(all_[i].word).substr(1, all_[i].word.size() - 2))) found.push_back(&all_[i]);
        const std::string words = spoken_in(line);
        for (std::size_t from = 1; from < words.size();) {
            const std::size_t to = words.find(' ', from);
            if (to > from)
                if (const auto known = words_.find(words.substr(from, to - from)); known != words_.end())
                    found.push_back(&all_[known->second]);
            from = to + 1;
        }
        for (const std::size_t i : phrases_)
            if (words.find(" " + all_[i].word + " ") != std::string::npos) found.push_back(&all_[i]);
        return found;
    }

private:
    std::vector<Retired> all_;
    std::vector<std::size_t> tokens_, phrases_;
    std::map<std::string, std::size_t, std::less<>> words_;
};

const std::filesystem::path& root() {
    static const std::filesystem::path path = STRATA_SOURCE_DIR;
    return path;
}

const Terms& terms() {
    static const Terms all(retired_of(lines_of(root() / "docs/style.md")));
    return all;
}

void check(const std::string& path, std::size_t number, const std::string& line) {
    for (const Retired* found : terms().in(line))
        if (!is_excepted(path, *found))
            ADD_FAILURE() << path << ":" << number << ": " << found->word << " is retired, see docs/style.md: " << found->term;
}

/// Lines of docs/style.md that show retired words: the table of terms, and one of sentences before and after.
std::vector<std::string> without_examples(std::vector<std::string> lines) {
    bool in_terms = false;
    for (std::string& line : lines) {
        if (line.starts_with("## ")) in_terms = line == "## Terms";
        if (in_terms || line.starts_with("|")) line.clear();
    }
    return lines;
}

bool is_document(const std::filesystem::path& path) { return path.extension() == ".md"; }

std::vector<std::filesystem::path> documents() {
    std::vector<std::filesystem::path> all;
    for (const auto& entry : std::filesystem::directory_iterator(root()))
        if (is_document(entry.path())) all.push_back(entry.path());
    for (const char* folder : {"capture_format", "passes", "replay", "ui", "captures", "tests", "docs"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root() / folder))
            if (is_document(entry.path())) all.push_back(entry.path());
    return all;
}

TEST(Terms, TheTableOfTermsIsRead) {
    const std::vector<Retired> all =
        retired_of({"## Terms", "| term | meaning | retired |", "|---|---|---|", "| gray | a color | grey, `Grey` |",
                    "| color | of light | |", "## More", "| a | b | c |"});
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0].word, "grey");
    EXPECT_EQ(all[1].word, "`Grey`");
    EXPECT_EQ(all[0].term, "gray");
    EXPECT_GT(retired_of(lines_of(root() / "docs/style.md")).size(), 30u);
}

TEST(Terms, ARetiredWordIsFoundInSentencesAndIdentifiersButNotInOtherWords) {
    const Terms some({{"act", "pass"}, {"loop turn", "iteration"}, {"`--points`", "variant"}});
    const auto found = [&](const std::string& line) {
        std::vector<std::string> words;
        for (const Retired* each : some.in(line)) words.push_back(each->term);
        return words;
    };
    for (const char* line : {"// an act", "ExpectedAct x;", "of_act", "\"acts\"", "ACT", "Act,"})
        EXPECT_THAT(found(line), ElementsAre("pass")) << line;
    EXPECT_THAT(found("// each loop turn"), ElementsAre("iteration"));
    EXPECT_THAT(found("report --points"), ElementsAre("variant"));
    for (const char* line : {"exact", "fract(x)", "actual", "--points-x", "points"}) EXPECT_THAT(found(line), IsEmpty()) << line;
}

TEST(Terms, NoSourceHasARetiredWord) {
    for (const SourceFile& file : source_files())
        for (std::size_t i = 0; i < file.lines.size(); ++i) check(file.path.generic_string(), i + 1, file.lines[i]);
}

TEST(Terms, NoDocumentHasARetiredWord) {
    for (const std::filesystem::path& document : documents()) {
        const std::string path = document.lexically_relative(root()).generic_string();
        std::vector<std::string> lines = lines_of(document);
        if (path == "docs/style.md") lines = without_examples(std::move(lines));
        for (std::size_t i = 0; i < lines.size(); ++i) check(path, i + 1, lines[i]);
    }
}

TEST(Terms, NoFileHasARetiredWordInItsName) {
    for (const SourceFile& file : source_files()) {
        const std::string path = file.path.generic_string();
        check(path, 0, path);
    }
}

}  // namespace
}  // namespace strata
