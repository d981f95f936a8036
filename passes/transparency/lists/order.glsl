// The order of a list's keys: z ascending, then later submission first; or by submission. `Submissions` is bound by order_lists().
#ifndef PASSES_TRANSPARENCY_LISTS_ORDER_GLSL
#define PASSES_TRANSPARENCY_LISTS_ORDER_GLSL
#include "passes/transparency/lists/pixel_lists.shared.h"

layout(constant_id = 0) const uint list_order = list_order_depth;

layout(set = 0, binding = 7, scalar) readonly buffer Submissions { ListSubmission submissions[]; };

bool is_later(ListSubmission a, ListSubmission b) { return a.draw != b.draw ? a.draw > b.draw : a.primitive > b.primitive; }

bool comes_first(ListKey a, ListKey b) {
    if (list_order == list_order_submission) return is_later(submissions[b.fragment], submissions[a.fragment]);
    return a.z != b.z ? a.z < b.z : is_later(submissions[a.fragment], submissions[b.fragment]);
}

// The same where a's submission is at hand.
bool comes_first(ListKey a, ListSubmission of_a, ListKey b) {
    if (list_order == list_order_submission) return is_later(submissions[b.fragment], of_a);
    return a.z != b.z ? a.z < b.z : is_later(of_a, submissions[b.fragment]);
}

#endif
