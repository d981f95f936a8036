// Files written whole or not at all: the bytes go to a temporary beside the target, which a rename then replaces. Whoever
// reads the target sees the old file or the new one, never a part.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <stop_token>
#include <string_view>

#include "capture_format/result.h"

namespace strata {

/// Removes the temporaries and ends the program at once: for where it cannot go on, as without memory. The thread that calls it
/// must not be writing a file here.
[[noreturn]] void end_program(int code);

/// A file being written. Until commit() the target is as it was; without commit() the temporary is removed.
class WholeFile {
public:
    /// Makes the temporary, empty, in the target's folder. A link is followed, an existing file's mode kept. What is no file
    /// (a pipe, /dev/stdout) cannot be replaced: there temporary() is the target itself. Fails (usage) for a directory, a
    /// folder or a file that cannot be written.
    static Result<WholeFile> begin(const std::filesystem::path& target);
    WholeFile(WholeFile&&) noexcept;
    WholeFile& operator=(WholeFile&&) noexcept;
    ~WholeFile();

    /// Where to write. The file exists: open it without creating it, so that nothing is left when a signal just removed it.
    const std::filesystem::path& temporary() const;
    /// Calls `open` with the path of the temporary and returns its result, for a writer that would create the file: a signal
    /// that ends the program waits until it is open.
    template <typename Opener>
    auto opened_by(const Opener& open) const {
        const auto held = hold_signals();
        return open(temporary());
    }
    /// Puts what was written in the target's place. Call it when every writer is done; once.
    Result<void> commit();

private:
    friend Result<void> leave_nothing_half_written_when_stopped();
    friend void end_program(int code);
    struct Pending;
    static std::unique_lock<std::mutex> hold_signals();
    explicit WholeFile(std::unique_ptr<Pending>);
    std::unique_ptr<Pending> pending_;
};

/// The whole file at once. Errors (usage) carry the path and the system's words.
Result<void> write_whole_file(const std::filesystem::path&, std::span<const std::byte>);
Result<void> write_whole_file(const std::filesystem::path&, std::string_view text);

/// For programs of our own, to be called before any thread starts: a signal that ends the process (SIGINT, SIGTERM, SIGHUP,
/// SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2) removes the temporaries and ends it with 128 + signal (130 for SIGINT), unless
/// whoever started us ignores it. A file beyond the size limit and a pipe that nobody reads are failed writes and no signals.
/// Fails (device lacks) where no thread can be started.
Result<void> leave_nothing_half_written_when_stopped();

/// While it lives, the first SIGINT or SIGTERM asks for a stop instead of ending the program, and the next one ends it. One at a
/// time.
class StopAtSignal {
public:
    StopAtSignal();
    ~StopAtSignal();
    StopAtSignal(const StopAtSignal&) = delete;
    StopAtSignal& operator=(const StopAtSignal&) = delete;
    std::stop_token token() const { return source_.get_token(); }

private:
    std::stop_source source_;
};

}  // namespace strata
