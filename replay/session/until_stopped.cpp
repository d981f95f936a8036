#include "replay/session/until_stopped.h"

#include <tbb/task_group.h>

namespace strata {

bool until_stopped(const std::stop_token& stop, const std::function<void()>& work) {
    tbb::task_group group;
    const std::stop_callback cancels(stop, [&] { group.cancel(); });
    return group.run_and_wait(work) == tbb::complete;
}

}  // namespace strata
