// The order of a list's keys: z ascending, then later submission first; or by submission. `Submissions` is bound by order_lists().
#ifndef PASSES_TRANSPARENCY_LISTS_ORDER_GLSL
#define PASSES_TRANSPARENCY_LISTS_ORDER_GLSL
#include "passes/transparency/lists/event_lists.shared.h"

layout(constant_id = 0) const uint list_order = list_order_depth;

layout(set = 0, binding = 7, scalar) readonly buffer Submissions { ListSubmission submissions[]; };

bool submitted_later(ListKey a, ListKey b) {
    const ListSubmission s = submissions[a.event], t = submissions[b.event];
    return s.draw != t.draw ? s.draw > t.draw : s.primitive > t.primitive;
}

bool comes_first(ListKey a, ListKey b) {
    if (list_order == list_order_submission) return submitted_later(b, a);
    return a.z != b.z ? a.z < b.z : submitted_later(a, b);
}

#endif
