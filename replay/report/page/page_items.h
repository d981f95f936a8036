// Pieces of HTML that pages of reports share.
#pragma once

#include <map>
#include <span>
#include <string>

#include "replay/report/answer.h"

namespace strata {

/// Shapes and colors of techniques: one each, in the order of the rows in which they are first seen.
class Marks {
public:
    template <typename Rows>
    explicit Marks(const Rows& rows) {
        for (const auto& row : rows) kinds_.try_emplace(row.technique, kinds_.size());
    }
    std::size_t kind(const std::string& technique) const { return kinds_.at(technique); }
    std::string html(const std::string& technique) const;
    /// By name.
    const std::map<std::string, std::size_t>& kinds() const { return kinds_; }

private:
    std::map<std::string, std::size_t> kinds_;
};

/// The facts of a page's head beside each other; empty ones are left out.
std::string provenance_html(std::initializer_list<std::string> facts);
/// A command line with its button.
std::string command_html(const std::string& command);
/// The lines of an answer without the command and the sentence on the times, which have places of their own.
std::string answer_html(std::span<const AnswerLine>, const std::string& times_are);
/// Rows that no number stands for, with the reasons; empty where there are none.
std::string left_out_html(std::span<const std::pair<std::string, std::string>> reasons);
/// A note above the answer; `id` is data for scripts, and may be empty.
std::string note_html(const std::string& note, const std::string& id = {});

}  // namespace strata
