// What grids hold, as pictures.
#pragma once

#include "passes/graph/step.h"

namespace strata {

class Graph;         // passes/graph/graph.h
class Settings;      // passes/settings.h
struct FrameImages;  // passes/frame_images.h

}  // namespace strata

namespace strata::indirect {

/// Cells as white diffuse spheres, lit by what the cells hold after propagation.
Image cells_view(Graph&, FrameImages&, const Settings&);
/// Cells with injected light as spheres, shaded by what they send.
Image injected_view(Graph&, FrameImages&, const Settings&);
/// What blockers take of the light through the faces of the cell that a surface lies in, by axis.
Image axial_occlusion_view(Graph&, FrameImages&, const Settings&);

}  // namespace strata::indirect
