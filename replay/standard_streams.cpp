#include "replay/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "capture_format/clean_text.h"

namespace strata {
namespace {

// Why standard output lost something, or 0. stdio remembers that it did and not why; the stream itself is as global.
constinit std::atomic<int> stdout_problem = 0;

constinit std::atomic<bool> has_written_stdout = false;

void note_problem(bool written) {
    if (!written && stdout_problem == 0) stdout_problem = errno;
}

// Whether the terminal's last line is to be rewritten.
constinit std::atomic<bool> is_rewritable = false;

bool put(std::FILE* stream, std::string_view text) { return std::fwrite(text.data(), 1, text.size(), stream) == text.size(); }

constexpr std::string_view clear_to_the_left = "\r\033[K";

void clear_line() {
    if (is_rewritable.exchange(false)) put(stderr, clear_to_the_left);
}

}  // namespace

void open_standard_streams() {
    for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number) {
        if (::fcntl(number, F_GETFD) >= 0 || errno != EBADF) continue;
        [[maybe_unused]] const int lowest = ::open("/", O_RDONLY | O_DIRECTORY);  // the lowest free number: this one
    }
}

void write_stdout(std::string_view text) {
    clear_line();
    has_written_stdout = true;
    note_problem(put(stdout, clean_text(text)));
}

bool wrote_stdout() { return has_written_stdout; }

void write_stderr(std::string_view text) {
    // At once: another thread may be writing, too.
    put(stderr, std::string(is_rewritable.exchange(false) ? clear_to_the_left : "") + clean_text(text));
}

bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }

void rewrite_line(std::string_view text) {
    write_stderr(text);
    is_rewritable = !text.empty();
}

Result<void> finish_stdout() {
    note_problem(std::fflush(stdout) == 0);
    if (stdout_problem == 0) return {};
    if (stdout_problem == EPIPE) {
        std::signal(SIGPIPE, SIG_DFL);
        std::raise(SIGPIPE);
    }
    return fail(Fault::usage, "stdout.cannot_write", "cannot write to standard output: {reason}",
                std::generic_category().message(stdout_problem));
}

}  // namespace strata
