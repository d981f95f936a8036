// What comments and documents refer to in docs/algorithms exists: the file, and the section or label named after it, as in
// "docs/algorithms/transparency.md 6.10, V6 and V9"; and so does what they refer to in DECISIONS.md, whose entries are short.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/8_rules/source_files.h"

namespace strata {
namespace {

using testing::ElementsAre;

/// A document, and the sections and labels named after it.
struct Reference {
    std::string document;
    std::vector<std::string> places;
};

/// A section is "6.10"; a label "R3", "T2.2b" or "T-MS-1". Several follow each other by commas, "and" or "to".
std::vector<Reference> references(const std::string& text) {
    static const std::string folder = "docs/algorithms/";
    static const std::regex named("^[a-z_]+\\.md");
    static const std::regex place(
        "^`?(?:,|,? and| to)? ([0-9]+(?:\\.[0-9]+)?|[A-Z](?:-[A-Z]+-)?[0-9]+(?:\\.[0-9]+)?[a-z]?)\\b(?! %)");
    std::vector<Reference> found;
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder, at + 1)) {
        std::string rest = text.substr(at + folder.size(), 200);
        std::smatch match;
        if (!std::regex_search(rest, match, named)) continue;
        found.push_back({match.str(), {}});
        for (rest = match.suffix(); std::regex_search(rest, match, place); rest = match.suffix())
            found.back().places.push_back(match[1]);
    }
    return found;
}

/// The lines as one text, so that a reference may go on in the next line of a comment.
std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) {
        const std::size_t begin = line.find_first_not_of(" /<");
        if (begin != std::string::npos) text += line.substr(begin) + " ";
    }
    return text;
}

/// Numbers that begin a line or a heading, and labels anywhere: tables and lists have them at many places.
class Places {
public:
    explicit Places(const std::filesystem::path& document) {
        static const std::regex section("^[#*]* ?([0-9]+(?:\\.[0-9]+)?)\\.? ");
        static const std::regex label("[A-Z](?:-[A-Z]+-)?[0-9]+(?:\\.[0-9]+)?[a-z]?");
        std::ifstream file(document);
        exists_ = file.good();
        for (std::string line; std::getline(file, line);) {
            if (std::smatch match; std::regex_search(line, match, section)) known_.insert(match[1]);
            for (std::sregex_iterator it(line.begin(), line.end(), label), end; it != end; ++it) known_.insert(it->str());
        }
    }
    bool exist() const { return exists_; }
    bool has(const std::string& place) const { return known_.contains(place); }

private:
    bool exists_ = false;
    std::set<std::string> known_;
};

const Places& places_of(const std::string& document) {
    static std::map<std::string, Places> read;
    const auto path = std::filesystem::path(STRATA_SOURCE_DIR) / "docs/algorithms" / document;
    return read.try_emplace(document, path).first->second;
}

/// How many references the lines have; adds a failure for each that leads nowhere.
std::size_t check(const std::string& file, const std::vector<std::string>& lines) {
    static const std::regex bare("\\bchapter [0-9]");
    const std::string text = joined(lines);
    EXPECT_FALSE(std::regex_search(text, bare)) << file << " names a chapter and not its document";
    const std::vector<Reference> found = references(text);
    for (const Reference& reference : found) {
        EXPECT_TRUE(places_of(reference.document).exist()) << file << " names docs/algorithms/" << reference.document;
        for (const std::string& place : reference.places)
            EXPECT_TRUE(places_of(reference.document).has(place))
                << file << ": docs/algorithms/" << reference.document << " has no " << place;
    }
    return found.size();
}

std::vector<std::string> lines_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

/// Every document of the folders and of the root.
std::vector<SourceFile> documents() {
    const std::filesystem::path root = STRATA_SOURCE_DIR;
    std::vector<SourceFile> found;
    for (const char* name : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"}) found.push_back({name, lines_of(root / name)});
    for (const char* folder : {"capture_format", "passes", "replay", "ui", "captures", "tests", "docs"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
            if (entry.path().extension() == ".md")
                found.push_back({entry.path().lexically_relative(root), lines_of(entry.path())});
    return found;
}

/// The entries of DECISIONS.md as number and text, line breaks as one space. An entry begins with its number and continues
/// indented.
std::vector<std::pair<int, std::string>> decisions() {
    static const std::regex begin("^([0-9]+)\\. (.*)$");
    std::vector<std::pair<int, std::string>> found;
    for (const std::string& line : lines_of(std::filesystem::path(STRATA_SOURCE_DIR) / "DECISIONS.md")) {
        if (std::smatch match; std::regex_search(line, match, begin)) {
            found.emplace_back(std::stoi(match[1]), match[2]);
        } else if (line.starts_with("    ") && !found.empty()) {
            found.back().second += line.substr(3);
        }
    }
    return found;
}

/// The numbers that follow "DECISIONS" or "DECISIONS.md".
std::vector<int> named_decisions(const std::string& text) {
    static const std::string name = "DECISIONS";
    static const std::regex first("^`?(?:\\.md)?`? ([0-9]+)"), next("^(?:,|,? and) ([0-9]+)");
    std::vector<int> found;
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        std::string rest = text.substr(at + name.size(), 100);
        std::smatch match;
        for (bool more = std::regex_search(rest, match, first); more; more = std::regex_search(rest, match, next)) {
            found.push_back(std::stoi(match[1]));
            rest = match.suffix().str();
        }
    }
    return found;
}

/// "(86)" and "continued in 101)": how one decision names another.
std::vector<int> numbers_in_parentheses(const std::string& text) {
    static const std::regex named("(?:\\(|in )([0-9]+)\\)");
    std::vector<int> found;
    for (std::sregex_iterator it(text.begin(), text.end(), named), end; it != end; ++it) found.push_back(std::stoi(it->str(1)));
    return found;
}

TEST(Documents, AReferenceIsADocumentAndWhatStandsInIt) {
    const auto found =
        references("see docs/algorithms/lighting.md 1.9, T2.2b and N16: 4096 lights, or `docs/algorithms/a.md` 3.");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_THAT(found[0].places, ElementsAre("1.9", "T2.2b", "N16"));
    EXPECT_THAT(found[1].places, ElementsAre("3"));
}

TEST(Documents, EverySectionThatACommentNamesExists) {
    std::size_t found = 0;
    for (const SourceFile& file : source_files())
        if (file.path.filename() != "documents_test.cpp") found += check(file.path.string(), file.lines);
    EXPECT_GT(found, 150u);
}

TEST(Documents, EverySectionThatADocumentNamesExists) {
    std::size_t found = 0;
    for (const SourceFile& document : documents()) found += check(document.path.string(), document.lines);
    EXPECT_GT(found, 15u);
}

TEST(Documents, NoDecisionIsLongerThan400Characters) {
    for (const auto& [number, text] : decisions()) EXPECT_LE(text.size(), 400u) << "DECISIONS.md " << number << ": " << text;
    EXPECT_GT(decisions().size(), 100u);
}

TEST(Documents, NoNumberOfADecisionIsGivenTwice) {
    std::set<int> seen;
    for (const auto& [number, text] : decisions()) EXPECT_TRUE(seen.insert(number).second) << number << ": " << text;
}

TEST(Documents, EveryDecisionThatIsNamedExists) {
    EXPECT_THAT(named_decisions("see DECISIONS.md 13, 14 and 16; 3 of them (`DECISIONS` 9)"), ElementsAre(13, 14, 16, 9));
    std::set<int> known;
    for (const auto& [number, text] : decisions()) known.insert(number);
    std::vector<SourceFile> files = documents();
    files.insert(files.end(), source_files().begin(), source_files().end());
    for (const SourceFile& file : files)
        for (const int number : named_decisions(joined(file.lines)))
            EXPECT_TRUE(known.contains(number)) << file.path.string() << " names DECISIONS " << number;
    for (const auto& [number, text] : decisions()) {
        for (const int other : numbers_in_parentheses(text))
            EXPECT_TRUE(known.contains(other)) << "DECISIONS.md " << number << " names " << other;
    }
}

}  // namespace
}  // namespace strata
