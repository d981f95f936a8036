// Standard input, output and error of the program: opened, written and checked here alone. Whatever names a file gives (of
// meshes, notes, parts), no control character but a line's end or a tab reaches a terminal.
#pragma once

#include <string_view>

#include <fmt/core.h>

#include "capture_format/result.h"

namespace strata {

/// To be called before any file is opened. A standard stream that is closed gets a folder in its place: no file takes its number,
/// and writing to it fails as before, also by the name /dev/stdout (/dev/null would take what is written to that name).
void open_standard_streams();

/// Results. What cannot be written is remembered for finish_stdout().
void write_stdout(std::string_view text);
/// Whether anything was written by then.
bool wrote_stdout();
/// Messages. Those that cannot be written are dropped: they must not end what they tell of.
void write_stderr(std::string_view text);

template <typename... Args>
void to_stdout(fmt::format_string<Args...> format, Args&&... args) {
    write_stdout(fmt::format(format, std::forward<Args>(args)...));
}

template <typename... Args>
void to_stderr(fmt::format_string<Args...> format, Args&&... args) {
    write_stderr(fmt::format(format, std::forward<Args>(args)...));
}

bool stderr_is_terminal();
/// The last line of a terminal at standard error becomes this text, until something else is written.
void rewrite_line(std::string_view text);

/// Flushes standard output. Fails (usage) where anything could not be written. Where nobody reads the pipe any more, the program
/// ends as every program in a pipeline does: by SIGPIPE, without a word.
Result<void> finish_stdout();

}  // namespace strata
