// The order of a list's keys: z ascending, then later submission first; or by submission.
#ifndef PASSES_TRANSPARENCY_LISTS_ORDER_GLSL
#define PASSES_TRANSPARENCY_LISTS_ORDER_GLSL
#include "passes/transparency/lists/event_lists.shared.h"

layout(constant_id = 0) const uint list_order = list_order_depth;

bool submitted_later(ListKey a, ListKey b) {
    return a.draw != b.draw ? a.draw > b.draw : a.primitive > b.primitive;
}

bool comes_first(ListKey a, ListKey b) {
    if (list_order == list_order_submission) return submitted_later(b, a);
    return a.z != b.z ? a.z < b.z : submitted_later(a, b);
}

#endif
