// What the sorted lists' C++ and shaders share.
#ifndef PASSES_TRANSPARENCY_SORTED_LISTS_SHARED_H
#define PASSES_TRANSPARENCY_SORTED_LISTS_SHARED_H
#include "passes/shader_interop.h"
#ifdef __cplusplus
namespace strata::transparency {
#endif

struct SortedListsParams {
    float pool;  // million fragments kept at a time
};

#ifdef __cplusplus
}
#endif
#endif
