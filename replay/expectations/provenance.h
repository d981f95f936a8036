// Where a picture comes from: what it takes to make it again.
#pragma once

#include "replay/images/image_io.h"
#include "replay/session/session.h"

namespace strata {

/// What a run was made of.
struct Origin {
    const DeviceInfo& device;
    std::string capture_id;
};

/// What a picture needs to be traced back; the same block is in the EXR header and in the JSON.
Metadata provenance(const Origin&, const Request&, const Run&);
inline Metadata provenance(const Session& session, const Request& request, const Run& run) {
    return provenance({session.device(), session.capture_id()}, request, run);
}

}  // namespace strata
