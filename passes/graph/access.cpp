#include "passes/graph/access.h"

namespace strata {
namespace {

enum class Reads { no, yes };
enum class Writes { no, yes };

struct AccessRow {
    Access access;
    std::string_view name;
    Reads reads;
    Writes writes;
};

constexpr AccessRow access_rows[] = {
    {Access::none, "none", Reads::no, Writes::no},
    {Access::sampled, "sampled", Reads::yes, Writes::no},
    {Access::loaded, "loaded", Reads::yes, Writes::no},
    {Access::stored, "stored", Reads::no, Writes::yes},
    {Access::updated, "updated", Reads::yes, Writes::yes},
    {Access::color_written, "color_written", Reads::no, Writes::yes},
    {Access::color_blended, "color_blended", Reads::yes, Writes::yes},
    {Access::depth_tested, "depth_tested", Reads::yes, Writes::no},
    {Access::depth_written, "depth_written", Reads::yes, Writes::yes},
    {Access::indirect, "indirect", Reads::yes, Writes::no},
    {Access::indexed, "indexed", Reads::yes, Writes::no},
    {Access::copied_from, "copied_from", Reads::yes, Writes::no},
    {Access::copied_to, "copied_to", Reads::no, Writes::yes},
};

constexpr bool rows_stand_in_order() {
    for (std::size_t i = 0; i < std::size(access_rows); ++i)
        if (static_cast<std::size_t>(access_rows[i].access) != i) return false;
    return true;
}
static_assert(rows_stand_in_order());

const AccessRow& row(Access access) { return access_rows[static_cast<std::size_t>(access)]; }

}  // namespace

std::string_view name(Access access) { return row(access).name; }
bool writes(Access access) { return row(access).writes == Writes::yes; }
bool reads(Access access) { return row(access).reads == Reads::yes; }

bool writes(AccessSet set) { return writes(leading(set)); }

Access leading(AccessSet set) {
    Access first = Access::none;
    for (const AccessRow& candidate : access_rows) {
        if (!set.has(candidate.access)) continue;
        if (candidate.writes == Writes::yes) return candidate.access;
        if (first == Access::none) first = candidate.access;
    }
    return first;
}

std::string names(AccessSet set) {
    std::string text;
    for (const AccessRow& candidate : access_rows) {
        if (!set.has(candidate.access)) continue;
        if (!text.empty()) text += " and ";
        text += candidate.name;
    }
    return text.empty() ? std::string(name(Access::none)) : text;
}

}  // namespace strata
