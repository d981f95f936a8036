// Errors have ids: words for the case, of one kind, with one sentence each.
#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/8_rules/source_files.h"

namespace strata {
namespace {

/// Ids with more than one sentence, and why.
const std::map<std::string, std::string> several_sentences = {
    {"bench.clock_too_coarse", "for a frame, and for what a device can do"},
    {"device.lacks_feature", "who needs the feature differs: a technique, a setting, the program"},
    {"device.short_loops", "each pass counts other loops"},
    {"device.unknown", "with and without a list of devices"},
    {"diff.nothing_to_compare", "an image or a capture is compared"},
    {"diff.over_tolerance", "the first image by name, or a summary"},
    {"eye.not_a_number", "of the API and of --eye"},
    {"file.cannot_read", "with and without the system's reason"},
    {"file.cannot_write", "with and without the system's reason"},
    {"frame.no_output", "who asks says why"},
    {"frame.no_pixel", "of a picture and of a frame"},
    {"frame.unknown_image", "with and without a suggestion"},
    {"image.too_large", "an image, or a part of one"},
    {"machine.out_of_memory", "what to do depends on the caller"},
    {"options.excluded", "with and without why"},
    {"options.malformed", "the form that is taken differs by option"},
    {"options.missing", "with and without the alternative"},
    {"options.not_a_choice", "with and without a suggestion"},
    {"options.not_a_number", "whole and finite numbers"},
    {"options.not_a_size", "with and without an example"},
    {"options.out_of_range", "ranges have one end or two"},
    {"output.unknown_ending", "images, tiles and tables"},
    {"probe.no_fragment", "with and without a pixel that has some"},
    {"replay.no_expectation", "in the tool and in the inspector"},
    {"session.no_step", "by name and by number"},
    {"session.stopped", "how far it got"},
    {"settings.given_twice", "by --set and in --techniques"},
    {"settings.not_a_choice", "with and without a suggestion"},
    {"settings.unknown", "of a technique, of a stage, of all"},
    {"shader.unknown", "with and without a suggestion"},
    {"stage.no_truth", "by stage and by image"},
    {"stage.not_needed", "with and without why"},
    {"window.cannot_draw", "the window and the layer in it"},
};

/// Ids of more than one kind, and why.
const std::map<std::string, std::string> several_kinds = {
    {"device.unknown", "the user asked for it, or a device that was there is gone"},
    {"machine.out_of_memory", "the tool ends with what the machine lacks; the inspector goes on"},
    {"shader.unknown", "the user named it, or a file did"},
};

/// Sentences of more than one id: the system's words make the difference.
const std::set<std::string> several_ids = {"cannot read {file}: {reason}", "cannot write {file}: {reason}",
                                           "there is no widget '{widget}'{suggestion}"};

struct ErrorInSource {
    std::string id, kind, sentence, place;
};

std::string text_of(const SourceFile& file) {
    std::string text;
    for (const std::string& line : file.lines) text += line + "\n";
    return text;
}

/// The literals of a sentence as one text.
std::string literals_of(const std::string& literals) {
    static const std::regex literal(R"~("((?:[^"\\]|\\.)*)")~");
    std::string text;
    for (std::sregex_iterator found(literals.begin(), literals.end(), literal), end; found != end; ++found) text += (*found)[1];
    return text;
}

/// What stands before the id in its statement names the kind, or is the expectation of an inspection, all of which are of bad
/// input.
std::string kind_before(const std::string& text, std::size_t id) {
    static const std::regex kind(R"(Fault::(\w+),\s*$)");
    const std::size_t begin = text.find_last_of(";}", id);
    const std::string statement = text.substr(begin + 1, id - begin - 1);
    std::smatch found;
    if (std::regex_search(statement, found, kind)) return found[1];
    return statement.find("expect(") == std::string::npos ? "" : "bad_input";
}

std::vector<ErrorInSource> errors_in_sources() {
    static const std::regex error(R"~("([a-z0-9_]+(?:\.[a-z0-9_]+)+)",\s*((?:"(?:[^"\\]|\\.)*"\s*)+)[,)])~");
    std::vector<ErrorInSource> errors;
    for (const SourceFile& file : source_files()) {
        if (file.folder() == "tests" || is_shader(file) || file.path.generic_string().ends_with("_test.cpp")) continue;
        const std::string text = text_of(file);
        for (std::sregex_iterator found(text.begin(), text.end(), error), end; found != end; ++found) {
            const auto at = static_cast<std::size_t>(found->position());
            const std::string kind = kind_before(text, at);
            if (kind.empty()) continue;  // two texts of another kind
            const auto line = std::count(text.begin(), text.begin() + found->position(), '\n') + 1;
            errors.push_back({(*found)[1], kind, literals_of((*found)[2]), file.path.string() + ":" + std::to_string(line)});
        }
    }
    return errors;
}

TEST(Errors, AreSeenByTheRules) { EXPECT_GT(errors_in_sources().size(), 150u); }

TEST(Errors, OfOneIdAreOfOneKind) {
    std::map<std::string, ErrorInSource> first;
    for (const ErrorInSource& error : errors_in_sources()) {
        const auto [known, is_new] = first.try_emplace(error.id, error);
        EXPECT_TRUE(known->second.kind == error.kind || several_kinds.contains(error.id))
            << error.id << " at " << known->second.place << " and " << error.place;
    }
}

TEST(Errors, OfOneIdHaveOneSentence) {
    std::map<std::string, ErrorInSource> first;
    std::set<std::string> differing;
    for (const ErrorInSource& error : errors_in_sources()) {
        const auto [known, is_new] = first.try_emplace(error.id, error);
        if (known->second.sentence == error.sentence) continue;
        differing.insert(error.id);
        EXPECT_TRUE(several_sentences.contains(error.id))
            << error.id << " at " << known->second.place << " and " << error.place << ": \"" << known->second.sentence
            << "\" and \"" << error.sentence << '"';
    }
    for (const auto& [id, reason] : several_sentences) EXPECT_TRUE(differing.contains(id)) << id << " has one sentence by now";
}

TEST(Errors, OfOneSentenceHaveOneId) {
    std::map<std::string, ErrorInSource> first;
    for (const ErrorInSource& error : errors_in_sources()) {
        const auto [known, is_new] = first.try_emplace(error.sentence, error);
        EXPECT_TRUE(known->second.id == error.id || several_ids.contains(error.sentence))
            << known->second.place << " and " << error.place << ": " << error.sentence;
    }
}

}  // namespace
}  // namespace strata
