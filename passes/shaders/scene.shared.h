// The scene on the device: records of the buffers that scene.glsl declares and every shader gets without binding them.
// Everything is in view space (+x right, +y up, +z forward, meters), made camera-relative in double on the CPU.
#ifndef PASSES_SHADERS_SCENE_SHARED_H
#define PASSES_SHADERS_SCENE_SHARED_H
#include "passes/shaders/scene/draws.shared.h"
#include "passes/shaders/scene/lights.shared.h"
#include "passes/shaders/scene/materials.shared.h"
#include "passes/shaders/scene/no_index.shared.h"
#include "passes/shaders/scene/shadows.shared.h"
#include "passes/shaders/scene/view.shared.h"
#endif
