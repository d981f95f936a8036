// The index that points at nothing. C++ has it in capture_format/frame/no_index.h.
#ifndef PASSES_SHADERS_SCENE_NO_INDEX_SHARED_H
#define PASSES_SHADERS_SCENE_NO_INDEX_SHARED_H
#ifndef __cplusplus
const uint no_index = 0xffffffffu;
#endif
#endif
