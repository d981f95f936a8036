// A frame as plain values: everything a stage may need to compute it again, and nothing of any graphics API.
//
//   Units      Meters, radians, seconds, linear radiance. World positions are doubles.
//   World      +y is up: Hemisphere's sky. Right-handed (glTF, OpenGL) or left-handed (Direct3D): View::to_view says which.
//   Matrices   glm's: stored by columns, for column vectors. world = to_world * vec4(object, 1); to_world[3] is the translation.
//              A matrix for row vectors that is stored by rows has the same 16 numbers in the same order.
//   Winding    The front of triangle a, b, c is the side that cross(b - a, c - a) points to, in the coordinates of the mesh. Seen
//              from there a, b, c turn counter-clockwise in a right-handed world and clockwise in a left-handed one. A to_world
//              that mirrors changes no front. Back faces are invisible unless Material::double_sided.
//   Views      view.h: view space, clip space, reversed depth. look_at() makes a View from an eye, a target and a field of view.
//
// Each header included here can be included alone by whoever reads a part of a frame.
#pragma once

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/lens.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/shadow_use.h"
#include "capture_format/frame/stage_choice.h"
#include "capture_format/frame/texture.h"
#include "capture_format/frame/weather.h"
#include "capture_format/view.h"
