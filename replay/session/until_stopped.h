// Long work in double that ends early once a stop is requested.
#pragma once

#include <functional>
#include <stop_token>

namespace strata {

/// Whether `work` ran to its end. Once a stop is requested, its parallel loops begin nothing more, so it returns soon, and what
/// it made is worth nothing. Loops of which a row takes seconds ask tbb::is_current_task_group_canceling() more often.
[[nodiscard]] bool until_stopped(const std::stop_token&, const std::function<void()>& work);

}  // namespace strata
