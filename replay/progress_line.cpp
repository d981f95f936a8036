#include "replay/progress_line.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "replay/standard_streams.h"

namespace strata {
namespace {

using Time = std::chrono::steady_clock::time_point;

std::string bar(double done) {
    constexpr int cells = 30;
    const int full = static_cast<int>(done * cells);
    return fmt::format("[{:#<{}}{:.<{}}]", "", full, "", cells - full);
}

/// Nothing until enough is done to tell.
std::string time_left(double elapsed_s, double done) {
    if (elapsed_s < 5 || done < .05 || done >= 1) return {};
    const double left = elapsed_s * (1 - done) / done;
    return left < 90 ? fmt::format(", about {:.0f} s left", left) : fmt::format(", about {:.0f} min left", left / 60);
}

/// The last report, and a thread that repeats it.
class ShownProgress {
public:
    explicit ShownProgress(ProgressTiming timing)
        : timing_(std::move(timing)), is_terminal_(stderr_is_terminal()), begin_(timing_.clock()), last_(begin_) {
        try {
            thread_ = std::jthread([this](const std::stop_token& stop) { repeat(stop); });
        } catch (const std::system_error&) {
            // Without a thread the reports alone are shown.
        }
    }

    ~ShownProgress() {
        thread_ = {};
        if (is_terminal_) rewrite_line("");
    }

    ShownProgress(const ShownProgress&) = delete;
    ShownProgress& operator=(const ShownProgress&) = delete;

    void report(std::string_view what, double done) {
        const std::lock_guard held(mutex_);
        what_ = what, done_ = done;
        show(timing_.clock());
    }

private:
    void repeat(const std::stop_token& stop) {
        std::unique_lock held(mutex_);
        while (!stop.stop_requested()) {
            wakes_.wait_for(held, stop, timing_.beat, [] { return false; });
            if (!stop.stop_requested() && !what_.empty()) show(timing_.clock());
        }
    }

    void show(Time now) {
        const auto elapsed = std::chrono::duration_cast<std::chrono::seconds>(now - begin_).count();
        const std::string left = time_left(double(elapsed), done_);
        if (is_terminal_) {
            rewrite_line(done_ < 1 ? fmt::format("{} {} ({} s{})", bar(done_), what_, elapsed, left) : "");
        } else if (done_ < 1 && now - last_ >= timing_.between_lines) {
            last_ = now;
            to_stderr("strata: {:.0f} % done after {} s{}: {}\n", 100 * done_, elapsed, left, what_);
        }
    }

    const ProgressTiming timing_;
    const bool is_terminal_;
    const Time begin_;
    Time last_;  ///< of the last line
    std::string what_;
    double done_ = 0;
    std::mutex mutex_;
    std::condition_variable_any wakes_;
    std::jthread thread_;  // last: it uses all of the above
};

}  // namespace

Progress progress_line(ProgressTiming timing) {
    return [shown = std::make_shared<ShownProgress>(std::move(timing))](std::string_view what, double done) {
        shown->report(what, done);
    };
}

void show_frame(const Progress& progress, std::size_t index, std::size_t count) {
    progress(fmt::format("frame {} of {}", index + 1, count), double(index) / double(count));
}

}  // namespace strata
