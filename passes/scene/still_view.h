// The eye of light volumes: light that is computed as it sees the scene has the same bits wherever the frame's eye is.
#pragma once

#include "capture_format/view.h"

namespace strata {

struct Frame;  // capture_format/frame.h

/// Looks along the world's axes from the middle of the first light volume; of cascades, which follow the eye, from the middle of
/// 256 of the finest cells each way, which stays while the eye is among them. The world's origin is the middle of such a block.
/// View space is as left-handed as the frame's own. Without a light volume the frame's own view. Records as it sees them are
/// offered as "Still View", "Still Draws" and so on.
View still_view(const Frame&);

}  // namespace strata
