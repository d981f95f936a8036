// What comments and documents refer to in docs/algorithms exists: the file, and the section or label named after it, as in
// "docs/algorithms/transparency.md 6.10, V6 and V9".
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
    const std::filesystem::path root = STRATA_SOURCE_DIR;
    for (const char* folder : {"capture_format", "passes", "replay", "ui", "captures", "tests", "docs"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            if (entry.path().extension() != ".md") continue;
            std::ifstream file(entry.path());
            std::vector<std::string> lines;
            for (std::string line; std::getline(file, line);) lines.push_back(line);
            found += check(entry.path().string(), lines);
        }
    }
    EXPECT_GT(found, 15u);
}

}  // namespace
}  // namespace strata
