#include "replay/process.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

namespace strata {
namespace {

/// A temporary file without a name: gone with whoever holds it.
using Nameless = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
Nameless nameless_file() { return {std::tmpfile(), &std::fclose}; }

std::string contents(std::FILE* file) {
    std::string text;
    std::rewind(file);
    char block[65536];
    for (std::size_t got = 0; (got = std::fread(block, 1, sizeof block, file)) > 0;) text.append(block, got);
    return text;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> made;
    for (std::string& text : texts) made.push_back(text.data());
    made.push_back(nullptr);
    return made;
}

}  // namespace

Result<EndedProcess> run_process(ProcessRequest wanted) {
    const Nameless in = nameless_file(), out = nameless_file(), err = nameless_file();
    const bool is_written =
        in && out && err && std::fwrite(wanted.input.data(), 1, wanted.input.size(), in.get()) == wanted.input.size();
    if (!is_written || std::fflush(in.get()) != 0)
        return fail(Fault::usage, "process.no_temporary_file", "cannot write a temporary file: {reason}",
                    std::generic_category().message(errno));
    std::rewind(in.get());

    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (const auto& [file, number] : {std::pair(in.get(), 0), std::pair(out.get(), 1), std::pair(err.get(), 2)})
        posix_spawn_file_actions_adddup2(&files, fileno(file), number);
    pid_t child = 0;
    const int problem = posix_spawnp(&child, wanted.arguments.front().c_str(), &files, nullptr, pointers(wanted.arguments).data(),
                                     pointers(wanted.environment).data());
    posix_spawn_file_actions_destroy(&files);
    if (problem != 0)
        return fail(Fault::device_failed, "process.cannot_start", "cannot start {program}: {reason}", wanted.arguments.front(),
                    std::generic_category().message(problem));
    EndedProcess ended;
    while (waitpid(child, &ended.status, 0) < 0 && errno == EINTR) {}
    ended.out = contents(out.get());
    ended.err = contents(err.get());
    return ended;
}

}  // namespace strata
