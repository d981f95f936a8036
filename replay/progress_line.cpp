#include "replay/progress_line.h"

#include "replay/standard_streams.h"

namespace strata {
namespace {

constexpr auto between_lines = std::chrono::seconds(10);  // what a log can take and a waiting person bear

void rewrite(std::string_view what, double done) {
    constexpr int cells = 30;
    const int full = static_cast<int>(done * cells);
    rewrite_line(done < 1 ? fmt::format("[{:#<{}}{:.<{}}] {}", "", full, "", cells - full, what) : "");
}

}  // namespace

Progress progress_line(Clock clock) {
    return [clock, last = clock()](std::string_view what, double done) mutable {
        if (stderr_is_terminal()) return rewrite(what, done);
        if (done >= 1 || clock() - last < between_lines) return;
        last = clock();
        to_stderr("strata: {:.0f} % done: {}\n", 100 * done, what);
    };
}

void show_frame(const Progress& progress, std::size_t index, std::size_t count) {
    if (count > 1) progress(fmt::format("frame {} of {}", index + 1, count), double(index) / double(count));
}

}  // namespace strata
