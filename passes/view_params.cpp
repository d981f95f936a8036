#include "passes/view_params.h"

#include <cctype>
#include <string>

namespace strata {
namespace {

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace

bool has_word(std::string_view text, std::string_view word) {
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !is_of_word(text[at - 1])) && (end == text.size() || !is_of_word(text[end]))) return true;
    }
    return false;
}

bool names_param(const DebugView& view, std::string_view param) {
    std::string marked = "`";
    marked.append(param).append("`");
    return view.help.find(marked) != view.help.npos;
}

std::vector<const Param*> params_of(const Technique& technique, const DebugView& view) {
    std::vector<const Param*> found;
    for (const Param& param : technique.params)
        if (names_param(view, param.name)) found.push_back(&param);
    return found;
}

}  // namespace strata
